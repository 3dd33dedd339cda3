//! Laplace's intervals against the sampler, where the posterior is known.

use crate::common::normal;
use diagnosis::{
    Active, Channel, Fit, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Samples, Settings, State,
    diagnose, sampled,
};

const WHITE: f64 = 0.3;
const ROWS: usize = 80;
const STEPS: usize = 4000;

/// One mechanism whose size acts by a power of it.
struct Power {
    channels: Vec<Channel>,
    mechanisms: Vec<Omission>,
    state: State,
    power: i32,
}

fn time() -> impl Iterator<Item = f64> {
    (0..ROWS).map(|n| 30.0 * n as f64)
}

fn column() -> impl Iterator<Item = f64> {
    time().map(|t| (t / 300.0).sin())
}

impl Power {
    fn new(power: i32) -> Self {
        let noise = NoisePrior::new((WHITE, 1e-4), (1e-9, 1e-4), (1000.0, 1e-4), (1e-9, 1e-4));
        let size = Omission {
            id: "size".into(),
            stage: "any".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 2.0 })],
            choice: None,
            starts: vec![vec![-1.0], vec![1.0]],
            named: true,
            weight: 1.0,
        };
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            mechanisms: vec![size],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            power,
        }
    }

    /// The fit of a record with a size of 1.5, and what the sampler finds of it.
    fn samples(&self) -> (Fit, Samples) {
        let mut normal = normal(4);
        let y = column().map(|c| 1.5_f64.powi(self.power) * c + WHITE * normal()).collect();
        let records = [Observation { time: time().collect(), channels: vec![y] }];
        let found = diagnose(self, &[0], &records, &Settings::default(), &|_| ()).expect("a diagnosis");
        let with = found.candidates.iter().find(|candidate| !candidate.fit.active.is_empty()).expect("a candidate");
        let samples = sampled(self, &[0], &records, &with.fit, STEPS, 1).expect("samples");
        (with.fit.clone(), samples)
    }
}

impl ForwardModel for Power {
    type Error = std::convert::Infallible;

    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &[]
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, _: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Self::Error> {
        let size = active.first().map_or(0.0, |active| active.values[0].powi(self.power));
        Ok(vec![column().map(|c| size * c).collect()])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

#[test]
fn exact_where_the_posterior_is_normal_every_step_is_taken_and_intervals_agree() {
    let (fit, samples) = Power::new(1).samples();
    assert!(samples.taken > 0.999, "{}", samples.taken);
    let [size] = &samples.unknowns[..] else { panic!("one unknown") };
    assert!((size.inside - 0.9).abs() < 0.02, "{}", size.inside);
    let (sampled, laplace) = (size.ci90, size.laplace.ci90());
    let width = laplace[1] - laplace[0];
    assert!((0..2).all(|k| (sampled[k] - laplace[k]).abs() < 0.05 * width), "{sampled:?} {laplace:?}");
    assert!(size.disagreement < 1.01 && size.effective > 1000.0, "{size:?}");
    assert!((size.laplace.value() - fit.active[0].values[0]).abs() < 1e-12);
}

/// A size and its opposite act alike: Laplace's interval is about one of them and holds half of what is likely.
#[test]
fn a_second_minimum_is_found_and_walked_to() {
    let (_, samples) = Power::new(2).samples();
    assert_eq!(samples.minima, 2);
    let [size] = &samples.unknowns[..] else { panic!("one unknown") };
    assert!((size.inside - 0.45).abs() < 0.03, "{}", size.inside);
    assert!(size.ci90[0] < -1.4 && size.ci90[1] > 1.4, "{:?}", size.ci90);
    assert!(size.disagreement < 1.05, "{size:?}");
}
