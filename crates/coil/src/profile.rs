//! Courses of the drives: what can be run, the rest before it, and a smooth course through the rows of a record.

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
        if self.drives.len() != drives || self.drives.iter().any(|d| d.len() != self.time.len()) {
            return bad(0, format!("{drives} courses of {} instants are needed", self.time.len()));
        }
        for (row, t) in self.time.iter().enumerate() {
            if !t.is_finite() || (row > 0 && *t <= self.time[row - 1]) {
                return bad(row, format!("time {t} s must be finite and later than the one before"));
            }
            if let Some(value) = self.drives.iter().map(|d| d[row]).find(|v| !v.is_finite()) {
                return bad(row, format!("{value} must be finite"));
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
        let spread = |of: &dyn Fn(usize, f64) -> f64, rows: &[f64]| -> Vec<f64> {
            let between = (1..rows.len()).flat_map(|n| {
                // the rows themselves keep their bits
                (1..=parts).map(move |part| if part == parts { rows[n] } else { of(n, fraction(part)) })
            });
            rows.first().copied().into_iter().chain(between).collect()
        };
        let t = &self.time;
        let cubic = |course: &Vec<f64>| {
            let slopes = slopes(t, course);
            let at = |n: usize, s: f64| {
                let (h, rise) = (t[n] - t[n - 1], course[n] - course[n - 1]);
                let (leaving, arriving) = (h * slopes[n - 1] - rise, h * slopes[n] - rise);
                course[n - 1] + s * rise + s * (1.0 - s) * ((1.0 - s) * leaving - s * arriving)
            };
            spread(&at, course)
        };
        let time = spread(&|n, s| t[n - 1] + s * (t[n] - t[n - 1]), t);
        Self { drives: self.drives.iter().map(cubic).collect(), time }
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
