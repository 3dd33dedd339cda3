//! `identify`: its arguments, and what it does with them.

use std::path::PathBuf;

use clap::Args;
use fogcoil::{Error, identify, input};

use crate::line;
use crate::print::print;
use crate::progress::Progress;

#[derive(Args)]
pub(crate) struct Identify {
    /// Measured effective constants and the cells to try, e.g. fixtures/identify/table-one.ron
    #[arg(value_name = "TARGETS.ron")]
    targets: PathBuf,
    /// Print one JSON object, in SI
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Identify, progress: &Progress) -> Result<(), Error> {
    let Identify { targets, json } = arguments;
    let case = input::read_targets(targets)?;
    let result = progress.tasks(|tell| identify::identify(&case, tell))?;
    print(&if *json { line(&identify::json(&case, &result)) } else { identify::text(&case, &result) })
}
