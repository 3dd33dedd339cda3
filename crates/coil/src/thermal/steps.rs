//! A reduced model stepped through a course of its drives, from rest.

use super::modal::Interval;
use super::{Output, Outputs, Reduced, Step, ThermalState};
use fem_core::dense::transposed_product;
use nalgebra::{DMatrix, DVector};

/// Steps a reduced model through a course, exactly; made by [`Reduced::steps`]. Yields each step after it is made: the state is then
/// that at its end.
#[derive(Debug, Clone)]
pub struct Steps<'a> {
    model: &'a Reduced,
    time: &'a [f64],
    courses: &'a [Vec<f64>],
    /// The instant of `state`.
    at: usize,
    state: ThermalState,
    /// Interval of the last step's length: kept for as many steps as have it.
    interval: Interval,
}

fn drives_at(courses: &[Vec<f64>], n: usize) -> Vec<f64> {
    courses.iter().map(|course| course[n]).collect()
}

impl Reduced {
    /// From rest with the drives at `rest` through `courses`, one a drive, at the instants `time` \[s\], increasing: at the first
    /// instant the drives jump to where the courses begin.
    ///
    /// # Panics
    /// If there is no instant, or a course is shorter than `time`.
    pub fn steps<'a>(&'a self, time: &'a [f64], courses: &'a [Vec<f64>], rest: &[f64]) -> Steps<'a> {
        let drives = drives_at(courses, 0);
        let mut amplitudes = vec![0.0; self.rates.len()];
        self.jump(&mut amplitudes, &drives.iter().zip(rest).map(|(u, rest)| u - rest).collect::<Vec<_>>());
        let state = ThermalState { drives, amplitudes };
        Steps { model: self, time, courses, at: 0, state, interval: self.interval(0.0) }
    }

    /// Every output at every instant of `time`, as [`Self::steps`] goes through them; a drive without a course stays at 0.
    ///
    /// # Panics
    /// As [`Self::steps`].
    pub fn run(&self, time: &[f64], courses: &[Vec<f64>], rest: &[f64]) -> Outputs<Vec<f64>> {
        // a few instants at once: their states stay near, and the outputs are a product of matrices
        const AT_ONCE: usize = 128;
        let weights: Vec<DVector<f64>> = self.outputs.iter().map(Output::vector).collect();
        assert!(!time.is_empty(), "an instant at least");
        let (weights, drives) = (DMatrix::from_columns(&weights), self.outputs.thermometer.at_rest.len());
        let courses = &courses[..drives.min(courses.len())];
        let size = weights.nrows();
        // the last column of a block is the first of the next
        let mut states = DMatrix::<f64>::zeros(size, 1 + AT_ONCE.min(time.len()));
        let mut values = self.outputs.map(|_| Vec::with_capacity(time.len()));
        let mut slope: Vec<f64> = courses.iter().zip(rest).map(|(course, rest)| course[0] - rest).collect();
        self.jump(&mut states.as_mut_slice()[drives..size], &slope);
        let mut interval = self.interval(0.0);
        for first in (0..time.len()).step_by(AT_ONCE) {
            let count = AT_ONCE.min(time.len() - first);
            for n in 0..count {
                let (before, now) = states.as_mut_slice()[n * size..(n + 2) * size].split_at_mut(size);
                let row = first + n;
                courses.iter().zip(&mut *now).for_each(|(course, u)| *u = course[row]);
                if row == 0 {
                    now[drives..].copy_from_slice(&before[drives..]);
                    continue;
                }
                let dt = time[row] - time[row - 1];
                if interval.dt != dt {
                    interval = self.interval(dt);
                }
                slope.iter_mut().zip(courses).for_each(|(slope, course)| *slope = (course[row] - course[row - 1]) / dt);
                interval.step(&before[drives..], &mut now[drives..], &slope);
            }
            let block = transposed_product(&states, &weights);
            let rows = block.column_iter().map(|column| column.into_iter().skip(1).take(count));
            values.iter_mut().zip(rows).for_each(|(values, new)| values.extend(new));
            let last = count * size..(count + 1) * size;
            states.as_mut_slice().copy_within(last, 0);
        }
        values
    }

    /// The state `since` seconds after the start of a step.
    pub fn within(&self, step: &Step, since: f64) -> ThermalState {
        let mut state = step.from.clone();
        self.interval(since).advance(&mut state.amplitudes, &step.slope);
        state.drives.iter_mut().zip(&step.slope).for_each(|(u, slope)| *u += slope * since);
        state
    }

    /// How fast a state changes while the drives change at `slope`: all of it per second.
    pub fn change(&self, state: &ThermalState, slope: &[f64]) -> ThermalState {
        let mode = |((rate, drive), q): ((&f64, &Vec<f64>), &f64)| {
            -rate * q - drive.iter().zip(slope).map(|(drive, slope)| drive * slope).sum::<f64>()
        };
        let amplitudes = self.rates.iter().zip(&self.drive).zip(&state.amplitudes).map(mode).collect();
        ThermalState { drives: slope.to_vec(), amplitudes }
    }
}

impl Steps<'_> {
    /// The state at the end of the last step; before the first, at the first instant.
    pub fn state(&self) -> &ThermalState {
        &self.state
    }
}

impl Iterator for Steps<'_> {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        let dt = self.time.get(self.at + 1)? - self.time[self.at];
        self.at += 1;
        let drives = drives_at(self.courses, self.at);
        let slope: Vec<f64> = drives.iter().zip(&self.state.drives).map(|(b, a)| (b - a) / dt).collect();
        if self.interval.dt != dt {
            self.interval = self.model.interval(dt);
        }
        let mut amplitudes = self.state.amplitudes.clone();
        self.interval.advance(&mut amplitudes, &slope);
        Some(Step { from: std::mem::replace(&mut self.state, ThermalState { drives, amplitudes }), slope, dt })
    }
}
