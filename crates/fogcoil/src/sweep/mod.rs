//! `fogcoil sweep`: designs around a drawing, computed by the thousand: a table of varied keys and outputs, its statistics, and the part of a design from
//! which the spread of the sensitivity comes.
//!
//! The points follow from plan and seed alone, whatever computes them and in which order: a task is a range of points, its rows are kept in a file of
//! their own until all are there ([`Parts`]), and the table that is made of them has the same bytes on one thread, on many, after an interruption, and
//! from many machines.

mod columns;
mod course;
mod indices;
mod json;
mod outputs;
mod parts;
mod picture;
mod plan;
mod points;
mod random;
mod report;
mod row;
mod run;
mod statistics;
mod text;

pub use columns::table;
pub use indices::{Index, Indices};
pub use json::json;
pub use outputs::Output;
#[cfg(not(target_family = "wasm"))]
pub(crate) use outputs::mass;
pub use parts::Parts;
pub use picture::svg;
pub use plan::{MOST_POINTS, Plan, check_plan, read_plan};
pub use points::{Points, Sampling};
pub use report::report;
pub use row::Row;
pub use run::{Share, clear, merged, run};
pub use statistics::{Smallest, Spread, Summary};
pub use text::text;
