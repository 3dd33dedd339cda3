//! A thermometer in a bath, of which the nominal model knows the bath and the gain: the engine must name what is left out, and only then.

use diagnosis::{
    Active, Channel, Contradiction, Diagnosis, ForwardModel, Judged, Latent, NoisePrior, Nuisance, Observation, Omission,
    Parameter, Prior, Rival, Role, Ruling, Settings, State, Structure, Verdict, diagnose, gained_by_noise_of,
};

pub(crate) const ROWS: usize = 600;
const STEP_S: f64 = 30.0;

/// Number of the mechanism that stands for the constant, where a bath has it.
const FACTOR: usize = 2;

pub(crate) struct Bath {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    states: Vec<State>,
    time: Vec<f64>,
    /// A record in which nothing can act at a stage.
    lacking: Option<(usize, &'static str)>,
    /// Whether one of its members does nothing.
    idle: bool,
}

fn mechanism(id: &str, stage: &str, parameters: Vec<Parameter>, start: Vec<f64>) -> Omission {
    let (id, stage) = (id.to_owned(), stage.to_owned());
    Omission { id, stage, parameters, choice: None, starts: vec![start], named: true, weight: 1.0 }
}

impl Bath {
    /// Two courses of the bath: one to fit, one to judge.
    pub(crate) fn new() -> Self {
        let time: Vec<f64> = (0..ROWS).map(|n| STEP_S * n as f64).collect();
        let course = |fast: f64| {
            let level: Vec<f64> = time.iter().map(|t| 20.0 * (t / 2000.0).sin() + 15.0 * (fast * t / 2000.0).sin()).collect();
            let slope = |t: &f64| (20.0 * (t / 2000.0).cos() + 15.0 * fast * (fast * t / 2000.0).cos()) / 2000.0;
            State { level, rate: time.iter().map(slope).collect() }
        };
        let noise = NoisePrior::new((0.1, 0.7), (0.03, 0.7), (1500.0, 0.5), (1e-5, 1.0));
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![
                Nuisance::normal("gain", 1.0, 1e-3, Role::ModelError),
                Nuisance::normal("constant", 1.0, 0.03, Role::Constant),
            ],
            mechanisms: vec![
                mechanism(
                    "lag",
                    "sensor",
                    vec![Parameter::new("lag_s", Prior::LogNormal { median: 60.0, spread: 1.0 })],
                    vec![60.0],
                ),
                mechanism("bend", "optics", vec![Parameter::new("bend", Prior::Normal { mean: 0.0, sd: 2.0 })], vec![0.0]),
            ],
            states: vec![course(2.7), course(1.9)],
            time,
            lacking: None,
            idle: false,
        }
    }

    pub(crate) fn level(&self, record: usize) -> &[f64] {
        &self.states[record].level
    }

    pub(crate) fn truth(&self, record: usize, mechanism: Option<(usize, f64)>) -> Vec<f64> {
        let active: Vec<Active> =
            mechanism.map(|(mechanism, value)| Active { mechanism, values: vec![value], choice: None }).into_iter().collect();
        self.respond(record, &[1.0, 1.0], &active).expect("a response").remove(0)
    }
}

