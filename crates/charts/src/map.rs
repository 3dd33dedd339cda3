//! Heat maps: a grid of values in steps of colour.

use std::fmt::Write;

use crate::attributes;
use crate::scale::{DIGIT, Scale, power_of_ten};
use crate::svg::Svg;

/// Steps of colour; odd, so that a diverging map has a middle.
const STEPS: usize = 41;

/// Overlap of the rows of a map [px]: without it, rounding to pixels leaves gaps.
const OVERLAP: f64 = 0.6;

/// Cividis (Nuñez, Anderton and Renslow 2018): even in lightness, the same to colour-blind readers.
const SEQUENTIAL: [u32; 10] =
    [0x00204d, 0x00336f, 0x39486b, 0x575c6d, 0x707173, 0x8a8779, 0xa69d75, 0xc4b56c, 0xe4cf5b, 0xffea46];
/// RdBu (Brewer), from blue to red.
const DIVERGING: [u32; 11] =
    [0x053061, 0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7, 0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b, 0x67001f];

/// Values to colours.
#[derive(Debug, Clone, PartialEq)]
pub struct Colours {
    /// Quantity and unit, e.g. "strain [10⁻⁶]".
    pub label: String,
    /// Value at either end.
    pub range: [f64; 2],
    stops: &'static [u32],
    /// Whether the colours run from high to low.
    reversed: bool,
}

impl Colours {
    /// Colours from blue to red, white at 0, for values of at most `most` either side; never less than `least`.
    pub fn diverging(label: impl Into<String>, most: f64, least: f64) -> Self {
        let most = most.max(least);
        Self { label: label.into(), range: [-most, most], stops: &DIVERGING, reversed: false }
    }

    /// Colours from dark near 0 to bright for a range of one sign, diverging about 0 if the values lie on both sides of it; at least `least` wide. Ends that are no
    /// numbers count as 0.
    pub fn of(label: impl Into<String>, ends: [f64; 2], least: f64) -> Self {
        // of no numbers there are none to tell apart
        let [low, high] = if ends.iter().all(|end| end.is_finite()) { ends } else { [0.0; 2] };
        // a hundredth on the other side is no reason to give half the colours to it
        if low.min(-high) < 0.0 && (-low).min(high) > 0.01 * (-low).max(high) {
            return Self::diverging(label, (-low).max(high), least);
        }
        let middle = low / 2.0 + high / 2.0;
        let range = if high - low < least { [middle - least / 2.0, middle + least / 2.0] } else { [low, high] };
        Self { label: label.into(), range, stops: &SEQUENTIAL, reversed: -low > high }
    }

    /// Colour of a value.
    pub fn at(&self, value: f64) -> String {
        self.colour(self.step(value))
    }

    fn step(&self, value: f64) -> usize {
        let part = (value - self.range[0]) / (self.range[1] - self.range[0]);
        ((part * STEPS as f64).max(0.0) as usize).min(STEPS - 1)
    }

    fn colour(&self, step: usize) -> String {
        let step = if self.reversed { STEPS - 1 - step } else { step };
        let along = step as f64 / (STEPS - 1) as f64 * (self.stops.len() - 1) as f64;
        let below = (along as usize).min(self.stops.len() - 2);
        let channel = |shift: u32| {
            let [a, b] = [below, below + 1].map(|k| f64::from((self.stops[k] >> shift) & 0xff));
            (a + (b - a) * (along - below as f64)).round() as u8
        };
        format!("#{:02x}{:02x}{:02x}", channel(16), channel(8), channel(0))
    }

