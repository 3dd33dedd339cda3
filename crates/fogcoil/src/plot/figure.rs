//! A figure: panels under one another or side by side, each with its axes, legend or colour bar.

use std::fmt::Write;

use super::scale::Scale;
use super::style::document_style;
use super::{Axis, Colours, Drawing, HeatMap, Series};
use crate::picture::escape;

/// A figure.
pub(crate) struct Figure<'a> {
    /// Unique on its page and among files; the names of its parts start with it.
    pub(crate) id: &'static str,
    /// What it shows.
    pub(crate) title: String,
    /// What there is to see in it, for those who do not see it.
    pub(crate) description: String,
    /// What one must know to read it.
    pub(crate) caption: String,
    /// Panels side by side, where the paper is wide enough.
    pub(crate) columns: usize,
    /// In reading order.
    pub(crate) panels: Vec<Panel<'a>>,
}

/// A plot within a figure.
pub(crate) struct Panel<'a> {
    /// Above it; none if empty.
    pub(crate) heading: String,
    /// To the right.
    pub(crate) x: Axis,
    /// Upwards.
    pub(crate) y: Axis,
    /// How high it is.
    pub(crate) height: Height,
    /// What is in it.
    pub(crate) content: Content<'a>,
}

/// Height of a panel between its axes.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Height {
    /// In font sizes.
    Lines(f64),
    /// A unit of y is as long as a unit of x; at most this many font sizes high.
    ToScale(f64),
}

/// What a panel shows.
pub(crate) enum Content<'a> {
    /// Lines, the first at the back.
    Lines(Vec<Series<'a>>),
    /// A heat map.
    Map(HeatMap),
    /// A drawing.
    Drawing(Drawing),
}

/// For which paper a figure is drawn; a page holds both and shows one.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    /// Screens and paper.
    Wide,
    /// Phones.
    Narrow,
}

/// Measures of a size [px].
struct Measures {
    class: &'static str,
    width: f64,
    font: f64,
    /// Least distance of ticks along x and y.
    apart: [f64; 2],
    /// Most panels side by side.
    columns: usize,
    /// Whether it comes first on a page.
    first: bool,
}

impl Size {
    fn measures(self) -> Measures {
        match self {
            Self::Wide => Measures { class: "wide", width: 900.0, font: 14.0, apart: [75.0, 42.0], columns: 2, first: true },
            Self::Narrow => Measures { class: "narrow", width: 360.0, font: 12.0, apart: [55.0, 30.0], columns: 1, first: false },
        }
    }
}

/// Width of a digit in font sizes, a little more than the usual fonts have.
const DIGIT: f64 = 0.62;
/// Mean width of a letter in font sizes, a little more than the usual fonts have.
const LETTER: f64 = 0.56;
/// Length of a legend's sample [px].
const SAMPLE: f64 = 34.0;
/// Widest colour bar [px].
const BAR: f64 = 420.0;

/// Where the parts of a panel lie [px].
struct Place {
    /// From the panel's left to its axes.
    left: f64,
    /// Width and height between the axes.
    plot: [f64; 2],
    /// Height of what stands above the axes.
    above: f64,
    below: f64,
}

impl Place {
    fn height(&self) -> f64 {
        self.above + self.plot[1] + self.below
    }
}

