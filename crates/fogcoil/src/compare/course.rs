//! Bias under a profile: of A, of B, and of B less A row by row.

use coil::SAFETY;

use super::Comparison;
use crate::simulate::{SimulatedRow, Simulation};
use crate::summary::{Summary, over_time};

/// Summary of a course of the bias \[deg/h\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CourseNumbers {
    /// Largest magnitude, and its instant \[s\].
    pub peak: (f64, f64),
    /// Root of the mean square over time.
    pub rms: f64,
    /// Value in the last row.
    pub end: f64,
    /// Numerical errors of the three: estimates; of the difference that of its meshes' difference, and the sum of what modes leave out.
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

    /// Numerical errors of the peak, root mean square and end of the difference: what both designs' meshes are off by alike falls out.
    fn errors_of_difference(&self) -> Option<[f64; 3]> {
        let [a, b] = self.simulations.as_ref()?;
        let apart = |(a, b): (SimulatedRow, SimulatedRow)| {
            (a.time, SAFETY * a.parts().iter().zip(b.parts()).map(|(a, b)| (b - a).abs()).sum::<f64>())
        };
        let off = || a.differences().zip(b.differences()).map(apart);
        let most = off().fold(0.0, |most: f64, (_, off)| most.max(off));
        let mut modes = [0.0; 2];
        for simulation in [a, b] {
            let Summary { peak, rms, .. } = Summary::of(simulation);
            let share = simulation.reduction.bias;
            modes = [modes[0] + share * peak.rate.abs(), modes[1] + share * rms];
        }
        Some([most + modes[0], over_time(off()) + modes[1], most + modes[0]])
    }

    /// The bias of A, of B, and of B less A row by row; `None` without a profile.
    pub fn bias(&self) -> Option<[CourseNumbers; 3]> {
        let [a, b] = self.simulations.as_ref()?.each_ref().map(CourseNumbers::of);
        let rows = self.rate_difference();
        let (first, last) = (*rows.first()?, *rows.last()?);
        let peak = rows
            .iter()
            .fold((0.0, first.0), |(most, at), (time, rate)| if rate.abs() > most { (rate.abs(), *time) } else { (most, at) });
        let rms = over_time(rows.iter().copied());
        let errors = self.errors_of_difference()?;
        Some([a, b, CourseNumbers { peak, rms, end: last.1, errors }])
    }
}
