//! A model that is linear in its constants, made anew about their values by the records.

use crate::fit::{Fit, Fitter, Hypothesis, alternatives};
use crate::noise::Noise;
use crate::{Error, ForwardModel, Nuisance, Observation, Role};
use progress::Step;

const TASK: &str = "finding the constants about which to compare";
/// Most times that a model is made anew. Where it is smooth, the distance to its limit is squared each time.
const ROUNDS: usize = 6;
/// Rounds after which the likeliest of several starts is followed.
const TRIED: usize = 2;
/// Gain of ln evidence from which a mechanism beside the constants is followed where these are within their tolerances.
const MATTERS: f64 = 3.0;
/// Standard deviations from the drawing beyond which a constant may hide a mechanism.
const STRAINED: f64 = 1.0;
/// Standard deviations from the drawing beyond which a constant has strayed: where it is no fit goes on from.
const STRAYED: f64 = 3.0;
/// Share of the leader's gain from which another mechanism is followed, too: about the drawing nobody can tell which of two strong ones it is.
const RIVALS: f64 = 0.5;
/// Rounds of a usual record: of the constants alone, the leader beside them, one rival.
const USUAL: usize = 3 * ROUNDS;
/// Most hypotheses that are tried so from each of the two rounds in which all are: where many do nearly the same about the drawing, their order says little.
const NEAR: usize = 6;
/// Most of them that are followed to the end, those that are the likeliest when they were tried: both flanges, of a mechanism that may be at either, and another one.
const FOLLOWED: usize = 3;
/// Most choices of the leader's own mechanism that are followed so, where it has few: the other flange.
const ELSEWHERE: usize = 1;
/// Choices of a mechanism that are tried.
const CHOICES: usize = 3;

/// A model about the constants that the records favour.
pub struct Settled<M> {
    /// The model anew, where the one given was not good there.
    pub model: Option<M>,
    alone: Alone<M>,
    /// The constants re-estimated, nothing else at work, under the model that is good about *them*: to be compared with all others.
    pub recalibrated: Fit,
    /// The likeliest mechanism beside the constants, where [`Self::model`] is good about those: where a search begins.
    pub leading: Option<Fit>,
    /// Other mechanisms that were followed, each with the model about it, unless that is the one given.
    pub(crate) rivals: Vec<(Fit, Option<M>)>,
    /// The mechanism that explains most beside the constants, by its number, and how much ln evidence it gains on them alone: little or less than
    /// nothing if they suffice.
    pub suspect: Option<(usize, f64)>,
}

/// The model that is good about the constants alone.
enum Alone<M> {
    /// That of [`Settled::model`].
    Settled,
    /// The one given.
    Given,
    /// Another one.
    Other(M),
}

impl<M> Settled<M> {
    /// The model by which [`Self::recalibrated`] was found; `given` is the one that was given.
    pub fn alone<'a>(&'a self, given: &'a M) -> &'a M {
        match &self.alone {
            Alone::Settled => self.model.as_ref().unwrap_or(given),
            Alone::Given => given,
            Alone::Other(model) => model,
        }
    }

    /// The same for good; `None` if it is the one given.
    pub fn into_alone(self) -> Option<M> {
        match self.alone {
            Alone::Settled => self.model,
            Alone::Given => None,
            Alone::Other(model) => Some(model),
        }
    }

    /// Takes another model, the one about `leading`; gives back what led before, with its model.
    pub(crate) fn lead(&mut self, about: Option<M>, leading: Fit) -> Option<(Fit, Option<M>)> {
        let before = std::mem::replace(&mut self.model, about);
        match self.leading.replace(leading) {
            Some(led) => Some((led, before)),
            None => {
                if matches!(self.alone, Alone::Settled) {
                    self.alone = before.map_or(Alone::Given, Alone::Other);
                }
                None
            }
        }
    }
}

