//! The cross-section as a picture (Osunluk et al., Fig. 3): every turn a disc, coloured by its half of the fibre.
//!
//! The colours are those of Okabe and Ito, told apart by colour-blind readers; large CCW turns carry a white centre as well.

use charts::{Frame, Svg, attributes};
use winding::{Half, Turn, Winding};

use crate::units::to_mm;
use crate::wind::name;

/// Beyond this number of turns the overview draws runs of turns as bars, to keep the file small.
const MOST_DISCS: usize = 20_000;
/// Radius from which a CCW turn carries a white centre [px].
const LARGE_DISC: f64 = 10.0;
/// Layers and turns in an enlarged corner.
const CORNER: (usize, usize) = (8, 7);
const WIDTH: f64 = 1100.0;
const LEFT: f64 = 90.0;
const PLOT: (f64, f64) = (960.0, 420.0);
const TOP: f64 = 110.0;

/// A rectangle of the (y, r) half-plane [mm] drawn at (`left`, `top`) [px] with `scale` [px/mm]; y to the right, r upwards.
struct View {
    y: [f64; 2],
    r: [f64; 2],
    left: f64,
    top: f64,
    scale: f64,
}

impl View {
    fn x(&self, y: f64) -> f64 {
        self.left + (y - self.y[0]) * self.scale
    }

    fn v(&self, r: f64) -> f64 {
        self.top + (self.r[1] - r) * self.scale
    }

    fn width(&self) -> f64 {
        (self.y[1] - self.y[0]) * self.scale
    }

    fn bottom(&self) -> f64 {
        self.v(self.r[0])
    }
}

/// The picture as an SVG document: an overview with axes, and the two inner corners enlarged.
pub fn svg(case_name: &str, winding: &Winding) -> String {
    let spec = winding.spec();
    let ([first, last], inner, outer) = (winding.edges().map(to_mm), to_mm(spec.inner_radius), to_mm(winding.outer_radius()));
    // from the coil's left face on, or from where a winding begins before it
    let left = first.min(0.0);
    let scale = (PLOT.0 / (last - left)).min(PLOT.1 / (outer - inner));
    let overview = View { y: [left, last], r: [inner, outer], left: LEFT, top: TOP, scale };
    let corners = corners(winding, overview.bottom() + 130.0);
    let height = corners.iter().map(View::bottom).fold(overview.bottom(), f64::max) + 60.0;
    let [cw, ccw] = [Half::Cw, Half::Ccw].map(|half| winding.count(half));
    let frame = Frame {
        ids: ["title", "desc"],
        size: [WIDTH, height],
        font: 15.0,
        title: &format!("Cross-section of the coil {case_name}: {cw} turns of the CW half and {ccw} of the CCW half"),
        description: "Every turn at its place over axial position and radius, blue for the CW half, vermilion for the CCW half, whose large \
                      discs have white centres; below, the two inner corners enlarged, layers numbered.",
        attributes: &[],
        style: "",
    };
    frame.document(|svg| {
        heading(svg, case_name, winding);
        turns(svg, &overview, winding);
        axes(svg, &overview);
        for (corner, side) in corners.iter().zip(["left", "right"]) {
            enlarged(svg, &overview, corner, winding, side);
        }
    })
}

/// The enlarged inner corners at the left and the right end; none where they would meet.
fn corners(winding: &Winding, top: f64) -> Vec<View> {
    let spec = winding.spec();
    let (pitch, [first, last], inner) = (to_mm(spec.pitch), winding.edges().map(to_mm), to_mm(spec.inner_radius));
    let across = (CORNER.1 as f64 + 0.5) * pitch;
    if last - first < 2.0 * across {
        return Vec::new();
    }
    let layers = spec.layers.min(CORNER.0) as f64;
    let up = (1.0 + (layers - 1.0) * 3_f64.sqrt() / 2.0) * pitch;
    let scale = 430.0 / across;
    let r = [inner, inner + up];
    let right = View { y: [last - across, last], r, left: LEFT + PLOT.0 - across * scale, top, scale };
    vec![View { y: [first, first + across], r, left: LEFT, top, scale }, right]
}

