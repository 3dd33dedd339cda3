//! Who is mistaken for whom: expected ln odds as a chequered table.

use std::fmt::Write;

use super::Comparison;
use crate::picture::escape;

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

fn class(log_odds: f64) -> (&'static str, &'static str) {
    let (_, fill, ink, _) = CLASSES.iter().find(|c| log_odds < c.0).unwrap_or(&CLASSES[CLASSES.len() - 1]);
    (fill, ink)
}

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
        let mut out = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"sans-serif\" font-size=\"12\" fill=\"#1a1d21\" role=\"img\" aria-labelledby=\"t d\">\n\
             <title id=\"t\">Which mechanisms are mistaken for which</title>\n\
             <desc id=\"d\">Expected ln of the odds for the mechanism of the row over that of the column, fitted in its place; typical size, 24 h.</desc>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n\
             <text x=\"8\" y=\"24\" font-size=\"18\" font-weight=\"bold\">Which mechanisms are mistaken for which</text>\n\
             <text x=\"8\" y=\"46\">Expected ln odds for the truth (row) over what is fitted in its place (column); typical sizes, typical noise.</text>\n"
        );
        for (n, k) in which.iter().enumerate() {
            let top = 70.0 + n as f64 * table;
            let _ = writeln!(out, "<g transform=\"translate(0 {top})\">\n{}</g>", self.chequered(*k));
        }
        let mut x = 8.0;
        for (_, fill, _, name) in CLASSES {
            let y = height - 30.0;
            let _ = writeln!(
                out,
                "<rect x=\"{x}\" y=\"{y}\" width=\"16\" height=\"16\" fill=\"{fill}\"/><text x=\"{}\" y=\"{}\">{}</text>",
                x + 22.0,
                y + 12.0,
                escape(name)
            );
            x += 160.0;
        }
        out + "</svg>\n"
    }

    fn chequered(&self, k: usize) -> String {
        let mut out = format!("<text x=\"8\" y=\"14\" font-weight=\"bold\">{}</text>\n", escape(&self.programmes[k].name));
        for (j, rival) in self.rivals.iter().enumerate() {
            let (x, y) = (NAMES + (j as f64 + 0.6) * CELL, ABOVE - 6.0);
            let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" transform=\"rotate(-60 {x} {y})\">{}</text>", escape(rival));
        }
        for (i, entry) in self.entries.iter().enumerate() {
            let y = ABOVE + i as f64 * CELL;
            let _ =
                writeln!(out, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>", NAMES - 8.0, y + 19.0, escape(&entry.id));
            for (j, told) in self.told[k][i].iter().enumerate() {
                let x = NAMES + j as f64 * CELL;
                let Some(told) = told else { continue };
                let (fill, ink) = class(told.log_odds);
                let _ = writeln!(
                    out,
                    "<rect x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" fill=\"{fill}\"/>\
                     <text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-size=\"11\" fill=\"{ink}\">{}</text>",
                    CELL - 1.0,
                    CELL - 1.0,
                    x + CELL / 2.0 - 0.5,
                    y + 19.0,
                    escape(&number(told.log_odds))
                );
            }
        }
        out
    }
}
