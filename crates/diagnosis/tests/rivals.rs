//! Two mechanisms with nearly the same effect, one of which a model that is not about it knows badly: what it is and how large shows about each of them alone.

use crate::common::normal;
use diagnosis::{
    Active, Channel, Diagnosis, Fit, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, Settings,
    Settled, State, diagnose_settled, settled,
};

const WHITE: f64 = 0.05;
const ROWS: usize = 241;
const TRUTH: f64 = 4.0;
/// The mechanism that is at work, and the one that looks like it about the drawing.
const WORKS: usize = 1;
const LOOKS: usize = 0;

struct Pair {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    /// the mechanism that it is made about
    about: Option<usize>,
    /// effect of a mechanism of size one, in a model about itself or not
    effect: fn(usize, bool, f64) -> f64,
    /// of all effects
    scale: f64,
    /// factor on the scale of a model made anew, if there is always one that is better still
    growth: Option<f64>,
}

/// Known badly elsewhere, and then looked like by the other one.
fn bent(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    let beside = match mechanism {
        LOOKS => 0.05 * (9.0 * x).cos(),
        _ if about_itself => 0.0,
        _ => 0.1 * (14.0 * x).cos(),
    };
    (5.0 * x).sin() + beside
}

/// Of the same shape everywhere, but a quarter too large elsewhere.
fn larger(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    if mechanism == LOOKS || about_itself { (5.0 * x).sin() } else { 1.25 * (5.0 * x).sin() }
}

/// The same of both, but of a shape that is a little worse where it is not rare.
fn both_larger(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    let worse = if mechanism == WORKS { -0.003 * (3.0 * x).cos() } else { 0.0 };
    larger(WORKS, about_itself, x) + worse
}

/// One a quarter too large elsewhere; the other better elsewhere than in a model about itself, and a little better than the first.
fn better_elsewhere(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    match mechanism {
        LOOKS => larger(WORKS, about_itself, x) - 0.003 * (3.0 * x).cos(),
        _ if about_itself => (5.0 * x).sin() + 0.03 * (14.0 * x).cos(),
        _ => (5.0 * x).sin(),
    }
}

/// Both the same about themselves, and both known badly elsewhere.
fn both_bent(_: usize, about_itself: bool, x: f64) -> f64 {
    bent(WORKS, about_itself, x)
}

/// The same among others that look like it, each with something of its own.
fn one_of_many(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    let beside = (8.0 + mechanism as f64) * x;
    if mechanism < 2 { bent(mechanism, about_itself, x) } else { (5.0 * x).sin() + 0.05 * beside.cos() }
}

/// One of a shape of its own and the same everywhere; the other a quarter too large elsewhere.
fn unlike_and_larger(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    let beside = if mechanism == LOOKS { 0.01 * (9.0 * x).cos() } else { 0.0 };
    larger(mechanism, about_itself, x) + beside
}

/// The same, about itself or not.
fn unlike(mechanism: usize, _: bool, x: f64) -> f64 {
    unlike_and_larger(mechanism, true, x)
}

/// Each seems likelier elsewhere than it is about itself, and is a quarter too large there.
fn flattered(mechanism: usize, about_itself: bool, x: f64) -> f64 {
    let worse = 0.01 + 0.002 * if mechanism == 1 { 1.0 } else { 0.0 };
    if about_itself { (5.0 * x).sin() + worse * (14.0 * x).cos() } else { 1.25 * (5.0 * x).sin() }
}

fn x() -> impl Iterator<Item = f64> {
    (0..ROWS).map(|n| n as f64 / (ROWS - 1) as f64)
}

