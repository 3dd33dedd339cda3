//! Courses of the drives: conditions to run them, the rest before them, and a smooth course through the rows of a record.

use crate::{Drive, Error};

/// Courses of the drives in time, linear between instants.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Instants \[s\], increasing.
    pub time: Vec<f64>,
    /// One course per drive of the [`Dynamics`](crate::Dynamics), each as long as `time`.
    pub drives: Vec<Vec<f64>>,
}

impl Profile {
    /// Whether it can be run: `drives` courses of finite values at instants that increase.
    ///
    /// # Errors
    /// [`Error::Profile`] names the instant at fault.
    pub fn check(&self, drives: usize) -> Result<(), Error> {
        let bad = |row: usize, problem: String| Err(Error::Profile { row, problem });
        if self.time.is_empty() {
            return bad(0, "there is no instant; give at least one".into());
        }
        if self.drives.len() != drives {
            return bad(
                0,
                format!("there are {} courses of drives where {drives} are needed; give one for each", self.drives.len()),
            );
        }
        if let Some(course) = self.drives.iter().find(|course| course.len() != self.time.len()) {
            let (values, instants) = (course.len(), self.time.len());
            return bad(
                0,
                format!("the course of a drive has {values} values where there are {instants} instants; give one for each"),
            );
        }
        for (row, t) in self.time.iter().enumerate() {
            if !t.is_finite() || (row > 0 && *t <= self.time[row - 1]) {
                return bad(row, format!("time {t} s must be finite and later than the one before"));
            }
            if let Some(value) = self.drives.iter().map(|d| d[row]).find(|v| !v.is_finite()) {
                return bad(row, format!("a drive is {value} there; it must be finite"));
            }
        }
        Ok(())
    }

    /// The drives at rest before the first instant: its temperatures everywhere, heaters off.
    pub fn rest(&self, drives: &[Drive]) -> Vec<f64> {
        let of = |(drive, course): (&Drive, &Vec<f64>)| if *drive == Drive::Heaters { 0.0 } else { course[0] };
        drives.iter().zip(&self.drives).map(of).collect()
    }

    /// The same rows with `parts` − 1 instants between each two, on the piecewise cubic whose slope at a row is that of the parabola
    /// through it and its neighbours (at the ends, of the straight line).
    ///
    /// For records of a chamber, which turns smoothly; a programme with corners is linear between them already. A slope is at most the
    /// largest change beside its row over the longest interval beside it, which equal intervals never exceed: the cubic leaves the range
    /// of two rows by at most a quarter of the largest change in theirs and the two intervals beside it. Rates of
    /// [`crate::Dynamics::simulate`] are then means over the parts.
    ///
    /// A profile that [`crate::Dynamics::simulate`] refuses is still refused; none or one part leaves the rows as they are.
    #[must_use]
    pub fn smoothed(&self, parts: usize) -> Self {
        let shortest = self.drives.iter().map(Vec::len).fold(self.time.len(), usize::min);
        if parts < 2 || shortest < self.time.len() {
            return self.clone();
        }
        let fraction = |part: usize| part as f64 / parts as f64;
        let t = &self.time;
        // the rows themselves keep their bits
        let within = |n: usize, part: usize| if part == parts { t[n] } else { t[n - 1] + fraction(part) * (t[n] - t[n - 1]) };
        let between = (1..t.len()).flat_map(|n| (1..=parts).map(move |part| within(n, part)));
        let time: Vec<f64> = t.first().copied().into_iter().chain(between).collect();
        let drives = self.drives.iter().map(|course| {
            let smooth = Smooth::through(t, course);
            time.iter().map(|t| smooth.at(*t).0).collect()
        });
        Self { drives: drives.collect(), time }
    }
}

/// A course between its rows: the piecewise cubic that has its values and rates there; beyond its ends it stays.
#[derive(Debug, Clone, PartialEq)]
pub struct Smooth {
    time: Vec<f64>,
    course: Vec<f64>,
    rates: Vec<f64>,
}

