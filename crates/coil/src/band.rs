//! What a design's tolerances make of a number that follows from it: slopes by differences, one standard deviation to either side.

use crate::{Design, Error, MeshFineness, Model, Number, Parameter, Tolerances};

/// One standard deviation of a number that follows from a design, and where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Band {
    /// One standard deviation, to first order in the tolerances.
    pub sd: f64,
    /// Change by one standard deviation of each number of the design, the largest first.
    pub changes: Vec<(Number, f64)>,
    /// Share of the variance that each has, in their order; with its part of what it shares with correlated ones, so that all add up to 1.
    pub shares: Vec<f64>,
}

/// The mesh behind the slopes: good to a per cent of them.
pub(crate) const SLOPES: MeshFineness = MeshFineness { order: 4, layers: 2, ratio: 0.15 };

/// Whether a number acts in a uniform ramp, in which no heat flows.
fn acts_in_a_ramp(number: Number) -> bool {
    use Parameter::{
        AxialExpansion, AxialModulus, AxialPoisson, FlangeOverhang, FlangeThickness, HubThickness, ShearRatio, SpoolExpansion,
        SpoolModulus, SpoolPoisson, TransverseExpansion, TransverseModulus, TransversePoisson,
    };
    match number {
        Number::Tail => true,
        // one temperature throughout: no thermal phase between the halves
        Number::ThermoOptic | Number::SensorLag => false,
        Number::Constant(parameter) => matches!(
            parameter,
            AxialModulus
                | TransverseModulus
                | ShearRatio
                | AxialPoisson
                | TransversePoisson
                | AxialExpansion
                | TransverseExpansion
                | SpoolModulus
                | SpoolPoisson
                | SpoolExpansion
                | HubThickness
                | FlangeThickness
                | FlangeOverhang
        ),
    }
}

impl Band {
    /// Of what follows `of` a design in a steady ramp. Where the design cannot have a number on one side, as a Poisson's ratio beyond its bound, the other
    /// side counts alone.
    ///
    /// # Errors
    /// What `of` says of the design itself.
    pub(crate) fn in_a_ramp(
        design: &Design,
        tolerances: &Tolerances,
        of: impl Fn(&Design) -> Result<f64, Error>,
    ) -> Result<Self, Error> {
        let here = of(design)?;
        let constants = Parameter::ALL.iter().map(|p| Number::Constant(*p));
        let numbers = constants.chain([Number::Tail]).filter(|n| acts_in_a_ramp(*n));
        let mut changes: Vec<(Number, f64)> = Vec::new();
        for number in numbers {
            let Some(drawn) = number.of(design) else { continue };
            let sd = tolerances.of(number).of(drawn);
            if sd <= 0.0 {
                continue;
            }
            // a tail is not shortened below nothing
            let down = if number == Number::Tail { None } else { of(&number.set(design, drawn - sd)).ok() };
            let change = match (of(&number.set(design, drawn + sd)).ok(), down) {
                (Some(up), Some(down)) => (up - down) / 2.0,
                (Some(up), None) => up - here,
                (None, Some(down)) => here - down,
                (None, None) => continue,
            };
            // both tails vary alike, each by itself
            changes.push((number, if number == Number::Tail { std::f64::consts::SQRT_2 * change } else { change }));
        }
        changes.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        let numbers: Vec<Number> = changes.iter().map(|(number, _)| *number).collect();
        let each = nalgebra::DVector::from_iterator(changes.len(), changes.iter().map(|(_, change)| *change));
        let with_others = tolerances.correlation(&numbers) * &each;
        let variance = each.dot(&with_others).max(0.0);
        let share = |(own, all): (&f64, &f64)| if variance > 0.0 { own * all / variance } else { 0.0 };
        let shares = each.iter().zip(with_others.iter()).map(share).collect();
        Ok(Self { sd: variance.sqrt(), changes, shares })
    }
}

/// What the tolerances of a design make of its steady-ramp sensitivity, (°/h)/(°C/min).
///
/// # Errors
/// [`Error`] names the dimension or property at fault, or the solve that failed.
pub fn sensitivity_band(design: &Design, tolerances: &Tolerances) -> Result<Band, Error> {
    Band::in_a_ramp(design, tolerances, |design| Ok(Model::new(design, &SLOPES)?.sensitivity()?.total()))
}