    /// The label, below it all colours as a bar of this `width` \[px\], and below that the values at its ends and, where there is room, in its middle, in a font
    /// of this size \[px\]; all of it 3.7 font sizes high.
    pub fn scale(&self, svg: &mut Svg, font: f64, width: f64) {
        let [low, high] = self.range;
        let most = low.abs().max(high.abs());
        let power = if most > 0.0 && !(1e-3..1e6).contains(&most) { most.log10().floor() } else { 0.0 };
        let unit = 10.0_f64.powf(power);
        let named = if power == 0.0 { self.label.clone() } else { format!("{} · {}", self.label, power_of_ten(power)) };
        // two digits of the range
        let decimals = (1.0 - ((high - low) / unit).log10().floor()).clamp(0.0, 15.0) as usize;
        let said = |value: f64| {
            let text = format!("{:.decimals$}", value / unit);
            let zero = text.chars().all(|c| "-0.".contains(c));
            if zero { "0".to_owned() } else { text.replace('-', "\u{2212}") }
        };
        let middle = said(low + (high - low) / 2.0);
        let [low, high] = [low, high].map(said);
        svg.text([0.0, 1.1 * font], "start", &named);
        let (top, deep) = (1.6 * font, 0.8 * font);
        svg.group(attributes! { "transform": "translate(0 {top:.1}) scale({width:.1} {deep:.1})" }, |svg| self.bar(svg));
        let room = [&low, &middle, &high].map(|text| text.chars().count() + 2).iter().sum::<usize>() as f64 * DIGIT * font;
        let places = [(0.0, "start", low), (width / 2.0, "middle", middle), (width, "end", high)];
        let mut marks = format!("M0 {top:.1}h{width:.1}v{deep:.1}h-{width:.1}z");
        for (at, anchor, text) in places.into_iter().filter(|(_, anchor, _)| *anchor != "middle" || room < width) {
            let _ = write!(marks, "M{at:.1} {:.1}v4", top + deep);
            svg.text([at, top + deep + 1.25 * font], anchor, &text);
        }
        svg.leaf("path", attributes! { "class": "axis", "fill": "none", "stroke": "currentColor", "d": "{marks}" });
    }

    /// All colours in a box of 1 × 1, from left to right.
    fn bar(&self, svg: &mut Svg) {
        let each = 1.0 / STEPS as f64;
        svg.group(attributes! { "transform": "scale({each:.6} 1)", "shape-rendering": "crispEdges" }, |svg| {
            for step in 0..STEPS {
                svg.leaf("path", attributes! { "fill": "{}"(self.colour(step)), "d": "M{step} 0h1v1h-1z" });
            }
        });
    }
}

/// Values on a grid of equal cells.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatMap {
    /// Cells along x.
    pub columns: usize,
    /// Value of each cell, row by row from the bottom, as many as fill whole rows; not a number where there is nothing.
    pub values: Vec<f64>,
    /// Ends along x.
    pub x: [f64; 2],
    /// Ends along y.
    pub y: [f64; 2],
    /// Its colours.
    pub colours: Colours,
    /// Whether the colour bar is drawn with it.
    pub bar: bool,
    /// Numbers of the cells that stand out, in the order of the values; each carries a dot. What is no cell's number has none.
    pub marked: Vec<usize>,
    /// Rectangles that are outlined, by their ends along x and along y.
    pub outlines: Vec<[[f64; 2]; 2]>,
}

impl HeatMap {
    fn rows(&self) -> usize {
        self.values.len() / self.columns.max(1)
    }

    /// The cells in a box of `width` × `height`. The `first` drawing of a map on a page gives them the name `id`, later ones refer to it.
    pub(crate) fn cells(&self, svg: &mut Svg, [width, height]: [f64; 2], id: &str, first: bool) {
        let (across, down) = (width / self.columns.max(1) as f64, height / self.rows().max(1) as f64);
        let thick = 1.0 + OVERLAP / down;
        let scale = format!("scale({across:.6} {down:.6})");
        let draw = |svg: &mut Svg| match first {
            true => svg.group(attributes! { "id": "{id}" }, |svg| self.runs(svg)),
            false => _ = svg.leaf("use", attributes! { "href": "#{id}" }),
        };
        svg.group(
            attributes! { "class": "cells", "stroke-width": "{thick:.3}", "transform": "{scale}", "shape-rendering": "crispEdges" },
            draw,
        );
    }

    /// A dot in the middle of each cell that stands out, in a box of `width` × `height`.
    pub(crate) fn dots(&self, svg: &mut Svg, [width, height]: [f64; 2]) {
        let (columns, rows) = (self.columns.max(1), self.rows().max(1));
        for cell in self.marked.iter().filter(|cell| **cell < columns * self.rows()) {
            let (x, y) = ((cell % columns) as f64 + 0.5, (rows - 1 - cell / columns) as f64 + 0.5);
            let (x, y) = (x * width / columns as f64, y * height / rows as f64);
            svg.leaf("circle", attributes! { "class": "dot", "cx": "{x:.1}", "cy": "{y:.1}", "r": "3.5" });
        }
    }

    /// The outlines, each on a wider white line, so that it stands out on any map.
    pub(crate) fn outlined(&self, svg: &mut Svg, [x, y]: [&Scale; 2]) {
        for [across, along] in &self.outlines {
            let ([left, right], [low, high]) = (across.map(|end| x.pixel(end)), along.map(|end| y.pixel(end)));
            let path = format!("M{left:.1} {low:.1}H{right:.1}V{high:.1}H{left:.1}z");
            svg.leaf("path", attributes! { "class": "outline under", "d": "{path}" });
            svg.leaf("path", attributes! { "class": "outline", "d": "{path}" });
        }
    }

