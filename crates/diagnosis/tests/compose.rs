//! A law that is composed is the one that made the record, and none is composed of noise.

use crate::common::lines::{Lines, WHITE, alone};
use diagnosis::{
    Active, Breadth, Channel, Composed, Earlier, Fit, ForwardModel, Hypothesis, Nuisance, Observation, Omission, Parameter,
    Prior, Settings, State, compose, compose_within, diagnose, fitted, gained_by_noise_of, in_place_of, prove, proven,
};
use rand::SeedableRng;
use rand::rngs::SmallRng;
use rand_distr::{Distribution, Normal};

const ROWS: usize = 400;

/// The second mechanism's column times a size in noise, and a fit of nothing to it.
fn record(size: f64, seed: u64) -> (Lines, diagnosis::Observation, Fit) {
    let lines = Lines::new(ROWS).starting_at(1.0);
    let mut random = SmallRng::seed_from_u64(seed);
    let noise = Normal::new(0.0, WHITE).expect("a density");
    let y: Vec<f64> = lines.column(1).iter().map(|x| size * x + noise.sample(&mut random)).collect();
    let observed = lines.observed(&y);
    let nothing = fitted(&lines, &[0], std::slice::from_ref(&observed), &[Hypothesis::NOMINAL]).expect("a fit");
    (lines, observed, nothing)
}

#[test]
fn the_law_that_made_a_record_is_composed_with_its_size() {
    let (lines, observed, nothing) = record(1.5, 3);
    let found =
        compose(&lines, 0..2, &[0], std::slice::from_ref(&observed), &nothing, &|_| ()).expect("composed").expect("a law");
    assert_eq!((found.laws, found.fit.hypothesis.mechanisms.as_slice()), (1, &[(1, None)][..]));
    let estimate = &found.fit.estimates(&lines, 0)[0];
    assert!(estimate.ci90[0] < 1.5 && 1.5 < estimate.ci90[1], "{estimate:?}");
    // the choice between two is paid for: exact evidence of the fit alone, less ln 2
    let single = fitted(&lines, &[0], std::slice::from_ref(&observed), &[alone(1)]).expect("a fit");
    let gain = single.log_evidence - nothing.log_evidence - 2.0_f64.ln();
    assert!((found.gain - gain).abs() < 0.05, "{} and {gain}", found.gain);
}

/// What stays behind the law that is taken, and what an answer of two laws weighs.
#[test]
fn others_are_behind_by_their_evidence_and_share_the_last_place() {
    let (lines, observed, nothing) = record(1.5, 3);
    let observed = std::slice::from_ref(&observed);
    let found = compose(&lines, 0..2, &[0], observed, &nothing, &|_| ()).expect("composed").expect("a law");
    let [first, second] = [0, 1].map(|law| fitted(&lines, &[0], observed, &[alone(law)]).expect("a fit").log_evidence);
    let [(other, behind)] = found.others[..] else { panic!("{:?}", found.others) };
    assert!(other == 0 && (behind - (second - first)).abs() < 0.05, "{behind} and {}", second - first);
    // two laws in either order, and two others that are as good as the last and half as good
    let two = Composed { laws: 2, choice: 1.5, others: vec![(3, 0.0), (4, 2.0_f64.ln())], ..found };
    let weight = two.fit.log_evidence - 1.5 + 2.0_f64.ln() + 2.5_f64.ln() - 7.0;
    assert!((two.log_weight(-7.0) - weight).abs() < 1e-9, "{} and {weight}", two.log_weight(-7.0));
}

