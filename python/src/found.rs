//! A result for the typed layer: its object as JSON, its words, its table, and its picture or page for a notebook.

use fogcoil::tabular;
use pyo3::prelude::*;
use serde_json::Value;

use crate::table::Table;

/// A result. Immutable.
#[pyclass(frozen, get_all, module = "fogcoil")]
pub(crate) struct Found {
    /// One object.
    json: String,
    /// The words of the command line.
    text: String,
    table: Option<Table>,
    /// An SVG document.
    picture: Option<String>,
    /// An HTML document.
    page: Option<String>,
}

impl Found {
    pub(crate) fn new(object: &Value, text: String) -> Self {
        Self { json: object.to_string(), text, table: None, picture: None, page: None }
    }

    pub(crate) fn with_table(self, table: tabular::Table) -> Self {
        Self { table: Some(table.into()), ..self }
    }

    pub(crate) fn with_picture(self, svg: impl Into<Option<String>>) -> Self {
        Self { picture: svg.into(), ..self }
    }

    pub(crate) fn with_page(self, html: String) -> Self {
        Self { page: Some(html), ..self }
    }
}
