//! Samples of a fit's unknowns, against which Laplace's intervals are held.
//!
//! Metropolis and Hastings' walk whose proposals keep the normal density of a minimum: û + ρ (u − û) + √(1 − ρ²) ξ (S. L. Cotter and others, *Statistical
//! Science* 28, 424 (2013)), along all of that density's axes or a few of them: the fewer, the farther it goes at once where the posterior is not normal.
//! Acceptance depends on the ratio of the posterior to that density alone, so that a normal posterior is sampled at every step. Now and then, with ρ = 0
//! along all axes, the walk jumps from one minimum to another, as the mixture of all their densities proposes. No derivatives are needed.

use super::fitter::{Fit, Fitter};
use super::hypothesis::Hypothesis;
use super::objective::{Objective, Point};
use crate::posterior::Posterior;
use crate::{Error, ForwardModel, Observation};
use nalgebra::{Cholesky, DMatrix, DVector, SymmetricEigen};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};
use rand_distr::StandardNormal;

/// Number of walks, each with its own start.
const WALKS: usize = 4;
/// Share of a walk that is left out: it may not have forgotten its start.
const FORGOTTEN: f64 = 0.2;
/// Kinds of steps of a walk: it jumps, or keeps so much of its place along this share of the axes.
const MOVES: [Option<(f64, f64)>; 6] =
    [None, Some((0.7, 1.0)), Some((0.95, 1.0)), Some((0.3, 0.3)), Some((0.0, 0.1)), Some((0.0, 0.03))];
/// −ln p above the least beyond which a minimum holds nothing.
const FAR: f64 = 15.0;
/// Distance of two minima, in standard deviations of the first, below which they are one.
const ONE: f64 = 1.0;
/// Fewest steps of a walk.
const FEWEST: usize = 20;
/// Distance of a walk's start from a minimum, over the spread of the unknowns.
const SPREAD: f64 = 1.5;

/// An unknown as Laplace's method and a sampler have it.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampled {
    /// The unknown by Laplace's method.
    pub laplace: Posterior,
    /// Ends of the samples' interval that holds it with probability 0.9.
    pub ci90: [f64; 2],
    /// Share of the samples within Laplace's interval.
    pub inside: f64,
    /// Number of independent samples that would determine it as well.
    pub effective: f64,
    /// Ratio of the spread of all walks together to that of each (Gelman and Rubin 1992): 1 where they agree.
    pub disagreement: f64,
}

/// Result of a sampler around a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples {
    /// Every unknown but offsets.
    pub unknowns: Vec<Sampled>,
    /// Number of minima between which it walked.
    pub minima: usize,
    /// Share of the steps that were accepted.
    pub taken: f64,
}

/// A normal density about a minimum.
struct Mode {
    at: DVector<f64>,
    /// its axes, each a standard deviation long
    axes: DMatrix<f64>,
    precision: DMatrix<f64>,
    half_log_det: f64,
}

impl Mode {
    fn of(fit: &Fit) -> Option<Self> {
        let factor = Cholesky::new(fit.covariance.clone())?;
        let half_log_det = factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        let SymmetricEigen { eigenvalues, eigenvectors: mut axes } = fit.covariance.clone().symmetric_eigen();
        axes.column_iter_mut().zip(eigenvalues.iter()).for_each(|(mut axis, square)| axis.scale_mut(square.max(0.0).sqrt()));
        Some(Self { at: fit.u.clone(), axes, precision: factor.inverse(), half_log_det })
    }

    /// −ln of the density, but for a constant.
    fn energy(&self, u: &DVector<f64>) -> f64 {
        let off = u - &self.at;
        (&self.precision * &off).dot(&off) / 2.0
    }

    fn draw(&self, random: &mut SmallRng) -> DVector<f64> {
        &self.axes * DVector::from_fn(self.at.len(), |_, _| random.sample::<f64, _>(StandardNormal))
    }

    /// Next point after `u`, by a proposal that keeps the density: along each axis of the `share`, the part `kept` of its place remains.
    fn beside(&self, u: &DVector<f64>, (kept, share): (f64, f64), random: &mut SmallRng) -> DVector<f64> {
        let places = &self.precision * (u - &self.at);
        // one of them at least
        let one = random.random_range(0..self.at.len());
        let by = DVector::from_fn(self.at.len(), |axis, _| {
            if axis != one && random.random::<f64>() >= share {
                return 0.0;
            }
            // A⁻¹ = Aᵀ P for axes A with A Aᵀ = P⁻¹
            let place = self.axes.column(axis).dot(&places);
            (kept - 1.0) * place + (1.0 - kept * kept).sqrt() * random.sample::<f64, _>(StandardNormal)
        });
        u + &self.axes * by
    }
}

/// −ln of the densities' mixture, but for a constant.
fn mixture(modes: &[Mode], u: &DVector<f64>) -> f64 {
    let each: Vec<f64> = modes.iter().map(|mode| mode.energy(u) + mode.half_log_det).collect();
    let least = each.iter().copied().fold(f64::INFINITY, f64::min);
    least - each.iter().map(|energy| (least - energy).exp()).sum::<f64>().ln()
}

