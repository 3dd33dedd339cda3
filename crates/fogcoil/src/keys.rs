//! Constants in the keys of a coil file.

use coil::{Design, Number};
use files::input::keyed;
use mechanisms::{number_of, with_constant};

/// The key of the constant of this name, one of `all`, and its value in the key's unit, where the others have their stated values and this one the
/// value `told`; `None` for a name that is none of the design's. For tails it is the difference, which alone a record determines.
pub(crate) fn by_key<'n>(
    design: &Design,
    all: impl Iterator<Item = (&'n str, f64)>,
    name: &str,
    told: f64,
) -> Option<(&'static str, f64)> {
    let number = number_of(name)?;
    if number == Number::Tail {
        return Some((keyed(number, design)?.0, told));
    }
    // a key may depend on more than one constant: G follows E_r
    let put =
        |design: Design, (other, value): (&str, f64)| with_constant(&design, other, if other == name { told } else { value });
    keyed(number, &all.filter(|(other, _)| number_of(other).is_some()).try_fold(design.clone(), put)?)
}

/// The key of the constant of this name, the value and both ends of an interval, in the key's unit.
pub(crate) fn interval_by_key<'n>(
    design: &Design,
    all: impl Iterator<Item = (&'n str, f64)> + Clone,
    name: &str,
    [value, low, high]: [f64; 3],
) -> Option<(&'static str, f64, [f64; 2])> {
    let of = |told: f64| by_key(design, all.clone(), name, told);
    let ((key, value), (_, low), (_, high)) = (of(value)?, of(low)?, of(high)?);
    Some((key, value, [low.min(high), low.max(high)]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_are_told_in_the_units_of_their_keys() {
        let reference = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron");
        let design = crate::input::read_coil(reference.as_ref()).unwrap().design;
        let all = [("E_r and G", 1.1), ("G/E_r", 1.05), ("hub thickness [mm]", 4.05), ("dn/dT", 1.0), ("gain of the rate", 1.0)];
        let of = |name: &str, told: f64| by_key(&design, all.into_iter(), name, told).unwrap();
        let near = |(key, value): (&str, f64), expected: (&str, f64)| {
            assert!(key == expected.0 && (value / expected.1 - 1.0).abs() < 1e-12, "{key} {value} {expected:?}");
        };
        near(of("E_r and G", 1.1), ("coil.material.e_r_mpa", 1.1 * 95.2));
        // G is what both leave of it
        near(of("G/E_r", 1.05), ("coil.material.g_zr_mpa", 1.1 * 1.05 * 24.1));
        near(of("hub thickness [mm]", 4.05), ("spool.hub_thickness_mm", 4.05));
        near(of("dn/dT", 0.9), ("optics.thermo_optic_per_k", 0.9 * design.optics.thermo_optic));
        near(of("CW tail less CCW tail, beyond the drawing's [m]", 0.4), ("winding.tails_m", 0.4));
        assert_eq!(by_key(&design, all.into_iter(), "gain of the rate", 1.0), None);
        let (key, value, [low, high]) = interval_by_key(&design, all.into_iter(), "E_r and G", [1.1, 1.2, 1.0]).unwrap();
        assert!(key == "coil.material.e_r_mpa" && low < value && value < high);
    }
}
