#![doc = include_str!("../README.md")]

mod expression;
mod fault;
mod parse;
mod shown;
mod system;
mod unit;

pub use expression::Expression;
pub use fault::Fault;
pub use parse::check_name;
pub use system::{Run, State, System};
pub use unit::Unit;
