//! A sweep as JSON. See docs/schema/sweep.schema.json.

use serde_json::{Map, Value, json};

use super::indices::Indices;
use super::plan::Plan;
use super::statistics::{Smallest, Spread, Summary};
use crate::variants::Value as Varied;

/// One object; sensitivities in (deg/h)/(degC/min), the rest in the unit of its name.
pub fn json(plan: &Plan, summary: &Summary) -> Value {
    let spread = |s: &Spread| {
        let [least, low, median, high, largest] = s.quantiles;
        json!({
            "name": s.name, "mean": s.mean, "sd": s.sd, "least": least, "p05": low, "median": median, "p95": high, "largest": largest,
        })
    };
    json!({
        "points": plan.count(),
        "designs": summary.designs,
        "failed": summary.failed.as_ref().map_or(0, |(count, _)| *count),
        "first_problem": summary.failed.as_ref().map(|(_, problem)| problem),
        "seed": plan.seed,
        "inputs_sha256": plan.hash(),
        "outputs": summary.spreads.iter().map(spread).collect::<Vec<_>>(),
        "smallest": summary.smallest.as_ref().map(smallest),
        "linear_sd": summary.linear_sd,
        "indices": summary.indices.as_ref().map(indices),
    })
}

fn smallest(smallest: &Smallest) -> Value {
    let value = |value: &Varied| match value {
        Varied::Number(value) => json!(value),
        other => json!(other.shown()),
    };
    let values: Map<String, Value> = smallest.values.iter().map(|(key, told)| (key.clone(), value(told))).collect();
    json!({"point": smallest.point, "total": smallest.total, "values": values})
}

fn indices(indices: &Indices) -> Value {
    let with = |(value, ci90): (f64, [f64; 2])| json!({"value": value, "ci90": ci90});
    let groups = indices
        .all
        .iter()
        .map(|index| json!({"group": index.group.name(), "first": with(index.first), "total": with(index.total)}));
    json!({"of": "|total|", "pairs": indices.pairs, "left_out": indices.left_out, "groups": groups.collect::<Vec<_>>()})
}