impl ForwardModel for Bath {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn stands_for(&self, mechanism: usize) -> Option<usize> {
        (mechanism == FACTOR).then_some(1)
    }

    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let State { level, rate } = &self.states[record];
        let mut y: Vec<f64> = rate.iter().map(|r| 100.0 * nuisances[0] * nuisances[1] * r).collect();
        for active in active {
            match active.mechanism {
                0 => {
                    let mut x = y[0];
                    for y in &mut y {
                        x += (*y - x) * -(-STEP_S / active.values[0].max(1e-6)).exp_m1();
                        *y = x;
                    }
                }
                // in place of the constant
                FACTOR => y.iter_mut().for_each(|y| *y *= active.values[0] / nuisances[1]),
                _ => y.iter_mut().zip(level).zip(rate).for_each(|((y, l), r)| *y += active.values[0] * l * r),
            }
        }
        Ok(vec![y])
    }

    fn state(&self, record: usize) -> &State {
        &self.states[record]
    }

    fn latent(&self, record: usize) -> Result<Vec<Latent>, diagnosis::Failure> {
        let State { level, rate } = &self.states[record];
        let one = |stage: &str, series: Vec<f64>| Latent { stage: stage.to_owned(), functions: vec![vec![series]] };
        let mut stages = vec![
            one("sensor", rate.windows(2).map(|r| r[1] - r[0]).chain([0.0]).collect()),
            one("optics", level.iter().zip(rate).map(|(l, r)| l * r).collect()),
            one("electronics", level.clone()),
        ];
        stages.retain(|latent| self.lacking.is_none_or(|(of, stage)| of != record || stage != latent.stage));
        Ok(stages)
    }

    /// Two that do the same, one of its own, and one that does nothing where there is such a one.
    fn members(&self, record: usize) -> Result<Option<Latent>, diagnosis::Failure> {
        let State { level, rate } = &self.states[record];
        let bend: Vec<f64> = level.iter().zip(rate).map(|(l, r)| l * r).collect();
        let idle = self.idle.then(|| vec![0.0; ROWS]);
        let functions = [bend.clone(), bend, level.clone()].into_iter().chain(idle).map(|series| vec![series]).collect();
        Ok(Some(Latent { stage: "optics".to_owned(), functions }))
    }
}

/// White noise of 0.1 and a drift of 0.03 over 1500 s.
fn noise(seed: u64) -> Vec<f64> {
    let mut normal = crate::common::normal(seed);
    let keep = (-STEP_S / 1500.0_f64).exp();
    let mut drift = 0.03 * normal();
    (0..ROWS)
        .map(|_| {
            drift = keep * drift + 0.03 * (1.0 - keep * keep).sqrt() * normal();
            drift + 0.1 * normal()
        })
        .collect()
}

pub(crate) fn observed(bath: &Bath, y: &[f64], seed: u64) -> Observation {
    let y = y.iter().zip(noise(seed)).map(|(y, n)| y + n + 0.4).collect();
    Observation { time: bath.time.clone(), channels: vec![y] }
}

fn run(bath: &Bath, y: &[f64], seed: u64) -> Diagnosis {
    diagnose(bath, &[0], &[observed(bath, y, seed)], &Settings::default(), &|_| ()).expect("a diagnosis")
}

#[test]
fn nothing_is_found_in_noise() {
    let bath = Bath::new();
    let y = bath.truth(0, None);
    let raised = (1..=30).filter(|seed| run(&bath, &y, *seed).verdict != Verdict::None).count();
    // at one false alarm in a hundred, two of thirty would be rarer than one in twenty
    assert!(raised <= 1, "{raised} false alarms in 30");
}

#[test]
fn what_is_concealed_is_named_its_parameter_covered_and_the_held_out_record_predicted() {
    let bath = Bath::new();
    for (concealed, value) in [(0, 45.0), (1, 1.5)] {
        let y = bath.truth(0, Some((concealed, value)));
        let (mut covered, mut gained) = (0, 0.0);
        for seed in 101..=120 {
            let diagnosis = run(&bath, &y, seed);
            assert_eq!(diagnosis.verdict, Verdict::Explained, "mechanism {concealed}, seed {seed}");
            assert_eq!(diagnosis.mechanisms[0].0, concealed);
            assert!(diagnosis.set.contains(&concealed));
            let [low, high] = diagnosis.parameters[0][0].ci90;
            covered += usize::from((low..=high).contains(&value));
            let judge = &diagnosis.best().fit;
            let record = observed(&bath, &bath.truth(1, Some((concealed, value))), seed + 1000);
            let model = judge.hold_out(&bath, 1, &record, judge).expect("held out");
            let nominal = diagnosis.nominal.hold_out(&bath, 1, &record, judge).expect("held out");
            let [rmse, before] = [&model, &nominal].map(|held| held.rmse[0]);
            assert!(rmse < 1.2 * model.noise_floor[0] && rmse < 1.01 * before, "seed {seed}: {rmse} {before}");
            assert!(model.log_score > nominal.log_score, "seed {seed}: {} {}", model.log_score, nominal.log_score);
            gained += before - rmse;
        }
        assert!(gained > 0.0, "mechanism {concealed}: {gained}");
        // 90 % of 20 are 18; 14 or fewer would be rarer than one in twenty
        assert!(covered >= 15, "mechanism {concealed}: {covered} of 20 intervals hold the truth");
    }
}

