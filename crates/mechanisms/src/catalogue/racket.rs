//! A sensitivity that depends on temperature: all of the bias times 1 + b (T − 20 °C).

use crate::mechanism::{Change, Described, Offer, Stage};
use crate::series::growing;
use diagnosis::Prior;

pub(super) const RACKET: Described = Described {
    id: "unknown:racket",
    title: "A sensitivity that depends on temperature",
    stage: Stage::Material,
    equation: "All of the bias times 1 + b (T − 20 °C).",
    place: "The material of the coil; outside the named library.",
    signature: "The same ramp gives more bias at one end of the range than at the other.",
    source: "An empirical description; no source.",
    offer: |_| Offer::one("relative_per_k", Prior::Normal { mean: 0.0, sd: 1e-3 }, &[0.0]),
    law: |record, v| Change::of_parts(growing(&record.nominal.parts, record.spool(), v[0])),
    likeness: |v, digits| format!("a sensitivity that changes with temperature, by {} % a kelvin", digits(100.0 * v[0], 2)),
};
