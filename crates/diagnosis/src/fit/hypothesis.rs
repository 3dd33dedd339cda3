//! Hypotheses, which can be fitted.

use crate::ForwardModel;

/// A set of mechanisms at work, with the nominal constants given or re-estimated.
#[derive(Debug, Clone, PartialEq)]
pub struct Hypothesis {
    /// Numbers in the library, each with the value of its choice, if it has one.
    pub mechanisms: Vec<(usize, Option<f64>)>,
    /// Whether the design's own constants are free.
    pub constants_free: bool,
}

impl Hypothesis {
    /// Nothing is left out.
    pub const NOMINAL: Self = Self { mechanisms: Vec::new(), constants_free: false };

    /// Nothing is left out, but the design's own constants are re-estimated.
    pub const RECALIBRATED: Self = Self { mechanisms: Vec::new(), constants_free: true };

    /// Numbers of its mechanisms, in increasing order.
    pub(crate) fn numbers(&self) -> Vec<usize> {
        let mut numbers: Vec<usize> = self.mechanisms.iter().map(|(number, _)| *number).collect();
        numbers.sort_unstable();
        numbers
    }

    /// Whether a mechanism is at work, whatever its choice.
    pub fn has(&self, mechanism: usize) -> bool {
        self.mechanisms.iter().any(|(number, _)| *number == mechanism)
    }
}

/// The hypotheses of one mechanism alone, one for each of its choices, beside constants that are free.
pub fn alternatives(model: &dyn ForwardModel, mechanism: usize) -> Vec<Hypothesis> {
    let of = |choice| Hypothesis { mechanisms: vec![(mechanism, choice)], constants_free: true };
    match &model.mechanisms()[mechanism].choice {
        None => vec![of(None)],
        Some((_, values)) => values.iter().map(|v| of(Some(*v))).collect(),
    }
}
