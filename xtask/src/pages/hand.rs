//! Whether a page's figures answer to a hand.

use std::path::Path;

use proof::Failure;
use serde::Deserialize;

use crate::browser::Browser;

const TRY: &str = include_str!("hand.js");
/// Largest distance of what is read under the pointer from the figure's table, of the axis' range: lines are thinned to pixels.
const FARTHEST: f64 = 0.01;

/// What a hand saw.
#[derive(Deserialize)]
struct Seen {
    /// Rows of the table that were compared.
    #[serde(default)]
    rows: usize,
    #[serde(default)]
    farthest: f64,
    /// Whether the lines changed when a part was asked for, and how many ticks it has.
    #[serde(default)]
    closer: (bool, usize),
    /// A temperature in kelvin less the same in °C.
    #[serde(default)]
    kelvin: f64,
    /// Values that are read with one of two lines taken away, and how that line is shown.
    #[serde(default)]
    one: (usize, String),
    /// Whether the whole figure is as it was.
    #[serde(default)]
    whole: bool,
    fault: Option<String>,
}

/// What is wrong with the figures of the simulation's page.
pub(super) fn faults(browser: &mut Browser, page: &Path) -> Result<Vec<String>, Failure> {
    browser.open(&format!("file://{}", page.display()))?;
    let Seen { rows, farthest, closer, kelvin, one, whole, fault } = serde_json::from_value(browser.evaluate(TRY)?)?;
    let wanted = [
        (rows > 20, format!("{rows} rows of a figure's table are compared")),
        (farthest < FARTHEST, format!("values under the pointer are {farthest:.3} of the range from the table's")),
        (closer.0 && closer.1 > 4, format!("a part of a figure has {} ticks, or is drawn as the whole", closer.1)),
        ((kelvin - 273.15).abs() < 0.02, format!("a temperature in kelvin is {kelvin} more than in °C")),
        (one == (1, "none".into()), format!("with one of two lines taken away {} are read", one.0)),
        (whole, "the whole figure is not drawn as it was".into()),
    ];
    let wrong = wanted.into_iter().filter(|(right, _)| !right).map(|(_, words)| words);
    Ok(fault.into_iter().chain(wrong).map(|words| format!("a hand: {words}")).collect())
}
