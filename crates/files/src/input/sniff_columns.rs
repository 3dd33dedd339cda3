//! Meaning of a logger's columns, by the usual words and units in their names.

use super::record_options::Key;
use super::sniff::{Sniffed, is_value};
use super::timestamp::{is_date, is_day, time_of_day};
use super::unit_names::{bracketed, ending, foreign, is_long, is_temperature, parted, spelled};

/// Words in names of columns, in lower case; those of up to three letters stand alone.
fn words(key: Key) -> &'static [&'static str] {
    match key {
        Key::Time => &["time", "zeit", "date", "datum", "elapsed", "stamp", "seconds", "temps", "uhrzeit"],
        Key::Chamber => &["chamber", "kammer", "oven", "ofen", "ambient", "umgebung", "enceinte", "climat", "klima", "air"],
        Key::Spool => &["spool", "spule", "coil", "hub", "bobbin", "bobine", "wickel", "nabe", "moyeu"],
        Key::Rate => &["rate", "gyro", "omega", "angular", "fog", "rotation", "winkelgeschw", "kreisel", "drehrate"],
    }
}

/// Words for set points, not measurements, and for side columns of a channel.
const BESIDE: [&str; 9] = ["set", "setpoint", "soll", "sollwert", "target", "alarm", "status", "limit", "consigne"];

/// A column that was found.
pub(super) struct Found {
    /// Its number.
    pub(super) column: usize,
    /// The unit that its name, or a line below it, says.
    pub(super) unit: Option<&'static str>,
    /// Text in its name at the place of a unit that is none.
    pub(super) foreign: Option<String>,
    /// Other columns that it may be.
    pub(super) others: Vec<usize>,
}

/// The column of a key, if there seems to be one.
pub(super) fn find(table: &Sniffed, key: Key) -> Option<Found> {
    let is = |column: usize| is_of(&table.names[column], key) || key == Key::Time && is_counted(table, column);
    let fits = |column: &usize| is(*column) && holds_values(table, *column);
    let mut candidates: Vec<usize> = (0..table.names.len()).filter(fits).collect();
    let standard = |column: &usize| table.names[*column] != key.standard();
    // a unit that is said speaks for a column, a word more; a day alone is no instant
    candidates.sort_by_key(|&column| {
        let says = says(&table.names[column], key);
        (standard(&column), holds(table, column, is_day), !says, unit(table, column, key).is_none())
    });
    let (column, others) = candidates.split_first()?;
    Some(Found { others: others.to_vec(), ..Found::of(table, *column, key) })
}

impl Found {
    /// The column of a key by its number.
    pub(super) fn of(table: &Sniffed, column: usize, key: Key) -> Self {
        let foreign = foreign(&table.names[column], key).map(str::to_owned);
        Self { column, unit: unit(table, column, key), foreign, others: Vec::new() }
    }
}

/// Columns that may be a key's for all that their names say, none of those that are `taken`: numbers that increase, or dates, as the time; other numbers
/// as a rate.
pub(super) fn perhaps(table: &Sniffed, key: Key, taken: &[usize]) -> Vec<usize> {
    let is = |column: &usize| match key {
        Key::Time => increases(table, *column) || holds(table, *column, |field| is_instant(field) || is_day(field)),
        _ => holds(table, *column, |field| number(field).is_some()) && !is_temperature(&table.names[*column]),
    };
    (0..table.names.len()).filter(|column| !taken.contains(column) && is(column)).collect()
}

/// Whether a field is an instant that is no number.
pub(super) fn is_instant(field: &str) -> bool {
    is_date(field) || time_of_day(field).is_some()
}

/// Columns, none of those that are `taken`, that seem to hold instants in a form that is not read: numbers between other signs, each row another.
pub(super) fn unread_instants(table: &Sniffed, taken: &[usize]) -> Vec<usize> {
    let seems = |field: &str| {
        let numbers = field.split(|c: char| !c.is_ascii_digit()).filter(|digits| !digits.is_empty());
        number(field).is_none() && numbers.count() >= INSTANT_NUMBERS
    };
    let differ = |column: usize| table.rows.windows(2).all(|rows| rows[0][column] != rows[1][column]);
    let is = |column: &usize| !taken.contains(column) && holds(table, *column, seems) && differ(*column);
    (0..table.names.len()).filter(is).collect()
}

/// Fewest numbers in an instant that is no number itself: a day, hours and minutes.
const INSTANT_NUMBERS: usize = 3;

fn number(field: &str) -> Option<f64> {
    field.trim().replace(',', ".").parse().ok()
}

/// Whether a column's numbers increase from each row to the next.
fn increases(table: &Sniffed, column: usize) -> bool {
    let values: Vec<f64> = table.rows.iter().map(|row| number(&row[column]).unwrap_or(f64::NAN)).collect();
    values.len() > 1 && values.windows(2).all(|pair| pair[1] > pair[0])
}

