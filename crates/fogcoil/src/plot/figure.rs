//! A plot as an SVG element.

use std::fmt::Write;

use super::scale::Scale;
use super::{Axis, Series};
use crate::picture::escape;

/// A plot.
pub(crate) struct Figure<'a> {
    /// Unique on its page; the names of its parts start with it.
    pub(crate) id: &'a str,
    /// What it shows, for those who do not see it.
    pub(crate) title: &'a str,
    /// What there is to see in it.
    pub(crate) description: &'a str,
    /// To the right.
    pub(crate) x: Axis,
    /// Upwards.
    pub(crate) y: Axis,
    /// The lines, the first at the back.
    pub(crate) series: Vec<Series<'a>>,
}

/// For which paper a plot is drawn; both are drawn and the page shows one.
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
    height: f64,
    font: f64,
    /// Least distance of ticks along x and y.
    apart: [f64; 2],
}

impl Size {
    fn measures(self) -> Measures {
        match self {
            Self::Wide => Measures { class: "wide", width: 900.0, height: 380.0, font: 14.0, apart: [75.0, 50.0] },
            Self::Narrow => Measures { class: "narrow", width: 360.0, height: 290.0, font: 12.0, apart: [55.0, 30.0] },
        }
    }
}

/// Width of a character, in font sizes: digits of the usual fonts are narrower.
const CHARACTER: f64 = 0.62;

impl Figure<'_> {
    /// The plot as an `<svg>` element to stand in a page.
    pub(crate) fn svg(&self, size: Size) -> String {
        let m = size.measures();
        let [x_range, y_range] = self.ranges();
        let (top, bottom, right) = (2.0 * m.font, m.height - 3.4 * m.font, m.width - 1.6 * m.font);
        let y = Scale::new(&self.y, y_range, [bottom, top], m.apart[1]);
        let widest = y.ticks().iter().map(|(_, label)| label.chars().count()).max().unwrap_or(1);
        let left = (widest as f64 * CHARACTER + 1.0) * m.font;
        let x = Scale::new(&self.x, x_range, [left, right], m.apart[0]);
        let id = format!("{}-{}", self.id, m.class);
        let mut out = format!(
            "<svg class=\"plot {}\" viewBox=\"0 0 {} {}\" font-size=\"{}\" role=\"img\" aria-labelledby=\"{id}-title {id}-desc\">\n\
             <title id=\"{id}-title\">{}</title>\n<desc id=\"{id}-desc\">{}</desc>\n",
            m.class,
            m.width,
            m.height,
            m.font,
            escape(self.title),
            escape(self.description),
        );
        self.axes(&mut out, &m, (&x, &y), [left, right, top, bottom]);
        for series in &self.series {
            let path = path(&series.points(|(a, b)| (x.pixel(a), y.pixel(b))));
            let _ = writeln!(out, "<path class=\"{}\" d=\"{path}\"/>", series.style.class());
        }
        out.push_str("</svg>\n");
        out
    }

    /// The lines' names beside a piece of each.
    pub(crate) fn legend(&self) -> String {
        let mut out = String::from("<ul class=\"legend\">\n");
        for series in &self.series {
            let _ = writeln!(
                out,
                "<li><svg class=\"sample\" viewBox=\"0 0 44 12\" aria-hidden=\"true\"><path class=\"{}\" d=\"M2 6H42\"/></svg> {}</li>",
                series.style.class(),
                escape(series.name)
            );
        }
        out.push_str("</ul>\n");
        out
    }

    fn ranges(&self) -> [[f64; 2]; 2] {
        let all = self.series.iter().filter_map(Series::ranges);
        let join = |a: [f64; 2], b: [f64; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        all.reduce(|a, b| [join(a[0], b[0]), join(a[1], b[1])]).unwrap_or([[0.0, 0.0]; 2])
    }

    fn axes(&self, out: &mut String, m: &Measures, (x, y): (&Scale, &Scale), [left, right, top, bottom]: [f64; 4]) {
        let text = |x: f64, y: f64, anchor: &str, content: &str| {
            format!("<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>\n", escape(content))
        };
        let mut grid = String::new();
        for (tick, label) in x.ticks() {
            let at = x.pixel(tick);
            let _ = write!(grid, "M{at:.1} {top:.1}V{bottom:.1}");
            out.push_str(&text(at, bottom + 1.4 * m.font, "middle", &label));
        }
        for (tick, label) in y.ticks() {
            let at = y.pixel(tick);
            let _ = write!(grid, "M{left:.1} {at:.1}H{right:.1}");
            out.push_str(&text(left - 0.5 * m.font, at + 0.35 * m.font, "end", &label));
        }
        let _ = writeln!(out, "<path class=\"grid\" d=\"{grid}\"/>");
        let mut frame = format!("M{left:.1} {top:.1}V{bottom:.1}H{right:.1}");
        if y.holds(0.0) {
            let _ = write!(frame, "M{left:.1} {:.1}H{right:.1}", y.pixel(0.0));
        }
        let _ = writeln!(out, "<path class=\"axis\" d=\"{frame}\"/>");
        out.push_str(&text(0.2 * m.font, m.font, "start", &self.y.label));
        out.push_str(&text((left + right) / 2.0, m.height - 0.5 * m.font, "middle", &self.x.label));
    }
}

/// Path data to tenths of a pixel.
fn path(points: &[(f64, f64)]) -> String {
    let mut data = String::new();
    for (i, (x, y)) in points.iter().enumerate() {
        let _ = write!(data, "{}{x:.1} {y:.1}", if i == 0 { 'M' } else { 'L' });
    }
    if let [(x, y)] = points {
        let _ = write!(data, "L{x:.1} {y:.1}"); // a lone point is a dot: its line caps are round
    }
    data
}
