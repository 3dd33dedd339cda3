//! A figure: panels under one another or side by side.

use maud::{Markup, html};

use crate::attributes;
use crate::data::data;
use crate::panel::{Panel, Place};
use crate::size::{Measures, NARROW, WIDE};
use crate::style::document_style;
use crate::svg::{Frame, Svg};

/// A figure.
pub struct Figure<'a> {
    /// Unique on its page and among files; the names of its parts start with it.
    pub id: &'static str,
    /// The subject of the picture.
    pub title: String,
    /// Description of the picture, for those who do not see it.
    pub description: String,
    /// Explanations that a reader needs.
    pub caption: String,
    /// Panels side by side, where the paper is wide enough.
    pub columns: usize,
    /// Panels in reading order.
    pub panels: Vec<Panel<'a>>,
}

/// Height of the title above a document's panels \[px\].
const HEAD: f64 = 36.0;

impl Figure<'_> {
    /// The figure for a [`page`](crate::page), drawn for wide and for narrow paper, with its caption and, folded away, tables of its data.
    pub fn element(&self) -> Markup {
        html! {
            figure {
                h3 { (self.title) } "\n"
                (self.svg(&WIDE)) (self.svg(&NARROW))
                figcaption { (self.caption) }
            } "\n"
            (data(&self.title, &self.panels))
        }
    }

    /// One drawing of it; the narrow one comes after the wide one, whose maps it shows.
    fn svg(&self, m: &Measures) -> Svg {
        let ((body, height), id) = (self.body(m), format!("{}-{}", self.id, m.class));
        let mut svg = Svg::default();
        svg.open(
            "svg",
            attributes! {
                "class": "plot {}"(m.class), "viewBox": "0 0 {} {height:.0}"(m.width), "font-size": "{}"(m.font), "role": "img",
                "aria-labelledby": "{id}-title {id}-desc"
            },
        );
        svg.line();
        svg.element("title", attributes! { "id": "{id}-title" }, &self.title);
        svg.element("desc", attributes! { "id": "{id}-desc" }, &self.description);
        svg.append(&body).close("svg");
        svg
    }

    /// The figure as a document of its own, with its title.
    pub fn document(&self) -> String {
        let m = Measures { live: false, ..WIDE };
        let (body, height) = self.body(&m);
        let ids = ["title", "desc"].map(|part| format!("{}-{part}", self.id));
        let frame = Frame {
            ids: [&ids[0], &ids[1]],
            size: [m.width, height + HEAD],
            font: m.font,
            title: &self.title,
            description: &format!("{} {}", self.description, self.caption),
            attributes: attributes! { "class": "plot" },
            style: &document_style(),
        };
        frame.document(|svg| {
            svg.element("text", attributes! { "x": "4", "y": "22", "font-size": "18", "font-weight": "bold" }, &self.title);
            svg.group(attributes! { "transform": "translate(0 {HEAD})" }, |svg| _ = svg.append(&body));
        })
    }

    /// Everything but title and style, and its height.
    fn body(&self, m: &Measures) -> (Svg, f64) {
        let columns = self.columns.clamp(1, m.columns);
        let gap = 1.5 * m.font;
        let width = (m.width - gap * (columns - 1) as f64) / columns as f64;
        let (mut svg, mut top) = (Svg::default(), 0.0);
        // axes of panels under one another begin at one place
        let left = |column: usize| {
            let own = self.panels.iter().skip(column).step_by(columns).map(|panel| panel.left(m, width));
            own.fold(0.0, f64::max)
        };
        let lefts: Vec<f64> = (0..columns).map(left).collect();
        for (number, row) in self.panels.chunks(columns).enumerate() {
            let places: Vec<Place> = row.iter().zip(&lefts).map(|(panel, left)| panel.place(m, width, *left)).collect();
            for (column, (panel, place)) in row.iter().zip(&places).enumerate() {
                let id = format!("{}-map-{}", self.id, number * columns + column);
                // of panels under one another the last alone names their axis
                let below = self.panels.iter().skip(number * columns + column).step_by(columns);
                let along = below.map(|panel| panel.x.label.as_str()).find(|label| !label.is_empty()).unwrap_or_default();
                svg.moved([column as f64 * (width + gap), top], |svg| panel.draw(svg, m, width, place, [&id, along]));
            }
            top += places.iter().map(Place::height).fold(0.0, f64::max);
        }
        (svg, top)
    }
}
