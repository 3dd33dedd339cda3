//! A profile: the chamber's temperature in time, `time_s,chamber_c`, and the other drives of the coil.

use std::collections::BTreeMap;
use std::path::Path;

use coil::{Design, Drive, Profile};

use super::InputError;
use super::fingerprint::Fingerprint;
use super::profile_columns::Columns;
use super::record_format::{ColumnFormat, RecordFormat};
use super::record_notes;
use super::record_options::Key;
use super::rows::{Dialect, Rows, Table};
use crate::note::Note;
use crate::remark::Remark;

/// Rooms \[°C\].
pub(super) const ROOM_C: [f64; 2] = [15.0, 30.0];
/// Most rows of a profile: two and a half years at 4 s.
const MOST_ROWS: usize = 20_000_000;
/// Accepted temperatures \[degC\].
pub(super) const ABSOLUTE_ZERO_C: f64 = -273.15;
const MOST_C: f64 = 1000.0;
/// A chamber that never gets below this \[degC\] is warned of as possibly recorded in kelvin.
const KELVIN_C: f64 = 180.0;
/// Latest instant, either side of 0 [s]: 30 000 years, to catch a wrong unit.
pub(super) const MOST_S: f64 = 1e12;
/// Shortest interval between rows \[s\], but for rounding.
const SHORTEST_S: f64 = 1e-6;

/// Rows closer than this \[s\] are noted: the model's fastest modes last about as long, and the effect of a jump within it is not resolved.
const RESOLVED_S: f64 = 1.0;

/// Rows longer than this \[s\] are noted: a coil's response within them is averaged away.
const COARSE_S: f64 = 120.0;

/// Course of a profile's drives between its rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Between {
    /// Straight, as a programme is.
    #[default]
    Linear,
    /// A smooth cubic through the rows, as a recorded chamber moves.
    Cubic,
}

impl Between {
    /// Parts into which an interval is divided.
    pub fn parts(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Cubic => 6,
        }
    }
}

/// A profile that has been read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct ProfileCase {
    /// Drives of the coil, in the order of the profile's courses; the chamber first.
    pub drives: Vec<Drive>,
    /// Instants \[s\] and courses \[°C; heaters in units of their power\].
    pub profile: Profile,
    /// Further columns that mechanisms' files name, a value for each instant.
    pub further: BTreeMap<String, Vec<f64>>,
    /// How the chamber's course was inferred from a thermometer; `None` if it is given.
    pub inferred: Option<Inference>,
    /// Readings beside the chamber's, where the profile is a recording.
    pub recorded: Option<Recorded>,
    /// Notes for the user although nothing is wrong.
    pub notes: Vec<Note>,
    /// The file.
    pub fingerprint: Fingerprint,
    /// Course of the drives between its rows.
    pub between: Between,
    /// Longest part \[s\] into which its rows were divided, if they were.
    pub step: Option<f64>,
}

/// Readings of a recording, a value for each instant; NaN where none is to be used.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// Thermometer \[°C\].
    pub spool: Vec<f64>,
    /// Rate of the gyroscope \[deg/h\].
    pub rate: Vec<f64>,
}

/// Accuracy of a chamber's course inferred from a thermometer's record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Inference {
    /// Standard deviation of the readings \[K\], given.
    pub noise: f64,
    /// Standard deviation of the change of the chamber's slope over a second \[K s^−3/2\], the most likely.
    pub roughness: f64,
    /// Root mean square of the readings minus the model's thermometer \[K\].
    pub sensor_residual_rms: f64,
    /// Standard deviation of the chamber's temperature \[K\]: median and largest.
    pub chamber_sd: [f64; 2],
}

impl ProfileCase {
    /// Temperature of the chamber at every instant \[°C\].
    pub fn chamber(&self) -> &[f64] {
        &self.profile.drives[0]
    }

