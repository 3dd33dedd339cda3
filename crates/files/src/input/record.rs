//! A recording: instants, temperatures and the gyro's rate.

use std::path::{Path, PathBuf};

use recording::check::{Report, Severity, Unit, check};
use recording::{Channel, Recording, Sampling, Seconds};

use super::InputError;
use super::fingerprint::Fingerprint;
use super::meta::{self, Meta};
use super::opened::open;
use super::record_clock::{Clock, Unread};
use super::record_columns::RecordColumns;
use super::record_expectations::{expectations, possible};
use super::record_format::RecordFormat;
use super::record_lines::Lines;
use super::record_notes::{interval_note, notes};
use super::record_options::{Key, RecordOptions};
use super::rows::{NOT_UTF8, Rows, Table, quoted};
use super::timestamp;
use crate::Error;
use crate::note::Note;
use crate::remark::Remark;
use crate::shown::shown_path;

/// Most rows: what fits in a gigabyte with its checks.
const MOST_ROWS: usize = 10_000_000;

/// A recording that has been read and checked; nothing in it was altered but units.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordCase {
    /// All rows; channels [`super::CHAMBER`], [`super::SPOOL`] (where the file has them) and [`super::RATE`], in degC and deg/h.
    pub recording: Recording,
    /// Columns of numbers that nothing reads, in the same rows.
    pub ignored: Recording,
    /// The result: rows to keep, values to use.
    pub report: Report,
    /// Other units in which the rate may be, those that are rare last: conversion from the rate as it was read; none of counts.
    pub rate_units: Vec<Unit>,
    /// Seconds over which a rate is a mean.
    pub averaging: f64,
    /// The meta file, if there is one.
    pub meta: Option<Meta>,
    /// Notes for the user on the reading of the file.
    pub notes: Vec<Note>,
    /// Line of each row in the file; empty for numbers in memory.
    pub lines: Vec<u32>,
    /// Flags of the command that name files with which it was read, `--map` and `--meta`.
    pub flags: Vec<(&'static str, PathBuf)>,
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

    /// The lines of the file that findings are about.
    pub fn lines_by_instant(&self) -> Lines<'_> {
        Lines::new(self.recording.time(), &self.lines)
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
        let line = self.lines_by_instant().of(first).map(|lines| *lines.start() as usize);
        Err(InputError { line, ..InputError::whole(&self.fingerprint.file, problem, "") })
    }
}

/// Reads and checks a recording; one that cannot be used is no error here, see [`RecordCase::require_usable`].
///
/// # Errors
/// [`Error::Input`]: what is wrong, in which file, line and column, and how to mend it; [`Error::Usage`] for wrong options.
pub fn read_record(path: &Path, options: &RecordOptions) -> Result<RecordCase, Error> {
    read_as(path, &RecordFormat::read(path, options)?, options)
}

/// [`read_record`] in a known format.
pub(super) fn read_as(path: &Path, format: &RecordFormat, options: &RecordOptions) -> Result<RecordCase, Error> {
    let meta = known(options.meta_of(path))?;
    let flags = [("--map", &options.map), ("--meta", &options.meta)];
    let flags = flags.into_iter().filter_map(|(flag, file)| Some((flag, file.clone()?))).collect();
    let case = checked(Rows::open(path, "a recording (*.csv)", format.dialect)?, format, meta);
    // the line of names, and what stands above it, is as the map says, or is not
    let names = format.dialect.preamble as usize + 1;
    case.map(|case| RecordCase { flags, ..case }).map_err(|error| match error {
        Error::Input(wrong) => {
            let mut remedy = wrong.remedy.clone();
            if wrong.problem == NOT_UTF8 {
                remedy += ", or let `fogcoil check RECORD --write-map` find how it is encoded";
            }
            let is_of_form = wrong.problem == NOT_UTF8 || wrong.line.is_some_and(|line| line <= names);
            if let Some(map) = options.map.as_deref().filter(|_| is_of_form && wrong.file == path) {
                remedy += &format!(
                    " (read by --map {}, which stands for every record; a map beside each record, NAME.map.ron, is for it alone)",
                    shown_path(map)
                );
            }
            InputError { remedy, ..wrong }.into()
        }
        other => other,
    })
}

/// Checks a recording that is not in a file, in the standard columns: the case that [`read_record`] would read from a file of this
/// content with nothing beside it but `meta`, which is the path of a meta file; `further` columns are read as they stand.
///
/// # Errors
/// As [`read_record`]; messages call the table `path`.
pub fn check_record(path: &Path, table: impl Into<Table>, meta: Option<&Path>, further: &[String]) -> Result<RecordCase, Error> {
    let meta = known(meta.map(Path::to_owned))?;
    checked(Rows::of(path, table.into()), &RecordFormat { further: further.to_vec(), ..RecordFormat::standard() }, meta)
}

