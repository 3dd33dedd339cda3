//! A panel of a figure: axes, and between them lines, a map or a drawing; above them its legend or colour bar.

use std::fmt::Write;

use crate::scale::{DIGIT, Scale};
use crate::series::path;
use crate::size::Measures;
use crate::svg::Svg;
use crate::{Axis, Colours, Drawing, Fill, HeatMap, Series, attributes};

/// A plot within a figure.
pub struct Panel<'a> {
    /// Heading above it; none if empty.
    pub heading: String,
    /// Axis to the right.
    pub x: Axis,
    /// Axis upwards.
    pub y: Axis,
    /// Height of the panel.
    pub height: Height,
    /// Its content.
    pub content: Content<'a>,
}

/// Height of a panel between its axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Height {
    /// Height in font sizes.
    Lines(f64),
    /// A unit of y is as long as a unit of x; at most this many font sizes high.
    ToScale(f64),
}

/// Content of a panel.
pub enum Content<'a> {
    /// Lines, the first at the back.
    Lines(Vec<Series<'a>>),
    /// A heat map.
    Map(HeatMap),
    /// A drawing.
    Drawing(Drawing),
}

/// Mean width of a letter in font sizes, a little more than the usual fonts have.
const LETTER: f64 = 0.56;
/// Length of a legend's sample \[px\].
const SAMPLE: f64 = 34.0;
/// Widest colour bar \[px\].
const BAR: f64 = 420.0;

/// Places of the parts of a panel \[px\].
pub(crate) struct Place {
    /// Distance from the panel's left to its axes.
    left: f64,
    /// Width and height between the axes.
    plot: [f64; 2],
    /// Height of heading and legend above the axes.
    above: f64,
    below: f64,
}

impl Place {
    pub(crate) fn height(&self) -> f64 {
        self.above + self.plot[1] + self.below
    }
}

fn width_of(content: &str, m: &Measures) -> f64 {
    LETTER * m.font * content.chars().count() as f64
}

/// Distance of a heading's lines in font sizes.
const HEADING_LINE: f64 = 1.3;

/// Width of a label of an axis.
fn wide(label: &str, m: &Measures) -> f64 {
    label.chars().count() as f64 * DIGIT * m.font
}

/// A colour bar under its label, `left` from the panel's left, above axes as wide as `across`.
fn colour_bar(svg: &mut Svg, colours: &Colours, m: &Measures, left: f64, across: f64) {
    let inset = 2.0 * m.font;
    let width = BAR.min(across - inset);
    svg.group(attributes! { "transform": "translate({:.1} 0)"(left.max(inset)) }, |svg| {
        colours.scale(svg, m.font, width);
    });
}

/// An entry of a legend: its sample in a box of [`SAMPLE`] × 12, and its name.
struct Entry<'a>(Svg, &'a str);

impl<'a> Panel<'a> {
    /// Lines, the first at the back, `high` font sizes high.
    pub fn lines(x: Axis, y: Axis, high: f64, series: Vec<Series<'a>>) -> Self {
        Self { heading: String::new(), x, y, height: Height::Lines(high), content: Content::Lines(series) }
    }

    /// A heat map.
    pub fn map(x: Axis, y: Axis, height: Height, map: HeatMap) -> Self {
        Self { heading: String::new(), x, y, height, content: Content::Map(map) }
    }

    /// A drawing to scale, at most `high` font sizes high.
    pub fn drawing(x: Axis, y: Axis, high: f64, drawing: Drawing) -> Self {
        Self { heading: String::new(), x, y, height: Height::ToScale(high), content: Content::Drawing(drawing) }
    }