impl Figure<'_> {
    /// As an `<svg>` element to stand in a page with [`super::page_style`]; the narrow one after the wide one, whose maps it shows.
    pub(crate) fn svg(&self, size: Size) -> String {
        let m = size.measures();
        let (body, height) = self.body(&m);
        let id = format!("{}-{}", self.id, m.class);
        format!(
            "<svg class=\"plot {}\" viewBox=\"0 0 {} {height:.0}\" font-size=\"{}\" role=\"img\" \
             aria-labelledby=\"{id}-title {id}-desc\">\n<title id=\"{id}-title\">{}</title>\n<desc id=\"{id}-desc\">{}</desc>\n{body}</svg>\n",
            m.class,
            m.width,
            m.font,
            escape(&self.title),
            escape(&self.description),
        )
    }

    /// As a document of its own, with its title.
    pub(crate) fn document(&self) -> String {
        let m = Size::Wide.measures();
        let (body, height) = self.body(&m);
        let (id, width, top) = (self.id, m.width, 36.0);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" viewBox=\"0 0 {width} {0:.0}\" width=\"{width}\" height=\"{0:.0}\" \
             font-family=\"sans-serif\" font-size=\"{1}\" role=\"img\" aria-labelledby=\"{id}-title {id}-desc\">\n\
             <title id=\"{id}-title\">{2}</title>\n<desc id=\"{id}-desc\">{3} {4}</desc>\n<style>\n{5}</style>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text x=\"4\" y=\"22\" font-size=\"18\" font-weight=\"bold\">{2}</text>\n\
             <g transform=\"translate(0 {top})\">\n{body}</g>\n</svg>\n",
            height + top,
            m.font,
            escape(&self.title),
            escape(&self.description),
            escape(&self.caption),
            document_style(),
        )
    }

    /// Everything but title and style, and its height.
    fn body(&self, m: &Measures) -> (String, f64) {
        let columns = self.columns.clamp(1, m.columns);
        let gap = 1.5 * m.font;
        let width = (m.width - gap * (columns - 1) as f64) / columns as f64;
        let mut out = String::new();
        let mut top = 0.0;
        // axes of panels under one another begin at one place
        let left = |column: usize| {
            let own = self.panels.iter().skip(column).step_by(columns).map(|panel| panel.left(m, width));
            own.fold(0.0, f64::max)
        };
        let lefts: Vec<f64> = (0..columns).map(left).collect();
        for (number, row) in self.panels.chunks(columns).enumerate() {
            let places: Vec<Place> = row.iter().zip(&lefts).map(|(panel, left)| panel.place(m, width, *left)).collect();
            for (column, (panel, place)) in row.iter().zip(&places).enumerate() {
                let at = column as f64 * (width + gap);
                let id = format!("{}-map-{}", self.id, number * columns + column);
                let _ = writeln!(out, "<g transform=\"translate({at:.1} {top:.1})\">\n{}</g>", panel.svg(m, width, place, &id));
            }
            top += places.iter().map(Place::height).fold(0.0, f64::max);
        }
        (out, top)
    }
}

fn text(x: f64, y: f64, anchor: &str, content: &str) -> String {
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>\n", escape(content))
}

fn letters(content: &str) -> f64 {
    content.chars().count() as f64
}

fn bar_height(m: &Measures) -> f64 {
    4.2 * m.font
}

/// A colour bar under its label, `left` from the panel's left, above axes as wide as `across`.
fn colour_bar(colours: &Colours, m: &Measures, left: f64, across: f64) -> String {
    let inset = 2.0 * m.font;
    let width = BAR.min(across - inset);
    let scale = Scale::new(&Axis::tight("", 0.0), colours.range, [0.0, width], m.apart[0]);
    let mut out = format!("<g transform=\"translate({:.1} 0)\">\n", left.max(inset));
    out.push_str(&text(0.0, 1.1 * m.font, "start", &colours.label));
    let (top, high) = (1.6 * m.font, 0.8 * m.font);
    let _ = writeln!(out, "<g transform=\"translate(0 {top:.1}) scale({width:.1} {high:.1})\">\n{}</g>", colours.bar());
    let mut marks = format!("M0 {top:.1}h{width:.1}v{high:.1}h-{width:.1}z");
    for (tick, label) in scale.ticks() {
        let at = scale.pixel(tick);
        let _ = write!(marks, "M{at:.1} {:.1}v4", top + high);
        out.push_str(&text(at, top + high + 1.25 * m.font, "middle", &label));
    }
    let _ = writeln!(out, "<path class=\"axis\" d=\"{marks}\"/>\n</g>");
    out
}

/// What a legend names: its sample as SVG in a box of [`SAMPLE`] × 12, and its name.
struct Entry<'a>(String, &'a str);

