//! Every design that was tried, as a table.

use super::front::front;
use super::measure::Measure;
use super::plan::Plan;
use super::search::Found;
use crate::tabular::{Column, Table};
use crate::variants::Value;

/// A row for each design: what varies, its numbers, whether it keeps the limits, whether it is on the front.
pub fn table(plan: &Plan, found: &Found) -> Table {
    let all = &found.all;
    let best = front(all, &plan.minimise);
    let mut columns = vec![Column::whole("design", (0..all.len() as i64).collect())];
    for (n, factor) in plan.variants.factors.iter().enumerate() {
        let values = || all.iter().map(|tried| tried.values[n].as_ref());
        let number = |value: Option<&Value>| match value {
            Some(Value::Number(value)) => Some(*value),
            _ => None,
        };
        let is_number = values().flatten().all(|value| matches!(value, Value::Number(_)));
        columns.push(if is_number {
            Column::numbers(&factor.key, values().map(number).collect())
        } else {
            Column::texts(&factor.key, values().map(|value| value.map(Value::shown)).collect())
        });
    }
    columns.push(Column::numbers("total", all.iter().map(|tried| Some(tried.measures.sensitivity)).collect()));
    let with_tolerances = plan.asks(Measure::needs_tolerances);
    for measure in Measure::ALL.into_iter().filter(|measure| with_tolerances || !measure.needs_tolerances()) {
        columns.push(Column::numbers(measure.name(), all.iter().map(|tried| Some(measure.of(&tried.measures))).collect()));
    }
    columns.push(Column::whole("keeps_limits", all.iter().map(|tried| i64::from(tried.violation == 0.0)).collect()));
    columns.push(Column::whole("on_front", (0..all.len()).map(|n| i64::from(best.contains(&n))).collect()));
    Table { columns, about: vec![("fogcoil.version".to_owned(), env!("CARGO_PKG_VERSION").to_owned())] }
}
