//! A recording: instants, temperatures and the gyro's rate.

use std::path::Path;

use recording::check::{Expectation, Expectations, Offset, Report, Severity, check};
use recording::{Channel, Recording, Sampling};

use super::InputError;
use super::fingerprint::Fingerprint;
use super::meta::{self, Meta};
use super::record_columns::RecordColumns;
use super::record_format::{Key, RecordFormat, RecordOptions};
use super::rows::{Rows, quoted};
use super::timestamp::{self, FORMS, is_ambiguous};
use crate::Error;
use crate::remark::{Note, Remark};

/// Most rows: what fits in a gigabyte with its checks.
const MOST_ROWS: usize = 10_000_000;
/// Rows below which a recording is noted as short.
const FEW_ROWS: usize = 100;
/// Where temperatures may lie \[°C\].
const TEMPERATURE_C: [f64; 2] = [-100.0, 200.0];
/// Where rates and their noise may lie at rest \[deg/h\]: up to consumer gyros, whose bias is below a degree a second.
const RATE_DEG_PER_H: [f64; 2] = [-3600.0, 3600.0];
/// Noise below this is not that of a gyro's sample \[deg/h\].
const NOISE_DEG_PER_H: [f64; 2] = [2e-5, 3600.0];
/// The Earth's rate \[deg/h\] with two parts in a thousand (IERS Conventions 2010: 7.292115e-5 rad/s).
const EARTH_DEG_PER_H: f64 = 15.041 * 1.002;
/// A constant offset above this is no bias of the gyros that this program is for \[deg/h\].
const OFFSET_DEG_PER_H: f64 = 0.5;

/// A recording that has been read and checked; nothing in it was altered but units.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordCase {
    /// All rows; channels [`super::CHAMBER`], [`super::SPOOL`] (where the file has them) and [`super::RATE`], in degC and deg/h.
    pub recording: Recording,
    /// What was found: rows to keep, values to use.
    pub report: Report,
    /// Seconds over which a rate is a mean.
    pub averaging: f64,
    /// The meta file, if there is one.
    pub meta: Option<Meta>,
    /// What a user should know about how the file was read.
    pub notes: Vec<Note>,
    /// The file.
    pub fingerprint: Fingerprint,
}

impl RecordCase {
    /// The rows that are kept, in the order of `report.masks`.
    pub fn kept(&self) -> Recording {
        self.recording.select(&self.report.rows)
    }

    /// Number of a channel in `recording` and `report`.
    pub fn number(&self, channel: &str) -> Option<usize> {
        self.recording.channels().iter().position(|other| other.name == channel)
    }

    /// Refuses a recording that cannot be used.
    ///
    /// # Errors
    /// The worst of the findings, and how many there are.
    pub fn require_usable(&self) -> Result<(), InputError> {
        let mut errors = self.report.findings.iter().filter(|finding| finding.severity == Severity::Error);
        let Some(first) = errors.next() else { return Ok(()) };
        let more = match errors.count() {
            0 => String::new(),
            more => format!(" (and {more} more)"),
        };
        let problem = format!("cannot be used: {first}{more}");
        Err(InputError::whole(&self.fingerprint.file, problem, ""))
    }
}

/// Reads and checks a recording; one that cannot be used is no error here, see [`RecordCase::require_usable`].
///
/// # Errors
/// [`Error::Input`]: what is wrong, in which file, line and column, and how to mend it; [`Error::Usage`] for wrong options.
pub fn read_record(path: &Path, options: &RecordOptions) -> Result<RecordCase, Error> {
    let format = RecordFormat::read(path, options)?;
    let beside = Some(path.with_file_name("meta.ron")).filter(|beside| beside.is_file());
    let meta = options.meta.clone().or(beside).map(|path| meta::read(&path)).transpose()?;
    checked(Rows::open(path, "a recording (*.csv)", format.dialect)?, &format, meta)
}

/// Checks a recording that is not in a file, in the standard columns: the case that [`read_record`] would read from a file of this
/// content with nothing beside it but `meta`, which is the path of a meta file.
///
/// # Errors
/// As [`read_record`]; messages call the text `path`.
pub fn check_record(path: &Path, text: String, meta: Option<&Path>) -> Result<RecordCase, Error> {
    let meta = meta.map(meta::read).transpose()?;
    checked(Rows::of(path, text), &RecordFormat::standard(), meta)
}