/// Whatever was fitted, what the design leaves is what was concealed, but for a constant.
#[test]
fn what_the_design_leaves_is_the_effect_and_a_gap_stays_a_gap() {
    let bath = Bath::new();
    let concealed = bath.truth(0, Some((1, 1.5)));
    let mut y: Vec<f64> = concealed.iter().map(|y| y + 0.7).collect();
    y[17] = f64::NAN;
    let record = Observation { time: bath.time.clone(), channels: vec![y] };
    let left = diagnosis::designed_residuals(&bath, (0, &record)).expect("residuals").remove(0);
    let effect: Vec<f64> = concealed.iter().zip(bath.truth(0, None)).map(|(y, p)| y - p).collect();
    let known = || (0..ROWS).filter(|row| *row != 17);
    let mean = known().map(|row| effect[row]).sum::<f64>() / (ROWS - 1) as f64;
    assert!(left[17].is_nan());
    for row in known() {
        assert!((left[row] - (effect[row] - mean)).abs() < 1e-12, "{row}: {} {}", left[row], effect[row] - mean);
    }
}

/// A third mechanism that is a factor on the constant, far beyond its tolerance: it takes the constant's place, and is not found beside it.
#[test]
fn a_mechanism_that_stands_for_a_constant_takes_its_place() {
    let mut bath = Bath::new();
    let factor = Parameter::new("factor", Prior::LogNormal { median: 1.0, spread: 0.3 });
    bath.mechanisms.push(mechanism("factor", "thermal", vec![factor], vec![1.3]));
    let y = bath.respond(0, &[1.0, 0.7], &[]).expect("a response").remove(0);
    let found = run(&bath, &y, 1);
    assert_eq!((found.verdict, found.mechanisms[0].0, found.set.as_slice()), (Verdict::Explained, FACTOR, &[FACTOR][..]));
    let told = &found.parameters[0][0];
    assert!(told.ci90[0] < 0.7 && 0.7 < told.ci90[1] && told.ci90[1] - told.ci90[0] < 0.02, "{told:?}");
    // one number is known once
    let names: Vec<String> = found.best().fit.posteriors(&bath).into_iter().map(|p| p.name).collect();
    assert!(names.iter().any(|name| name == "factor") && names.iter().all(|name| name != "constant"), "{names:?}");
}

#[test]
fn a_changed_constant_is_recalibrated() {
    let bath = Bath::new();
    let y = bath.respond(0, &[1.0, 1.06], &[]).expect("a response").remove(0);
    let diagnosis = run(&bath, &y, 7);
    assert_eq!(diagnosis.verdict, Verdict::Recalibrate);
}

#[test]
fn a_ripple_that_no_mechanism_makes_is_unknown_and_described() {
    let bath = Bath::new();
    let level = &bath.states[0].level;
    let y: Vec<f64> = bath.truth(0, None).iter().zip(level).map(|(y, l)| y + 0.15 * (l / 1.1).sin()).collect();
    let diagnosis = run(&bath, &y, 11);
    assert_eq!(diagnosis.verdict, Verdict::Unknown);
    let rival = diagnosis.best().rival.as_ref().expect("a structure");
    assert_eq!(rival.structure, Structure::PeriodicInLevel);
    let period = rival.at.expect("a period");
    assert!((period / (std::f64::consts::TAU * 1.1) - 1.0).abs() < 0.1, "period {period}");
}

