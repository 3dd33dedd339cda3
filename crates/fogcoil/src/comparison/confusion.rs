//! Mistaken mechanisms: expected ln odds of each pair as a chequered table.

use charts::{Frame, Svg, attributes};

use super::Comparison;

/// Measures [px]: side of a cell, room for the names, room above for the slanted names, gap between two tables.
const CELL: f64 = 30.0;
const NAMES: f64 = 205.0;
const ABOVE: f64 = 190.0;
const GAP: f64 = 46.0;

/// Bounds of the classes of ln odds, and the colours between them, from "alike" to "told apart"; white digits on the dark ones.
const CLASSES: [(f64, &str, &str, &str); 4] = [
    (1.0, "#b2182b", "#ffffff", "below 1: alike"),
    (3.5, "#f4a582", "#1a1d21", "1 to 3.5: a hint"),
    (10.0, "#cfe4f2", "#1a1d21", "3.5 to 10: told apart"),
    (f64::INFINITY, "#2166ac", "#ffffff", "above 10: without doubt"),
];

fn number(log_odds: f64) -> String {
    match log_odds {
        x if x >= 99.5 => ">99".into(),
        x if x.abs() >= 9.95 => format!("{x:.0}"),
        x => format!("{:.1}", (x * 10.0).round() / 10.0 + 0.0),
    }
}

impl Comparison {
    /// Expected ln odds of every truth over every rival under each of some programmes, by their numbers: an SVG document.
    pub fn confusion(&self, which: &[usize]) -> String {
        let (rows, columns) = (self.entries.len() as f64, self.rivals.len() as f64);
        let table = ABOVE + rows * CELL + GAP;
        let (width, height) = (NAMES + columns * CELL + 110.0, 70.0 + which.len() as f64 * table + 40.0);
        let frame = Frame {
            ids: ["t", "d"],
            size: [width, height],
            font: 12.0,
            title: "Which mechanisms are mistaken for which",
            description: "Expected ln of the odds for the mechanism of the row over that of the column, fitted in its place; typical size, \
                          24 h.",
            attributes: attributes! { "fill": "#1a1d21" },
            style: "",
        };
        frame.document(|svg| {
            svg.element("text", attributes! { "x": "8", "y": "24", "font-size": "18", "font-weight": "bold" }, frame.title);
            let said =
                "Expected ln odds for the truth (row) over what is fitted in its place (column); typical sizes, typical noise.";
            svg.element("text", attributes! { "x": "8", "y": "46" }, said);
            for (n, k) in which.iter().enumerate() {
                let top = 70.0 + n as f64 * table;
                svg.group(attributes! { "transform": "translate(0 {top})" }, |svg| self.chequered(svg, *k));
            }
            for (n, (_, fill, _, name)) in CLASSES.into_iter().enumerate() {
                let (x, y) = (8.0 + 160.0 * n as f64, height - 30.0);
                svg.leaf("rect", attributes! { "x": "{x}", "y": "{y}", "width": "16", "height": "16", "fill": "{fill}" })
                    .joined();
                svg.element("text", attributes! { "x": "{}"(x + 22.0), "y": "{}"(y + 12.0) }, name);
            }
        })
    }

    fn chequered(&self, svg: &mut Svg, k: usize) {
        svg.element("text", attributes! { "x": "8", "y": "14", "font-weight": "bold" }, &self.programmes[k].name);
        for (j, rival) in self.rivals.iter().enumerate() {
            let (x, y) = (NAMES + (j as f64 + 0.6) * CELL, ABOVE - 6.0);
            svg.element("text", attributes! { "x": "{x}", "y": "{y}", "transform": "rotate(-60 {x} {y})" }, rival);
        }
        for (i, entry) in self.entries.iter().enumerate() {
            let y = ABOVE + i as f64 * CELL;
            let below = y + 19.0;
            svg.element("text", attributes! { "x": "{}"(NAMES - 8.0), "y": "{below}", "text-anchor": "end" }, &entry.id);
            for (j, told) in self.told[k][i].iter().enumerate() {
                let Some(told) = told else { continue };
                let (x, side) = (NAMES + j as f64 * CELL, CELL - 1.0);
                let (_, fill, ink, _) = CLASSES.iter().find(|c| told.log_odds < c.0).unwrap_or(&CLASSES[CLASSES.len() - 1]);
                svg.leaf("rect", attributes! { "x": "{x}", "y": "{y}", "width": "{side}", "height": "{side}", "fill": "{fill}" });
                let middle = x + CELL / 2.0 - 0.5;
                svg.joined().element(
                    "text",
                    attributes! { "x": "{middle}", "y": "{below}", "text-anchor": "middle", "font-size": "11", "fill": "{ink}" },
                    &number(told.log_odds),
                );
            }
        }
    }
}