/// A meta file with its path.
fn known(meta: Option<PathBuf>) -> Result<Option<(PathBuf, Meta)>, InputError> {
    meta.map(|path| open(&path).and_then(|source| meta::checked(&source)).map(|meta| (path, meta))).transpose()
}

fn checked(mut rows: Rows, format: &RecordFormat, meta: Option<(PathBuf, Meta)>) -> Result<RecordCase, Error> {
    rows.header("time_s,chamber_c,spool_c,rate_deg_per_h")?;
    let columns = RecordColumns::read(&rows, format)?;
    for _ in 0..format.dialect.below {
        rows.advance()?;
    }
    let ReadRows { recording, ignored, lines, dates, unread } = read_rows(&mut rows, &columns, format)?;
    let earth = meta.as_ref().and_then(|(_, meta)| meta.rate_deg_per_h.earth());
    let report = check(&recording, &expectations(&recording, format, dates.is_some(), earth));
    let [interval, span] = report.instants.as_ref().map_or([0.0; 2], |instants| [instants.interval, instants.span]);
    let meta = meta.map(|(path, meta)| fits(&path, meta, span)).transpose()?;
    let averaging = meta.as_ref().map(|meta| meta.sample_interval_s).filter(|seconds| *seconds > 0.0).unwrap_or(interval);
    let mut notes = notes(&columns, format, dates);
    notes.extend(unread);
    notes.extend(meta.as_ref().and_then(|meta| interval_note(meta, interval)));
    let (flags, fingerprint) = (Vec::new(), rows.fingerprint());
    let rate_units = format.column(Key::Rate).other_units(Key::Rate);
    Ok(RecordCase { recording, ignored, report, rate_units, averaging, meta, notes, lines, flags, fingerprint })
}

/// The meta file of a recording that lasts `span` \[s\], unless a rate would be a mean over more.
fn fits(path: &Path, meta: Meta, span: f64) -> Result<Meta, InputError> {
    let interval = meta.sample_interval_s;
    if span == 0.0 || interval <= span {
        return Ok(meta);
    }
    let problem = format!("sample_interval_s: {interval} s is longer than the recording, {} s", Seconds(span));
    Err(InputError::whole(path, problem, "give the seconds over which a rate is a mean, or leave the field out"))
}

/// What the rows hold.
struct ReadRows {
    recording: Recording,
    ignored: Recording,
    /// The line of each row.
    lines: Vec<u32>,
    /// The note on instants that are not seconds of a column.
    dates: Option<Note>,
    /// Notes on lines that are no rows.
    unread: Vec<Note>,
}

/// Most values of columns that nothing reads that are kept: 160 MB.
const MOST_UNUSED: usize = 20_000_000;

