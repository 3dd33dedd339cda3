//! A cell as a picture: its mesh over its phases, or over a field; the cells around it pale.

use std::collections::{BTreeMap, HashMap};
use std::fmt::Write;

use charts::{Colours, Frame, Svg, attributes, significant};
use homogenization::fields::Sample;
use homogenization::irregular::Solution;

use crate::homogenize::Quantity;

/// Phases in Okabe and Ito's colours, pale enough to carry a mesh.
const PHASES: [&str; 8] = ["#9ecae9", "#f2cf7d", "#8fd0b5", "#e6b3cf", "#f0a881", "#bcbddc", "#f7f0a8", "#c8c8c8"];
const SIDE: f64 = 640.0;
const LEFT: f64 = 20.0;
const FONT: f64 = 18.0;
/// Height of a line of text [px].
const LINE: f64 = 1.5 * FONT;
/// Most characters of a line: letters take 0.56 font sizes.
const MOST: usize = 63;
/// Width of the surroundings that are shown, in widths of the cell.
const AROUND: f64 = 0.12;

/// Positions [m] to pixels; y upwards.
struct View {
    low: [f64; 2],
    scale: f64,
    size: [f64; 2],
}

impl View {
    fn new(sample: &Sample, lattice: [[f64; 2]; 2]) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for position in sample.states.iter().map(|s| s.position).chain(corners(lattice)) {
            for c in 0..2 {
                (low[c], high[c]) = (low[c].min(position[c]), high[c].max(position[c]));
            }
        }
        let margin = AROUND * (high[0] - low[0]).max(high[1] - low[1]);
        let (low, high) = (low.map(|v| v - margin), high.map(|v| v + margin));
        let scale = SIDE / (high[0] - low[0]).max(high[1] - low[1]);
        Self { low, scale, size: [0, 1].map(|c| (high[c] - low[c]) * scale) }
    }

    fn pixel(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.low[0]) * self.scale, self.size[1] - (y - self.low[1]) * self.scale]
    }
}

fn corners([a, b]: [[f64; 2]; 2]) -> [[f64; 2]; 4] {
    [[0.0, 0.0], a, [a[0] + b[0], a[1] + b[1]], b]
}

/// The picture as an SVG document, with a field if one is given.
pub fn svg(name: &str, caption: &str, solution: &Solution, sample: &Sample, field: Option<Quantity>) -> String {
    let view = View::new(sample, solution.periodic.lattice);
    let caption_lines = broken(caption);
    let top = 34.0 + LINE * caption_lines.len() as f64 + 0.7 * FONT;
    let below = top + view.size[1];
    let rows = if field.is_some() { 2.7 } else { 1.0 + solution.phases.len() as f64 };
    let (width, height) = (2.0 * LEFT + SIDE, below + (2.6 + rows) * LINE);
    let frame = Frame {
        ids: ["title", "desc"],
        size: [width, height],
        font: FONT,
        title: &format!("{name}: {caption}"),
        description: match field {
            Some(_) => {
                "The periodic cell with its mesh, coloured by the field, with the scale of its colours; copies of it around, pale."
            }
            None => "The periodic cell with its mesh, coloured by its phases, which the legend names; copies of it around, pale.",
        },
        attributes: &[],
        style: "",
    };
    let colours = field.map(|quantity| (quantity, colours(quantity, sample)));
    frame.document(|svg| {
        svg.element(
            "text",
            attributes! { "x": "{LEFT}", "y": "34", "font-size": "{:.0}"(1.2 * FONT), "font-weight": "bold" },
            name,
        );
        for (n, line) in caption_lines.iter().enumerate() {
            svg.text([LEFT, 34.0 + LINE * (n + 1) as f64], "start", line);
        }
        svg.open("clipPath", attributes! { "id": "frame" });
        let [w, h] = view.size;
        svg.leaf("rect", attributes! { "width": "{w:.1}", "height": "{h:.1}" }).joined().close("clipPath");
        svg.group(attributes! { "transform": "translate({LEFT} {top})", "clip-path": "url(#frame)" }, |svg| {
            svg.open("defs", &[]).group(attributes! { "id": "cell" }, |svg| {
                fill(svg, &view, sample, colours.as_ref());
                mesh(svg, &view, solution, sample);
            });
            svg.joined().close("defs");
            copies(svg, &view, solution);
        });
        scale_bar(svg, &view, below);
        svg.moved([LEFT, below + 2.4 * LINE], |svg| match &colours {
            Some((_, colours)) => colours.scale(svg, FONT, SIDE - 2.0 * FONT),
            None => legend(svg, solution),
        });
    })
}