    /// Notes rows in which, or before which, something changes, and which last so long that the coil's response is averaged away.
    pub fn note_long_rows(&mut self, remedy: &str) {
        let Profile { time, drives } = &self.profile;
        let changes = |n: usize| n > 0 && drives.iter().any(|course| course[n] != course[n - 1]);
        let seen = (1..time.len()).filter(|&n| changes(n) || changes(n - 1));
        let longest = seen.map(|n| time[n] - time[n - 1]).fold(0.0, f64::max);
        if longest > COARSE_S {
            let problem =
                format!("rows last up to {longest:.0} s, and a row's rate is its mean: peaks within it do not show; {remedy}");
            self.notes.push(Remark::LongRows.note(problem).at(&self.fingerprint.file));
        }
    }

    /// Adds rows at whole numbers of `step` seconds from the first row, on the straight lines between the profile's own, which stay.
    ///
    /// # Errors
    /// If these are too many rows.
    pub fn divide(&mut self, step: f64) -> Result<(), InputError> {
        let time = &self.profile.time;
        let rows = (time[time.len() - 1] - time[0]) / step + time.len() as f64;
        if rows > MOST_ROWS as f64 {
            let problem = format!("has {rows:.0} rows with this --step, more than {MOST_ROWS}");
            return Err(InputError::whole(&self.fingerprint.file, problem, "give a longer step"));
        }
        let start = time[0];
        // in each interval the numbers of the rows that are added; what is next to a row of the profile's own is that row
        let between = |pair: &[f64]| -> Vec<f64> {
            let [from, to] = [pair[0], pair[1]].map(|t| (t - start) / step);
            ((from + BESIDE).floor() as u64 + 1..).map(|k| k as f64).take_while(|k| *k < to - BESIDE).collect()
        };
        let added: Vec<Vec<f64>> = time.windows(2).map(between).collect();
        // the rows themselves keep their bits
        let divided = |values: &[f64], at: &dyn Fn(usize, f64) -> f64| -> Vec<f64> {
            let rows =
                added.iter().enumerate().flat_map(|(n, added)| added.iter().map(move |k| at(n, *k)).chain([values[n + 1]]));
            values.first().copied().into_iter().chain(rows).collect()
        };
        let on_lines = |values: &[f64]| {
            divided(values, &|n, k| {
                let share = (start + k * step - time[n]) / (time[n + 1] - time[n]);
                values[n] + (values[n + 1] - values[n]) * share
            })
        };
        self.further.values_mut().for_each(|values| *values = on_lines(values));
        let drives = self.profile.drives.iter().map(|course| on_lines(course)).collect();
        self.profile = Profile { drives, time: divided(time, &|_, k| start + k * step) };
        self.step = Some(step);
        Ok(())
    }
}

/// A row this close to another, in steps, is the same.
const BESIDE: f64 = 1e-3;

/// Reads and checks the profile of a design, with further columns that mechanisms' files name. The design's heaters, if it has any, are on throughout.
///
/// # Errors
/// The fault, in which file, line and column, and how to mend it.
pub fn read_profile(path: &Path, design: &Design, further: &[String]) -> Result<ProfileCase, InputError> {
    read(Rows::open(path, "a profile (*.csv)", Dialect::STANDARD)?, path, None, design, further)
}

/// [`read_profile`] through a map file, which says how the table is written, and names and units of time and chamber; further columns are ignored.
///
/// # Errors
/// As [`read_profile`], and for a map that cannot be that of a profile.
pub fn read_mapped_profile(path: &Path, map: &Path, design: &Design, further: &[String]) -> Result<ProfileCase, InputError> {
    let format = RecordFormat::from_file(map)?;
    let without = [("interval_s", format.interval.is_some()), ("time_of_day", format.time_of_day.is_some())];
    if let Some((field, _)) = without.into_iter().find(|(_, is_said)| *is_said) {
        let problem = "a profile has its instants in one column of numbers";
        let remedy = "take it out; a recording is read with --record, and its chamber drives the coil";
        return Err(InputError { field: Some(field.into()), ..InputError::whole(map, problem, remedy) });
    }
    read(Rows::open(path, "a profile (*.csv)", format.dialect)?, path, Some(&format), design, further)
}