/// Samples the posterior of a hypothesis under the noise of `fit` by four walks of `steps` each, the same for one `seed`.
///
/// # Errors
/// The model's error if it cannot respond; [`Error::NotFinite`] if a minimum has no normal density.
pub fn sampled(
    model: &dyn ForwardModel,
    records: &[usize],
    observations: &[Observation],
    fit: &Fit,
    steps: usize,
    seed: u64,
) -> Result<Samples, Error> {
    let steps = steps.max(FEWEST);
    let fitter = Fitter::new(model, records, observations)?;
    let hypothesis: &Hypothesis = &fit.hypothesis;
    let objective = Objective::new(&fitter, hypothesis, &fit.noise)?;
    let modes = objective.modes(fit)?;
    let mut random = SmallRng::seed_from_u64(seed);
    let (mut walks, mut taken) = (Vec::new(), 0);
    for number in 0..WALKS {
        let own = &modes[number % modes.len()];
        let begun = objective.point(&own.at + own.draw(&mut random) * SPREAD).ok().filter(|point| point.value.is_finite());
        let mut at = begun.map_or_else(|| objective.point(own.at.clone()), Ok)?;
        let mut walk: Vec<DVector<f64>> = Vec::with_capacity(steps);
        for _ in 0..steps {
            let mode = &modes[random.random_range(0..modes.len())];
            let going = MOVES[random.random_range(0..MOVES.len())];
            let to = match going {
                None => &mode.at + mode.draw(&mut random),
                Some(going) => mode.beside(&at.u, going, &mut random),
            };
            // where the model cannot respond the walk does not go
            let Ok(next) = objective.point(to) else {
                walk.push(at.u.clone());
                continue;
            };
            // −ln of what is proposed where the walk jumps, and of what proposals keep where it does not
            let proposed = |u: &DVector<f64>| if going.is_none() { mixture(&modes, u) } else { mode.energy(u) };
            let missed = |point: &Point| point.value - proposed(&point.u);
            // a NaN, of what the model cannot compute, is not gone to
            if random.random::<f64>().ln() < missed(&at) - missed(&next) {
                at = next;
                taken += 1;
            }
            walk.push(at.u.clone());
        }
        walks.push(walk.split_off((FORGOTTEN * steps as f64) as usize));
    }
    let known = fit.posteriors(model);
    let of = |(i, laplace): (usize, Posterior)| {
        let series: Vec<Vec<f64>> = walks.iter().map(|walk| walk.iter().map(|u| u[i]).collect()).collect();
        described(laplace, &series)
    };
    let unknowns = known.into_iter().enumerate().map(of).collect();
    Ok(Samples { unknowns, minima: modes.len(), taken: taken as f64 / (WALKS * steps) as f64 })
}

