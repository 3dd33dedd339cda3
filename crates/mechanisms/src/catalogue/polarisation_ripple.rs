//! Two polarisation paths that interfere as their birefringence changes: a bias a sin(2πT/P) + b cos(2πT/P) of the spool's temperature T.

use crate::mechanism::{Change, Described, Offer, Stage, grid};
use crate::series::middles;
use diagnosis::{Parameter, Prior};
use std::f64::consts::TAU;

pub(super) const POLARISATION_RIPPLE: Described = Described {
    id: "unknown:polarisation-ripple",
    title: "A ripple of two polarisation paths",
    stage: Stage::Optics,
    equation: "A bias a sin(2πT/P) + b cos(2πT/P) of the spool's temperature T with a period P of some kelvin.",
    place: "The optics; outside the named library.",
    signature: "The rate waves with the temperature itself, not with its rate: a slow ramp shows several waves.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), ch. 5.",
    offer: |scene| {
        let size = Prior::Normal { mean: 0.0, sd: scene.noise };
        let sizes = [0.5, 0.0, -0.5].map(|x| x * scene.noise);
        let periods: Vec<f64> = (0..PERIODS.1).map(|k| PERIODS.0 * (f64::from(k) / 4.0).exp2()).collect();
        Offer {
            parameters: vec![
                Parameter::new("sine_deg_per_h", size),
                Parameter::new("cosine_deg_per_h", size),
                Parameter::new("period_k", Prior::LogNormal { median: 12.0, spread: 0.8 }).with_step(0.01),
            ],
            choice: None,
            starts: grid(&[&sizes, &sizes, &periods]),
        }
    },
    law: |record, v| {
        let ripple = middles(record.spool(), |t| {
            let (sine, cosine) = (TAU * t / v[2].max(1e-3)).sin_cos();
            v[0] * sine + v[1] * cosine
        });
        Change::of_rate(record, ripple)
    },
    likeness: |v, digits| {
        let (period, amplitude) = (digits(v[2], 3), digits(v[0].hypot(v[1]), 2));
        format!("periodic in the spool's temperature, with a period of {period} K and an amplitude of {amplitude} deg/h")
    },
};

/// The least period from which fits start \[K\], and the number of periods: four per octave.
const PERIODS: (f64, i32) = (2.0, 18);
