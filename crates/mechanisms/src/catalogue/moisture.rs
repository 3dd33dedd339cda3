//! Water that the adhesive gives off or takes up, at a rate that decays as in diffusion.

use crate::mechanism::{Change, Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Stage};
use crate::{Chain, Prepared};
use bias::units::S_PER_H;
use coil::{Design, Error};
use diagnosis::{Active, Parameter, Prior};

pub(crate) const ID: &str = "unknown:moisture";

pub(super) struct Moisture;

impl Mechanism for Moisture {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "Water that leaves or enters the adhesive",
            stage: Stage::Material,
            equation: "A bias a exp(−t/τ) from the record's first row.",
            place: "The material of the coil; outside the named library.",
            signature: "A decay over hours that does not repeat in a second run, whatever the chamber does.",
            source: "J. Crank, *The Mathematics of Diffusion*, 2nd ed., Oxford (1975).",
            naming: Naming::Described { likeness },
            heat_path: None,
            steady: Vec::new(),
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        Some(Offer {
            parameters: vec![
                Parameter::new("rate_deg_per_h", Prior::Normal { mean: 0.0, sd: 0.02 }),
                Parameter::new("time_s", Prior::LogNormal { median: 6.0 * S_PER_H, spread: 0.7 }),
            ],
            choice: None,
            starts: vec![vec![0.0, 2.0 * S_PER_H], vec![0.0, 8.0 * S_PER_H]],
        })
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        let (v, start) = (&active.values, record.time.first().copied().unwrap_or(0.0));
        let decay = record.time.iter().map(|t| v[0] * (-(t - start) / v[1]).exp()).collect();
        Ok(Effect::Coil(Change::of_rate(record, decay)))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }
}

fn likeness(v: &[f64], digits: Digits) -> String {
    format!("decaying with time, over {} h", digits(v[1] / S_PER_H, 2))
}