fn checked(mut rows: Rows, format: &RecordFormat, meta: Option<Meta>) -> Result<RecordCase, Error> {
    rows.header("time_s,chamber_c,spool_c,rate_deg_per_h")?;
    let columns = RecordColumns::read(&rows, format)?;
    let (recording, relative) = read_rows(&mut rows, &columns, format)?;
    let report = check(&recording, &expectations(&recording, format));
    let interval = report.instants.as_ref().map_or(0.0, |instants| instants.interval);
    let averaging = meta.as_ref().map(|meta| meta.sample_interval_s).filter(|seconds| *seconds > 0.0).unwrap_or(interval);
    let mut notes = notes(&columns, format, relative);
    notes.extend(meta.as_ref().and_then(|meta| interval_note(meta, interval)));
    Ok(RecordCase { recording, report, averaging, meta, notes, fingerprint: rows.fingerprint() })
}

/// The recording, and whether its instants count from its first row.
fn read_rows(rows: &mut Rows, columns: &RecordColumns, format: &RecordFormat) -> Result<(Recording, bool), InputError> {
    let channels: Vec<(Key, usize)> =
        [Key::Chamber, Key::Spool, Key::Rate].into_iter().filter_map(|key| Some((key, columns.column(key)?))).collect();
    let mut clock = Clock::new(columns, format);
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); channels.len()];
    let mut time: Vec<f64> = Vec::new();
    while rows.advance()? {
        let expected = columns.names.len();
        rows.check_count(expected, " ", |_, found| count_remedy(found, expected))?;
        if time.len() == MOST_ROWS {
            return Err(rows.fault(None, format!("more than {MOST_ROWS} rows"), "split the recording, or average it"));
        }
        time.push(clock.read(rows, columns, time.len())?);
        for ((key, column), values) in channels.iter().zip(&mut values) {
            let value = rows.value(*column, &columns.names[*column])?;
            values.push(value.map_or(f64::NAN, |value| format.column(*key).standard(value)));
        }
    }
    if time.is_empty() {
        return Err(rows.whole_fault("has no row below its header", "give one for each instant"));
    }
    let channel = |((key, _), values): (&(Key, usize), Vec<f64>)| Channel {
        name: key.standard().into(),
        unit: key.units()[0].names[0].into(),
        values,
        sampling: if *key == Key::Rate { Sampling::Mean } else { Sampling::Momentary },
    };
    let channels = channels.iter().zip(values).map(channel).collect();
    let recording = Recording::new(time, channels).map_err(|error| rows.whole_fault(&error.to_string(), ""))?;
    Ok((recording, clock.first.is_some()))
}

fn count_remedy(found: usize, expected: usize) -> &'static str {
    if found > expected && found.is_multiple_of(2) {
        "give one number a column; if decimals have a comma, separate the fields otherwise, e.g. --separator ';' --decimal-comma"
    } else {
        "complete the row (a missing value is an empty field), or remove it"
    }
}

/// Instants from a column, from dates, or from the rows' number.
struct Clock<'a> {
    column: Option<usize>,
    format: &'a RecordFormat,
    /// First instant of dates \[s since 1970\], from which the others count.
    first: Option<f64>,
}

impl<'a> Clock<'a> {
    fn new(columns: &RecordColumns, format: &'a RecordFormat) -> Self {
        Self { column: columns.column(Key::Time), format, first: None }
    }

    fn read(&mut self, rows: &Rows, columns: &RecordColumns, number: usize) -> Result<f64, InputError> {
        let Some(column) = self.column else { return Ok(number as f64 * self.format.interval.unwrap_or(1.0)) };
        if (number == 0 || self.first.is_some())
            && let Some(seconds) = timestamp::seconds(rows.field(column))
        {
            return Ok(seconds - *self.first.get_or_insert(seconds));
        }
        let name = &columns.names[column];
        if self.first.is_some() {
            let problem = format!("{} is not a date and time like that of the first row", quoted(rows.field(column)));
            return Err(rows.fault(Some(name), problem, format!("write it like {FORMS}")));
        }
        match rows.value(column, name).map_err(|error| not_an_instant(error, rows.field(column)))? {
            Some(value) => Ok(self.format.column(Key::Time).standard(value)),
            None => Err(rows.fault(Some(name), "is empty", "every row needs an instant; remove the row")),
        }
    }
}

