#![doc = include_str!("../README.md")]

pub mod allan;
pub mod check;
pub mod condition;
mod corners;
mod error;
pub mod lag;
pub mod lines;
pub mod minimise;
pub mod noise;
pub mod ramp;
mod record;
mod seconds;
mod series;
pub mod smooth;
pub mod statistics;

pub use error::Error;
pub use record::{Channel, Recording, Sampling};
pub use seconds::Seconds;
pub use series::median_interval;
