//! Columns of numbers from Python, as a table that the readers of files check.

use std::fmt::Write;

use fogcoil::input::InputError;
use fogcoil::{Error, FileError};

/// A column: its name and its values.
pub(crate) type Column = (String, Vec<f64>);

/// The columns as CSV; every number reads back to the same double. The columns are of one length.
pub(crate) fn table(columns: &[Column]) -> String {
    let mut text = columns.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(",") + "\n";
    for row in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        for (number, (_, values)) in columns.iter().enumerate() {
            let separator = if number == 0 { "" } else { "," };
            let _ = write!(text, "{separator}{:e}", values[row]);
        }
        text.push('\n');
    }
    text
}

/// A complaint about a line of [`table`] as one about an element of a column, which is what the user has.
pub(crate) fn at_element(error: Error) -> Error {
    match error {
        Error::File(FileError::Input(InputError { file, line: Some(line), field, problem, remedy })) => {
            let element = |name: String| if line < 2 { name } else { format!("{name}[{}]", line - 2) };
            InputError { file, line: None, field: field.map(element), problem, remedy }.into()
        }
        other => other,
    }
}
