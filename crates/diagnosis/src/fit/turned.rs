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
                let counts = fit.log_evidence - best.log_evidence > LEAST.ln();
                if counts && std::iter::once(best).chain(&found).all(is_apart) {
                    found.push(fit);
                }
            }
        }
        Ok(found)
    }
}

fn deviation(fit: &Fit, at: usize) -> f64 {
    fit.covariance[(at, at)].max(0.0).sqrt()
}
