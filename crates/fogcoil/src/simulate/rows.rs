//! Rows of the result and windows of them.

use bias::units::{DEG_PER_H_PER_RAD_PER_S, K_PER_MIN_PER_K_PER_S};
use coil::Response;

use crate::input::ProfileCase;

/// A column's name, and its value in a row.
pub type Column = (&'static str, fn(&SimulatedRow) -> f64);

/// Columns of the result.
pub const COLUMNS: [Column; 7] = [
    ("time_s", |row| row.time),
    ("chamber_c", |row| row.chamber),
    ("spool_c", |row| row.spool),
    ("shupe_deg_per_h", |row| row.shupe),
    ("eo_axial_deg_per_h", |row| row.eo_axial),
    ("eo_radial_deg_per_h", |row| row.eo_radial),
    ("rate_deg_per_h", |row| row.rate),
];

/// Span over which the thermometer is differenced for its rate \[s\]: the interval of the paper's record.
pub const WINDOW_S: f64 = 30.0;
/// Share by which a window may be shorter: the jitter of recorders' clocks.
const JITTER: f64 = 0.1;

/// One row of the result, in the units of its [`COLUMNS`]; rates are means since the previous row, 0 in the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulatedRow {
    /// Instant \[s\].
    pub time: f64,
    /// Chamber \[°C\].
    pub chamber: f64,
    /// Thermometer \[°C\].
    pub spool: f64,
    /// Thermal phase \[deg/h\].
    pub shupe: f64,
    /// Axial strain \[deg/h\].
    pub eo_axial: f64,
    /// Radial strain \[deg/h\].
    pub eo_radial: f64,
    /// The read-out's own drift with temperature \[deg/h\]; a column of the result where the design has one.
    pub read_out: f64,
    /// Contribution of a user's own mechanisms \[deg/h\]; a column of the result where there are any.
    pub mechanisms: f64,
    /// The sum of the five \[deg/h\].
    pub rate: f64,
    /// Recorded thermometer \[°C\] and rate \[deg/h\]; columns of the result where the profile is a recording, NaN where there is nothing to be used.
    pub recorded: [f64; 2],
}

impl SimulatedRow {
    pub(super) fn of(profile: &ProfileCase, n: usize, response: Response) -> Self {
        let Response { sensor, bias, .. } = response;
        let bias = bias * DEG_PER_H_PER_RAD_PER_S;
        Self {
            time: profile.profile.time[n],
            chamber: profile.chamber()[n],
            spool: sensor,
            shupe: bias.shupe,
            eo_axial: bias.eo_axial,
            eo_radial: bias.eo_radial,
            read_out: response.read_out * DEG_PER_H_PER_RAD_PER_S,
            mechanisms: 0.0,
            rate: response.rate() * DEG_PER_H_PER_RAD_PER_S,
            recorded: profile.recorded.as_ref().map_or([f64::NAN; 2], |recorded| [recorded.spool[n], recorded.rate[n]]),
        }
    }

    /// The parts of the rate that are computed: thermal phase, axial strain, radial strain, read-out \[deg/h\].
    pub(crate) fn parts(&self) -> [f64; 4] {
        [self.shupe, self.eo_axial, self.eo_radial, self.read_out]
    }
}

/// Rates over the shortest run of whole rows that spans [`WINDOW_S`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Its end \[s\].
    pub time: f64,
    /// Difference of the thermometer over its span \[°C/min\].
    pub spool_rate: f64,
    /// Mean bias \[deg/h\].
    pub rate: f64,
}

/// Rows in windows, behind a first one.
pub(crate) fn windowed(first: SimulatedRow, rows: impl Iterator<Item = SimulatedRow>) -> impl Iterator<Item = Window> {
    let (mut start, mut last, mut turned) = (first, first, 0.0);
    rows.filter_map(move |row| {
        turned += row.rate * (row.time - last.time);
        last = row;
        let span = row.time - start.time;
        if span < (1.0 - JITTER) * WINDOW_S {
            return None;
        }
        let spool_rate = (row.spool - start.spool) / span * K_PER_MIN_PER_K_PER_S;
        let window = Window { time: row.time, spool_rate, rate: turned / span };
        (start, turned) = (row, 0.0);
        Some(window)
    })
}

/// The shortest text that reads back to the same double; plain between a millionth and a quadrillion. Nothing for what is no number.
pub(crate) fn number(value: f64) -> String {
    match value.abs() {
        v if v.is_nan() => String::new(),
        0.0 => "0".into(),
        1e-6..1e15 => value.to_string(),
        _ => format!("{value:e}"),
    }
}