/// A text in lines that are short enough, broken behind blanks and commas.
fn broken(text: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_inclusive([' ', ',']) {
        if lines.last().is_some_and(|line| !line.is_empty() && line.chars().count() + word.trim_end().chars().count() > MOST) {
            lines.push(String::new());
        }
        lines.last_mut().into_iter().for_each(|line| line.push_str(word));
    }
    lines
}

fn colours(quantity: Quantity, sample: &Sample) -> Colours {
    let values = sample.states.iter().map(|s| quantity.of(s)).filter(|v| v.is_finite());
    let range = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    Colours::of(quantity.label(), range, 1e-9)
}

/// Elements of one colour as one path; edges of their own colour hide the seams. Without a field an element is filled as a whole.
fn fill(svg: &mut Svg, view: &View, sample: &Sample, colours: Option<&(Quantity, Colours)>) {
    let mut paths: BTreeMap<String, String> = BTreeMap::new();
    let Some((quantity, colours)) = colours else {
        let of_element = (sample.divisions + 1) * (sample.divisions + 1);
        for states in sample.states.chunks(of_element) {
            let path = paths.entry(PHASES[states[0].phase % PHASES.len()].to_owned()).or_default();
            line(path, view, (0..4).flat_map(|side| along(sample, side)).map(|k| states[k].position));
        }
        return paths.iter().for_each(|(colour, path)| area(svg, colour, path));
    };
    let colour = |corners: &[usize; 4]| {
        let mean = corners.iter().map(|k| quantity.of(&sample.states[*k])).sum::<f64>() / 4.0;
        if mean.is_finite() { colours.at(mean) } else { "#e8e8e8".into() }
    };
    let coloured: Vec<_> = sample.quadrilaterals.iter().map(|corners| (colour(corners), corners)).collect();
    // neighbours of one colour in a row are one shape
    for run in coloured.chunks(sample.divisions).flat_map(|row| row.chunk_by(|a, b| a.0 == b.0)) {
        let near = run.iter().map(|(_, corners)| corners[0]).chain([run[run.len() - 1].1[1]]);
        let far = run.iter().rev().map(|(_, corners)| corners[2]).chain([run[0].1[3]]);
        line(paths.entry(run[0].0.clone()).or_default(), view, near.chain(far).map(|k| sample.states[k].position));
    }
    paths.iter().for_each(|(colour, path)| area(svg, colour, path));
}

fn area(svg: &mut Svg, colour: &str, path: &str) {
    svg.leaf("path", attributes! { "fill": "{colour}", "stroke": "{colour}", "stroke-width": "0.5", "d": "{path}" });
}

/// Points in tenths of a pixel, each but the first relative to the one before it.
fn line(path: &mut String, view: &View, positions: impl Iterator<Item = [f64; 2]>) {
    let mut before = None;
    for position in positions {
        let [x, y] = view.pixel(position).map(|v| (10.0 * v).round() as i64);
        match before.replace([x, y]) {
            None => _ = write!(path, "M{} {}", x as f64 / 10.0, y as f64 / 10.0),
            Some(last) if last == [x, y] => {}
            Some([u, v]) => _ = write!(path, "l{} {}", (x - u) as f64 / 10.0, (y - v) as f64 / 10.0),
        }
    }
}

/// Points of a sampled element along its sides, counter-clockwise.
fn along(sample: &Sample, side: usize) -> impl Iterator<Item = usize> {
    let (d, n) = (sample.divisions, sample.divisions + 1);
    (0..n).map(move |k| match side {
        0 => k,
        1 => k * n + d,
        2 => d * n + d - k,
        _ => (d - k) * n,
    })
}

