//! A table as a workbook: a head that stays, numbers as numbers, texts as texts (a text that begins with = is no formula).

use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, XlsxError};

use super::table::{Cells, Table};

/// Most characters that a cell holds.
const MOST: usize = 32_000;
/// Widest column, in characters.
const WIDEST: usize = 60;

pub(super) fn bytes(table: &Table) -> Result<Vec<u8>, XlsxError> {
    let mut workbook = Workbook::new();
    // the same table gives the same bytes: no instant of writing
    let properties = DocProperties::new().set_creation_datetime(&ExcelDateTime::from_ymd(2000, 1, 1)?);
    workbook.set_properties(&properties);
    let sheet = workbook.add_worksheet();
    let head = Format::new().set_bold();
    sheet.set_freeze_panes(1, 0)?;
    for (number, column) in (0_u16..).zip(&table.columns) {
        sheet.write_string_with_format(0, number, &column.name, &head)?;
        sheet.set_column_width(number, width(&column.name, &column.cells) as f64)?;
        match &column.cells {
            Cells::Whole(cells) => {
                for (row, cell) in (1_u32..).zip(cells) {
                    sheet.write_number(row, number, *cell as f64)?;
                }
            }
            Cells::Numbers(cells) => {
                for (row, cell) in (1_u32..).zip(cells) {
                    if let Some(value) = cell.filter(|value| value.is_finite()) {
                        sheet.write_number(row, number, value)?;
                    }
                }
            }
            Cells::Texts(cells) => {
                for (row, cell) in (1_u32..).zip(cells) {
                    if let Some(text) = cell {
                        sheet.write_string(row, number, text.chars().take(MOST).collect::<String>())?;
                    }
                }
            }
        }
    }
    workbook.save_to_buffer()
}

fn width(name: &str, cells: &Cells) -> usize {
    let longest = match cells {
        Cells::Whole(_) | Cells::Numbers(_) => 12,
        Cells::Texts(cells) => cells.iter().flatten().map(|text| text.chars().count()).max().unwrap_or(0),
    };
    longest.max(name.chars().count()).min(WIDEST) + 2
}
