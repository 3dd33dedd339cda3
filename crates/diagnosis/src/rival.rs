//! The flexible rival: what a structure, added to a fit, gains of evidence.
//!
//! Functions with columns B (whitened) and independent normal amplitudes of standard deviation s add to ln p(data), the fit's own unknowns marginalised,
//! Σ ½ (s g)²/(1 + s² e) − ½ ln(1 + s² e) over the eigenvalues e of BᵀB − BᵀJ C JᵀB and the gradient's shares g along their vectors: exact for a
//! linear model.

use crate::fit::Fit;
use crate::structure::{Basis, Reach, bases, range, steps};
use crate::{ForwardModel, Structure};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A structure found in a residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Rival {
    /// The kind of structure.
    pub structure: Structure,
    /// The channel in which it was found.
    pub channel: usize,
    /// Period in the level, or instant of a step \[s\], where the structure has one.
    pub at: Option<f64>,
    /// Gain of ln evidence over the fit it is added to.
    pub gain: f64,
}

/// Amplitudes that are averaged over, in units of the channel's white noise over a minute, so that the length of a record's rows does not
/// matter.
const AMPLITUDES: [f64; 4] = [0.3, 1.0, 3.0, 10.0];

/// Duration of a record \[s\].
fn span(time: &[f64]) -> f64 {
    time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first)
}

/// ln of the mean of e^x, each with its share.
fn log_mean_exp(values: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let most = values.clone().fold(f64::NEG_INFINITY, |m, v| m.max(v.0));
    if most == f64::NEG_INFINITY {
        return most;
    }
    most + values.map(|(v, share)| share * (v - most).exp()).sum::<f64>().ln()
}

impl Fit {
    /// Products of functions, and the gradient of ln p by their amplitudes, the fit's own unknowns marginalised: they have the covariance (JᵀJ + P)⁻¹.
    pub(crate) fn marginal(&self, columns: &DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let shared = self.jacobian().tr_mul(columns);
        let free = columns.tr_mul(columns) - shared.tr_mul(&(&self.covariance * &shared));
        // what is left of the fit's own gradient, where it has not quite settled, is not the functions' merit
        let unsettled = self.jacobian().tr_mul(&self.whitened) - self.beforehand.slope(&self.u);
        (free, columns.tr_mul(&self.whitened) - shared.tr_mul(&(&self.covariance * unsettled)))
    }

    /// Gain of ln evidence by adding functions with independent normal amplitudes of standard deviation `scale`, for each scale.
    pub(crate) fn gain(&self, columns: &DMatrix<f64>, scales: &[f64]) -> Vec<f64> {
        let (free, gradient) = self.marginal(columns);
        let SymmetricEigen { eigenvalues, eigenvectors } = ((&free + free.transpose()) / 2.0).symmetric_eigen();
        let along = eigenvectors.tr_mul(&gradient);
        let of = |scale: &f64| {
            eigenvalues
                .iter()
                .zip(along.iter())
                .map(|(e, g)| {
                    let m = 1.0 + scale * scale * e.max(0.0);
                    (scale * g).powi(2) / m / 2.0 - m.ln() / 2.0
                })
                .sum()
        };
        scales.iter().map(of).collect()
    }

    /// Gain of ln evidence of each structure in each channel, best first.
    pub(crate) fn rivals(&self, model: &dyn ForwardModel, records: &[usize], times_of: &[&[f64]]) -> Vec<Rival> {
        let states = || records.iter().map(|r| model.state(*r));
        let spans = || times_of.iter().map(|time| span(time));
        let reach = Reach {
            level: range(states().flat_map(|s| &s.level)),
            rate: range(states().flat_map(|s| &s.rate)),
            longest: spans().fold(0.0, f64::max),
            together: spans().sum::<f64>().max(f64::MIN_POSITIVE),
        };
        let mut rivals = Vec::new();
        for channel in 0..model.channels().len() {
            let residuals: Vec<&[f64]> = self.residuals.iter().map(|channels| channels[channel].as_slice()).collect();
            let steps = steps(times_of, &residuals, &reach);
            for structure in Structure::ALL {
                let alternatives: Vec<Vec<Basis>> = records
                    .iter()
                    .enumerate()
                    .map(|(r, record)| bases(structure, times_of[r], model.state(*record), &reach, &steps[r]))
                    .collect();
                let count = alternatives.iter().map(Vec::len).min().unwrap_or(0);
                let mut gains = Vec::new();
                for k in 0..count {
                    if let Some(columns) = self.columns(&alternatives, k, channel, times_of) {
                        let white = (0..records.len()).map(|r| self.noise.white_of_a_minute(r, channel)).fold(0.0, f64::max);
                        let scales: Vec<f64> = AMPLITUDES.iter().map(|a| a * white).collect();
                        let even = 1.0 / scales.len() as f64;
                        let gain = log_mean_exp(self.gain(&columns, &scales).into_iter().map(|g| (g, even)));
                        let at = alternatives.iter().find_map(|of_record| of_record[k].at);
                        gains.push((gain, at, alternatives[0][k].share));
                    }
                }
                let best = gains.iter().max_by(|a, b| a.0.total_cmp(&b.0));
                if let Some(&(_, at, _)) = best {
                    let gain = log_mean_exp(gains.iter().map(|g| (g.0, g.2)));
                    rivals.push(Rival { structure, channel, at, gain });
                }
            }
        }
        rivals.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        rivals
    }

    /// Whitened functions of alternative `k`, of every record one below another, in the rows of the fit's residual.
    fn columns(&self, alternatives: &[Vec<Basis>], k: usize, channel: usize, times_of: &[&[f64]]) -> Option<DMatrix<f64>> {
        let mut columns: Vec<DVector<f64>> = Vec::new();
        for f in 0..alternatives[0][k].functions.len() {
            // largest absolute value 1 over all records
            let most = alternatives.iter().filter_map(|b| b[k].functions.get(f)).flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
            if most.is_nan() || most <= 0.0 || most.is_infinite() {
                return None;
            }
            let mut column = Vec::with_capacity(self.whitened.len());
            for (record, bases) in alternatives.iter().enumerate() {
                for c in 0..self.residuals[record].len() {
                    if c == channel {
                        let series: Vec<f64> = bases[k].functions.get(f)?.iter().map(|v| v / most).collect();
                        column.extend(self.noise.whiten(record, c, &series));
                    } else {
                        column.extend(std::iter::repeat_n(0.0, self.noise.rows(record, c).len()));
                    }
                }
                debug_assert_eq!(times_of[record].len(), self.residuals[record][channel].len());
            }
            columns.push(DVector::from_vec(column));
        }
        (!columns.is_empty()).then(|| DMatrix::from_columns(&columns))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_record_lasts_as_long_wherever_its_clock_begins() {
        assert_eq!([&[][..], &[7.0], &[0.0, 30.0, 60.0], &[500.0, 530.0, 560.0]].map(span), [0.0, 0.0, 60.0, 60.0]);
    }
}
