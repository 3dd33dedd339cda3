//! A batch as one object.

use serde_json::{Map, Value, json};

use super::columns::table;
use super::run::Batch;
use crate::tabular::{Cells, Column};

/// The table, an object for each unit, with the numbers of units that fail and of those that are not known to pass. See docs/schema/batch.schema.json.
pub fn json(batch: &Batch) -> Value {
    let columns = table(batch).columns;
    let unit =
        |row: usize| -> Map<String, Value> { columns.iter().map(|column| (column.name.clone(), cell(column, row))).collect() };
    json!({
        "units": (0..batch.rows.len()).map(unit).collect::<Vec<_>>(),
        "failing": batch.failing(),
        "not_known": batch.not_known(),
    })
}

fn cell(column: &Column, row: usize) -> Value {
    match &column.cells {
        Cells::Whole(cells) => json!(cells[row]),
        Cells::Numbers(cells) => json!(cells[row]),
        Cells::Texts(cells) => json!(cells[row]),
    }
}
