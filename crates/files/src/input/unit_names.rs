//! Units in the names of columns, as loggers write them.

use super::record_options::Key;
use crate::units::ColumnUnit;

/// Units as loggers write them, in lower case without blanks, and as the program does.
fn spellings(key: Key) -> &'static [(&'static str, &'static str)] {
    match key {
        Key::Time => TIMES,
        Key::Chamber | Key::Spool => TEMPERATURES,
        Key::Rate => RATES,
    }
}

const TIMES: &[(&str, &str)] = &[
    ("sec", "s"),
    ("secs", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("sek", "s"),
    ("sekunden", "s"),
    ("msec", "ms"),
    ("milliseconds", "ms"),
    ("usec", "us"),
    ("minute", "min"),
    ("minutes", "min"),
    ("minuten", "min"),
    ("hr", "h"),
    ("hrs", "h"),
    ("std", "h"),
    ("hour", "h"),
    ("hours", "h"),
    ("stunden", "h"),
    ("day", "d"),
    ("days", "d"),
    ("tage", "d"),
];

const TEMPERATURES: &[(&str, &str)] = &[
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
];

const RATES: &[(&str, &str)] = &[
    ("deg/hr", "deg/h"),
    ("\u{b0}/hr", "deg/h"),
    ("deg/hour", "deg/h"),
    ("deg_per_h", "deg/h"),
    ("deg_h", "deg/h"),
    ("deg_per_hr", "deg/h"),
    ("deg_per_hour", "deg/h"),
    ("deg_hr", "deg/h"),
    ("grad/h", "deg/h"),
    ("\u{b0}/s", "deg/s"),
    ("\u{b0}/h", "deg/h"),
    ("deg/sec", "deg/s"),
    ("\u{b0}/sec", "deg/s"),
    ("dps", "deg/s"),
    ("deg_per_s", "deg/s"),
    ("deg_s", "deg/s"),
    ("deg_per_sec", "deg/s"),
    ("grad/s", "deg/s"),
    ("deg_per_min", "deg/min"),
    ("rad/sec", "rad/s"),
    ("rad_per_s", "rad/s"),
    ("rad_s", "rad/s"),
    ("arcsec_per_s", "arcsec/s"),
];

/// Prefixes as loggers write them, in lower case, and as the program does.
const PREFIXES: [(char, &str); 5] = [('m', "m"), ('u', "u"), ('\u{b5}', "u"), ('\u{3bc}', "u"), ('n', "n")];

/// Words that often stand in round brackets and are no units, in lower case.
const NO_UNITS: [&str; 14] = ["raw", "utc", "gmt", "cet", "mez", "set", "ist", "soll", "avg", "mean", "max", "min", "x", "z"];

/// The unit that a text is, if it is one of the key's.
pub(super) fn spelled(text: &str, key: Key) -> Option<ColumnUnit> {
    let text: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    let lower = text.to_lowercase();
    let plain = |lower: &str| spellings(key).iter().find(|(spelling, _)| *spelling == lower).map(|(_, name)| *name);
    let small = |name: &str| key.units().iter().find(|unit| unit.names.iter().any(|own| own.to_lowercase() == name)).copied();
    let prefixed = || {
        let (letter, prefix) = PREFIXES.into_iter().find(|(letter, _)| lower.starts_with(*letter))?;
        let rest = lower.strip_prefix(letter).filter(|rest| rest.chars().count() > 1)?;
        key.unit(&format!("{prefix}{}", plain(rest)?)).ok()
    };
    key.unit(&text)
        .ok()
        .or_else(|| small(&lower))
        .or_else(|| plain(&lower).and_then(|name| key.unit(name).ok()))
        .or_else(prefixed)
}

/// A name that ends in brackets, and what is in them.
pub(super) fn bracketed(name: &str) -> Option<(&str, &str)> {
    [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| name.trim_end().strip_suffix(close)?.rsplit_once(open))
}

/// The unit that a column's name ends in.
pub(super) fn ending(name: &str, key: Key) -> Option<ColumnUnit> {
    parted(name, key).map(|(.., unit)| unit)
}

/// A column's name without the unit that it ends in, the text of that unit, and the unit: in brackets, behind a low line, a blank, a comma or a slash, or
/// the whole name if it is a word like `Minutes`.
pub(super) fn parted(name: &str, key: Key) -> Option<(&str, &str, ColumnUnit)> {
    if let Some((bare, text)) = bracketed(name) {
        return Some((bare, text, spelled(text, key)?));
    }
    // the longest ending: rad/s before s
    let behind = |(at, _): (usize, &str)| Some((&name[..at], &name[at + 1..], spelled(&name[at + 1..], key)?));
    let whole = || Some(("", name, spelled(name, key).filter(|_| is_long(name))?));
    name.match_indices(['_', ' ', ',', '/']).find_map(behind).or_else(whole)
}

/// Whether the text of a unit is a word that stands for nothing else, not a letter or `min`.
pub(super) fn is_long(unit: &str) -> bool {
    unit.trim().chars().count() > 3
}

/// Text in brackets of a column's name that seems to be a unit and is none of the key's.
pub(super) fn foreign(name: &str, key: Key) -> Option<&str> {
    let (bare, text) = bracketed(name)?;
    let (text, lower) = (text.trim(), text.trim().to_lowercase());
    let round = !name[bare.len()..].starts_with('[');
    let like_a_unit = lower.contains(['/', '\u{b0}', '%']) || lower.contains("deg") || lower.chars().count() <= 3;
    let is_word = NO_UNITS.contains(&lower.as_str()) || !like_a_unit;
    let none = text.is_empty() || text.chars().all(|c| c.is_ascii_digit()) || round && is_word;
    (!none && spelled(text, key).is_none()).then_some(text)
}

/// Whether a column's name says that it is a temperature.
pub(super) fn is_temperature(name: &str) -> bool {
    let lower = name.to_lowercase();
    match bracketed(name) {
        Some((_, unit)) => spelled(unit, Key::Chamber).is_some(),
        None => {
            let long =
                |(at, _): (usize, &str)| name[at + 1..].chars().count() > 1 && spelled(&name[at + 1..], Key::Chamber).is_some();
            lower.contains("temp") && !lower.contains("temps") || name.match_indices(['_', ' ', ',']).any(long)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Key, foreign, is_temperature, spelled};

    #[test]
    fn exact_units_are_heard_as_loggers_write_them() {
        for (key, text, name) in [
            (Key::Rate, "mdeg/s", "mdeg/s"),
            (Key::Rate, "m\u{b0}/s", "mdeg/s"),
            (Key::Rate, "mDeg/sec", "mdeg/s"),
            (Key::Rate, "mdeg/hr", "mdeg/h"),
            (Key::Rate, "\u{b5}rad/s", "urad/s"),
            (Key::Rate, "\u{3bc}rad / sec", "urad/s"),
            (Key::Rate, "mrad/sec", "mrad/s"),
            (Key::Rate, "\u{b0}/h", "deg/h"),
            (Key::Rate, "arcsec/s", "arcsec/s"),
            (Key::Time, "MS", "ms"),
            (Key::Time, "days", "d"),
            (Key::Chamber, "\u{ba}C", "degC"),
            (Key::Chamber, "mK", "mK"),
            (Key::Spool, "f", "degF"),
        ] {
            assert_eq!(spelled(text, key).unwrap().names[0], name, "{text}");
        }
        for (key, text) in [(Key::Rate, "xyz"), (Key::Rate, "K"), (Key::Chamber, "s"), (Key::Time, "mmin"), (Key::Rate, "")] {
            assert_eq!(spelled(text, key), None, "{text}");
        }
        assert_eq!(spelled("mdeg/s", Key::Rate).unwrap().scale, 3.6);
    }

    #[test]
    fn what_is_no_unit_here_is_told_from_what_is_no_unit() {
        for (name, text) in
            [("Rate [xyz]", "xyz"), ("Rate [foo bar]", "foo bar"), ("Rate (mV)", "mV"), ("Rate (counts/s)", "counts/s")]
        {
            assert_eq!(foreign(name, Key::Rate), Some(text), "{name}");
        }
        for name in ["Rate [deg/s]", "Rate (filtered)", "Rate (raw)", "rate", "rate (1)", "Rate []"] {
            assert_eq!(foreign(name, Key::Rate), None, "{name}");
        }
        for (name, is) in
            [("101 (C)", true), ("T1_degC", true), ("Temp 3", true), ("Temps", false), ("gain_c", false), ("U (V)", false)]
        {
            assert_eq!(is_temperature(name), is, "{name}");
        }
    }
}
