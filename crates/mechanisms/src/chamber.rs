//! The chamber's temperature as its thermometer and log say.

/// Readings of the chamber's thermometer, freed of its noise ([`recording::smooth`]): passed through the model, that noise would be correlated with
/// every mechanism.
#[derive(Debug, Clone)]
pub struct Chamber {
    time: Vec<f64>,
    /// freed of noise \[°C\]
    pub(crate) values: Vec<f64>,
    /// standard deviation of that noise \[K\]
    pub(crate) noise: f64,
    /// what is left of it, and over which time it is one error \[K, s\]
    pub(crate) left: (f64, f64),
}

impl Chamber {
    /// A course \[°C\] that was given, not read: it has no noise, and its corners stay.
    pub fn given(time: &[f64], values: &[f64]) -> Self {
        let interval = recording::median_interval(time).unwrap_or(1.0);
        Self { time: time.to_vec(), values: values.to_vec(), noise: 0.0, left: (0.0, interval) }
    }

    /// Frees readings \[°C\] of their noise, `digit` the last one that the thermometer shows, if it is known; what is too short is left as it is. The
    /// more readings, the better: average none beforehand. NaN is an instant between rare readings: the course there is the most likely one.
    pub fn recorded(time: &[f64], readings: &[f64], digit: Option<f64>) -> Self {
        let as_read = Self::given(time, readings);
        match recording::smooth::smoothed(time, readings, digit) {
            Ok(smooth) => {
                let left = (smooth.left, as_read.left.1 * smooth.of);
                Self { values: smooth.values, noise: smooth.noise, left, ..as_read }
            }
            Err(_) => Self { values: recording::condition::bridged(time, readings).unwrap_or_default(), ..as_read },
        }
    }

    /// The same at other instants, on straight lines between its own, constant before the first and after the last; NaN where there is none.
    pub fn at(&self, instants: &[f64]) -> Self {
        let at = |t: &f64| {
            let Some(last) = self.time.len().checked_sub(1) else { return f64::NAN };
            let after = self.time.partition_point(|own| own < t).min(last);
            let before = after.saturating_sub(1);
            let span = self.time[after] - self.time[before];
            let share = if span > 0.0 { ((t - self.time[before]) / span).clamp(0.0, 1.0) } else { 0.0 };
            self.values[before] + share * (self.values[after] - self.values[before])
        };
        Self { time: instants.to_vec(), values: instants.iter().map(at).collect(), noise: self.noise, left: self.left }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_readings_than_rows_leave_less_noise_in_the_rows() {
        let noise = |n: usize, by: usize| ((n * by % 1000) as f64 / 1000.0 - 0.5) * 0.2;
        let course = |t: f64| 20.0 + 0.005 * (t - 6000.0).clamp(0.0, 8000.0);
        let off = |every: usize| {
            let time: Vec<f64> = (0..2000).step_by(every).map(|n| 10.0 * n as f64).collect();
            let rows: Vec<f64> = (0..320).map(|n| 60.0 * f64::from(n)).collect();
            let squares = |by: usize| {
                let readings: Vec<f64> = time.iter().map(|t| course(*t) + noise((t / 10.0) as usize, by)).collect();
                let chamber = Chamber::recorded(&time, &readings, None).at(&rows);
                chamber.values.iter().zip(&rows).map(|(value, t)| (value - course(*t)).powi(2)).sum::<f64>()
            };
            // one noise may happen to leave more or less
            ([7919, 7907, 6619, 9371, 8689, 5281, 4723, 3539].map(squares).iter().sum::<f64>() / (8.0 * 320.0)).sqrt()
        };
        let [all, few] = [off(1), off(6)];
        assert!(all < 0.7 * few && all < 0.02, "{all} K from all readings, {few} K from every sixth");
    }

    #[test]
    fn beyond_its_ends_it_stays() {
        let chamber = Chamber::recorded(&[0.0, 10.0, 20.0], &[5.0, 6.0, 8.0], None);
        assert_eq!(chamber.at(&[-5.0, 0.0, 15.0, 20.0, 99.0]).values, [5.0, 5.0, 7.0, 8.0, 8.0]);
        assert!(Chamber::recorded(&[], &[], None).at(&[1.0]).values[0].is_nan());
    }

    #[test]
    fn between_rare_readings_the_programme_turns_where_its_lines_meet() {
        // ramps of 1 K/min between soaks, read every five minutes, by a chamber that follows at once or within two minutes
        for (lag, at) in
            [(1.0, [6130.0, 20_050.0]), (1.0, [6000.0, 20_100.0]), (120.0, [6130.0, 20_050.0]), (120.0, [6000.0, 20_299.0])]
        {
            let programme = |t: f64| 20.0 + ((t - at[0]).clamp(0.0, 3000.0) - (t - at[1]).clamp(0.0, 3000.0)) / 60.0;
            let mut air = programme(0.0);
            let follow = |t: u32| {
                air += (programme(f64::from(t)) - air) / lag;
                air
            };
            let course: Vec<f64> = (0..32_000).map(follow).collect();
            let rows: Vec<f64> = (0..530).map(|n| 60.0 * f64::from(n)).collect();
            let noise = |n: usize| ((n * 7919 % 1000) as f64 / 1000.0 - 0.5) * 0.03;
            let readings = (0..530).map(|n| if n % 5 == 0 { course[60 * n] + noise(n) } else { f64::NAN }).collect::<Vec<_>>();
            let off = |values: &[f64]| {
                let squares = values.iter().zip(&rows).map(|(value, t)| (value - course[*t as usize]).powi(2));
                (squares.sum::<f64>() / rows.len() as f64).sqrt()
            };
            let recorded = Chamber::recorded(&rows, &readings, Some(0.0));
            let (likely, lines) = (off(&recorded.values), off(&recording::condition::bridged(&rows, &readings).unwrap()));
            // lines happen to have the corners where those fall on a reading
            assert!(likely < 0.6 * lines || likely < 0.05, "{lag}, {at:?}: {likely} K off, {lines} K on lines");
        }
    }
}
