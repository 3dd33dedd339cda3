//! A table as comma-separated values (RFC 4180).

use super::table::{Cells, Table};

pub(super) fn bytes(table: &Table) -> Vec<u8> {
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let mut text = line(table.columns.iter().map(|column| quoted(&column.name)).collect());
    for row in 0..table.rows() {
        text.push_str(&line(table.columns.iter().map(|column| cell(&column.cells, row)).collect()));
    }
    text.into_bytes()
}

fn cell(cells: &Cells, row: usize) -> String {
    match cells {
        Cells::Whole(cells) => cells[row].to_string(),
        Cells::Numbers(cells) => cells[row].map_or(String::new(), |value| format!("{value:?}")),
        Cells::Texts(cells) => cells[row].as_deref().map_or(String::new(), quoted),
    }
}

fn quoted(text: &str) -> String {
    if text.contains(['"', ',', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
