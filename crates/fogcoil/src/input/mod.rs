//! Case files and profiles: read, checked to the last value, and turned into SI.

mod cell;
mod coil;
mod coil_file;
mod coil_parts;
mod error;
mod fields;
mod fingerprint;
mod heat;
mod limits;
mod mechanics;
mod profile;
mod profile_columns;
mod rows;
mod scanner;
mod source;
mod syntax;
mod warnings;

pub use cell::{CellCase, read_cell};
pub use coil::{CoilCase, Origin, PRINTED, Provenance, read_coil};
pub use error::InputError;
pub use fingerprint::Fingerprint;
pub use profile::{ProfileCase, read_profile};
