//! The heat flow without reduction: every unknown stepped in time.

use super::state::dot;
use super::{Drive, ThermalModel};
use crate::{Error, Profile};
use fem_core::{Effort, State, Transient};

/// Courses of output functionals, computed on all unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct FullRun {
    /// Value of each functional (inner index) at each instant of the profile.
    pub outputs: Vec<Vec<f64>>,
    /// Steps and factorisations.
    pub effort: Effort,
}

fn failed(source: fem_core::Error) -> Error {
    Error::Solve { part: "chamber", source }
}

impl ThermalModel {
    /// Runs a profile from rest at its first instant with an error of at most `tolerance` \[K\] in each step.
    ///
    /// `functionals` act on the temperature of all nodes; heaters are off before the first instant.
    ///
    /// # Errors
    /// [`Error::Profile`] for a profile that cannot be run; [`Error::Solve`] if a solve fails.
    pub fn run(&self, profile: &Profile, functionals: &[Vec<f64>], tolerance: f64) -> Result<FullRun, Error> {
        profile.check(self.shapes().len())?;
        let conductivity = self.conductivity().matrix().clone();
        let mut transient = Transient::new(self.capacity().clone(), conductivity).map_err(failed)?;
        let sudden = self.stored().iter().map(|w| transient.rate_of_load(w)).collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let unknowns = self.map().reduced();
        let at = |n: usize| -> Vec<f64> { profile.drives.iter().map(|d| d[n]).collect() };
        let mut state = State { value: vec![0.0; unknowns], rate: vec![0.0; unknowns] };
        // heaters are off before the first instant: switching them on moves θ, not T
        for ((_, shape), u) in self.drives().iter().zip(self.shapes()).zip(at(0)).filter(|((d, _), _)| **d == Drive::Heaters) {
            state.value.iter_mut().zip(self.map().restrict(shape)).for_each(|(v, s)| *v -= u * s);
        }
        let held_back = transient.rate_of_load(&self.conductivity().matrix().multiply(&state.value)).map_err(failed)?;
        state.rate.iter_mut().zip(held_back).for_each(|(r, k)| *r -= k);
        let onto: Vec<Vec<f64>> = functionals.iter().map(|f| self.map().restrict(f)).collect();
        let rest: Vec<Vec<f64>> = functionals.iter().map(|f| self.shapes().iter().map(|s| dot(s, f)).collect()).collect();
        let read = |u: &[f64], theta: &[f64]| -> Vec<f64> {
            rest.iter().zip(&onto).map(|(rest, onto)| dot(rest, u) + dot(onto, theta)).collect()
        };
        let mut outputs = vec![read(&at(0), &state.value)];
        let (mut slope, mut halvings) = (vec![0.0; self.shapes().len()], 0);
        for n in 1..profile.time.len() {
            let dt = profile.time[n] - profile.time[n - 1];
            let next: Vec<f64> = at(n).iter().zip(at(n - 1)).map(|(b, a)| (b - a) / dt).collect();
            let mut load = vec![0.0; unknowns];
            for ((stored, sudden), (new, old)) in self.stored().iter().zip(&sudden).zip(next.iter().zip(&slope)) {
                load.iter_mut().zip(stored).for_each(|(l, w)| *l -= new * w);
                state.rate.iter_mut().zip(sudden).for_each(|(r, s)| *r -= (new - old) * s);
            }
            slope = next;
            state = transient.advance(&state, &load, dt, tolerance, &mut halvings).map_err(failed)?;
            outputs.push(read(&at(n), &state.value));
        }
        Ok(FullRun { outputs, effort: transient.effort() })
    }
}
