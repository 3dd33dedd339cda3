//! States of the model between the rows of a profile.

use coil::{Dynamics, Profile, ThermalState};

/// Instants between the first and the last at which fields are drawn.
const SAMPLES: usize = 150;
/// Instants at which fields are written, both ends among them.
pub(crate) const MOST_FRAMES: usize = 31;

/// The model's state at an instant.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    /// Instant \[s\].
    pub(crate) time: f64,
    pub(crate) state: ThermalState,
    /// Its rate of change, per second.
    pub(crate) change: ThermalState,
}

/// The middles of [`SAMPLES`] equal intervals; none of a course without duration.
pub(super) fn middles(time: &[f64]) -> Vec<f64> {
    let count = if time.len() > 1 { SAMPLES } else { 0 };
    (0..count).map(|k| along(time, (k as f64 + 0.5) / SAMPLES as f64)).collect()
}

/// [`MOST_FRAMES`] instants from the first to the last; the one there is of a course without duration.
pub(super) fn frames(time: &[f64]) -> Vec<f64> {
    let count = if time.len() > 1 { MOST_FRAMES } else { 1 };
    (0..count).map(|k| along(time, k as f64 / (MOST_FRAMES - 1) as f64)).collect()
}

fn along(time: &[f64], share: f64) -> f64 {
    time[0] + (time[time.len() - 1] - time[0]) * share
}

/// The states at instants that do not decrease.
pub(super) fn samples(dynamics: &Dynamics, course: &Profile, instants: &[f64]) -> Result<Vec<Sample>, coil::Error> {
    let (time, reduced) = (&course.time, dynamics.reduced());
    let mut samples = Vec::with_capacity(instants.len());
    let mut steps = dynamics.steps(course)?;
    for ends in time.windows(2) {
        let Some(step) = steps.next() else { break };
        while samples.len() < instants.len() && instants[samples.len()] <= ends[1] {
            let time = instants[samples.len()];
            // a sample that rounding puts before its row is taken at the row
            let state = reduced.within(&step, (time - ends[0]).max(0.0));
            samples.push(Sample { time, change: reduced.change(&state, &step.slope), state });
        }
    }
    // a course without duration, or a last instant that rounding puts behind it
    samples.extend(instants[samples.len()..].iter().map(|time| {
        let state = steps.state().clone();
        let change = reduced.change(&state, &vec![0.0; state.drives.len()]);
        Sample { time: *time, state, change }
    }));
    Ok(samples)
}
