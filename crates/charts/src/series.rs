//! A line of a plot, thinned to what the paper can show.

use std::fmt::Write;

use crate::attributes;
use crate::svg::Svg;

/// Most points of a drawn line.
pub const MOST_POINTS: usize = 2000;

/// A line through points that are computed when they are needed.
pub struct Series<'a> {
    /// Its name in the legend, with what it stands for; none if empty.
    pub name: String,
    /// Style of the line.
    pub style: Style,
    /// Number of its points.
    pub count: usize,
    /// The point of a number below `count`; where it is no number, or beyond 1e300, the line has a gap.
    pub at: Box<dyn Fn(usize) -> (f64, f64) + 'a>,
    /// Thinning of the line.
    pub thinning: Thinning,
}

/// Style of a line; each differs from the others in colour and in dash.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Black or white, heavy.
    Total,
    /// Blue.
    First,
    /// Vermilion, dashed.
    Second,
    /// Green, dotted.
    Third,
    /// Thin, for a line that goes up and down many times: vermilion, black, blue or green.
    Fine(u8),
    /// Thin and violet: readings, below what is computed.
    Record,
    /// Points joined by a line: blue rings, vermilion squares, green triangles, black diamonds.
    Marked(u8),
    /// Marks alone, each of its own shape and colour: blue ring, vermilion square, green triangle, black diamond, blue cross.
    Points(u8),
    /// Thin, grey and dashed: a line to compare others with, which is left out of the tables.
    Guide,
}

impl Style {
    pub(crate) fn class(self) -> &'static str {
        match self {
            Self::Total => "line total",
            Self::First | Self::Marked(0) => "line first",
            Self::Second | Self::Marked(1) => "line second",
            Self::Points(kind) => MARKS[kind as usize % MARKS.len()],
            Self::Third | Self::Marked(2) => "line third",
            Self::Marked(_) => "line total",
            Self::Record => "line fine record",
            Self::Fine(0) => "line fine second",
            Self::Fine(1) => "line fine total",
            Self::Fine(2) => "line fine first",
            Self::Fine(_) => "line fine third",
            Self::Guide => "line guide",
        }
    }

    /// Whether nothing joins the points.
    pub(crate) fn is_points(self) -> bool {
        matches!(self, Self::Points(_))
    }
}

const MARKS: [&str; 5] = ["mark first", "mark second", "mark third", "mark total", "mark first"];

/// Thinning of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Thinning {
    /// The line runs from left to right: its lowest and highest point in every column of pixels.
    Columns,
    /// The line runs anywhere: the points that are a pixel from the one before, evenly thinned if they are still too many.
    Distance,
}

impl<'a> Series<'a> {
    /// A line through points, from left to right.
    pub fn new(name: impl Into<String>, style: Style, points: Vec<(f64, f64)>) -> Self {
        Self::computed(name, style, points.len(), move |n| points[n])
    }

    /// A line through `count` points, from left to right.
    pub fn computed(name: impl Into<String>, style: Style, count: usize, at: impl Fn(usize) -> (f64, f64) + 'a) -> Self {
        Self { name: name.into(), style, count, at: Box::new(at), thinning: Thinning::Columns }
    }

    /// The line, if it runs anywhere.
    pub fn anywhere(self) -> Self {
        Self { thinning: Thinning::Distance, ..self }
    }

    /// The line through [`Series::points`], and a mark at each where the style has marks.
    pub(crate) fn draw(&self, svg: &mut Svg, points: &[(f64, f64)]) {
        if !self.style.is_points() {
            // a mark shows a point without a neighbour
            let dots = !matches!(self.style, Style::Marked(_));
            svg.leaf("path", attributes! { "class": "{}"(self.style.class()), "d": "{}"(path(points, dots)) });
        }
        points.iter().filter(|point| !is_gap(point)).for_each(|point| self.mark(svg, *point));
    }

