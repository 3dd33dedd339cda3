//! The truth file of a unit: what [`crate::truth`] reads, and what a reader wants beside it.

use super::noise::Noise;
use crate::Failure;
use crate::truth::{Mechanism, Sizes, Strength};
use serde::Serialize;

#[derive(Serialize)]
pub(super) struct Sheet {
    pub(super) mechanisms: Vec<Mechanism>,
    pub(super) snr: Vec<Strength>,
    pub(super) confusable_sets: Vec<Vec<String>>,
    pub(super) noise: Wandering,
    pub(super) spool_sensor: SpoolSensor,
    pub(super) noise_free_rms_deg_per_h: Sizes,
    /// Of the record that is fitted, of the one that judges.
    pub(super) profiles: [String; 2],
}

/// The gyro's noise, with the family that the identification does not know.
#[derive(Serialize)]
pub(super) struct Wandering {
    arw_deg_per_sqrt_h: f64,
    gm_sigma_deg_per_h: f64,
    gm_tau_s: f64,
    rrw_deg_per_h_per_sqrt_h: f64,
    offset_deg_per_h: f64,
    unseen: Option<String>,
}

/// The spool's thermometer \[K\].
#[derive(Serialize)]
pub(super) struct SpoolSensor {
    pub(super) noise_c: f64,
    pub(super) quantisation_c: f64,
    pub(super) offset_c: f64,
}

impl Wandering {
    pub(super) fn new(noise: &Noise) -> Self {
        Self {
            arw_deg_per_sqrt_h: noise.arw,
            gm_sigma_deg_per_h: noise.drift.0,
            gm_tau_s: noise.drift.1,
            rrw_deg_per_h_per_sqrt_h: noise.walk,
            offset_deg_per_h: noise.offset,
            unseen: noise.unseen.map(|unseen| unseen.label()),
        }
    }
}

impl Sheet {
    pub(super) fn write(&self) -> Result<String, Failure> {
        Ok(ron::ser::to_string_pretty(self, ron::ser::PrettyConfig::default())? + "\n")
    }
}
