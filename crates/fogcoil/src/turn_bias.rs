//! Contribution of every turn to the bias.

use bias::Bias;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{ThermalState, TurnFields};

use crate::input::CoilCase;

/// Contribution of each turn to the bias while the state changes by `change` per second, in the winding's order \[°/h\]; tails left out, the
/// mechanics in their nominal state.
///
/// # Errors
/// [`bias::Error`] if an optical constant is out of range, with which no coil could have been simulated.
pub(crate) fn turn_bias(case: &CoilCase, turns: &TurnFields, change: &ThermalState) -> Result<Vec<Bias>, bias::Error> {
    let coefficients = case.design.optics.coefficients(case.winding.length())?;
    let rates = turns.at(change);
    let of = |(i, weight): (usize, f64)| {
        coefficients.bias(weight, rates.temperature[i], rates.axial[i], rates.radial[i]) * DEG_PER_H_PER_RAD_PER_S
    };
    Ok(case.winding.weights().into_iter().enumerate().map(of).collect())
}
