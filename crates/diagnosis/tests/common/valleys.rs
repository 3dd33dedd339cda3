//! A mechanism whose misfit is prescribed: a record of nothing but noughts under white noise of 1, so that −ln p is half the sum of the squares of what the
//! mechanism adds, but for a prior that hardly matters.

use diagnosis::{
    Active, Channel, Fit, ForwardModel, Hypothesis, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State,
    fitted,
};
use std::cell::RefCell;

const ROWS: usize = 8;
const STEP_S: f64 = 30.0;
/// A spread of the noise's priors that hardly lets it move.
const KNOWN: f64 = 1e-4;
const TINY: f64 = 1e-9;
/// Standard deviation of a parameter beforehand.
const WIDE: f64 = 100.0;

/// What the mechanism adds to the rows, of its parameters and nuisances.
type Added = Box<dyn Fn(&[f64]) -> [f64; ROWS]>;

pub(crate) struct Valleys {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    added: Added,
    /// every first parameter that was asked for
    pub(crate) asked: RefCell<Vec<f64>>,
}

impl Valleys {
    /// A mechanism whose fits begin at `starts`, and that looks around each parameter by distances.
    pub(crate) fn new(starts: &[&[f64]], around: &[f64], added: impl Fn(&[f64]) -> [f64; ROWS] + 'static) -> Self {
        let noise = NoisePrior::new((1.0, KNOWN), (TINY, KNOWN), (1000.0, KNOWN), (TINY, KNOWN));
        let parameter = |_: &f64| Parameter::new("place", Prior::Normal { mean: 0.0, sd: WIDE }).with_search(around);
        let mechanism = Omission {
            id: "valleys".into(),
            stage: "any".into(),
            parameters: starts[0].iter().map(parameter).collect(),
            choice: None,
            starts: starts.iter().map(|start| start.to_vec()).collect(),
            named: true,
            weight: 1.0,
        };
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, TINY), averaging: 0.0, noise }],
            nuisances: Vec::new(),
            mechanisms: vec![mechanism],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            added: Box::new(added),
            asked: RefCell::default(),
        }
    }

    /// The same with an offset that may be anything.
    pub(crate) fn with_any_offset(mut self) -> Self {
        self.channels[0].offset.1 = WIDE;
        self
    }

    /// The same beside a nuisance of this standard deviation, on which what is added depends as on one more parameter; it is looked around by distances, too.
    pub(crate) fn beside(mut self, sd: f64, around: &[f64]) -> Self {
        let nuisance = Nuisance::normal("beside", 0.0, sd, Role::Sensor);
        self.nuisances = vec![Nuisance { parameter: nuisance.parameter.with_search(around), ..nuisance }];
        self
    }

    /// The same where little is known of the noise.
    pub(crate) fn with_any_noise(mut self) -> Self {
        self.channels[0].noise.white.1 = 1.0;
        self
    }

    pub(crate) fn record() -> Observation {
        Observation { time: (0..ROWS).map(|n| STEP_S * n as f64).collect(), channels: vec![vec![0.0; ROWS]] }
    }

    pub(crate) fn fitted(&self) -> Fit {
        let hypothesis = Hypothesis { mechanisms: vec![(0, None)], constants_free: false };
        fitted(self, &[0], &[Self::record()], &[hypothesis]).expect("a fit")
    }
}

impl ForwardModel for Valleys {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, u: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let [Active { values, .. }] = active else { return Ok(vec![vec![0.0; ROWS]]) };
        self.asked.borrow_mut().push(values[0]);
        Ok(vec![(self.added)(&[values, u].concat()).to_vec()])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}
