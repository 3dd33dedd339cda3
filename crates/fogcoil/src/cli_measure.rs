//! `measure`: its arguments and its work.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::measure::{Prediction, all, measure, text, text_without_notes};
use fogcoil::{Error, input};

use crate::cli_check::Format;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Measure {
    /// Recordings, and the case file of the coil where its prediction is to stand beside them
    #[arg(value_name = "RECORD.csv|COIL.ron", required = true)]
    files: Vec<PathBuf>,
    #[command(flatten)]
    format: Format,
    /// Facts about the records besides their columns [default: meta.ron beside each, if it is there]
    #[arg(long, value_name = "FILE")]
    meta: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Measure, progress: &Progress) -> Result<(), Error> {
    let Measure { files, format, meta, json } = arguments;
    let (coils, records): (Vec<&PathBuf>, Vec<&PathBuf>) = files.iter().partition(|path| is_ron(path));
    let coil = match coils[..] {
        [] => None,
        [coil] => Some(coil),
        _ => return Err(Error::usage("more than one coil file (*.ron) is given; give one, or none")),
    };
    if records.is_empty() {
        return Err(Error::usage("no recording is given; give at least one beside the coil file"));
    }
    let options = format.options(meta.clone());
    let case = coil.map(|path| progress.read_coil(path)).transpose()?;
    let mut measured = Vec::new();
    for path in records {
        let shown = files::shown_path(path);
        let record = progress.during(&format!("reading {shown}"), || input::read_record(path, &options))?;
        measured.push(progress.during(&format!("measuring {shown}"), || measure(&record))?);
    }
    let predict = |case: &input::CoilCase| -> Result<Prediction, Error> {
        let steady = progress.during("modelling the coil", || case.steady_sensitivity())?;
        let band = progress.during("varying it within its tolerances", || case.sensitivity_band())?;
        Ok(Prediction::of(&case.name, &steady, &band))
    };
    let prediction = case.as_ref().map(predict).transpose()?;
    if *json {
        return print(&line(&all(&measured, prediction.as_ref())));
    }
    let text = if progress.is_silent() { text_without_notes } else { text };
    print(&measured.iter().map(|one| text(one, prediction.as_ref())).collect::<Vec<_>>().join("\n"))
}

fn is_ron(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ron"))
}
