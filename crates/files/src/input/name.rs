//! Names as they are read, and the likely meaning of a misspelt one.

use std::borrow::Cow;

use serde::{Deserialize, Deserializer};

use crate::shown;

/// Reads a name; a character that a terminal would obey becomes its escape.
pub(super) fn printable<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Cow::<str>::deserialize(deserializer).map(|name| shown(&name))
}

/// Likeness, by Jaro and Winkler's measure, from which a name is taken for a slip of another: with it `polarization` and `polarisation-ripple`
/// are alike, `tails_m` and `turns` are not.
const ALIKE: f64 = 0.85;

/// Letters of a name from which another that begins with it is meant.
const BEGUN: usize = 3;

/// The one known name that goes on where `name` ends; of several, the one that goes on with an underscore.
fn begun<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    let goes_on: Vec<&str> = known.iter().copied().filter(|other| name.len() >= BEGUN && other.starts_with(name)).collect();
    let apart: Vec<&str> = goes_on.iter().copied().filter(|other| other[name.len()..].starts_with('_')).collect();
    match (&goes_on[..], &apart[..]) {
        ([one], _) | (_, [one]) => Some(one),
        _ => None,
    }
}

/// ", did you mean ...?" where a known name begins with one that is not known, or where one of the known names is much like a name that is not known; otherwise nothing.
pub fn meant<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let likeness = |other: &&str| strsim::jaro_winkler(name, other);
    let known: Vec<&str> = known.into_iter().collect();
    let nearest = || known.iter().copied().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let meant = begun(name, &known).or_else(|| nearest().filter(|other| likeness(other) >= ALIKE));
    meant.map_or(String::new(), |other| format!("; did you mean `{other}`?"))
}

#[cfg(test)]
mod tests {
    use super::meant;

    #[test]
    fn a_slip_is_told_from_another_word() {
        let known = ["polarisation-ripple", "tails_m", "e_r_mpa", "e_z_gpa"];
        assert_eq!(meant("polarization", known), "; did you mean `polarisation-ripple`?");
        assert_eq!(meant("e_r_gpa", known), "; did you mean `e_r_mpa`?");
        assert_eq!(meant("tail", known), "; did you mean `tails_m`?");
        for other in ["turns", "moisture", "", "x"] {
            assert_eq!(meant(other, known), "", "{other}");
        }
        assert_eq!(meant("tail", []), "");
        // a key without its unit is meant, whatever is alike besides
        let keys = ["coil.material.e_z_gpa", "coil.material.e_r_mpa", "coil.material.nu_r", "coil.material.alpha_r_per_k"];
        assert_eq!(meant("coil.material.e_r", keys), "; did you mean `coil.material.e_r_mpa`?");
        assert_eq!(meant("coil.material.alpha", keys), "; did you mean `coil.material.alpha_r_per_k`?");
    }
}
