//! Laws that the library does not hold: small ones are tried beside the known mechanisms, and the choice among them is paid for.
//!
//! A law's first parameter is its size, in which the response is linear. All laws are ranked by the gain of the size at each of the law's starts;
//! the best are fitted, constants and sensors free, and the best of those is kept; then a second law is sought beside it.

use crate::fit::{Fit, Fitter, Hypothesis, checked};
use crate::rival::Rival;
use crate::{Active, Candidate, Error, ForwardModel, Observation, Prior};
use nalgebra::DMatrix;
use progress::Step;
use std::ops::Range;

const TASK: &str = "composing a law for what nothing explains";
/// Least gain of ln evidence of a law, the choice among all paid for: e³ is strong evidence on the scale of Kass and Raftery (1995).
const WORTH: f64 = 3.0;

/// Extent of the search for laws.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Breadth {
    /// Laws that may be added up.
    pub terms: usize,
    /// Number of laws that are fitted after the ranking.
    pub followed: usize,
    /// Number of these laws that are given noise of their own.
    pub likeliest: usize,
    /// Laws that are followed in the place of each that came first, one at a time: laws that explain a record together need not come first each by itself
    /// (limited discrepancy search with one discrepancy, Harvey and Ginsberg 1995).
    pub turnings: usize,
    /// Fate of the laws before the last.
    pub earlier: Earlier,
}

/// Fate of the earlier laws when another one is found beside them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Earlier {
    /// All of them stay.
    Kept,
    /// Those stay that still gain enough beside the others, the choice paid for.
    Weighed,
}

impl Default for Breadth {
    fn default() -> Self {
        Self { terms: 2, followed: 6, likeliest: 3, turnings: 0, earlier: Earlier::Kept }
    }
}

/// Composed laws.
#[derive(Debug, Clone)]
pub struct Composed {
    /// The fit with them: the known mechanisms come first, then the laws.
    pub fit: Fit,
    /// Number of laws.
    pub laws: usize,
    /// Gain of ln evidence over the known mechanisms, the choice among all laws paid for.
    pub gain: f64,
    /// Cost of that choice in ln evidence.
    pub choice: f64,
    /// Other laws that were fitted in the place of the last, and by how much ln evidence they stay behind it; the nearest first.
    pub others: Vec<(usize, f64)>,
    /// The fit after every law that was added, the last of them [`Self::fit`].
    pub steps: Vec<Fit>,
}

impl Composed {
    /// Mechanisms beside which the laws stand, by their numbers.
    pub fn names(&self) -> Vec<usize> {
        self.fit.active[..self.fit.active.len() - self.laws].iter().map(|active| active.mechanism).collect()
    }

    /// ln of evidence times prior probability, which is `log_prior` for any laws of this number: terms are found in any order, and others in the
    /// place of the last count, too.
    pub fn log_weight(&self, log_prior: f64) -> f64 {
        let orders = (1..=self.laws).product::<usize>() as f64;
        let kin = 1.0 + self.others.iter().map(|(_, behind)| (-behind).exp()).sum::<f64>();
        self.fit.log_evidence - self.choice + orders.ln() + kin.ln() + log_prior
    }
}

/// The best of the `laws`, by their numbers in the model, one or two of them, beside a fit; `None` if none gains enough.
///
/// # Errors
/// [`Error`] if the model or a fit fails.
pub fn compose(
    model: &dyn ForwardModel,
    laws: Range<usize>,
    records: &[usize],
    observations: &[Observation],
    beside: &Fit,
    progress: &dyn Fn(Step),
) -> Result<Option<Composed>, Error> {
    compose_within(model, laws, records, observations, beside, Breadth::default(), progress)
}