    /// The name of one of several: what has none is another part of the one before it that looks like it.
    pub(crate) fn called<'s>(all: &'s [Series], n: usize) -> &'s str {
        let alike = all[..=n].iter().rev().filter(|other| other.style == all[n].style);
        alike.map(|other| other.name.as_str()).find(|name| !name.is_empty()).unwrap_or_default()
    }

    /// A piece of it for a legend, 34 × 12 px.
    pub(crate) fn sample(&self, svg: &mut Svg) {
        if !self.style.is_points() {
            svg.leaf("path", attributes! { "class": "{}"(self.style.class()), "d": "M2 6H32" }).joined();
        }
        self.mark(svg, (17.0, 6.0));
    }

    fn mark(&self, svg: &mut Svg, (x, y): (f64, f64)) {
        let (Style::Points(kind) | Style::Marked(kind)) = self.style else { return };
        let class = MARKS[kind as usize % MARKS.len()];
        let shape = match kind {
            0 => {
                svg.leaf("circle", attributes! { "class": "{class}", "cx": "{x:.1}", "cy": "{y:.1}", "r": "4" });
                return;
            }
            1 => format!("M{:.1} {:.1}h8v8h-8z", x - 4.0, y - 4.0),
            2 => format!("M{x:.1} {:.1}l5 9h-10z", y - 5.5),
            3 => format!("M{x:.1} {:.1}l5.5 5.5l-5.5 5.5l-5.5 -5.5z", y - 5.5),
            _ => format!("M{:.1} {:.1}l9 9m0 -9l-9 9", x - 4.5, y - 4.5),
        };
        svg.leaf("path", attributes! { "class": "{class}", "d": "{shape}" });
    }

    /// Its points, none where it has a gap.
    fn all(&self) -> impl Iterator<Item = Option<(f64, f64)>> + '_ {
        let is_drawn = |(x, y): &(f64, f64)| x.abs() < FARTHEST && y.abs() < FARTHEST;
        (0..self.count).map(move |n| Some((self.at)(n)).filter(is_drawn))
    }

    /// Lowest and highest x, lowest and highest y; `None` without points.
    pub fn ranges(&self) -> Option<[[f64; 2]; 2]> {
        self.all().flatten().fold(None, |ranges, (x, y)| {
            let [[x0, x1], [y0, y1]] = ranges.unwrap_or([[x, x], [y, y]]);
            Some([[x0.min(x), x1.max(x)], [y0.min(y), y1.max(y)]])
        })
    }

    /// The points to draw, in pixels, with a [`GAP`] where the line is not joined.
    pub(crate) fn points(&self, pixel: impl Fn((f64, f64)) -> (f64, f64)) -> Vec<(f64, f64)> {
        let all = || self.all().map(|point| point.map(&pixel));
        match self.thinning {
            _ if self.count <= MOST_POINTS / 2 => strides(all(), 0.0),
            Thinning::Columns => extremes(all()),
            Thinning::Distance => {
                let points = strides(all(), 1.0);
                let every = points.len().div_ceil(MOST_POINTS - 1).max(1);
                let last = points.len().saturating_sub(1);
                let is_kept = |(n, point): &(usize, (f64, f64))| n.is_multiple_of(every) || *n == last || is_gap(point);
                points.into_iter().enumerate().filter(is_kept).map(|(_, point)| point).collect()
            }
        }
    }
}

/// Largest magnitude of a number that is drawn: differences of such are numbers, too.
const FARTHEST: f64 = 1e300;

/// A place at which a line is not joined.
const GAP: (f64, f64) = (f64::NAN, f64::NAN);

fn is_gap(point: &(f64, f64)) -> bool {
    point.0.is_nan()
}

