//! Searches among mechanisms with a name, each of which adds a size times a column of its own; the columns are waves that have nothing to do with each other.

#![cfg(test)]

use super::{FOLLOWED, LEADERS, PAIRS, Pool, SINGLES, Settings, diagnose};
use crate::fit::{Fit, Fitter, Hypothesis, alternatives};
use crate::noise::Noise;
use crate::{
    Active, Candidate, Channel, Failure, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Rival,
    Role, State, Structure,
};
use progress::Step;
use std::cell::RefCell;

const ROWS: usize = 60;
const WHITE: f64 = 0.5;
/// The column of the model's number, if it has one; a part of it goes with the mechanism in valleys.
const OWN: usize = 11;

struct Columns {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    /// The mechanism whose size counts by [`valleys`].
    in_valleys: Option<usize>,
}

fn column(number: usize) -> impl Iterator<Item = f64> {
    (0..ROWS).map(move |n| (std::f64::consts::TAU * (number + 1) as f64 * n as f64 / ROWS as f64).sin())
}

/// Sizes of the first two columns: one of 9 and none are nearest at a size of 1 on one branch, and reached at 10.5 on the other.
fn valleys(size: f64) -> [f64; 2] {
    if size < 4.0 { [8.0, 2.0 * (size - 1.0)] } else { [6.0 + 1.2 * (size - 8.0), 0.0] }
}

impl Columns {
    fn new(count: usize) -> Self {
        let mechanism = |number: usize| Omission {
            id: number.to_string(),
            stage: "any".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 5.0 })],
            choice: None,
            starts: vec![vec![1.0]],
            named: true,
            weight: 1.0,
        };
        let noise = NoisePrior::new((WHITE, 0.7), (1e-9, 1e-4), (1000.0, 1e-4), (1e-9, 1e-4));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: Vec::new(),
            mechanisms: (0..count).map(mechanism).collect(),
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            in_valleys: None,
        }
    }

    /// The same where a mechanism has so many choices, all of which do the same.
    fn with_choices(mut self, mechanism: usize, choices: usize) -> Self {
        self.mechanisms[mechanism].choice = Some(("place".into(), (0..choices).map(|place| place as f64).collect()));
        self
    }

    fn with_number(mut self, role: Role) -> Self {
        self.nuisances = vec![Nuisance::normal("number", 0.0, 1.0, role)];
        self
    }

    /// What a pool holds after its search for single mechanisms, and for pairs if they are asked for; and all that it told.
    fn searched(&self, sizes: &[f64], pairs: bool) -> Searched {
        let (observed, told) = ([observed(sizes)], RefCell::new(Vec::new()));
        let listener = |step: Step| told.borrow_mut().extend(step.done.map(|done| (step.task.to_owned(), done)));
        let mut pool = self.pool(&observed, &[], &listener);
        let nominal = pool.nominal().expect("a fit");
        let (leader, fits) = pool.singles(&nominal).expect("fits");
        pool.without_mechanisms(nominal, &leader).expect("a fit");
        let likeliest = pool.likeliest(fits.clone()).expect("fits");
        if pairs {
            pool.pairs(&likeliest).expect("fits");
        }
        let candidates = pool.candidates;
        Searched { fits, likeliest, candidates, told: told.into_inner() }
    }

    fn pool<'a>(&'a self, observed: &'a [Observation], known: &'a [Fit], progress: &'a dyn Fn(Step)) -> Pool<'a> {
        Pool {
            fitter: Fitter::new(self, &[0], observed).expect("a fitter"),
            settings: Settings::default(),
            singles: (0..self.mechanisms.len()).map(|m| alternatives(self, m)).collect(),
            candidates: Vec::new(),
            known,
            leading: None,
            progress,
        }
    }
}

struct Searched {
    fits: Vec<Fit>,
    likeliest: Vec<Fit>,
    candidates: Vec<Candidate>,
    /// Tasks with how much of them is done, of how much.
    told: Vec<(String, (usize, usize))>,
}

impl Searched {
    /// What was told of a task: how much is done, of how much.
    fn counts(&self, task: &str) -> Vec<(usize, usize)> {
        self.told.iter().filter(|(of, _)| of == task).map(|(_, done)| *done).collect()
    }

    fn with(&self, count: usize) -> Vec<&Candidate> {
        self.candidates.iter().filter(|c| c.fit.active.len() == count).collect()
    }
}

/// A record of so much of each column, and of what is like noise.
fn observed(sizes: &[f64]) -> Observation {
    let mut y: Vec<f64> = (0..ROWS).map(|n| 1.4 * WHITE * (0.7 * (n * n) as f64).sin()).collect();
    for (number, size) in sizes.iter().enumerate() {
        y.iter_mut().zip(column(number)).for_each(|(y, x)| *y += size * x);
    }
    Observation { time: (0..ROWS).map(|n| 30.0 * n as f64).collect(), channels: vec![y] }
}

fn white(fit: &Fit) -> f64 {
    fit.noise_model(0, 0).white
}