/// The model about the constants of the likeliest hypothesis: constants alone, or one mechanism beside them. Each is followed to where the model
/// about its own constants leads, as constants that make up for a mechanism that is left out may be far from those beside it; so are a few mechanisms that come next
/// to the likeliest.
///
/// # Errors
/// [`Error::Data`] if the observations do not fit the model or one of them has no value, [`Error::Definition`] if the model contradicts itself;
/// [`Error`] if the model or a fit fails.
pub fn settled<M: ForwardModel>(
    model: &M,
    records: &[usize],
    observations: &[Observation],
    progress: &dyn Fn(Step),
) -> Result<Settled<M>, Error> {
    let mut steps = 0;
    let mut told = |starts: usize, rounds: usize| {
        progress(Step::counted(TASK, steps, 1 + starts + rounds - TRIED));
        steps += 1;
    };
    let way = |start: Option<&Vec<f64>>| -> Result<Way<M>, Error> {
        let about = start.map(|start| model.about(start, &[])).transpose().map_err(Error::Model)?.flatten();
        let (known, only, rivals) = (None, None, Vec::new());
        Ok(Way { model, records, observations, about, known, only, rivals, rounds: 0, arrived: false })
    };
    // how likely the constants are from where a way starts is seen when they have been found about it
    let tried = |start: Option<&Vec<f64>>, mechanisms: bool| -> Result<(Way<M>, f64), Error> {
        let mut tried = way(start)?;
        (0..TRIED).try_for_each(|_| tried.go_on(mechanisms))?;
        let evidence = tried.settled()?.log_evidence;
        Ok((tried, evidence))
    };
    told(0, USUAL);
    let (mut alone, mut likeliest) = tried(None, false)?;
    let mut first = None;
    let starts = alone.known.as_ref().map_or_else(Vec::new, |known| model.starts(&known.nuisances[0]));
    for start in &starts {
        told(starts.len(), USUAL);
        let (other, evidence) = tried(Some(start), false)?;
        if evidence > likeliest {
            (alone, likeliest, first) = (other, evidence, Some(start));
        }
    }
    let mut told = |rounds: usize| told(starts.len(), rounds);
    while !alone.arrived {
        told(USUAL);
        alone.go_on(false)?;
    }
    let recalibrated = alone.settled()?;
    let Led { fit: leading, gain, .. } =
        leader(alone.here(), records, observations, Some(&recalibrated), (&candidates(model, true), true))?;
    // constants that had to go far may stand for a mechanism that is near the drawing: about them it does not show
    let suspect = leading.hypothesis.mechanisms.first().map(|(mechanism, _)| (*mechanism, gain));
    if gain <= MATTERS && strain(model, &recalibrated) <= STRAINED {
        return Ok(Settled {
            model: alone.about,
            alone: Alone::Settled,
            recalibrated,
            leading: None,
            rivals: Vec::new(),
            suspect,
        });
    }
    // the constants alone may have made up for a mechanism by the start that they prefer
    let (mut beside, first) = if first.is_some() {
        told(USUAL);
        let [(drawn, of_drawn), (other, of_other)] = [tried(None, true)?, tried(first, true)?];
        if of_other > of_drawn { (other, first) } else { (drawn, None) }
    } else {
        (way(None)?, None)
    };
    while !beside.arrived {
        told(USUAL);
        beside.go_on(true)?;
    }
    let mut leader = beside.settled()?;
    // about the leader's constants a rival may look much worse than it is: what it comes to by itself counts
    let mut others = std::mem::take(&mut beside.rivals);
    others.retain(|rival| *rival != leader.hypothesis);
    let rounds = 2 * ROUNDS + others.len() * TRIED + others.len().min(FOLLOWED) * (ROUNDS - TRIED);
    let mut near = Vec::new();
    for rival in others {
        let mut other = Way { only: Some(rival), ..way(first)? };
        for _ in 0..TRIED {
            told(rounds);
            other.go_on(true)?;
        }
        let evidence = other.settled()?.log_evidence;
        near.push((evidence, other));
    }
    near.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut rivals = Vec::new();
    for (_, mut other) in near.into_iter().take(FOLLOWED) {
        while !other.arrived {
            told(rounds);
            other.go_on(true)?;
        }
        let mut led = other.settled()?;
        if led.log_evidence > leader.log_evidence {
            (beside, other) = (other, beside);
            (leader, led) = (led, leader);
        }
        if !led.active.is_empty() {
            rivals.push((led, other.about));
        }
    }
    // each at its best, about its own constants
    let gain = leader.log_evidence - recalibrated.log_evidence;
    let suspect = leader.hypothesis.mechanisms.first().map(|(mechanism, _)| (*mechanism, gain));
    Ok(if gain <= 0.0 {
        Settled { model: alone.about, alone: Alone::Settled, recalibrated, leading: None, rivals, suspect }
    } else if leader.hypothesis == Hypothesis::RECALIBRATED {
        // with mechanisms on the way, the constants alone came to more likely ones
        Settled { model: beside.about, alone: Alone::Settled, recalibrated: leader, leading: None, rivals, suspect }
    } else {
        let alone = alone.about.map_or(Alone::Given, Alone::Other);
        Settled { model: beside.about, alone, recalibrated, leading: Some(leader), rivals, suspect }
    })
}