    /// The panel with a heading.
    pub fn headed(self, heading: impl Into<String>) -> Self {
        Self { heading: heading.into(), ..self }
    }

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
        let drawn = |draw: &dyn Fn(&mut Svg)| {
            let mut svg = Svg::default();
            draw(&mut svg);
            svg
        };
        match &self.content {
            Content::Lines(series) => {
                let named = series.iter().filter(|s| !s.name.is_empty());
                named.map(|s| Entry(drawn(&|svg| s.sample(svg)), &s.name)).collect()
            }
            Content::Map(_) => Vec::new(),
            Content::Drawing(drawing) => {
                let first = |i: usize, name: &str| !drawing.areas[..i].iter().any(|a| a.name == name);
                let named = drawing.areas.iter().enumerate().filter(|(i, a)| !a.name.is_empty() && first(*i, &a.name));
                let area = |svg: &mut Svg, fill: Fill| {
                    svg.leaf("path", attributes! { "class": "{}"(fill.class()), "d": "M8 0H28V12H8z" }).joined();
                };
                let dot = |svg: &mut Svg| {
                    svg.leaf("circle", attributes! { "class": "point", "cx": "18", "cy": "6", "r": "5" }).joined();
                };
                let areas = named.map(|(_, a)| Entry(drawn(&|svg| area(svg, a.fill)), a.name.as_str()));
                areas.chain(drawing.point.iter().map(|(_, name)| Entry(drawn(&dot), name))).collect()
            }
        }
    }

    /// Beginning of each entry of the legend, in rows.
    fn legend_places(entries: &[Entry], m: &Measures, width: f64) -> Vec<(usize, f64)> {
        let (mut row, mut x) = (0, 0.0);
        let mut places = Vec::new();
        for Entry(_, name) in entries {
            let wide = SAMPLE + 0.5 * m.font + width_of(name, m);
            if x > 0.0 && x + wide > width {
                (row, x) = (row + 1, 0.0);
            }
            places.push((row, x));
            x += wide + 1.4 * m.font;
        }
        places
    }

    /// Width of the labels of y, or of what a label of x reaches beyond its axis if that is more.
    pub(crate) fn left(&self, m: &Measures, width: f64) -> f64 {
        if self.y.names.is_some() {
            return 0.8 * m.font;
        }
        let guess = self.place(m, width, 4.0 * m.font);
        let [x, y] = self.scales(m, &guess);
        let labels = y.ticks().iter().map(|(_, label)| wide(label, m)).fold(DIGIT * m.font, f64::max) + m.font;
        x.ticks().iter().map(|(tick, label)| wide(label, m) / 2.0 - x.pixel(*tick)).fold(labels, f64::max)
    }

    /// The heading in lines that are no wider than the panel, as far as its words are not.
    fn heading_lines(&self, m: &Measures, width: f64) -> Vec<String> {
        let mut lines: Vec<String> = Vec::new();
        for word in self.heading.split(' ').filter(|word| !word.is_empty()) {
            match lines.last_mut() {
                Some(line) if width_of(&format!("{line} {word}"), m) <= width => {
                    line.push(' ');
                    line.push_str(word);
                }
                _ => lines.push(word.to_owned()),
            }
        }
        lines
    }

    fn heading_height(&self, m: &Measures, width: f64) -> f64 {
        match self.heading_lines(m, width).len() {
            0 => 0.0,
            lines => (1.8 + HEADING_LINE * (lines - 1) as f64) * m.font,
        }
    }

    pub(crate) fn place(&self, m: &Measures, width: f64, left: f64) -> Place {
        let rows = Self::legend_places(&self.legend(), m, width).last().map_or(0, |(row, _)| row + 1);
        let bar = match &self.content {
            Content::Map(map) if map.bar => 4.2 * m.font,
            _ => 0.0,
        };
        let heading = self.heading_height(m, width);
        let [x, y] = self.ranges();
        let space = width - left;
        let along = Scale::new(&self.x, x, [0.0, space - 1.6 * m.font], m.apart[0]);
        let labels = along.ticks().into_iter().map(|(tick, label)| along.pixel(tick) + wide(&label, m) / 2.0);
        // a label at the end reaches beyond its axis
        let across = 2.0 * space - 1.6 * m.font - labels.fold(space, f64::max);
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

    /// The panel, as wide as `width`; `id` names a map's cells, `along` is the label of its abscissa, which a panel below may have.
    pub(crate) fn draw(&self, svg: &mut Svg, m: &Measures, width: f64, place: &Place, [id, along]: [&str; 2]) {
        for (row, line) in self.heading_lines(m, width).iter().enumerate() {
            let y = 1.2 * m.font + HEADING_LINE * m.font * row as f64;
            svg.element("text", attributes! { "class": "heading", "x": "4", "y": "{y:.1}" }, line);
        }
        let at = self.heading_height(m, width);
        let entries = self.legend();
        for (Entry(sample, name), (row, x)) in entries.iter().zip(Self::legend_places(&entries, m, width)) {
            let y = at + 1.5 * m.font * row as f64;
            svg.open("g", attributes! { "transform": "translate({x:.1} {:.1})"(y + 0.75 * m.font - 6.0) })
                .append(sample)
                .close("g");
            svg.text([x + SAMPLE + 0.5 * m.font, y + 1.1 * m.font], "start", name);
        }
        if let Content::Map(map) = &self.content
            && map.bar
        {
            svg.group(attributes! { "transform": "translate(0 {at:.1})" }, |svg| {
                colour_bar(svg, &map.colours, m, place.left, place.plot[0]);
            });
        }
        svg.text([0.2 * m.font, place.above - 0.9 * m.font], "start", &self.y.label);
        let [x, y] = self.scales(m, place);
        let [width, height] = place.plot;
        let plot = |svg: &mut Svg| self.plot(svg, [&x, &y], m, place, id);
        match &self.content {
            // a page's script reads them
            Content::Lines(_) if m.live && self.y.names.is_none() => svg.group(
                attributes! {
                    "transform": "translate({:.1} {:.1})"(place.left, place.above), "data-x": "{}"(x.ends()), "data-y": "{}"(y.ends()),
                    "data-plot": "{width:.1} {height:.1}", "data-along": "{along}"
                },
                plot,
            ),
            _ => svg.moved([place.left, place.above], plot),
        }
    }

    /// The axes over the pixels between them.
    fn scales(&self, m: &Measures, place: &Place) -> [Scale; 2] {
        let ([x, y], [width, height]) = (self.ranges(), place.plot);
        [Scale::new(&self.x, x, [0.0, width], m.apart[0]), Scale::new(&self.y, y, [height, 0.0], m.apart[1])]
    }

    /// The content between the axes, and the axes; the origin is the upper left corner.
    fn plot(&self, svg: &mut Svg, [x, y]: [&Scale; 2], m: &Measures, place: &Place, id: &str) {
        let [width, height] = place.plot;
        let (mut grid, mut labels) = (String::new(), Svg::default());
        for (tick, label) in x.ticks() {
            let at = x.pixel(tick);
            let _ = write!(grid, "M{at:.1} 0V{height:.1}");
            labels.text([at, height + 1.4 * m.font], "middle", &label);
        }
        for (k, name) in self.y.names.iter().flatten().enumerate() {
            let at = y.pixel(k as f64);
            let _ = write!(grid, "M0 {at:.1}H{width:.1}");
            labels.text([0.4 * m.font, at - 0.8 * m.font], "start", name);
        }
        for (tick, label) in y.ticks().into_iter().filter(|_| self.y.names.is_none()) {
            let at = y.pixel(tick);
            let _ = write!(grid, "M0 {at:.1}H{width:.1}");
            labels.text([-0.5 * m.font, at + 0.35 * m.font], "end", &label);
        }
        let frame = format!("M0 0V{height:.1}H{width:.1}");
        let axes = |svg: &mut Svg, more: &str| _ = svg.leaf("path", attributes! { "class": "axis", "d": "{frame}{more}" });
        match &self.content {
            Content::Lines(series) => {
                svg.leaf("path", attributes! { "class": "grid", "d": "{grid}" });
                let zero = y.holds(0.0) && self.y.names.is_none();
                axes(svg, &if zero { format!("M0 {:.1}H{width:.1}", y.pixel(0.0)) } else { String::new() });
                for (n, one) in series.iter().enumerate() {
                    let points = one.points(|(a, b)| (x.pixel(a), y.pixel(b)));
                    let draw = |svg: &mut Svg| one.draw(svg, &points);
                    let name = Series::called(series, n);
                    match (m.live, one.style.is_points()) {
                        (true, true) => {
                            svg.group(attributes! { "data-name": "{name}", "data-points": "{}"(path(&points, false)) }, draw);
                        }
                        (true, false) => svg.group(attributes! { "data-name": "{name}" }, draw),
                        (false, _) => draw(svg),
                    }
                }
            }
            Content::Map(map) => {
                map.cells(svg, place.plot, id, m.first);
                map.outlined(svg, [x, y]);
                map.dots(svg, place.plot);
                axes(svg, &outward_ticks(x, y, height));
            }
            Content::Drawing(drawing) => {
                drawing.draw(svg, (x, y), m.font);
                axes(svg, &outward_ticks(x, y, height));
            }
        }
        svg.append(&labels);
        if !self.x.label.is_empty() {
            // a long label may not reach beyond the axes
            let middle = (width / 2.0).max(width_of(&self.x.label, m) / 2.0 - place.left);
            svg.text([middle, height + 3.0 * m.font], "middle", &self.x.label);
        }
    }
}

