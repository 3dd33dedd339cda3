//! A chamber whose thermometer is neither quick nor slow, and a gyroscope that is quiet enough to tell.

use super::gyro;
use diagnosis::{ForwardModel, Observation};
use mechanisms::{Gyro, Instruments, Prepared};

/// Unit 90 of `cargo xtask prove --composed` in its second programme, a staircase at 2 K/min: chamber, spool, rate. Nothing is concealed.
const RECORD: &str = include_str!("record.csv");
const ROW_S: f64 = 30.0;
/// White noise of thermometer and rate in a row \[K, deg/h\].
const WHITE: [f64; 2] = [0.0104, 0.0034];
/// Variance of the chamber's thermometer, steps of 5 s with a time constant of 29.5 s, and delay with the log's \[s², s\].
const SQUARED: f64 = 868.0;
const DELAY: f64 = 30.9;
/// Factor on k_r.
const K_R: f64 = 1.082;

/// From a thermometer without a lag, and from a lag at another delay, the search ends at another coil, which leaves a structure: a lag's
/// square of −200 s², k_r a third too high. The bounds tell that coil from the right one; the noise that smoothing leaves pulls the lag down by less.
#[test]
fn a_chamber_s_thermometer_of_half_a_minute_is_found() {
    let column = |at: usize| -> Vec<f64> {
        RECORD
            .lines()
            .skip(1)
            .map(|row| row.split(',').nth(at).and_then(|field| field.parse().ok()).unwrap_or(f64::NAN))
            .collect()
    };
    let [time, chamber, spool, rate] = [0, 1, 2, 3].map(column);
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let prepared = Prepared::new(&library, &time, &chamber, ROW_S).expect("prepared");
    let told = Instruments { white: WHITE, ..Instruments::default() };
    let gyro = Gyro::fitted_to(library, &[], vec![prepared], 1, &told).expect("gyro");
    let record = Observation { time, channels: vec![spool, rate] };
    let found = diagnosis::settled(&gyro, &[0], &[record], &|_| ()).expect("a model").recalibrated;
    for (name, truth, within) in [
        ("squared lag of the chamber's thermometer [s2]", SQUARED, 250.0),
        ("delay of the chamber's readings [s]", DELAY, 1.0),
        ("k_r", K_R, 0.12),
    ] {
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a nuisance");
        let value = found.nuisances[0][place];
        assert!((value - truth).abs() < within, "{name}: {value} in place of {truth}");
    }
}
