//! Diagnoses of waves in readings without noise, judged by a record that was held out.

#![cfg(test)]

use super::{Candidate, Diagnosis, Judgement, Ruling, Verdict};
use crate::fit::{Fitter, Hypothesis};
use crate::noise::Noise;
use crate::{Active, Channel, Failure, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Rival};
use crate::{Role, State, Structure};

const ROWS: usize = 100;

/// A reading of two waves: one as high as the design's constant, which should be 0, and one that the first mechanism makes. The second mechanism
/// has no name and does nothing.
struct Waves {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    /// Phase of the constant's wave before the mechanism's.
    ahead: f64,
    /// Height of the mechanism's wave in the record that is held out, over that in the one that is fitted.
    grown: f64,
}

impl Waves {
    fn new(ahead: f64, grown: f64) -> Self {
        let mechanism = |id: &str, named: bool| Omission {
            id: id.into(),
            stage: "sensor".into(),
            parameters: vec![Parameter::new("height", Prior::Normal { mean: 0.0, sd: 1.0 })],
            choice: None,
            starts: vec![vec![0.5]],
            named,
            weight: 1.0,
        };
        let noise = NoisePrior::new((0.1, 1e-3), (1e-9, 1e-3), (1500.0, 1e-3), (1e-12, 1e-3));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1e-6), averaging: 60.0, noise }],
            nuisances: vec![Nuisance::normal("constant", 0.0, 1.0, Role::Constant)],
            mechanisms: vec![mechanism("wave", true), mechanism("nothing", false)],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            ahead,
            grown,
        }
    }

    /// A record with waves of the constant and of the mechanism.
    fn record(&self, number: usize, constant: f64, mechanism: f64) -> Observation {
        let height = mechanism * if number == 0 { 1.0 } else { self.grown };
        let reading = |n: usize| {
            let phase = std::f64::consts::TAU * n as f64 / 20.0;
            constant * (phase + self.ahead).sin() + height * phase.sin()
        };
        Observation { time: (0..ROWS).map(|n| 60.0 * n as f64).collect(), channels: vec![(0..ROWS).map(reading).collect()] }
    }

    /// A diagnosis of a record with these candidates, each a hypothesis, whether it has a structure, and its probability.
    fn found(&self, of: &Observation, verdict: Verdict, verdicts: [f64; 4], candidates: &[(Hypothesis, bool, f64)]) -> Diagnosis {
        let fitter = Fitter::new(self, &[0], std::slice::from_ref(of)).expect("a fitter");
        let typical = Noise::typical(&self.channels, std::slice::from_ref(of)).expect("noise");
        let fit = |hypothesis: &Hypothesis| fitter.fit(hypothesis, &typical, None).expect("a fit");
        let structure = || Rival { structure: Structure::Step, channel: 0, at: None, gain: 0.0 };
        let candidate = |(hypothesis, rival, probability): &(Hypothesis, bool, f64)| Candidate {
            fit: fit(hypothesis),
            rival: rival.then(structure),
            log_weight: probability.ln(),
            probability: *probability,
        };
        let candidates: Vec<Candidate> = candidates.iter().map(candidate).collect();
        let plain = candidates.iter().filter(|c| c.rival.is_none() && c.fit.hypothesis.has(0));
        let nominal = fit(&Hypothesis::NOMINAL);
        Diagnosis {
            verdict,
            mechanisms: vec![(0, plain.map(|c| c.probability).sum())],
            set: vec![0],
            parameters: candidates[0].fit.active.iter().map(|_| Vec::new()).collect(),
            mismatch: nominal.clone(),
            nominal,
            stages: Vec::new(),
            verdicts,
            excluded: 0.03,
            candidates,
        }
    }

    fn judged(&self, diagnosis: &mut Diagnosis, fitted: &Observation, held: &[(usize, &Observation)]) -> Judgement {
        diagnosis.judge(self, self, None, (0, fitted), held, 0).expect("a judgement")
    }
}

