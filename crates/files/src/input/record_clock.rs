//! The instants of a recording: from a column of seconds, from dates, from times of day, or from the rows' number.

use std::borrow::Cow;

use super::InputError;
use super::profile::MOST_S;
use super::record_columns::RecordColumns;
use super::record_format::RecordFormat;
use super::record_gaps::with_gaps;
use super::record_notes::unread_clock;
use super::record_options::Key;
use super::rows::{Rows, quoted};
use super::timestamp::{self, Date, FORMS, First, is_day, slashed, time_of_day};
use super::unit_names::spelled;
use crate::note::Note;
use crate::remark::Remark;

/// Seconds of a day.
const DAY_S: f64 = 86_400.0;

pub(super) struct Clock<'a> {
    column: Option<usize>,
    time_of_day: Option<usize>,
    format: &'a RecordFormat,
    form: Form,
    /// of dates between slashes, the instants by what may stand first; none in an order in which some row is no date
    orders: [(First, Option<Vec<Date>>); 2],
}

/// Form of the instants, by the first row.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Numbers,
    /// Seconds since the first row.
    Dates(Date),
    /// Dates of which nobody says whether the day or the month is first.
    Slashed,
    /// The same, with what the rows together say of it.
    SlashedAs(Option<First>),
    /// Seconds of the day of the first row and of the last, and of the days between \[s\].
    Times {
        first: f64,
        last: f64,
        days: f64,
    },
}

impl<'a> Clock<'a> {
    pub(super) fn new(column: Option<usize>, columns: &RecordColumns, format: &'a RecordFormat) -> Self {
        let orders = [First::Day, First::Month].map(|first| (first, None));
        Self { column, time_of_day: columns.time_of_day, format, form: Form::Numbers, orders }
    }

    /// The instants of all rows \[s\] from those of [`Self::read`]: dates between slashes in the order in which they go on with the smaller jumps. Orders
    /// between which a record's dates do not tell give the same instants.
    pub(super) fn settle(&mut self, read: Vec<f64>) -> Vec<f64> {
        let jumps = |dates: &Vec<Date>| dates.windows(2).map(|w| (w[1].seconds - w[0].seconds).abs()).sum::<f64>();
        let [day, month] = self.orders.each_ref().map(|(_, dates)| dates.as_ref().map_or(f64::INFINITY, jumps));
        if self.form != Form::Slashed {
            return read;
        }
        let chosen = &mut self.orders[usize::from(month < day)];
        let dates = chosen.1.take().unwrap_or_default();
        let instants = dates.iter().map(|date| date.seconds - dates[0].seconds).collect();
        self.form = Form::SlashedAs(if month == day { None } else { Some(chosen.0) });
        instants
    }

    /// Note on instants that are no numbers.
    pub(super) fn note(&self) -> Option<Note> {
        match self.form {
            Form::Numbers => None,
            Form::Dates(_) | Form::Slashed | Form::SlashedAs(None) => {
                Some(Remark::Dates.note("instants are dates; they count from the first row"))
            }
            Form::SlashedAs(Some(first)) => {
                let name = if first == First::Day { "day" } else { "month" };
                let text =
                    format!("instants are dates, the {name} first, as only so they go on evenly; they count from the first row");
                Some(Remark::Dates.note(text))
            }
            Form::Times { .. } => {
                let text =
                    "instants are times of day; they count from the first row, and a day is added where they pass midnight";
                Some(Remark::TimesOfDay.note(text))
            }
        }
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
        let text = match self.time_of_day {
            Some(clock) => Cow::Owned(format!("{} {}", rows.field(column), rows.field(clock))),
            None => Cow::Borrowed(rows.field(column)),
        };
        if number == 0 {
            self.form = first(&text);
            self.orders.iter_mut().for_each(|(_, dates)| *dates = Some(Vec::new()));
        }
        let fault = |(problem, remedy): (&str, &str)| rows.fault(Some(name), format!("{} {problem}", quoted(&text)), remedy);
        let unlike = |what: &str| {
            let problem = format!("{} is not {what} like that of the first row", quoted(&text));
            rows.fault(Some(name), problem, format!("write it like {FORMS}"))
        };
        match self.form {
            Form::Dates(first) => {
                let date = timestamp::date(&text).ok_or_else(|| unlike("a date and time"))?;
                since(self.format, first, date).map_err(fault)
            }
            Form::Slashed | Form::SlashedAs(_) => {
                let mut told = Err(unlike("a date and time"));
                for (order, dates) in &mut self.orders {
                    let Some(dated) = dates else { continue };
                    let first = dated.first().copied();
                    let of = |date: Date| since(self.format, first.unwrap_or(date), date).map(|seconds| (date, seconds));
                    match slashed(&text, *order).map(of) {
                        Some(Ok((date, seconds))) => {
                            dated.push(date);
                            told = told.or(Ok(seconds));
                        }
                        Some(Err(complaint)) => {
                            told = told.or(Err(fault(complaint)));
                            *dates = None;
                        }
                        None => *dates = None,
                    }
                }
                told
            }
            Form::Times { first, last, days } => {
                let now = time_of_day(&text).ok_or_else(|| unlike("a time of day"))?;
                check_unit(self.format, "is a time of day, which has no unit or scale").map_err(fault)?;
                // half a day back is midnight
                let days = if now < last - DAY_S / 2.0 { days + DAY_S } else { days };
                self.form = Form::Times { first, last: now, days };
                Ok(days + now - first)
            }
            Form::Numbers if self.time_of_day.is_some() => Err(not_a_date(rows, name, &text)),
            Form::Numbers => match rows.value(column, name).map_err(|error| not_an_instant(error, &text))? {
                Some(value) => Ok(self.format.column(Key::Time).standard(value)),
                None => Err(rows.fault(Some(name), "is empty", "every row needs an instant; remove the row")),
            },
        }
    }
}