/// The same, with the extent of the search given.
///
/// # Errors
/// As [`compose`].
pub fn compose_within(
    model: &dyn ForwardModel,
    laws: Range<usize>,
    records: &[usize],
    observations: &[Observation],
    beside: &Fit,
    breadth: Breadth,
    progress: &dyn Fn(Step),
) -> Result<Option<Composed>, Error> {
    let fitter = Fitter::new(model, records, observations)?;
    let weights: f64 = laws.clone().map(|law| model.mechanisms()[law].weight).sum();
    // ln of how unlikely a law is before anything is seen
    let cost = |law: usize| (weights / model.mechanisms()[law].weight).ln();
    let first = beside.hypothesis.mechanisms.len();
    let choice = |fit: &Fit| fit.hypothesis.mechanisms[first..].iter().map(|(law, _)| cost(*law)).sum::<f64>();
    let net = |fit: &Fit| fit.log_evidence - choice(fit);
    let mut best = Path { fit: beside.clone(), others: Vec::new(), steps: Vec::new() };
    let mut met: Vec<Vec<usize>> = Vec::new();
    let mut without = beside.log_evidence;
    let mut follow = |mut path: Path, turnings: &mut Vec<Path>| -> Result<Path, Error> {
        // the same laws in another order are no other way
        while path.steps.len() < breadth.terms && !met.contains(&path.fit.hypothesis.numbers()) {
            progress(Step::counted(TASK, path.steps.len(), breadth.terms));
            met.push(path.fit.hypothesis.numbers());
            let (known, longer) = fitter.lengthened(&path, &laws, breadth, &cost, first)?;
            if path.steps.is_empty() {
                without = known;
            }
            let mut longer = longer.into_iter();
            let Some(next) = longer.next() else { break };
            turnings.extend(longer);
            path = next;
        }
        Ok(path)
    };
    let mut turnings = Vec::new();
    best = follow(best, &mut turnings)?;
    for turning in turnings {
        let other = follow(turning, &mut Vec::new())?;
        if net(&other.fit) > net(&best.fit) {
            best = other;
        }
    }
    let composed = |Path { fit, others, steps }: Path| Composed {
        laws: fit.hypothesis.mechanisms.len() - first,
        gain: net(&fit) - without,
        choice: choice(&fit),
        fit,
        others,
        steps,
    };
    Ok((!best.steps.is_empty()).then(|| composed(best)))
}

/// Laws added one after another.
#[derive(Clone)]
struct Path {
    fit: Fit,
    /// As [`Composed::others`].
    others: Vec<(usize, f64)>,
    steps: Vec<Fit>,
}

/// The likeliest of the `laws` in the place of one mechanism of a fit, all others kept; `None` if none is defined on these records.
///
/// A mechanism that such a law explains as well is named by what was thought of it beforehand, not by what was recorded.
///
/// # Errors
/// As [`compose`].
pub fn in_place_of(
    model: &dyn ForwardModel,
    laws: &Range<usize>,
    records: &[usize],
    observations: &[Observation],
    fit: &Fit,
    mechanism: usize,
) -> Result<Option<Fit>, Error> {
    let fitter = Fitter::new(model, records, observations)?;
    let mut without = fit.hypothesis.clone();
    without.mechanisms.retain(|(other, _)| *other != mechanism);
    // with the noise that the mechanism leaves, which has swallowed nothing of it
    let Some(base) = defined(fitter.fit(&without, &fit.noise, Some(fit)))? else { return Ok(None) };
    // one law stands for all others: the choice among them is no matter
    let mut likeliest = fitter.with_one_more(&base, laws, Breadth::default(), &|_| 0.0)?.into_iter();
    Ok(likeliest.next())
}

/// Gain of ln evidence of a fit when its noise is fitted anew from that of another, which may have found a likelier noise. At least 0.
///
/// # Errors
/// As [`compose`].
pub fn gained_by_noise_of(
    model: &dyn ForwardModel,
    records: &[usize],
    observations: &[Observation],
    candidate: &Candidate,
    other: &Fit,
) -> Result<f64, Error> {
    let fitter = Fitter::new(model, records, observations)?;
    if candidate.rival.is_some() {
        checked::states(model, records, observations)?;
    }
    let fit = &candidate.fit;
    let from = Fit { noise: other.noise.clone(), ..fit.clone() };
    let Some(again) = defined(fitter.fit_with_noise(&fit.hypothesis, &from, 2))? else { return Ok(0.0) };
    // of what was noise the structure beside it may have had its part already
    let structure = candidate.rival.as_ref().map_or(0.0, |before| {
        let times: Vec<&[f64]> = observations.iter().map(|o| o.time.as_slice()).collect();
        let same = |r: &Rival| r.structure == before.structure && r.channel == before.channel;
        again.rivals(model, records, &times).into_iter().find(same).map_or(0.0, |now| now.gain - before.gain)
    });
    Ok((again.log_evidence - fit.log_evidence + structure).max(0.0))
}

/// A fit; none where its law gives no number on the way, so that it is no law for these records.
fn defined(fit: Result<Fit, Error>) -> Result<Option<Fit>, Error> {
    match fit {
        Ok(fit) => Ok(Some(fit)),
        Err(Error::NotFinite | Error::NoStart) => Ok(None),
        Err(error) => Err(error),
    }
}

/// The law that was added last.
fn last(fit: &Fit) -> usize {
    fit.hypothesis.mechanisms.last().map_or(0, |(law, _)| *law)
}

