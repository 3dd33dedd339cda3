//! Whether there is such a winding.

use crate::Error;
use crate::pattern::owned_stretch;
use crate::spec::{LayerDefect, Pattern, Spec};

/// Most turns that [`wind`](crate::wind) lays: some 40 times a 5 km coil of 6 cm diameter, in about 100 MB.
pub const MAX_TURNS: usize = 1_000_000;

impl Spec {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field outside its range; more than [`MAX_TURNS`] turns.
    pub fn validate(&self) -> Result<(), Error> {
        for (field, value) in [("inner_radius", self.inner_radius), ("pitch", self.pitch)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(Error::Length { field, value, range: "above 0" });
            }
        }
        if !self.start.is_finite() {
            return Err(Error::Length { field: "start", value: self.start, range: "of any sign" });
        }
        // not `<=`: a NaN is no place
        if let Some(end) = self.end.filter(|end| !(end.is_finite() && *end > self.start)) {
            return Err(Error::Length { field: "end", value: end, range: "above start" });
        }
        for (field, value) in [("tails.cw", self.tails.cw), ("tails.ccw", self.tails.ccw)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Error::Length { field, value, range: "of 0 or more" });
            }
        }
        self.validate_counts()?;
        self.validate_defect()
    }

    fn validate_defect(&self) -> Result<(), Error> {
        let Some(LayerDefect { layer, turns }) = self.defect else { return Ok(()) };
        if !(1..=self.layers).contains(&layer) {
            return Err(Error::DefectLayer { layer, layers: self.layers });
        }
        let (first, last) = owned_stretch(self, layer);
        let owned = last + 1 - first;
        match owned.checked_add_signed(turns as isize) {
            Some(left) if left >= 1 && left <= 2 * owned => Ok(()),
            _ => Err(Error::DefectTurns { layer, turns, owned }),
        }
    }

    fn validate_counts(&self) -> Result<(), Error> {
        let (odd, even) = (self.turns_odd_layers, self.turns_even_layers);
        if self.layers == 0 {
            return Err(Error::NoLayers);
        }
        // one layer has no even one beside it
        if self.layers > 1 && even != odd && Some(even) != odd.checked_sub(1) {
            return Err(Error::EvenTurns { odd, even });
        }
        let needed = match self.pattern {
            Pattern::PracticalQuadrupole => 2,
            Pattern::Cylindrical | Pattern::Dipole | Pattern::Quadrupole | Pattern::Octupole => 1,
        };
        if let Some(layer) = (1..=self.layers.min(2)).find(|&layer| self.turns_in(layer) < needed) {
            return Err(Error::TooFewTurns { layer, turns: self.turns_in(layer), needed });
        }
        match self.turns() {
            Some(turns) if turns <= MAX_TURNS => Ok(()),
            _ => Err(Error::TooManyTurns { layers: self.layers, odd, even, limit: MAX_TURNS }),
        }
    }

    /// Turns of the whole coil, `None` if they overflow.
    fn turns(&self) -> Option<usize> {
        let even_layers = self.layers / 2;
        let odd = (self.layers - even_layers).checked_mul(self.turns_odd_layers)?;
        odd.checked_add(even_layers.checked_mul(self.turns_even_layers)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::{ClimbSide, Tails, TurnLength};

    const SPEC: Spec = Spec {
        pattern: Pattern::PracticalQuadrupole,
        layers: 4,
        turns_odd_layers: 3,
        turns_even_layers: 2,
        inner_radius: 0.04,
        pitch: 2e-4,
        start: 0.0,
        end: None,
        cw_climbs: ClimbSide::Right,
        turn_length: TurnLength::True,
        tails: Tails { cw: 0.0, ccw: 0.0 },
        defect: None,
    };

    #[test]
    fn a_message_names_field_value_and_remedy() {
        let cases = [
            (Spec { inner_radius: -0.04, ..SPEC }, "inner_radius = -0.04 m"),
            (Spec { start: f64::NAN, ..SPEC }, "start = NaN m"),
            (Spec { start: 1e-3, end: Some(1e-3), ..SPEC }, "end = 0.001 m"),
            (Spec { end: Some(f64::NAN), ..SPEC }, "end = NaN m"),
            (Spec { pitch: f64::NAN, ..SPEC }, "pitch = NaN m"),
            (Spec { tails: Tails { cw: 0.0, ccw: -1.0 }, ..SPEC }, "tails.ccw = -1 m"),
            (Spec { tails: Tails { cw: f64::INFINITY, ccw: 0.0 }, ..SPEC }, "tails.cw = inf m"),
            (Spec { layers: 0, ..SPEC }, "at least one layer"),
            (Spec { turns_even_layers: 1, ..SPEC }, "set it to 3 or to one less"),
            (Spec { turns_even_layers: 4, ..SPEC }, "set it to 3 or to one less"),
            (Spec { turns_odd_layers: 2, turns_even_layers: 1, ..SPEC }, "layer 2 has 1 turn,"),
            (Spec { turns_odd_layers: 0, turns_even_layers: 0, pattern: Pattern::Dipole, ..SPEC }, "layer 1 has 0 turns"),
            (Spec { layers: 400_001, ..SPEC }, "more than 1000000 turns"),
            (Spec { layers: usize::MAX, turns_odd_layers: usize::MAX, turns_even_layers: usize::MAX, ..SPEC }, "lower one"),
        ];
        for (spec, expected) in cases {
            let message = spec.validate().expect_err(expected).to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn the_largest_and_the_smallest_coil_pass() {
        assert_eq!(Spec { layers: 400_000, ..SPEC }.validate(), Ok(()));
        assert_eq!(Spec { layers: 1, turns_odd_layers: 2, turns_even_layers: 1, ..SPEC }.validate(), Ok(()));
        let single = Spec { pattern: Pattern::Octupole, layers: 1, turns_odd_layers: 1, turns_even_layers: 0, ..SPEC };
        assert_eq!(single.validate(), Ok(()));
    }
}
