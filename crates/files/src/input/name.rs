//! Names as they are read, and those that were likely meant.

use std::borrow::Cow;

use serde::{Deserialize, Deserializer};

use crate::shown;

/// Reads a name; what a terminal would obey becomes its escape.
pub(super) fn printable<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Cow::<str>::deserialize(deserializer).map(|name| shown(&name))
}

/// Likeness, by Jaro and Winkler's measure, from which a name is taken for a slip of another: with it `polarization` and `polarisation-ripple`
/// are alike, `tails_m` and `turns` are not.
const ALIKE: f64 = 0.85;

/// ", did you mean ...?" where one of the known names is much like a name that is not known; otherwise nothing.
pub fn meant<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let likeness = |other: &&str| strsim::jaro_winkler(name, other);
    let nearest = known.into_iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    nearest.filter(|other| likeness(other) >= ALIKE).map_or(String::new(), |other| format!("; did you mean `{other}`?"))
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
    }
}