/// Checks a profile that is not in a file: the case that [`read_profile`] would read from a file of this content.
///
/// # Errors
/// As [`read_profile`]; messages call the text `path`.
pub fn check_profile(
    path: &Path,
    table: impl Into<Table>,
    design: &Design,
    further: &[String],
) -> Result<ProfileCase, InputError> {
    read(Rows::of(path, table.into()), path, None, design, further)
}

fn read(
    mut rows: Rows,
    path: &Path,
    map: Option<&RecordFormat>,
    design: &Design,
    further: &[String],
) -> Result<ProfileCase, InputError> {
    rows.header("time_s,chamber_c")?;
    let columns = Columns::read(&rows, map, design, further)?;
    for _ in 0..map.map_or(0, |format| format.dialect.below) {
        rows.advance()?;
    }
    let form = |key: Key| map.map(|format| format.column(key));
    let drives = columns.drives.iter().map(|(column, drive)| {
        let form = form(Key::Chamber).filter(|_| *drive == Drive::Chamber);
        Wanted { form, ..Wanted::temperature(*column, &columns.names[*column]) }
    });
    let beside = columns.further.iter().map(|column| Wanted::number(*column, &columns.names[*column]));
    let read: Vec<Wanted> = drives.chain(beside).collect();
    let time = Wanted { form: form(Key::Time), ..Wanted::number(columns.time, &columns.names[columns.time]) };
    let (time, mut courses) = read_rows(&mut rows, columns.names.len(), &time, &read, (MOST_ROWS, "profile"))?;
    rows.check_commas()?;
    if time.is_empty() {
        return Err(rows.whole_fault("has no row below its header", "give one for each instant, e.g. 0,20.0"));
    }
    let beside = courses.split_off(columns.drives.len());
    let further = further.iter().cloned().zip(beside).collect();
    let mut drives: Vec<Drive> = columns.drives.iter().map(|(_, drive)| *drive).collect();
    if !design.heat.heaters.is_empty() {
        drives.push(Drive::Heaters);
        courses.push(vec![1.0; time.len()]);
    }
    let mut notes = Vec::from_iter(columns.note(path));
    for (key, column) in [(Key::Time, columns.time), (Key::Chamber, columns.drives[0].0)] {
        let note = |form| record_notes::of_column(key, &columns.names[column], form);
        notes.extend(form(key).map_or(Vec::new(), note).into_iter().map(|note| note.at(path)));
    }
    if time.len() == 1 {
        notes.push(Remark::OneRow.note("has one row, in which nothing can happen").at(path));
    }
    let shortest = time.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    if shortest < RESOLVED_S * (1.0 - 1e-6) {
        let problem = format!(
            "rows are as close as {shortest:.6} s; means over less than {RESOLVED_S} s are not reliable just after a jump"
        );
        notes.push(Remark::CloseRows.note(problem).at(path));
    }
    notes.extend(other_unit(&courses[0]).map(|note| note.at(path)));
    Ok(ProfileCase {
        drives,
        profile: Profile { time, drives: courses },
        further,
        inferred: None,
        recorded: None,
        notes,
        fingerprint: rows.fingerprint(),
        between: Between::Linear,
        step: None,
    })
}

/// Note on a chamber whose course seems to be in another unit than \[°C\].
fn other_unit(chamber: &[f64]) -> Option<Note> {
    if chamber.iter().all(|celsius| *celsius > KELVIN_C) {
        let problem = format!("chamber_c never falls below {KELVIN_C} degC; if it is in kelvin, subtract 273.15");
        return Some(Remark::Kelvin.warning(problem));
    }
    let (first, fahrenheit) = (*chamber.first()?, Key::Chamber.unit("degF").ok()?);
    let is_room = |celsius: f64| (ROOM_C[0]..=ROOM_C[1]).contains(&celsius);
    let mistaken = !is_room(first) && is_room(fahrenheit.scale * first + fahrenheit.offset);
    let problem =
        || format!("chamber_c starts at {first} degC; a room has as many degF: if it is in degF, subtract 32 and divide by 1.8");
    mistaken.then(|| Remark::Fahrenheit.warning(problem()))
}