impl ForwardModel for Columns {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, numbers: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Failure> {
        let mut y = vec![0.0; ROWS];
        let mut add = |size: f64, number: usize| y.iter_mut().zip(column(number)).for_each(|(y, x)| *y += size * x);
        numbers.iter().for_each(|number| add(*number, OWN));
        for Active { mechanism, values, .. } in active {
            if self.in_valleys == Some(*mechanism) {
                valleys(values[0]).iter().enumerate().for_each(|(number, size)| add(*size, number));
                add(0.5, OWN);
            } else {
                add(values[0], *mechanism);
            }
        }
        Ok(vec![y])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

#[test]
fn what_is_known_of_a_mechanism_stands_for_it_alone_and_not_beside_a_structure() {
    let (columns, observed) = (Columns::new(2).with_number(Role::Constant), [observed(&[3.0])]);
    let of = |hypothesis: &Hypothesis| {
        let fitter = Fitter::new(&columns, &[0], &observed).expect("a fitter");
        let noise = Noise::typical(&columns.channels, &observed).expect("noise");
        fitter.fit(hypothesis, &noise, None).expect("a fit")
    };
    let fits = [of(&alternatives(&columns, 0)[0]), of(&Hypothesis::RECALIBRATED)];
    let known = fits.clone().map(|fit| Fit { log_evidence: fit.log_evidence - 7.0, ..fit });
    let structure = Rival { structure: Structure::Step, channel: 0, at: None, gain: 2.0 };
    for (place, rival, by) in [(0, None, 7.0), (0, Some(structure.clone()), 0.0), (1, None, 0.0), (1, Some(structure), 0.0)] {
        let mut pool = columns.pool(&observed, &known, &|_| ());
        pool.push(fits[place].clone(), rival.clone());
        let less = fits[place].log_evidence - pool.candidates[0].fit.log_evidence;
        assert!((less - by).abs() < 1e-9, "{place} {rival:?}: {less}");
    }
}

#[test]
fn constants_are_re_estimated_where_there_are_any() {
    for (role, expected) in [(Role::Constant, &[false, true][..]), (Role::Sensor, &[false]), (Role::ModelError, &[false])] {
        let columns = Columns::new(1).with_number(role);
        let found = diagnose(&columns, &[0], &[observed(&[0.0])], &Settings::default(), &|_| ()).expect("a diagnosis");
        let plain = found.candidates.iter().filter(|c| c.rival.is_none() && c.fit.active.is_empty());
        let mut free: Vec<bool> = plain.map(|c| c.fit.hypothesis.constants_free).collect();
        free.sort_unstable();
        assert_eq!(free, expected, "{role:?}");
    }
}

#[test]
fn progress_counts_every_mechanism_of_every_round_once() {
    let counts = Columns::new(4).searched(&[3.0], false).counts(SINGLES);
    assert!(counts.len() > 4, "one round: {counts:?}");
    let of = counts[0].1;
    assert_eq!(of, 12);
    assert_eq!(counts, (0..counts.len()).map(|done| (done, of)).collect::<Vec<_>>());
}

/// The start that seems the likeliest leads to the poorer of two valleys; the first round follows both.
#[test]
fn a_round_goes_on_from_where_the_one_before_found_a_mechanism() {
    let mut columns = Columns::new(2);
    columns.in_valleys = Some(1);
    columns.mechanisms[1].starts = vec![vec![1.0], vec![8.0]];
    columns.mechanisms[1].parameters[0].prior = Prior::Normal { mean: 0.0, sd: 50.0 };
    let searched = columns.searched(&[9.0], false);
    assert!(searched.counts(SINGLES).len() > 2 && searched.fits[0].hypothesis.has(0));
    let of = searched.fits.iter().find(|fit| fit.hypothesis.has(1)).expect("it was compared");
    assert!((of.active[0].values[0] - 10.5).abs() < 0.5, "{:?}", of.active);
}

#[test]
fn of_mechanisms_far_behind_those_have_noise_of_their_own_that_make_up_a_handful() {
    let searched = Columns::new(8).searched(&[9.0], false);
    let under = white(&searched.fits[0]);
    let own = searched.with(1).iter().filter(|c| white(&c.fit) > 2.0 * under).count();
    // and the likeliest, which leaves no more than before
    assert_eq!((searched.with(1).len(), own + 1, searched.likeliest.len()), (8, FOLLOWED, FOLLOWED));
}

/// Seven that are all at work: all pairs are met but those of mechanisms that no leader is among.
#[test]
fn pairs_are_sought_of_a_handful_and_a_handful_of_each_has_noise_of_its_own() {
    let searched = Columns::new(7).searched(&[1.9, 1.85, 1.8, 1.75, 1.7, 1.65, 1.6], true);
    assert_eq!(searched.counts(PAIRS), (0..LEADERS).map(|done| (done, LEADERS)).collect::<Vec<_>>());
    let pairs = searched.with(2);
    assert_eq!(pairs.len(), 7 * 6 / 2 - 1);
    let first = &searched.likeliest[0];
    let of_first = pairs.iter().map(|c| &c.fit).filter(|fit| fit.hypothesis.mechanisms[0] == first.hypothesis.mechanisms[0]);
    let (own, under): (Vec<&Fit>, Vec<&Fit>) = of_first.partition(|fit| white(fit) != white(first));
    assert_eq!((own.len(), under.len()), (FOLLOWED, 1));
    assert!(own.iter().all(|fit| fit.log_evidence > under[0].log_evidence && white(fit) < white(first)));
}

#[test]
fn a_pair_stands_for_the_choices_of_both_its_mechanisms() {
    let columns = Columns::new(3).with_choices(0, 3).with_choices(1, 13);
    let searched = columns.searched(&[3.0, 0.4, 0.4], true);
    for (second, choices) in [(1, 13.0 / 5.0), (2, 1.0)] {
        let pairs = searched.with(2);
        let of: Vec<&&Candidate> = pairs.iter().filter(|c| c.fit.hypothesis.numbers() == [0, second]).collect();
        assert_eq!(of.len(), if second == 1 { 5 } else { 1 });
        for pair in of {
            let beforehand = Settings::default().log_prior(&columns, &pair.fit.hypothesis, false);
            let stands_for = (pair.log_prior() - beforehand).exp();
            assert!((stands_for / (3.0 * choices) - 1.0).abs() < 0.01, "{second}: {stands_for}");
        }
    }
}
