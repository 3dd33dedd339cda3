//! Requirements on the program's numbers, and the proofs that they are met.
//!
//! - [`validation`]: the whole chain against the paper's Tables I to IV and an independent finite-element code.
//! - [`cells`]: cells of many kinds against much finer solutions, finite elements and NGSolve.
//! - [`coil_job`]: heat flow and strains of a whole coil by the project's own elements, as the peers of `benches/peers` compute them ([`peers`]).
//! - [`Identify`]: constituents of cells that are known, from their constants with noise.
//! - [`Survey`]: errors that are stated of random cells, coils and profiles against the true ones.
//! - [`generator`]: units that conceal something, made by a plant of their own, which shares no law with what diagnoses them.
//! - [`Prove`]: those units and the fixtures' answered by the program, and the answers held against the truths.
//! - [`statistics`]: rates, medians and means with 90 % intervals.
//!
//! Answers are written before the truths are opened. What is measured goes into the pages of `docs`, under the hash of the [`program`] that
//! answered; this crate, which only asks, does not count in that hash.
//!
//! ```
//! use proof::statistics::rate;
//!
//! // no false alarm in 300 units: by Wilson's interval their rate is below 1 % with 95 % probability
//! let measured = rate(0, 300).expect("there are units");
//! assert_eq!(measured.value, 0.0);
//! assert!(measured.interval[1] < 0.01);
//! ```

pub mod cells;
pub mod coil_job;
mod composed;
mod concealed;
mod failure;
pub mod files;
pub mod generator;
mod identified;
mod ordinary;
pub mod peers;
pub mod program;
pub mod statistics;
mod survey;
mod three_records;
mod truth;
pub mod validation;

pub use concealed::Prove;
pub use failure::Failure;
pub use identified::Identify;
pub use survey::Survey;
