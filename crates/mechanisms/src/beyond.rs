//! Mechanisms beyond the named library: each acts at its place, but its verdict stays `unknown`.
//!
//! | id | equation |
//! |---|---|
//! | `unknown:polarisation-ripple` | bias a sin(2πT/P) + b cos(2πT/P) of the spool's temperature T: two polarisation paths that interfere as their birefringence changes (Lefèvre, *The Fiber-Optic Gyroscope*, 2014, ch. 5) |
//! | `unknown:moisture` | bias a exp(−t/τ): the adhesive gives off or takes up water at a rate that decays as in diffusion (Crank, *The Mathematics of Diffusion*, 1975) |
//! | `unknown:ratcheting` | bias ∝ d/dt of the hottest and of the coldest temperature so far: what sets for good the first time a temperature is reached |
//! | `unknown:spool-expansion` | spool's expansion α (1 + b (T − 20 °C)), as that of metals is |
//! | `unknown:racket` | all of the bias times 1 + b (T − 20 °C): a sensitivity that depends on temperature |
//! | `unknown:magnetic` | bias ∝ rate of the chamber: the Faraday effect of its heaters' and coolers' stray field (Lefèvre, ch. 7) |

use crate::REFERENCE_C;
use crate::catalogue::{Law, about, grid, normal};
use crate::laws::Change;
use crate::record::{Parts, Prepared};
use diagnosis::{Mechanism, Parameter};
use std::f64::consts::TAU;

/// Ripples' periods from which fits start \[K\]: four per octave.
const PERIODS: (f64, i32) = (2.0, 18);
/// Seconds in an hour.
const HOUR: f64 = 3600.0;

/// The entries, each with its law.
pub(crate) fn entries() -> Vec<(Law, Mechanism)> {
    let entry = |law: Law, id: &str, stage: &str, parameters: Vec<Parameter>, starts: Vec<Vec<f64>>| {
        let id = format!("unknown:{id}");
        (law, Mechanism { id, stage: stage.to_owned(), parameters, choice: None, starts, named: false, weight: 1.0 })
    };
    let bias = |name: &str, size: f64| Parameter::new(name, normal(size));
    let periods: Vec<f64> = (0..PERIODS.1).map(|k| PERIODS.0 * (f64::from(k) / 4.0).exp2()).collect();
    vec![
        entry(
            Law::Ripple,
            "polarisation-ripple",
            "optics",
            vec![
                bias("sine_deg_per_h", 8e-3),
                bias("cosine_deg_per_h", 8e-3),
                Parameter::new("period_k", about(12.0, 0.8)).with_step(0.01),
            ],
            grid(&[&[4e-3, 0.0, -4e-3], &[4e-3, 0.0, -4e-3], &periods]),
        ),
        entry(
            Law::Moisture,
            "moisture",
            "material",
            vec![bias("rate_deg_per_h", 0.02), Parameter::new("time_s", about(6.0 * HOUR, 0.7))],
            grid(&[&[0.0], &[2.0 * HOUR, 8.0 * HOUR]]),
        ),
        entry(
            Law::Ratchet,
            "ratcheting",
            "bond",
            vec![bias("hot_deg_per_h_per_k_per_h", 2e-3), bias("cold_deg_per_h_per_k_per_h", 2e-3)],
            vec![vec![0.0, 0.0]],
        ),
        entry(
            Law::SpoolExpansion,
            "spool-expansion",
            "material",
            vec![Parameter::new("expansion_per_k2_relative", normal(1e-3))],
            vec![vec![0.0]],
        ),
        entry(Law::Racket, "racket", "material", vec![Parameter::new("relative_per_k", normal(1e-3))], vec![vec![0.0]]),
        entry(Law::Magnetic, "magnetic", "optics", vec![bias("deg_per_h_per_k_per_h", 5e-4)], vec![vec![0.0]]),
    ]
}

/// Mean of a function over the interval that ends at each row, from its values at the ends.
fn middles(series: &[f64], of: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..series.len()).map(|n| (of(series[n]) + of(series[n.saturating_sub(1)])) / 2.0).collect()
}

/// Rate of a series since the row before \[per hour\].
fn rates(time: &[f64], series: &[f64]) -> Vec<f64> {
    let rate = |n: usize| if n > 0 { (series[n] - series[n - 1]) / (time[n] - time[n - 1]) * HOUR } else { 0.0 };
    (0..time.len()).map(rate).collect()
}

/// What the mechanism changes; `expansion` holds the parts per relative change of the spool's expansion.
pub(crate) fn change(record: &Prepared, law: Law, v: &[f64]) -> Change {
    let spool = &record.nominal.sensor;
    let added = |rate: Vec<f64>| Change { rate: Some(rate), ..Change::none(record) };
    let scaled = |parts: &Parts, slope: f64| {
        let factor = middles(spool, |t| slope * (t - REFERENCE_C));
        let parts = [0, 1, 2].map(|p: usize| parts[p].iter().zip(&factor).map(|(x, f)| x * f).collect());
        Change { parts, ..Change::none(record) }
    };
    match law {
        Law::Ripple => added(middles(spool, |t| {
            let (sine, cosine) = (TAU * t / v[2].max(1e-3)).sin_cos();
            v[0] * sine + v[1] * cosine
        })),
        Law::Moisture => {
            let start = record.time.first().copied().unwrap_or(0.0);
            added(record.time.iter().map(|t| v[0] * (-(t - start) / v[1]).exp()).collect())
        }
        Law::Ratchet => {
            let so_far = |better: fn(f64, f64) -> f64| -> Vec<f64> {
                let mut extreme = record.coil[0];
                let reached = record.coil.iter().map(|t| {
                    extreme = better(extreme, *t);
                    extreme
                });
                rates(&record.time, &reached.collect::<Vec<_>>())
            };
            let (hot, cold) = (so_far(f64::max), so_far(f64::min));
            added(hot.iter().zip(&cold).map(|(h, c)| v[0] * h + v[1] * c).collect())
        }
        Law::SpoolExpansion => record.constants.last().map_or_else(|| Change::none(record), |parts| scaled(parts, v[0])),
        Law::Racket => scaled(&record.nominal.parts, v[0]),
        Law::Magnetic => added(rates(&record.time, &record.chamber).iter().map(|r| v[0] * r).collect()),
        _ => Change::none(record),
    }
}
