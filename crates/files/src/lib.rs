#![doc = include_str!("../README.md")]
//! # Modules
//! - [`input`] reads `CELL.ron`, `COIL.ron`, `TARGETS.ron`, profiles and recordings. Every value is checked; what is wrong is said once, with
//!   file, line, field and remedy ([`input::InputError`]). The keys carry their units, the result is SI. One set of types says what a file
//!   holds: for reading, for writing and for its JSON Schema ([`input::schemas`]).
//! - [`output`] writes a design as a coil file, and files whole or not at all.
//! - [`units`] holds every conversion between the files' units and SI; [`schema`] tells whether JSON keeps a schema.
//! - [`shown`] and the like show names from files without what a terminal would obey.
//! - [`Note`] is a warning or a note; [`Remark`] has their ids, each with its explanation.
//!
//! Conventions: y = 0 is the coil's left face, +y its right; in a material z is the fibre (the coil's hoop), r across it.

mod error;
pub mod input;
mod note;
pub mod output;
mod remark;
pub mod schema;
mod shown;
pub mod units;

pub use error::Error;
pub use note::{Note, Severity};
pub use remark::{Explanation, Remark};
pub use shown::{shown, shown_json, shown_lines, shown_path};