/// A column that is read.
pub(super) struct Wanted<'a> {
    column: usize,
    name: &'a str,
    /// Unit and count, where a map says them.
    form: Option<&'a ColumnFormat>,
    check: fn(&Rows, &str, f64) -> Result<f64, InputError>,
}

impl<'a> Wanted<'a> {
    /// A temperature \[°C\].
    pub(super) fn temperature(column: usize, name: &'a str) -> Self {
        Self { check: temperature, ..Self::number(column, name) }
    }

    /// Any number.
    pub(super) fn number(column: usize, name: &'a str) -> Self {
        Self { column, name, form: None, check: |_, _, value| Ok(value) }
    }

    fn read(&self, rows: &Rows) -> Result<f64, InputError> {
        let value = rows.number(self.column, self.name)?;
        (self.check)(rows, self.name, self.form.map_or(value, |form| form.standard(value)))
    }
}

/// Instants, and the courses of some columns, of at most so many rows below a header of `count` columns.
pub(super) fn read_rows(
    rows: &mut Rows,
    count: usize,
    at_time: &Wanted,
    columns: &[Wanted],
    (most, kind): (usize, &str),
) -> Result<(Vec<f64>, Vec<Vec<f64>>), InputError> {
    let mut time: Vec<f64> = Vec::new();
    let mut courses = vec![Vec::new(); columns.len()];
    while rows.advance()? {
        rows.check_count(count, ",", |line, found| count_remedy(line, found > count))?;
        if time.len() == most {
            return Err(rows.fault(None, format!("more than {most} rows"), format!("split the {kind}, or thin it out")));
        }
        time.push(instant(rows, at_time, time.last().copied())?);
        for (column, course) in columns.iter().zip(&mut courses) {
            course.push(column.read(rows)?);
        }
    }
    Ok((time, courses))
}

fn count_remedy(line: &str, more: bool) -> &'static str {
    if line.contains(';') {
        "separate the fields with commas, not semicolons, and write decimals with a point"
    } else if more {
        "give one number a column, decimals with a point, not a comma"
    } else {
        "complete the row or remove it: between rows the course is linear"
    }
}

fn instant(rows: &Rows, column: &Wanted, last: Option<f64>) -> Result<f64, InputError> {
    let time = column.read(rows)?;
    let fault = |problem: String, remedy: &str| Err(rows.fault(Some(column.name), problem, remedy));
    if time.abs() > MOST_S {
        return fault(format!("{time} s is beyond {MOST_S:e} s"), "give seconds from any start");
    }
    match last {
        Some(last) if time == last => fault(format!("{time} s stands in the row above too"), "keep one of the two rows"),
        Some(last) if time < last => fault(
            format!("{time} s comes before the row above, {last} s"),
            "sort the rows by time, or split the file where the clock restarts",
        ),
        // each of the two is the nearest double to what was written
        Some(last) if time - last < SHORTEST_S - f64::EPSILON * time.abs().max(last.abs()) => fault(
            format!("{time} s is less than {SHORTEST_S:e} s after the row above"),
            "give seconds; remove one of the rows if it is a repeat",
        ),
        _ => Ok(time),
    }
}

fn temperature(rows: &Rows, name: &str, celsius: f64) -> Result<f64, InputError> {
    let fault = |problem: String, remedy: &str| Err(rows.fault(Some(name), problem, remedy));
    if celsius < ABSOLUTE_ZERO_C {
        fault(
            format!("{celsius} degC is below absolute zero, {ABSOLUTE_ZERO_C} degC"),
            "check the sensor and the unit; temperatures are in degC",
        )
    } else if celsius > MOST_C {
        fault(
            format!("{celsius} degC is more than {MOST_C}, the most accepted"),
            "give degrees Celsius; if it is in kelvin, subtract 273.15, if in hundredths of a degree, divide by 100",
        )
    } else {
        Ok(celsius)
    }
}
