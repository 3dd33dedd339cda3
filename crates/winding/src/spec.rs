//! Specification of a winding: pattern, counts, dimensions \[m\].

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
    /// The half from the mid-point to z = L; wound clockwise.
    Cw,
    /// The half from z = 0 to the mid-point; wound counter-clockwise.
    Ccw,
}

/// The end of the coil at which the CW half climbs from layer to layer; the CCW half climbs at the other.
///
/// Patterns without passing turns start at −y for `Right`, at +y for `Left`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ClimbSide {
    /// The side −y: turn j of a layer of N becomes turn N + 1 − j. It is the mirror image of `Right` where even layers have a turn fewer; with equal counts they
    /// stay half a pitch off towards +y, and the mirror image does not.
    Left,
    /// The side +y.
    Right,
}

/// Length of fibre in a turn.
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
    /// Tail at the outer end of the CW half \[m\].
    pub cw: f64,
    /// Tail at the outer end of the CCW half \[m\].
    pub ccw: f64,
}

impl Tails {
    /// Weight of both in the bias beside `wound` \[m\] of fibre in turns, W = ∫ (L − 2z) dz \[m²\].
    pub fn weight(&self, wound: f64) -> f64 {
        (self.ccw - self.cw) * wound
    }
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
    /// Order in which the halves take the layers.
    pub pattern: Pattern,
    /// Number of layers, ≥ 1. A pattern cancels what it can if its halves have as many layers in each of its groups: a dipole's is of two, a quadrupole's
    /// of four, an octupole's of eight.
    pub layers: usize,
    /// Turns in layers 1, 3, 5, …; ≥ 1, for the practical quadrupole ≥ 2.
    pub turns_odd_layers: usize,
    /// Turns in layers 2, 4, 6, …: as many as in the odd layers or one less, ≥ 1, for the practical quadrupole ≥ 2. Of a coil of one layer,
    /// which has no such layer, it means nothing.
    pub turns_even_layers: usize,
    /// Inner radius of the coil, the surface of its hub \[m\], > 0.
    pub inner_radius: f64,
    /// Distance between the centres of touching turns, the outer diameter of the fibre \[m\], > 0.
    pub pitch: f64,
    /// Axial place at which the winding begins, the outer edge of its first turn \[m\]: 0 where it touches the coil's left face.
    pub start: f64,
    /// Axial place at which it ends, the outer edge of its last turn \[m\]: turns are spread evenly between both. `None`: they touch. A
    /// place that is too short presses them closer than the pitch, as a tolerance may; this is not refused.
    pub end: Option<f64>,
    /// The end of the coil at which the CW half climbs.
    pub cw_climbs: ClimbSide,
    /// Length of fibre in a turn.
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
    /// Axial places at which the winding begins and ends \[m\].
    pub fn edges(&self) -> [f64; 2] {
        [self.start, self.end.unwrap_or(self.start + self.width() * self.pitch)]
    }

    /// Lowest and highest place of a turn's centre along the axis, as wound \[m\].
    pub fn reach(&self) -> [f64; 2] {
        let last = |layer| self.turns_in(layer).saturating_add_signed(self.surplus_in(layer));
        let centres = (1..=self.layers).flat_map(|layer| [self.centre(layer, 1), self.centre(layer, last(layer))]);
        centres.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)])
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

    /// Axial place of a turn's centre as designed \[m\].
    pub(crate) fn position(&self, layer: usize, turn: usize) -> f64 {
        let groove = if layer % 2 == 1 { 0.5 } else { 0.0 };
        self.start + (turn as f64 - groove) * self.spacing()
    }

    /// Turns side by side that are as wide as the winding; half a turn where every other layer lies half a turn further.
    fn width(&self) -> f64 {
        let odd = self.turns_odd_layers as f64;
        if self.layers > 1 { odd.max(self.turns_even_layers as f64 + 0.5) } else { odd }
    }

    /// Axial distance between the centres of neighbouring turns as designed \[m\].
    pub fn spacing(&self) -> f64 {
        self.end.map_or(self.pitch, |end| (end - self.start) / self.width())
    }
}
