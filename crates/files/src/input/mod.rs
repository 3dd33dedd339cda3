//! Case files, profiles and recordings: read, checked to the last value, and turned into SI.

mod cell;
mod cell_constants;
mod cell_file;
mod cell_general;
mod cell_material;
mod coil;
mod coil_file;
mod edit;
mod error;
mod fields;
mod fingerprint;
mod given;
mod group;
mod heat;
mod kind;
mod mechanics;
mod meta;
mod mirror;
mod profile;
mod profile_columns;
mod quantity;
mod record;
mod record_columns;
mod record_format;
mod rows;
mod scanner;
mod schema;
mod source;
mod spool;
mod spool_file;
mod syntax;
mod targets;
mod targets_file;
mod timestamp;
mod warnings;
mod winding_file;

pub use cell::{AnyCell, CellCase, check_any_cell, read_any_cell, read_cell};
pub use cell_constants::{AtTemperature, Spread, at_temperature};
pub use cell_general::GeneralCase;
pub use cell_material::Material;
pub use coil::{CoilCase, Origin, PRINTED, Provenance, check_coil, read_coil};
pub(crate) use coil_file::CoilFile;
pub use edit::{field_text, with_fields};
pub use error::InputError;
pub use fingerprint::Fingerprint;
pub use meta::{Meta, TemperatureSensor};
pub use profile::{Between, Inference, ProfileCase, check_profile, read_profile};
pub use record::{CHAMBER, RATE, RecordCase, SPOOL, check_record, read_record};
pub use record_format::{Key, RecordOptions};
pub use schema::schemas;
pub use source::{read_ron, read_text};
pub use spool::{SpoolCase, read_spool};
pub use targets::{TargetsCase, read_targets};

/// Rings of the most elaborate fibre accepted.
const MOST_RINGS: usize = 16;
/// Fibres of the largest cell accepted.
const MOST_FIBRES: usize = 100;
