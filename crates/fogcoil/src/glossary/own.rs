//! A mechanism of a user's own, as its file describes it.

use std::fmt::Write;

use diagnosis::{Parameter, Prior};
use mechanisms::Mechanism;
use serde_json::{Value, json};

use super::mechanism::indented;
use crate::input::MechanismCase;
use crate::table::{significant, table};
use crate::units::parameter_unit;

/// The mechanism as text.
pub fn own_text(case: &MechanismCase) -> String {
    let facts = case.mechanism.facts();
    let mut out = format!("{}: {}\n", facts.id, facts.title);
    let mut say = |name: &str, text: &str| {
        if !text.is_empty() {
            let _ = write!(out, "\n{name}\n{}\n", indented(text));
        }
    };
    say("Equation", facts.equation);
    let header = ["parameter", "unit", "prior", "value"].map(str::to_owned).to_vec();
    let row = |(parameter, value): (&Parameter, &Option<f64>)| {
        let value = value.map_or_else(|| "-".to_owned(), |value| significant(value, 5));
        vec![parameter.name.clone(), parameter_unit(&parameter.name).into_owned(), prior(&parameter.prior), value]
    };
    let rows = case.mechanism.parameters.iter().zip(&case.values).map(row);
    say("Parameters", &table(&std::iter::once(header).chain(rows).collect::<Vec<_>>()));
    say("Signature", facts.signature);
    say("How to test it", &facts.inspection().map_or(String::new(), |inspection| format!("On the unit: {inspection}.")));
    say("Source", facts.source);
    out
}

fn prior(prior: &Prior) -> String {
    match *prior {
        Prior::Normal { mean, sd } => format!("{mean} ± {sd}"),
        Prior::Size { scale } => format!("0 ± {scale}, or larger by orders"),
        Prior::LogNormal { median, spread } => format!("{median}, its logarithm ± {spread}"),
        Prior::Uniform { low, high } => format!("{low} to {high}"),
    }
}

/// One object, as of a mechanism of the program; see docs/schema/glossary.schema.json.
pub fn own_json(case: &MechanismCase) -> Value {
    let facts = case.mechanism.facts();
    let parameter = |parameter: &Parameter| json!({"parameter": parameter.name, "unit": parameter_unit(&parameter.name), "prior": prior(&parameter.prior)});
    json!({
        "id": facts.id,
        "kind": "mechanism",
        "title": facts.title,
        "stage": facts.stage.name(),
        "equation": facts.equation,
        "place": facts.place,
        "parameters": case.mechanism.parameters.iter().map(parameter).collect::<Vec<_>>(),
        "signature": facts.signature,
        "confused_with": [],
        "inspection": facts.inspection(),
        "source": facts.source,
    })
}