impl Pair {
    fn new(effect: fn(usize, bool, f64) -> f64, weights: [f64; 2], about: Option<usize>) -> Self {
        let noise = NoisePrior::new((WHITE, 1e-4), (1e-9, 1e-4), (100.0, 1e-4), (1e-9, 1e-4));
        let one = |id: &str, sd: f64, weight: f64| Omission {
            id: id.into(),
            stage: "one".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd })],
            choice: None,
            starts: vec![vec![1.0]],
            named: true,
            weight,
        };
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![Nuisance::normal("gain", 1.0, 0.01, Role::Constant)],
            mechanisms: vec![one("looks", 3.0, weights[LOOKS]), one("works", 3.0, weights[WORKS])],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            about,
            effect,
            scale: 1.0,
            growth: None,
        }
    }

    /// The two as one mechanism at either of two places.
    fn at_two_places(effect: fn(usize, bool, f64) -> f64, about: Option<usize>) -> Self {
        let mut pair = Self::new(effect, [1.0; 2], about);
        pair.mechanisms.truncate(1);
        pair.mechanisms[0].choice = Some(("place".into(), vec![LOOKS as f64, WORKS as f64]));
        pair
    }

    /// The one that looks like the other at any of many places.
    fn with_many_places(effect: fn(usize, bool, f64) -> f64, about: Option<usize>) -> Self {
        let mut pair = Self::new(effect, [1.0; 2], about);
        pair.mechanisms[LOOKS].choice = Some(("place".into(), (1..=9).map(f64::from).collect()));
        pair
    }

    /// Four more beside the two.
    fn with_a_crowd(effect: fn(usize, bool, f64) -> f64) -> Self {
        let mut crowd = Self::new(effect, [1.0; 2], None);
        crowd
            .mechanisms
            .extend((2..6).map(|n| Omission { id: format!("looks {n}"), ..crowd.mechanisms[LOOKS].clone() }).collect::<Vec<_>>());
        crowd
    }

    /// Which of the two is at work: a mechanism, or the place of the only one.
    fn which(&self, active: &Active) -> usize {
        active.choice.filter(|_| self.mechanisms.len() == 1).map_or(active.mechanism, |place| place as usize)
    }
}