/// Ticks outside the axes, where a grid would hide what is shown.
fn outward_ticks(x: &Scale, y: &Scale, height: f64) -> String {
    let along = x.ticks().into_iter().map(|(tick, _)| format!("M{:.1} {height:.1}v4", x.pixel(tick)));
    along.chain(y.ticks().into_iter().map(|(tick, _)| format!("M0 {:.1}h-4", y.pixel(tick)))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::size::{NARROW, WIDE};

    #[test]
    fn a_long_heading_has_lines_no_wider_than_its_panel_and_room_for_them() {
        let text = "recorded less extended model, a/unit/with/a/long/folder/run1.csv, and another word";
        let line = || vec![Series::new("", crate::Style::First, vec![(0.0, 0.0), (1.0, 1.0)])];
        let panel = || Panel::lines(Axis::tight("t", 1.0), Axis::round("y", 1.0), 9.0, line());
        for m in &[WIDE, NARROW] {
            let headed = panel().headed(text);
            let width = 22.0 * m.font;
            let lines = headed.heading_lines(m, width);
            assert_eq!(lines.join(" "), text);
            assert!(
                lines.len() > 1 && lines.iter().filter(|line| line.contains(' ')).all(|line| width_of(line, m) <= width),
                "{lines:?}"
            );
            let [one, all] = ["short", text].map(|text| panel().headed(text).place(m, width, 30.0).above);
            assert!((all - one - HEADING_LINE * m.font * (lines.len() - 1) as f64).abs() < 1e-9);
        }
    }
}
