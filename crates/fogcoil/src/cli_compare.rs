//! `compare`: its arguments and its work.

use std::path::PathBuf;

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::output::Content;
use fogcoil::{Error, compare};

use crate::cli_under::Under;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Compare {
    /// Case file of a coil
    #[arg(value_name = "A.ron")]
    a: PathBuf,
    /// Case file of the coil to compare it with
    #[arg(value_name = "B.ron")]
    b: PathBuf,
    #[command(flatten)]
    under: Under,
    /// Write a page with pictures side by side here
    #[arg(long, value_name = "R.html")]
    report: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Build the models anew and do not keep them
    #[arg(long)]
    no_cache: bool,
}

pub(crate) fn run(arguments: &Compare, progress: &Progress) -> Result<(), Error> {
    let Compare { a, b, under, report, json, no_cache } = arguments;
    let inputs: Vec<PathBuf> = [b.clone()].into_iter().chain(under.files()).collect();
    let outputs = [report.as_deref()];
    let case_a = progress.read_coil_for(a, &inputs, &outputs)?;
    let case_b = progress.read_coil_for(b, &[], &outputs)?;
    let [of_a, of_b] = [under.read(&case_a)?, under.read(&case_b)?];
    let profiles = of_a.zip(of_b).map(|(a, b)| [a, b]);
    profiles.iter().for_each(|[a, _]| progress.tell(&a.notes));
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    let compared = progress.tasks(|tell| compare::compare([&case_a, &case_b], profiles.as_ref(), &cache, tell))?;
    let page = |path| (path, Content::Text(compare::report(&compared)));
    progress.save(&report.as_deref().map(page).into_iter().collect::<Vec<_>>())?;
    print(&if *json { line(&compare::json(&compared)) } else { compare::text(&compared) })
}
