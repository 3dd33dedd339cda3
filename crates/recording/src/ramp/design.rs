//! The columns that a channel may hold in response to a temperature.

use super::absent::{Absent, Direction};
use super::branches::Course;
use super::input::Input;
use crate::lag::lagging;
use crate::series::GAP;

/// Columns and where which of them stand.
pub(super) struct Design {
    pub(super) columns: Vec<Vec<f64>>,
    /// Time constants \[s\], the longest first.
    pub(super) lags: Vec<f64>,
    /// Whether heating and cooling have amounts of their own.
    split: bool,
    /// Temperature at a row, from −1 at the coldest to 1 at the warmest.
    pub(super) warmth: Vec<f64>,
    only: Option<Direction>,
}

/// An offset, and a parabola over temperature.
const STATIC: usize = 3;

/// Numbers of columns, and what of each is taken.
pub(super) type Weights = Vec<(usize, f64)>;

impl Design {
    pub(super) fn new(input: &Input, course: &Course, lags: &[f64], heats: bool, cools: bool) -> Self {
        let warmth = warmth(input.seat);
        let mut columns = vec![vec![1.0; warmth.len()], warmth.clone(), warmth.iter().map(|x| x * x).collect()];
        let start = input.time[0];
        // the state in which the record begins is not known
        columns.extend(lags.iter().map(|lag| input.time.iter().map(|t| (-(t - start) / lag).exp()).collect()));
        let rates = |moved: &dyn Fn(usize) -> f64| -> Vec<Vec<f64>> {
            let moved: Vec<f64> = (0..input.time.len()).map(moved).collect();
            lags.iter().map(|lag| lagging_rate(input.time, &moved, *lag, input.interval)).collect()
        };
        let [up, down] = &course.movement;
        columns.extend(rates(&|row| up[row] + down[row]));
        let split = heats && cools;
        if split {
            columns.extend(rates(&|row| (up[row] - down[row]) / 2.0));
        }
        let only = match (heats, cools) {
            (true, false) => Some(Direction::Heating),
            (false, true) => Some(Direction::Cooling),
            _ => None,
        };
        Self { columns, lags: lags.to_vec(), split, warmth, only }
    }

    /// With a further column at the end.
    pub(super) fn with(&self, column: Vec<f64>) -> Self {
        let columns = self.columns.iter().cloned().chain([column]).collect();
        Self { columns, lags: self.lags.clone(), split: self.split, warmth: self.warmth.clone(), only: self.only }
    }

    fn common(&self) -> std::ops::Range<usize> {
        STATIC + self.lags.len()..STATIC + 2 * self.lags.len()
    }

    fn difference(&self) -> std::ops::Range<usize> {
        let end = self.common().end;
        if self.split { end..end + self.lags.len() } else { end..end }
    }

    /// Each lag's amount less their mean, over `size`, in both directions together and between them: what is known beforehand leaves the sums as they are.
    pub(super) fn apart(&self, size: f64) -> Vec<Weights> {
        let share = 1.0 / self.lags.len() as f64;
        let of = |all: std::ops::Range<usize>| {
            let rows = all.clone();
            rows.map(move |own| {
                all.clone().map(|number| (number, (f64::from(u8::from(number == own)) - share) / size)).collect::<Weights>()
            })
        };
        of(self.common()).chain(of(self.difference())).collect()
    }

    /// Settled response to a steady ramp of rate 1: the mean of both directions, or the only one.
    pub(super) fn sensitivity(&self) -> Weights {
        self.common().map(|number| (number, 1.0)).collect()
    }

    /// The same in one direction.
    pub(super) fn towards(&self, direction: Direction) -> Result<Weights, Absent> {
        if self.only.is_some_and(|only| only != direction) {
            return Err(Absent::OneWay(direction));
        }
        let half = 0.5 - direction as usize as f64;
        Ok(self.common().map(|number| (number, 1.0)).chain(self.difference().map(|number| (number, half))).collect())
    }

