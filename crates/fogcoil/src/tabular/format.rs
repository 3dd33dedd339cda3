//! Formats of a table, and the table written in one of them.

use std::path::Path;

use super::table::Table;
#[cfg(not(target_family = "wasm"))]
use super::xlsx;
use super::{csv, parquet};
use crate::Error;

/// Format of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values; every number reads back to the same double.
    Csv,
    /// Apache Parquet.
    Parquet,
    /// A workbook of Excel.
    Xlsx,
}

impl Format {
    /// The format by the end of a file's name, one of `known`.
    ///
    /// # Errors
    /// [`files::Error::Usage`] names the file and the ends that are known.
    pub fn of(path: &Path, known: &[Self]) -> Result<Self, Error> {
        let end = path.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase);
        let found = known.iter().find(|format| end.as_deref() == Some(format.end()));
        found.copied().ok_or_else(|| {
            let ends: Vec<String> = known.iter().map(|format| format!(".{}", format.end())).collect();
            let shown = files::shown_path(path);
            Error::usage(format!("{shown}: a table is not written as this; give a name that ends in {}", ends.join(" or ")))
        })
    }

    /// End of a file's name.
    pub fn end(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
            Self::Xlsx => "xlsx",
        }
    }
}

/// The bytes of a table in a file.
///
/// # Errors
/// [`Error::Table`] where the writer of the format refuses it.
pub fn bytes(table: &Table, format: Format) -> Result<Vec<u8>, Error> {
    match format {
        Format::Csv => Ok(csv::bytes(table)),
        Format::Parquet => parquet::bytes(table).map_err(|error| Error::Table(error.to_string())),
        #[cfg(not(target_family = "wasm"))]
        Format::Xlsx => xlsx::bytes(table).map_err(|error| Error::Table(error.to_string())),
        #[cfg(target_family = "wasm")]
        Format::Xlsx => Err(Error::Table("a page writes no workbooks".into())),
    }
}

#[cfg(test)]
mod tests {
    use super::super::table::hard;
    use super::*;

    #[test]
    fn numbers_read_back_and_words_are_quoted() {
        let text = String::from_utf8(bytes(&hard(), Format::Csv).unwrap()).unwrap();
        let third = -1.0_f64 / 3.0;
        assert_eq!(text, format!("row,x_mm,\"words, quoted\"\n1,0.1,\"a \"\"b\"\", c\"\n2,,=1+1\n3,{third:?},\n"));
    }

    #[test]
    fn a_table_has_the_same_bytes_each_time() {
        for format in [Format::Parquet, Format::Xlsx] {
            assert_eq!(bytes(&hard(), format).unwrap(), bytes(&hard(), format).unwrap());
        }
    }

    #[test]
    fn a_file_of_another_kind_is_refused() {
        let error = Format::of("t.xls".as_ref(), &[Format::Csv, Format::Parquet]).unwrap_err().to_string();
        assert!(error.contains("t.xls: a table is not written as this; give a name that ends in .csv or .parquet"), "{error}");
        assert_eq!(Format::of("a/t.CSV".as_ref(), &[Format::Csv]).unwrap(), Format::Csv);
    }
}