/// A column of instants for which an interval stands, but for its gaps.
pub(super) struct Unread<'a> {
    column: usize,
    clock: Clock<'a>,
    /// Its instants; none if one of them cannot be read.
    instants: Option<Vec<f64>>,
    /// The last digit that its texts show \[s\].
    written: f64,
}

impl<'a> Unread<'a> {
    /// The one of these columns, if there is one.
    pub(super) fn of(columns: &RecordColumns, format: &'a RecordFormat) -> Option<Self> {
        let column = columns.unread_clock?;
        Some(Self {
            column,
            clock: Clock::new(Some(column), columns, format),
            instants: Some(Vec::new()),
            written: f64::INFINITY,
        })
    }

    /// Reads row `number`.
    pub(super) fn read(&mut self, rows: &Rows, columns: &RecordColumns, number: usize) {
        if let Some(mut instants) = self.instants.take() {
            let text = rows.field(columns.time_of_day.unwrap_or(self.column));
            let time = self.clock.format.column(Key::Time);
            let of_number = || (time.unit.scale * time.count).abs() * timestamp::last_digit(text);
            self.written = self.written.min(timestamp::last_digit_of_clock(text).unwrap_or_else(of_number));
            self.instants = self.clock.read(rows, columns, number).ok().map(|instant| {
                instants.push(instant);
                instants
            });
        }
    }

    /// The instants \[s\] that stand for it, later by its gaps, and the note on that and on how it differs from them.
    pub(super) fn settle(mut self, columns: &RecordColumns, time: Vec<f64>) -> (Vec<f64>, Note) {
        let lasts = |time: &[f64]| Some(time.last()? - time.first()?);
        let instants = self.instants.take().map(|instants| self.clock.settle(instants));
        let by_column = instants.as_deref().and_then(lasts);
        let (time, gaps) = match (instants, self.clock.format.interval) {
            (Some(clock), Some(interval)) => with_gaps(time, &clock, interval, self.written),
            _ => (time, 0),
        };
        let note = unread_clock(&columns.names[self.column], gaps, lasts(&time).unwrap_or(0.0), by_column);
        (time, note)
    }
}

/// Refuses unit and scale of instants that have none; an error is problem and remedy.
fn check_unit(format: &RecordFormat, problem: &'static str) -> Result<(), (&'static str, &'static str)> {
    let remedy = "leave out --unit time and --scale time (unit and scale in the map file)";
    if format.column(Key::Time).is_standard(Key::Time) { Ok(()) } else { Err((problem, remedy)) }
}

/// Seconds since the first date; an error is problem and remedy.
fn since(format: &RecordFormat, first: Date, date: Date) -> Result<f64, (&'static str, &'static str)> {
    if !date.exists {
        return Err(("is a day that its month does not have", "check day and month"));
    }
    check_unit(format, "is a date, which has no unit or scale")?;
    match (first.is_zoned, date.is_zoned) {
        (true, false) => Err(("has no zone, but the first instant has one", "give every instant its zone, or none")),
        (false, true) => Err(("has a zone, but the first instant has none", "give every instant its zone, or none")),
        _ => Ok(date.seconds - first.seconds),
    }
}

/// Form of the first instant.
fn first(text: &str) -> Form {
    match (timestamp::date(text), time_of_day(text)) {
        (Some(date), _) => Form::Dates(date),
        (None, None) if timestamp::is_date(text) => Form::Slashed,
        (None, Some(first)) => Form::Times { first, last: first, days: 0.0 },
        (None, None) => Form::Numbers,
    }
}

/// The complaint about date and time of day in two columns that are none.
fn not_a_date(rows: &Rows, name: &str, text: &str) -> InputError {
    let error = rows.fault(Some(name), format!("{} is not a date and a time of day", quoted(text)), "");
    not_an_instant(error, text)
}

/// The complaint about a field that is no number, where it may be a date.
fn not_an_instant(error: InputError, text: &str) -> InputError {
    // of numbers by column there is no text
    if text.is_empty() || text.parse::<f64>().is_ok() || error.remedy.contains("--decimal-comma") {
        return error;
    }
    let remedy = if is_day(text) {
        "if the time of day stands in a column of its own, name it: --time-of-day NAME (time_of_day in the map file)".into()
    } else if spelled(text, Key::Time).is_some() {
        "if the line holds the units, let `fogcoil check RECORD --write-map` find it, or write lines_below_names: 1 into a map file".into()
    } else {
        format!("write seconds like 20.5, or dates like {FORMS}; with no column of instants, --interval SECONDS")
    };
    InputError { remedy, ..error }
}
