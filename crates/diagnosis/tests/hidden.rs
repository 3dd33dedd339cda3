//! A mechanism that a constant hides: where the constant has gone to make up for it, the mechanism does next to nothing.

use crate::common::normal;
use diagnosis::{
    Active, Channel, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State, settled,
};

const WHITE: f64 = 0.05;
const ROWS: usize = 241;
const TRUTH: f64 = 4.0;

/// A constant and a mechanism of one shape.
struct Hidden {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    /// value of the constant that it is made about
    about: f64,
}

fn shape() -> impl Iterator<Item = f64> {
    (0..ROWS).map(|n| (5.0 * n as f64 / (ROWS - 1) as f64).sin())
}

impl Hidden {
    fn about(about: f64) -> Self {
        let noise = NoisePrior::new((WHITE, 1e-4), (1e-9, 1e-4), (100.0, 1e-4), (1e-9, 1e-4));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![Nuisance::normal("constant", 0.0, 1.0, Role::Constant)],
            mechanisms: vec![Omission {
                id: "hidden".into(),
                stage: "one".into(),
                parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 5.0 })],
                choice: None,
                starts: vec![vec![1.0]],
                named: true,
                weight: 1.0,
            }],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            about,
        }
    }
}

impl ForwardModel for Hidden {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, constant: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let size: f64 = active.iter().map(|a| a.values[0]).sum();
        let amplitude = constant[0] + size * (-self.about.powi(2)).exp();
        Ok(vec![shape().map(|x| amplitude * x).collect()])
    }

    fn about(&self, constant: &[f64], _: &[Active]) -> Result<Option<Self>, diagnosis::Failure> {
        Ok(((constant[0] - self.about).abs() > 1e-3).then(|| Self::about(constant[0])))
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

/// The leader's size, if one leads, where the record has so much of the shape.
fn leading(amplitude: f64) -> Option<f64> {
    let mut normal = normal(9);
    let y = shape().map(|x| amplitude * x + WHITE * normal()).collect();
    let observed = Observation { time: (0..ROWS).map(|n| 60.0 * n as f64).collect(), channels: vec![y] };
    let settled = settled(&Hidden::about(0.0), &[0], &[observed], &|_| ()).expect("a fit");
    settled.leading.map(|leading| leading.active[0].values[0])
}

#[test]
fn a_constant_that_went_far_is_doubted() {
    let size = leading(TRUTH).expect("one leads");
    assert!((size - TRUTH).abs() < 0.4, "{size}");
}

#[test]
fn a_constant_within_its_tolerance_is_not() {
    assert_eq!(leading(0.7), None);
}
