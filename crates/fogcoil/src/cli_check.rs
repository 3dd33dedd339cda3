//! `check`: its arguments and its work; and the options for reading a recording.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::Args;
use fogcoil::input::{InputError, Key, RecordOptions, recordings_without_profiles};
use fogcoil::output::Content;
use fogcoil::{Error, check, input, output};
use serde_json::json;

use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Check {
    /// Recordings: time_s,chamber_c,spool_c,rate_deg_per_h, or a logger's own files with the flags below; of a folder its *.csv and those of its folders, without profiles
    #[arg(value_name = "RECORD.csv|FOLDER", required = true)]
    pub(crate) records: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) format: Format,
    /// Facts about the record besides its columns [default: meta.ron beside it, if it is there]
    #[arg(long, value_name = "FILE")]
    pub(crate) meta: Option<PathBuf>,
    /// Propose a map file for reading the recording, write it, and check the recording so read [default: RECORD.map.ron beside it]
    #[arg(long, value_name = "FILE.map.ron", num_args = 0..=1, conflicts_with = "map")]
    pub(crate) write_map: Option<Option<PathBuf>>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the Allan deviation here
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
}

pub(crate) fn run(arguments: &Check, progress: &Progress) -> Result<(), Error> {
    let Check { records, format, meta, write_map, json, svg } = arguments;
    let options = format.options(meta.clone());
    let (records, left_out) = recordings_without_profiles(records, &options)?;
    progress.tell(&left_out);
    match &records[..] {
        [record] => one(record, &options, arguments, progress),
        _ if write_map.is_some() || svg.is_some() => Err(Error::usage(
            "--write-map and --svg are of one recording; give one: its map serves all of them with --map FILE.map.ron, here and in every other command",
        )),
        all => several(all, &options, *json, progress),
    }
}

fn one(record: &Path, options: &RecordOptions, arguments: &Check, progress: &Progress) -> Result<(), Error> {
    let Check { write_map, json, svg, .. } = arguments;
    let map = write_map.as_ref().map(|path| path.clone().unwrap_or_else(|| record.with_extension("map.ron")));
    progress.reads(&options.files(record).into_iter().chain(map.clone()).collect::<Vec<_>>(), &[svg.as_deref()])?;
    let reading = format!("reading {}", files::shown_path(record));
    let case = match map {
        None => progress.during(&reading, || input::read_record(record, options))?,
        Some(path) => {
            let proposed = progress.during(&reading, || input::propose_map(record, options))?;
            output::write_new(&path, &proposed.text)?;
            progress.note(&format!("{} is written", files::shown_path(&path)));
            proposed.case.map_err(|missing| unchosen(record, &path, &missing))?
        }
    };
    let analysis = progress.during("identifying the noise", || check::Analysis::new(&case));
    print(&match (json, progress.is_silent()) {
        (true, _) => line(&check::json(&analysis)),
        (false, true) => check::text_without_notes(&analysis),
        (false, false) => check::text(&analysis),
    })?;
    case.require_usable()?;
    match (svg, check::svg(&analysis)) {
        (Some(path), Some(picture)) => progress.save(&[(path, Content::Text(picture))]),
        (Some(path), None) => Err(Error::usage(format!("{}: there is no Allan deviation to draw", files::shown_path(path)))),
        (None, _) => Ok(()),
    }
}

/// The complaint about columns that are still to be chosen in a map.
fn unchosen(record: &Path, map: &Path, missing: &[&str]) -> InputError {
    let problem = format!("no column's name says that it is the {}", missing.join(", nor one that it is the "));
    let remedy = format!(
        "{} lists what may be it: take the // from the line that is right, give its unit, and check again without --write-map",
        files::shown_path(map)
    );
    InputError::whole(record, problem, remedy)
}

/// A line for each; one that cannot be used does not keep the others from being checked.
fn several(records: &[PathBuf], options: &RecordOptions, as_json: bool, progress: &Progress) -> Result<(), Error> {
    let (mut lines, mut objects, mut bad) = (Vec::new(), Vec::new(), 0);
    for record in records {
        let checked = progress.during(&format!("checking {}", files::shown_path(record)), || {
            let case = input::read_record(record, options)?;
            let analysis = check::Analysis::new(&case);
            Ok::<_, Error>((analysis.line(), check::json(&analysis), case.report.usable()))
        });
        let (line, object, usable) = checked.unwrap_or_else(|error| {
            let why = error.to_string();
            (
                check::unreadable(record, &why),
                json!({"file": record.display().to_string(), "usable": false, "problem": why}),
                false,
            )
        });
        bad += usize::from(!usable);
        lines.push(line);
        objects.push(object);
    }
    print(&if as_json { line(&json!({"records": objects})) } else { check::several(&lines) })?;
    if bad == 0 { Ok(()) } else { Err(Error::usage(format!("{bad} of {} recordings cannot be used", records.len()))) }
}

/// Options for reading a logger's file.
#[derive(Args, Clone)]
pub(crate) struct Format {
    /// A file in place of the flags below [default: RECORD.map.ron beside RECORD.csv, if it is there]
    #[arg(long, value_name = "FILE.ron")]
    map: Option<PathBuf>,
    /// Name of a column in the file; KEY is time, chamber, spool or rate
    #[arg(long = "column", value_name = "KEY=NAME", value_parser = pair::<String>)]
    columns: Vec<(Key, String)>,
    /// Unit of a column: s, ms, us, ns, min, h, d; degC, K, degF; deg/h, deg/s, mdeg/s, rad/s, mrad/s, urad/s (dates need none)
    #[arg(long = "unit", value_name = "KEY=UNIT", value_parser = pair::<String>)]
    units: Vec<(Key, String)>,
    /// Units in a count, for a column of counts
    #[arg(long = "scale", value_name = "KEY=FACTOR", value_parser = pair::<f64>)]
    scales: Vec<(Key, f64)>,
    /// Separator of the fields: a character such as ';', or tab
    #[arg(long, value_name = "CHAR")]
    separator: Option<String>,
    /// Numbers are written like 20,5
    #[arg(long)]
    decimal_comma: bool,
    /// Seconds between rows, for a file without instants, or in place of its clock
    #[arg(long, value_name = "S")]
    interval: Option<f64>,
    /// Column of the time of day, where the column of instants holds the date alone
    #[arg(long, value_name = "NAME")]
    time_of_day: Option<String>,
}

impl Format {
    pub(crate) fn options(&self, meta: Option<PathBuf>) -> RecordOptions {
        let Self { map, columns, units, scales, separator, decimal_comma, interval, time_of_day } = self.clone();
        RecordOptions { map, meta, columns, units, scales, separator, decimal_comma, interval, time_of_day, further: Vec::new() }
    }
}

fn pair<T: FromStr>(text: &str) -> Result<(Key, T), String>
where
    T::Err: std::fmt::Display,
{
    let (key, value) = text.split_once('=').ok_or("write it as KEY=VALUE")?;
    Ok((key.parse()?, value.parse().map_err(|error| format!("`{value}`: {error}"))?))
}
