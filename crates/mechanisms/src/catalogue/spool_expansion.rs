//! A spool whose expansion depends on temperature, as that of metals does.

use crate::mechanism::growing;
use crate::mechanism::{Change, Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Stage};
use crate::{Chain, Prepared};
use coil::{Design, Error};
use diagnosis::{Active, Prior};

pub(crate) const ID: &str = "unknown:spool-expansion";

pub(super) struct SpoolExpansion;

impl Mechanism for SpoolExpansion {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "A spool whose expansion depends on temperature",
            stage: Stage::Material,
            equation: "Spool's expansion α (1 + b (T − 20 °C)), as that of metals is.",
            place: "The spool's material; outside the named library.",
            signature: "The sensitivity changes linearly with temperature, by part as the spool's expansion does.",
            source: "An empirical description; no source.",
            naming: Naming::Described { likeness },
            heat_path: None,
            steady: Vec::new(),
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        Some(Offer::one("expansion_per_k2_relative", Prior::Normal { mean: 0.0, sd: 1e-3 }, &[0.0]))
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        // parts per relative change of the spool's expansion
        let change = record.constants.last().map(|parts| Change::of_parts(growing(parts, record.spool(), active.values[0])));
        Ok(Effect::Coil(change.unwrap_or_else(|| Change::none(record))))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }
}

fn likeness(v: &[f64], digits: Digits) -> String {
    format!("like the spool's expansion changing with temperature, by {} % a kelvin", digits(100.0 * v[0], 2))
}
