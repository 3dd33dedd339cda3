//! The turn table and what follows from it.

use std::f64::consts::PI;

use crate::pattern::{Place, places};
use crate::{Error, Half, Pattern, Spec, Turn, TurnLength};

/// A wound coil: its turns in order along the fibre.
#[derive(Debug, Clone, PartialEq)]
pub struct Winding {
    spec: Spec,
    turns: Vec<Turn>,
    length: f64,
}

/// Lays the fibre.
///
/// # Errors
/// A field of `spec` outside its range (see [`Spec::validate`]), or a fibre too long to square.
pub fn wind(spec: &Spec) -> Result<Winding, Error> {
    spec.validate()?;
    let places = places(spec);
    let true_length = |place: &Place| 2.0 * PI * spec.radius(place.layer);
    let mean = places.iter().map(true_length).sum::<f64>() / places.len() as f64;
    let mut z = spec.tails.ccw;
    let mut turns: Vec<Turn> = Vec::with_capacity(places.len());
    for place in &places {
        let z_start = z;
        z += match spec.turn_length {
            TurnLength::True => true_length(place),
            TurnLength::Equal => mean,
        };
        let Place { half, layer, turn } = *place;
        turns.push(Turn { half, layer, turn, r: spec.radius(layer), y: spec.centre(layer, turn), z_start, z_end: z });
    }
    let length = z + spec.tails.cw;
    if !(length * length).is_finite() {
        return Err(Error::TooLong { length });
    }
    if spec.pattern == Pattern::Cylindrical {
        divide_at_the_middle(&mut turns, length);
    }
    Ok(Winding { spec: *spec, turns, length })
}

fn divide_at_the_middle(turns: &mut [Turn], length: f64) {
    for turn in turns {
        turn.half = if turn.z_mid() < 0.5 * length { Half::Ccw } else { Half::Cw };
    }
}

impl Winding {
    /// The winding.
    pub fn spec(&self) -> &Spec {
        &self.spec
    }

    /// The turns in order along the fibre from z = 0; without the tails. Each begins where the one before ends. The first of them lie in an outermost layer of
    /// the CCW half, not in layer 1, except in the cylindrical pattern.
    pub fn turns(&self) -> &[Turn] {
        &self.turns
    }

    /// Length L of the fibre with its tails \[m\].
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Length of the fibre without its tails \[m\].
    pub fn wound_length(&self) -> f64 {
        self.wound_end() - self.spec.tails.ccw
    }

    fn wound_end(&self) -> f64 {
        self.turns.last().map_or(self.spec.tails.ccw, |last| last.z_end)
    }

    /// Number of turns of one half.
    pub fn count(&self, half: Half) -> usize {
        self.turns.iter().filter(|turn| turn.half == half).count()
    }

    /// Outer radius of the coil \[m\]: half a pitch beyond the centres of the last layer.
    pub fn outer_radius(&self) -> f64 {
        self.spec.radius(self.spec.layers) + self.spec.pitch / 2.0
    }

    /// Mean of the inner and the outer diameter \[m\], the D of the Sagnac effect unless another was measured.
    pub fn mean_diameter(&self) -> f64 {
        self.spec.inner_radius + self.outer_radius()
    }

    /// Height of the winding \[m\], from the outer edge of its first turn to that of its last.
    pub fn height(&self) -> f64 {
        let [start, end] = self.edges();
        end - start
    }

    /// Axial places of the outer edges of its first and its last turn \[m\].
    pub fn edges(&self) -> [f64; 2] {
        self.spec.edges()
    }

    /// Weight of every turn in the bias, W = ∫ (L − 2z) dz \[m²\], in the order of [`turns`](Self::turns).
    ///
    /// With the [`tail_weight`](Self::tail_weight) they add up to 0.
    pub fn weights(&self) -> Vec<f64> {
        self.turns.iter().map(|turn| turn.weight(self.length)).collect()
    }

    /// Weight of both bare tails together, W = ∫ (L − 2z) dz \[m²\].
    pub fn tail_weight(&self) -> f64 {
        self.spec.tails.weight(self.wound_length())
    }

    /// The spans (`z_start`, `z_end`) of the bare tails \[m\]: first the CCW tail, then the CW tail. Empty spans for no tails.
    pub fn tail_spans(&self) -> ((f64, f64), (f64, f64)) {
        ((0.0, self.spec.tails.ccw), (self.wound_end(), self.length))
    }

    /// Moment Σ W (r − r̄)ⁱ (y − ȳ)ʲ of the weights over the turns [m^(2+i+j)], tails left out.
    ///
    /// (r̄, ȳ) is the plain mean of the turn centres. A field that varies as (r − r̄)ⁱ (y − ȳ)ʲ drives a bias in proportion.
    /// Without tails moment(0, 0) is 0, so moment(1, 0) and moment(0, 1) do not depend on the reference point.
    pub fn moment(&self, i: u32, j: u32) -> f64 {
        let count = self.turns.len() as f64;
        let r_mean = self.turns.iter().map(|turn| turn.r).sum::<f64>() / count;
        let y_mean = self.turns.iter().map(|turn| turn.y).sum::<f64>() / count;
        let power = |base: f64, exponent: u32| base.powi(i32::try_from(exponent).unwrap_or(i32::MAX));
        let term = |turn: &Turn| turn.weight(self.length) * power(turn.r - r_mean, i) * power(turn.y - y_mean, j);
        self.turns.iter().map(term).sum()
    }
}