impl Panel<'_> {
    fn ranges(&self) -> [[f64; 2]; 2] {
        let join = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let all = |ranges: &mut dyn Iterator<Item = [[f64; 2]; 2]>| {
            ranges.reduce(|a, b| [join(a[0], b[0]), join(a[1], b[1])]).unwrap_or([[0.0, 0.0]; 2])
        };
        match &self.content {
            Content::Lines(series) => all(&mut series.iter().filter_map(Series::ranges)),
            Content::Map(map) => [map.x, map.y],
            Content::Drawing(drawing) => all(&mut drawing.areas.iter().map(|area| [area.x, area.y])),
        }
    }

    fn legend(&self) -> Vec<Entry<'_>> {
        let area = |class: &str| format!("<path class=\"area {class}\" d=\"M8 0H28V12H8z\"/>");
        match &self.content {
            Content::Lines(series) => series.iter().filter(|s| !s.name.is_empty()).map(|s| Entry(s.sample(), &s.name)).collect(),
            Content::Map(_) => Vec::new(),
            Content::Drawing(drawing) => {
                let first = |i: usize, name: &str| !drawing.areas[..i].iter().any(|a| a.name == name);
                let named = drawing.areas.iter().enumerate().filter(|(i, a)| !a.name.is_empty() && first(*i, &a.name));
                let areas = named.map(|(_, a)| a).map(|a| Entry(area(a.class), a.name.as_str()));
                let dot = "<circle class=\"point\" cx=\"18\" cy=\"6\" r=\"5\"/>";
                areas.chain(drawing.point.iter().map(|(_, name)| Entry(dot.into(), name))).collect()
            }
        }
    }

    /// Where each entry of the legend begins, in rows.
    fn legend_places(entries: &[Entry], m: &Measures, width: f64) -> Vec<(usize, f64)> {
        let (mut row, mut x) = (0, 0.0);
        let mut places = Vec::new();
        for Entry(_, name) in entries {
            let wide = SAMPLE + 0.5 * m.font + LETTER * m.font * letters(name);
            if x > 0.0 && x + wide > width {
                (row, x) = (row + 1, 0.0);
            }
            places.push((row, x));
            x += wide + 1.4 * m.font;
        }
        places
    }

    /// Width of the labels of y.
    fn left(&self, m: &Measures, width: f64) -> f64 {
        if self.y.names.is_some() {
            return 0.8 * m.font;
        }
        let guess = self.place(m, width, 4.0 * m.font);
        let y = Scale::new(&self.y, self.ranges()[1], [guess.plot[1], 0.0], m.apart[1]);
        let widest = y.ticks().iter().map(|(_, label)| label.chars().count()).max().unwrap_or(1);
        (widest as f64 * DIGIT + 1.0) * m.font
    }

    fn place(&self, m: &Measures, width: f64, left: f64) -> Place {
        let rows = Self::legend_places(&self.legend(), m, width).last().map_or(0, |(row, _)| row + 1);
        let bar = match &self.content {
            Content::Map(map) if map.bar => bar_height(m),
            _ => 0.0,
        };
        let heading = if self.heading.is_empty() { 0.0 } else { 1.8 * m.font };
        let [x, y] = self.ranges();
        let across = width - left - 1.6 * m.font;
        let plot = match self.height {
            Height::Lines(lines) => [across, lines * m.font],
            Height::ToScale(most) => {
                let high = across * (y[1] - y[0]) / (x[1] - x[0]);
                let most = most * m.font;
                // too high: narrower; too flat to be seen: stretched
                if high > most { [across * most / high, most] } else { [across, high.max(3.0 * m.font)] }
            }
        };
        let below = if self.x.label.is_empty() { 2.2 } else { 3.8 } * m.font;
        Place { left, plot, above: heading + 1.5 * m.font * rows as f64 + bar + 2.1 * m.font, below }
    }

    fn svg(&self, m: &Measures, width: f64, place: &Place, id: &str) -> String {
        let mut out = String::new();
        let mut at = 0.0;
        if !self.heading.is_empty() {
            let _ = writeln!(out, "<text class=\"heading\" x=\"4\" y=\"{:.1}\">{}</text>", 1.2 * m.font, escape(&self.heading));
            at += 1.8 * m.font;
        }
        let entries = self.legend();
        for (Entry(sample, name), (row, x)) in entries.iter().zip(Self::legend_places(&entries, m, width)) {
            let y = at + 1.5 * m.font * row as f64;
            let _ = writeln!(out, "<g transform=\"translate({x:.1} {:.1})\">{sample}</g>", y + 0.75 * m.font - 6.0);
            out.push_str(&text(x + SAMPLE + 0.5 * m.font, y + 1.1 * m.font, "start", name));
        }
        if let Content::Map(map) = &self.content
            && map.bar
        {
            let bar = colour_bar(&map.colours, m, place.left, place.plot[0]);
            let _ = writeln!(out, "<g transform=\"translate(0 {at:.1})\">\n{bar}</g>");
        }
        out.push_str(&text(0.2 * m.font, place.above - 0.9 * m.font, "start", &self.y.label));
        let _ =
            writeln!(out, "<g transform=\"translate({:.1} {:.1})\">\n{}</g>", place.left, place.above, self.plot(m, place, id));
        out
    }

    /// What lies between the axes, and the axes; the origin is the upper left corner. `id` names a map's cells.
    fn plot(&self, m: &Measures, place: &Place, id: &str) -> String {
        let ([x_range, y_range], [width, height]) = (self.ranges(), place.plot);
        let x = Scale::new(&self.x, x_range, [0.0, width], m.apart[0]);
        let y = Scale::new(&self.y, y_range, [height, 0.0], m.apart[1]);
        let mut out = String::new();
        let (mut grid, mut labels) = (String::new(), String::new());
        for (tick, label) in x.ticks() {
            let at = x.pixel(tick);
            let _ = write!(grid, "M{at:.1} 0V{height:.1}");
            labels.push_str(&text(at, height + 1.4 * m.font, "middle", &label));
        }
        for (k, name) in self.y.names.iter().flatten().enumerate() {
            let at = y.pixel(k as f64);
            let _ = write!(grid, "M0 {at:.1}H{width:.1}");
            labels.push_str(&text(0.4 * m.font, at - 0.8 * m.font, "start", name));
        }
        for (tick, label) in y.ticks().into_iter().filter(|_| self.y.names.is_none()) {
            let at = y.pixel(tick);
            let _ = write!(grid, "M0 {at:.1}H{width:.1}");
            labels.push_str(&text(-0.5 * m.font, at + 0.35 * m.font, "end", &label));
        }
        let mut frame = format!("M0 0V{height:.1}H{width:.1}");
        match &self.content {
            Content::Lines(series) => {
                let _ = writeln!(out, "<path class=\"grid\" d=\"{grid}\"/>");
                if y.holds(0.0) && self.y.names.is_none() {
                    let _ = write!(frame, "M0 {0:.1}H{width:.1}", y.pixel(0.0));
                }
                let _ = writeln!(out, "<path class=\"axis\" d=\"{frame}\"/>");
                for series in series {
                    out.push_str(&series.svg(|(a, b)| (x.pixel(a), y.pixel(b))));
                }
            }
            Content::Map(map) => {
                out.push_str(&map.cells(width, height, id, m.first));
                out.push_str(&map.dots(width, height));
                let _ = writeln!(out, "<path class=\"axis\" d=\"{frame}{}\"/>", outward_ticks(&x, &y, height));
            }
            Content::Drawing(drawing) => {
                out.push_str(&drawing.svg((&x, &y), m.font));
                let _ = writeln!(out, "<path class=\"axis\" d=\"{frame}{}\"/>", outward_ticks(&x, &y, height));
            }
        }
        out.push_str(&labels);
        if !self.x.label.is_empty() {
            // a long label may not reach beyond the axes
            let half = LETTER * m.font * letters(&self.x.label) / 2.0;
            let middle = (width / 2.0).max(half - place.left);
            out.push_str(&text(middle, height + 3.0 * m.font, "middle", &self.x.label));
        }
        out
    }
}

/// Ticks outside the axes, where a grid would hide what is shown.
fn outward_ticks(x: &Scale, y: &Scale, height: f64) -> String {
    let mut ticks = String::new();
    x.ticks().iter().for_each(|(tick, _)| {
        let _ = write!(ticks, "M{:.1} {height:.1}v4", x.pixel(*tick));
    });
    y.ticks().iter().for_each(|(tick, _)| {
        let _ = write!(ticks, "M0 {:.1}h-4", y.pixel(*tick));
    });
    ticks
}