fn heading(svg: &mut Svg, case_name: &str, winding: &Winding) {
    let (spec, count) = (winding.spec(), winding.turns().len());
    svg.element(
        "text",
        attributes! { "x": "{LEFT:.1}", "y": "34.0", "text-anchor": "start", "font-size": "20", "font-weight": "bold" },
        &format!("{case_name}: {:?} winding", spec.pattern),
    );
    svg.text([LEFT, 58.0], "start", &format!("{} layers, {count} turns, {:.2} m of fibre", spec.layers, winding.length()));
    for (half, x) in [(Half::Cw, LEFT + 8.0), (Half::Ccw, LEFT + 250.0)] {
        disc(svg, (x, 82.0), 8.0, half);
        svg.text([x + 16.0, 87.0], "start", &format!("{} half, {} turns", name(half), winding.count(half)));
    }
}

fn colour(half: Half) -> &'static str {
    match half {
        Half::Cw => "#0072B2",
        Half::Ccw => "#D55E00",
    }
}

fn disc(svg: &mut Svg, (x, y): (f64, f64), radius: f64, half: Half) {
    svg.leaf("circle", attributes! { "cx": "{x:.2}", "cy": "{y:.2}", "r": "{radius:.2}", "fill": "{}"(colour(half)) });
    if half == Half::Ccw {
        svg.leaf("circle", attributes! { "cx": "{x:.2}", "cy": "{y:.2}", "r": "{:.2}"(0.3 * radius), "fill": "#fff" });
    }
}

fn turns(svg: &mut Svg, view: &View, winding: &Winding) {
    let radius = to_mm(winding.spec().pitch) / 2.0 * view.scale;
    for half in [Half::Cw, Half::Ccw] {
        let own: Vec<&Turn> = winding.turns().iter().filter(|turn| turn.half == half).collect();
        svg.group(attributes! { "fill": "{}"(colour(half)) }, |svg| {
            if winding.turns().len() > MOST_DISCS {
                return bars(svg, view, radius, &own);
            }
            for turn in own {
                let (x, v) = (view.x(to_mm(turn.y)), view.v(to_mm(turn.r)));
                if radius > LARGE_DISC {
                    disc(svg, (x, v), radius, half);
                } else {
                    svg.leaf("circle", attributes! { "cx": "{x:.2}", "cy": "{v:.2}", "r": "{radius:.2}" });
                }
            }
        });
    }
}

/// Draws turns that follow one another in a layer as one bar.
fn bars(svg: &mut Svg, view: &View, radius: f64, turns: &[&Turn]) {
    for run in turns.chunk_by(|a, b| a.layer == b.layer && a.turn.abs_diff(b.turn) == 1) {
        let ys = || run.iter().map(|turn| view.x(to_mm(turn.y)));
        let (x0, x1) = (ys().fold(f64::INFINITY, f64::min) - radius, ys().fold(0.0, f64::max) + radius);
        let top = run.first().map_or(0.0, |turn| view.v(to_mm(turn.r))) - radius;
        let (width, height) = (x1 - x0, 2.0 * radius);
        svg.leaf("rect", attributes! { "x": "{x0:.2}", "y": "{top:.2}", "width": "{width:.2}", "height": "{height:.3}" });
    }
}

fn axes(svg: &mut Svg, view: &View) {
    let (bottom, right) = (view.bottom() + 8.0, view.left + view.width());
    let left = view.left - 8.0;
    svg.leaf(
        "path",
        attributes! { "d": "M{left:.1} {:.1}V{bottom:.1}H{right:.1}"(view.top), "fill": "none", "stroke": "#000", "stroke-width": "1" },
    );
    for y in ticks(view.y, view.scale) {
        let x = view.x(y);
        svg.leaf("path", attributes! { "d": "M{x:.1} {bottom:.1}v6", "stroke": "#000" });
        svg.text([x, bottom + 22.0], "middle", &label(y));
    }
    for r in ticks(view.r, view.scale) {
        let v = view.v(r);
        svg.leaf("path", attributes! { "d": "M{left:.1} {v:.1}h-6", "stroke": "#000" });
        svg.text([left - 10.0, v + 5.0], "end", &label(r));
    }
    svg.text([view.left + view.width() / 2.0, bottom + 44.0], "middle", "axial position y [mm], 0 at the left face");
    let (x, y) = (left - 55.0, (view.top + view.bottom()) / 2.0);
    svg.element(
        "text",
        attributes! { "transform": "translate({x:.1} {y:.1}) rotate(-90)", "text-anchor": "middle" },
        "radius r [mm]",
    );
}