impl Smooth {
    /// Through rows whose rates nobody told: those of [`Profile::smoothed`]. Instants that do not increase give a course without meaning.
    pub fn through(time: &[f64], course: &[f64]) -> Self {
        Self::with_rates(time, course, &slopes(time, course))
    }

    /// Through rows with these rates \[unit of the course per s\]; of lists that differ in length the shortest counts.
    pub fn with_rates(time: &[f64], course: &[f64], rates: &[f64]) -> Self {
        let rows = time.len().min(course.len()).min(rates.len());
        let first = |of: &[f64]| of[..rows].to_vec();
        Self { time: first(time), course: first(course), rates: first(rates) }
    }

    /// Instants \[s\] of the rows.
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Values in the rows.
    pub fn course(&self) -> &[f64] {
        &self.course
    }

    /// Value and rate at an instant; beyond the ends those of the end, NaN where there is no row. A row has its own, bit by bit.
    pub fn at(&self, t: f64) -> (f64, f64) {
        let n = self.time.partition_point(|row| *row < t);
        match (n.checked_sub(1), self.time.get(n)) {
            (Some(before), Some(after)) if t < *after => self.between(before, t),
            (Some(last), None) => (self.course[last], self.rates[last]),
            (None, None) => (f64::NAN, f64::NAN),
            (_, Some(_)) => (self.course[n], self.rates[n]),
        }
    }

    fn between(&self, n: usize, t: f64) -> (f64, f64) {
        let (h, rise) = (self.time[n + 1] - self.time[n], self.course[n + 1] - self.course[n]);
        let (s, left) = ((t - self.time[n]) / h, (self.time[n + 1] - t) / h);
        let (leaving, arriving) = (h * self.rates[n] - rise, h * self.rates[n + 1] - rise);
        let value = self.course[n] + s * rise + s * left * (left * leaving - s * arriving);
        let rate = (rise + left * (left - 2.0 * s) * leaving + s * (s - 2.0 * left) * arriving) / h;
        (value, rate)
    }
}

/// Slope of a course at each row.
fn slopes(t: &[f64], course: &[f64]) -> Vec<f64> {
    let steps: Vec<(f64, f64)> = t.windows(2).zip(course.windows(2)).map(|(t, u)| (t[1] - t[0], u[1] - u[0])).collect();
    let line = |step: Option<&(f64, f64)>| step.map_or(0.0, |(h, rise)| rise / h);
    let parabola = |w: &[(f64, f64)]| {
        let [(h0, rise0), (h1, rise1)] = [w[0], w[1]];
        let slope = (rise0 / h0 * h1 + rise1 / h1 * h0) / (h0 + h1);
        let most = rise0.abs().max(rise1.abs()) / h0.max(h1);
        slope.max(-most).min(most)
    };
    [line(steps.first())].into_iter().chain(steps.windows(2).map(parabola)).chain([line(steps.last())]).take(t.len()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_that_cannot_be_run_is_told_by_what_is_wrong() {
        let refused = |time: &[f64], drives: &[&[f64]]| {
            let profile = Profile { time: time.to_vec(), drives: drives.iter().map(|course| course.to_vec()).collect() };
            profile.check(1).expect_err("a bad profile").to_string()
        };
        let said = refused(&[0.0, 1.0], &[&[20.0]]);
        assert!(said.contains("the course of a drive has 1 values where there are 2 instants; give one for each"), "{said}");
        let said = refused(&[0.0], &[&[20.0], &[20.0]]);
        assert!(said.contains("there are 2 courses of drives where 1 are needed"), "{said}");
        let said = refused(&[0.0, 1.0], &[&[20.0, f64::NAN]]);
        assert!(said.contains("instant 1") && said.contains("a drive is NaN there; it must be finite"), "{said}");
    }
}
