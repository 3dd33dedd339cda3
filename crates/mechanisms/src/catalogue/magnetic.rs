//! A bias by the stray field of the chamber's heaters and coolers, proportional to the rate of the chamber.

use crate::mechanism::rates_per_hour;
use crate::mechanism::{Change, Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Stage};
use crate::{Chain, Prepared};
use coil::{Design, Error};
use diagnosis::{Active, Prior};

pub(crate) const ID: &str = "unknown:magnetic";

pub(super) struct Magnetic;

impl Mechanism for Magnetic {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "Stray field of the chamber's heaters and coolers",
            stage: Stage::Optics,
            equation: "A bias proportional to the rate of the chamber's temperature.",
            place: "The optics (Faraday effect); outside the named library.",
            signature: "The rate answers the chamber at once, before any heat has reached the coil.",
            source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), ch. 7.",
            naming: Naming::Described { likeness },
            heat_path: None,
            steady: Vec::new(),
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        Some(Offer::one("deg_per_h_per_k_per_h", Prior::Normal { mean: 0.0, sd: 5e-4 }, &[0.0]))
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        let rates = rates_per_hour(&record.time, &record.chamber);
        Ok(Effect::Coil(Change::of_rate(record, rates.iter().map(|r| active.values[0] * r).collect())))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }
}

fn likeness(_: &[f64], _: Digits) -> String {
    "proportional to the rate of the chamber's temperature".into()
}
