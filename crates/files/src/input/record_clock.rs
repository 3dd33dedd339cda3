//! The instants of a recording: from a column of seconds, from dates, or from the rows' number.

use super::InputError;
use super::profile::MOST_S;
use super::record_columns::RecordColumns;
use super::record_format::RecordFormat;
use super::record_options::Key;
use super::rows::{Rows, quoted};
use super::timestamp::{self, Date, FORMS, is_ambiguous};

pub(super) struct Clock<'a> {
    column: Option<usize>,
    format: &'a RecordFormat,
    /// First instant of dates, from which the others count.
    first: Option<Date>,
}

impl<'a> Clock<'a> {
    pub(super) fn new(columns: &RecordColumns, format: &'a RecordFormat) -> Self {
        Self { column: columns.column(Key::Time), format, first: None }
    }

    /// Whether instants are dates.
    pub(super) fn counts_dates(&self) -> bool {
        self.first.is_some()
    }

    /// The instant of row `number` \[s\].
    pub(super) fn read(&mut self, rows: &Rows, columns: &RecordColumns, number: usize) -> Result<f64, InputError> {
        let (time, name) = match self.column {
            Some(column) => (self.of_column(rows, column, &columns.names[column], number)?, columns.names[column].as_str()),
            None => (number as f64 * self.format.interval.unwrap_or(1.0), "--interval"),
        };
        if time.abs() > MOST_S {
            let remedy = "give seconds from any start, or their unit: --unit time=UNIT (unit in the map file)";
            return Err(rows.fault(Some(name), format!("{time:e} s is beyond {MOST_S:e} s"), remedy));
        }
        Ok(time)
    }

    fn of_column(&mut self, rows: &Rows, column: usize, name: &str, number: usize) -> Result<f64, InputError> {
        let text = rows.field(column);
        if (number == 0 || self.first.is_some())
            && let Some(date) = timestamp::date(text)
        {
            return self
                .of_date(date)
                .map_err(|(problem, remedy)| rows.fault(Some(name), format!("{} {problem}", quoted(text)), remedy));
        }
        if self.first.is_some() {
            let problem = format!("{} is not a date and time like that of the first row", quoted(text));
            return Err(rows.fault(Some(name), problem, format!("write it like {FORMS}")));
        }
        match rows.value(column, name).map_err(|error| not_an_instant(error, text))? {
            Some(value) => Ok(self.format.column(Key::Time).standard(value)),
            None => Err(rows.fault(Some(name), "is empty", "every row needs an instant; remove the row")),
        }
    }

    /// Seconds since the first date; an error is problem and remedy.
    fn of_date(&mut self, date: Date) -> Result<f64, (&'static str, &'static str)> {
        if !date.exists {
            return Err(("is a day that its month does not have", "check day and month"));
        }
        if !self.format.column(Key::Time).is_standard(Key::Time) {
            let remedy = "leave out --unit time and --scale time (unit and scale in the map file)";
            return Err(("is a date, which has no unit or scale", remedy));
        }
        let first = *self.first.get_or_insert(date);
        match (first.is_zoned, date.is_zoned) {
            (true, false) => Err(("has no zone, but the first instant has one", "give every instant its zone, or none")),
            (false, true) => Err(("has a zone, but the first instant has none", "give every instant its zone, or none")),
            _ => Ok(date.seconds - first.seconds),
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
