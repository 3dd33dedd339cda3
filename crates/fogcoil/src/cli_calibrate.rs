//! `calibrate`: its arguments and its work.

use std::path::PathBuf;

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::input::RecordOptions;
use fogcoil::output::Content;
use fogcoil::{Error, calibrate, diagnose, input};

use files::shown;

use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Calibrate {
    /// The drawing: case file of the coil
    #[arg(value_name = "COIL.ron")]
    coil: PathBuf,
    /// Records of a good unit, with commas between them; once for every unit
    #[arg(long = "unit", value_name = "A1.csv,A2.csv", required_unless_present_any = ["each", "passed"], value_parser = records)]
    good: Vec<Records>,
    /// Good units of one record each, after the coil file, e.g. --units lot/*.csv
    #[arg(long = "units", id = "each", value_name = "A.csv", value_parser = records, num_args = 1..)]
    each: Vec<Records>,
    /// Good units of a batch, those that passed: table.csv of the folder that `fogcoil batch --out` wrote
    #[arg(long, value_name = "TABLE.csv")]
    passed: Option<PathBuf>,
    /// Write the lot's design here, a coil file
    #[arg(long, value_name = "LOT.ron")]
    out: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Facts about the records besides their columns [default: meta.ron beside each, if it is there]
    #[arg(long, value_name = "FILE")]
    meta: Option<PathBuf>,
    /// A file that says how the records are read [default: RECORD.map.ron beside each RECORD.csv, if it is there]
    #[arg(long, value_name = "FILE.ron")]
    map: Option<PathBuf>,
    /// Build the models anew and do not keep them
    #[arg(long)]
    no_cache: bool,
}

/// Records of one unit.
type Records = std::sync::Arc<[PathBuf]>;

fn records(text: &str) -> Result<Records, String> {
    let paths: Vec<PathBuf> = text.split(',').map(|path| PathBuf::from(path.trim())).collect();
    if paths.iter().any(|path| path.as_os_str().is_empty()) {
        return Err("a record has no name; write A1.csv,A2.csv".into());
    }
    Ok(paths.into())
}

pub(crate) fn run(arguments: &Calibrate, progress: &Progress) -> Result<(), Error> {
    let Calibrate { coil, good, each, passed, out, json, meta, map, no_cache } = arguments;
    let judged = passed.as_deref().map(input::read_passed).transpose()?.unwrap_or_default();
    for unit in &judged.left_out {
        progress.note(&format!(
            "{}: left out, although it passed: a warning says that what a record of it says is void",
            shown(unit)
        ));
    }
    let judged: Vec<Records> = judged.units.into_iter().map(Records::from).collect();
    let good: Vec<&Records> = good.iter().chain(each).chain(&judged).collect();
    let options = RecordOptions { map: map.clone(), meta: meta.clone(), ..RecordOptions::default() };
    let records = good.iter().flat_map(|unit| unit.iter()).flat_map(|record| options.files(record));
    let inputs: Vec<PathBuf> = records.chain(passed.clone()).collect();
    let case = progress.read_coil_for(coil, &inputs, &[Some(out)])?;
    diagnose::check_design(&case, coil)?;
    let unit = |paths: &&Records| paths.iter().map(|path| input::read_record(path, &options)).collect::<Result<Vec<_>, _>>();
    let units = progress.during("reading the records", || good.iter().map(unit).collect::<Result<Vec<_>, _>>())?;
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    let outcome = progress.tasks(|tell| calibrate::calibrate(&case, &units, &cache, tell))?;
    progress.tell(outcome.notes());
    progress.save(&[(out, Content::Text(outcome.file()?))])?;
    print(&if *json { line(&outcome.json()) } else { outcome.text() })
}
