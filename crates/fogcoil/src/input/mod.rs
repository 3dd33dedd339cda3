//! Case files: read, checked to the last value, and turned into SI.

mod cell;
mod coil;
mod coil_file;
mod coil_parts;
mod error;
mod fields;
mod limits;
mod scanner;
mod source;
mod syntax;

pub use cell::{CellCase, read_cell};
pub use coil::{CoilCase, Origin, Provenance, read_coil};
pub use error::InputError;
