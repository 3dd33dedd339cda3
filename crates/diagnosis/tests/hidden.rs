//! A mechanism that a constant hides: where the constant has gone to make up for it, the mechanism does next to nothing.

use crate::common::normal;
use diagnosis::{
    Active, Channel, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, Settings, State,
    diagnose_settled, settled,
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
        // elsewhere it is not good
        let bent = 0.1 * (constant[0] - self.about);
        Ok(vec![shape().map(|x| amplitude * x + bent * (1.0 - x * x)).collect()])
    }

    fn about(&self, constant: &[f64], _: &[Active]) -> Result<Option<Self>, diagnosis::Failure> {
        Ok(((constant[0] - self.about).abs() > 1e-3).then(|| Self::about(constant[0])))
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

/// A record that has so much of the shape.
fn observed(amplitude: f64) -> Observation {
    let mut normal = normal(9);
    let y = shape().map(|x| amplitude * x + WHITE * normal()).collect();
    Observation { time: (0..ROWS).map(|n| 60.0 * n as f64).collect(), channels: vec![y] }
}

/// The leader's size, if one leads.
fn leading(amplitude: f64) -> Option<f64> {
    let settled = settled(&Hidden::about(0.0), &[0], &[observed(amplitude)], &|_| ()).expect("a fit");
    settled.leading.map(|leading| leading.active[0].values[0])
}

#[test]
fn a_constant_that_went_far_is_doubted() {
    let size = leading(TRUTH).expect("one leads");
    // the constant keeps a part of it
    assert!((0.75 * TRUTH..1.5 * TRUTH).contains(&size), "{size}");
}

#[test]
fn a_constant_within_its_tolerance_is_not() {
    assert_eq!(leading(0.7), None);
}

/// The constants alone are judged by the model about them, not by the one about the leader.
#[test]
fn the_constants_alone_are_as_likely_as_about_themselves() {
    let (hidden, records) = (Hidden::about(0.0), [observed(TRUTH)]);
    let mut settled = settled(&hidden, &[0], &records, &|_| ()).expect("a fit");
    let alone = settled.recalibrated.log_evidence;
    let found = diagnose_settled(&hidden, &mut settled, &[0], &records, &Settings::default(), &|_| ()).expect("a diagnosis");
    let constants: Vec<f64> = found.candidates.iter().filter(|c| c.is_constants_alone()).map(|c| c.fit.log_evidence).collect();
    assert!(constants.iter().all(|evidence| (evidence - alone).abs() < 0.5) && !constants.is_empty(), "{constants:?}, {alone}");
    // and the model that is left for them is the one about them
    let of_them = settled.recalibrated.nuisances[0][0];
    let [leading, alone] = [settled.model.as_ref().expect("a model").about, settled.alone(&hidden).about];
    assert!((alone - of_them).abs() < 0.1 && (leading - of_them).abs() > 1.0, "{leading}, {alone}, {of_them}");
    assert_eq!(settled.into_alone().map(|model| model.about), Some(alone));
}
