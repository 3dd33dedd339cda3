//! `cargo xtask bench`: times beside errors, against other programs and against the full model. Each subcommand prints a table and
//! rewrites its section of docs/benchmarks.md.

mod batch;
mod cell;
mod coil;
mod diagnose;
mod parametric;
mod publish;
mod reduced;
mod sensitivity;

use clap::{Args, Subcommand};
use proof::Failure;
use std::path::PathBuf;

/// Fewest repetitions from which a median is taken.
const FEWEST: u64 = 3;

/// Options of a comparison with other programs.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// A Python with the other programs' packages; without it they are skipped
    #[arg(long = "peers-python", value_name = "PATH", env = "FOGCOIL_PEERS_PYTHON", value_parser = file)]
    python: Option<PathBuf>,
    /// Runs of which the median is taken
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(FEWEST..))]
    repetitions: Option<u64>,
}

fn file(path: &str) -> Result<PathBuf, String> {
    Some(PathBuf::from(path)).filter(|path| path.is_file()).ok_or_else(|| "no such file".into())
}

/// The benchmarks.
#[derive(Debug, Subcommand)]
pub(crate) enum Bench {
    /// Thirty records of a production to one table and page
    Batch,
    /// The reference cell, ours and the other programs'
    Cell(Options),
    /// The reference cell, ours alone
    #[command(hide = true)]
    CellJob { name: String },
    /// The coil job, ours and the other programs'
    Coil(Options),
    /// The coil job, ours alone under a named setting
    #[command(hide = true)]
    CoilJob { name: String },
    /// Whole diagnoses
    Diagnose,
    /// The parametric against the full model, at random points of the boxes of three designs
    ///
    /// Exit status 1 if it is not as near or as fast as it must be.
    Parametric {
        /// Points of each box
        #[arg(long, value_name = "N", default_value_t = 200)]
        points: usize,
    },
    /// The reduced against the full model
    Reduced,
    /// The steady sensitivity, ours and NGSolve's
    Sensitivity(Options),
}

impl Bench {
    /// Runs it; whether all is as it must be.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        match self {
            Self::Batch => batch::run()?,
            Self::Cell(options) => cell::run(options.python.as_deref(), options.repetitions.unwrap_or(11))?,
            Self::CellJob { name } => cell::child(name)?,
            Self::Coil(options) => coil::run(options.python.as_deref(), options.repetitions.unwrap_or(FEWEST))?,
            Self::CoilJob { name } => coil::child(name)?,
            Self::Diagnose => diagnose::run()?,
            Self::Parametric { points } => return parametric::run(*points),
            Self::Reduced => reduced::run()?,
            Self::Sensitivity(options) => sensitivity::run(options.python.as_deref(), options.repetitions.unwrap_or(21))?,
        }
        Ok(true)
    }
}