/// Round numbers (steps of 1, 2 or 5) some 60 px apart.
fn ticks(range: [f64; 2], scale: f64) -> Vec<f64> {
    let least = 60.0 / scale;
    let decade = 10_f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * decade).find(|step| *step >= least).unwrap_or(10.0 * decade);
    let first = (range[0] / step - 1e-9).ceil();
    (0..60).map(|i| (first + f64::from(i)) * step).take_while(|tick| *tick <= range[1] + 1e-9 * step).collect()
}

fn label(tick: f64) -> String {
    let rounded = format!("{tick:.4}");
    rounded.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn enlarged(svg: &mut Svg, overview: &View, corner: &View, winding: &Winding, side: &str) {
    let (x, v) = (overview.x(corner.y[0]), overview.v(corner.r[1]));
    let (w, h) = ((corner.y[1] - corner.y[0]) * overview.scale, (corner.r[1] - corner.r[0]) * overview.scale);
    svg.leaf(
        "rect",
        attributes! {
            "x": "{x:.1}", "y": "{v:.1}", "width": "{w:.1}", "height": "{h:.1}", "fill": "none", "stroke": "#000", "stroke-width": "2"
        },
    );
    let radius = to_mm(winding.spec().pitch) / 2.0;
    let inside = |turn: &&Turn| {
        let (y, r, reach) = (to_mm(turn.y), to_mm(turn.r), 0.99 * radius);
        corner.y[0] < y - reach && y + reach < corner.y[1] && r + reach < corner.r[1]
    };
    for turn in winding.turns().iter().filter(inside) {
        disc(svg, (corner.x(to_mm(turn.y)), corner.v(to_mm(turn.r))), 0.96 * radius * corner.scale, turn.half);
    }
    let right = corner.left + corner.width();
    let (label_x, anchor, caption_x, towards) =
        if side == "left" { (corner.left - 12.0, "end", corner.left, "start") } else { (right + 12.0, "start", right, "end") };
    let step = 3_f64.sqrt() * radius;
    for layer in 1..=winding.spec().layers.min(CORNER.0) {
        let v = corner.v(corner.r[0] + radius + (layer - 1) as f64 * step);
        svg.text([label_x, v + 5.0], anchor, &layer.to_string());
    }
    let caption = format!("{side} end enlarged, y = {:.2} to {:.2} mm, by layer", corner.y[0], corner.y[1]);
    svg.text([caption_x, corner.top - 14.0], towards, &caption);
}

#[cfg(test)]
mod tests {
    use super::*;
    use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength, wind};

    /// Every turn lies in the overview, and the enlarged corners hold turns, wherever the winding begins and ends.
    #[test]
    fn a_winding_that_begins_off_the_face_is_drawn_whole() {
        let spec = Spec {
            pattern: Pattern::Octupole,
            layers: 16,
            turns_odd_layers: 60,
            turns_even_layers: 59,
            inner_radius: 0.12,
            pitch: 0.262e-3,
            start: 2e-3,
            end: Some(17.8e-3),
            cw_climbs: ClimbSide::Left,
            turn_length: TurnLength::True,
            tails: Tails { cw: 0.0, ccw: 0.0 },
            defect: None,
        };
        let of = |text: &str, key: &str| -> Vec<f64> {
            let key = format!(" {key}=\"");
            let values = text.split(&key).skip(1);
            values.filter_map(|rest| rest.split('"').next()?.parse().ok()).collect()
        };
        for (start, end) in [(0.0, None), (2e-3, Some(17.8e-3)), (-1e-3, None)] {
            let picture = svg("c", &wind(&Spec { start, end, ..spec }).expect("a winding"));
            let [left, right] = [LEFT, LEFT + PLOT.0 + 1e-6];
            let places = of(&picture, "cx");
            assert!(places.iter().all(|x| (left..right).contains(x)), "{start}: {places:?}");
            let first = 1e3 * start;
            assert!(picture.contains(&format!("left end enlarged, y = {first:.2} to ")), "{start}");
            // the large discs of either corner
            let half = (left + right) / 2.0;
            let large: Vec<f64> = picture
                .split("<circle ")
                .skip(1)
                .filter(|disc| of(&format!(" {disc}"), "r").first().is_some_and(|r| *r > 10.0))
                .filter_map(|disc| of(&format!(" {disc}"), "cx").first().copied())
                .collect();
            let counts = [large.iter().filter(|x| **x < half).count(), large.iter().filter(|x| **x > half).count()];
            assert!(counts.iter().all(|count| *count > 20), "{start}: {counts:?}");
        }
    }
}