impl Fitter<'_> {
    /// A path with one law more, for every law of the likeliest that gains enough; and ln evidence without it, the noise as well fitted as with it.
    fn lengthened(
        &self,
        path: &Path,
        laws: &Range<usize>,
        breadth: Breadth,
        cost: &impl Fn(usize) -> f64,
        first: usize,
    ) -> Result<(f64, Vec<Path>), Error> {
        let known = &path.fit;
        let net = |fit: &Fit| fit.log_evidence - cost(last(fit));
        // noise that has not swallowed what is sought
        let noise = known.noise.calmed(self.model.channels(), self.observations)?;
        let Some(base) = defined(self.fit(&known.hypothesis, &noise, Some(known)))? else {
            return Ok((known.log_evidence, Vec::new()));
        };
        let own = self.with_one_more(&base, laws, breadth, cost)?;
        // the noise that a law leaves may be likelier without the law, too, than the noise that was found without it
        let mut without = known.log_evidence;
        for other in own.first().map(|best| &best.noise).into_iter().chain([&noise]) {
            let from = Fit { noise: other.clone(), ..known.clone() };
            let again = defined(self.fit_with_noise(&known.hypothesis, &from, 2))?;
            without = again.map_or(without, |fit| without.max(fit.log_evidence));
        }
        let mut longer = Vec::new();
        for (place, best) in own.iter().enumerate().take(1 + breadth.turnings) {
            if net(best) - without < WORTH {
                break;
            }
            let beside = own.iter().enumerate().filter(|(other, _)| *other != place);
            let others = beside.map(|(_, fit)| (last(fit), net(best) - net(fit))).collect();
            let mut fit = best.clone();
            if breadth.earlier == Earlier::Weighed {
                fit = self.weighed(fit, first, cost)?;
            }
            let steps = path.steps.iter().cloned().chain([fit.clone()]).collect();
            longer.push(Path { fit, others, steps });
        }
        Ok((without, longer))
    }

    /// A fit with one law more, for the likeliest of the laws, each with its own noise; the best first, the choice paid for.
    fn with_one_more(
        &self,
        base: &Fit,
        laws: &Range<usize>,
        breadth: Breadth,
        cost: &impl Fn(usize) -> f64,
    ) -> Result<Vec<Fit>, Error> {
        let net = |fit: &Fit| fit.log_evidence - cost(last(fit));
        let taken = base.hypothesis.numbers();
        let mut fits = Vec::new();
        let mut ranked = self.ranked(laws.clone().filter(|law| !taken.contains(law)), base)?;
        ranked.sort_by(|a, b| (b.0 - cost(b.1.mechanism)).total_cmp(&(a.0 - cost(a.1.mechanism))));
        for (_, law) in ranked.into_iter().take(breadth.followed) {
            let mut hypothesis: Hypothesis = base.hypothesis.clone();
            hypothesis.mechanisms.push((law.mechanism, None));
            let mut from = base.clone();
            from.active.push(law);
            fits.extend(defined(self.screened(&hypothesis, &from))?);
        }
        fits.sort_by(|a, b| net(b).total_cmp(&net(a)));
        let mut own = Vec::new();
        for fit in fits.iter().take(breadth.likeliest) {
            own.extend(defined(self.fit_with_noise(&fit.hypothesis, fit, 2))?);
        }
        own.sort_by(|a, b| net(b).total_cmp(&net(a)));
        Ok(own)
    }

    /// A fit without those of its laws, from number `first` on and before the last, that gain less than they cost.
    fn weighed(&self, mut fit: Fit, first: usize, cost: &impl Fn(usize) -> f64) -> Result<Fit, Error> {
        let mut place = first;
        while place + 1 < fit.hypothesis.mechanisms.len() {
            let mut hypothesis = fit.hypothesis.clone();
            let (law, _) = hypothesis.mechanisms.remove(place);
            match defined(self.fit_with_noise(&hypothesis, &fit, 2))? {
                Some(without) if fit.log_evidence - without.log_evidence < cost(law) + WORTH => (fit, place) = (without, first),
                _ => place += 1,
            }
        }
        Ok(fit)
    }

    /// Laws with the gain of their sizes beside a fit, each at the best of its starts and at the best size there.
    fn ranked(&self, laws: impl Iterator<Item = usize>, base: &Fit) -> Result<Vec<(f64, Active)>, Error> {
        let respond = |at: usize, active: &[Active]| {
            let rows = self.observations[at].time.len();
            checked::responded(self.model, self.records[at], rows, &base.nuisances[at], active)
        };
        let without = (0..self.records.len()).map(|at| respond(at, &base.active)).collect::<Result<Vec<_>, _>>()?;
        let mut ranked: Vec<(f64, Active)> = Vec::new();
        for law in laws {
            let omission = &self.model.mechanisms()[law];
            let Some(prior @ (Prior::Normal { .. } | Prior::Size { .. })) = omission.parameters.first().map(|p| p.prior) else {
                continue;
            };
            let sd = prior.sd();
            let mut most: Option<(f64, Active)> = None;
            for start in &omission.starts {
                let own = Active { mechanism: law, values: start.clone(), choice: None };
                let active: Vec<Active> = base.active.iter().cloned().chain([own.clone()]).collect();
                let mut column = Vec::new();
                for (at, without) in without.iter().enumerate() {
                    for (channel, (with, without)) in respond(at, &active)?.iter().zip(without).enumerate() {
                        let per_sd: Vec<f64> = with.iter().zip(without).map(|(a, b)| (a - b) / start[0] * sd).collect();
                        column.extend(base.noise.whiten(at, channel, &per_sd));
                    }
                }
                let Some((gain, amplitude)) = gained(base, column, prior) else { continue };
                if most.as_ref().is_none_or(|(most, _)| gain > *most) {
                    let mut values = start.clone();
                    values[0] = amplitude * sd;
                    most = Some((gain, Active { values, ..own }));
                }
            }
            ranked.extend(most);
        }
        Ok(ranked)
    }
}

