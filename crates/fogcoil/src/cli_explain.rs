//! `explain`: its arguments and its work.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::{Error, diagnose, explain, glossary, input, shown_path};

use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Explain {
    /// Id of a mechanism, a verdict, a warning or a note, or the file of a mechanism of your own; with --sensitivity the case file of a coil; without
    /// either all ids are listed
    #[arg(value_name = "ID|COIL.ron", required_if_eq("signed", "true"))]
    subject: Option<PathBuf>,
    /// Measured steady sensitivity in (deg/h)/(degC/min): a magnitude, or negative, with the sign of this program's conventions
    #[arg(long, value_name = "S", allow_negative_numbers = true, requires = "subject")]
    sensitivity: Option<f64>,
    /// A positive sensitivity is no magnitude, but has the sign of this program's conventions, too
    #[arg(long, requires = "sensitivity")]
    signed: bool,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    /// Build the models anew and do not keep them
    #[arg(long)]
    no_cache: bool,
}

pub(crate) fn run(arguments: &Explain, progress: &Progress) -> Result<(), Error> {
    let Explain { subject, sensitivity, signed, json, no_cache } = arguments;
    let (object, text) = match (subject, sensitivity) {
        (Some(coil), Some(measured)) => {
            let case = progress.read_coil(coil)?;
            diagnose::check_design(&case, coil)?;
            let cache = if *no_cache { Cache::NONE } else { Cache::of_user() };
            let result = progress.tasks(|tell| explain::explain(&case, *measured, !signed, &cache, tell))?;
            (explain::json(&result), explain::text(&case, &result))
        }
        (Some(file), None) if file.is_file() && file.extension().is_some_and(|end| end == "ron" || end == "json") => {
            if input::is_coil(file) {
                let text =
                    "is a coil file; add --sensitivity S, as it was measured, and the changes that would give it are explained";
                return Err(Error::usage(format!("{}: {text}", shown_path(file))));
            }
            let case = input::read_mechanism(file)?;
            (glossary::own_json(&case), glossary::own_text(&case))
        }
        (Some(id), None) => {
            let entry = look_up(id)?;
            (entry.json(), entry.text())
        }
        (None, _) => (glossary::list_json(), glossary::list()),
    };
    print(&if *json { line(&object) } else { text })
}

fn look_up(id: &Path) -> Result<glossary::Entry, Error> {
    let name = shown_path(id);
    glossary::look_up(&id.to_string_lossy()).map_err(|near| {
        if id.exists() {
            let text =
                "give an id, a mechanism's file (*.ron or *.json), or a coil's with --sensitivity S; `fogcoil check` reads recordings";
            return Error::usage(format!("{name}: is no mechanism's file; {text}"));
        }
        let near = if near.is_empty() { String::new() } else { format!("; nearest: {}", near.join(", ")) };
        let none = if id.extension().is_some() { "no file, and no id" } else { "no id" };
        Error::usage(format!("{name}: is {none} of a mechanism, a warning or a note{near}; `fogcoil explain` lists all"))
    })
}
