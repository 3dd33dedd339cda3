//! An optimisation for scripts. See docs/schema/optimise.schema.json.

use serde_json::{Map, Value, json};

use super::check::{Change, Checked};
use super::evaluate::Tried;
use super::front::front;
use super::measure::{Measure, Measures};
use super::plan::Plan;
use super::search::Found;
use crate::variants;

/// One object; `optimum` is null where no design that was tried keeps the limits.
pub fn json(plan: &Plan, found: &Found, checked: Option<&Checked>) -> Value {
    let best = front(&found.all, &plan.minimise);
    json!({
        "tried": found.all.len(),
        "failed": found.failed.as_ref().map_or(0, |(count, _)| *count),
        "first_problem": found.failed.as_ref().map(|(_, problem)| problem),
        "keep_limits": found.all.iter().filter(|tried| tried.violation == 0.0).count(),
        "minimised": plan.minimise.iter().map(|measure| measure.name()).collect::<Vec<_>>(),
        "drawing": numbers(plan, &found.drawn),
        "front": best.iter().map(|n| design(plan, &found.all[*n])).collect::<Vec<_>>(),
        "optimum": checked.map(|checked| optimum(plan, checked)),
    })
}

fn numbers(plan: &Plan, measures: &Measures) -> Value {
    let known = |measure: &Measure| plan.asks(Measure::needs_tolerances) || !measure.needs_tolerances();
    let told = |measure: Measure| (measure.name().to_owned(), json!(measure.of(measures)));
    let mut all: Map<String, Value> = Measure::ALL.into_iter().filter(known).map(told).collect();
    all.insert("total".into(), json!(measures.sensitivity));
    Value::Object(all)
}

fn design(plan: &Plan, tried: &Tried) -> Value {
    let value = |value: &Option<variants::Value>| match value {
        Some(variants::Value::Number(value)) => json!(value),
        other => json!(other.as_ref().map(variants::Value::shown)),
    };
    let factors = plan.variants.factors.iter().map(|factor| factor.key.clone());
    let values: Map<String, Value> = factors.zip(tried.values.iter().map(value)).collect();
    json!({"values": values, "numbers": numbers(plan, &tried.measures)})
}

fn optimum(plan: &Plan, checked: &Checked) -> Value {
    let [most, largest] = checked.quantiles();
    let step = |(key, value, total): &Change| json!({"key": key, "value": value, "total": total});
    json!({
        "design": design(plan, &checked.tried),
        "total": checked.steady.sensitivity.total(),
        "error_estimate": checked.steady.error_estimate,
        "tolerance_sd": checked.band.sd,
        "units": {"count": checked.within.len(), "p95": most, "largest": largest, "share_below_half": checked.share_below(0.5)},
        "warnings": checked.case.warnings,
        "path": checked.path.iter().map(step).collect::<Vec<_>>(),
    })
}
