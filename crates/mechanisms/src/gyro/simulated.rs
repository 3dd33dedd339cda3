//! Designs in full, beside the model that is linear in what is small.

use super::Gyro;
use crate::course::{Clock, RATE, SPOOL};
use crate::record_to_bias::Prepared;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Drive, Dynamics, Error, Profile, STANDARD};
use diagnosis::{Active, Role};

impl Gyro<'_> {
    /// Change of thermometer \[K\] and rate \[deg/h\] from the design that this model is made about to `design` in the rows of a record, by full solutions, less the change that
    /// this model says constants `u` and mechanisms at work make: channel by channel, as [`Self::respond`]. Instruments read both alike.
    ///
    /// `None` where a design has heaters: when they were switched on is no part of it.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn missed(&self, record: usize, u: &[f64], active: &[Active], design: &Design) -> Result<Option<Vec<Vec<f64>>>, Error> {
        if [design, self.library().design()].iter().any(|design| !design.heat.heaters.is_empty()) {
            return Ok(None);
        }
        // this model is exact where it is made about, and the drawing may be far from there
        let mut undisturbed = u.to_vec();
        for ((value, nuisance), here) in undisturbed.iter_mut().zip(&self.nuisances).zip(self.here()) {
            if nuisance.role == Role::Constant {
                *value = here;
            }
        }
        let (changed, exact) = (self.respond(record, u, active)?, self.respond(record, &undisturbed, &[])?);
        let (full, full_exact) = (self.in_full(design)?.under(record)?, self.in_full(self.library().unchanged())?.under(record)?);
        let missed = |channel: usize| {
            let rows = 0..changed[channel].len();
            rows.map(|n| full[channel][n] - full_exact[channel][n] - (changed[channel][n] - exact[channel][n])).collect()
        };
        Ok(Some((0..changed.len()).map(missed).collect()))
    }

    /// Any design in full, to be asked for what it makes of these records.
    ///
    /// # Errors
    /// As [`Self::missed`].
    pub fn in_full(&self, design: &Design) -> Result<InFull<'_>, Error> {
        Ok(InFull { records: &self.records, dynamics: Dynamics::new(design, &[Drive::Chamber], &STANDARD)? })
    }
}

/// A design in full under the records of a [`Gyro`]: each is simulated from rest.
pub struct InFull<'g> {
    records: &'g [Prepared],
    dynamics: Dynamics,
}

impl InFull<'_> {
    /// Thermometer \[°C\] and rate \[deg/h\] in the rows of a record, as instruments without an error read them: channel by channel, as
    /// [`ForwardModel::respond`](diagnosis::ForwardModel::respond).
    ///
    /// # Errors
    /// As [`Gyro::missed`].
    pub fn under(&self, record: usize) -> Result<[Vec<f64>; 2], Error> {
        let record = &self.records[record];
        let clock = Clock::new(&record.time, &record.chamber, record.averaging);
        let profile = Profile { time: clock.time.clone(), drives: vec![clock.chamber.clone()] };
        let responses = self.dynamics.simulate(&profile)?;
        let turned = |n: usize| responses[n].rate() * DEG_PER_H_PER_RAD_PER_S * (clock.time[n] - clock.time[n - 1]);
        let mean = |[from, to]: [usize; 2]| match to > from {
            true => (from + 1..=to).map(turned).sum::<f64>() / (clock.time[to] - clock.time[from]),
            false => 0.0,
        };
        let mut channels = [const { Vec::new() }; 2];
        channels[SPOOL] = clock.rows.iter().map(|&n| responses[n].sensor).collect();
        channels[RATE] = clock.readings().map(mean).collect();
        Ok(channels)
    }
}
