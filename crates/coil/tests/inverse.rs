//! The chamber from the thermometer: against the posterior written out in full, and against known chambers.

use crate::common::{QUICK, changed, dynamics, half_minutes, reference};
use coil::{Drive, Dynamics, Error, Fidelity, Heater, Profile, STANDARD, Side, chamber_from_sensor};
use nalgebra::{DMatrix, DVector};

/// Thermometer and total bias under a course of the chamber.
fn run(dynamics: &Dynamics, time: &[f64], chamber: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let profile = Profile { time: time.to_vec(), drives: vec![chamber.to_vec()] };
    dynamics.simulate(&profile).expect("run").iter().map(|row| (row.sensor, row.bias.total())).unzip()
}

/// Deviates of unit variance: sums of twelve uniform ones from a linear congruential generator (Knuth's constants).
fn noise(count: usize) -> Vec<f64> {
    let mut state = 1u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (0..count).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect()
}

/// Rest, up by 30 K at 1 K/min, rest, down by 10 K at 2 K/min, rest; through a controller that lags by three minutes.
fn chamber(t: f64) -> f64 {
    let ramp = |begin: f64| (t - begin).max(0.0) + 180.0 * (-(t - begin).max(0.0) / 180.0).exp_m1();
    20.0 + (ramp(1800.0) - ramp(3600.0)) / 60.0 - (ramp(9000.0) - ramp(9300.0)) / 30.0
}

/// Deviation from `truth` relative to its peak: root mean square and largest.
fn relative(values: &[f64], truth: &[f64]) -> (f64, f64) {
    let peak = truth.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let errors: Vec<f64> = values.iter().zip(truth).map(|(a, b)| (a - b) / peak).collect();
    let squares: f64 = errors.iter().map(|e| e * e).sum();
    ((squares / errors.len() as f64).sqrt(), errors.iter().fold(0.0, |m, e| m.max(e.abs())))
}

/// The same estimate without recursion: the chamber is linear in its first value and the changes of its slope, the thermometer linear in
/// the chamber; both priors and the noise are normal.
#[test]
fn exact_filter_and_smoother_give_the_posterior_written_out_in_full() {
    let (sigma, count) = (0.02, 60);
    let time: Vec<f64> = (0..count).map(|k| 1e9 + 60.0 * k as f64 + 25.0 * (k as f64).sin()).collect();
    for lag in [0.0, 200.0] {
        // few enough modes for the filter to hold them all
        let design = changed(|d| d.sensor.lag = lag);
        let dynamics = Dynamics::new(&design, &[Drive::Chamber], &Fidelity { modes: 12, ..QUICK }).expect("model");
        let truth: Vec<f64> = time.iter().map(|t| 5.0 * ((t - time[0]) / 600.0).sin()).collect();
        let readings: Vec<f64> = run(&dynamics, &time, &truth).0.iter().zip(noise(count)).map(|(s, e)| s + sigma * e).collect();
        let inferred = chamber_from_sensor(&dynamics, &time, &readings, sigma).expect("inferred");
        let column = |j: usize| -> Vec<f64> {
            let grown = |k: usize| match j {
                0 => 1.0,
                _ if k < j => 0.0,
                _ => time[k] - time[j - 1],
            };
            (0..count).map(grown).collect()
        };
        let columns: Vec<Vec<f64>> = (0..count).map(column).collect();
        let to_chamber = DMatrix::from_fn(count, count, |k, j| columns[j][k]);
        let seen: Vec<Vec<f64>> = columns.iter().map(|c| run(&dynamics, &time, c).0).collect();
        let to_sensor = DMatrix::from_fn(count, count, |k, j| seen[j][k]);
        let offset = DVector::from_element(count, readings[0]);
        let innovation = DVector::from_vec(readings.clone()) - &offset;
        let prior = |roughness: f64| {
            let variance = |j: usize| {
                if j == 0 { (100.0 * sigma).powi(2) } else { roughness.powi(2) * (time[j] - time[j - 1]) }
            };
            DMatrix::from_diagonal(&DVector::from_fn(count, |j, _| variance(j)))
        };
        let of_readings = |roughness: f64| {
            &to_sensor * prior(roughness) * to_sensor.transpose() + DMatrix::identity(count, count) * sigma * sigma
        };
        let factor = of_readings(inferred.roughness).cholesky().expect("positive definite");
        let cross = &to_chamber * prior(inferred.roughness) * to_sensor.transpose();
        let mean = offset + &cross * factor.solve(&innovation);
        let covariance =
            &to_chamber * prior(inferred.roughness) * to_chamber.transpose() - &cross * factor.solve(&cross.transpose());
        for k in 0..count {
            let sd = covariance[(k, k)].sqrt();
            let error = (inferred.chamber[k] - mean[k]).abs();
            assert!(error < 1e-6 * sd, "lag {lag}, row {k}: {} against {}, sd {sd}", inferred.chamber[k], mean[k]);
            assert!((inferred.chamber_sd[k] / sd - 1.0).abs() < 1e-6, "{} against {sd}", inferred.chamber_sd[k]);
        }
        let likelihood = |roughness: f64| {
            let factor = of_readings(roughness).cholesky().expect("positive definite");
            let log_determinant: f64 = factor.l().diagonal().iter().map(|d| 2.0 * d.ln()).sum();
            -0.5 * (log_determinant + innovation.dot(&factor.solve(&innovation)))
        };
        let best = likelihood(inferred.roughness);
        for neighbour in [-1.0, -0.25, 0.25, 1.0] {
            assert!(likelihood(inferred.roughness * 10f64.powf(neighbour)) < best, "lag {lag}: not the most likely");
        }
    }
}

