//! What is a lone value, and what a course.

use crate::check::{ROWS, sound};

/// A response of a few rows at the onset of a ramp, of any size and wherever between rows it begins; beside it a bad value that a logger repeats.
#[test]
fn the_onset_of_a_response_is_no_outlier() {
    for seed in 0..300 {
        let mut sample = sound(seed, 0.01);
        let size = 0.02 * [15.0, 25.0, 40.0, 100.0][seed as usize % 4];
        let rise = [10.0, 25.0, 45.0][seed as usize % 3];
        let onset = 6000.0 + 30.0 * (seed % 10) as f64 / 10.0;
        let response = |t: f64| size * (1.0 - (-(t - onset).max(0.0) / rise).exp()) * (-(t - onset).max(0.0) / 900.0).exp();
        sample.time.iter().zip(&mut sample.rate).for_each(|(t, rate)| *rate += response(*t));
        let bad = [[500, 501], [700, 702]];
        bad.iter().for_each(|[first, last]| (*first..=*last).for_each(|row| sample.rate[row] += 1.0));
        let report = sample.report();
        let masked: Vec<usize> = (0..ROWS).filter(|&row| !report.masks[1][row]).collect();
        assert_eq!(masked, [500, 501, 700, 701, 702], "seed {seed}");
    }
}

/// Beside a gap a value has neighbours on one side alone, as at an end.
#[test]
fn a_lone_value_beside_a_gap_is_one_and_a_step_there_is_none() {
    let gaps = [300..312, 900..903, 1500..1600];
    let without = |mut sample: crate::check::Sample, change: &dyn Fn(usize) -> f64| {
        (0..ROWS).for_each(|row| sample.rate[row] += change(row));
        let kept: Vec<usize> = (0..ROWS).filter(|row| !gaps.iter().any(|gap| gap.contains(row))).collect();
        for series in [&mut sample.time, &mut sample.temperature, &mut sample.rate] {
            *series = kept.iter().map(|&row| series[row]).collect();
        }
        let report = sample.report();
        let masked = kept.iter().zip(&report.masks[1]).filter(|(_, used)| !**used);
        (masked.map(|(row, _)| *row).collect::<Vec<_>>(), report.usable())
    };
    for seed in 0..50 {
        // the last before a gap, the last but one, the first behind one, the second
        let bad = [299, 898, 903, 1601];
        let size = |row: usize| if bad.contains(&row) { 1.0 } else { 0.0 };
        let (masked, usable) = without(sound(seed, 0.01), &size);
        assert!(usable && masked == bad, "seed {seed}: {masked:?}");
        // what goes on from there, and what two rows beside the gap have
        let step = |row: usize| if row >= 1498 { 1.0 } else { 0.0 };
        assert_eq!(without(sound(seed, 0.01), &step).0, [0_usize; 0], "seed {seed}");
    }
}
