//! The command line: arguments in, exit status out. Everything else is in the library.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use fogcoil::{Error, homogenize, input, output, picture, sensitivity, wind};

/// Thermal bias of fibre-optic-gyroscope coils.
#[derive(Parser)]
#[command(version, after_help = "Exit status: 0 done; 2 bad usage or input; 1 the program's own failure.")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
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
}

fn main() -> ExitCode {
    match run(&Cli::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // nobody is left to tell if standard error is closed
            let _ = writeln!(std::io::stderr().lock(), "error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(command: &Command) -> Result<(), Error> {
    match command {
        Command::Homogenize { cell, json } => {
            let case = input::read_cell(cell)?;
            let result = case.homogenize()?;
            output::print(&if *json { line(&homogenize::json(&result)) } else { homogenize::text(&case, &result) })
        }
        Command::Wind { coil, csv, svg } => run_wind(coil, csv.as_deref(), svg.as_deref()),
        Command::Sensitivity { coil, json } => {
            let case = input::read_coil(coil)?;
            let result = case.steady_sensitivity()?;
            output::print(&if *json { line(&sensitivity::json(&result)) } else { sensitivity::text(&case, &result) })
        }
    }
}

fn run_wind(coil: &Path, csv: Option<&Path>, svg: Option<&Path>) -> Result<(), Error> {
    output::check_distinct(coil, &[csv, svg])?;
    let case = input::read_coil(coil)?;
    let csv = csv.map(|path| (path, wind::csv(&case.winding)));
    let svg = svg.map(|path| (path, picture::svg(&case.name, &case.winding)));
    match (csv, svg) {
        (None, None) => output::print(&wind::text(&case)),
        (csv, svg) => output::write_files(&csv.into_iter().chain(svg).collect::<Vec<_>>()),
    }
}

fn line(json: &serde_json::Value) -> String {
    format!("{json}\n")
}
