//! What a mechanism changes, drawn.

use super::{Comparison, Entry};
use crate::plot::{Axis, Content, Figure, Height, Panel, Series, Style, Thinning};
use crate::table::significant;

const HOUR: f64 = 3600.0;
/// Changes less than these are no changes: rounding \[deg/h\], \[K\].
const LEAST: [f64; 2] = [1e-4, 0.02];

impl Comparison {
    /// Change of rate and of spool temperature by a mechanism of typical size, under the slow ramp and the fast one: an SVG document.
    pub fn signature(&self, entry: &Entry) -> String {
        let both = [0, 1].map(|k: usize| &self.programmes[k]);
        let mut panels = Vec::new();
        for programme in both {
            let corners = &programme.corners;
            let line = Series {
                name: String::new(),
                style: Style::Total,
                count: corners.len(),
                at: Box::new(|n| (corners[n].0 / HOUR, corners[n].1)),
                thinning: Thinning::Distance,
            };
            panels.push(panel(programme.name.clone(), "chamber [°C]", 5.0, 1.0, line));
        }
        let (interval, rows) =
            (self.programmes[0].duration() / (entry.changes[0][0].len() - 1) as f64, entry.changes[0][0].len());
        for (channel, label, least, style) in [
            (1, "change of the rate [°/h]", LEAST[0], Style::First),
            (0, "change of the spool's reading [K]", LEAST[1], Style::Second),
        ] {
            for changes in &entry.changes[..2] {
                let change = &changes[channel];
                let line = Series {
                    name: String::new(),
                    style,
                    count: rows,
                    at: Box::new(move |n| (n as f64 * interval / HOUR, change[n])),
                    thinning: Thinning::Columns,
                };
                panels.push(panel(String::new(), label, 8.0, least, line));
            }
        }
        let values: Vec<String> =
            entry.parameters.iter().map(|p| format!("{} = {}", p.name, significant(p.typical, 3))).collect();
        let figure = Figure {
            id: "signature",
            title: format!("{}: {}", entry.id, values.join(", ")),
            description:
                "Left under a slow ramp, right under a fast one; from top to bottom the chamber, the change of the gyro's \
                          rate, the change of the spool thermometer's reading."
                    .into(),
            caption: format!("{}; what the mechanism adds to the nominal response, without noise.", self.design),
            columns: 2,
            panels,
        };
        figure.document()
    }
}

fn panel<'a>(heading: String, label: &str, lines: f64, least: f64, series: Series<'a>) -> Panel<'a> {
    Panel {
        heading,
        x: Axis::tight("time [h]", 1.0),
        y: Axis::round(label, least),
        height: Height::Lines(lines),
        content: Content::Lines(vec![series]),
    }
}
