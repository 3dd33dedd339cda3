//! Tables for Python: by Arrow's C data interface for libraries that read it, by the bytes of their columns for numpy.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_array::ffi_stream::FFI_ArrowArrayStream;
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray};
use arrow_schema::{DataType, Field, Schema};
use fogcoil::tabular::{self, Cells};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyCapsule};

/// A table. Immutable.
#[pyclass(frozen, module = "fogcoil")]
#[derive(Clone)]
pub(crate) struct Table(Arc<tabular::Table>);

impl From<tabular::Table> for Table {
    fn from(table: tabular::Table) -> Self {
        Self(Arc::new(table))
    }
}

/// A column for numpy.
#[derive(IntoPyObject)]
pub(crate) enum Values<'py> {
    /// The bytes of doubles.
    Numbers(Bound<'py, PyByteArray>),
    /// The bytes of whole numbers of 64 bits.
    Whole((Bound<'py, PyByteArray>,)),
    Texts(Vec<Option<String>>),
}

#[pymethods]
impl Table {
    /// The whole table as a stream of one batch, in a capsule that pandas, polars, pyarrow, DuckDB and others take.
    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // the protocol lets a producer give the schema that it has
        drop(requested_schema);
        let batch = self.batch().map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        let schema = batch.schema();
        let stream = FFI_ArrowArrayStream::new(Box::new(RecordBatchIterator::new([Ok(batch)], schema)));
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    /// Names and values of all columns.
    fn columns<'py>(&self, py: Python<'py>) -> Vec<(String, Values<'py>)> {
        let values = |cells: &Cells| match cells {
            Cells::Whole(cells) => Values::Whole((bytes(py, cells.iter().map(|cell| cell.to_ne_bytes())),)),
            Cells::Numbers(cells) => Values::Numbers(bytes(py, cells.iter().map(|cell| cell.unwrap_or(f64::NAN).to_ne_bytes()))),
            Cells::Texts(cells) => Values::Texts(cells.clone()),
        };
        self.0.columns.iter().map(|column| (column.name.clone(), values(&column.cells))).collect()
    }
}

impl Table {
    fn batch(&self) -> Result<RecordBatch, arrow_schema::ArrowError> {
        let array = |cells: &Cells| -> ArrayRef {
            match cells {
                Cells::Whole(cells) => Arc::new(Int64Array::from(cells.clone())),
                Cells::Numbers(cells) => Arc::new(Float64Array::from(cells.clone())),
                Cells::Texts(cells) => Arc::new(StringArray::from(cells.clone())),
            }
        };
        let field = |column: &tabular::Column| match &column.cells {
            Cells::Whole(_) => Field::new(&column.name, DataType::Int64, false),
            Cells::Numbers(_) => Field::new(&column.name, DataType::Float64, true),
            Cells::Texts(_) => Field::new(&column.name, DataType::Utf8, true),
        };
        let schema = Schema::new(self.0.columns.iter().map(field).collect::<Vec<_>>());
        let schema = schema.with_metadata(self.0.about.iter().cloned().collect::<HashMap<_, _>>());
        RecordBatch::try_new(Arc::new(schema), self.0.columns.iter().map(|column| array(&column.cells)).collect())
    }
}

fn bytes<'py>(py: Python<'py>, values: impl Iterator<Item = [u8; 8]>) -> Bound<'py, PyByteArray> {
    PyByteArray::new(py, &values.flatten().collect::<Vec<u8>>())
}
