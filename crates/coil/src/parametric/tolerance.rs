//! How far the numbers of a unit may be from its drawing.

use super::parameter::{Parameter, Tolerance};
use crate::Design;
use nalgebra::DMatrix;

/// A number of a design that has a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Number {
    /// One that the parametric model has as a parameter.
    Constant(Parameter),
    /// ∂n/∂T of the fibre \[1/K\].
    ThermoOptic,
    /// Length of a tail \[m\], of each alike.
    Tail,
    /// Time constant of the spool's thermometer \[s\].
    SensorLag,
}

impl Number {
    /// Every number that may have a tolerance.
    pub fn every() -> impl Iterator<Item = Self> {
        Parameter::ALL.iter().map(|parameter| Self::Constant(*parameter)).chain([Self::ThermoOptic, Self::Tail, Self::SensorLag])
    }

    /// Its value in a design, SI, of a tail the CW one's; `None` if the design has no such number.
    pub fn of(self, design: &Design) -> Option<f64> {
        match self {
            Self::Constant(parameter) => parameter.of(design),
            Self::ThermoOptic => Some(design.optics.thermo_optic),
            Self::Tail => Some(design.winding.tails.cw),
            Self::SensorLag => Some(design.sensor.lag),
        }
    }

    /// The design with another value of it; unchanged if it has no such number.
    #[must_use]
    pub fn set(self, design: &Design, value: f64) -> Design {
        let mut changed = design.clone();
        match self {
            Self::Constant(parameter) => return parameter.set(design, value),
            Self::ThermoOptic => changed.optics.thermo_optic = value,
            Self::Tail => changed.winding.tails.cw = value,
            Self::SensorLag => changed.sensor.lag = value,
        }
        changed
    }

    /// Share of its variance that units of a lot usually have in common: half where it is a material's, of one batch with others of its kind; none where it
    /// is cut, machined or mounted unit by unit.
    pub fn shared(self) -> f64 {
        match self.tolerance() {
            Tolerance::Relative(_) if self != Self::SensorLag => 0.5,
            Tolerance::Relative(_) | Tolerance::Absolute(_) | Tolerance::Exact => 0.0,
        }
    }

    /// How far it usually is from the drawing: [`Parameter::tolerance`]; of ∂n/∂T what handbooks of silica differ by, of a tail's length what it
    /// is cut to, of a thermometer's lag what glueing it makes of it.
    pub fn tolerance(self) -> Tolerance {
        match self {
            Self::Constant(parameter) => parameter.tolerance(),
            Self::ThermoOptic => Tolerance::Relative(0.05),
            Self::Tail => Tolerance::Absolute(0.02),
            Self::SensorLag => Tolerance::Relative(0.2),
        }
    }
}

/// Standard deviations of a winding's start or end until a turn's centre reaches a face of the coil, at least.
const WITHIN: f64 = 4.0;

/// Tolerances of a drawing: those that it gives, and of all other numbers the usual ones ([`Number::tolerance`]).
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tolerances {
    /// Those that are given.
    pub given: Vec<(Number, Tolerance)>,
    /// Correlations of two numbers, where units of a lot have told them; all others are independent.
    pub correlations: Vec<(Number, Number, f64)>,
}

impl Tolerances {
    /// Of a number.
    pub fn of(&self, number: Number) -> Tolerance {
        self.given.iter().find(|(given, _)| *given == number).map_or_else(|| number.tolerance(), |(_, tolerance)| *tolerance)
    }

    /// One standard deviation of a number of a design, SI; `None` if the design has no such number. A winding's turns
    /// stay in the coil: four of it take none to a face.
    pub fn sd(&self, number: Number, design: &Design) -> Option<f64> {
        let drawn = number.of(design)?;
        let sd = self.of(number).of(drawn);
        Some(match number {
            Number::Constant(place) if place.of_winding() => sd.min(place.axial_room(design) / WITHIN),
            _ => sd,
        })
    }

    /// Correlations of some numbers, all with all.
    pub fn correlation(&self, numbers: &[Number]) -> DMatrix<f64> {
        let of = |a: Number, b: Number| {
            let both = |(first, second, _): &&(Number, Number, f64)| [*first, *second] == [a, b] || [*first, *second] == [b, a];
            self.correlations.iter().find(both).map_or(0.0, |(_, _, r)| *r)
        };
        DMatrix::from_fn(numbers.len(), numbers.len(), |i, j| if i == j { 1.0 } else { of(numbers[i], numbers[j]) })
    }

    /// Every constant of a design that has one, with its drawn value and one standard deviation, SI.
    pub fn constants(&self, design: &Design) -> Vec<(Parameter, f64, f64)> {
        let of = |&parameter: &Parameter| {
            let by = self.sd(Number::Constant(parameter), design)?;
            (by > 0.0).then_some((parameter, parameter.of(design)?, by))
        };
        Parameter::ALL.iter().filter_map(of).collect()
    }
}