/// State on the way from a model to one that is good about its own result.
struct Way<'a, M> {
    model: &'a M,
    records: &'a [usize],
    observations: &'a [Observation],
    about: Option<M>,
    known: Option<Fit>,
    /// The hypothesis that is followed, if there is but one.
    only: Option<Hypothesis>,
    /// Mechanisms, and other choices of the likeliest one, that come next to it, in each round in which all are tried.
    rivals: Vec<Hypothesis>,
    rounds: usize,
    arrived: bool,
}

impl<M: ForwardModel> Way<'_, M> {
    fn here(&self) -> &M {
        self.about.as_ref().unwrap_or(self.model)
    }

    /// One round: fits constants alone, or with each of the mechanisms beside them, and makes the model anew about the likeliest.
    fn go_on(&mut self, mechanisms: bool) -> Result<(), Error> {
        if self.arrived {
            return Ok(());
        }
        // who leads is settled after two rounds
        let among = match &self.known {
            Some(known) if self.rounds >= TRIED => vec![known.hypothesis.clone()],
            _ => self.only.clone().map_or_else(|| candidates(self.model, mechanisms), |only| vec![only]),
        };
        // who leads is known by then, and has begun anew in the noise that it left, too: that of a poor fit is large, and hides what keeps it from a better one
        let is_tried = self.rounds >= TRIED;
        let Led { fit, rivals, .. } =
            leader(self.here(), self.records, self.observations, self.known.as_ref(), (&among, !is_tried))?;
        let next = self.here().about(&fit.nuisances[0], &fit.active).map_err(Error::Model)?;
        rivals.into_iter().for_each(|rival| {
            if !self.rivals.contains(&rival) {
                self.rivals.push(rival);
            }
        });
        self.known = Some(fit);
        self.rounds += 1;
        self.arrived = next.is_none() && (among.is_empty() || self.rounds >= TRIED) || self.rounds == ROUNDS;
        self.about = next.or(self.about.take());
        Ok(())
    }

    /// The likeliest under the model as it is here, with its own noise.
    fn settled(&self) -> Result<Fit, Error> {
        let among = self.known.as_ref().map_or_else(Vec::new, |known| vec![known.hypothesis.clone()]);
        let Led { fit: last, .. } = leader(self.here(), self.records, self.observations, self.known.as_ref(), (&among, false))?;
        let fitter = Fitter::new(self.here(), self.records, self.observations)?;
        fitter.fit_with_noise(&last.hypothesis, &last, 2)
    }
}

