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