/// Outlines of the elements, thicker where the phase changes or ends.
fn mesh(svg: &mut Svg, view: &View, solution: &Solution, sample: &Sample) {
    let (mesh, of_element) = (&solution.mesh, (sample.divisions + 1) * (sample.divisions + 1));
    let mut original: Vec<usize> = (0..mesh.nodes().len()).collect();
    solution.periodic.periodic.iter().for_each(|[copy, first]| original[*copy] = *first);
    // the inner nodes of a side name it, whichever copy it is
    let (order, m) = (mesh.order(), mesh.order() + 1);
    let name = |e: usize, side: usize| {
        let node = |k: usize| match side {
            0 => k,
            1 => k * m + order,
            2 => order * m + k,
            _ => k * m,
        };
        let mut pair = [1, order - 1].map(|k| original[mesh.elements()[e][node(k)]]);
        pair.sort_unstable();
        pair
    };
    let mut sides: HashMap<[usize; 2], Vec<(usize, usize)>> = HashMap::new();
    let all = || (0..mesh.elements().len()).flat_map(|e| (0..4).map(move |side| (e, side)));
    all().for_each(|(e, side)| sides.entry(name(e, side)).or_default().push((e, side)));
    let (mut lines, mut interfaces) = (String::new(), String::new());
    for (e, side) in all() {
        let beside = &sides[&name(e, side)];
        let inside = beside.len() > 1 && beside.iter().all(|(other, _)| mesh.regions()[*other] == mesh.regions()[e]);
        let path = if inside { &mut lines } else { &mut interfaces };
        let start = e * of_element;
        line(path, view, along(sample, side).map(|k| sample.states[start + k].position));
    }
    svg.leaf(
        "path",
        attributes! { "fill": "none", "stroke": "#000", "stroke-opacity": "0.35", "stroke-width": "0.6", "d": "{lines}" },
    );
    svg.leaf("path", attributes! { "fill": "none", "stroke": "#000", "stroke-width": "1", "d": "{interfaces}" });
}

/// The cell, pale copies around it, and its lattice vectors.
fn copies(svg: &mut Svg, view: &View, solution: &Solution) {
    let [a, b] = solution.periodic.lattice;
    svg.group(attributes! { "opacity": "0.3" }, |svg| {
        for (i, j) in (-2..=2).flat_map(|i| (-2..=2).map(move |j| (i, j))).filter(|ij| *ij != (0, 0)) {
            let (i, j) = (f64::from(i) * view.scale, f64::from(j) * view.scale);
            let (x, y) = (i * a[0] + j * b[0], -(i * a[1] + j * b[1]));
            svg.leaf("use", attributes! { "href": "#cell", "x": "{x:.2}", "y": "{y:.2}" });
        }
    });
    svg.leaf("use", attributes! { "href": "#cell" });
    let path: Vec<String> = corners([a, b]).map(|p| view.pixel(p)).iter().map(|[x, y]| format!("{x:.2} {y:.2}")).collect();
    svg.leaf(
        "path",
        attributes! {
            "fill": "none", "stroke": "#c00000", "stroke-width": "1.5", "stroke-dasharray": "7 4", "d": "M{}z"(path.join("L"))
        },
    );
}

fn legend(svg: &mut Svg, solution: &Solution) {
    for (k, phase) in solution.phases.iter().enumerate() {
        let y = LINE * (k as f64 + 0.75);
        let share = solution.response.fractions.get(k).copied().unwrap_or(0.0);
        let (top, colour) = (y - 0.85 * FONT, PHASES[k % PHASES.len()]);
        svg.leaf(
            "rect",
            attributes! { "y": "{top:.1}", "width": "{FONT}", "height": "{FONT}", "fill": "{colour}", "stroke": "#000" },
        );
        svg.text([1.6 * FONT, y], "start", &format!("{}, {:.2} %", phase.name, 100.0 * share));
    }
    let said = format!("{} elements of order {}", solution.mesh.elements().len(), solution.mesh.order());
    svg.text([0.0, LINE * (solution.phases.len() as f64 + 0.75)], "start", &said);
}

/// A length to scale and the outline of the lattice cell, below the picture.
fn scale_bar(svg: &mut Svg, view: &View, below: f64) {
    let metres = 0.25 * view.size[0] / view.scale;
    let decade = 10_f64.powf(metres.log10().floor());
    let length = [5.0, 2.0, 1.0].into_iter().map(|m| m * decade).find(|l| *l <= metres).unwrap_or(decade);
    let (y, pixels) = (below + 0.8 * LINE, length * view.scale);
    svg.leaf("path", attributes! { "d": "M{LEFT} {y:.1}h{pixels:.1}", "stroke": "#000", "stroke-width": "3" });
    let said = format!("{} µm; x to the right, y upwards", significant(length * 1e6, 3));
    svg.text([LEFT, y + LINE], "start", &said);
    svg.element(
        "text",
        attributes! { "x": "{:.1}"(LEFT + SIDE), "y": "{:.1}"(y + LINE), "text-anchor": "end", "fill": "#c00000" },
        "dashed: the lattice cell",
    );
}