/// A likelier noise counts for the fit and for the structure beside it, which may have had its part of it already.
#[test]
fn what_a_likelier_noise_gains_is_counted_once() {
    let bath = Bath::new();
    let record = [observed(&bath, &bath.truth(0, None), 11)];
    let found = diagnose(&bath, &[0], &record, &Settings::default(), &|_| ()).expect("a diagnosis").best().clone();
    assert!(found.rival.is_none());
    // of a fit that stays behind its best by so much, and a structure that had so much
    let gained = |behind: f64, had: Option<(Structure, usize, f64)>| {
        let mut of = found.clone();
        of.fit.log_evidence -= behind;
        of.rival = had.map(|(structure, channel, gain)| Rival { structure, channel, at: None, gain });
        gained_by_noise_of(&bath, &[0], &record, &of, &found.fit).expect("a fit")
    };
    for behind in [-5.0, 0.0, 5.0] {
        let gain = gained(behind, None);
        assert!(gain >= 0.0 && (gain - behind.max(0.0)).abs() < 0.05, "{behind}: {gain}");
    }
    // noise holds no structure: each has its own small gain, to which all else is added
    let own = [Structure::PeriodicInLevel, Structure::Step].map(|of| gained(0.0, Some((of, 0, -20.0))) - 20.0);
    assert!(own[0].abs() < 10.0 && own[1].abs() < 10.0 && (own[0] - own[1]).abs() > 0.1, "{own:?}");
    for (behind, had) in [(0.0, -30.0), (5.0, -20.0), (-8.0, -14.0)] {
        let gain = gained(behind, Some((Structure::Step, 0, had)));
        assert!((gain - (own[1] + behind - had)).abs() < 0.1, "{behind} {had}: {gain}");
    }
    // the structure of another channel is another one
    let gain = gained(3.0, Some((Structure::Step, 1, -20.0)));
    assert!((gain - 3.0).abs() < 0.05, "{gain}");
}

#[test]
fn a_mismatch_is_located_over_the_state_and_in_time() {
    let bath = Bath::new();
    // something that acts only where it is warm, and only for an hour
    let hour = 7200.0..10800.0;
    let level = &bath.states[0].level;
    let extra = |n: usize| {
        let t = bath.time[n];
        let warm = if level[n] > 20.0 { 0.5 } else { 0.0 };
        warm + if hour.contains(&t) { 0.6 * (std::f64::consts::TAU * t / 100.0).sin() } else { 0.0 }
    };
    let y: Vec<f64> = bath.truth(0, None).iter().enumerate().map(|(n, y)| y + extra(n)).collect();
    let record = observed(&bath, &y, 13);
    let diagnosis = diagnose(&bath, &[0], std::slice::from_ref(&record), &Settings::default(), &|_| ()).expect("a diagnosis");
    // the noise is that of a record without it
    let clean = run(&bath, &bath.truth(0, None), 14);
    let judge = &clean.best().fit;
    let cells = diagnosis.nominal.over_state(&bath, (0, 0), 0, &record, judge);
    let found: Vec<_> = cells.iter().filter(|c| c.significant).collect();
    assert!(!found.is_empty() && found.iter().filter(|c| c.level[1] > 17.0).count() * 2 > found.len(), "{found:?}");
    let blocks = diagnosis.nominal.in_time(0, 0, &record, judge);
    let most = blocks.iter().max_by(|a, b| a.excess.total_cmp(&b.excess)).expect("blocks");
    assert!(most.significant && most.time[1] > hour.start && most.time[0] < hour.end, "{blocks:?}");
    // wherever the clock starts
    let late = |t: &f64| t + 1e6;
    let later = Observation { time: record.time.iter().map(late).collect(), ..record };
    let moved = diagnosis.nominal.in_time(0, 0, &later, judge);
    assert!(moved.iter().zip(&blocks).all(|(m, b)| m.excess == b.excess && m.time == [late(&b.time[0]), late(&b.time[1])]));
}

#[test]
fn a_flexible_input_at_the_right_stage_restores_whiteness() {
    let bath = Bath::new();
    for (concealed, value, stage) in [(0, 45.0, "sensor"), (1, 1.5, "optics")] {
        let diagnosis = run(&bath, &bath.truth(0, Some((concealed, value))), 31);
        let [first, others @ ..] = diagnosis.stages.as_slice() else { panic!("no stages") };
        assert_eq!(first.stage, stage);
        assert!(first.probability > 0.9 && first.whiteness[0] > 0.01, "{first:?}");
        assert!(others.iter().all(|s| s.gain < first.gain - 5.0), "{others:?}");
    }
}

