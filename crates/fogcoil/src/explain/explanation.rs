//! A mechanism as an explanation of a sensitivity.

use diagnosis::{Active, ForwardModel};
use mechanisms::Gyro;

/// Distance from the middle of a prior up to which a value is plausible \[σ\].
pub const PLAUSIBLE: f64 = 2.0;
/// Distance up to which it is not out of the question \[σ\].
pub const STRAINED: f64 = 3.0;

/// Size that a mechanism would have to have.
#[derive(Debug, Clone, PartialEq)]
pub enum Reach {
    /// It gives the sensitivity.
    Gives {
        /// The parameter and its value.
        value: f64,
        /// Error of the value by that of the computed sensitivity.
        error: f64,
        /// Distance from the middle of its prior \[σ\].
        sigma: f64,
        /// A layer and the number of layers in which a plausible number of turns does as well, where it is a defect of one.
        layer: Option<(usize, usize)>,
    },
    /// It changes the sensitivity, but not so much, within four σ of its prior.
    OutOfReach {
        /// Range that it can give, (deg/h)/(degC/min).
        range: [f64; 2],
    },
    /// It does not change the sensitivity.
    Unable {
        /// The reason.
        why: &'static str,
    },
}

/// A mechanism as an explanation.
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// Mechanism.
    pub id: String,
    /// Its parameter; empty where none is solved for.
    pub parameter: String,
    /// Condition under which it holds.
    pub when: &'static str,
    /// Size that it would have to have.
    pub outcome: Reach,
}

impl Explanation {
    /// Distance from the middle of the prior, if the mechanism can explain the sensitivity.
    pub fn sigma(&self) -> Option<f64> {
        match self.outcome {
            Reach::Gives { sigma, .. } => Some(sigma),
            _ => None,
        }
    }
}

/// A mechanism of that size: the solved parameter among the middles of the others.
pub(super) fn active(gyro: &Gyro, explanation: &Explanation) -> Option<Active> {
    let Reach::Gives { value, layer, .. } = explanation.outcome else { return None };
    let mechanism = gyro.find(&explanation.id)?;
    let entry = &gyro.mechanisms()[mechanism];
    let of = |p: &diagnosis::Parameter| if p.name == explanation.parameter { value } else { p.prior.value(0.0) };
    let choice = layer.map(|(layer, _)| layer as f64);
    Some(Active { mechanism, values: entry.parameters.iter().map(of).collect(), choice })
}