impl Objective<'_> {
    /// Minima to which the mechanisms' own starts and `fit` lead, the likeliest first.
    fn modes(&self, fit: &Fit) -> Result<Vec<Mode>, Error> {
        let anew = Fit { active: Vec::new(), ..fit.clone() };
        let mut starts = self.starts(Some(&anew), &[]).into_iter().map(|u| self.point(u)).collect::<Result<Vec<_>, _>>()?;
        starts.sort_by(|a, b| a.value.total_cmp(&b.value));
        starts.truncate(super::STARTS);
        starts.insert(0, self.point(fit.u.clone())?);
        let mut fits = Vec::new();
        for start in starts {
            // a start that leads nowhere is no minimum
            if let Ok(found) = self.descend(start).and_then(|end| self.concluded(end)) {
                fits.push(found);
            }
        }
        fits.sort_by(|a, b| a.value().total_cmp(&b.value()));
        let mut modes: Vec<Mode> = Vec::new();
        let least = fits.first().map_or(0.0, Fit::value);
        for fit in fits.iter().filter(|fit| fit.value() - least < FAR) {
            // one that has no width is no density
            let Some(mode) = Mode::of(fit) else { continue };
            let known = modes.iter().any(|known| known.energy(&mode.at) < ONE.powi(2) / 2.0);
            if !known {
                modes.push(mode);
            }
        }
        if modes.is_empty() { Err(Error::NoStart) } else { Ok(modes) }
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn variance(values: &[f64]) -> f64 {
    let mean = mean(values);
    values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (values.len() as f64 - 1.0).max(1.0)
}

fn described(laplace: Posterior, walks: &[Vec<f64>]) -> Sampled {
    let mut all: Vec<f64> = walks.concat();
    all.sort_by(f64::total_cmp);
    let quantile = |share: f64| all[(share * all.len() as f64) as usize];
    let ends = [quantile(0.05), quantile(0.95)].map(|u| laplace.prior.value(u));
    let half = recording::statistics::normal_quantile(0.95) * laplace.sd;
    let inside = all.iter().filter(|u| (**u - laplace.u).abs() <= half).count() as f64 / all.len() as f64;
    // halves of walks: a walk that drifts disagrees with itself
    let halves: Vec<&[f64]> = walks.iter().flat_map(|walk| [&walk[..walk.len() / 2], &walk[walk.len() / 2..]]).collect();
    let within = mean(&halves.iter().map(|half| variance(half)).collect::<Vec<_>>());
    let between = variance(&halves.iter().map(|half| mean(half)).collect::<Vec<_>>());
    let disagreement = if within > 0.0 { (1.0 + between / within).sqrt() } else { f64::INFINITY };
    Sampled { laplace, ci90: ends, inside, effective: effective(walks, within), disagreement }
}

/// Number of independent samples: by the sum of autocorrelations while neighbouring pairs of them are positive (Geyer 1992).
fn effective(walks: &[Vec<f64>], within: f64) -> f64 {
    let length = walks.iter().map(Vec::len).min().unwrap_or(0);
    if within <= 0.0 {
        return 0.0;
    }
    let at = |lag: usize| {
        let of = |walk: &Vec<f64>| {
            let middle = mean(walk);
            (lag..length).map(|n| (walk[n] - middle) * (walk[n - lag] - middle)).sum::<f64>() / length as f64
        };
        mean(&walks.iter().map(of).collect::<Vec<_>>()) / within
    };
    // beyond a walk's length there is no pair, and none positive
    let sum: f64 = (0..).map(|pair| at(2 * pair) + at(2 * pair + 1)).take_while(|two| *two > 0.0).sum();
    (walks.len() * length) as f64 / (2.0 * sum - 1.0).max(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Prior;
    use crate::Role;
    use crate::posterior::Place;
    use statrs::distribution::{Continuous, Normal};

    #[test]
    fn exact_what_is_proposed_is_the_sum_of_the_minima_s_densities() {
        // middles and standard deviations, some of which overlap
        for normals in [&[(0.0, 0.5)][..], &[(0.0, 0.5), (1.0, 2.0)], &[(3.0, 0.1), (-1.0, 1.5), (3.1, 0.4)]] {
            let modes: Vec<Mode> = normals
                .iter()
                .map(|(at, sd): &(f64, f64)| Mode {
                    at: DVector::from_element(1, *at),
                    axes: DMatrix::from_element(1, 1, *sd),
                    precision: DMatrix::from_element(1, 1, sd.powi(-2)),
                    half_log_det: sd.ln(),
                })
                .collect();
            let density = |u: f64| normals.iter().map(|(at, sd)| Normal::new(*at, *sd).expect("a density").pdf(u)).sum::<f64>();
            let energy = |u: f64| mixture(&modes, &DVector::from_element(1, u));
            for u in [-4.0, -0.3, 0.6, 1.7, 3.05, 9.0] {
                let ratio = (density(u) / density(0.2)).ln();
                let said = energy(0.2) - energy(u);
                assert!((said - ratio).abs() < 1e-9, "{normals:?} at {u}: {said} {ratio}");
            }
        }
    }

    fn known() -> Posterior {
        let prior = Prior::Normal { mean: 0.0, sd: 1.0 };
        Posterior { name: String::new(), place: Place::Nominal(Role::Constant), record: None, prior, u: 0.0, sd: 1.0 }
    }

    #[test]
    fn walks_that_go_nowhere_agree_on_nothing() {
        for places in [[0.25, 0.25], [0.25, -0.5]] {
            let stuck = described(known(), &places.map(|at| vec![at; 16]));
            assert_eq!((stuck.disagreement, stuck.effective), (f64::INFINITY, 0.0), "{places:?}");
        }
    }

    /// However much a walk's places make up for one another.
    #[test]
    fn samples_are_no_more_than_steps() {
        let to_and_fro: Vec<f64> = [1.0, -1.0].repeat(9);
        assert_eq!(described(known(), &[to_and_fro.clone(), to_and_fro]).effective, 36.0);
    }

    /// Of a walk that keeps the part ρ of its place, (1 + ρ)/(1 − ρ) steps tell as much as one independent sample.
    #[test]
    fn steps_that_keep_a_part_of_the_place_count_for_less() {
        let mut random = SmallRng::seed_from_u64(3);
        for kept in [0.0_f64, 0.5, 0.9] {
            let mut at = 0.0;
            let mut walk = || {
                at = kept * at + (1.0 - kept * kept).sqrt() * random.sample::<f64, _>(StandardNormal);
                at
            };
            let walks: Vec<Vec<f64>> = (0..4).map(|_| (0..5000).map(|_| walk()).collect()).collect();
            let said = described(known(), &walks);
            let exact = 20_000.0 * (1.0 - kept) / (1.0 + kept);
            assert!((said.effective / exact - 1.0).abs() < 0.2, "{kept}: {} {exact}", said.effective);
            assert!((said.disagreement - 1.0).abs() < 0.01 && (said.inside - 0.9).abs() < 0.03, "{kept}: {said:?}");
        }
    }
}