#[test]
fn a_law_is_found_at_any_scale_of_its_size() {
    for scale in [1e-6, 1.0, 1e6] {
        let lines = Lines::new(ROWS).sized([scale; 2], 1.0);
        let mut random = SmallRng::seed_from_u64(6);
        let noise = Normal::new(0.0, WHITE).expect("a density");
        let y: Vec<f64> = lines.column(1).iter().map(|x| 1.5 * scale * x + noise.sample(&mut random)).collect();
        let observed = [lines.observed(&y)];
        let nothing = fitted(&lines, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
        let found = compose(&lines, 0..2, &[0], &observed, &nothing, &|_| ()).expect("composed").expect("a law");
        assert_eq!(found.fit.hypothesis.mechanisms, [(1, None)], "{scale}");
        let estimate = &found.fit.estimates(&lines, 0)[0];
        assert!(estimate.ci90[0] < 1.5 * scale && 1.5 * scale < estimate.ci90[1], "{scale}: {estimate:?}");
    }
}

/// Far more than a size usually is, in noise that hardly tells the two laws apart: the law that is tried is the one of the two that explains more,
/// whatever the units of the sizes.
#[test]
fn the_law_to_try_is_chosen_in_any_units() {
    const FAR: f64 = 30.0;
    const EFFECT: f64 = 0.015;
    let mut random = SmallRng::seed_from_u64(2);
    let noise = Normal::new(0.0, WHITE).expect("a density");
    let noise: Vec<f64> = (0..ROWS).map(|_| noise.sample(&mut random)).collect();
    for scales in [[1.0, 1.0], [1e-6, 1e6], [1e6, 1e-6]] {
        let lines = Lines::new(ROWS).sized(scales, EFFECT);
        for law in 0..2 {
            let y: Vec<f64> = lines.column(law).iter().zip(&noise).map(|(x, n)| FAR * scales[law] * x + n).collect();
            let observed = [lines.observed(&y)];
            let nothing = fitted(&lines, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
            let breadth = Breadth { followed: 1, ..Breadth::default() };
            let found = compose_within(&lines, 0..2, &[0], &observed, &nothing, breadth, &|_| ()).expect("composed");
            assert_eq!(found.expect("a law").fit.hypothesis.mechanisms, [(law, None)], "{scales:?}");
        }
    }
}

#[test]
fn a_law_in_the_place_of_a_mechanism_is_behind_by_what_the_record_tells() {
    // the second mechanism made the record: another one with its own column stands for it, the first does not
    let (lines, observed, _) = record(1.5, 5);
    let observed = std::slice::from_ref(&observed);
    let named = fitted(&lines, &[0], observed, &[alone(1)]).expect("a fit");
    let of = |laws: std::ops::Range<usize>| in_place_of(&lines, &laws, &[0], observed, &named, 1).expect("fits").expect("a law");
    let [same, other] = [of(1..2), of(0..1)];
    assert!((same.log_evidence - named.log_evidence).abs() < 1e-3, "{} and {}", same.log_evidence, named.log_evidence);
    assert!(named.log_evidence - other.log_evidence > 20.0, "{} and {}", other.log_evidence, named.log_evidence);
    // the best of both, and no trace of the mechanism
    let best = of(0..2);
    assert_eq!(best.hypothesis.mechanisms, [(1, None)]);
    assert_eq!(other.hypothesis.mechanisms, [(0, None)]);
}

#[test]
fn exact_laws_share_the_probability_of_the_unknown() {
    let lines = Lines::new(ROWS);
    for settings in [Settings::default(), Settings { unknown: 0.3, single: 0.2, ..Settings::default() }] {
        let by_itself = settings.log_unlisted(&lines, &Hypothesis::NOMINAL);
        // half of the unknown is of laws, one or two of them; of two mechanisms each has half of what all have
        assert!((by_itself - (settings.unknown / 6.0).ln()).abs() < 1e-12, "{by_itself}");
        let beside = settings.log_unlisted(&lines, &alone(1));
        assert!((beside - by_itself - (settings.single / 2.0).ln()).abs() < 1e-12, "{beside}");
    }
}

#[test]
fn of_noise_nothing_is_composed() {
    for seed in 0..20 {
        let (lines, observed, nothing) = record(0.0, seed);
        let found = compose(&lines, 0..2, &[0], std::slice::from_ref(&observed), &nothing, &|_| ()).expect("composed");
        assert!(found.is_none(), "seed {seed}");
    }
}

/// A fit under a drift that there is not, and the drift that there is.
fn misled(seed: u64) -> (Lines, [Observation; 1], Fit) {
    let (lines, observed, _) = record(0.0, seed);
    let observed = [observed];
    let drifting = Lines::new(ROWS).starting_at(1.0).with_drift(WHITE);
    let fit = fitted(&drifting, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
    (lines, observed, fit)
}

#[test]
fn a_likelier_noise_is_no_gain_of_a_law() {
    let (lines, observed, misled) = misled(3);
    let nothing = fitted(&lines, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
    assert!(nothing.log_evidence > misled.log_evidence + 10.0, "{} {}", nothing.log_evidence, misled.log_evidence);
    assert!(compose(&lines, 0..2, &[0], &observed, &misled, &|_| ()).expect("composed").is_none());
}

#[test]
fn a_likelier_noise_of_another_fit_is_a_gain_of_its_own() {
    let (lines, observed, misled) = misled(3);
    let nothing = fitted(&lines, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
    let missing = nothing.log_evidence - misled.log_evidence;
    let mut candidate = diagnose(&lines, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis").best().clone();
    (candidate.fit, candidate.rival) = (misled, None);
    let gained = gained_by_noise_of(&lines, &[0], &observed, &candidate, &nothing).expect("a fit");
    assert!((gained - missing).abs() < 0.05, "{gained} and {missing}");
}

/// Laws of one's own in the noise of [`Lines`], each a function of its values and of the place in the record, from 0 to 1.
struct Laws {
    lines: Lines,
    laws: Vec<Omission>,
    of: fn(&Active, f64) -> f64,
}

impl Laws {
    /// The sum of two others with something of its own, and these: a wave and a ripple.
    fn sum() -> Self {
        let lines = Lines::new(ROWS).starting_at(1.0);
        let laws = ["sum", "wave", "ripple"].map(|id| Omission { id: id.into(), ..lines.mechanisms()[0].clone() }).to_vec();
        let of = |law: &Active, x: f64| {
            let (wave, ripple) = ((7.0 * x).sin(), (40.0 * x).cos());
            law.values[0] * [wave + ripple + 0.5 * (90.0 * x).sin(), wave, ripple][law.mechanism]
        };
        Self { lines, laws, of }
    }

    /// A bump at a place that is fitted: from a place far off no slope leads to it.
    fn bump(places: [f64; 3]) -> Self {
        let lines = Lines::new(ROWS).starting_at(1.0);
        let size = lines.mechanisms()[0].parameters[0].clone();
        let place = Parameter::new("place", Prior::Uniform { low: 0.0, high: 1.0 });
        let starts = places.map(|place| vec![1.0, place]).to_vec();
        let laws = vec![Omission { id: "bump".into(), parameters: vec![size, place], starts, ..lines.mechanisms()[0].clone() }];
        let of = |law: &Active, x: f64| law.values[0] * (-((x - law.values[1]) / 0.02).powi(2)).exp();
        Self { lines, laws, of }
    }

    /// A record of some laws, in noise.
    fn record(&self, truth: &[Active], seed: u64) -> Observation {
        let mut random = SmallRng::seed_from_u64(seed);
        let noise = Normal::new(0.0, WHITE).expect("a density");
        let y = self.respond(0, &[], truth).expect("a response").remove(0);
        self.lines.observed(&y.into_iter().map(|y| y + noise.sample(&mut random)).collect::<Vec<_>>())
    }
}

impl ForwardModel for Laws {
    fn channels(&self) -> &[Channel] {
        self.lines.channels()
    }

    fn nuisances(&self) -> &[Nuisance] {
        &[]
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.laws
    }

    fn state(&self, record: usize) -> &State {
        self.lines.state(record)
    }

    fn respond(&self, _: usize, _: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let at = |n: usize| active.iter().map(|law| (self.of)(law, n as f64 / ROWS as f64)).sum();
        Ok(vec![(0..ROWS).map(at).collect()])
    }
}

#[test]
fn a_law_begins_at_the_best_of_its_starts() {
    for places in [[0.1, 0.4, 0.71], [0.71, 0.4, 0.1], [0.1, 0.71, 0.4]] {
        let model = Laws::bump(places);
        let observed = [model.record(&[Active { mechanism: 0, values: vec![3.0, 0.7], choice: None }], 9)];
        let nothing = fitted(&model, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
        let found = compose(&model, 0..1, &[0], &observed, &nothing, &|_| ()).expect("composed").expect("a law");
        assert!((found.fit.active[0].values[1] - 0.7).abs() < 0.01, "{places:?}: {:?}", found.fit.active);
    }
}

#[test]
fn a_law_that_others_make_superfluous_is_dropped() {
    let model = Laws::sum();
    let truth = [1, 2].map(|mechanism| Active { mechanism, values: vec![2.0], choice: None });
    let observed = [model.record(&truth, 8)];
    let nothing = fitted(&model, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
    let laws = |earlier| {
        let breadth = Breadth { terms: 3, earlier, ..Breadth::default() };
        let found = compose_within(&model, 0..3, &[0], &observed, &nothing, breadth, &|_| ()).expect("composed").expect("laws");
        found.fit.hypothesis.mechanisms.iter().map(|(law, _)| *law).collect::<Vec<_>>()
    };
    let kept = laws(Earlier::Kept);
    assert_eq!((kept[0], kept.len()), (0, 3), "the sum comes first");
    let mut weighed = laws(Earlier::Weighed);
    weighed.sort_unstable();
    assert_eq!(weighed, [1, 2]);
}

/// Two laws are needed, in turn: no more are composed than were asked for.
#[test]
fn no_more_laws_are_composed_than_may_be_added_up() {
    let model = Laws::sum();
    let truth = [1, 2].map(|mechanism| Active { mechanism, values: vec![2.0], choice: None });
    let observed = [model.record(&truth, 8)];
    let nothing = fitted(&model, &[0], &observed, &[Hypothesis::NOMINAL]).expect("a fit");
    for terms in [1, 2] {
        let breadth = Breadth { terms, ..Breadth::default() };
        let found = compose_within(&model, 1..3, &[0], &observed, &nothing, breadth, &|_| ()).expect("composed").expect("laws");
        assert_eq!((found.laws, found.steps.len()), (terms, terms));
    }
}

/// Mechanisms at work together.
fn together(mechanisms: &[usize]) -> Hypothesis {
    Hypothesis { mechanisms: mechanisms.iter().map(|law| (*law, None)).collect(), constants_free: true }
}

/// Weight of a law beside others of weight 1, so many, where its choice costs so much.
fn weight(cost: f64, others: f64) -> f64 {
    others / cost.exp_m1()
}

/// The ripple of the sum is in the record, too, but little of it: the sum is worth more than e³ beside the other two laws, or not, by its prior.
#[test]
fn an_earlier_law_stays_where_it_gains_more_than_it_costs() {
    let mut model = Laws::sum();
    let truth = [(0, 0.4), (1, 1.6), (2, 1.6)].map(|(mechanism, size)| Active { mechanism, values: vec![size], choice: None });
    let observed = [model.record(&truth, 8)];
    let [nothing, without, all] =
        [&[][..], &[1, 2], &[0, 1, 2]].map(|laws| fitted(&model, &[0], &observed, &[together(laws)]).expect("a fit"));
    let gain = all.log_evidence - without.log_evidence;
    assert!((9.0..20.0).contains(&gain), "{gain}");
    for (spare, kept) in [(0.5, true), (-0.5, false)] {
        model.laws[0].weight = weight(gain - 3.0 - spare, 2.0);
        let breadth = Breadth { terms: 3, earlier: Earlier::Weighed, ..Breadth::default() };
        let found = compose_within(&model, 0..3, &[0], &observed, &nothing, breadth, &|_| ()).expect("composed").expect("laws");
        assert_eq!(found.steps[0].hypothesis.mechanisms, [(0, None)], "the sum comes first");
        let numbers: Vec<usize> = found.fit.hypothesis.mechanisms.iter().map(|(law, _)| *law).collect();
        assert_eq!((numbers.contains(&0), numbers.len()), (kept, if kept { 3 } else { 2 }), "{spare}: {numbers:?}");
    }
}

/// A wave explains more than a ripple: whether it is taken is a matter of what was thought of both beforehand.
#[test]
fn a_law_that_explains_more_is_taken_where_the_choice_does_not_cost_as_much() {
    let mut model = Laws::sum();
    let truth = [(1, 0.3), (2, 0.2)].map(|(mechanism, size)| Active { mechanism, values: vec![size], choice: None });
    let observed = [model.record(&truth, 8)];
    let [nothing, wave, ripple] =
        [&[][..], &[1], &[2]].map(|laws| fitted(&model, &[0], &observed, &[together(laws)]).expect("a fit"));
    let more = wave.log_evidence - ripple.log_evidence;
    assert!(more > 3.0, "{more}");
    for (spare, taken) in [(1.0, 1), (-1.0, 2)] {
        // the difference of the two costs
        model.laws[1].weight = (spare - more).exp();
        let breadth = Breadth { terms: 1, ..Breadth::default() };
        let found = compose_within(&model, 1..3, &[0], &observed, &nothing, breadth, &|_| ()).expect("composed").expect("a law");
        assert_eq!(found.fit.hypothesis.mechanisms, [(taken, None)], "{spare}");
    }
}

#[test]
fn what_was_known_stays_beside_what_is_composed() {
    let (lines, observed, _) = record(1.5, 4);
    let observed = std::slice::from_ref(&observed);
    let like = fitted(&lines, &[0], observed, &[alone(0)]).expect("a fit");
    let breadth = Breadth { earlier: Earlier::Weighed, ..Breadth::default() };
    let found = compose_within(&lines, 1..2, &[0], observed, &like, breadth, &|_| ()).expect("composed").expect("a law");
    assert_eq!((found.laws, found.steps.len()), (1, 1));
    assert_eq!(found.fit.hypothesis.mechanisms, [(0, None), (1, None)]);
}

/// A law is as large as the noise of a minute, and far smaller than that of its rows.
#[test]
fn rows_of_a_second_bear_out_a_law_as_rows_of_a_minute_do() {
    const SIZE: f64 = 0.09;
    for rows_a_minute in [1, 60] {
        let rows = 200 * rows_a_minute;
        let lines = Lines::new(rows);
        let record = |seed: u64| {
            let mut normal = crate::common::normal(seed);
            // the noise of a row of a minute is that of sixty shorter ones
            let size = SIZE * (60.0 / rows_a_minute as f64).sqrt();
            let y = lines.column(0).iter().map(|x| size * x + WHITE * normal()).collect();
            Observation { time: (0..rows).map(|n| 60.0 / rows_a_minute as f64 * n as f64).collect(), channels: vec![y] }
        };
        let [nothing, law] = [Hypothesis::NOMINAL, alone(0)].map(|of| fitted(&lines, &[0], &[record(1)], &[of]).expect("a fit"));
        let proof = prove(&lines, &nothing, &law, &[(0, &record(2))]).expect("predictions");
        assert!(proof.accepted, "{rows_a_minute}: {:?}", proof.rmse(0));
    }
}

#[test]
fn what_was_held_out_bears_out_the_law_that_made_it_and_no_other() {
    let (lines, observed, nothing) = record(1.5, 3);
    let law = fitted(&lines, &[0], std::slice::from_ref(&observed), &[alone(1)]).expect("a fit");
    let (_, again, _) = record(1.5, 11);
    let (_, noise, _) = record(0.0, 12);
    let accepted = |held: &[(usize, &diagnosis::Observation)]| prove(&lines, &nothing, &law, held).expect("predictions").accepted;
    assert!(accepted(&[(0, &again)]));
    assert!(!accepted(&[(0, &noise)]) && !accepted(&[(0, &again), (0, &noise)]) && !accepted(&[]));
    let steps = [law.clone(), nothing.clone()];
    let last = proven(&lines, &nothing, &steps, &[(0, &again)]).expect("predictions").expect("a law");
    assert_eq!(last.hypothesis, law.hypothesis);
    assert!(proven(&lines, &nothing, &steps, &[(0, &noise)]).expect("predictions").is_none());
}
