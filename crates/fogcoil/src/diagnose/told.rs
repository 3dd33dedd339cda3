//! Fitted values as they are told: of a choice its whole number, of a flange its side with it.

use charts::significant;
use coil::{Design, Side};
use diagnosis::{Estimate, ForwardModel};

use super::Outcome;

/// Name of the choice among flanges, which are counted from 1 in the design's order.
const FLANGE: &str = "flange";

impl Outcome<'_> {
    /// The value, and the ends of the 90 % interval, to so many digits.
    pub(super) fn told(&self, estimate: &Estimate, digits: usize) -> (String, [String; 2]) {
        let name = &estimate.name;
        let is_choice = self.gyro.mechanisms().iter().filter_map(|m| m.choice.as_ref()).any(|(choice, _)| choice == name);
        let one = |value: f64| if is_choice { self.chosen(name, value) } else { significant(value, digits) };
        (one(estimate.value), estimate.ci90.map(one))
    }

    /// The value of a choice.
    pub(super) fn chosen(&self, name: &str, value: f64) -> String {
        chosen(self.gyro.library().design(), name, value)
    }
}

fn chosen(design: &Design, name: &str, value: f64) -> String {
    let flanges = design.spool.as_ref().filter(|_| name == FLANGE).map_or(&[][..], |spool| &spool.flanges);
    let flange = (value as usize).checked_sub(1).and_then(|k| flanges.get(k));
    match flange.map(|flange| flange.side) {
        Some(Side::Left) => format!("{value:.0} (left)"),
        Some(Side::Right) => format!("{value:.0} (right)"),
        None => format!("{value:.0}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flange_is_told_by_its_side_and_a_layer_by_its_number() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron");
        let mut design = crate::input::read_coil(path.as_ref()).expect("a coil").design;
        let flanges = &mut design.spool.as_mut().expect("a spool").flanges;
        let right = flanges[0];
        *flanges = vec![right, coil::Flange { side: Side::Left, ..right }];
        assert_eq!([1.0, 2.0, 3.0].map(|k| chosen(&design, FLANGE, k)), ["1 (right)", "2 (left)", "3"]);
        assert_eq!(chosen(&design, "layer", 2.0), "2");
    }
}