/// Whether a column holds dates as numbers of days since 1900, of the years 1968 to 2105: with the decimals that seconds need, and rows closer than an hour.
pub(super) fn are_days(table: &Sniffed, column: usize) -> bool {
    let fields = || table.rows.iter().map(|row| row[column].trim());
    let is_day = |field: &str| number(field).is_some_and(|day| (25_000.0..75_000.0).contains(&day));
    let decimals = |field: &str| field.split_once(['.', ',']).map_or(0, |(_, decimals)| decimals.len());
    let values: Vec<f64> = fields().filter_map(number).collect();
    fields().all(is_day)
        && fields().any(|field| decimals(field) >= DAY_DECIMALS)
        && values.windows(2).all(|pair| (0.0..1.0 / 24.0).contains(&(pair[1] - pair[0])))
}

/// Decimals of a day that tell seconds.
const DAY_DECIMALS: usize = 5;

/// Whether a name says that a column holds counts.
pub(super) fn is_counts(name: &str) -> bool {
    tokens(&name.to_lowercase()).iter().any(|token| ["count", "counts", "cnt", "lsb", "raw", "adc"].contains(token))
}

/// Whether a column counts in a unit of time by the end of its name alone, like `t_min` or `Minutes`: then its numbers must increase.
fn is_counted(table: &Sniffed, column: usize) -> bool {
    let says = |(bare, text, _): (&str, &str, _)| bare.trim().eq_ignore_ascii_case("t") || is_long(text);
    parted(&table.names[column], Key::Time).is_some_and(says) && increases(table, column)
}

/// Columns that hold date and time of day, if there are such.
pub(super) fn date_and_time(table: &Sniffed) -> Option<(usize, usize)> {
    let find = |is: fn(&str) -> bool| (0..table.names.len()).find(|column| holds(table, *column, is));
    Some((find(is_day)?, find(|field| time_of_day(field).is_some())?))
}

/// Temperatures that are measured and are none of those that are `taken`.
pub(super) fn unused_temperatures(table: &Sniffed, taken: &[usize]) -> Vec<usize> {
    let measured = |name: &str| !name.to_lowercase().split(|c: char| !c.is_alphanumeric()).any(|word| BESIDE.contains(&word));
    let is = |column: &usize| {
        let name = &table.names[*column];
        let says = is_temperature(name) || table.units.get(*column).is_some_and(|unit| spelled(unit, Key::Chamber).is_some());
        says && measured(name) && holds_values(table, *column) && !taken.contains(column)
    };
    (0..table.names.len()).filter(is).collect()
}

/// Columns that may be temperatures for all that their names say, none of those that are `taken`: numbers of that size, without a unit.
pub(super) fn perhaps_temperatures(table: &Sniffed, taken: &[usize]) -> Vec<usize> {
    /// Temperatures of a chamber \[°C\].
    const USUAL: std::ops::RangeInclusive<f64> = -100.0..=200.0;
    let is = |column: &usize| {
        let unit =
            bracketed(&table.names[*column]).is_some() || table.units.get(*column).is_some_and(|unit| !unit.trim().is_empty());
        let values: Vec<Option<f64>> = table.rows.iter().map(|row| number(&row[*column])).collect();
        !unit && !taken.contains(column) && !values.is_empty() && values.iter().all(|v| v.is_some_and(|v| USUAL.contains(&v)))
    };
    (0..table.names.len()).filter(is).collect()
}

/// The unit that a column's name says, or a line below the names.
pub(super) fn unit(table: &Sniffed, column: usize, key: Key) -> Option<&'static str> {
    let below = || spelled(table.units.get(column)?.trim_matches(['[', ']', '(', ')']), key);
    ending(&table.names[column], key).or_else(below).map(|unit| unit.names[0])
}

/// Whether all rows of a column are such.
pub(super) fn holds(table: &Sniffed, column: usize, is: impl Fn(&str) -> bool) -> bool {
    table.rows.iter().all(|row| is(&row[column]))
}

fn holds_values(table: &Sniffed, column: usize) -> bool {
    table.rows.iter().any(|row| is_value(&row[column]))
}

/// A name in lower case without its unit.
fn bare(lower: &str) -> &str {
    bracketed(lower).map_or(lower, |(bare, _)| bare)
}

fn tokens(bare: &str) -> Vec<&str> {
    bare.split(|c: char| !c.is_alphanumeric()).collect()
}

/// Whether a name says by a word that the column is a key's.
fn says(name: &str, key: Key) -> bool {
    let lower = name.to_lowercase();
    let bare = bare(&lower);
    let tokens = tokens(bare);
    let says = |word: &&str| if word.len() <= 3 { tokens.contains(word) } else { bare.contains(*word) };
    (key == Key::Time && (bare.trim() == "t" || bare.starts_with("t/"))) || words(key).iter().any(says)
}

fn is_of(name: &str, key: Key) -> bool {
    let other_unit = || Key::ALL.into_iter().any(|other| other.units() != key.units() && ending(name, other).is_some());
    let unit = ending(name, key).is_some();
    // no other quantity of a record is told in deg/h or deg/s
    (says(name, key) || key == Key::Rate && unit)
        && !tokens(bare(&name.to_lowercase())).iter().any(|token| BESIDE.contains(token))
        && (unit || !other_unit())
}
