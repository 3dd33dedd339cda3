//! Parameters of the best explanation, with the doubt about a mechanism's choice in their intervals.

use crate::fit::Unknown;
use crate::{Candidate, Estimate, ForwardModel, Prior};
use statrs::distribution::{ContinuousCDF, Normal};

/// Shares of the posterior below the ends of an interval.
const ENDS: [f64; 2] = [0.05, 0.95];
/// Halvings that find a quantile.
const HALVINGS: usize = 60;

/// Estimates of the mechanism at `place` in `candidates[0]`. Where the mechanism has a choice, intervals are those of the mixture over
/// all candidates that differ in choices only.
pub(crate) fn estimates(model: &dyn ForwardModel, candidates: &[Candidate], place: usize) -> Vec<Estimate> {
    let best = &candidates[0].fit;
    let mut estimates = best.estimates(model, place);
    let (mechanism, choice) = best.hypothesis.mechanisms[place];
    if choice.is_none() {
        return estimates;
    }
    let like = |c: &&Candidate| {
        c.rival == candidates[0].rival
            && c.fit.hypothesis.numbers() == best.hypothesis.numbers()
            && c.fit.hypothesis.constants_free == best.hypothesis.constants_free
    };
    let kin: Vec<(&Candidate, usize)> = candidates
        .iter()
        .filter(like)
        .filter_map(|c| Some((c, c.fit.hypothesis.mechanisms.iter().position(|m| m.0 == mechanism)?)))
        .collect();
    let sum: f64 = kin.iter().map(|(c, _)| c.probability).sum();
    if sum.is_nan() || sum <= 0.0 {
        return estimates;
    }
    let mut choices: Vec<(f64, f64)> =
        kin.iter().filter_map(|(c, at)| Some((c.fit.hypothesis.mechanisms[*at].1?, c.probability / sum))).collect();
    choices.sort_by(|a, b| a.0.total_cmp(&b.0));
    if let Some(first) = estimates.first_mut() {
        first.ci90 = ENDS.map(|end| {
            let mut below = 0.0;
            let reached = choices.iter().find(|(_, p)| {
                below += p;
                below >= end
            });
            reached.or(choices.last()).map_or(first.value, |c| c.0)
        });
    }
    for (parameter, estimate) in estimates.iter_mut().skip(1).enumerate() {
        let prior = model.mechanisms()[mechanism].parameters[parameter].prior;
        let normals: Vec<(Normal, f64)> =
            kin.iter().filter_map(|(c, at)| normal(c, *at, parameter).map(|n| (n, c.probability / sum))).collect();
        estimate.ci90 = ENDS.map(|end| quantile(&prior, &normals, end));
    }
    estimates
}

/// Posterior of a parameter's u in one candidate.
fn normal(candidate: &Candidate, place: usize, parameter: usize) -> Option<Normal> {
    let fit = &candidate.fit;
    let at = fit.layout.iter().position(|u| *u == Unknown::Mechanism { place, parameter })?;
    Normal::new(fit.u[at], fit.covariance[(at, at)].max(f64::MIN_POSITIVE).sqrt()).ok()
}

/// Value below which a share of a mixture lies.
fn quantile(prior: &Prior, mixture: &[(Normal, f64)], share: f64) -> f64 {
    let (mut low, mut high) = (-20.0, 20.0);
    for _ in 0..HALVINGS {
        let middle = (low + high) / 2.0;
        let below: f64 = mixture.iter().map(|(normal, weight)| weight * normal.cdf(middle)).sum();
        if below < share {
            low = middle;
        } else {
            high = middle;
        }
    }
    prior.value((low + high) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_quantiles_of_one_normal_and_of_two() {
        let prior = Prior::Normal { mean: 2.0, sd: 3.0 };
        let normal = |mean: f64, sd: f64, weight: f64| (Normal::new(mean, sd).expect("a density"), weight);
        for (mean, sd) in [(0.3, 0.5), (-4.0, 0.01), (7.0, 1.0)] {
            let one = [normal(mean, sd, 1.0)];
            for (share, z) in [(0.05, -1.644_853_626_951), (0.5, 0.0), (0.95, 1.644_853_626_951)] {
                let value = quantile(&prior, &one, share);
                assert!((value - prior.value(mean + z * sd)).abs() < 1e-9, "{value} at {share}");
            }
        }
        // far apart: a quarter of all is half of the lower one's
        let two = [normal(-3.0, 0.1, 0.5), normal(4.0, 0.1, 0.5)];
        for (share, u) in [(0.25, -3.0), (0.75, 4.0)] {
            assert!((quantile(&prior, &two, share) - prior.value(u)).abs() < 1e-9);
        }
    }
}
