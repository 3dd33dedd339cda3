//! The table of a sweep.

use super::plan::Plan;
use super::points::Sampling;
use super::row::Row;
use crate::tabular::{Column, Table};
use crate::variants::Value;

/// The table of a plan's rows, all of them and in order: the point's number, the factors in the units of their keys, the outputs, and the reason of a lack.
pub fn table(plan: &Plan, rows: &[Row]) -> Table {
    let mut columns = vec![Column::whole("point", (0..rows.len() as i64).collect())];
    if let Sampling::Indices(_) = plan.sampling {
        columns.push(Column::texts("matrix", (0..rows.len()).map(|n| Some(matrix(plan, n))).collect()));
    }
    columns.extend(plan.variants.factors.iter().enumerate().map(|(n, factor)| varied(&factor.key, n, rows)));
    for (n, name) in plan.names().into_iter().enumerate() {
        columns.push(Column::numbers(name, rows.iter().map(|row| row.outputs[n]).collect()));
    }
    columns.push(Column::texts("problem", rows.iter().map(|row| row.problem.clone()).collect()));
    let about = [("fogcoil.version", env!("CARGO_PKG_VERSION").to_owned()), ("fogcoil.inputs_sha256", plan.hash())];
    Table { columns, about: about.map(|(key, value)| (key.to_owned(), value)).to_vec() }
}

/// Matrix to which a point belongs: A, B, or A with a group of B.
fn matrix(plan: &Plan, number: usize) -> String {
    match number % plan.points.block() {
        0 => "A".into(),
        1 => "B".into(),
        place => plan.groups[place - 2].name().into(),
    }
}

fn varied(key: &str, place: usize, rows: &[Row]) -> Column {
    let values = || rows.iter().map(|row| row.values.get(place).and_then(Option::as_ref));
    let is_number = |value: &Value| matches!(value, Value::Number(_));
    if values().flatten().all(is_number) {
        let number = |value: Option<&Value>| match value {
            Some(Value::Number(value)) => Some(*value),
            _ => None,
        };
        Column::numbers(key, values().map(number).collect())
    } else {
        Column::texts(key, values().map(|value| value.map(Value::shown)).collect())
    }
}
