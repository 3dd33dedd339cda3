//! The search for single mechanisms among many that have no name, each of which adds a size times a column of its own.

use crate::common::normal;
use diagnosis::{
    Active, Channel, Diagnosis, Fit, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Settings,
    State, diagnose,
};

const ROWS: usize = 100;
const WHITE: f64 = 0.5;
const SIZE: f64 = 3.0;
/// What is at work is the first column; those after it are ever less like it, and the last is unlike it.
const COLUMNS: usize = 8;
const UNLIKE: usize = COLUMNS - 1;
/// The mechanism that may be at either of two columns.
const EITHER: usize = 3;
const OF_EITHER: [usize; 2] = [3, 6];

struct Columns {
    channels: Vec<Channel>,
    mechanisms: Vec<Omission>,
    state: State,
}

fn column(number: usize) -> Vec<f64> {
    let of = |n: usize| {
        let x = n as f64 / ROWS as f64;
        let beside = (9.0 + 2.0 * number as f64) * x;
        match number {
            UNLIKE => (x - 0.5).powi(2),
            6 => (7.0 * x).sin() + 0.25 * beside.cos(),
            _ => (7.0 * x).sin() + 0.06 * (number as f64).sqrt() * beside.cos(),
        }
    };
    (0..ROWS).map(of).collect()
}

impl Columns {
    fn new() -> Self {
        let mechanism = |number: usize| Omission {
            id: format!("unknown:{number}"),
            stage: "any".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 5.0 })],
            choice: (number == EITHER).then(|| ("column".into(), OF_EITHER.map(|column| column as f64).to_vec())),
            starts: vec![vec![1.0]],
            named: false,
            weight: 1.0 + number as f64,
        };
        let mut mechanisms: Vec<Omission> = (0..COLUMNS).map(mechanism).collect();
        mechanisms.remove(OF_EITHER[1]);
        let noise = NoisePrior::new((WHITE, 0.7), (1e-9, 1e-4), (1000.0, 1e-4), (1e-9, 1e-4));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            mechanisms,
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
        }
    }

    fn diagnosed(&self) -> Diagnosis {
        let mut normal = normal(2);
        let y = column(0).iter().map(|x| SIZE * x + WHITE * normal()).collect();
        let observed = Observation { time: (0..ROWS).map(|n| 30.0 * n as f64).collect(), channels: vec![y] };
        diagnose(self, &[0], &[observed], &Settings::default(), &|_| ()).expect("a diagnosis")
    }
}

/// The column that the only mechanism of a fit adds.
fn column_of(active: &Active) -> usize {
    active.choice.map_or(if active.mechanism < OF_EITHER[1] { active.mechanism } else { UNLIKE }, |choice| choice as usize)
}

impl ForwardModel for Columns {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &[]
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, _: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let mut y = vec![0.0; ROWS];
        for active in active {
            y.iter_mut().zip(column(column_of(active))).for_each(|(y, x)| *y += active.values[0] * x);
        }
        Ok(vec![y])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

/// White noise of a fit, and the root mean square of what it leaves.
fn noise(fit: &Fit) -> [f64; 2] {
    let squares = fit.residuals[0][0].iter().map(|r| r * r).sum::<f64>();
    [fit.noise_model(0, 0).white, (squares / ROWS as f64).sqrt()]
}

#[test]
fn whatever_is_not_far_behind_has_the_noise_that_it_leaves_and_another_choice_that_of_the_best() {
    let found = Columns::new().diagnosed();
    let of = |column: usize| {
        let is = |fit: &&Fit| matches!(&fit.active[..], [active] if column_of(active) == column);
        let mut plain = found.candidates.iter().filter(|c| c.rival.is_none()).map(|c| &c.fit);
        plain.find(is).expect("it was compared")
    };
    let best = of(0).log_evidence;
    for column in 0..6 {
        let [white, left] = noise(of(column));
        assert!((white / left - 1.0).abs() < 0.03 && best - of(column).log_evidence < 25.0, "{column}: {white} of {left}");
    }
    let [of_best, _] = noise(of(0));
    let [white, left] = noise(of(UNLIKE));
    assert!((white / of_best - 1.0).abs() < 0.03 && left > 2.0 * of_best, "{white} of {left} beside {of_best}");
    let [one, other] = OF_EITHER.map(|column| noise(of(column))[0]);
    assert!(other == one && one > 1.02 * of_best, "{other}, {one}, {of_best}");
}

#[test]
fn mechanisms_without_a_name_share_a_third_of_the_unknown_by_their_weights() {
    let found = Columns::new().diagnosed();
    let priors = || {
        let plain = found.candidates.iter().filter(|c| c.rival.is_none());
        plain.filter_map(|c| Some((column_of(c.fit.active.first()?), c.log_prior().exp())))
    };
    let together: f64 = priors().map(|(_, prior)| prior).sum();
    assert!((together - Settings::default().unknown / 3.0).abs() < 1e-9, "{together}");
    let of = |column: usize| priors().find(|(of, _)| *of == column).expect("it was compared").1;
    // each choice has half of its mechanism's
    for (column, weight) in [(5, 6.0), (UNLIKE, 8.0), (OF_EITHER[0], 2.0), (OF_EITHER[1], 2.0)] {
        assert!((of(column) / of(0) - weight).abs() < 1e-6, "{column}: {}", of(column) / of(0));
    }
}
