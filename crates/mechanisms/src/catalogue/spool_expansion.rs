//! A spool whose expansion depends on temperature, as that of metals does.

use crate::mechanism::{Change, Described, Offer, Stage};
use crate::series::growing;
use diagnosis::Prior;

pub(super) const SPOOL_EXPANSION: Described = Described {
    id: "unknown:spool-expansion",
    title: "A spool whose expansion depends on temperature",
    stage: Stage::Material,
    equation: "Spool's expansion α (1 + b (T − 20 °C)), as that of metals is.",
    place: "The spool's material; outside the named library.",
    signature: "The sensitivity changes linearly with temperature, by part as the spool's expansion does.",
    source: "An empirical description; no source.",
    offer: |_| Offer::one("expansion_per_k2_relative", Prior::Normal { mean: 0.0, sd: 1e-3 }, &[0.0]),
    law: |record, v| {
        let change = record.of_spool_expansion().map(|parts| Change::of_parts(growing(&parts, record.spool(), v[0])));
        change.unwrap_or_else(|| Change::none(record))
    },
    likeness: |v, digits| {
        format!("like the spool's expansion changing with temperature, by {} % a kelvin", digits(100.0 * v[0], 2))
    },
};
