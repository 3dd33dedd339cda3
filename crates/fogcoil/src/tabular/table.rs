//! A table: named columns of as many cells.

/// A table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Columns, from the left.
    pub columns: Vec<Column>,
    /// Metadata of a Parquet file: names and texts.
    pub about: Vec<(String, String)>,
}

/// A column.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Its name; of a number with its unit.
    pub name: String,
    /// Cells, from the top.
    pub cells: Cells,
}

/// Cells of a column; all columns of a table have the same number.
#[derive(Debug, Clone, PartialEq)]
pub enum Cells {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers, some of which may be missing.
    Numbers(Vec<Option<f64>>),
    /// Texts, some of which may be missing.
    Texts(Vec<Option<String>>),
}

impl Column {
    /// A column of numbers.
    pub fn numbers(name: impl Into<String>, cells: Vec<Option<f64>>) -> Self {
        Self { name: name.into(), cells: Cells::Numbers(cells) }
    }

    /// A column of texts.
    pub fn texts(name: impl Into<String>, cells: Vec<Option<String>>) -> Self {
        Self { name: name.into(), cells: Cells::Texts(cells) }
    }

    /// A column of whole numbers.
    pub fn whole(name: impl Into<String>, cells: Vec<i64>) -> Self {
        Self { name: name.into(), cells: Cells::Whole(cells) }
    }
}

impl Table {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| match &column.cells {
            Cells::Whole(cells) => cells.len(),
            Cells::Numbers(cells) => cells.len(),
            Cells::Texts(cells) => cells.len(),
        })
    }
}

/// A table with everything that is hard to write.
#[cfg(test)]
pub(super) fn hard() -> Table {
    Table {
        columns: vec![
            Column::whole("row", vec![1, 2, 3]),
            Column::numbers("x_mm", vec![Some(0.1), None, Some(-1.0 / 3.0)]),
            Column::texts("words, quoted", vec![Some("a \"b\", c".into()), Some("=1+1".into()), None]),
        ],
        about: vec![("made by".into(), "a test".into())],
    }
}
