//! Conversion between the units of the files and SI: the only place where a factor is applied.
//!
//! Divisions by powers of ten are correctly rounded, so `from_mm(43.5)` is the double nearest to 0.0435.

use std::borrow::Cow;

use laws::Unit;

use bias::units::{DEG_PER_H_PER_RAD_PER_S, S_PER_H, S_PER_MIN};

/// Endings of a case file's key, after the quantity's name.
pub(crate) const SUFFIXES: [&str; 14] =
    ["um", "mm", "m", "mpa", "gpa", "per_k", "w_per_mk", "kg_per_m3", "j_per_kgk", "c", "s", "w", "w_per_m2k", "m2k_per_w"];

/// Micrometres to metres.
pub fn from_um(value: f64) -> f64 {
    value / 1e6
}

/// Metres to micrometres.
pub fn to_um(metres: f64) -> f64 {
    metres * 1e6
}

/// Millimetres to metres.
pub fn from_mm(value: f64) -> f64 {
    value / 1e3
}

/// Metres to millimetres.
pub fn to_mm(metres: f64) -> f64 {
    metres * 1e3
}

/// Megapascals to pascals.
pub fn from_mpa(value: f64) -> f64 {
    value * 1e6
}

/// Pascals to megapascals.
pub fn to_mpa(pascals: f64) -> f64 {
    pascals / 1e6
}

/// Gigapascals to pascals.
pub fn from_gpa(value: f64) -> f64 {
    value * 1e9
}

/// Pascals to gigapascals.
pub fn to_gpa(pascals: f64) -> f64 {
    pascals / 1e9
}

/// 1/K to 10⁻⁶/K.
pub fn to_ppm(ratio: f64) -> f64 {
    ratio * 1e6
}

/// The unit of a mechanism's parameter, by the end of its name; 1 if it has none.
pub fn parameter_unit(name: &str) -> Cow<'static, str> {
    const UNITS: [(&str, &str); 15] = [
        ("_m2k_per_w", "m² K/W"),
        ("_w_per_m2k", "W/(m² K)"),
        ("_w_per_mk", "W/(m K)"),
        ("_j_per_kgk", "J/(kg K)"),
        ("deg_per_h_per_k_per_h", "(deg/h)/(K/h)"),
        ("_deg_per_h_per_k", "(deg/h)/K"),
        ("_deg_per_h", "deg/h"),
        // of what is relative already
        ("_per_k2_relative", "1/K"),
        ("_per_k2", "1/K²"),
        ("_per_k", "1/K"),
        ("_m", "m"),
        ("_c", "degC"),
        ("_k", "K"),
        ("_s", "s"),
        ("_w", "W"),
    ];
    let words = words_of_unit(name);
    // of a longer unit the end says nothing
    let whole = |end: &str| {
        name.ends_with(end) && words.iter().map(|word| word.len() + 1).sum::<usize>() <= end.trim_start_matches('_').len() + 1
    };
    match UNITS.iter().find(|(end, _)| whole(end)) {
        Some((_, unit)) => Cow::Borrowed(unit),
        None => Cow::Owned(unit_of_words(&words)),
    }
}

/// Units whose names are not capital and in no other way like the word in a parameter's name.
const WORDS: [&str; 24] = [
    "K", "W", "mW", "Pa", "hPa", "kPa", "MPa", "GPa", "J", "N", "V", "mV", "A", "mA", "T", "mT", "uT", "G", "Hz", "degC", "deg",
    "rad", "min", "h",
];

fn unit_of_word(word: &str) -> Option<String> {
    let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
    let unit = WORDS.iter().find(|unit| unit.eq_ignore_ascii_case(letters) || letters == "c" && **unit == "degC");
    match (word, unit) {
        ("per", _) => Some("/".to_owned()),
        ("percent", _) => Some("%".to_owned()),
        (_, Some(unit)) => Some(format!("{unit}{}", &word[letters.len()..])),
        _ => ["m", "mm", "um", "s", "ms", "d", "g", "kg", "ppm"].contains(&letters).then(|| word.to_owned()),
    }
}

/// The words that a name ends in which are units, or `per`.
fn words_of_unit(name: &str) -> Vec<&str> {
    let mut words: Vec<&str> = name.rsplit('_').take_while(|word| unit_of_word(word).is_some()).collect();
    words.reverse();
    words
}

/// The unit in words; 1 if there are none.
fn unit_of_words(words: &[&str]) -> String {
    let mut unit = String::new();
    for word in words.iter().filter_map(|word| unit_of_word(word)) {
        let joined = unit.is_empty() || unit.ends_with('/') || word == "/";
        unit.push_str(if joined { "" } else { " " });
        unit.push_str(&word);
    }
    match unit.as_str() {
        "" | "/" => "1".to_owned(),
        over if over.starts_with('/') => format!("1{over}"),
        _ => unit,
    }
}

/// Ending of the name of a number with a unit: `deg_per_h_per_k` for `deg/h/K`; empty for a pure number, or for a text that is no unit.
pub(crate) fn suffix(unit: &str) -> String {
    let words = Unit::words(unit).unwrap_or_default();
    let word = |(name, power): &(&str, f64)| {
        let name = if *name == "%" { "percent".to_owned() } else { name.to_ascii_lowercase().replace("degc", "c") };
        match power.abs() {
            1.0 => name,
            power => format!("{name}{power}").replace('.', "_"),
        }
    };
    let above = words.iter().filter(|(name, power)| *name != "1" && *power > 0.0).map(word);
    let below = words.iter().filter(|(name, power)| *name != "1" && *power < 0.0).map(|unit| format!("per_{}", word(unit)));
    above.chain(below).collect::<Vec<_>>().join("_")
}

