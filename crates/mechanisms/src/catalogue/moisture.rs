//! Water that the adhesive gives off or takes up, at a rate that decays as in diffusion.

use crate::mechanism::{Change, Described, Offer, Stage};
use bias::units::S_PER_H;
use diagnosis::{Parameter, Prior};

pub(super) const MOISTURE: Described = Described {
    id: "unknown:moisture",
    title: "Water that leaves or enters the adhesive",
    stage: Stage::Material,
    equation: "A bias a exp(−t/τ) from the record's first row.",
    place: "The material of the coil; outside the named library.",
    signature: "A decay over hours that does not repeat in a second run, whatever the chamber does.",
    source: "J. Crank, *The Mathematics of Diffusion*, 2nd ed., Oxford (1975).",
    offer: |scene| Offer {
        parameters: vec![
            Parameter::new("rate_deg_per_h", Prior::Normal { mean: 0.0, sd: 2.5 * scene.noise }),
            Parameter::new("time_s", Prior::LogNormal { median: 6.0 * S_PER_H, spread: 0.7 }),
        ],
        choice: None,
        starts: vec![vec![0.0, 2.0 * S_PER_H], vec![0.0, 8.0 * S_PER_H]],
    },
    law: |record, v| {
        let start = record.time.first().copied().unwrap_or(0.0);
        Change::of_rate(record, record.time.iter().map(|t| v[0] * (-(t - start) / v[1]).exp()).collect())
    },
    likeness: |v, digits| format!("decaying with time, over {} h", digits(v[1] / S_PER_H, 2)),
};
