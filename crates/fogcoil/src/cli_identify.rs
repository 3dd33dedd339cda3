//! `identify`: its arguments, and what it does with them.

use std::path::PathBuf;

use clap::Args;
use fogcoil::{Error, identify, input, output};

use crate::line;
use crate::progress::Progress;

#[derive(Args)]
pub(crate) struct Identify {
    /// Measured effective constants and the cells to try, e.g. fixtures/identify/table-one.ron
    #[arg(value_name = "TARGETS.ron")]
    targets: PathBuf,
    /// Print one JSON object, in SI
    #[arg(long)]
    json: bool,
    /// No progress on standard error
    #[arg(long)]
    quiet: bool,
}

pub(crate) fn run(arguments: &Identify) -> Result<(), Error> {
    let Identify { targets, json, quiet } = arguments;
    let progress = if *quiet { Progress::Silent } else { Progress::OnStandardError };
    let case = input::read_targets(targets)?;
    let result = identify::identify(&case, &|task| progress.note(task))?;
    output::print(&if *json { line(&identify::json(&case, &result)) } else { identify::text(&case, &result) })
}