    /// Heating minus cooling.
    pub(super) fn asymmetry(&self) -> Result<Weights, Absent> {
        let other = match self.only {
            None => return Ok(self.difference().map(|number| (number, 1.0)).collect()),
            Some(Direction::Heating) => Direction::Cooling,
            Some(Direction::Cooling) => Direction::Heating,
        };
        Err(Absent::OneWay(other))
    }

    /// Change at rest from one warmth to another.
    pub(super) fn at_rest(from: f64, to: f64) -> Weights {
        vec![(1, to - from), (2, to * to - from * from)]
    }

    /// Effect of the temperature in a row less that in the first.
    pub(super) fn thermal(&self, row: usize) -> Weights {
        let ramps = self.common().start..self.difference().end;
        let ramps = ramps.map(|number| (number, self.columns[number][row]));
        Self::at_rest(self.warmth[0], self.warmth[row]).into_iter().chain(ramps).collect()
    }

    /// The rate of the temperature as the slowest lag has it \[K/s\].
    pub(super) fn slowest_rate(&self) -> &[f64] {
        &self.columns[self.common().start]
    }

    /// The same as the fastest lag has it.
    pub(super) fn fastest_rate(&self) -> &[f64] {
        &self.columns[self.common().end - 1]
    }
}

/// A temperature \[K\] as −1 at its least to 1 at its largest.
pub(super) fn warmth(temperature: &[f64]) -> Vec<f64> {
    let least = temperature.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = temperature.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let half = if largest > least { (largest - least) / 2.0 } else { 1.0 };
    temperature.iter().map(|value| (value - least) / half - 1.0).collect()
}

/// The rate of a movement as a first-order system of time constant `lag` follows it, its mean since the row before; after a gap the value there.
pub(super) fn lagging_rate(time: &[f64], moved: &[f64], lag: f64, interval: f64) -> Vec<f64> {
    let behind = lagging(time, moved, lag);
    let mean = |row: usize| {
        let span = time[row] - time[row - 1];
        if span > GAP * interval {
            return behind[row] / lag;
        }
        // the system's own state is the movement less what it is behind by
        (moved[row] - behind[row] - moved[row - 1] + behind[row - 1]) / span
    };
    (0..time.len()).map(|row| if row == 0 { 0.0 } else { mean(row) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp of 2 K/s behind a lag of 30 s, over a gap: its rate as the lag has it, 2 (1 − e^(−t/30)) at the gap's end, its mean over other rows.
    #[test]
    fn exact_the_rate_behind_a_lag_and_over_a_gap() {
        let lag = 30.0_f64;
        let time = [0.0, 10.0, 20.0, 500.0, 510.0];
        let moved = time.map(|t| 2.0 * t);
        let rate = lagging_rate(&time, &moved, lag, 10.0);
        // the response is 2 (t − lag (1 − e^(−t/lag)))
        let response = |t: f64| 2.0 * (t - lag * (1.0 - (-t / lag).exp()));
        let mean = |from: f64, to: f64| (response(to) - response(from)) / (to - from);
        let expected = [0.0, mean(0.0, 10.0), mean(10.0, 20.0), 2.0 * (1.0 - (-500.0 / lag).exp()), mean(500.0, 510.0)];
        for (found, expected) in rate.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{rate:?}");
        }
    }

    /// An interval of one and a half usual ones is no gap.
    #[test]
    fn exact_the_mean_over_a_long_interval() {
        let (lag, time) = (30.0_f64, [0.0, 10.0, 20.0, 35.0]);
        let state = |t: f64| 2.0 * (t - lag * (1.0 - (-t / lag).exp()));
        let rate = lagging_rate(&time, &time.map(|t| 2.0 * t), lag, 10.0);
        assert!((rate[3] - (state(35.0) - state(20.0)) / 15.0).abs() < 1e-12, "{rate:?}");
    }
}