/// The complaint about a field that is no number, where it may be a date.
fn not_an_instant(error: InputError, text: &str) -> InputError {
    if text.parse::<f64>().is_ok() || error.remedy.contains("--decimal-comma") {
        return error;
    }
    let problem = if is_ambiguous(text) {
        format!("{} does not say whether the day or the month is first", quoted(text))
    } else {
        error.problem
    };
    let remedy = format!("write seconds like 20.5, or dates like {FORMS}; with no column of instants, --interval SECONDS");
    InputError { problem, remedy, ..error }
}

/// What a gyro's record holds.
fn expectations(recording: &Recording, format: &RecordFormat) -> Expectations {
    let of = |channel: &Channel| {
        let key = Key::ALL.into_iter().find(|key| key.standard() == channel.name).unwrap_or(Key::Rate);
        let mistaken = format.column(key).mistaken(key);
        if key != Key::Rate {
            return Expectation { values: TEMPERATURE_C, mistaken, ..Expectation::default() };
        }
        let of = format!("Earth's rate not removed (up to {:.2} deg/h times the sine of the latitude)", EARTH_DEG_PER_H / 1.002);
        Expectation {
            values: RATE_DEG_PER_H,
            noise: NOISE_DEG_PER_H,
            mistaken,
            offset: Some(Offset { largest: OFFSET_DEG_PER_H, explained: EARTH_DEG_PER_H, of }),
            essential: true,
        }
    };
    Expectations { channels: recording.channels().iter().map(of).collect(), fewest_rows: FEW_ROWS }
}

fn notes(columns: &RecordColumns, format: &RecordFormat, relative: bool) -> Vec<Note> {
    let mut notes = Vec::new();
    for key in Key::ALL {
        let Some(column) = columns.column(key) else {
            notes.push(if key == Key::Time {
                Remark::DeclaredInterval.note("there is no column of instants: the interval that was declared stands for it")
            } else {
                let message = format!("there is no column {}; a model can do without it, less surely", key.standard());
                Remark::AbsentColumn.note(message)
            });
            continue;
        };
        let (name, form) = (&columns.names[column], format.column(key));
        let standard = key.units()[0];
        if name != key.standard() || form.unit != standard || form.count != 1.0 {
            let counts = if form.count == 1.0 { String::new() } else { format!("counts of {} ", form.count) };
            let unit = form.unit.names[0];
            let message = format!("{} is read from the column {}, in {counts}{unit}", key.name(), quoted(name));
            notes.push(Remark::MappedColumn.note(message));
        }
        if let Some(named) = key.unit_in(name).filter(|named| *named != form.unit) {
            let (named, unit, key) = (named.names[0], form.unit.names[0], key.name());
            let message =
                format!("the column {} is read in {unit}; if its name is right, add --unit {key}={named}", quoted(name));
            notes.push(Remark::UnitInName.warning(message));
        }
    }
    if relative {
        notes.push(Remark::Dates.note("instants are dates; they count from the first row"));
    }
    match columns.ignored()[..] {
        [] => {}
        [name] => notes.push(Remark::IgnoredColumn.note(format!("the column {} is not used", quoted(name)))),
        ref names => {
            let message = format!("{} columns are not used: {}", names.len(), names.join(", "));
            notes.push(Remark::IgnoredColumn.note(message));
        }
    }
    notes
}

fn interval_note(meta: &Meta, interval: f64) -> Option<Note> {
    let nominal = meta.sample_interval_s;
    let differs = nominal > 0.0 && interval > 0.0 && (interval / nominal - 1.0).abs() > 0.02;
    let message = || format!("the rows are {interval} s apart, the meta file says {nominal} s");
    differs.then(|| Remark::IntervalDiffers.note(message()))
}
