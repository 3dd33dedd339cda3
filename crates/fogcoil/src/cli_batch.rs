//! `batch`: its arguments and its work.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::batch::{
    self, Batch, Inputs, Unit, json, kept_beside, kept_files, kept_in, read_limits, report, table, text, units,
    without_recordings,
};
use fogcoil::cache::Cache;
use fogcoil::input::{self, RecordOptions};
use fogcoil::measure::Prediction;
use fogcoil::tabular::Format;
use fogcoil::{Error, diagnose};

use crate::cli_tables::Tables;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct BatchOf {
    /// Case file of the coil: the drawing, or a lot's design (`fogcoil calibrate`)
    #[arg(value_name = "COIL.ron")]
    coil: PathBuf,
    /// A recording, or a folder with the recordings (*.csv) of one unit, of which holdout*.csv judge; or a folder of such folders
    #[arg(value_name = "RECORD.csv|FOLDER", required = true)]
    records: Vec<PathBuf>,
    /// Limits that every unit must keep (`fogcoil new --kind limits`); exit status 1 unless all are known to do so
    #[arg(long, value_name = "LIMITS.ron")]
    limits: Option<PathBuf>,
    /// Write table.csv, table.parquet, table.xlsx, report.html and units/ here; an interrupted run goes on from what is there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Print the table as one JSON object
    #[arg(long)]
    json: bool,
    /// A mechanism of your own beside the program's, or the id of one that is weighed on request; may be given more than once
    #[arg(long = "mechanism", value_name = "MECHANISM.ron|ID")]
    mechanisms: Vec<PathBuf>,
    /// Id of a mechanism that the units are known not to have; may be given more than once
    #[arg(long, value_name = "ID")]
    without: Vec<String>,
    /// Facts about the records besides their columns [default: meta.ron beside each, if it is there]
    #[arg(long, value_name = "FILE")]
    meta: Option<PathBuf>,
    /// A file that says how the records are read [default: RECORD.map.ron beside each RECORD.csv, if it is there]
    #[arg(long, value_name = "FILE.ron")]
    map: Option<PathBuf>,
}

/// Records from which it is said that all those in a folder are of one unit.
const MANY: usize = 5;

pub(crate) fn run(arguments: &BatchOf, progress: &Progress) -> Result<(), Error> {
    let BatchOf { coil, records, limits, out, json: as_json, mechanisms, without, meta, map } = arguments;
    let asked = input::read_mechanisms(mechanisms)?.without(without)?;
    let further = asked.further_columns();
    let options = RecordOptions { map: map.clone(), meta: meta.clone(), further, ..RecordOptions::default() };
    let units = units(records, out)?;
    for unit in units.iter().filter(|unit| unit.records() >= MANY) {
        let (name, records) = (&unit.name, unit.records());
        progress.note(&format!(
            "the {records} records in {name} are taken for those of one unit; give the files themselves if each is a unit"
        ));
    }
    for folder in without_recordings(records, out)? {
        progress.note(&format!("{} has no recording (*.csv) and is no unit: are its files missing?", files::shown_path(&folder)));
    }
    let others = kept_beside(out, &units);
    if let Some(first) = others.first() {
        let (count, folder) = (others.len(), files::shown_path(&kept_in(out)));
        progress.note(&format!(
            "units that this table does not hold are kept in {folder}: {count}, {first} the first; give all units together if it should hold them"
        ));
    }
    let limits = limits.as_deref().map(read_limits).transpose()?;
    let all = units.iter().flat_map(|unit| unit.fits.iter().chain(&unit.holdouts)).flat_map(|record| options.files(record));
    let mut inputs: Vec<PathBuf> = all.chain(asked.own.iter().map(|own| own.file.clone())).collect();
    inputs.extend(limits.iter().map(|limits| limits.fingerprint.file.clone()));
    let tables = Tables::within(out, &[Format::Csv, Format::Parquet, Format::Xlsx]);
    let outputs = places(&tables, out, &units);
    let case = progress.read_coil_for(coil, &inputs, &outputs.iter().map(|path| Some(path.as_path())).collect::<Vec<_>>())?;
    diagnose::check_design(&case, coil)?;
    let prediction = progress.during("modelling the coil", || {
        let (steady, band) = (case.steady_sensitivity()?, case.sensitivity_band()?);
        Ok::<_, Error>(Prediction::of(&case.name, &steady, &band))
    })?;
    let inputs = Inputs { case: &case, asked: &asked, options: &options, cache: &Cache::of_user(), prediction: &prediction };
    progress.keeps(&kept_in(out), "units", batch::TASK);
    let batch = progress.tasks(|tell| batch::run(&inputs, &units, limits.as_ref(), out, tell))?;
    tables.save(&table(&batch), || report(&inputs, limits.as_ref(), &batch), Vec::new(), progress)?;
    print(&if *as_json { line(&json(&batch)) } else { text(&batch) })?;
    judged(&batch)
}

/// All files that may be written into an existing folder, those of units where an earlier run kept them; the path itself where it is no folder.
fn places(tables: &Tables, out: &Path, units: &[Unit]) -> Vec<PathBuf> {
    if !out.is_dir() {
        return out.exists().then(|| out.to_owned()).into_iter().collect();
    }
    let kept = kept_files(out, units).into_iter().filter(|file| file.exists());
    tables.files().map(Path::to_owned).chain(kept).collect()
}

/// Bad input comes before failing units.
fn judged(batch: &Batch) -> Result<(), Error> {
    if let Some((unit, problem)) = batch.problems().next() {
        let count = batch.problems().count();
        return Err(Error::usage(format!("{count} of {} units are not diagnosed; {unit}: {problem}", batch.rows.len())));
    }
    let (failing, not_known, units) = (batch.failing(), batch.not_known(), batch.rows.len());
    if failing + not_known == 0 { Ok(()) } else { Err(Error::Limits { failing, not_known, units }) }
}
