//! Case files in; tables, pictures and JSON out: the program `fogcoil` as a library.
//!
//! - [`input`], [`output`], [`units`] and [`schema`] are those of the crate [`files`]: case files, profiles and recordings in, designs out.
//! - [`simulate`] runs a profile; [`summary`], [`figures`] and [`report`] say what came out.
//! - [`homogenize`], [`wind`], [`sensitivity`] render what the physics crates compute: as text for people and as JSON, CSV or SVG.
//! - [`identify`] finds constituents behind measured effective constants.
//! - [`sweep`](mod@sweep) computes designs around a drawing by the thousand; [`variants`](mod@variants) are what differs; [`tabular`] writes tables.
//! - [`optimise`] seeks the design with the least of what a plan names.
//! - [`batch`] measures, diagnoses and judges many units of one design.
//! - [`compare`](mod@compare) holds two designs against each other.
//! - [`cache`] keeps models that take long to build.
//! - [`check`] judges a recording and identifies its noise.
//! - [`measure`] has a recording's figures as specifications state them.
//! - [`diagnose`] compares recordings with a design and names what the design leaves out.
//! - [`recommend`] finds the test that tells mechanisms apart; [`explain`] solves for what would give a measured sensitivity.
//! - [`prepare`] makes what these start from: a design's library of models, and recordings as the engine wants them.
//! - [`contradictions`] are what a meta file says and its record does not.
//! - [`glossary`] explains the ids of mechanisms, warnings and notes.
//!
//! The functions neither print nor parse arguments; `main.rs` does.
//!
//! Conventions: y = 0 is the coil's left face, +y its right; z = 0 is the outer end of the CCW half; in a material z is the
//! fibre (the coil's hoop), r across it. Sensitivities in (deg/h)/(degC/min).
//!
//! ```
//! # fn main() -> Result<(), fogcoil::Error> {
//! # let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron");
//! let case = fogcoil::input::read_coil(path.as_ref())?;
//! assert_eq!(format!("{:.2}", case.winding.length()), "1101.57"); // m
//! assert!(fogcoil::wind::csv(&case.winding).starts_with("half,layer,turn,y_mm,r_mm,z_start_m,z_end_m\nCCW,36,"));
//! # Ok(())
//! # }
//! ```

pub mod band;
pub mod batch;
mod beside;
pub mod cache;
pub mod calibrate;
pub mod check;
pub mod compare;
pub mod comparison;
mod compose;
pub mod contradictions;
mod copies;
pub mod diagnose;
mod error;
pub mod explain;
pub mod figures;
pub mod glossary;
pub mod homogenize;
pub mod identify;
mod jumps;
mod keys;
mod left;
pub mod measure;
#[cfg(not(target_family = "wasm"))]
pub mod optimise;
mod other_drawing;
pub mod picture;
pub mod picture_cell;
pub mod prepare;
mod program;
mod rate_unit;
pub mod recommend;
pub mod report;
pub mod section_files;
pub mod sensitivity;
pub mod simulate;
pub mod summary;
pub mod sweep;
mod table;
pub mod tabular;
pub mod templates;
pub mod trim;
mod turn_bias;
pub mod variants;
pub mod wind;

pub use error::Error;
pub use files::{Error as FileError, input, output, schema, shown_path, units};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
