//! What is wound: pattern, counts, dimensions \[m\].

use crate::Error;
use crate::pattern::owned_stretch;

/// Most turns that [`wind`](crate::wind) lays: some 40 times a 5 km coil of 6 cm diameter, in about 100 MB.
pub const MAX_TURNS: usize = 1_000_000;

/// The order in which the two halves of the fibre take the layers.
///
/// A and B are the layers owned by the CW and the CCW half, from the inside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Pattern {
    /// One fibre from the innermost layer (z = 0) outwards, to and fro like thread on a bobbin.
    Cylindrical,
    /// AB AB …, each half winding only the layers it owns.
    Dipole,
    /// ABBA ABBA … (Frigo 1983), each half winding only the layers it owns.
    Quadrupole,
    /// ABBA ABBA …, where a half that passes a layer of the other lays one turn there, at its own end of the coil (Osunluk et
    /// al., Fig. 3).
    PracticalQuadrupole,
    /// ABBA BAAB …, each half winding only the layers it owns.
    Octupole,
}

/// A half of the fibre, seen from the point where winding begins.
///
/// In the cylindrical pattern, which has no such point: CCW is the half nearer z = 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Half {
    /// From the mid-point to z = L; wound clockwise.
    Cw,
    /// From z = 0 to the mid-point; wound counter-clockwise.
    Ccw,
}

/// The end of the coil at which the CW half climbs from layer to layer; the CCW half climbs at the other.
///
/// Patterns without passing turns start at −y for `Right`, at +y for `Left`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ClimbSide {
    /// At −y: the mirror image of `Right`, turn j of a layer of N becoming turn N + 1 − j.
    Left,
    /// At +y.
    Right,
}

/// How much fibre a turn takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum TurnLength {
    /// 2π r.
    True,
    /// Every turn the mean of the true lengths; the fibre's length stays the same.
    Equal,
}

/// Bare fibre beyond the winding \[m\], finite and ≥ 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tails {
    /// At the outer end of the CW half \[m\].
    pub cw: f64,
    /// At the outer end of the CCW half \[m\].
    pub ccw: f64,
}

/// A layer with too many or too few turns, spread evenly over the width that its owner's turns should take.
///
/// The turns belong to the half that owns the layer; where the other half passes, its turn stays at the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LayerDefect {
    /// The layer, 1 = innermost.
    pub layer: usize,
    /// Turns too many (positive) or missing (negative).
    pub turns: i32,
}

/// A winding to be laid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Spec {
    /// Which half takes which layer.
    pub pattern: Pattern,
    /// Number of layers, ≥ 1.
    pub layers: usize,
    /// Turns in layers 1, 3, 5, …; ≥ 1, for the practical quadrupole ≥ 2.
    pub turns_odd_layers: usize,
    /// Turns in layers 2, 4, 6, …: as many as in the odd layers or one less; where there is such a layer, ≥ 1, for the practical
    /// quadrupole ≥ 2.
    pub turns_even_layers: usize,
    /// Inner radius of the coil, the surface of its hub \[m\], > 0.
    pub inner_radius: f64,
    /// Distance between the centres of touching turns \[m\], > 0.
    pub pitch: f64,
    /// The end of the coil at which the CW half climbs.
    pub cw_climbs: ClimbSide,
    /// How much fibre a turn takes.
    pub turn_length: TurnLength,
    /// Bare fibre beyond the winding.
    pub tails: Tails,
    /// A layer wound wrongly, if there is one.
    pub defect: Option<LayerDefect>,
}

impl Half {
    /// The other half.
    pub fn other(self) -> Self {
        match self {
            Half::Cw => Half::Ccw,
            Half::Ccw => Half::Cw,
        }
    }
}

impl ClimbSide {
    /// The other end of the coil.
    pub fn other(self) -> Self {
        match self {
            ClimbSide::Left => ClimbSide::Right,
            ClimbSide::Right => ClimbSide::Left,
        }
    }
}

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
        if even != odd && Some(even) != odd.checked_sub(1) {
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

    /// Turns too many in a layer.
    pub(crate) fn surplus_in(&self, layer: usize) -> isize {
        self.defect.filter(|defect| defect.layer == layer).map_or(0, |defect| defect.turns as isize)
    }

    /// Turns in a layer counted from 1, as designed.
    pub(crate) fn turns_in(&self, layer: usize) -> usize {
        if layer % 2 == 1 { self.turns_odd_layers } else { self.turns_even_layers }
    }

    /// Radius of the centres of a layer's turns \[m\].
    pub(crate) fn radius(&self, layer: usize) -> f64 {
        let step = self.pitch * 3_f64.sqrt() / 2.0;
        self.inner_radius + self.pitch / 2.0 + (layer - 1) as f64 * step
    }

    /// Axial position of a turn's centre as wound \[m\].
    pub(crate) fn centre(&self, layer: usize, turn: usize) -> f64 {
        let surplus = self.surplus_in(layer);
        if surplus == 0 {
            return self.position(layer, turn);
        }
        let (first, last) = owned_stretch(self, layer);
        let designed = last + 1 - first;
        let wound = designed.saturating_add_signed(surplus);
        if turn < first {
            self.position(layer, turn)
        } else if turn < first + wound {
            let share = (turn - first) as f64 + 0.5;
            self.position(layer, first) + (share * designed as f64 / wound as f64 - 0.5) * self.pitch
        } else {
            self.position(layer, turn.saturating_add_signed(-surplus))
        }
    }

    /// Axial position of a turn's centre as designed \[m\].
    pub(crate) fn position(&self, layer: usize, turn: usize) -> f64 {
        let groove = if layer % 2 == 1 { 0.5 } else { 0.0 };
        (turn as f64 - groove) * self.pitch
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPEC: Spec = Spec {
        pattern: Pattern::PracticalQuadrupole,
        layers: 4,
        turns_odd_layers: 3,
        turns_even_layers: 2,
        inner_radius: 0.04,
        pitch: 2e-4,
        cw_climbs: ClimbSide::Right,
        turn_length: TurnLength::True,
        tails: Tails { cw: 0.0, ccw: 0.0 },
        defect: None,
    };

    #[test]
    fn a_message_names_field_value_and_remedy() {
        let cases = [
            (Spec { inner_radius: -0.04, ..SPEC }, "inner_radius = -0.04 m"),
            (Spec { pitch: f64::NAN, ..SPEC }, "pitch = NaN m"),
            (Spec { tails: Tails { cw: 0.0, ccw: -1.0 }, ..SPEC }, "tails.ccw = -1 m"),
            (Spec { tails: Tails { cw: f64::INFINITY, ccw: 0.0 }, ..SPEC }, "tails.cw = inf m"),
            (Spec { layers: 0, ..SPEC }, "at least one layer"),
            (Spec { turns_even_layers: 1, ..SPEC }, "set it to 3 or to one less"),
            (Spec { turns_even_layers: 4, ..SPEC }, "set it to 3 or to one less"),
            (Spec { turns_odd_layers: 2, turns_even_layers: 1, ..SPEC }, "layer 2 has 1 turns"),
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
