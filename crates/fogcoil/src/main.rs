//! The command line: arguments in, exit status out. Everything else is in the library.

mod cli;
mod cli_batch;
mod cli_calibrate;
mod cli_check;
mod cli_compare;
mod cli_explain;
mod cli_homogenize;
mod cli_manual;
mod cli_measure;
mod cli_new;
mod cli_optimise;
mod cli_recommend;
mod cli_simulate;
mod cli_sweep;
mod cli_tables;
mod cli_under;
mod progress;
mod signals;

use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use crate::progress::Progress;
use clap::Parser;
use cli::{Cli, Command, Diagnose};
use cli_under::Under;
use fogcoil::cache::Cache;
use fogcoil::diagnose::{self, Written};
use fogcoil::glossary::{Note, Remark};
use fogcoil::input::{MechanismCase, RecordOptions};
use fogcoil::output::Content;
use fogcoil::{Error, identify, input, picture, sensitivity, trim, wind};

fn main() -> ExitCode {
    let cli = Cli::try_parse().unwrap_or_else(|error| refuse(&error));
    match run(&cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // nobody is left to tell if standard error is closed
            let kind = if matches!(error, Error::Limits { .. }) { "" } else { "error: " };
            let _ = writeln!(std::io::stderr().lock(), "{kind}{}", files::shown_lines(&error.to_string()));
            ExitCode::from(error.exit_code())
        }
    }
}

/// Ends the program with the message of the command line's reader, without colours where a name would give a terminal orders.
fn refuse(error: &clap::Error) -> ! {
    let text = error.render().to_string();
    let shown = files::shown_lines(&text);
    if shown == text {
        error.exit();
    }
    let _ = write!(std::io::stderr().lock(), "{shown}");
    std::process::exit(error.exit_code())
}

fn run(Cli { command, quiet, jobs }: &Cli) -> Result<(), Error> {
    let progress = &Progress::new(*quiet);
    if let Some(jobs) = jobs {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(jobs.get());
        pool.build_global().map_err(|error| Error::usage(format!("--jobs {jobs}: no such number of threads begins: {error}")))?;
    }
    match command {
        Command::Homogenize(arguments) => cli_homogenize::run(arguments, progress),
        Command::Batch(arguments) => cli_batch::run(arguments, progress),
        Command::Calibrate(arguments) => cli_calibrate::run(arguments, progress),
        Command::Check(arguments) => cli_check::run(arguments, progress),
        Command::Compare(arguments) => cli_compare::run(arguments, progress),
        Command::Completions { shell } => cli_manual::completions(*shell),
        Command::Diagnose(arguments) => run_diagnose(arguments, progress),
        Command::Explain(arguments) => cli_explain::run(arguments, progress),
        Command::Man { dir } => cli_manual::man(dir.as_deref(), progress),
        Command::Measure(arguments) => cli_measure::run(arguments, progress),
        Command::New(arguments) => cli_new::run(arguments),
        Command::Optimise(arguments) => cli_optimise::run(arguments, progress),
        Command::Recommend(arguments) => cli_recommend::run(arguments, progress),
        Command::Simulate(arguments) => cli_simulate::run(arguments, progress),
        Command::Sweep(arguments) => cli_sweep::run(arguments, progress),
        Command::Trim { coil, under, json } => run_trim(coil, under, *json, progress),
        Command::Wind { coil, csv, svg, json } => run_wind(coil, csv.as_deref(), svg.as_deref(), *json, progress),
        Command::Identify { targets, json } => {
            let case = input::read_targets(targets)?;
            let result = progress.tasks(|tell| identify::identify(&case, tell))?;
            print(&if *json { line(&identify::json(&case, &result)) } else { identify::text(&case, &result) })
        }
        Command::Sensitivity { coil, all, json } => {
            let case = progress.read_coil(coil)?;
            let result = progress.during("modelling the coil", || case.steady_sensitivity())?;
            let band = progress.during("varying it within its tolerances", || case.sensitivity_band())?;
            let object = || line(&sensitivity::json(&case, &result, &band));
            print(&if *json { object() } else { sensitivity::text(&case, &result, &band, *all) })
        }
    }
}

fn run_wind(coil: &Path, csv: Option<&Path>, svg: Option<&Path>, json: bool, progress: &Progress) -> Result<(), Error> {
    let case = progress.read_coil_for(coil, &[], &[csv, svg])?;
    let mut files = Vec::new();
    files.extend(csv.map(|path| (path, Content::Text(wind::csv(&case.winding)))));
    files.extend(svg.map(|path| (path, Content::Text(picture::svg(&case.name, &case.winding)))));
    progress.save(&files)?;
    print(&if json { line(&wind::json(&case)) } else { wind::text(&case) })
}

