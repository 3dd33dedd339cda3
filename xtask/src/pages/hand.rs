//! Trial of a page's figures by a hand.

use std::path::Path;

use proof::Failure;
use serde::Deserialize;

use crate::browser::Browser;

const TRY: &str = include_str!("hand.js");
/// Largest distance of a value under the pointer from the figure's table, of the axis' range: lines are thinned to pixels.
const FARTHEST: f64 = 0.01;

/// Sights of a hand.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Seen {
    /// Rows of the table that were compared.
    rows: usize,
    farthest: f64,
    /// Whether the lines changed when a part was asked for, and the number of its ticks.
    closer: (bool, usize),
    /// Ends of a stretch that was marked from 0.2 to 0.5 of the abscissa.
    stretch: [f64; 2],
    /// A temperature in kelvin less the same in °C.
    kelvin: f64,
    /// Values that are read with one of two lines taken away, and the display of that line.
    one: (usize, String),
    /// Whether the whole figure is as it was.
    whole: bool,
    /// Distance of a straight line's reading from the line, of its range.
    bent: f64,
    /// Largest distance of a mark from its line's point when a part is shown \[px\].
    off: f64,
    /// Whether differences in kelvin can be read in °C, as if they were temperatures.
    differences: bool,
    fault: Option<String>,
}

/// Faults of the figures of the simulation's page.
pub(super) fn faults(browser: &mut Browser, page: &Path) -> Result<Vec<String>, Failure> {
    browser.open(&format!("file://{}", page.display()))?;
    let seen: Seen = serde_json::from_value(browser.evaluate(TRY)?)?;
    let Seen { rows, farthest, closer, stretch, kelvin, one, whole, bent, off, differences, fault } = seen;
    let wanted = [
        (rows > 20, format!("{rows} rows of a figure's table are compared")),
        (farthest < FARTHEST, format!("values under the pointer are {farthest:.3} of the range from the table's")),
        (closer.0 && closer.1 > 4, format!("a part of a figure has {} ticks, or is drawn as the whole", closer.1)),
        (
            (stretch[0] - 0.2).abs() < 0.01 && (stretch[1] - 0.5).abs() < 0.01,
            format!("a stretch from 0.2 to 0.5 becomes {stretch:.3?}"),
        ),
        ((kelvin - 273.15).abs() < 0.02, format!("a temperature in kelvin is {kelvin} more than in °C")),
        (one == (1, "none".into()), format!("with one of two lines taken away {} are read", one.0)),
        (whole, "the whole figure is not drawn as it was".into()),
        (bent < 0.001, format!("a straight line is read {bent:.4} of its range beside it")),
        (off <= 0.2, format!("a mark lies {off:.1} px from its line")),
        (!differences, "a difference in kelvin can be read in °C".into()),
    ];
    let wrong = wanted.into_iter().filter(|(right, _)| !right).map(|(_, words)| words);
    Ok(fault.into_iter().chain(wrong).map(|words| format!("a hand: {words}")).collect())
}
