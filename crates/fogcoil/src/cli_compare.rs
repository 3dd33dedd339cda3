//! `compare`: its arguments and its work.

use std::path::PathBuf;

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::output::Content;
use fogcoil::{Error, compare, input};

use crate::progress::Progress;
use crate::{divide, line, print};

#[derive(Args)]
pub(crate) struct Compare {
    /// Case file of a coil
    #[arg(value_name = "A.ron")]
    a: PathBuf,
    /// Case file of the coil to compare it with
    #[arg(value_name = "B.ron")]
    b: PathBuf,
    /// Profile under which to compare their bias, e.g. fixtures/profiles/paper.csv
    #[arg(long, value_name = "P.csv")]
    profile: Option<PathBuf>,
    /// Add a row every S seconds from the first row, on the straight lines between the profile's own
    #[arg(long, value_name = "S", value_parser = crate::cli_simulate::step, requires = "profile")]
    step: Option<f64>,
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
    let Compare { a, b, profile, step, report, json, no_cache } = arguments;
    let inputs: Vec<PathBuf> = [b].into_iter().chain(profile).cloned().collect();
    let outputs = [report.as_deref()];
    let case_a = progress.read_coil_for(a, &inputs, &outputs)?;
    let case_b = progress.read_coil_for(b, &[], &outputs)?;
    let read = |path: &PathBuf| -> Result<_, Error> {
        let of = |case: &input::CoilCase| input::read_profile(path, &case.design, &[]);
        let mut profiles = [of(&case_a)?, of(&case_b)?];
        profiles.iter_mut().try_for_each(|profile| divide(profile, *step))?;
        progress.tell(&profiles[0].notes);
        Ok(profiles)
    };
    let profiles = profile.as_ref().map(read).transpose()?;
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    let compared = progress.tasks(|tell| compare::compare([&case_a, &case_b], profiles.as_ref(), &cache, tell))?;
    let page = |path| (path, Content::Text(compare::report(&compared)));
    progress.save(&report.as_deref().map(page).into_iter().collect::<Vec<_>>())?;
    print(&if *json { line(&compare::json(&compared)) } else { compare::text(&compared) })
}
