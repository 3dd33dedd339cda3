//! Parameters of the best explanation, with the doubt about a mechanism's choice, and about which of several minima is the true one, in their intervals.

use crate::fit::{Fit, Unknown};
use crate::{Candidate, Estimate, ForwardModel, Prior};
use statrs::distribution::{ContinuousCDF, Normal};

/// Shares of the posterior below the ends of an interval.
const ENDS: [f64; 2] = [0.05, 0.95];
/// Halvings that find a quantile.
const HALVINGS: usize = 60;

/// Estimates of the mechanism at `place` in `candidates[0]`. Where the mechanism has a choice, or that candidate's fit ends `elsewhere`, too, intervals are those of
/// the mixture over all candidates that differ in choices only, and over those minima, by their evidence.
pub(crate) fn estimates(model: &dyn ForwardModel, candidates: &[Candidate], elsewhere: &[Fit], place: usize) -> Vec<Estimate> {
    let best = &candidates[0].fit;
    let mut estimates = best.estimates(model, place);
    let (mechanism, choice) = best.hypothesis.mechanisms[place];
    if choice.is_none() && elsewhere.is_empty() {
        return estimates;
    }
    let like = |c: &&Candidate| {
        c.rival == candidates[0].rival
            && c.fit.hypothesis.numbers() == best.hypothesis.numbers()
            && c.fit.hypothesis.constants_free == best.hypothesis.constants_free
    };
    let others = elsewhere.iter().map(|fit| (fit, candidates[0].probability * (fit.log_evidence - best.log_evidence).exp()));
    let kin: Vec<(&Fit, f64, usize)> = candidates
        .iter()
        .filter(like)
        .map(|c| (&c.fit, c.probability))
        .chain(others)
        .filter_map(|(fit, p)| Some((fit, p, fit.hypothesis.mechanisms.iter().position(|m| m.0 == mechanism)?)))
        .collect();
    let sum: f64 = kin.iter().map(|(_, p, _)| p).sum();
    if sum.is_nan() || sum <= 0.0 {
        return estimates;
    }
    let mut choices: Vec<(f64, f64)> =
        kin.iter().filter_map(|(fit, p, at)| Some((fit.hypothesis.mechanisms[*at].1?, p / sum))).collect();
    choices.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_chosen = choice.is_some();
    if let Some(first) = estimates.first_mut().filter(|_| is_chosen) {
        first.ci90 = ENDS.map(|end| {
            let mut below = 0.0;
            let reached = choices.iter().find(|(_, p)| {
                below += p;
                below >= end
            });
            reached.or(choices.last()).map_or(first.value, |c| c.0)
        });
    }
    for (parameter, estimate) in estimates.iter_mut().skip(usize::from(is_chosen)).enumerate() {
        let prior = model.mechanisms()[mechanism].parameters[parameter].prior;
        let normals: Vec<(Normal, f64)> =
            kin.iter().filter_map(|(fit, p, at)| normal(model, fit, *at, parameter).map(|n| (n, p / sum))).collect();
        estimate.ci90 = ENDS.map(|end| quantile(&prior, &normals, end));
    }
    estimates
}

