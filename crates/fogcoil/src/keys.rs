//! Constants as the keys of a coil file tell them.

use coil::{Design, Number};
use files::input::keyed;
use mechanisms::{number_of, with_constant};

/// The key of the constant of this name, and its value in the key's unit where `all` constants have the values told of them, but this one the
/// value `told`; `None` for a name that is none of the design's. Of tails it is the difference, which is what a record knows.
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
