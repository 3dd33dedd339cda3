//! `explain`: its arguments, and what it does with them.

use std::path::PathBuf;

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::{Error, diagnose, explain, output};

use crate::progress::Progress;
use crate::{line, read_coil};

#[derive(Args)]
pub(crate) struct Explain {
    /// Case file of the coil
    #[arg(value_name = "COIL.ron")]
    coil: PathBuf,
    /// Measured steady sensitivity in (deg/h)/(degC/min), a magnitude
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    sensitivity: f64,
    /// The measured sensitivity's sign is that of this program's conventions
    #[arg(long)]
    signed: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// No notes and no progress on standard error
    #[arg(long)]
    quiet: bool,
    /// Build the models anew and do not keep them
    #[arg(long)]
    no_cache: bool,
}

pub(crate) fn run(arguments: &Explain) -> Result<(), Error> {
    let Explain { coil, sensitivity, signed, json, quiet, no_cache } = arguments;
    let progress = if *quiet { Progress::Silent } else { Progress::OnStandardError };
    let case = if *quiet { fogcoil::input::read_coil(coil)? } else { read_coil(coil)? };
    diagnose::check_design(&case, coil)?;
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    let result = explain::explain(&case, *sensitivity, !signed, &cache, &|task| progress.note(task))?;
    output::print(&if *json { line(&explain::json(&result)) } else { explain::text(&case, &result) })
}
