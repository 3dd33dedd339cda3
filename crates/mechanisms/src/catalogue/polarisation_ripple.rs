//! Two polarisation paths that interfere as their birefringence changes: a bias a sin(2πT/P) + b cos(2πT/P) of the spool's temperature T.

use crate::mechanism::{Change, Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Stage};
use crate::mechanism::{grid, middles};
use crate::{Chain, Prepared};
use coil::{Design, Error};
use diagnosis::{Active, Parameter, Prior};
use std::f64::consts::TAU;

pub(crate) const ID: &str = "unknown:polarisation-ripple";

pub(super) struct PolarisationRipple;

impl Mechanism for PolarisationRipple {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "A ripple of two polarisation paths",
            stage: Stage::Optics,
            equation: "A bias a sin(2πT/P) + b cos(2πT/P) of the spool's temperature T with a period P of some kelvin.",
            place: "The optics; outside the named library.",
            signature: "The rate waves with the temperature itself, not with its rate: a slow ramp shows several waves.",
            source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), ch. 5.",
            naming: Naming::Described { likeness },
            heat_path: None,
            steady: Vec::new(),
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        let size = Prior::Normal { mean: 0.0, sd: 8e-3 };
        let periods: Vec<f64> = (0..PERIODS.1).map(|k| PERIODS.0 * (f64::from(k) / 4.0).exp2()).collect();
        Some(Offer {
            parameters: vec![
                Parameter::new("sine_deg_per_h", size),
                Parameter::new("cosine_deg_per_h", size),
                Parameter::new("period_k", Prior::LogNormal { median: 12.0, spread: 0.8 }).with_step(0.01),
            ],
            choice: None,
            starts: grid(&[&[4e-3, 0.0, -4e-3], &[4e-3, 0.0, -4e-3], &periods]),
        })
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        let v = &active.values;
        let ripple = middles(record.spool(), |t| {
            let (sine, cosine) = (TAU * t / v[2].max(1e-3)).sin_cos();
            v[0] * sine + v[1] * cosine
        });
        Ok(Effect::Coil(Change::of_rate(record, ripple)))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }
}

fn likeness(v: &[f64], digits: Digits) -> String {
    format!(
        "periodic in the spool's temperature, with a period of {} K and an amplitude of {} deg/h",
        digits(v[2], 3),
        digits(v[0].hypot(v[1]), 2)
    )
}

/// The least period from which fits start \[K\], and the number of periods: four per octave.
const PERIODS: (f64, i32) = (2.0, 18);
