//! Separation of linear mechanisms under white noise, against least squares in closed form.

use diagnosis::{
    Active, Channel, ForwardModel, Hypothesis, Mechanism, NoisePrior, Nuisance, Observation, Parameter, Plan, Prior, State,
    alternatives, separation,
};

const ROWS: usize = 200;
const WHITE: f64 = 0.1;
const TINY: f64 = 1e-9;

/// y = value × its own wave; the third mechanism chooses between the waves of the others.
struct Waves {
    channels: Vec<Channel>,
    mechanisms: Vec<Mechanism>,
    state: State,
}

fn wave(which: usize, n: usize) -> f64 {
    let t = n as f64 / ROWS as f64 * std::f64::consts::TAU;
    if which == 0 { t.sin() } else { t.sin() + 0.2 * (3.0 * t).cos() }
}

impl Waves {
    fn new() -> Self {
        let noise = NoisePrior { white: (WHITE, 1.0), drift: (TINY, 1.0), drift_time: (100.0, 1.0), walk: (TINY, 1.0) };
        let mechanism = |id: &str, choice| Mechanism {
            id: id.into(),
            stage: "any".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 2.0 })],
            choice,
            starts: vec![vec![0.0]],
            named: true,
            weight: 1.0,
        };
        let either = Some(("wave".to_owned(), vec![0.0, 1.0]));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset_sd: TINY, averaging: 0.0, noise }],
            mechanisms: vec![mechanism("first", None), mechanism("second", None), mechanism("either", either)],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
        }
    }
}

impl ForwardModel for Waves {
    type Error = std::convert::Infallible;

    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &[]
    }

    fn mechanisms(&self) -> &[Mechanism] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, _: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Self::Error> {
        let of = |n: usize| -> f64 {
            active.iter().map(|a| a.values[0] * wave(a.choice.map_or(a.mechanism, |c| c as usize), n)).sum()
        };
        Ok(vec![(0..ROWS).map(of).collect()])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

fn instants(every: usize) -> Observation {
    let recorded = (0..ROWS).map(|n| if n % every == 0 { 0.0 } else { f64::NAN }).collect();
    Observation { time: (0..ROWS).map(|n| 30.0 * n as f64).collect(), channels: vec![recorded] }
}

/// Least of |a x₀ − b x₁|²/σ² + b²/4 over b, and that b, on every `every`th row.
fn exact(a: f64, every: usize) -> (f64, f64) {
    let dot = |i: usize, j: usize| (0..ROWS).step_by(every).map(|n| wave(i, n) * wave(j, n)).sum::<f64>() / (WHITE * WHITE);
    let b = a * dot(0, 1) / (dot(1, 1) + 0.25);
    (a * a * dot(0, 0) - b * a * dot(0, 1), b)
}

#[test]
fn distance_and_fitted_rival_are_those_of_least_squares() {
    let waves = Waves::new();
    let truth = [Active { mechanism: 0, values: vec![3.0], choice: None }];
    for every in [1, 4] {
        let plan = Plan { records: &[0], instants: &[instants(every)], noise: None };
        let found = separation(&waves, &plan, &truth, &alternatives(&waves, 1)).expect("a separation");
        let (squared, b) = exact(3.0, every);
        assert!((found.squared / squared - 1.0).abs() < 1e-5, "{} against {squared}", found.squared);
        assert!((found.rival.active[0].values[0] - b).abs() < 1e-4);
        assert!((found.own - 2.25).abs() < 1e-9 && (found.log_odds() - (squared - 2.25) / 2.0).abs() < 1e-3 * squared);
    }
}

#[test]
fn the_nearest_choice_counts_and_noise_can_be_given() {
    let waves = Waves::new();
    let truth = [Active { mechanism: 0, values: vec![3.0], choice: None }];
    let instants = [instants(1)];
    let plan = Plan { records: &[0], instants: &instants, noise: None };
    let found = separation(&waves, &plan, &truth, &alternatives(&waves, 2)).expect("a separation");
    assert_eq!(found.rival.active[0].choice, Some(0.0));
    assert!(found.squared < 2.26 && found.log_odds() < 0.01, "{found:?}");
    // four times the noise, a sixteenth of the distance to the nominal model, which has nothing to fit
    let nominal =
        |noise| separation(&waves, &Plan { noise, ..plan.clone() }, &truth, &[Hypothesis::NOMINAL]).expect("one").squared;
    let louder = [recording::noise::NoiseModel {
        averaging: 0.0,
        white: 4.0 * WHITE,
        drift: TINY,
        drift_time: 100.0,
        walk: TINY,
        quantisation: 0.0,
    }];
    assert!((nominal(None) / nominal(Some(&louder)) - 16.0).abs() < 1e-3);
}

#[test]
fn nothing_to_compare_is_an_error() {
    let waves = Waves::new();
    let plan = Plan { records: &[0], instants: &[], noise: None };
    assert!(separation(&waves, &plan, &[], &[Hypothesis::NOMINAL]).is_err());
    let instants = [instants(1)];
    let plan = Plan { records: &[0], instants: &instants, noise: None };
    assert!(separation(&waves, &plan, &[], &[]).is_err());
    assert!(separation(&waves, &Plan { noise: Some(&[]), ..plan }, &[], &[Hypothesis::NOMINAL]).is_err());
}
