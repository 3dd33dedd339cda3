//! A bias by the stray field of the chamber's heaters and coolers, proportional to the rate of the chamber.

use crate::mechanism::{Change, Described, Offer, Stage};
use crate::series::rates_per_hour;
use diagnosis::Prior;

pub(super) const MAGNETIC: Described = Described {
    id: "unknown:magnetic",
    title: "Stray field of the chamber's heaters and coolers",
    stage: Stage::Optics,
    equation: "A bias proportional to the rate of the chamber's temperature.",
    place: "The optics (Faraday effect); outside the named library.",
    signature: "The rate answers the chamber at once, before any heat has reached the coil.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), ch. 7.",
    offer: |scene| Offer::one("deg_per_h_per_k_per_h", Prior::Normal { mean: 0.0, sd: 0.06 * scene.noise }, &[0.0]),
    law: |record, v| {
        let rates = rates_per_hour(&record.time, &record.chamber);
        Change::of_rate(record, rates.iter().map(|r| v[0] * r).collect())
    },
    likeness: |_, _| "proportional to the rate of the chamber's temperature".into(),
};
