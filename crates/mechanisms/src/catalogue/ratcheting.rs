//! A change that sets for good the first time that a temperature is reached.

use crate::mechanism::{Change, Described, Offer, Stage};
use crate::series::rates_per_hour;
use diagnosis::{Parameter, Prior};

pub(super) const RATCHETING: Described = Described {
    id: "unknown:ratcheting",
    title: "What sets for good when a temperature is first reached",
    stage: Stage::Bond,
    equation: "A bias proportional to the rate of the hottest, and of the coldest, temperature so far.",
    place: "The bond; outside the named library.",
    signature: "The first cycle differs from all later ones.",
    source: "An empirical description; no source.",
    offer: |scene| {
        let sd = 0.25 * scene.noise;
        let names = ["hot_deg_per_h_per_k_per_h", "cold_deg_per_h_per_k_per_h"];
        let parameters = names.map(|name| Parameter::new(name, Prior::Normal { mean: 0.0, sd })).into();
        Offer { parameters, choice: None, starts: vec![vec![0.0, 0.0]] }
    },
    law: |record, v| {
        let so_far = |better: fn(f64, f64) -> f64| -> Vec<f64> {
            let mut extreme = record.coil[0];
            let reached = record.coil.iter().map(|t| {
                extreme = better(extreme, *t);
                extreme
            });
            rates_per_hour(&record.time, &reached.collect::<Vec<_>>())
        };
        let (hot, cold) = (so_far(f64::max), so_far(f64::min));
        Change::of_rate(record, hot.iter().zip(&cold).map(|(h, c)| v[0] * h + v[1] * c).collect())
    },
    likeness: |_, _| "present where a temperature is reached for the first time".into(),
};
