//! `fogcoil optimise`: designs with the least of what a plan names (sensitivity, its spread by tolerances, their worst, mass, length), within limits, over
//! numbers and choices of a coil file; the front where several are weighed; the optimum checked by the full model, and explained.
//!
//! Every combination of choices is tried at points of a Sobol' sequence; from the best of them the Nelder–Mead method goes on, once for each weighing of what is
//! minimised. All designs that were tried are kept: the front is those of which none is better in everything.

mod check;
mod columns;
mod evaluate;
mod front;
mod json;
mod measure;
mod picture;
mod plan;
mod report;
mod search;
mod text;
mod weigh;

pub use check::{Checked, check};
pub use columns::table;
pub use evaluate::Tried;
pub use front::front;
pub use json::json;
pub use measure::{Measure, Measures};
pub use picture::svg;
pub use plan::{Plan, check_plan, read_plan};
pub use report::report;
pub use search::{Found, search};
pub use text::text;