/// Gain of ln evidence of a whitened function beside a fit, and its likeliest amplitude in standard deviations of `prior`, the amplitude's prior;
/// `None` if it is not finite.
fn gained(base: &Fit, column: Vec<f64>, prior: Prior) -> Option<(f64, f64)> {
    let (free, gradient) = base.marginal(&DMatrix::from_vec(column.len(), 1, column));
    let (gain, amplitude) = gain_of(free[0].max(0.0), gradient[0], prior);
    gain.is_finite().then_some((gain, amplitude))
}

/// ln of the mean, over the prior, of the likelihood exp(`along` a − `free` a²/2) of an amplitude a in standard deviations of the prior, and the likeliest
/// amplitude: for a size as if it were normal, or about the amplitude that the data alone tell, whichever is more.
fn gain_of(free: f64, along: f64, prior: Prior) -> (f64, f64) {
    let precision = 1.0 + free;
    let normal = (along * along / precision / 2.0 - precision.ln() / 2.0, along / precision);
    // far out the data alone say how large it is
    let largest = match prior {
        Prior::Size { scale } if normal.1.abs() > 1.0 => {
            let amplitude = along / free;
            let u = prior.standard(amplitude * scale);
            let slope = (prior.value(u + 1e-3) - prior.value(u - 1e-3)) / 2e-3 / scale;
            (along * along / free / 2.0 - u * u / 2.0 - (1.0 + free * slope * slope).ln() / 2.0, amplitude)
        }
        _ => normal,
    };
    if largest.0 > normal.0 { largest } else { normal }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of the likelihood over the prior, by quadrature.
    fn mean(free: f64, along: f64, prior: Prior) -> f64 {
        let step = 1e-4;
        let most = if free > 0.0 { along * along / free / 2.0 } else { 0.0 };
        let likelihood = |u: f64| {
            let a = prior.value(u) / prior.sd();
            (along * a - free * a * a / 2.0 - most - u * u / 2.0).exp()
        };
        let sum: f64 = (-80_000..=80_000).map(|n| likelihood(f64::from(n) * step)).sum();
        most + (sum * step / std::f64::consts::TAU.sqrt()).ln()
    }

    #[test]
    fn exact_the_gain_of_a_normal_size_is_the_mean_of_its_likelihood() {
        for (free, along) in [(0.0, 0.0), (0.3, 0.5), (4.0, -6.0), (50.0, 20.0)] {
            let (gain, amplitude) = gain_of(free, along, Prior::Normal { mean: 0.0, sd: 0.7 });
            let exact = mean(free, along, Prior::Normal { mean: 0.0, sd: 0.7 });
            assert!((gain - exact).abs() < 1e-6, "{free} {along}: {gain} and {exact}");
            assert!((amplitude - along / (1.0 + free)).abs() < 1e-12);
        }
    }

    #[test]
    fn the_gain_of_a_far_size_is_that_of_the_data_beside_its_own_prior() {
        // an amplitude of 12 standard deviations, known to a quarter and to a fortieth of one
        for (free, scale) in [(16.0, 1.0), (1600.0, 1.0), (16.0, 1e-6)] {
            let prior = Prior::Size { scale };
            let (gain, amplitude) = gain_of(free, -12.0 * free, prior);
            let exact = mean(free, -12.0 * free, prior);
            assert!((amplitude + 12.0).abs() < 1e-9, "{amplitude}");
            assert!((gain - exact).abs() < 0.02, "{free} {scale}: {gain} and {exact}");
        }
        // what does nothing of its own gains nothing, whatever rounding leaves of it
        let (nothing, _) = gain_of(1e-24, 1e-9, Prior::Size { scale: 3.0 });
        assert!(nothing.abs() < 1e-9, "{nothing}");
        // a small one is as if its prior were normal
        let near = [Prior::Size { scale: 3.0 }, Prior::Normal { mean: 0.0, sd: 3.0 }].map(|prior| gain_of(2.0, 1.5, prior));
        assert_eq!(near[0], near[1]);
    }
}
