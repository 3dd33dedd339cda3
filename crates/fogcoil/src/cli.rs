//! The arguments.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Thermal bias of fibre-optic-gyroscope coils.
#[derive(Parser)]
#[command(version, after_help = "Exit status: 0 done; 2 bad usage or input; 1 the program's own failure.")]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Effective constants and the M row of a fibre's cell
    Homogenize {
        /// Case file of the cell
        #[arg(value_name = "CELL.ron")]
        cell: PathBuf,
        /// Print one JSON object, in SI
        #[arg(long)]
        json: bool,
    },
    /// Turn table and cross-section picture; without flags a summary
    Wind {
        /// Case file of the coil
        #[arg(value_name = "COIL.ron")]
        coil: PathBuf,
        /// Write the turn table here
        #[arg(long, value_name = "FILE")]
        csv: Option<PathBuf>,
        /// Draw the cross-section here
        #[arg(long, value_name = "FILE")]
        svg: Option<PathBuf>,
    },
    /// Steady-ramp sensitivity in (deg/h)/(degC/min), by part
    Sensitivity {
        /// Case file of the coil
        #[arg(value_name = "COIL.ron")]
        coil: PathBuf,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Tail lengths, or turns to cut off, that null the steady sensitivity, and how surely
    Trim {
        /// Case file of the coil
        #[arg(value_name = "COIL.ron")]
        coil: PathBuf,
        /// Profile under which to show what remains, e.g. fixtures/profiles/paper.csv
        #[arg(long, value_name = "P.csv")]
        profile: Option<PathBuf>,
        /// Print one JSON object
        #[arg(long)]
        json: bool,
    },
    /// Thermometer and bias in time under a profile of the chamber's temperature
    Simulate(Simulate),
}

#[derive(Args)]
pub(crate) struct Simulate {
    /// Case file of the coil
    #[arg(value_name = "COIL.ron")]
    pub(crate) coil: PathBuf,
    /// Profile: time_s,chamber_c and, where wanted, left_c, right_c, mount_left_c, mount_right_c
    #[arg(long, value_name = "P.csv")]
    pub(crate) profile: PathBuf,
    /// Write the result here, a row for each of the profile's
    #[arg(long, value_name = "B.csv")]
    pub(crate) out: PathBuf,
    /// Write a page with plots here
    #[arg(long, value_name = "R.html")]
    pub(crate) report: Option<PathBuf>,
    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// No notes and no progress on standard error
    #[arg(long)]
    pub(crate) quiet: bool,
}