impl ForwardModel for Pair {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, gain: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let of = |x: f64| {
            let effect =
                |a: &Active| self.scale * a.values[0] * (self.effect)(self.which(a), self.about == Some(self.which(a)), x);
            gain[0] * (x + active.iter().map(effect).sum::<f64>())
        };
        Ok(vec![x().map(of).collect()])
    }

    fn about(&self, _: &[f64], active: &[Active]) -> Result<Option<Self>, diagnosis::Failure> {
        let leads = active.first().map(|a| self.which(a));
        let next = || Self {
            channels: self.channels.clone(),
            nuisances: self.nuisances.clone(),
            mechanisms: self.mechanisms.clone(),
            state: self.state.clone(),
            about: leads,
            scale: self.scale * self.growth.unwrap_or(1.0),
            ..*self
        };
        Ok((self.growth.is_some() || leads != self.about).then(next))
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

fn observed() -> Observation {
    let mut normal = normal(4);
    let y = x().map(|x| x + TRUTH * (5.0 * x).sin() + WHITE * normal()).collect();
    Observation { time: x().map(|x| 600.0 * x).collect(), channels: vec![y] }
}

/// Before the comparison the other one leads, as it does the same; the comparison knows that it is rare.
#[test]
fn the_size_of_the_likeliest_is_that_of_a_model_about_it() {
    let (pair, observed) = (Pair::new(larger, [0.01, 1.0], None), [observed()]);
    let mut settled = settled(&pair, &[0], &observed, &|_| ()).expect("a fit");
    assert_eq!(settled.leading.as_ref().expect("one leads").active[0].mechanism, LOOKS);
    let found = diagnose_settled(&pair, &mut settled, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis");
    let best = &found.best().fit.active[0];
    assert_eq!((best.mechanism, settled.model.expect("a model").about), (WORKS, Some(WORKS)));
    assert!((best.values[0] - TRUTH).abs() < 0.1, "{best:?}");
    assert!((found.parameters[0][0].value - TRUTH).abs() < 0.1, "{:?}", found.parameters);
}

/// The one that led before the comparison is the second in it: its size, too, is that of a model about itself.
#[test]
fn whatever_was_followed_counts_as_about_itself() {
    let (pair, observed) = (Pair::new(both_larger, [0.001, 1.0], None), [observed()]);
    let mut settled = settled(&pair, &[0], &observed, &|_| ()).expect("a fit");
    assert_eq!(settled.leading.as_ref().expect("one leads").active[0].mechanism, LOOKS);
    let found = diagnose_settled(&pair, &mut settled, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis");
    assert_eq!(found.best().fit.active[0].mechanism, WORKS);
    let of_one_that_led = found
        .candidates
        .iter()
        .map(|candidate| &candidate.fit)
        .find(|fit| fit.active.len() == 1 && fit.active[0].mechanism == LOOKS);
    let size = of_one_that_led.expect("it was compared").active[0].values[0];
    assert!((size - TRUTH).abs() < 0.1, "{size}");
}

/// The one that led is likelier than the one that was followed: its model is the one that is left, not that about the other.
#[test]
fn the_model_is_that_of_the_likeliest_if_it_led_before() {
    let (pair, observed) = (Pair::new(better_elsewhere, [1.0; 2], None), [observed()]);
    let mut settled = settled(&pair, &[0], &observed, &|_| ()).expect("a fit");
    let led = settled.leading.clone().expect("one leads");
    assert_eq!(led.active[0].mechanism, LOOKS);
    // under its model the other seems likelier
    let about = settled.model.as_ref().expect("a model");
    let there = diagnosis::diagnose(about, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis");
    assert_eq!(there.best().fit.active[0].mechanism, WORKS);
    let found = diagnose_settled(&pair, &mut settled, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis");
    assert_eq!(found.best().fit.active[0].mechanism, LOOKS);
    assert_eq!(settled.model.expect("a model").about, Some(LOOKS));
    assert_eq!(settled.leading.expect("one leads").active, led.active);
}

/// What led before the comparison was found under the same model: where the comparison finds it likelier, that is how likely it is.
#[test]
fn what_led_is_no_less_likely_than_the_comparison_finds_it() {
    const BEHIND: f64 = 20.0;
    let (pair, observed) = (Pair::new(better_elsewhere, [1.0; 2], None), [observed()]);
    let mut settled = settled(&pair, &[0], &observed, &|_| ()).expect("a fit");
    let leading = settled.leading.as_mut().expect("one leads");
    let (hypothesis, log_evidence) = (leading.hypothesis.clone(), leading.log_evidence);
    leading.log_evidence -= BEHIND;
    let found = diagnose_settled(&pair, &mut settled, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis");
    let same = found.candidates.iter().find(|c| c.rival.is_none() && c.fit.hypothesis == hypothesis);
    let behind = log_evidence - same.expect("it was compared").fit.log_evidence;
    assert!(behind.abs() < 0.5, "{behind}");
}

/// A search that never arrives ends all the same, and its progress with it.
#[test]
fn a_search_without_an_end_is_as_long_as_was_said() {
    let pair = Pair { growth: Some(1.0), ..Pair::new(bent, [1.0; 2], None) };
    let told = std::cell::RefCell::new(Vec::new());
    settled(&pair, &[0], &[observed()], &|step| told.borrow_mut().push(step.done.expect("a count"))).expect("a fit");
    let told = told.into_inner();
    let of = told[0].1;
    assert_eq!(told, (0..of).map(|done| (done, of)).collect::<Vec<_>>());
}

#[test]
fn the_runner_up_is_followed_to_where_it_leads() {
    let settled = settled(&Pair::new(bent, [1.0; 2], None), &[0], &[observed()], &|_| ()).expect("a fit");
    let leading = settled.leading.expect("one leads");
    assert_eq!(leading.active[0].mechanism, WORKS);
    assert!((leading.active[0].values[0] - TRUTH).abs() < 0.1, "{:?}", leading.active);
    assert_eq!(settled.model.expect("a model").about, Some(WORKS));
}

/// One mechanism at either of two places, known badly elsewhere: the place where it is at work is found, not the one that looks like it about the drawing.
#[test]
fn a_mechanism_is_followed_at_its_other_place_too() {
    let settled = settled(&Pair::at_two_places(bent, None), &[0], &[observed()], &|_| ()).expect("a fit");
    let leading = settled.leading.expect("one leads");
    assert_eq!((leading.active[0].mechanism, leading.active[0].choice), (0, Some(WORKS as f64)));
    assert!((leading.active[0].values[0] - TRUTH).abs() < 0.1, "{:?}", leading.active);
    assert_eq!(settled.model.expect("a model").about, Some(WORKS));
}

/// Many places of the one that leads do not keep another mechanism from being followed.
#[test]
fn a_rival_of_a_mechanism_with_many_places_is_followed() {
    let settled = settled(&Pair::with_many_places(bent, None), &[0], &[observed()], &|_| ()).expect("a fit");
    assert_eq!(settled.leading.expect("one leads").active[0].mechanism, WORKS);
}

/// About the drawing five others look more like what is at work than it does itself.
#[test]
fn one_of_many_that_look_alike_is_followed_to_where_it_leads() {
    let settled = settled(&Pair::with_a_crowd(one_of_many), &[0], &[observed()], &|_| ()).expect("a fit");
    let leading = settled.leading.expect("one leads");
    assert_eq!(leading.active[0].mechanism, WORKS);
    assert!((leading.active[0].values[0] - TRUTH).abs() < 0.1, "{:?}", leading.active);
}

/// Nothing tells the two from one another: the one that does not lead has no model about it in the comparison, but what it came to about itself.
#[test]
fn whatever_did_not_lead_counts_as_about_itself() {
    let (pair, observed) = (Pair::new(both_bent, [1.0; 2], None), [observed()]);
    let mut settled = settled(&pair, &[0], &observed, &|_| ()).expect("a fit");
    let found = diagnose_settled(&pair, &mut settled, &[0], &observed, &Settings::default(), &|_| ()).expect("a diagnosis");
    let probability = |mechanism: usize| found.mechanisms.iter().find(|(m, _)| *m == mechanism).map_or(0.0, |(_, p)| *p);
    assert!([LOOKS, WORKS].iter().all(|m| (0.4..0.6).contains(&probability(*m))), "{:?}", found.mechanisms);
}

/// A comparison with all that it is told, and how many there were.
fn compared(pair: &Pair, settled: &mut Settled<Pair>) -> (Diagnosis, usize) {
    let comparisons = std::cell::Cell::new(0);
    let count = |step: progress::Step| {
        if step.task == "nominal model and noise" {
            comparisons.set(comparisons.get() + 1);
        }
    };
    let found = diagnose_settled(pair, settled, &[0], &[observed()], &Settings::default(), &count).expect("a diagnosis");
    (found, comparisons.get())
}

/// What has no name is not followed before the comparison, and its size elsewhere is wrong.
#[test]
fn whatever_the_comparison_finds_is_followed_to_a_model_about_it() {
    let mut pair = Pair::new(unlike_and_larger, [1.0; 2], None);
    pair.mechanisms[WORKS].named = false;
    let mut settled = settled(&pair, &[0], &[observed()], &|_| ()).expect("a fit");
    assert_eq!(settled.leading.as_ref().expect("one leads").active[0].mechanism, LOOKS);
    let (found, comparisons) = compared(&pair, &mut settled);
    let best = &found.best().fit.active[0];
    assert_eq!((best.mechanism, settled.model.expect("a model").about, comparisons), (WORKS, Some(WORKS), 2));
    assert!((best.values[0] - TRUTH).abs() < 0.1, "{best:?}");
}

/// A model about it says nothing else of it.
#[test]
fn whatever_is_the_same_about_itself_is_compared_once() {
    let mut pair = Pair::new(unlike, [1.0; 2], None);
    pair.mechanisms[WORKS].named = false;
    let mut settled = settled(&pair, &[0], &[observed()], &|_| ()).expect("a fit");
    let (found, comparisons) = compared(&pair, &mut settled);
    let best = &found.best().fit.active[0];
    assert_eq!((best.mechanism, settled.model.expect("a model").about, comparisons), (WORKS, Some(LOOKS), 1));
    assert!((best.values[0] - TRUTH).abs() < 0.1, "{best:?}");
}

/// Nothing is made anew about the one that led and is the likeliest, though there is always a model that says something else of its size.
#[test]
fn the_one_that_led_is_not_followed_again() {
    let pair = Pair { growth: Some(1.1), ..Pair::new(unlike, [1.0; 2], None) };
    let mut settled = settled(&pair, &[0], &[observed()], &|_| ()).expect("a fit");
    let led = settled.leading.clone().expect("one leads").active;
    let scale = settled.model.as_ref().expect("a model").scale;
    let (found, comparisons) = compared(&pair, &mut settled);
    assert_eq!((&found.best().fit.active, comparisons), (&led, 1));
    assert_eq!(settled.model.expect("a model").scale, scale);
    assert!((led[0].values[0] * scale - TRUTH).abs() < 0.1, "{led:?}");
}

/// Wherever the model is made anew another one without a name seems likelier: after three comparisons the last model stays, and all that led count as
/// about themselves.
#[test]
fn comparisons_that_lead_ever_further_are_three() {
    let mut crowd = Pair::with_a_crowd(flattered);
    for (number, mechanism) in crowd.mechanisms.iter_mut().enumerate().skip(2) {
        (mechanism.named, mechanism.weight) = (false, 10.0 - number as f64);
    }
    // nor are two at once likely
    crowd.mechanisms[1].weight = 1e-4;
    let mut settled = settled(&crowd, &[0], &[observed()], &|_| ()).expect("a fit");
    assert_eq!(settled.leading.as_ref().expect("one leads").active[0].mechanism, 0);
    let (found, comparisons) = compared(&crowd, &mut settled);
    assert_eq!((found.best().fit.active[0].mechanism, comparisons), (4, 3));
    assert_eq!(settled.model.expect("a model").about, Some(3));
    let size = |mechanism: usize| {
        let alone = |fit: &&Fit| matches!(&fit.active[..], [active] if active.mechanism == mechanism);
        let mut plain = found.candidates.iter().filter(|c| c.rival.is_none()).map(|c| &c.fit);
        plain.find(alone).expect("it was compared").active[0].values[0]
    };
    for mechanism in 0..6 {
        let expected = if mechanism < 4 { TRUTH } else { TRUTH / 1.25 };
        assert!((size(mechanism) - expected).abs() < 0.1, "{mechanism}: {}", size(mechanism));
    }
}
