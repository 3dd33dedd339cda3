//! Keys in which two designs differ.

use coil::Number;

use crate::input::{CoilCase, keyed};
use crate::output::design_entries;
use crate::sensitivity::tolerance_in_words;
use crate::units::parameter_unit;

/// A key whose values differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Differing {
    /// Key of a coil file.
    pub key: String,
    /// Unit of a number; none of a choice, or of a number without one.
    pub unit: Option<String>,
    /// Value in A and in B, as a coil file writes it; `None` where a design has no such key.
    pub values: [Option<String>; 2],
}

/// Difference of two numbers, relative, that is none: units of files.
const SAME: f64 = 1e-12;

/// Whether two numbers are the same but for rounding.
pub(super) fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

fn is_same_text(a: &str, b: &str) -> bool {
    match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(a), Ok(b)) => is_same(a, b),
        _ => a == b,
    }
}

/// Keys whose values differ, in the order of A's file; those of B alone behind the key that they follow in B.
pub(super) fn differing(cases: [&CoilCase; 2]) -> Vec<Differing> {
    let [a, b] = cases.map(|case| design_entries(&case.design));
    let value = |entries: &[(String, String)], key: &str| entries.iter().find(|(k, _)| k == key).map(|(_, v)| v.clone());
    let mut keys: Vec<String> = a.iter().map(|(key, _)| key.clone()).collect();
    let mut after = 0;
    for (key, _) in &b {
        match keys.iter().position(|known| known == key) {
            Some(at) => after = at + 1,
            None => {
                keys.insert(after, key.clone());
                after += 1;
            }
        }
    }
    let of = |key: String| {
        let values = [value(&a, &key), value(&b, &key)];
        if let [Some(a), Some(b)] = &values
            && is_same_text(a, b)
        {
            return None;
        }
        let number = values.iter().flatten().any(|text| text.parse::<f64>().is_ok());
        // a unit may stand at an outer key: tails_m.cw
        let unit = key.rsplit('.').map(parameter_unit).find(|unit| unit != "1");
        Some(Differing { unit: unit.filter(|_| number).map(std::borrow::Cow::into_owned), key, values })
    };
    keys.into_iter().filter_map(of).collect()
}

/// Keys whose tolerances differ, those that a file leaves out included, in words.
pub(super) fn tolerances(cases: [&CoilCase; 2]) -> Vec<Differing> {
    let of = |number: Number| {
        let (key, _) = cases.iter().find_map(|case| keyed(number, &case.design))?;
        if cases[0].tolerances.of(number) == cases[1].tolerances.of(number) {
            return None;
        }
        // two that are larger than a number can have are one
        let values = cases.map(|case| tolerance_in_words(case, number));
        (values[0] != values[1]).then(|| Differing { key: key.to_owned(), unit: None, values })
    };
    Number::every().filter_map(of).collect()
}
