//! The Python module `fogcoil._native`: what the package's typed layer calls.
//!
//! Texts and arrays in; objects as JSON and tables as Arrow's arrays out. The interpreter is free while anything is computed, and an interrupt ends it at
//! its next step.

mod case;
mod compute;
mod error;
mod found;
mod plans;
mod records;
mod table;
mod watched;

#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::case::{Cell, Coil};
    #[pymodule_export]
    use crate::compute::{
        DesignBox, compare, explain_id, explain_mechanism, explain_sensitivity, homogenize, sensitivity, simulate, template,
        trim, wind,
    };
    #[pymodule_export]
    use crate::error::InputError;
    #[pymodule_export]
    use crate::found::Found;
    #[pymodule_export]
    use crate::plans::{identify, optimise, sweep};
    #[pymodule_export]
    use crate::records::{batch, calibrate, check, diagnose, further_columns, measure, recommend};
    #[pymodule_export]
    use crate::table::Table;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
