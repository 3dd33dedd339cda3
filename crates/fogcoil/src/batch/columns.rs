//! The table of a batch.

use super::row::{MEASURED, NUMBERS, Row};
use super::run::Batch;
use crate::input::BETWEEN_FILES;
use crate::tabular::{Column, Table};

/// A row for each unit: its name, its measured figures, its diagnosis, and whether it passes.
pub fn table(batch: &Batch) -> Table {
    let rows = || batch.rows.iter().map(|(row, _)| row);
    let text = |name: &str, of: &dyn Fn(&Row) -> Option<String>| Column::texts(name, rows().map(of).collect());
    let joined = |all: &[String]| (!all.is_empty()).then(|| all.join(BETWEEN_FILES));
    let judged = || batch.rows.iter().map(|(_, judged)| judged);
    let mut columns = vec![
        text("unit", &|row| Some(row.unit.clone())),
        text("serial", &|row| row.serial.clone()),
        text("date", &|row| row.date.clone()),
        Column::texts("judged", judged().map(|judged| Some(judged.word().to_owned()).filter(|word| !word.is_empty())).collect()),
        Column::texts("reason", judged().map(super::limits::Judged::reasons).collect()),
        text("verdict", &|row| row.verdict.clone()),
        text("set", &|row| joined(&row.set)),
    ];
    for (n, name) in NUMBERS.iter().enumerate() {
        columns.push(Column::numbers(*name, rows().map(|row| row.number(name)).collect()));
        for (end, place) in [("low", 0), ("high", 1)].into_iter().filter(|_| n < MEASURED) {
            let cells = rows().map(|row| row.interval(name).map(|ends| ends[place])).collect();
            columns.push(Column::numbers(format!("{name}_{end}"), cells));
        }
    }
    columns.extend([
        text("first_mechanism", &|row| row.first.clone()),
        text("lot", &|row| row.lot.clone()),
        text("shape", &|row| row.shape.clone()),
        text("warnings", &|row| joined(&row.warnings)),
        text("bias_instability_is", &|row| row.instability_is_bound.then(|| "upper bound".to_owned())),
    ]);
    columns.extend(parameters(batch));
    columns.extend([
        text("files", &|row| joined(&row.files)),
        text("sha256", &|row| joined(&row.hashes)),
        text("program", &|_| Some(format!("fogcoil {}", env!("CARGO_PKG_VERSION")))),
        text("problem", &|row| row.problem.clone()),
    ]);
    let about = vec![("fogcoil.version".to_owned(), env!("CARGO_PKG_VERSION").to_owned())];
    Table { columns, about }
}

/// Every parameter that a unit has, by name, with both ends of its interval.
fn parameters(batch: &Batch) -> Vec<Column> {
    let mut names: Vec<&str> =
        batch.rows.iter().flat_map(|(row, _)| row.parameters.iter().map(|(name, _)| name.as_str())).collect();
    names.sort_unstable();
    names.dedup();
    let of = |name: &str, place: usize| {
        let value = |row: &Row| row.parameters.iter().find(|(own, _)| own == name).map(|(_, told)| told[place]);
        batch.rows.iter().map(|(row, _)| value(row)).collect()
    };
    let column = |name: &str| ["", "_low", "_high"].map(|end| format!("{name}{end}"));
    names
        .iter()
        .flat_map(|name| column(name).into_iter().enumerate().map(|(n, head)| Column::numbers(head, of(name, n))))
        .collect()
}
