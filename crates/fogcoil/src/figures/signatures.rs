//! What each mechanism of the library adds to the nominal response: the signatures among which a diagnosis chooses.

use super::Document;
use crate::Error;
use crate::cache::Cache;
use crate::comparison::{Entry, Responses};
use crate::input::CoilCase;
use crate::plot::{Axis, Content, Figure, Height, Panel, Series, Style, Thinning};
use crate::table::significant;

const HOUR: f64 = 3600.0;
/// Changes less than these are no changes: rounding \[deg/h\], \[K\].
const LEAST: [f64; 2] = [1e-4, 0.02];

/// Signatures of all mechanisms under one fast programme, a panel for rate and thermometer of each, as a file.
///
/// # Errors
/// [`Error::Coil`] if the design cannot be modelled.
pub fn signatures(case: &CoilCase, cache: &Cache) -> Result<Document, Error> {
    let responses = Responses::of(case, cache)?;
    let programme = &responses.programmes[1];
    let corners = &programme.corners;
    let chamber = |heading: String| {
        let line = Series {
            name: String::new(),
            style: Style::Total,
            count: corners.len(),
            at: Box::new(|n| (corners[n].0 / HOUR, corners[n].1)),
            thinning: Thinning::Distance,
        };
        panel(heading, "chamber [°C]", 4.5, 1.0, line)
    };
    let mut panels = vec![chamber(programme.name.clone()), chamber(" ".into())];
    for entry in &responses.entries {
        let values: Vec<String> =
            entry.parameters.iter().map(|p| format!("{} = {}", p.name, significant(p.typical, 2))).collect();
        // over both panels of the row
        let heading = format!("{}: {}", entry.id, values.join(", "));
        panels.push(panel(heading, "change of the rate [°/h]", 4.5, LEAST[0], course(entry, programme.duration(), 1)));
        panels.push(panel(
            " ".into(),
            "change of the spool's reading [K]",
            4.5,
            LEAST[1],
            course(entry, programme.duration(), 0),
        ));
    }
    if let [.., a, b] = &mut panels[..] {
        [a, b].into_iter().for_each(|last| last.x.label = "time [h]".into());
    }
    let figure = Figure {
        id: "signatures",
        title: "Signatures of the mechanisms".into(),
        description: format!(
            "Under {}: a row for each mechanism of the library, left what it adds to the gyro's rate, right what it adds to the spool \
             thermometer's reading, over time; the chamber's temperature above.",
            programme.name
        ),
        caption: format!("{}; each mechanism at a typical size, without noise. Each panel has its own scale.", case.name),
        columns: 2,
        panels,
    };
    Ok((figure.id, figure.document()))
}

/// Change of a channel by a mechanism under the second programme.
fn course(entry: &Entry, duration: f64, channel: usize) -> Series<'_> {
    let change = &entry.changes[1][channel];
    let interval = duration / (change.len().max(2) - 1) as f64;
    Series {
        name: String::new(),
        style: if channel == 1 { Style::First } else { Style::Second },
        count: change.len(),
        at: Box::new(move |n| (n as f64 * interval / HOUR, change[n])),
        thinning: Thinning::Columns,
    }
}

fn panel<'a>(heading: String, label: &str, lines: f64, least: f64, series: Series<'a>) -> Panel<'a> {
    Panel {
        heading,
        x: Axis::tight("", 1.0),
        y: Axis::round(label, least),
        height: Height::Lines(lines),
        content: Content::Lines(vec![series]),
    }
}