#[test]
fn bounds_the_bias_of_the_inferred_chamber_is_that_of_the_true_one() {
    let dynamics = Dynamics::new(&reference(), &[Drive::Chamber], &STANDARD).expect("model");
    let time = half_minutes(600);
    let truth: Vec<f64> = time.iter().map(|t| chamber(*t)).collect();
    let (sensor, bias) = run(&dynamics, &time, &truth);
    let deviates = noise(time.len());
    // without noise what is left is what the prior smooths; with it, what the thermometer cannot tell
    for (sigma, assumed, rms, largest) in [(0.0, 1e-4, 2e-3, 2e-2), (0.01, 0.01, 6e-3, 4e-2)] {
        let readings: Vec<f64> = sensor.iter().zip(&deviates).map(|(s, e)| s + sigma * e).collect();
        let inferred = chamber_from_sensor(&dynamics, &time, &readings, assumed).expect("inferred");
        let (off, most) = relative(&run(&dynamics, &time, &inferred.chamber).1, &bias);
        assert!(off < rms && most < largest, "noise {sigma} K: rms {off:.2e}, largest {most:.2e} of the peak");
        assert!(inferred.sensor_residual_rms < 1.1 * assumed, "{}", inferred.sensor_residual_rms);
        if sigma > 0.0 {
            assert!(inferred.sensor_residual_rms > 0.8 * sigma, "the noise is followed: {}", inferred.sensor_residual_rms);
            // the error's ratio to its standard deviation has unit variance
            let ratios = inferred.chamber.iter().zip(&truth).zip(&inferred.chamber_sd).map(|((a, b), sd)| ((a - b) / sd).powi(2));
            let spread = (ratios.sum::<f64>() / time.len() as f64).sqrt();
            assert!((0.5..1.5).contains(&spread), "standard deviations off by {spread}");
        }
    }
}

#[test]
fn exact_heaters_are_taken_off_and_an_offset_of_the_thermometer_shifts_the_chamber_alone() {
    let design = changed(|d| d.heat.heaters.push(Heater { side: Side::Right, power: 0.5 }));
    let dynamics = dynamics(&design, &[Drive::Chamber, Drive::Heaters]);
    let time = half_minutes(300);
    let profile = Profile { time: time.clone(), drives: vec![vec![20.0; 300], vec![1.0; 300]] };
    let readings: Vec<f64> = dynamics.simulate(&profile).expect("run").iter().map(|row| row.sensor).collect();
    assert!(readings[299] > 25.0, "the heater matters");
    for offset in [0.0, 3.0] {
        let shifted: Vec<f64> = readings.iter().map(|r| r + offset).collect();
        let inferred = chamber_from_sensor(&dynamics, &time, &shifted, 1e-3).expect("inferred");
        assert!(inferred.chamber.iter().all(|c| (c - 20.0 - offset).abs() < 1e-6), "{:?}", &inferred.chamber[..3]);
        assert!(inferred.sensor_residual_rms < 1e-6, "{} K", inferred.sensor_residual_rms);
    }
}

#[test]
fn bounds_many_rows_and_gaps_are_no_trouble() {
    let dynamics = dynamics(&reference(), &[Drive::Chamber]);
    // a second apart for a day, with ten minutes missing
    let time: Vec<f64> = (0..86_400).map(f64::from).filter(|t| !(40_000.0..40_600.0).contains(t)).collect();
    let truth: Vec<f64> = time.iter().map(|t| 20.0 - 30.0 * ((t / 4000.0).cos() - 1.0)).collect();
    let (sensor, bias) = run(&dynamics, &time, &truth);
    let start = std::time::Instant::now();
    let inferred = chamber_from_sensor(&dynamics, &time, &sensor, 0.01).expect("inferred");
    assert!(start.elapsed().as_secs() < 60, "{:?}", start.elapsed());
    let (off, most) = relative(&run(&dynamics, &time, &inferred.chamber).1, &bias);
    assert!(off < 3e-3 && most < 4e-2, "rms {off:.2e}, largest {most:.2e} of the peak");
}

#[test]
fn bounds_records_that_cannot_be_inverted_are_refused() {
    let plain = dynamics(&reference(), &[Drive::Chamber]);
    let walls = dynamics(&reference(), &[Drive::Chamber, Drive::EndWall(Side::Left)]);
    let (time, still): (Vec<f64>, Vec<f64>) = (0..20).map(|k| (30.0 * f64::from(k), 20.0)).unzip();
    let refused = |d: &Dynamics, time: &[f64], sensor: &[f64], noise: f64| match chamber_from_sensor(d, time, sensor, noise) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("accepted"),
    };
    assert!(refused(&plain, &time[..5], &still[..5], 0.01).contains("5 rows are too few"));
    assert!(refused(&plain, &[], &[], 0.01).contains("at least one"));
    assert!(refused(&plain, &time, &still[..19], 0.01).contains("20 instants"));
    assert!(refused(&plain, &time, &[vec![f64::NAN], still[1..].to_vec()].concat(), 0.01).contains("instant 0"));
    assert!(refused(&plain, &[&time[..19], &[0.0]].concat(), &still, 0.01).contains("instant 19"));
    for noise in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(&plain, &time, &still, noise).contains("noise"));
    }
    assert!(matches!(chamber_from_sensor(&walls, &time, &still, 0.01), Err(Error::Record(_))));
    let rest = chamber_from_sensor(&plain, &time, &still, 0.01).expect("a record of a rest");
    assert!(rest.chamber.iter().all(|c| (c - 20.0).abs() < 1e-9));
}
