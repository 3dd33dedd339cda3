//! `fogcoil batch`: many units of one design, each measured, diagnosed and judged by limits, and their common features.
//!
//! The finding of a unit is kept in a file of its own as soon as it is known, under the hash of design, records and program; an interrupted run goes on
//! from there. Every table and page is made of these files alone, so that it does not matter which run computed them.

mod columns;
mod doubt;
mod finding;
mod json;
mod kept;
mod limits;
mod lot;
mod report;
mod row;
mod run;
mod serials;
mod text;
mod trends;
mod units;

pub use columns::table;
pub use finding::Inputs;
pub use json::json;
pub use kept::{kept_beside, kept_files, kept_in};
pub use limits::{Judged, Limits, check_limits, read_limits};
pub use report::report;
pub use row::Row;
pub use run::{Batch, TASK, run};
pub use text::text;
pub use units::{Unit, units, without_recordings};
