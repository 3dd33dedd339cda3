//! Which column of a logger's file is what, by the usual words and units in its name.

use super::record_options::Key;
use super::sniff::{Sniffed, is_value};

/// Words in names of columns, in lower case; those of up to three letters stand alone.
fn words(key: Key) -> &'static [&'static str] {
    match key {
        Key::Time => &["time", "zeit", "date", "datum", "elapsed", "stamp", "seconds", "temps"],
        Key::Chamber => &["chamber", "kammer", "oven", "ofen", "ambient", "umgebung", "enceinte", "climat", "klima", "air"],
        Key::Spool => &["spool", "spule", "coil", "hub", "bobbin", "bobine", "wickel"],
        Key::Rate => &["rate", "gyro", "omega", "angular", "fog", "rotation", "winkelgeschw"],
    }
}

/// Words of what is asked for, not measured, and of what goes with a channel.
const BESIDE: [&str; 9] = ["set", "setpoint", "soll", "sollwert", "target", "alarm", "status", "limit", "consigne"];

/// Units as loggers write them, in lower case without blanks, and as the program does.
fn spellings(key: Key) -> &'static [(&'static str, &'static str)] {
    match key {
        Key::Time => &[
            ("s", "s"),
            ("sec", "s"),
            ("secs", "s"),
            ("second", "s"),
            ("seconds", "s"),
            ("sek", "s"),
            ("sekunden", "s"),
            ("ms", "ms"),
            ("msec", "ms"),
            ("us", "us"),
            ("\u{b5}s", "us"),
            ("\u{3bc}s", "us"),
            ("usec", "us"),
            ("ns", "ns"),
            ("min", "min"),
            ("minutes", "min"),
            ("h", "h"),
            ("hr", "h"),
            ("hrs", "h"),
            ("hours", "h"),
        ],
        Key::Chamber | Key::Spool => &[
            ("degc", "degC"),
            ("\u{b0}c", "degC"),
            ("\u{ba}c", "degC"),
            ("c", "degC"),
            ("celsius", "degC"),
            ("deg_c", "degC"),
            ("k", "K"),
            ("kelvin", "K"),
            ("degf", "degF"),
            ("\u{b0}f", "degF"),
            ("\u{ba}f", "degF"),
            ("f", "degF"),
            ("fahrenheit", "degF"),
            ("deg_f", "degF"),
        ],
        Key::Rate => &[
            ("deg/h", "deg/h"),
            ("\u{b0}/h", "deg/h"),
            ("deg/hr", "deg/h"),
            ("\u{b0}/hr", "deg/h"),
            ("deg/hour", "deg/h"),
            ("dph", "deg/h"),
            ("deg_per_h", "deg/h"),
            ("deg_h", "deg/h"),
            ("grad/h", "deg/h"),
            ("deg/s", "deg/s"),
            ("\u{b0}/s", "deg/s"),
            ("deg/sec", "deg/s"),
            ("dps", "deg/s"),
            ("deg_per_s", "deg/s"),
            ("deg_s", "deg/s"),
            ("grad/s", "deg/s"),
            ("mrad/s", "mrad/s"),
            ("mrad_per_s", "mrad/s"),
            ("rad/s", "rad/s"),
            ("rad/sec", "rad/s"),
            ("rad_per_s", "rad/s"),
            ("rad_s", "rad/s"),
        ],
    }
}

/// A column that was found.
pub(super) struct Found {
    /// Its number.
    pub(super) column: usize,
    /// The unit that its name says.
    pub(super) unit: Option<&'static str>,
    /// Others that it may be.
    pub(super) others: Vec<usize>,
}

/// The column of a key, if there seems to be one.
pub(super) fn find(table: &Sniffed, key: Key) -> Option<Found> {
    let fits = |column: &usize| is_of(&table.names[*column], key) && holds_values(table, *column);
    let mut candidates: Vec<usize> = (0..table.names.len()).filter(fits).collect();
    let standard = |column: &usize| table.names[*column] != key.standard();
    // a unit that is said speaks for a column
    candidates.sort_by_key(|column| (standard(column), unit(&table.names[*column], key).is_none()));
    let (column, others) = candidates.split_first()?;
    Some(Found { column: *column, unit: unit(&table.names[*column], key), others: others.to_vec() })
}

fn holds_values(table: &Sniffed, column: usize) -> bool {
    table.rows.iter().any(|row| is_value(&row[column], table.decimal_comma))
}

fn is_of(name: &str, key: Key) -> bool {
    let lower = name.to_lowercase();
    let bare = match bracketed(&lower) {
        Some((bare, _)) => bare,
        None => &lower,
    };
    let tokens: Vec<&str> = bare.split(|c: char| !c.is_alphanumeric()).collect();
    let says = |word: &&str| if word.len() <= 3 { tokens.contains(word) } else { bare.contains(*word) };
    let other_unit = || Key::ALL.into_iter().any(|other| other.units() != key.units() && unit(name, other).is_some());
    let symbol = key == Key::Time && bare.trim() == "t";
    (symbol || words(key).iter().any(says))
        && !BESIDE.iter().any(|word| tokens.contains(word))
        && (unit(name, key).is_some() || !other_unit())
}

/// A name that ends in brackets, and what is in them.
fn bracketed(name: &str) -> Option<(&str, &str)> {
    [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| name.trim_end().strip_suffix(close)?.rsplit_once(open))
}

/// The unit that a name ends in: in brackets, or behind a last line or blank.
fn unit(name: &str, key: Key) -> Option<&'static str> {
    let lower = name.to_lowercase();
    let is = |text: &str| {
        let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        spellings(key).iter().find(|(spelling, _)| *spelling == text).map(|(_, unit)| *unit)
    };
    match bracketed(&lower) {
        Some((_, unit)) => is(unit),
        // the longest ending: rad/s before s
        None => lower.match_indices(['_', ' ', ',', '/']).filter_map(|(at, _)| is(&lower[at + 1..])).next(),
    }
}