/// Path data to tenths of a pixel; a point without a neighbour is a dot where that is asked for, as line caps are round.
pub(crate) fn path(points: &[(f64, f64)], dots: bool) -> String {
    let mut data = String::new();
    for joined in points.split(is_gap) {
        for (i, (x, y)) in joined.iter().enumerate() {
            let _ = write!(data, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
        }
        if let ([(x, y)], true) = (joined, dots) {
            let _ = write!(data, "L{x:.1} {y:.1}");
        }
    }
    data
}

type Numbered = (usize, (f64, f64));

/// Lowest and highest point of every column of pixels in the order they come, and the two ends; of gaps those that are wider than a column.
fn extremes(points: impl Iterator<Item = Option<(f64, f64)>>) -> Vec<(f64, f64)> {
    let mut kept: Vec<(f64, f64)> = Vec::new();
    let keep = |kept: &mut Vec<(f64, f64)>, [low, high]: [Numbered; 2]| {
        let (first, second) = if low.0 <= high.0 { (low, high) } else { (high, low) };
        kept.push(first.1);
        if second.0 != first.0 {
            kept.push(second.1);
        }
    };
    let mut column: Option<[Numbered; 2]> = None;
    let (mut last, mut gap) = (None, false);
    for (n, point) in points.enumerate() {
        let Some(point) = point else {
            gap = true;
            continue;
        };
        if last.is_none() {
            kept.push(point);
        }
        column = Some(match column {
            Some([low, high]) if low.1.0.floor() == point.0.floor() => {
                [if point.1 < low.1.1 { (n, point) } else { low }, if point.1 > high.1.1 { (n, point) } else { high }]
            }
            full => {
                full.into_iter().for_each(|ends| keep(&mut kept, ends));
                let is_wide = |before: &(f64, f64)| gap && (point.0 - before.0).abs() >= 1.0;
                kept.extend(last.filter(is_wide).map(|_| GAP));
                [(n, point); 2]
            }
        });
        (last, gap) = (Some(point), false);
    }
    column.into_iter().for_each(|ends| keep(&mut kept, ends));
    kept.extend(last);
    kept
}

/// Points at least `reach` pixels from the one kept before, and the last; of gaps those that are as wide.
fn strides(points: impl Iterator<Item = Option<(f64, f64)>>, reach: f64) -> Vec<(f64, f64)> {
    let far = |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).hypot(a.1 - b.1) >= reach;
    let mut kept: Vec<(f64, f64)> = Vec::new();
    // the point before, and whether it was kept
    let (mut last, mut gap) = (None::<((f64, f64), bool)>, false);
    for point in points {
        let Some(point) = point else {
            gap = true;
            continue;
        };
        let behind_gap = last.filter(|(before, _)| gap && far(*before, point));
        if let Some((before, is_kept)) = behind_gap {
            kept.extend((!is_kept).then_some(before).into_iter().chain([GAP]));
        }
        let is_kept = behind_gap.is_some() || kept.last().is_none_or(|before| far(*before, point));
        kept.extend(is_kept.then_some(point));
        (last, gap) = (Some((point, is_kept)), false);
    }
    kept.extend(last.filter(|(_, is_kept)| !is_kept).map(|(point, _)| point));
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series<'a>(count: usize, at: &'a dyn Fn(usize) -> (f64, f64), thinning: Thinning) -> Series<'a> {
        Series { thinning, ..Series::computed("", Style::Total, count, at) }
    }

    #[test]
    fn a_single_spike_among_a_million_points_survives() {
        let at = |n: usize| (n as f64 / 1e6 * 800.0, if n == 654_321 { 99.0 } else { (n % 7) as f64 });
        let points = series(1_000_000, &at, Thinning::Columns).points(|p| p);
        assert!(points.len() <= MOST_POINTS, "{}", points.len());
        assert!(points.iter().any(|p| p.1 == 99.0) && points.windows(2).all(|w| w[0].0 <= w[1].0));
        assert_eq!((points[0], points[points.len() - 1]), (at(0), at(999_999)));
    }

    #[test]
    fn a_loop_keeps_its_shape() {
        let angle = |n: usize| n as f64 / 1e5 * std::f64::consts::TAU;
        let at = |n: usize| (angle(n).cos() * 300.0, angle(n).sin() * 300.0);
        let chaos = |n: usize| ((n as f64).cos() * 300.0, (n as f64).sin() * 300.0);
        for at in [&at as &dyn Fn(usize) -> (f64, f64), &chaos] {
            let points = series(100_000, at, Thinning::Distance).points(|p| p);
            assert!((1000..=MOST_POINTS).contains(&points.len()), "{}", points.len());
            assert_eq!(points[points.len() - 1], at(99_999));
        }
    }

    #[test]
    fn few_points_are_all_drawn() {
        let at = |n: usize| (n as f64, 0.0);
        assert_eq!(series(1, &at, Thinning::Columns).points(|p| p), [(0.0, 0.0)]);
        assert_eq!(series(0, &at, Thinning::Columns).points(|p| p), []);
        assert_eq!(series(500, &at, Thinning::Distance).points(|p| p).len(), 500);
        assert_eq!(series(0, &at, Thinning::Columns).ranges(), None);
    }

    /// What is no number is a gap, and nothing else of the line is lost.
    #[test]
    fn exact_a_line_has_a_gap_where_it_has_no_number() {
        let of = |values: &[f64]| {
            let at = |n: usize| (n as f64, values[n]);
            let one = series(values.len(), &at, Thinning::Columns);
            (path(&one.points(|p| p), true), one.ranges())
        };
        let (nan, up) = (f64::NAN, f64::INFINITY);
        assert_eq!(of(&[1.0, nan, 3.0, 2.0]), ("M0.0 1.0L0.0 1.0M2.0 3.0L3.0 2.0".into(), Some([[0.0, 3.0], [1.0, 3.0]])));
        assert_eq!(of(&[nan, 1.0, 2.0, up]).0, "M1.0 1.0L2.0 2.0");
        assert_eq!(of(&[1e308, -1e308, nan]), (String::new(), None));
        // a long one: gaps that can be seen stay, of those within a pixel none
        for thinning in [Thinning::Columns, Thinning::Distance] {
            let at =
                |n: usize| (n as f64 / 100.0, if (20_000..40_000).contains(&n) || n.is_multiple_of(7) { f64::NAN } else { 50.0 });
            let points = series(100_000, &at, thinning).points(|p| p);
            assert_eq!(points.iter().filter(|p| is_gap(p)).count(), 1);
            let at = points.iter().position(is_gap).unwrap();
            assert!((points[at - 1].0 - 199.99).abs() < 1.1 && (points[at + 1].0 - 400.01).abs() < 0.02, "{points:?}");
            assert!((points[points.len() - 1].0 - 999.99).abs() < 1e-9);
        }
        assert_eq!(path(&[(1.0, 2.0)], false), "M1.0 2.0");
    }
}