/// The farthest that a constant of the design is from the drawing, standard deviations.
fn strain(model: &dyn ForwardModel, fit: &Fit) -> f64 {
    let of = |(nuisance, value): (&Nuisance, &f64)| match nuisance.role {
        Role::Constant => nuisance.parameter.prior.standard(*value).abs(),
        Role::ModelError | Role::Sensor => 0.0,
    };
    model.nuisances().iter().zip(&fit.nuisances[0]).map(of).fold(0.0, f64::max)
}

/// The mechanisms that have a name, each alone, of many choices a few; none at all where they are not asked for.
fn candidates(model: &dyn ForwardModel, mechanisms: bool) -> Vec<Hypothesis> {
    let all = if mechanisms { model.mechanisms().len() } else { 0 };
    let named = (0..all).filter(|m| model.mechanisms()[*m].named);
    named
        .flat_map(|mechanism| {
            let hypotheses = alternatives(model, mechanism);
            let every = hypotheses.len().div_ceil(CHOICES).max(1);
            hypotheses.into_iter().skip(every / 2).step_by(every).collect::<Vec<_>>()
        })
        .collect()
}

/// The best of some hypotheses and the constants alone.
struct Led {
    /// With the noise that it leaves.
    fit: Fit,
    /// Its lead on the constants alone, ln evidence.
    gain: f64,
    /// The best of the others that lead on the constants by nearly as much: of other mechanisms, and the leader's own elsewhere.
    rivals: Vec<Hypothesis>,
}

