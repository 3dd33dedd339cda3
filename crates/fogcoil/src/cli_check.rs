//! The arguments of `check`, and the options for reading a recording.

use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;
use fogcoil::input::{Key, RecordOptions};

#[derive(Args)]
pub(crate) struct Check {
    /// Recording: time_s,chamber_c,spool_c,rate_deg_per_h, or a logger's own file with the flags below
    #[arg(value_name = "RECORD.csv")]
    pub(crate) record: PathBuf,
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
    /// Seconds between rows, for a file without instants
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
