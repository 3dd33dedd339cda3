//! Bias under a profile: of A, of B, and of B less A row by row.

use super::Comparison;
use crate::simulate::Simulation;
use crate::summary::Summary;

/// Summary of a course of the bias \[deg/h\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CourseNumbers {
    /// Largest magnitude, and its instant \[s\].
    pub peak: (f64, f64),
    /// Root of the mean square over time.
    pub rms: f64,
    /// Value in the last row.
    pub end: f64,
    /// Numerical errors of the three: estimates; of the difference the sum of both.
    pub errors: [f64; 3],
}

impl CourseNumbers {
    fn of(simulation: &Simulation) -> Self {
        let summary = Summary::of(simulation);
        let error = summary.errors.parts[4];
        Self {
            peak: (summary.peak.rate.abs(), summary.peak.time),
            rms: summary.rms,
            end: simulation.row(simulation.count() - 1).rate,
            errors: [error, summary.errors.rms, error],
        }
    }
}

impl Comparison<'_> {
    /// Instants \[s\] and rates \[deg/h\] of B less A, row by row; none without a profile.
    pub(super) fn rate_difference(&self) -> Vec<(f64, f64)> {
        let [a, b] = match &self.simulations {
            Some(simulations) => simulations,
            None => return Vec::new(),
        };
        a.rows().zip(b.rows()).map(|(a, b)| (a.time, b.rate - a.rate)).collect()
    }

    /// The bias of A, of B, and of B less A row by row; `None` without a profile.
    pub fn bias(&self) -> Option<[CourseNumbers; 3]> {
        let [a, b] = self.simulations.as_ref()?.each_ref().map(CourseNumbers::of);
        let rows = self.rate_difference();
        let (first, last) = (*rows.first()?, *rows.last()?);
        let peak = rows
            .iter()
            .fold((0.0, first.0), |(most, at), (time, rate)| if rate.abs() > most { (rate.abs(), *time) } else { (most, at) });
        let duration = last.0 - first.0;
        let squares: f64 = rows.windows(2).map(|w| w[1].1.powi(2) * (w[1].0 - w[0].0)).sum();
        let rms = if duration > 0.0 { (squares / duration).sqrt() } else { 0.0 };
        let errors = [0, 1, 2].map(|n| a.errors[n] + b.errors[n]);
        Some([a, b, CourseNumbers { peak, rms, end: last.1, errors }])
    }
}
