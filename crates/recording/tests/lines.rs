//! Lines in noise, and noise without one.

use recording::lines::{has_line, strongest};

/// Normal numbers: xorshift64* and Box–Muller.
fn normals(seed: u64) -> impl FnMut() -> f64 {
    let mut state = 0x9e37_79b9_7f4a_7c15 ^ (seed + 1).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mut uniform = move || {
        state ^= state >> 12;
        state ^= state << 25;
        state ^= state >> 27;
        (state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 11) as f64 / (1_u64 << 53) as f64
    };
    move || (-2.0 * (1.0 - uniform()).ln()).sqrt() * (std::f64::consts::TAU * uniform()).cos()
}

/// Of any length, interval and origin of time, with rows that are missing: period and amplitude to their errors, and the line at every instant.
#[test]
fn a_line_is_found_with_its_period_and_amplitude() {
    for (seed, (rows, interval, start, period)) in
        [(300, 30.0, 0.0, 97.0), (4000, 1.0, 1.7e9, 4.76), (30_000, 0.01, -5.0, 0.0213), (2500, 20.0, 0.0, 1800.0)]
            .into_iter()
            .enumerate()
    {
        let mut normal = normals(seed as u64);
        let there = |n: usize| !(rows / 3..rows / 2).contains(&n) || n.is_multiple_of(3);
        let time: Vec<f64> = (0..rows).filter(|n| there(*n)).map(|n| start + interval * n as f64).collect();
        let line = |t: f64| 1.5 * (std::f64::consts::TAU * (t - start) / period + 0.7).sin();
        let mut values: Vec<f64> = time.iter().map(|t| 3.0 + line(*t) + normal()).collect();
        values[17] = f64::NAN;
        let found = strongest(&time, &values, &values).expect("a line");
        let span = interval * rows as f64;
        // frequency and amplitude are known to √6/π /(span A √n) and √2/√n of the noise, in Hann's window to some more
        let error = 1.0 / (time.len() as f64).sqrt();
        assert!((1.0 / found.period - 1.0 / period).abs() < 4.0 * error / span, "{found:?} of {period}");
        assert!((found.amplitude() - 1.5).abs() < 7.0 * error, "{found:?}");
        let off = time.iter().map(|t| (found.at(*t) - line(*t)).abs()).fold(0.0, f64::max);
        assert!(off < 20.0 * error, "{off}");
        // nothing is left
        let rest: Vec<f64> = time.iter().zip(&values).map(|(t, value)| value - found.at(*t)).collect();
        assert_eq!(strongest(&time, &rest, &rest), None);
    }
}

/// White noise, outliers, a few cycles of a course, a sudden step: none is a line.
#[test]
fn noise_and_courses_have_no_line() {
    for seed in 0..100 {
        let mut normal = normals(seed);
        let time: Vec<f64> = (0..1000 + 37 * seed).map(|n| 10.0 * n as f64).collect();
        let length = time[time.len() - 1];
        let value = |t: &f64| {
            let other = match seed % 4 {
                0 => 0.0,
                1 => 0.05 * normal().powi(3),
                2 => (14.0 * std::f64::consts::TAU * t / length).sin(),
                _ => f64::from(u8::from(*t > length / 3.0)),
            };
            normal() + other
        };
        let values: Vec<f64> = time.iter().map(value).collect();
        assert_eq!(strongest(&time, &values, &values), None, "{seed}");
    }
    assert_eq!(strongest(&[0.0, 1.0], &[1.0, 2.0], &[1.0, 2.0]), None);
    assert_eq!(strongest(&[], &[], &[]), None);
}

/// A ramp beside which a controller swings, and the same without.
#[test]
fn a_course_has_the_line_that_its_controller_makes() {
    let mut normal = normals(1);
    let time: Vec<f64> = (0..2000).map(|n| 30.0 * f64::from(n)).collect();
    let mut course = |swing: f64| -> Vec<f64> {
        let at = |t: &f64| 20.0 + (t / 600.0).min(40.0) + swing * (std::f64::consts::TAU * t / 600.0).sin() + 0.01 * normal();
        time.iter().map(at).collect()
    };
    let (with, without) = (course(0.05), course(0.0));
    assert!(has_line(&time, &with, 600.0) && has_line(&time, &with, 300.0));
    assert!(!has_line(&time, &without, 600.0) && !has_line(&time, &with, 433.0));
}

