//! Other minima of a fit: a parameter whose effect turns back does the same at two values.

use super::fitter::{Fit, Fitter};
use super::objective::Objective;
use super::unknowns::Unknown;
use crate::Error;

/// Least weight of a minimum beside the best that is told: what is less likely moves no end of an interval.
const LEAST: f64 = 0.01;
/// Standard deviations, of the narrower one, from which two minima are two.
const APART: f64 = 2.0;

impl Fitter<'_> {
    /// Fits of the same hypothesis under the same noise that end elsewhere, each begun with one parameter of a mechanism at another of its starts.
    ///
    /// Parameters with kinks stay where they are: the records know these best, and a second look has been around them.
    pub(crate) fn elsewhere(&self, best: &Fit) -> Result<Vec<Fit>, Error> {
        let objective = Objective::new(self, &best.hypothesis, &best.noise)?;
        let mut found: Vec<Fit> = Vec::new();
        for (at, unknown) in best.layout.iter().enumerate() {
            let Unknown::Mechanism { place, parameter } = *unknown else { continue };
            let mechanism = &self.model.mechanisms()[best.hypothesis.mechanisms[place].0];
            let of = &mechanism.parameters[parameter];
            if mechanism.parameters.len() == 1 || !of.around.is_empty() {
                continue;
            }
            let mut starts: Vec<f64> = mechanism.starts.iter().map(|start| of.prior.standard(start[parameter])).collect();
            starts.sort_by(f64::total_cmp);
            starts.dedup();
            for start in starts {
                let mut u = best.u.clone();
                u[at] = start;
                let fit = objective.concluded(objective.descend(objective.point(u)?)?)?;
                // a wide one beside a narrow one is another
                let is_apart =
                    |other: &Fit| (fit.u[at] - other.u[at]).abs() > APART * deviation(&fit, at).min(deviation(other, at));
                if counts(&fit, best) && std::iter::once(best).chain(&found).all(is_apart) {
                    found.push(fit);
                }
            }
        }
        Ok(found)
    }
}

/// Whether a minimum holds enough beside the best to be told.
fn counts(fit: &Fit, best: &Fit) -> bool {
    fit.log_evidence - best.log_evidence > LEAST.ln()
}

fn deviation(fit: &Fit, at: usize) -> f64 {
    fit.covariance[(at, at)].max(0.0).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::candidate;

    #[test]
    fn a_minimum_of_more_than_a_hundredth_of_the_best_counts() {
        let of = |log_evidence: f64| Fit { log_evidence, ..candidate(&[0], 1.0).fit };
        for best in [-300.0, 0.0, 300.0] {
            for (share, expected) in [(2.0_f64, true), (1.0, true), (0.011, true), (0.009, false), (1e-9, false)] {
                assert_eq!(counts(&of(best + share.ln()), &of(best)), expected, "{share} beside {best}");
            }
        }
    }
}