impl ForwardModel for Waves {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Failure> {
        let height = active.iter().filter(|a| a.mechanism == 0).map(|a| a.values[0]).sum();
        Ok(self.record(record, nuisances[0], height).channels)
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

/// A mechanism alone.
fn only(mechanism: usize) -> Hypothesis {
    Hypothesis { mechanisms: vec![(mechanism, None)], constants_free: false }
}

fn assert_near(found: [f64; 4], expected: [f64; 4]) {
    assert!(found.iter().zip(expected).all(|(f, e)| (f - e).abs() < 1e-12), "{found:?} {expected:?}");
}

/// The constant does in both records what the mechanism did in the first.
#[test]
fn constants_that_predict_better_take_the_explanation_s_place_by_the_odds_of_both_records() {
    let waves = Waves::new(0.0, 1.03);
    let [fitted, held] = [0, 1].map(|number| waves.record(number, 1.0, 0.0));
    let verdicts = [0.01, 0.3, 0.65, 0.04];
    let candidates = [
        (only(0), false, 0.65),
        (Hypothesis::RECALIBRATED, true, 0.04),
        (Hypothesis::RECALIBRATED, false, 0.3),
        (Hypothesis::NOMINAL, false, 0.01),
    ];
    let mut found = waves.found(&fitted, Verdict::Explained, verdicts, &candidates);
    let before = found.clone();
    let Judgement { records, ruling, withdrawn } = waves.judged(&mut found, &fitted, &[(1, &held)]);
    assert_eq!((ruling, found.verdict, withdrawn.len()), (Ruling::Outweighed, Verdict::Recalibrate, 0));
    // odds beforehand, times the ratio of the probabilities of the record that was held out
    let score = |c: usize| before.candidates[c].fit.hold_out(&waves, 1, &held, &before.best().fit).expect("held out").log_score;
    let (none, constants) = ((score(3) - score(0)).exp(), (score(2) - score(0)).exp());
    assert!(none < 1e-99 && constants > 2.5, "{none} {constants}");
    let sum = 0.3 * constants + 0.65 + 0.04;
    assert_near(found.verdicts(), [0.0, 0.3 * constants / sum, 0.65 / sum, 0.04 / sum]);
    // the mechanism stands in what explains, and nowhere else
    assert!((found.mechanisms[0].1 - found.verdicts()[2]).abs() < 1e-12, "{:?}", found.mechanisms);
    assert!(found.best().is_constants_alone() && found.set.is_empty() && found.parameters.is_empty());
    // what is told of the record is what its constants predict
    assert!(records[0].constants.as_ref() == Some(&records[0].model) && records[0].accepted);
    assert!(records[0].model.rmse[0] < 0.01 && records[0].nominal.rmse[0] > 0.5, "{:?}", records[0].model.rmse);
}

#[test]
fn of_the_design_and_its_constants_the_likelier_stands_and_the_design_where_they_are_alike() {
    let waves = Waves::new(0.0, 1.0);
    let [fitted, held] = [0, 1].map(|number| waves.record(number, 0.0, 0.0));
    for (none, recalibrate, verdict) in [(0.4, 0.2, Verdict::None), (0.3, 0.3, Verdict::None), (0.2, 0.4, Verdict::Recalibrate)] {
        let candidates = [
            (only(0), false, 0.3),
            (Hypothesis::NOMINAL, true, 0.1),
            (Hypothesis::RECALIBRATED, false, recalibrate),
            (Hypothesis::NOMINAL, false, none),
        ];
        let verdicts = [none, recalibrate, 0.3, 0.1];
        let found = waves.found(&fitted, Verdict::Explained, verdicts, &candidates);
        let mut alone = found.clone();
        assert_eq!(waves.judged(&mut alone, &fitted, &[]).ruling, Ruling::Outweighed);
        assert_near(alone.verdicts(), verdicts);
        let place = if verdict == Verdict::None { 3 } else { 2 };
        let (best, stands) = (alone.best(), &found.candidates[place]);
        assert_eq!((alone.verdict, &best.fit.hypothesis, &best.rival), (verdict, &stands.fit.hypothesis, &None));
        assert!(alone.set.is_empty() && alone.parameters.is_empty());
        assert!((alone.mechanisms[0].1 - 0.3).abs() < 1e-12, "{:?}", alone.mechanisms);
        // a record in which there is nothing is predicted by the design
        if none > recalibrate {
            let mut judged = found.clone();
            let records = waves.judged(&mut judged, &fitted, &[(1, &held)]).records;
            assert_eq!((judged.verdict, &records[0].model), (Verdict::None, &records[0].nominal));
        }
    }
}

#[test]
fn what_stands_beside_a_structure_is_named_where_it_is_nearly_certain_and_takes_all_with_it() {
    let waves = Waves::new(std::f64::consts::FRAC_PI_2, 1.0);
    let [fitted, held] = [0, 1].map(|number| waves.record(number, 0.0, 1.0));
    let of = |beside: f64| {
        let candidates = [
            (only(0), true, beside),
            (only(0), false, 0.11),
            (only(1), false, 0.77 - beside),
            (Hypothesis::RECALIBRATED, false, 0.06),
            (Hypothesis::NOMINAL, false, 0.04),
            (Hypothesis::NOMINAL, true, 0.02),
        ];
        let mut found = waves.found(&fitted, Verdict::Unknown, [0.04, 0.06, 0.11, 0.79], &candidates);
        let ruling = waves.judged(&mut found, &fitted, &[(1, &held)]).ruling;
        (ruling, found)
    };
    let (ruling, named) = of(0.7);
    assert_eq!((ruling, named.verdict, named.set.as_slice()), (Ruling::AcceptedBeside, Verdict::Explained, &[0][..]));
    assert!(named.mechanisms[0].0 == 0 && (named.mechanisms[0].1 - 0.81).abs() < 1e-12, "{:?}", named.mechanisms);
    // unknown are what has no name and a structure alone
    assert_near(named.verdicts(), [0.04, 0.06, 0.81, 0.09]);
    // less than four in five
    let (ruling, doubtful) = of(0.68);
    assert_eq!((ruling, doubtful.verdict, doubtful.verdicts()), (Ruling::Stands, Verdict::Unknown, [0.04, 0.06, 0.11, 0.79]));
}
