//! The box of parameters that a model holds for.

use super::parameter::{Parameter, Tolerance};
use super::tolerance::Tolerances;
use crate::Design;

/// A parameter and the range that a model must hold for.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Range {
    /// The parameter.
    pub parameter: Parameter,
    /// Its least value.
    pub low: f64,
    /// Its largest value.
    pub high: f64,
}

/// Standard deviations that a usual range reaches to either side.
const REACH: f64 = 3.0;

impl Range {
    /// The ranges of every parameter of `design` that usually differs from the drawing: three standard deviations of
    /// [`Parameter::tolerance`] to either side.
    pub fn usual(design: &Design) -> Vec<Self> {
        Self::tolerated(design, &Tolerances::default())
    }

    /// The ranges of every parameter of `design` that has a tolerance: three standard deviations to either side, the usual ones at least.
    pub fn tolerated(design: &Design, tolerances: &Tolerances) -> Vec<Self> {
        let usual = Tolerances::default().constants(design);
        let mut all = tolerances.constants(design);
        for (parameter, value, by) in usual {
            match all.iter_mut().find(|(other, ..)| *other == parameter) {
                Some((.., given)) => *given = given.max(by),
                None => all.push((parameter, value, by)),
            }
        }
        let of = |(parameter, value, by): (Parameter, f64, f64)| {
            let by = REACH * by;
            // a wall keeps half of its thickness, whatever the tolerance
            let is_wall = !parameter.of_winding() && matches!(parameter.tolerance(), Tolerance::Absolute(_));
            let less = if is_wall { by.min(value.abs() / 2.0) } else { by };
            Self { parameter, low: value - less, high: value + by }
        };
        all.into_iter().map(of).collect()
    }

    /// Ranges that hold every parameter of `design`, too.
    pub fn widened(ranges: &mut Vec<Self>, from: &Design, design: &Design) {
        for &parameter in Parameter::ALL {
            let (Some(before), Some(value)) = (parameter.of(from), parameter.of(design)) else { continue };
            match ranges.iter_mut().find(|range| range.parameter == parameter) {
                Some(range) => (range.low, range.high) = (range.low.min(value), range.high.max(value)),
                None if value != before => {
                    ranges.push(Self { parameter, low: before.min(value), high: before.max(value) });
                }
                None => {}
            }
        }
    }
}
