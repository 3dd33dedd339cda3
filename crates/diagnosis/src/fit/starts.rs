//! Starting points of a fit's unknowns.

use super::fitter::Fit;
use super::objective::Objective;
use super::unknowns::Unknown;
use crate::Active;
use nalgebra::DVector;

/// Largest unknown of a known fit [u] from which alone a fit starts; beyond it the fit starts from the middles of the priors, too.
const STRAYED: f64 = 3.0;

impl Objective<'_> {
    /// Unknowns of all combinations of the mechanisms' starts; `known` gives the others, and the mechanisms that it has fitted, beside those that other
    /// fits have `found`.
    pub(super) fn starts(&self, known: Option<&Fit>, found: &[Active]) -> Vec<DVector<f64>> {
        let mut base = DVector::zeros(self.layout.len());
        for (i, unknown) in self.layout.iter().enumerate().filter(|(_, u)| !u.is_mechanism()) {
            let of = |fit: &Fit| fit.layout.iter().position(|other| other == unknown).map(|at| fit.u[at]);
            base[i] = known.and_then(of).unwrap_or(0.0);
        }
        // where the known fit has strayed far to make up for what it lacks, its unknowns are a poor start
        let strayed = base.amax() > STRAYED;
        let mut starts = vec![base];
        if strayed {
            starts.push(DVector::zeros(self.layout.len()));
        }
        for (place, &(mechanism, choice)) in self.hypothesis.mechanisms.iter().enumerate() {
            // a mechanism that is already fitted goes on from there
            let same = |a: &&Active| a.mechanism == mechanism && a.choice == choice;
            let fitted = known.iter().flat_map(|fit| &fit.active).chain(found).find(same).map(|a| vec![a.values.clone()]);
            let values = fitted.unwrap_or_else(|| {
                let mut values = self.fitter.model.mechanisms()[mechanism].starts.clone();
                // what stands for a constant goes on from where that was
                if let (Some(number), Some(known), Some(first)) = (self.fitter.model.stands_for(mechanism), known, values.first())
                {
                    let mut goes_on = first.clone();
                    goes_on[0] = known.nuisances[0][number];
                    values.push(goes_on);
                }
                values
            });
            starts = starts.iter().flat_map(|u| values.iter().map(|values| self.placed(u, place, values))).collect();
        }
        starts
    }

    /// Unknowns with the parameters of the mechanism at `place` put in.
    fn placed(&self, u: &DVector<f64>, place: usize, values: &[f64]) -> DVector<f64> {
        let mut u = u.clone();
        for (i, unknown) in self.layout.iter().enumerate() {
            match *unknown {
                Unknown::Mechanism { place: at, parameter } if at == place => {
                    u[i] = self.prior(*unknown).standard(values[parameter]);
                }
                _ => {}
            }
        }
        u
    }
}
