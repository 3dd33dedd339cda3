//! A sensitivity that depends on temperature: all of the bias times 1 + b (T − 20 °C).

use crate::mechanism::growing;
use crate::mechanism::{Change, Digits, Effect, Extent, Facts, Mechanism, Naming, Offer, Stage};
use crate::{Chain, Prepared};
use coil::{Design, Error};
use diagnosis::{Active, Prior};

pub(crate) const ID: &str = "unknown:racket";

pub(super) struct Racket;

impl Mechanism for Racket {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "A sensitivity that depends on temperature",
            stage: Stage::Material,
            equation: "All of the bias times 1 + b (T − 20 °C).",
            place: "The material of the coil; outside the named library.",
            signature: "The same ramp gives more bias at one end of the range than at the other.",
            source: "An empirical description; no source.",
            naming: Naming::Described { likeness },
            heat_path: None,
            steady: Vec::new(),
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        Some(Offer::one("relative_per_k", Prior::Normal { mean: 0.0, sd: 1e-3 }, &[0.0]))
    }

    fn effect(&self, _: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        Ok(Effect::Coil(Change::of_parts(growing(&record.nominal.parts, record.spool(), active.values[0]))))
    }

    fn extended(&self, _: &Design, _: &Active) -> Option<Design> {
        None
    }
}

fn likeness(v: &[f64], digits: Digits) -> String {
    format!("a sensitivity that changes with temperature, by {} % a kelvin", digits(100.0 * v[0], 2))
}
