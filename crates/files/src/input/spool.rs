//! A record of the spool's thermometer, `time_s,spool_c`, to infer the chamber's course from.

use std::path::Path;

use coil::{Design, Drive, FEWEST_ROWS};
use recording::Seconds;

use super::InputError;
use super::fingerprint::Fingerprint;
use super::profile::{Wanted, read_rows};
use super::profile_columns::{DRIVES, RESULTS, names};
use super::record::read_record;
use super::record_options::{RecordOptions, TIME};
use super::rows::{Dialect, Rows, quoted};
use crate::Error;
use crate::note::Note;
use crate::remark::Remark;

const SPOOL: &str = "spool_c";
/// Most rows of a record: the smoother holds some 300 bytes of each.
const MOST_ROWS: usize = 1_000_000;
/// Rows further apart than this, in medians, are noted.
const GAP: f64 = 10.0;

/// A thermometer's record that has been read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct SpoolCase {
    /// Drives of the coil: the chamber, and its heaters if it has any.
    pub drives: Vec<Drive>,
    /// Instants \[s\].
    pub time: Vec<f64>,
    /// Readings \[°C\].
    pub spool: Vec<f64>,
    /// Notes for the user although nothing is wrong.
    pub notes: Vec<Note>,
    /// The file.
    pub fingerprint: Fingerprint,
}

/// Reads and checks a record: as a recording ([`super::read_record`]) where a map file says how it is read, given or beside it; else `time_s,spool_c`, in which
/// other columns that profiles and recordings have may stand and are not read.
///
/// # Errors
/// The fault, in which file, line and column, and how to mend it.
pub fn read_spool(path: &Path, options: &RecordOptions, design: &Design) -> Result<SpoolCase, Error> {
    if options.map_of(path).is_none() {
        return Ok(read_standard(path, design)?);
    }
    let record = read_record(path, options)?;
    record.require_usable()?;
    let used = record.report.used(&record.recording);
    let readings = used.channel(SPOOL).map_or(&[][..], |channel| &channel.values);
    let (time, spool): (Vec<f64>, Vec<f64>) = used.time().iter().zip(readings).filter(|(_, reading)| reading.is_finite()).unzip();
    if time.len() < FEWEST_ROWS {
        return Err(too_few(path, time.len(), "rows with a reading of the spool's thermometer").into());
    }
    let mut notes = record.notes;
    notes.extend(gap(&time).map(|gap| Remark::Gap.note(gap).at(path)));
    Ok(SpoolCase { drives: drives(design), time, spool, notes, fingerprint: record.fingerprint })
}

/// The drives of a design whose chamber is inferred.
fn drives(design: &Design) -> Vec<Drive> {
    if design.heat.heaters.is_empty() { vec![Drive::Chamber] } else { vec![Drive::Chamber, Drive::Heaters] }
}

fn too_few(path: &Path, count: usize, rows: &str) -> InputError {
    let problem = format!("has {count} {rows}, too few to infer the chamber from");
    InputError::whole(path, problem, format!("give {FEWEST_ROWS} or more"))
}

/// Reads a record in the standard columns.
fn read_standard(path: &Path, design: &Design) -> Result<SpoolCase, InputError> {
    let mut rows = Rows::open(path, "a record (*.csv)", Dialect::STANDARD)?;
    rows.header("time_s,spool_c")?;
    let names = columns(&rows)?;
    let [at_time, at_spool] = [TIME, SPOOL].map(|wanted| names.iter().position(|name| name == wanted));
    let missing = |name| rows.fault(Some(name), "the column is missing", format!("a record starts with a line {TIME},{SPOOL}"));
    let (at_time, at_spool) = (at_time.ok_or_else(|| missing(TIME))?, at_spool.ok_or_else(|| missing(SPOOL))?);
    let (time, mut courses) = read_rows(
        &mut rows,
        names.len(),
        &Wanted::number(at_time, TIME),
        &[Wanted::temperature(at_spool, SPOOL)],
        (MOST_ROWS, "record"),
    )?;
    let spool = courses.pop().unwrap_or_default();
    if time.len() < FEWEST_ROWS {
        return Err(too_few(path, time.len(), "rows below its header"));
    }
    let mut notes = Vec::new();
    let ignored: Vec<&str> = names.iter().map(String::as_str).filter(|name| ![TIME, SPOOL].contains(name)).collect();
    if !ignored.is_empty() {
        let message = format!("not read: {}; the chamber is inferred from {SPOOL}", ignored.join(", "));
        notes.push(Remark::IgnoredColumn.note(message).at(path));
    }
    notes.extend(gap(&time).map(|gap| Remark::Gap.note(gap).at(path)));
    Ok(SpoolCase { drives: drives(design), time, spool, notes, fingerprint: rows.fingerprint() })
}

/// The names of the columns, all known and none twice.
fn columns(rows: &Rows) -> Result<Vec<String>, InputError> {
    let names = names(rows, "time_s,spool_c")?;
    let known = |name: &str| name == TIME || RESULTS.contains(&name) || DRIVES.iter().any(|(drive, _)| *drive == name);
    match names.iter().find(|name| !known(name)) {
        Some(name) => {
            let remedy = format!("a record has {TIME},{SPOOL}; the other columns of profiles and results may stand beside them");
            Err(rows.fault(None, format!("unknown column {}", quoted(name)), remedy))
        }
        None => Ok(names),
    }
}

/// Note on the longest gap.
fn gap(time: &[f64]) -> Option<String> {
    let mut intervals: Vec<f64> = time.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let (at, longest) = intervals.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    intervals.sort_by(f64::total_cmp);
    let median = intervals[intervals.len() / 2];
    (longest > GAP * median).then(|| {
        let [longest, after, median] = [longest, time[at], median].map(Seconds);
        format!("no row for {longest} s after {after} s, usually {median} s; there the chamber is taken as linear")
    })
}
