//! Expected content of a recording.

use recording::check::{Clock, Expectation, Expectations, Offset};
use recording::{Channel, Recording};

use super::profile::{ABSOLUTE_ZERO_C, ROOM_C};
use super::record_format::RecordFormat;
use super::record_options::Key;

/// Rows below which a recording is noted as short.
const FEW_ROWS: usize = 100;
/// Range of temperatures \[°C\].
const TEMPERATURE_C: [f64; 2] = [-100.0, 200.0];
/// Temperatures \[°C\] that a sensor on a coil can tell: from absolute zero to where polyimide, the most resistant polymer on a fibre, decomposes.
const POSSIBLE_C: [f64; 2] = [ABSOLUTE_ZERO_C, 400.0];
/// The Earth's rate \[deg/h\] with two parts in a thousand (IERS Conventions 2010: 7.292115e-5 rad/s).
pub(super) const EARTH_DEG_PER_H: f64 = 15.041 * 1.002;
/// Range of rates at rest \[deg/h\]: a hundred times the Earth's, far beyond an optical gyro's bias.
const RATE_DEG_PER_H: [f64; 2] = [-100.0 * EARTH_DEG_PER_H, 100.0 * EARTH_DEG_PER_H];
/// Rates \[deg/h\] that a gyro can tell: some thousand degrees a second.
const POSSIBLE_DEG_PER_H: [f64; 2] = [-1e8, 1e8];
/// Noise below this is not that of a gyro's sample \[deg/h\].
const NOISE_DEG_PER_H: [f64; 2] = [2e-5, 3600.0];
/// Rates that never reach this \[deg/h\] would, in deg/s, never reach the Earth's.
const SMALL_DEG_PER_H: f64 = EARTH_DEG_PER_H / 3600.0;
/// A constant offset above this is no bias of the gyros that this program is for \[deg/h\].
pub(super) const OFFSET_DEG_PER_H: f64 = 0.5;
/// The fastest change of a chamber's air \[degC/s\], 30 degC a minute: twice the fastest rate of IEC 60068-2-14, test Nb (15 K/min). In a
/// faster change, as in a test by thermal shock, the bias does not follow a model that starts at rest.
const FASTEST_C_PER_S: f64 = 0.5;
/// Range of a recording's duration \[s\]: longer than a minute, as a coil needs minutes to answer, and at most 100 days.
const SPAN_S: [f64; 2] = [60.0, 100.0 * 86_400.0];
/// Usual duration of a recording \[s\]: ten hours.
const USUAL_S: f64 = 36_000.0;
/// Longest cycle of a chamber's logger \[s\]: loggers are set to minutes, and a level of a programme lasts until the unit has settled, which takes tens of
/// minutes.
const LONGEST_HOLD_S: f64 = 600.0;

/// Range beyond which no value is possible, in the standard unit.
pub(super) fn possible(key: Key) -> [f64; 2] {
    if key == Key::Rate { POSSIBLE_DEG_PER_H } else { POSSIBLE_C }
}

/// Expectations of a gyro's record; `earth` is Earth's rate along the axis \[deg/h\], where it is told.
pub(super) fn expectations(recording: &Recording, format: &RecordFormat, has_dates: bool, earth: Option<f64>) -> Expectations {
    // one word is enough where both are too fast
    let driver = [Key::Chamber, Key::Spool].into_iter().find(|key| recording.channel(key.standard()).is_some());
    let of = |channel: &Channel| {
        // of a further column nothing is expected
        let Some(key) = Key::ALL.into_iter().find(|key| key.standard() == channel.name) else { return Expectation::default() };
        let mistaken = format.column(key).mistaken(key);
        if key != Key::Rate {
            // who says the unit knows where the recording starts
            let start = if format.column(key).is_standard(key) { ROOM_C } else { Expectation::default().start };
            return Expectation {
                values: TEMPERATURE_C,
                possible: possible(key),
                start,
                fastest: if driver == Some(key) { FASTEST_C_PER_S } else { f64::INFINITY },
                may_jump: key != Key::Spool,
                longest_hold: if key == Key::Spool { f64::INFINITY } else { LONGEST_HOLD_S },
                mistaken,
                key: key.name().into(),
                ..Expectation::default()
            };
        }
        let offset = match earth {
            Some(earth) => Offset {
                known: earth,
                largest: OFFSET_DEG_PER_H,
                explained: OFFSET_DEG_PER_H,
                of: format!("Earth's rate, {earth:.2} deg/h by the meta file"),
            },
            None => Offset {
                known: 0.0,
                largest: OFFSET_DEG_PER_H,
                explained: EARTH_DEG_PER_H,
                of: format!(
                    "Earth's rate not removed (up to {:.2} deg/h times the sine of the latitude)",
                    EARTH_DEG_PER_H / 1.002
                ),
            },
        };
        Expectation {
            values: RATE_DEG_PER_H,
            possible: possible(key),
            noise: NOISE_DEG_PER_H,
            least_size: SMALL_DEG_PER_H,
            longest_hold: f64::INFINITY,
            mistaken,
            key: key.name().into(),
            offset: Some(offset),
            essential: true,
            ..Expectation::default()
        }
    };
    let time = format.column(Key::Time);
    // dates have no unit, and an interval that was declared has one
    let mistaken = if has_dates || format.interval.is_some() { Vec::new() } else { time.mistaken(Key::Time) };
    let clock = Clock { span: SPAN_S, usual: USUAL_S, mistaken, key: Key::Time.name().into() };
    Expectations { channels: recording.channels().iter().map(of).collect(), fewest_rows: FEW_ROWS, clock }
}
