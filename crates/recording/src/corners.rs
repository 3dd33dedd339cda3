//! Corners that runs of missing values hide.

use std::ops::Range;

use crate::condition::mean;

/// Values beside a run of missing ones through which a line is laid: enough that their noise hardly turns it, few enough that a ramp is straight over them.
const BESIDE: usize = 10;

/// Of every run of missing values between two that are there its steps, from the value before to the value behind, and the instant at which the lines
/// through the values before and behind meet: not finite where they do not, or where a line has one value.
pub(crate) fn corners(time: &[f64], values: &[f64]) -> Vec<(Range<usize>, f64)> {
    let there: Vec<usize> = (0..values.len()).filter(|n| !values[*n].is_nan()).collect();
    let line = |rows: &[usize]| {
        let [t, x] = [time, values].map(|of| rows.iter().map(|n| of[*n]).collect::<Vec<_>>());
        let (at, level) = (mean(&t), mean(&x));
        let squares: f64 = t.iter().map(|t| (t - at).powi(2)).sum();
        let slope = t.iter().zip(&x).map(|(t, x)| (t - at) * (x - level)).sum::<f64>() / squares;
        (slope, level - slope * at)
    };
    let of = |n: usize| {
        let [(a, from), (b, to)] =
            [&there[(n + 1).saturating_sub(BESIDE)..=n], &there[n + 1..there.len().min(n + 1 + BESIDE)]].map(line);
        (there[n]..there[n + 1], (to - from) / (a - b))
    };
    (0..there.len().saturating_sub(1)).filter(|n| there[n + 1] - there[*n] > 1).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::corners;

    #[test]
    fn exact_lines_meet_where_they_do() {
        let time: Vec<f64> = (0..60).map(f64::from).collect();
        let course = |t: f64| 5.0 + 2.0 * t.min(27.5);
        let missing = [0, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30, 45, 59];
        let values: Vec<f64> = (0..60).map(|n| if missing.contains(&n) { f64::NAN } else { course(time[n]) }).collect();
        let [(turn, at), (even, nowhere)] = &corners(&time, &values)[..] else { panic!("two runs between values") };
        assert_eq!((turn.clone(), even.clone()), (19..31, 44..46));
        assert!((at - 27.5).abs() < 1e-9 && !nowhere.is_finite(), "{at} {nowhere}");
        assert!(corners(&time, &[f64::NAN; 60]).is_empty() && corners(&[], &[]).is_empty());
        // one value is no line
        assert!(corners(&[0.0, 1.0, 2.0], &[1.0, f64::NAN, 3.0])[0].1.is_nan());
    }

    /// Ten values on either side, beyond which the course turns.
    #[test]
    fn exact_ten_values_on_either_side_make_the_lines() {
        let time: Vec<f64> = (0..60).map(f64::from).collect();
        let course = |t: f64| if (14.0..=44.0).contains(&t) { 5.0 + 2.0 * t.min(27.5) } else { 300.0 - t * t };
        let value = |t: &f64| if (24.0..35.0).contains(t) { f64::NAN } else { course(*t) };
        let found = corners(&time, &time.iter().map(value).collect::<Vec<_>>());
        assert!(found.len() == 1 && (found[0].1 - 27.5).abs() < 1e-9, "{found:?}");
    }

    /// A clock that counts from 1970, temperatures in kelvin.
    #[test]
    fn exact_lines_meet_wherever_time_begins() {
        let time: Vec<f64> = (0..40).map(|n| 1e9 + f64::from(n)).collect();
        let value = |n: u32| if (15..25).contains(&n) { f64::NAN } else { 293.37 + 0.171 * (f64::from(n)).min(19.5) };
        let found = corners(&time, &(0..40).map(value).collect::<Vec<_>>());
        assert!(found.len() == 1 && (found[0].1 - 1e9 - 19.5).abs() < 1e-5, "{found:?}");
    }

    /// A value that is off turns the line if it is among the ten beside the missing ones.
    #[test]
    fn exact_the_tenth_value_on_either_side_counts() {
        let time: Vec<f64> = (0..40).map(f64::from).collect();
        let meet = |off: Option<u32>| {
            let course = |n: u32| f64::from(n).min(19.5) + if off == Some(n) { 1.0 } else { 0.0 };
            let values: Vec<f64> = (0..40).map(|n| if (15..25).contains(&n) { f64::NAN } else { course(n) }).collect();
            corners(&time, &values)[0].1
        };
        let is_turned = |row: u32| (meet(Some(row)) - meet(None)).abs() > 0.1;
        assert_eq!([4, 5, 34, 35].map(is_turned), [false, true, true, false]);
    }
}
