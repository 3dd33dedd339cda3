//! The Python module `fogcoil._native`: what the package's typed layer calls.
//!
//! Texts and arrays in, texts and bytes out: objects as JSON, columns as the bytes of their doubles, which numpy reads in place. The
//! interpreter is free while anything is computed.

mod case;
mod columns;
mod compute;
mod error;

#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::case::{Cell, Coil};
    #[pymodule_export]
    use crate::compute::{DesignBox, compare, diagnose, further_columns, homogenize, measure, sensitivity, simulate, wind};
    #[pymodule_export]
    use crate::error::InputError;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