/// A stage is compared with the others where each record has it.
#[test]
fn a_stage_that_one_record_lacks_is_left_out() {
    for lacking in [(0, "electronics"), (1, "electronics")] {
        let bath = Bath { lacking: Some(lacking), ..Bath::new() };
        let records = [0, 1].map(|number| observed(&bath, &bath.truth(number, Some((0, 45.0))), 31 + number as u64));
        let diagnosis = diagnose(&bath, &[0, 1], &records, &Settings::default(), &|_| ()).expect("a diagnosis");
        let names: Vec<&str> = diagnosis.stages.iter().map(|stage| stage.stage.as_str()).collect();
        assert_eq!(names, ["sensor", "optics"]);
        assert!(diagnosis.stages[0].probability > 0.9, "{:?}", diagnosis.stages);
    }
}

#[test]
fn members_that_do_the_same_are_not_told_apart() {
    let bath = Bath { idle: true, ..Bath::new() };
    let diagnosis = run(&bath, &bath.truth(0, Some((1, 1.5))), 37);
    let resolution = diagnosis.mismatch.resolution(&bath, &[0], 2.0).expect("a resolution").expect("members");
    // of the twins each is half resolved, and they share what is there; the third is resolved, and is not at work
    assert!(resolution.resolved[..2].iter().all(|r| (r - 0.5).abs() < 0.02), "{resolution:?}");
    assert!((resolution.values[0] + resolution.values[1] - 1.5).abs() < 0.2, "{resolution:?}");
    assert!(resolution.resolved[2] > 0.9 && resolution.values[2].abs() < 3.0 * resolution.errors[2], "{resolution:?}");
    assert!((resolution.combinations() - 2.0).abs() < 0.1 && resolution.locatable());
    // of what does nothing the prior is all that is known
    assert_eq!([&resolution.values, &resolution.errors, &resolution.resolved].map(|of| of[3]), [0.0, 2.0, 0.0]);
    // members that are known beforehand are not the record's to locate
    let known = diagnosis.mismatch.resolution(&bath, &[0], 1e-5).expect("a resolution").expect("members");
    assert!(known.combinations() < 0.01 && !known.locatable(), "{known:?}");
}

#[test]
fn an_explanation_by_an_unnamed_mechanism_stays_unknown_and_a_choice_has_an_interval() {
    let mut bath = Bath::new();
    bath.mechanisms[1].named = false;
    let y = bath.truth(0, Some((1, 1.5)));
    let diagnosis = run(&bath, &y, 41);
    assert_eq!(diagnosis.verdict, Verdict::Unknown);
    assert_eq!(diagnosis.set, [1]);
    assert_eq!(diagnosis.choice(0), None);
    // choices that do the same are not told apart
    bath.mechanisms[1].named = true;
    bath.mechanisms[1].choice = Some(("place".to_owned(), vec![1.0, 2.0, 3.0]));
    let diagnosis = run(&bath, &y, 41);
    assert_eq!((diagnosis.verdict, diagnosis.choice(0)), (Verdict::Explained, Some([1.0, 3.0])));
}

#[test]
fn an_explanation_that_a_held_out_record_contradicts_is_taken_back() {
    let bath = Bath::new();
    let with_bend = |record: usize, seed: u64| observed(&bath, &bath.truth(record, Some((1, 1.5))), seed);
    let first = with_bend(0, 43);
    let found = diagnose(&bath, &[0], std::slice::from_ref(&first), &Settings::default(), &|_| ()).expect("a diagnosis");
    let judged = |held: &[(usize, &Observation)]| {
        let mut diagnosis = found.clone();
        let judgement = diagnosis.judge(&bath, &bath, None, (0, &first), held, 0).expect("a judgement");
        (diagnosis, judgement)
    };
    // the same unit: the explanation stands
    let own = with_bend(1, 45);
    let (kept, judgement) = judged(&[(1, &own)]);
    assert_eq!((judgement.ruling, kept.verdict, kept.set.len()), (Ruling::Stands, Verdict::Explained, found.set.len()));
    assert!(judgement.records[0].accepted);
    // another unit, without what the first had
    let other = observed(&bath, &bath.truth(1, None), 44);
    let (taken, judgement) = judged(&[(1, &own), (1, &other)]);
    assert_eq!(judgement.ruling, Ruling::TakenBack { record: 1, why: Contradiction::ClearlyWorse });
    let Judged { nominal, model, accepted, .. } = &judgement.records[1];
    assert!(nominal.within_noise(0) && !model.within_noise(0) && !accepted);
    assert_eq!((taken.verdict, taken.set.len(), taken.mechanisms.len()), (Verdict::None, 0, 0));
    // a third that neither explains: what there is is unknown
    let bent = observed(&bath, &bath.truth(1, Some((1, -1.5))), 46);
    let (taken, judgement) = judged(&[(1, &bent)]);
    assert_eq!(judgement.ruling, Ruling::TakenBack { record: 0, why: Contradiction::ClearlyWorse });
    assert_eq!(taken.verdict, Verdict::Unknown);
}