/// Noise of one standard deviation and rows 1 s apart, of a given number, beside sinusoids of some cycles each: amplitude, cycles, phase.
fn series(rows: u32, waves: &[(f64, f64, f64)], normal: &mut impl FnMut() -> f64) -> (Vec<f64>, Vec<f64>) {
    let time: Vec<f64> = (0..rows).map(f64::from).collect();
    let length = f64::from(rows - 1);
    let wave =
        |t: f64, (size, cycles, phase): (f64, f64, f64)| size * (std::f64::consts::TAU * cycles * t / length + phase).sin();
    let values = time.iter().map(|t| waves.iter().map(|one| wave(*t, *one)).sum::<f64>() + normal()).collect();
    (time, values)
}

/// Twenty cycles and the half frequency of the rows, but for the steps that a line fills, are the ends.
#[test]
fn a_line_is_found_between_the_ends_of_the_band() {
    let mut normal = normals(5);
    for rows in [700, 1024, 1025] {
        for (cycles, is_found) in [(17.0, false), (21.5, true), (0.5 * f64::from(rows) - 7.0, true)] {
            let (time, values) = series(rows, &[(1.5, cycles, 0.7)], &mut normal);
            let found = strongest(&time, &values, &values);
            assert_eq!(found.is_some(), is_found, "{rows} {cycles}: {found:?}");
            let off = |line: recording::lines::Line| (time[time.len() - 1] / line.period - cycles).abs();
            assert!(found.is_none_or(|line| off(line) < 0.1), "{rows} {cycles}: {found:?}");
        }
    }
}

/// A line far above the noise hides none a tenth of its size beside it: the stronger is found first, the other when that is taken off, and then none.
#[test]
fn of_two_lines_the_stronger_is_found_first() {
    let waves = [(20.0, 100.4, 0.3), (2.0, 112.5, 1.9)];
    let (time, mut values) = series(1000, &waves, &mut normals(6));
    for (amplitude, cycles, _) in waves {
        let line = strongest(&time, &values, &values).expect("a line");
        assert!((999.0 / line.period - cycles).abs() < 0.1 && (line.amplitude() - amplitude).abs() < 0.3, "{line:?}");
        time.iter().zip(&mut values).for_each(|(t, value)| *value -= line.at(*t));
        // what is left of it in any part of the rows is noise
        for rows in [0..400, 300..700, 960..1000] {
            let [time, values] = [&time, &values].map(|series| &series[rows.clone()]);
            let left = line.left(time.iter().zip(values)).expect("an amplitude");
            let beside = if amplitude > 10.0 { 2.5 } else { 0.0 };
            assert!(left < beside + 5.0 / (time.len() as f64).sqrt(), "{rows:?}: {left}");
        }
    }
    assert_eq!(strongest(&time, &values, &values), None);
}

#[test]
fn exact_a_line_does_not_depend_on_units() {
    let (time, values) = series(600, &[(1.0, 77.7, 0.2)], &mut normals(7));
    let scaled = |series: &[f64], by: f64| series.iter().map(|value| by * value).collect::<Vec<_>>();
    let line = strongest(&time, &values, &values).expect("a line");
    let (later, smaller) = (scaled(&time, 64.0), scaled(&values, 0.25));
    let other = strongest(&later, &smaller, &smaller).expect("a line");
    let ratios = [other.period / line.period / 64.0, other.amplitude() / line.amplitude() / 0.25];
    assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 1e-12), "{ratios:?}");
    assert!(time.iter().zip(&later).all(|(t, later)| (other.at(*later) - 0.25 * line.at(*t)).abs() < 1e-9));
    // what the line is sought in need not be what tells its amplitude
    let sought = strongest(&time, &smaller, &values).expect("a line");
    assert!(sought.period == line.period && (sought.amplitude() / other.amplitude() - 1.0).abs() < 1e-12, "{sought:?}");
}

#[test]
fn what_stands_still_has_no_line() {
    let time: Vec<f64> = (0..400).map(f64::from).collect();
    for value in [0.0, 4.0, -0.5, f64::NAN] {
        let values = vec![value; 400];
        assert_eq!(strongest(&time, &values, &values), None, "{value}");
        assert!(!has_line(&time, &values, 10.0));
    }
}

/// A ramp through nothing in a part of the rows leaks into all of the spectrum of the values, of sums and of ratios of neighbours.
#[test]
fn a_steep_course_hides_no_line() {
    let (time, values) = series(2000, &[(2.0, 75.0, 0.4)], &mut normals(8));
    let course = |t: f64| 5.0 * (t - 1000.0).clamp(-100.0, 100.0);
    let values: Vec<f64> = time.iter().zip(&values).map(|(t, value)| value + course(*t)).collect();
    assert!(has_line(&time, &values, 1999.0 / 75.0) && !has_line(&time, &values, 1999.0 / 131.0));
}
