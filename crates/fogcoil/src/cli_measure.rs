//! `measure`: its arguments and its work.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::input::recordings_without_profiles;
use fogcoil::measure::{Prediction, all, measure, several, text, text_without_notes};
use fogcoil::{Error, input};

use crate::cli_check::Format;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Measure {
    /// Recordings, of several a line each; of a folder its *.csv and those of its folders, without profiles; and the case file of the coil where its prediction is to stand beside them
    #[arg(value_name = "RECORD.csv|FOLDER|COIL.ron", required = true)]
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
    let (coils, records): (Vec<PathBuf>, Vec<PathBuf>) = files.iter().cloned().partition(|path| is_ron(path));
    let coil = match &coils[..] {
        [] => None,
        [coil] => Some(coil),
        _ => return Err(Error::usage("more than one coil file (*.ron) is given; give one, or none")),
    };
    if records.is_empty() {
        return Err(Error::usage("no recording is given; give at least one beside the coil file"));
    }
    let options = format.options(meta.clone());
    let (records, left_out) = recordings_without_profiles(&records, &options)?;
    progress.tell(&left_out);
    let case = coil.map(|path| progress.read_coil(path)).transpose()?;
    let mut measured = Vec::new();
    for path in &records {
        let shown = files::shown_path(path);
        let one = progress.during(&format!("reading {shown}"), || input::read_record(path, &options));
        let one =
            one.map_err(Error::from).and_then(|record| Ok(progress.during(&format!("measuring {shown}"), || measure(&record))?));
        measured.push(match one {
            // one of several that cannot be used does not keep the others from being measured
            Err(error) if records.len() > 1 => Err((path.clone(), error)),
            one => Ok(one?),
        });
    }
    let predict = |case: &input::CoilCase| -> Result<Prediction, Error> {
        let steady = progress.during("modelling the coil", || case.steady_sensitivity())?;
        let band = progress.during("varying it within its tolerances", || case.sensitivity_band())?;
        Ok(Prediction::of(&case.name, &steady, &band))
    };
    let prediction = case.as_ref().map(predict).transpose()?;
    let prediction = prediction.as_ref();
    for one in measured.iter_mut().flatten() {
        // a warning comes before the notes
        let doubt = prediction.and_then(|prediction| prediction.other_unit(one));
        one.notes.splice(0..0, doubt);
    }
    print(&match &measured[..] {
        _ if *json => line(&all(&measured, prediction)),
        [Ok(measured)] if progress.is_silent() => text_without_notes(measured, prediction),
        [Ok(measured)] => text(measured, prediction),
        _ => several(&measured, prediction),
    })?;
    match measured.iter().filter(|one| one.is_err()).count() {
        0 => Ok(()),
        bad => Err(Error::usage(format!("{bad} of {} recordings cannot be used", measured.len()))),
    }
}

fn is_ron(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("ron"))
}
