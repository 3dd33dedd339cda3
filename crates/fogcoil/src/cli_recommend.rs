//! `recommend`: its arguments and its work.

use std::path::PathBuf;

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::input::RecordOptions;
use fogcoil::output::Content;
use fogcoil::recommend::Limits;
use fogcoil::{Error, diagnose, input, recommend};

use crate::cli_check::Format;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Recommend {
    /// Case file of the coil
    #[arg(value_name = "COIL.ron")]
    coil: PathBuf,
    /// Mechanisms to tell apart; `nominal` and `recalibrate` may stand among them
    #[arg(long, value_name = "ID,ID,...", value_delimiter = ',', value_parser = id, required = true)]
    between: Vec<String>,
    /// A mechanism of your own, or the id of one that is weighed on request: its id may then stand in --between; may be given more than once
    #[arg(long = "mechanism", value_name = "MECHANISM.ron|ID")]
    mechanisms: Vec<PathBuf>,
    /// Record of the unit: gives sizes, noise, and the test that a repeat would repeat; may be given more than once
    #[arg(long = "from", value_name = "A.csv")]
    records: Vec<PathBuf>,
    /// Lowest chamber temperature in degC
    #[arg(long, value_name = "C", default_value_t = Limits::USUAL.coldest, allow_negative_numbers = true)]
    coldest: f64,
    /// Highest chamber temperature in degC
    #[arg(long, value_name = "C", default_value_t = Limits::USUAL.hottest, allow_negative_numbers = true)]
    hottest: f64,
    /// Fastest change of the chamber in K/min
    #[arg(long, value_name = "K/MIN", default_value_t = Limits::USUAL.fastest)]
    fastest: f64,
    /// Length of the test in h
    #[arg(long, value_name = "H", default_value_t = Limits::USUAL.hours)]
    hours: f64,
    /// Write the recommended profile here, time_s,chamber_c, as `simulate` reads it
    #[arg(long, value_name = "P.csv")]
    out: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Facts about the records besides their columns [default: meta.ron beside each, if it is there]
    #[arg(long, value_name = "FILE")]
    meta: Option<PathBuf>,
    #[command(flatten)]
    format: Format,
    /// Build the models anew and do not keep them
    #[arg(long)]
    no_cache: bool,
}

/// An id as it is meant: a list may have spaces behind its commas.
fn id(text: &str) -> Result<String, std::convert::Infallible> {
    Ok(text.trim().to_owned())
}

pub(crate) fn run(arguments: &Recommend, progress: &Progress) -> Result<(), Error> {
    let Recommend { coil, between, mechanisms, records, coldest, hottest, fastest, hours, out, json, meta, format, no_cache } =
        arguments;
    let asked = input::read_mechanisms(mechanisms)?;
    let options = RecordOptions { further: asked.further_columns(), ..format.options(meta.clone()) };
    let inputs: Vec<PathBuf> =
        records.iter().flat_map(|record| options.files(record)).chain(asked.own.iter().map(|own| own.file.clone())).collect();
    let case = progress.read_coil_for(coil, &inputs, &[out.as_deref()])?;
    diagnose::check_design(&case, coil)?;
    let records = records.iter().map(|path| input::read_record(path, &options)).collect::<Result<Vec<_>, _>>()?;
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    progress.tell(&recommend::notes(&case, &records));
    let limits = Limits { coldest: *coldest, hottest: *hottest, fastest: *fastest, hours: *hours };
    let result =
        progress.tasks(|tell| recommend::recommend(&case, &asked.with_catalogue(), between, &records, &limits, &cache, tell))?;
    if let Some(path) = out {
        progress.save(&[(path, Content::Text(result.profiles[0].programme.csv()))])?;
        if let Some(caveat) = recommend::caveat(&result, &files::shown_path(path)) {
            progress.note(&caveat);
        }
    }
    print(&if *json { line(&recommend::json(&result)) } else { recommend::text(&result) })
}