fn read_rows(rows: &mut Rows, columns: &RecordColumns, format: &RecordFormat) -> Result<ReadRows, InputError> {
    let channels: Vec<(Key, usize)> =
        [Key::Chamber, Key::Spool, Key::Rate].into_iter().filter_map(|key| Some((key, columns.column(key)?))).collect();
    let mut clock = Clock::new(columns.column(Key::Time), columns, format);
    let mut unread = Unread::of(columns, format);
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); channels.len()];
    let mut impossible: Vec<Option<(usize, InputError)>> = vec![None; channels.len()];
    let mut further: Vec<Vec<f64>> = vec![Vec::new(); columns.further.len()];
    let mut unused: Vec<(usize, Vec<f64>)> = columns.unused().into_iter().map(|column| (column, Vec::new())).collect();
    let (mut time, mut lines): (Vec<f64>, Vec<u32>) = (Vec::new(), Vec::new());
    let mut footer: Option<(u32, String, InputError)> = None;
    let mut again: Vec<u32> = Vec::new();
    while rows.advance()? {
        // a spreadsheet's empty line; without instants it stands for one of them
        if format.interval.is_none() && rows.line().is_some() && rows.fields().all(str::is_empty) {
            continue;
        }
        if !time.is_empty() && rows.line().is_some() && rows.fields().eq(columns.names.iter().map(String::as_str)) {
            again.extend(rows.line());
            for _ in 0..format.dialect.below {
                rows.advance()?;
            }
            continue;
        }
        if !time.is_empty() && is_remark(rows) {
            footer.get_or_insert_with(|| {
                let (line, text) = (rows.line().unwrap_or(0), quoted(&rows.fields().collect::<Vec<_>>().join(" ")));
                (line, text, rows.fault(None, "holds no number, and rows follow", "if the line is a remark, remove it"))
            });
            continue;
        }
        if let Some((.., fault)) = footer.take() {
            return Err(fault);
        }
        let expected = columns.names.len();
        if rows.count() != expected {
            rows.check_commas()?;
        }
        rows.check_count(expected, " ", |_, found| count_remedy(found, expected))?;
        if time.len() == MOST_ROWS {
            return Err(rows.fault(None, format!("more than {MOST_ROWS} rows"), "split the recording, or average it"));
        }
        unread.iter_mut().for_each(|unread| unread.read(rows, columns, time.len()));
        time.push(clock.read(rows, columns, time.len())?);
        lines.extend(rows.line());
        for (((key, column), values), impossible) in channels.iter().zip(&mut values).zip(&mut impossible) {
            let name = &columns.names[*column];
            let value = rows.value(*column, name)?.map_or(f64::NAN, |value| format.column(*key).standard(value));
            let [low, high] = possible(*key);
            if value < low || value > high {
                impossible.get_or_insert_with(|| (0, beyond(rows, *key, name, value))).0 += 1;
            }
            values.push(value);
        }
        for (column, values) in columns.further.iter().zip(&mut further) {
            values.push(rows.value(*column, &columns.names[*column])?.unwrap_or(f64::NAN));
        }
        // of very many nobody looks for a course
        if unused.len() * time.len() > MOST_UNUSED {
            unused.clear();
        }
        // a column of words tells no numbers
        unused.retain_mut(|(column, values)| {
            let value = rows.value(*column, &columns.names[*column]);
            value.map(|value| values.push(value.unwrap_or(f64::NAN))).is_ok()
        });
    }
    rows.check_commas()?;
    for (values, impossible) in values.iter().zip(impossible) {
        // of fewer, `check` says that they are not used
        let present = values.iter().filter(|value| !value.is_nan()).count();
        if let Some((count, first)) = impossible.filter(|(count, _)| 2 * count > present) {
            return Err(InputError { problem: format!("{}, and so are {count} of {present} values", first.problem), ..first });
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
    let as_it_stands = |(column, values): (usize, Vec<f64>)| Channel {
        name: columns.names[column].clone(),
        unit: String::new(),
        values,
        sampling: Sampling::Momentary,
    };
    let beside = columns.further.iter().copied().zip(further).map(as_it_stands);
    // of a name that stands twice none is meant
    let is_one =
        |(column, _): &(usize, Vec<f64>)| columns.names.iter().filter(|name| **name == columns.names[*column]).count() == 1;
    let unused = unused.into_iter().filter(is_one).map(as_it_stands).collect();
    let channels = channels.iter().zip(values).map(channel).chain(beside).collect();
    let time = clock.settle(time);
    let (time, dates) = match unread {
        Some(unread) => {
            let (time, note) = unread.settle(columns, time);
            (time, Some(note))
        }
        None => (time, clock.note()),
    };
    let footer = footer.map(|(line, text, _)| {
        Remark::Footer
            .note(format!("what begins in line {line}, {text}, holds no number: a remark below the rows, which is not read"))
    });
    let names_again = again.first().map(|line| {
        let more = if again.len() > 1 { format!(", and so do {} more", again.len() - 1) } else { String::new() };
        Remark::NamesAgain.note(format!("line {line} holds the names again{more}; they are not read: the logger began anew"))
    });
    let of_rows = |time, channels| Recording::new(time, channels).map_err(|error| rows.whole_fault(&error.to_string(), ""));
    let (ignored, recording) = (of_rows(time.clone(), unused)?, of_rows(time, channels)?);
    Ok(ReadRows { recording, ignored, lines, dates, unread: footer.into_iter().chain(names_again).collect() })
}

/// Whether a line of text says something, and no field of it is a number, a date or a time of day.
fn is_remark(rows: &Rows) -> bool {
    let is_value = |field: &str| {
        field.replace(',', ".").parse::<f64>().is_ok() || timestamp::is_date(field) || timestamp::time_of_day(field).is_some()
    };
    rows.line().is_some() && rows.fields().any(|field| !field.is_empty()) && !rows.fields().any(is_value)
}

/// The complaint about a value that is impossible.
fn beyond(rows: &Rows, key: Key, name: &str, value: f64) -> InputError {
    let ([low, high], unit) = (possible(key), key.units()[0].names[0]);
    let shown = if value.abs() < 1e6 { format!("{value}") } else { format!("{value:e}") };
    let key = key.name();
    let remedy = format!(
        "check the column, its unit (--unit {key}=UNIT, or unit in the map file) and its scale (--scale {key}=FACTOR, or scale)"
    );
    rows.fault(Some(name), format!("{shown} {unit} is impossible ({low} to {high} {unit})"), remedy)
}

fn count_remedy(found: usize, expected: usize) -> &'static str {
    if found > expected && found.is_multiple_of(2) {
        "give one number a column; if decimals have a comma, separate the fields otherwise, e.g. --separator ';' --decimal-comma"
    } else {
        "complete the row (a missing value is an empty field), or remove it"
    }
}