/// A unit of a recording's column: value in the standard unit = scale · value + offset.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ColumnUnit {
    pub(crate) names: &'static [&'static str],
    pub(crate) scale: f64,
    /// Added after the factor.
    pub(crate) offset: f64,
    /// Whether it is so rare that it is never suggested.
    pub(crate) is_rare: bool,
}

const fn unit(names: &'static [&'static str], scale: f64, offset: f64) -> ColumnUnit {
    ColumnUnit { names, scale, offset, is_rare: false }
}

const fn rare(names: &'static [&'static str], scale: f64, offset: f64) -> ColumnUnit {
    ColumnUnit { names, scale, offset, is_rare: true }
}

/// Units of instants; the standard one, s, first.
pub(crate) const TIMES: [ColumnUnit; 7] = [
    unit(&["s"], 1.0, 0.0),
    unit(&["ms"], 1e-3, 0.0),
    unit(&["us", "\u{b5}s", "\u{3bc}s"], 1e-6, 0.0),
    unit(&["ns"], 1e-9, 0.0),
    unit(&["min"], S_PER_MIN, 0.0),
    unit(&["h"], S_PER_H, 0.0),
    unit(&["d"], 24.0 * S_PER_H, 0.0),
];

/// Units of temperatures; the standard one, degC, first.
pub(crate) const TEMPERATURES: [ColumnUnit; 5] = [
    unit(&["degC", "\u{b0}C", "C"], 1.0, 0.0),
    unit(&["K"], 1.0, -273.15),
    unit(&["degF", "\u{b0}F", "F"], 5.0 / 9.0, -160.0 / 9.0),
    rare(&["mdegC", "m\u{b0}C"], 1e-3, 0.0),
    rare(&["mK"], 1e-3, -273.15),
];

/// Units of rates; the standard one, deg/h, first.
pub(crate) const RATES: [ColumnUnit; 12] = [
    unit(&["deg/h", "\u{b0}/h", "dph"], 1.0, 0.0),
    unit(&["deg/s", "\u{b0}/s", "dps"], S_PER_H, 0.0),
    unit(&["rad/s"], DEG_PER_H_PER_RAD_PER_S, 0.0),
    unit(&["mrad/s"], 1e-3 * DEG_PER_H_PER_RAD_PER_S, 0.0),
    rare(&["mdeg/s", "m\u{b0}/s", "mdps"], 1e-3 * S_PER_H, 0.0),
    rare(&["udeg/s", "\u{b5}\u{b0}/s", "\u{3bc}\u{b0}/s", "\u{b5}deg/s", "\u{3bc}deg/s"], 1e-6 * S_PER_H, 0.0),
    rare(&["mdeg/h", "m\u{b0}/h"], 1e-3, 0.0),
    rare(&["deg/min", "\u{b0}/min"], S_PER_H / S_PER_MIN, 0.0),
    rare(&["urad/s", "\u{b5}rad/s", "\u{3bc}rad/s"], 1e-6 * DEG_PER_H_PER_RAD_PER_S, 0.0),
    rare(&["nrad/s"], 1e-9 * DEG_PER_H_PER_RAD_PER_S, 0.0),
    // 3600 in a degree, 3600 s in an hour
    rare(&["arcsec/s"], 1.0, 0.0),
    rare(&["rad/h"], DEG_PER_H_PER_RAD_PER_S / S_PER_H, 0.0),
];

/// The unit in which a span of time is shown to people: seconds up to five minutes, minutes up to five hours, hours beyond.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DurationUnit {
    /// Its name.
    pub name: &'static str,
    seconds: f64,
}

impl DurationUnit {
    /// The unit for a span \[s\].
    pub fn of(seconds: f64) -> Self {
        if seconds <= 5.0 * S_PER_MIN {
            Self { name: "s", seconds: 1.0 }
        } else if seconds <= 5.0 * S_PER_H {
            Self { name: "min", seconds: S_PER_MIN }
        } else {
            Self { name: "h", seconds: S_PER_H }
        }
    }

    /// Seconds in this unit.
    pub fn of_seconds(self, seconds: f64) -> f64 {
        seconds / self.seconds
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_name_ends_in_its_unit_and_says_it() {
        for (unit, suffix_of, said) in [
            ("deg/h/K", "deg_per_h_per_k", "(deg/h)/K"),
            ("s", "s", "s"),
            ("1", "", "1"),
            ("1/K2", "per_k2", "1/K²"),
            ("W/(m2 K)", "w_per_m2_per_k", "W/m2/K"),
            ("deg/h/(K/s)", "deg_s_per_h_per_k", "deg s/h/K"),
            ("deg/h/uT", "deg_per_h_per_ut", "deg/h/uT"),
            ("%", "percent", "%"),
            ("degC", "c", "degC"),
            ("K/min", "k_per_min", "K/min"),
            ("1/min", "per_min", "1/min"),
        ] {
            let name = format!("size_{}", suffix(unit));
            assert_eq!((suffix(unit).as_str(), parameter_unit(name.trim_end_matches('_')).as_ref()), (suffix_of, said), "{unit}");
        }
        for (key, said) in [
            ("coil.material.k_r_w_per_mk", "W/(m K)"),
            ("coil.specific_heat_j_per_kgk", "J/(kg K)"),
            // `per` divides by one word alone, and the first word from the end that is no unit ends it
            ("q_deg_s_per_h_per_k_per_k", "deg s/h/K/K"),
            ("q_deg_per_h_per_k2", "deg/h/K2"),
            ("size_per_s_turns", "1"),
        ] {
            assert_eq!(parameter_unit(key), said);
        }
    }
}
