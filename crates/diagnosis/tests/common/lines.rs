//! A linear model under white noise, of which everything is known in closed form: two mechanisms, each a size times a column of its own;
//! a third, if it is asked for, chooses between their columns.

use diagnosis::{
    Active, Channel, ForwardModel, Hypothesis, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State,
};
use nalgebra::DMatrix;

/// Standard deviation of the noise.
pub(crate) const WHITE: f64 = 0.5;
/// Standard deviation of a size beforehand.
pub(crate) const PRIOR_SD: f64 = 2.0;
const STEP_S: f64 = 30.0;
/// Sizes beyond so many times their order are refused, as a coil's model refuses the impossible.
const MOST: f64 = 1000.0;
/// A spread of the noise's priors that hardly lets it move.
const KNOWN: f64 = 1e-4;
const TINY: f64 = 1e-9;

pub(crate) struct Lines {
    channels: Vec<Channel>,
    mechanisms: Vec<Omission>,
    state: State,
    unit: f64,
    scales: [f64; 2],
    effect: f64,
    power: i32,
    constants: Vec<Nuisance>,
    precision: Option<DMatrix<f64>>,
}

/// One mechanism alone.
pub(crate) fn alone(mechanism: usize) -> Hypothesis {
    Hypothesis { mechanisms: vec![(mechanism, None)], constants_free: true }
}

impl Lines {
    pub(crate) fn new(rows: usize) -> Self {
        Self::in_unit(rows, 1.0)
    }

    /// The same in a unit of which `unit` make one.
    pub(crate) fn in_unit(rows: usize, unit: f64) -> Self {
        let noise = NoisePrior::new((WHITE * unit, KNOWN), (TINY * unit, KNOWN), (1000.0, KNOWN), (TINY * unit, KNOWN));
        let mechanism = |id: &str| Omission {
            id: id.into(),
            stage: "any".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: PRIOR_SD })],
            choice: None,
            starts: vec![vec![0.0]],
            named: true,
            weight: 1.0,
        };
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 3.0 * unit), averaging: 0.0, noise }],
            mechanisms: vec![mechanism("wave"), mechanism("bend")],
            state: State { level: vec![0.0; rows], rate: vec![0.0; rows] },
            unit,
            scales: [1.0; 2],
            effect: 1.0,
            power: 1,
            constants: Vec::new(),
            precision: None,
        }
    }

    /// The same with a constant for each column beside the offset, which go together; the first mechanism stands for the first one.
    pub(crate) fn with_constants(rows: usize, correlation: f64) -> Self {
        let constants = ["a", "b"].map(|name| Nuisance::normal(name, 0.0, PRIOR_SD, Role::Constant)).to_vec();
        let together = DMatrix::from_row_slice(2, 2, &[1.0, correlation, correlation, 1.0]);
        Self { constants, precision: together.try_inverse(), ..Self::new(rows) }
    }

    /// The same where every record has constants of its own.
    pub(crate) fn with_own_constants(rows: usize) -> Self {
        let mut lines = Self::with_constants(rows, 0.0);
        lines.constants.iter_mut().for_each(|constant| constant.local = true);
        lines
    }

    /// The same where the first mechanism acts by the square of its size: a size and its opposite are one.
    pub(crate) fn squared(rows: usize) -> Self {
        let mut lines = Self { power: 2, ..Self::new(rows) };
        lines.mechanisms[0].starts = vec![vec![-1.0], vec![1.0]];
        lines
    }

    /// The same where mechanisms act by a power of their sizes.
    pub(crate) fn with_power(self, power: i32) -> Self {
        Self { power, ..self }
    }

    /// The same where fits start from a size.
    pub(crate) fn starting_at(mut self, size: f64) -> Self {
        self.mechanisms.iter_mut().for_each(|mechanism| mechanism.starts = vec![vec![size]]);
        self
    }

    /// The same where the noise is known to drift so much.
    pub(crate) fn with_drift(mut self, drift: f64) -> Self {
        self.channels[0].noise.drift.0 = drift;
        self
    }

    /// The same in another state.
    pub(crate) fn in_state(self, state: State) -> Self {
        Self { state, ..self }
    }

    /// The same where sizes are of the order of `scales` and may be far larger; one of that order has so much of the effect.
    pub(crate) fn sized(mut self, scales: [f64; 2], effect: f64) -> Self {
        (self.scales, self.effect) = (scales, effect);
        for (mechanism, scale) in self.mechanisms.iter_mut().zip(scales) {
            mechanism.parameters = vec![Parameter::new("size", Prior::Size { scale })];
            mechanism.starts = vec![vec![scale]];
        }
        self
    }

    /// The same with a third mechanism that chooses between the columns of the others.
    pub(crate) fn with_either(rows: usize) -> Self {
        let mut lines = Self::new(rows);
        let choice = Some(("column".to_owned(), vec![0.0, 1.0]));
        lines.mechanisms.push(Omission { id: "either".into(), choice, ..lines.mechanisms[0].clone() });
        lines
    }

    /// The same with an offset that may be anything.
    pub(crate) fn with_any_offset(mut self) -> Self {
        self.channels[0].offset.1 = f64::INFINITY;
        self
    }

    /// The same with a mechanism that has nothing to choose from.
    pub(crate) fn with_no_choice(rows: usize) -> Self {
        let mut lines = Self::with_either(rows);
        lines.mechanisms[2].choice = Some(("column".to_owned(), Vec::new()));
        lines
    }

    /// The same with an offset that is known to be 0.
    pub(crate) fn without_offset(mut self) -> Self {
        self.channels[0].offset.1 = TINY;
        self
    }

    pub(crate) fn offset_sd(&self) -> f64 {
        self.channels[0].offset.1
    }

    /// Response to a size of 1.
    pub(crate) fn column(&self, mechanism: usize) -> Vec<f64> {
        let rows = self.state.level.len();
        let of = |n: usize| {
            let x = n as f64 / rows as f64;
            self.unit * self.effect / self.scales[mechanism]
                * if mechanism == 0 { (7.0 * x).sin() } else { (7.0 * x).sin() + x * x }
        };
        (0..rows).map(of).collect()
    }

    pub(crate) fn observed(&self, y: &[f64]) -> Observation {
        Observation { time: (0..y.len()).map(|n| STEP_S * n as f64).collect(), channels: vec![y.to_vec()] }
    }
}

impl ForwardModel for Lines {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.constants
    }

    fn precision(&self) -> Option<&DMatrix<f64>> {
        self.precision.as_ref()
    }

    fn stands_for(&self, mechanism: usize) -> Option<usize> {
        (mechanism == 0 && !self.constants.is_empty()).then_some(0)
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, constants: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let mut y = vec![0.0; self.state.level.len()];
        let stood_for = |constant: usize| active.iter().any(|active| self.stands_for(active.mechanism) == Some(constant));
        for (constant, value) in constants.iter().enumerate().filter(|(constant, _)| !stood_for(*constant)) {
            y.iter_mut().zip(self.column(constant)).for_each(|(y, x)| *y += value * x);
        }
        for active in active {
            if active.values[0].abs() > MOST * self.scales[active.mechanism.min(1)] {
                return Err(format!("a size of {}", active.values[0]).into());
            }
            y.iter_mut()
                .zip(self.column(active.choice.map_or(active.mechanism, |c| c as usize)))
                .for_each(|(y, x)| *y += active.values[0].powi(self.power) * x);
        }
        Ok(vec![y])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}
