//! Tables of named columns, written as CSV, Parquet or a workbook: the same table gives the same bytes.

mod csv;
mod format;
mod parquet;
mod table;
#[cfg(not(target_family = "wasm"))]
mod xlsx;

pub use format::{Format, bytes};
pub use table::{Cells, Column, Table};
