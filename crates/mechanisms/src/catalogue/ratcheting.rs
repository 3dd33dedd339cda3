//! What sets for good the first time a temperature is reached.

use crate::mechanism::rates_per_hour;
use crate::mechanism::{Change, Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Stage};
use crate::{Chain, Prepared};
use coil::{Design, Error};
use diagnosis::{Active, Parameter, Prior};

pub(crate) const ID: &str = "unknown:ratcheting";

pub(super) struct Ratcheting;

impl Mechanism for Ratcheting {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "What sets for good when a temperature is first reached",
            stage: Stage::Bond,
            equation: "A bias proportional to the rate of the hottest, and of the coldest, temperature so far.",
            place: "The bond; outside the named library.",
            signature: "The first cycle differs from all later ones.",
            source: "An empirical description; no source.",
            naming: Naming::Described { likeness },
            heat_path: None,
            steady: Vec::new(),
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        let size = Prior::Normal { mean: 0.0, sd: 2e-3 };
        let names = ["hot_deg_per_h_per_k_per_h", "cold_deg_per_h_per_k_per_h"];
        Some(Offer { parameters: names.map(|n| Parameter::new(n, size)).into(), choice: None, starts: vec![vec![0.0, 0.0]] })
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        let so_far = |better: fn(f64, f64) -> f64| -> Vec<f64> {
            let mut extreme = record.coil[0];
            let reached = record.coil.iter().map(|t| {
                extreme = better(extreme, *t);
                extreme
            });
            rates_per_hour(&record.time, &reached.collect::<Vec<_>>())
        };
        let (v, hot, cold) = (&active.values, so_far(f64::max), so_far(f64::min));
        let rate = hot.iter().zip(&cold).map(|(h, c)| v[0] * h + v[1] * c).collect();
        Ok(Effect::Coil(Change::of_rate(record, rate)))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }
}

fn likeness(_: &[f64], _: Digits) -> String {
    "present where a temperature is reached for the first time".into()
}