fn run_diagnose(arguments: &Diagnose, progress: &Progress) -> Result<(), Error> {
    let Diagnose { coil, fits, holdouts, mechanisms, without, json, prediction, model_out, report, meta, format, no_cache } =
        arguments;
    let asked = input::read_mechanisms(mechanisms)?.without(without)?;
    let options = RecordOptions { further: asked.further_columns(), ..format.options(meta.clone()) };
    let records = fits.iter().chain(holdouts).flat_map(|record| options.files(record));
    let inputs: Vec<PathBuf> = records.chain(asked.own.iter().map(|own| own.file.clone())).collect();
    let out_of = |own: &MechanismCase| Some(beside(model_out.as_deref()?, &own.mechanism.id));
    let own_out: Vec<Option<PathBuf>> = asked.own.iter().map(out_of).collect();
    let json_file = json.as_ref().and_then(Option::as_deref);
    let mut outputs = vec![json_file, prediction.as_deref(), model_out.as_deref(), report.as_deref()];
    outputs.extend(own_out.iter().map(Option::as_deref));
    let case = progress.read_coil_for(coil, &inputs, &outputs)?;
    diagnose::check_design(&case, coil)?;
    let read = |paths: &[PathBuf]| paths.iter().map(|path| input::read_record(path, &options)).collect::<Result<Vec<_>, _>>();
    let (fits, holdouts) = progress.during("reading the records", || Ok::<_, Error>((read(fits)?, read(holdouts)?)))?;
    let mechanisms = asked.with_catalogue();
    let columns = diagnose::of_columns(&fits, &holdouts, &mechanisms);
    let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
    let mut outcome = progress.tasks(|tell| diagnose::diagnose(&case, &mechanisms, &columns, &fits, &holdouts, &cache, tell))?;
    let mut files = Vec::new();
    if let Some(path) = model_out {
        let note = match progress.during("simulating the extended model", || outcome.written())? {
            Ok(Written { text, note }) => {
                files.push((path.as_path(), Content::Text(text)));
                note
            }
            Err(why) => Some(Remark::NoModel.warning(format!("nothing to write: {why}"))),
        };
        outcome.add_notes(note.map(|note| note.at(path)));
    }
    // the text that is printed begins with the warnings
    let not_in_text = |note: &&Note| *json == Some(None) || !note.is_warning();
    progress.tell(&outcome.notes().iter().filter(not_in_text).cloned().collect::<Vec<_>>());
    let object = line(&outcome.json());
    files.extend(json_file.map(|path| (path, Content::Text(object.clone()))));
    files.extend(prediction.as_deref().zip(outcome.prediction()).map(|(path, text)| (path, Content::Text(text))));
    let own: Vec<&MechanismCase> = asked.own.iter().chain(&columns).collect();
    let own_out: Vec<Option<PathBuf>> = own.iter().map(|own| out_of(own)).collect();
    for (own, path) in own.iter().zip(&own_out) {
        if let (Some(path), Some(values)) = (path, outcome.found_of(&own.mechanism.id)) {
            files.push((path, Content::Text(own.with_values(&values)?)));
        }
    }
    let laws = outcome.laws()?.into_iter();
    let laws: Vec<(PathBuf, String)> = laws.filter_map(|(id, text)| Some((beside(model_out.as_deref()?, &id), text))).collect();
    files.extend(laws.iter().map(|(path, text)| (path.as_path(), Content::Text(text.clone()))));
    let page = || progress.during("drawing the report, with the test to make next", || outcome.report());
    files.extend(report.as_deref().map(|path| (path, Content::Text(page()))));
    progress.save(&files)?;
    print(&if *json == Some(None) { object } else { outcome.text() })
}

/// `M.ID.ron` beside `M.ron`.
fn beside(model: &Path, id: &str) -> PathBuf {
    model.with_extension(format!("{id}.ron"))
}

fn run_trim(coil: &Path, under: &Under, json: bool, progress: &Progress) -> Result<(), Error> {
    let case = progress.read_coil(coil)?;
    let profile = under.read(&case)?;
    profile.iter().for_each(|profile| progress.tell(&profile.notes));
    let result = progress.during("trimming", || trim::trim(&case, profile.as_ref()))?;
    print(&if json { line(&trim::json(&result)) } else { trim::text(&case, &result) })
}

fn line(json: &serde_json::Value) -> String {
    files::shown_json(&json.to_string()) + "\n"
}

/// Writes to standard output without orders to a terminal; a reader that has left is no error.
fn print(text: &str) -> Result<(), Error> {
    let mut stdout = std::io::stdout().lock();
    let written = stdout.write_all(files::shown_lines(text).as_bytes()).and_then(|()| stdout.flush());
    written.or_else(|error| if error.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(Error::Stdout(error)) })
}
