//! Numbers that are minimised or limited.

use serde::Deserialize;

/// A number of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Measure {
    /// Magnitude of the steady-ramp sensitivity.
    Sensitivity,
    /// One standard deviation of the sensitivity by tolerances, to first order.
    Spread,
    /// |S| + 2 standard deviations: what nearly every unit stays below.
    Worst,
    /// Mass of coil and spool.
    Mass,
    /// Length of the fibre with tails.
    Length,
}

/// Standard deviations that [`Measure::Worst`] adds.
const WORST: f64 = 2.0;

/// The numbers of a design.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Steady-ramp sensitivity \[(deg/h)/(degC/min)\].
    pub sensitivity: f64,
    /// One standard deviation of it; 0 where it is not asked for.
    pub spread: f64,
    /// \[kg\].
    pub mass: f64,
    /// \[m\].
    pub length: f64,
}

impl Measure {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Sensitivity, Self::Spread, Self::Worst, Self::Mass, Self::Length];

    /// Its name in tables and plans.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sensitivity => "sensitivity",
            Self::Spread => "spread",
            Self::Worst => "worst",
            Self::Mass => "mass_kg",
            Self::Length => "length_m",
        }
    }

    /// Its name with its unit.
    pub fn label(self) -> &'static str {
        match self {
            Self::Sensitivity => "|S| [(°/h)/(°C/min)]",
            Self::Spread => "spread of S by tolerances [(°/h)/(°C/min)]",
            Self::Worst => "|S| + 2 spreads [(°/h)/(°C/min)]",
            Self::Mass => "mass of coil and spool [kg]",
            Self::Length => "length of the fibre [m]",
        }
    }

    /// Whether it needs the tolerances.
    pub fn needs_tolerances(self) -> bool {
        matches!(self, Self::Spread | Self::Worst)
    }

    /// Measures of a design.
    pub fn of(self, measures: &Measures) -> f64 {
        match self {
            Self::Sensitivity => measures.sensitivity.abs(),
            Self::Spread => measures.spread,
            Self::Worst => measures.sensitivity.abs() + WORST * measures.spread,
            Self::Mass => measures.mass,
            Self::Length => measures.length,
        }
    }
}