    /// Runs of cells of one colour as lines as thick as a row, one path for each colour; a cell is a unit square.
    fn runs(&self, svg: &mut Svg) {
        let rows = self.rows();
        let mut paths = vec![String::new(); STEPS];
        for (row, values) in self.values.chunks_exact(self.columns.max(1)).enumerate() {
            let steps: Vec<Option<usize>> = values.iter().map(|v| v.is_finite().then(|| self.colours.step(*v))).collect();
            let mut start = 0;
            for run in steps.chunk_by(|a, b| a == b) {
                if let Some(step) = run[0] {
                    let _ = write!(paths[step], "M{start} {}.5h{}", rows - 1 - row, run.len());
                }
                start += run.len();
            }
        }
        for (step, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
            svg.leaf("path", attributes! { "stroke": "{}"(self.colours.colour(step)), "d": "{path}" });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_run_from_end_to_end_with_white_at_zero() {
        let diverging = Colours::of("", [-1.0, 2.0], 0.0);
        assert_eq!(diverging.range, [-2.0, 2.0]);
        let at = |value: f64| diverging.colour(diverging.step(value));
        assert_eq!([at(-2.0), at(0.0), at(2.0), at(9.0)], ["#053061", "#f7f7f7", "#67001f", "#67001f"]);
        let sequential = Colours::of("", [-0.001, 2.0], 0.0);
        assert_eq!((sequential.range, sequential.colour(0).as_str()), ([-0.001, 2.0], "#00204d"));
        let negative = Colours::of("", [-2.0, 0.0], 0.0);
        assert_eq!(
            (negative.colour(negative.step(0.0)).as_str(), negative.colour(negative.step(-2.0)).as_str()),
            ("#00204d", "#ffea46")
        );
        let still = Colours::of("", [3.0, 3.0], 1.0);
        assert_eq!((still.range, still.step(3.0)), ([2.5, 3.5], STEPS / 2));
        assert_eq!(Colours::of("", [0.0, 0.0], 1.0).range, [-0.5, 0.5]);
    }

    #[test]
    fn a_map_without_cells_or_with_marks_beyond_them_is_drawn() {
        let figure = |values: Vec<f64>| {
            let colours = Colours::of("", [f64::NAN; 2], 1.0);
            let map = HeatMap {
                columns: 2,
                values,
                x: [0.0, 1.0],
                y: [0.0, 1.0],
                colours,
                bar: true,
                marked: vec![99],
                outlines: Vec::new(),
            };
            let [x, y] = ["x", "y"].map(|label| crate::Axis::tight(label, 1e-3));
            let panels = vec![crate::Panel::map(x, y, crate::Height::Lines(8.0), map)];
            let text = String::new;
            crate::Figure { id: "m", title: text(), description: text(), caption: text(), columns: 1, panels }
        };
        for values in [vec![], vec![1.0, 2.0]] {
            let figure = figure(values);
            let drawn = figure.document() + &figure.element().into_string();
            assert!(!drawn.contains("NaN") && !drawn.contains("class=\"dot\""), "{drawn}");
        }
    }

    #[test]
    fn cells_of_one_colour_that_touch_are_one_box() {
        let colours = Colours::diverging("", 1.0, 0.0);
        let values = vec![1.0, 1.0, -1.0, f64::NAN, 1.0, 1.0];
        let map = HeatMap {
            columns: 3,
            values,
            x: [0.0, 1.0],
            y: [0.0, 1.0],
            colours,
            bar: true,
            marked: vec![1],
            outlines: Vec::new(),
        };
        let drawn = |draw: &dyn Fn(&mut Svg)| {
            let mut svg = Svg::default();
            draw(&mut svg);
            svg.into_string()
        };
        let cells = drawn(&|svg| map.cells(svg, [30.0, 20.0], "m", true));
        assert!(cells.contains("scale(10.000000 10.000000)") && cells.contains("id=\"m\""), "{cells}");
        assert!(cells.contains("d=\"M0 1.5h2M1 0.5h2\"") && cells.contains("d=\"M2 1.5h1\""), "{cells}");
        let dots = drawn(&|svg| map.dots(svg, [30.0, 20.0]));
        assert!(dots.contains("cx=\"15.0\" cy=\"15.0\"") && dots.lines().count() == 1, "{dots}");
        let again = drawn(&|svg| map.cells(svg, [15.0, 20.0], "m", false));
        assert!(
            again.contains("scale(5.000000 10.000000)") && again.contains("href=\"#m\"") && !again.contains("<path"),
            "{again}"
        );
    }
}