/// Posterior of a parameter's u in one fit.
fn normal(model: &dyn ForwardModel, fit: &Fit, place: usize, parameter: usize) -> Option<Normal> {
    let at = fit.layout.iter().position(|u| *u == Unknown::Mechanism { place, parameter })?;
    Normal::new(fit.u[at], fit.deviation(model, at).max(f64::MIN_POSITIVE)).ok()
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
    use crate::verdict::{candidate, library};
    use crate::{Active, Parameter, Rival, Structure};

    const PRIOR: Prior = Prior::Normal { mean: 10.0, sd: 2.0 };
    /// Standard deviation of a size's u, far less than its distances.
    const NARROW: f64 = 0.01;

    /// A mechanism with a choice at work; its size's u is the choice plus `shift`.
    fn choosing(choice: f64, shift: f64, probability: f64) -> Candidate {
        let mut candidate = candidate(&[0], probability);
        let (fit, u) = (&mut candidate.fit, shift + choice);
        fit.hypothesis.mechanisms = vec![(0, Some(choice))];
        fit.active = vec![Active { mechanism: 0, values: vec![PRIOR.value(u)], choice: Some(choice) }];
        fit.layout = vec![Unknown::Offset { record: 0, channel: 0 }, Unknown::Mechanism { place: 0, parameter: 0 }];
        fit.u = nalgebra::DVector::from_column_slice(&[0.3, u]);
        fit.covariance = nalgebra::DMatrix::from_row_slice(2, 2, &[0.5, 0.0, 0.0, NARROW * NARROW]);
        candidate
    }

    /// Estimates of the choice and the size.
    fn estimated(candidates: &[Candidate]) -> [Estimate; 2] {
        let mut model = library(&[true, true]);
        model.0[0].choice = Some(("place".into(), (0..10).map(f64::from).collect()));
        model.0[0].parameters = vec![Parameter::new("size", PRIOR)];
        estimates(&model, candidates, &[], 0).try_into().expect("a choice and a size")
    }

    /// Ends of what a candidate at u = 0 says of its size.
    fn own_ends() -> [f64; 2] {
        [-1.0, 1.0].map(|side| PRIOR.value(side * 1.644_853_626_951 * NARROW))
    }

    fn near(a: [f64; 2], b: [f64; 2]) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9), "{a:?} {b:?}");
    }

    /// Two minima of one mechanism, as likely as each other: a tenth of either lies beyond an end.
    #[test]
    fn exact_an_interval_is_that_of_all_minima() {
        let at = |u: f64| {
            let mut candidate = choosing(u, 0.0, 1.0);
            candidate.fit.hypothesis.mechanisms = vec![(0, None)];
            candidate.fit.active[0].choice = None;
            candidate
        };
        let mut model = library(&[true, true]);
        model.0[0].parameters = vec![Parameter::new("size", PRIOR)];
        let [found] = &estimates(&model, &[at(0.0)], &[at(1.0).fit], 0)[..] else { panic!("a size") };
        near(found.ci90, [-1.281_551_565_545 * NARROW, 1.0 + 1.281_551_565_545 * NARROW].map(|u| PRIOR.value(u)));
    }

    /// A half of all probability, of which five choices have so much that the ends of the interval are in the middle of the second and of the last but
    /// one: there the size is the one of these. All else has the other half.
    #[test]
    fn exact_an_interval_is_that_of_all_choices_by_their_shares_and_of_nothing_else() {
        let likeliest = [choosing(3.0, -3.0, 0.44)];
        let choices =
            [choosing(5.0, -3.0, 0.02), choosing(1.0, -3.0, 0.02), choosing(4.0, -3.0, 0.01), choosing(2.0, -3.0, 0.01)];
        let rival = Some(Rival { structure: Structure::Step, channel: 0, at: None, gain: 0.0 });
        let beside = Candidate { rival, ..choosing(0.0, -4.0, 0.2) };
        let (mut recalibrated, mut pair) = (choosing(9.0, -4.0, 0.2), choosing(8.0, -4.0, 0.1));
        recalibrated.fit.hypothesis.constants_free = true;
        pair.fit.hypothesis.mechanisms.push((1, None));
        for others in [vec![], vec![beside], vec![recalibrated], vec![pair]] {
            let [choice, size] = estimated(&[&likeliest[..], &others, &choices].concat());
            assert_eq!((choice.value, choice.ci90, size.value), (3.0, [2.0, 4.0], PRIOR.value(0.0)));
            near(size.ci90, [-1.0, 1.0].map(|u| PRIOR.value(u)));
        }
        // the only one
        let [choice, size] = estimated(&likeliest);
        assert_eq!(choice.ci90, [3.0; 2]);
        near(size.ci90, own_ends());
    }

    #[test]
    fn where_nothing_is_probable_a_candidate_speaks_for_itself() {
        for nothing in [0.0, f64::NAN] {
            let [choice, size] = estimated(&[choosing(3.0, -3.0, nothing), choosing(5.0, -3.0, nothing)]);
            assert_eq!(choice.ci90, [3.0; 2]);
            near(size.ci90, own_ends());
        }
    }

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

    /// The same of one that is a third as likely: of the upper one, which has a quarter of all, a fifth lies beyond an end, of the lower one a fifteenth.
    #[test]
    fn exact_a_minimum_has_its_share_of_an_interval() {
        let at = |u: f64, log_evidence: f64| {
            let mut candidate = choosing(u, 0.0, 0.8);
            candidate.fit.hypothesis.mechanisms = vec![(0, None)];
            candidate.fit.active[0].choice = None;
            candidate.fit.log_evidence = log_evidence;
            candidate
        };
        let mut model = library(&[true, true]);
        model.0[0].parameters = vec![Parameter::new("size", PRIOR)];
        let (best, other) = (at(0.0, 50.0), at(1.0, 50.0 - 3.0_f64.ln()).fit);
        let [found] = &estimates(&model, &[best], &[other], 0)[..] else { panic!("a size") };
        let [low, high] = [1.0 / 15.0, 0.8].map(recording::statistics::normal_quantile);
        near(found.ci90, [low * NARROW, 1.0 + high * NARROW].map(|u| PRIOR.value(u)));
    }
}
