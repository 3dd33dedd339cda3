//! Drawings to scale: areas, mesh, dimensions.

use crate::attributes;
use crate::scale::Scale;
use crate::svg::Svg;

/// Style of an area.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fill {
    /// Pale blue.
    Cool,
    /// Pale brown.
    Sand,
    /// Brown.
    Clay,
    /// The paper's colour, without an outline.
    Blank,
    /// A heavy outline alone.
    Heavy,
    /// A dashed outline alone.
    Dashed,
}

impl Fill {
    pub(crate) fn class(self) -> &'static str {
        match self {
            Self::Cool => "area cool",
            Self::Sand => "area sand",
            Self::Clay => "area clay",
            Self::Blank => "area blank",
            Self::Heavy => "area heavy",
            Self::Dashed => "area dashed",
        }
    }
}

/// A rectangle.
#[derive(Debug, Clone, PartialEq)]
pub struct Area {
    /// Style of the area.
    pub fill: Fill,
    /// Its name in the legend; none if empty.
    pub name: String,
    /// Ends along x.
    pub x: [f64; 2],
    /// Ends along y.
    pub y: [f64; 2],
}

/// A dimension: an arrow with two heads, along x or along y, and its length in words.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrow {
    /// One end (x, y).
    pub from: [f64; 2],
    /// The other.
    pub to: [f64; 2],
    /// The quantity that it measures.
    pub label: String,
}

/// Content of a drawing, from the back to the front.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Drawing {
    /// Filled areas; the first spans the drawing.
    pub areas: Vec<Area>,
    /// Outlines of mesh elements: ends along x, ends along y.
    pub mesh: Vec<[[f64; 2]; 2]>,
    /// A place with its name in the legend.
    pub point: Option<([f64; 2], String)>,
    /// Dimensions.
    pub arrows: Vec<Arrow>,
}

/// Length of an arrow's head \[px\].
const HEAD: f64 = 7.0;

impl Drawing {
    pub(crate) fn draw(&self, svg: &mut Svg, (x, y): (&Scale, &Scale), font: f64) {
        let path = |x_ends: [f64; 2], y_ends: [f64; 2]| {
            let ([x0, x1], [y0, y1]) = (x_ends.map(|v| x.pixel(v)), y_ends.map(|v| y.pixel(v)));
            format!("M{x0:.1} {y0:.1}H{x1:.1}V{y1:.1}H{x0:.1}z")
        };
        for Area { fill, x, y, .. } in &self.areas {
            svg.leaf("path", attributes! { "class": "{}"(fill.class()), "d": "{}"(path(*x, *y)) });
        }
        if !self.mesh.is_empty() {
            let all: String = self.mesh.iter().map(|[x, y]| path(*x, *y)).collect();
            svg.leaf("path", attributes! { "class": "mesh", "d": "{all}" });
        }
        if let Some(([px, py], _)) = self.point {
            svg.leaf(
                "circle",
                attributes! { "class": "point", "cx": "{:.1}"(x.pixel(px)), "cy": "{:.1}"(y.pixel(py)), "r": "5" },
            );
        }
        for Arrow { from, to, label } in &self.arrows {
            let ends = [from, to].map(|[a, b]| [x.pixel(*a), y.pixel(*b)]);
            arrow(svg, ends, label, font);
        }
    }
}

/// Between two places \[px\]; none where they are one.
fn arrow(svg: &mut Svg, [[x0, y0], [x1, y1]]: [[f64; 2]; 2], label: &str, font: f64) {
    let length = (x1 - x0).hypot(y1 - y0);
    if length.is_nan() || length <= 0.0 {
        return;
    }
    let ([u, v], head) = ([(x1 - x0) / length, (y1 - y0) / length], HEAD.min(length / 2.0));
    let tip = |x: f64, y: f64, u: f64, v: f64| {
        let (bx, by, w) = (x - head * u, y - head * v, head * 0.4);
        format!("M{:.1} {:.1}L{x:.1} {y:.1}L{:.1} {:.1}", bx - w * v, by + w * u, bx + w * v, by - w * u)
    };
    let (there, back) = (tip(x1, y1, u, v), tip(x0, y0, -u, -v));
    svg.leaf("path", attributes! { "class": "arrow", "d": "M{x0:.1} {y0:.1}L{x1:.1} {y1:.1}{there}{back}" });
    let (middle, level) = ((x0 + x1) / 2.0, (y0 + y1) / 2.0);
    let (at, below, anchor) = if u.abs() > v.abs() {
        (middle, level - 0.5 * font, "middle")
    } else {
        (middle + 0.5 * font, level + 0.35 * font, "start")
    };
    svg.element("text", attributes! { "class": "halo", "x": "{at:.1}", "y": "{below:.1}", "text-anchor": "{anchor}" }, label);
}
