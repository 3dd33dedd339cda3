//! Common parts of the examples on real recordings: a nominal model names its quantities and places, all small laws are offered to it, and the
//! composed laws are judged on held-out records, beside least squares and a network.

#![allow(dead_code, reason = "each example and test uses its part")]

pub(crate) mod cascade;
pub(crate) mod cell;
pub(crate) mod chart;
pub(crate) mod control;
pub(crate) mod heaters;
pub(crate) mod law;
pub(crate) mod load;
pub(crate) mod network;
pub(crate) mod noise;
pub(crate) mod offered;
pub(crate) mod picture;
pub(crate) mod plant;
pub(crate) mod ramp;
pub(crate) mod rate_sensor;
pub(crate) mod report;
pub(crate) mod shapes;
pub(crate) mod study;
pub(crate) mod table;

use std::error::Error;
use std::process::ExitCode;

/// The status of a program, its error told in a sentence.
#[allow(clippy::print_stderr, reason = "of programs")]
pub(crate) fn told(result: Result<(), Box<dyn Error>>) -> ExitCode {
    let Err(error) = result else { return ExitCode::SUCCESS };
    eprintln!("error: {error}");
    ExitCode::FAILURE
}
