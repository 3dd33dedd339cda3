//! A model that is linear about one value of a constant, on which its response depends far from linearly: an oscillation of unknown frequency.

use crate::common::normal;
use diagnosis::{
    Active, Channel, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State, expected, settled,
};

const WHITE: f64 = 0.05;
const ROWS: usize = 241;
const STEP_S: f64 = 0.05;
/// Between the design's and this one the misfit has other minima: they differ by more than a turn over the record.
const TRUE_FREQUENCY: f64 = 2.0;

struct Oscillation {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    starts: Vec<Vec<f64>>,
    here: f64,
}

fn time() -> impl Iterator<Item = f64> {
    (0..ROWS).map(|n| STEP_S * n as f64)
}

impl Oscillation {
    fn new(starts: &[f64]) -> Self {
        let noise = NoisePrior::new((WHITE, 1e-4), (1e-9, 1e-4), (100.0, 1e-4), (1e-9, 1e-4));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![Nuisance::normal("frequency", 1.0, 0.5, Role::Constant)],
            mechanisms: Vec::new(),
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            starts: starts.iter().map(|start| vec![*start]).collect(),
            here: 1.0,
        }
    }

    /// The same with a mechanism that adds a bow.
    fn with_a_bow(starts: &[f64]) -> Self {
        let bow = Omission {
            id: "bow".into(),
            stage: "one".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 1.0 })],
            choice: None,
            starts: vec![vec![0.0]],
            named: true,
            weight: 1.0,
        };
        Self { mechanisms: vec![bow], ..Self::new(starts) }
    }
}

/// What the mechanism of size one adds.
fn bow(t: f64) -> f64 {
    let x = t / (STEP_S * (ROWS - 1) as f64);
    4.0 * x * (1.0 - x)
}

impl ForwardModel for Oscillation {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, frequency: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let size: f64 = active.iter().map(|a| a.values[0]).sum();
        let linear = |t: f64| size * bow(t) + (self.here * t).sin() + (frequency[0] - self.here) * t * (self.here * t).cos();
        Ok(vec![time().map(linear).collect()])
    }

    fn about(&self, frequency: &[f64], _: &[Active]) -> Result<Option<Self>, diagnosis::Failure> {
        let anew = || Self {
            channels: self.channels.clone(),
            nuisances: self.nuisances.clone(),
            mechanisms: self.mechanisms.clone(),
            state: self.state.clone(),
            starts: self.starts.clone(),
            here: frequency[0],
        };
        Ok(((frequency[0] - self.here).abs() > 1e-4).then(anew))
    }

    fn starts(&self, _: &[f64]) -> Vec<Vec<f64>> {
        self.starts.clone()
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

/// The frequency that is found, and how likely it is.
fn found(starts: &[f64]) -> (f64, f64) {
    let mut normal = normal(9);
    let y = time().map(|t| (TRUE_FREQUENCY * t).sin() + WHITE * normal()).collect();
    let observed = Observation { time: time().collect(), channels: vec![y] };
    let settled = settled(&Oscillation::new(starts), &[0], &[observed], &|_| ()).expect("a fit");
    (settled.recalibrated.nuisances[0][0], settled.recalibrated.log_evidence)
}

#[test]
fn the_likeliest_of_the_starts_is_followed_and_none_is_worse_than_the_middle() {
    assert_eq!(expected(Oscillation::new(&[]).nuisances()), [1.0]);
    let (lost, unlikely) = found(&[]);
    assert!((lost - TRUE_FREQUENCY).abs() > 0.1, "the middle leads there alone: {lost}");
    for starts in [&[2.1][..], &[0.4, 1.9, 3.0], &[3.0, 0.4, 2.1]] {
        let (frequency, likely) = found(starts);
        assert!((frequency - TRUE_FREQUENCY).abs() < 5e-3 && likely > unlikely + 100.0, "{starts:?}: {frequency}, {likely}");
    }
    let (same, as_likely) = found(&[0.4, 3.0]);
    assert!(as_likely >= unlikely - 0.1, "{same}: {as_likely} against {unlikely}");
}

/// The constants alone come to the true frequency by the start alone; so does what is at work beside them.
#[test]
fn a_mechanism_is_sought_from_the_start_that_is_the_likeliest_with_it() {
    let mut normal = normal(9);
    let y = time().map(|t| (TRUE_FREQUENCY * t).sin() + 0.5 * bow(t) + WHITE * normal()).collect();
    let observed = [Observation { time: time().collect(), channels: vec![y] }];
    let settled = settled(&Oscillation::with_a_bow(&[2.1]), &[0], &observed, &|_| ()).expect("a fit");
    let leading = settled.leading.expect("the bow");
    let (frequency, size) = (leading.nuisances[0][0], leading.active[0].values[0]);
    assert!((frequency - TRUE_FREQUENCY).abs() < 5e-3 && (size - 0.5).abs() < 0.03, "{frequency}, {size}");
}