/// The best of some hypotheses and the constants alone.
fn leader(
    model: &dyn ForwardModel,
    records: &[usize],
    observations: &[Observation],
    known: Option<&Fit>,
    (among, begins_anew): (&[Hypothesis], bool),
) -> Result<Led, Error> {
    let fitter = Fitter::new(model, records, observations)?;
    let noise = match known {
        Some(fit) => fit.noise.calmed(model.channels(), observations)?,
        None => Noise::typical(model.channels(), observations)?,
    };
    let recalibrated = fitter.fit(&Hypothesis::RECALIBRATED, &noise, known)?;
    let mut fits = among.iter().map(|hypothesis| fitter.screened(hypothesis, &recalibrated)).collect::<Result<Vec<Fit>, _>>()?;
    // constants that have made up for a mechanism hide it: about the drawing each begins there, too
    if known.is_none() {
        let drawn = recalibrated.as_drawn(model);
        for hypothesis in among {
            fits.push(fitter.screened(hypothesis, &drawn)?);
        }
    }
    // beside derivatives of the constants alone a fit may have missed its minimum, and what is known may have settled in another one: the likeliest begins anew
    let likeliest = fits.iter().filter(|fit| !fit.log_evidence.is_nan()).max_by(|a, b| a.log_evidence.total_cmp(&b.log_evidence));
    if let Some(hypothesis) = likeliest.filter(|_| begins_anew).map(|fit| fit.hypothesis.clone()) {
        fits.push(fitter.fit(&hypothesis, &noise, None)?);
    }
    // what is known goes on from there, too
    let goes_on = |known: &&Fit| !known.active.is_empty() && among.contains(&known.hypothesis) && strain(model, known) <= STRAYED;
    if let Some(known) = known.filter(goes_on) {
        fits.push(fitter.fit(&known.hypothesis, &noise, Some(known))?);
    }
    fits.retain(|fit| !fit.log_evidence.is_nan());
    fits.sort_by(|a, b| b.log_evidence.total_cmp(&a.log_evidence));
    // a switch at a wrong instant leaves so much that constants, and then the noise, make up for it: it is looked for before they do
    if let Some(first) = fits.first().cloned() {
        fits[0] = fitter.looked_around(first)?;
    }
    let gain_of = |fit: &Fit| fit.log_evidence - recalibrated.log_evidence;
    let best = fits.first().filter(|fit| gain_of(fit) > 0.0).unwrap_or(&recalibrated);
    let gain = gain_of(best);
    let mut near: Vec<&Hypothesis> = Vec::new();
    for fit in fits.iter().filter(|fit| gain_of(fit) > MATTERS.max(RIVALS * gain)) {
        if fit.hypothesis != best.hypothesis && !near.contains(&&fit.hypothesis) {
            near.push(&fit.hypothesis);
        }
    }
    let mechanism = |hypothesis: &Hypothesis| hypothesis.mechanisms.first().map(|(mechanism, _)| *mechanism);
    let leads = mechanism(&best.hypothesis);
    let (own, others): (Vec<&Hypothesis>, Vec<&Hypothesis>) = near.into_iter().partition(|near| mechanism(near) == leads);
    // of many choices a few are tried, and none of these is better known than its neighbours
    let has_few = leads.is_some_and(|mechanism| alternatives(model, mechanism).len() <= CHOICES);
    let next = others.into_iter().take(NEAR).chain(own.into_iter().take(if has_few { ELSEWHERE } else { 0 }));
    let rivals = next.cloned().collect();
    // what the leader leaves is noise: the next round compares under that
    let noise = best.noise.refitted(model.channels(), observations, &best.residuals)?;
    Ok(Led { fit: Fit { noise, ..best.clone() }, gain, rivals })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Active, Channel, Failure, NoisePrior, Omission, Parameter, Prior, State};
    use std::cell::RefCell;

    const ROWS: usize = 100;
    const WHITE: f64 = 0.1;

    /// A constant with a column of its own, and mechanisms with columns that are the more alike the nearer their places are.
    struct Places {
        channels: Vec<Channel>,
        constant: [Nuisance; 1],
        mechanisms: Vec<Omission>,
        state: State,
        /// The constant, the mechanism and its size, of every response that was asked for with a mechanism.
        asked: RefCell<Vec<(f64, usize, f64)>>,
    }

    /// A place beyond all rows.
    const NOWHERE: f64 = f64::INFINITY;

    fn column(place: f64) -> impl Iterator<Item = f64> {
        let of = move |n: usize| ((n as f64 - place) / 10.0).powi(2);
        (0..ROWS).map(move |n| (-of(n)).exp())
    }

    impl Places {
        fn new(places: &[f64]) -> Self {
            let noise = NoisePrior::new((WHITE, 1e-4), (1e-9, 1e-4), (1000.0, 1e-4), (1e-9, 1e-4));
            let mechanism = |place: &f64| Omission {
                id: place.to_string(),
                stage: "any".into(),
                parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 1.0 })],
                choice: None,
                starts: vec![vec![0.5]],
                named: true,
                weight: 1.0,
            };
            Self {
                channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1e-6), averaging: 0.0, noise }],
                constant: [Nuisance::normal("constant", 0.0, 1.0, Role::Constant)],
                mechanisms: places.iter().map(mechanism).collect(),
                state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
                asked: RefCell::default(),
            }
        }

        fn all(&self) -> Vec<Hypothesis> {
            candidates(self, true)
        }

        /// Whether a mechanism was asked for at its start beside the constant of the drawing.
        fn began_anew(&self) -> bool {
            self.asked.borrow().iter().any(|(constant, _, size)| (*constant, *size) == (0.0, 0.5))
        }
    }

    impl ForwardModel for Places {
        fn channels(&self) -> &[Channel] {
            &self.channels
        }
        fn nuisances(&self) -> &[Nuisance] {
            &self.constant
        }
        fn mechanisms(&self) -> &[Omission] {
            &self.mechanisms
        }
        fn respond(&self, _: usize, constant: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Failure> {
            let mut y: Vec<f64> = (0..ROWS).map(|n| if n < ROWS / 10 { constant[0] } else { 0.0 }).collect();
            for Active { mechanism, values, .. } in active {
                self.asked.borrow_mut().push((constant[0], *mechanism, values[0]));
                let place: f64 = self.mechanisms[*mechanism].id.parse()?;
                y.iter_mut().zip(column(place)).for_each(|(y, x)| *y += values[0] * x);
            }
            Ok(vec![y])
        }
        fn state(&self, _: usize) -> &State {
            &self.state
        }
    }

    /// A constant of 0.4, a mechanism at 50 of this size, and what is like noise.
    fn observed(size: f64) -> [Observation; 1] {
        let of =
            |(n, x): (usize, f64)| size * x + if n < ROWS / 10 { 0.4 } else { 0.0 } + 1.4 * WHITE * (0.7 * (n * n) as f64).sin();
        let y = column(50.0).enumerate().map(of).collect();
        [Observation { time: (0..ROWS).map(|n| 30.0 * n as f64).collect(), channels: vec![y] }]
    }

    fn way<'a>(model: &'a Places, observations: &'a [Observation]) -> Way<'a, Places> {
        let (about, known, only, rivals) = (None, None, None, Vec::new());
        Way { model, records: &[0], observations, about, known, only, rivals, rounds: 0, arrived: false }
    }

    #[test]
    fn who_leads_begins_anew_and_is_compared_until_two_rounds_are_gone() {
        let (places, observed) = (Places::new(&[50.0, 53.0]), observed(1.0));
        let mut way = way(&places, &observed);
        for round in 0..4 {
            way.arrived = false;
            places.asked.borrow_mut().clear();
            way.go_on(true).expect("a fit");
            let other = places.asked.borrow().iter().any(|(_, mechanism, _)| *mechanism == 1);
            assert_eq!((places.began_anew(), other), (round < TRIED, round < TRIED), "round {round}");
        }
        assert!(way.known.expect("a fit").hypothesis.has(0));
    }

    #[test]
    fn a_model_that_is_good_is_arrived_at_once_with_constants_alone_and_after_two_rounds_beside_mechanisms() {
        let (places, observed) = (Places::new(&[50.0, 53.0]), observed(1.0));
        let mut alone = way(&places, &observed);
        alone.go_on(false).expect("a fit");
        assert!(alone.arrived);
        let mut beside = way(&places, &observed);
        let arrived = [1, 2].map(|_| {
            beside.go_on(true).expect("a fit");
            beside.arrived
        });
        assert_eq!(arrived, [false, true]);
    }

    #[test]
    fn what_is_known_is_compared_only_where_it_is_asked_for() {
        let (places, observed) = (Places::new(&[50.0, 60.0]), observed(1.0));
        let of = |known: Option<&Fit>, among: &[Hypothesis]| {
            leader(&places, &[0], &observed, known, (among, false)).expect("a fit").fit
        };
        let known = of(None, &places.all());
        assert!(known.hypothesis.has(0));
        assert!(of(Some(&known), &places.all()).hypothesis.has(0));
        assert!(of(Some(&known), &places.all()[1..]).hypothesis.has(1));
    }

    #[test]
    fn rivals_gain_more_than_a_half_of_what_the_leader_does() {
        // of the leader's gain they have about nine tenths, six tenths, three tenths and nothing
        let (places, observed) = (Places::new(&[50.0, 53.0, 57.0, 61.0, 90.0]), observed(1.0));
        let all = places.all();
        let led = leader(&places, &[0], &observed, None, (&all, true)).expect("a fit");
        assert!(led.fit.hypothesis.has(0) && led.gain > 50.0, "{}", led.gain);
        assert_eq!(led.rivals, all[1..3]);
    }

    /// In a record of noughts nothing is rounded: what does nothing is exactly as likely as the constants alone.
    #[test]
    fn exact_what_does_nothing_does_not_lead() {
        let places = Places::new(&[NOWHERE]);
        let noughts = [Observation { channels: vec![vec![0.0; ROWS]], ..observed(0.0)[0].clone() }];
        let led = leader(&places, &[0], &noughts, None, (&places.all(), true)).expect("a fit");
        assert_eq!((led.fit.hypothesis, led.gain), (Hypothesis::RECALIBRATED, 0.0));
    }
}