#[test]
fn a_step_between_the_even_instants_is_found_where_it_is() {
    const ROW: usize = 318;
    let bath = Bath::new();
    let y: Vec<f64> = bath.truth(0, None).iter().enumerate().map(|(n, y)| if n < ROW { *y } else { y + 0.35 }).collect();
    let diagnosis = run(&bath, &y, 51);
    assert_eq!(diagnosis.verdict, Verdict::Unknown);
    let rival = diagnosis.best().rival.as_ref().expect("a structure");
    assert_eq!(rival.structure, Structure::Step);
    let row = rival.at.expect("an instant") / STEP_S;
    assert!((row - ROW as f64).abs() <= 2.0, "row {row}");
}

#[test]
fn a_mechanism_with_a_name_beside_a_structure_is_accepted_with_its_probability() {
    let bath = Bath::new();
    let rippled = |record: usize, lag: Option<(usize, f64)>, height: f64| -> Vec<f64> {
        let (y, level) = (bath.truth(record, lag), &bath.states[record].level);
        y.iter().zip(level).map(|(y, l)| y + height * (l / 1.1).sin()).collect()
    };
    // within 1.3 times the noise in means over a minute, of two rows
    let both = |record| rippled(record, Some((0, 150.0)), 0.08);
    let mut diagnosis = run(&bath, &both(0), 61);
    assert_eq!(diagnosis.verdict, Verdict::Unknown);
    assert!(diagnosis.is_beside_named(&bath) && diagnosis.mechanisms[0].1 < 0.5);
    let [first, other] = [(0, 61), (1, 62)].map(|(record, seed)| observed(&bath, &both(record), seed));
    let judgement = diagnosis.judge(&bath, &bath, None, (0, &first), &[(1, &other)], 0).expect("a judgement");
    assert_eq!(judgement.ruling, Ruling::AcceptedBeside);
    let Judged { nominal, model, .. } = &judgement.records[0];
    assert!(nominal.clearly_worse_than(model, 0) && model.within_noise(0));
    assert_eq!((diagnosis.verdict, diagnosis.mechanisms[0].0, diagnosis.set.as_slice()), (Verdict::Explained, 0, &[0][..]));
    assert!(diagnosis.mechanisms[0].1 > 0.9 && !diagnosis.is_beside_named(&bath));
    // a ripple alone stands beside nothing
    assert!(!run(&bath, &rippled(0, None, 0.15), 11).is_beside_named(&bath));
}

#[test]
fn exact_a_law_takes_its_probability_from_all_others_alike() {
    let bath = Bath::new();
    let mut found = run(&bath, &bath.truth(0, Some((0, 45.0))), 71);
    let before: Vec<f64> = found.candidates.iter().map(|c| c.probability).collect();
    let verdicts = found.verdicts();
    // as likely as all that were compared together
    let weight = found.best().log_weight - found.best().probability.ln();
    found.weigh_unlisted(weight, &[], 0.0, 0.0);
    for (c, before) in found.candidates.iter().zip(&before) {
        assert!((c.probability - before / 2.0).abs() < 1e-9, "{} was {before}", c.probability);
    }
    let after = found.verdicts();
    assert!((after.iter().sum::<f64>() - 1.0).abs() < 1e-9 && (after[3] - (0.5 + verdicts[3] / 2.0)).abs() < 1e-9, "{after:?}");
}
