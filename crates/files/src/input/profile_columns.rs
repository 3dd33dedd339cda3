//! The header of a profile: drives of its columns.

use std::path::Path;

use coil::{Design, Drive, Side};

use super::InputError;
use super::record_columns::shown;
use super::record_format::RecordFormat;
use super::record_options::{Key, TIME};
use super::rows::{Rows, quoted};
use crate::note::Note;
use crate::remark::Remark;

const CHAMBER: &str = "chamber_c";

/// Columns that a profile may have, and their drives.
pub(super) const DRIVES: [(&str, Drive); 5] = [
    (CHAMBER, Drive::Chamber),
    ("left_c", Drive::EndWall(Side::Left)),
    ("right_c", Drive::EndWall(Side::Right)),
    ("mount_left_c", Drive::Mount(Side::Left)),
    ("mount_right_c", Drive::Mount(Side::Right)),
];

/// Columns of recordings and of this program's own results; a profile may have them, and they drive nothing.
pub(super) const RESULTS: [&str; 9] = [
    "spool_c",
    "shupe_deg_per_h",
    "eo_axial_deg_per_h",
    "eo_radial_deg_per_h",
    "rate_deg_per_h",
    "read_out_deg_per_h",
    "mechanisms_deg_per_h",
    "recorded_spool_c",
    "recorded_rate_deg_per_h",
];

pub(crate) struct Columns {
    pub(crate) time: usize,
    /// Those that drive, the chamber first.
    pub(crate) drives: Vec<(usize, Drive)>,
    /// Those that mechanisms' files name, in the order in which they are asked for.
    pub(crate) further: Vec<usize>,
    pub(crate) names: Vec<String>,
    ignored: Vec<String>,
}

impl Columns {
    /// Reads them from the row at which `rows` stands; a map may name those of time and chamber otherwise.
    pub(crate) fn read(rows: &Rows, map: Option<&RecordFormat>, design: &Design, further: &[String]) -> Result<Self, InputError> {
        let mapped = |key: Key| map.and_then(|format| format.column(key).name.as_deref()).unwrap_or(key.standard());
        let (time_name, chamber_name) = (mapped(Key::Time), mapped(Key::Chamber));
        let called = |drive: &'static str| if drive == CHAMBER { chamber_name } else { drive };
        let names = names(rows, "time_s,chamber_c")?;
        let mut ignored = Vec::new();
        for name in &names {
            if let Some((_, drive)) = DRIVES.iter().find(|(known, _)| called(known) == name) {
                check_drive(rows, name, *drive, design)?;
            } else if RESULTS.contains(&name.as_str()) {
                ignored.push(name.clone());
            } else if name != time_name && !further.contains(name) {
                // a map says what is meant; without one the name may be misspelt
                match map {
                    Some(_) if name.is_empty() => {}
                    Some(_) => ignored.push(name.clone()),
                    None => return Err(unknown(rows, name)),
                }
            }
        }
        let find = |wanted: &str| names.iter().position(|name| name == wanted);
        let record = if find("spool_c").is_some() { "; a record of the spool's thermometer goes to --spool" } else { "" };
        let missing = |name| {
            let remedy = match map {
                Some(_) => format!("the columns here are {}; say in the map which it is", shown(&names)),
                None => format!("a profile starts with a line {TIME},{CHAMBER}{record}"),
            };
            rows.fault(Some(name), "the column is missing", remedy)
        };
        let time = find(time_name).ok_or_else(|| missing(time_name))?;
        find(chamber_name).ok_or_else(|| missing(chamber_name))?;
        let drives = DRIVES.iter().filter_map(|(name, drive)| Some((find(called(name))?, *drive))).collect();
        let beside = |name: &String| {
            let remedy = "give it a number in each row; the law of a mechanism that is added names it";
            find(name).ok_or_else(|| rows.fault(Some(name), "the column is missing", remedy))
        };
        let further = further.iter().map(beside).collect::<Result<_, _>>()?;
        Ok(Self { time, drives, further, names, ignored })
    }

    /// Columns that are not used.
    pub(crate) fn note(&self, path: &Path) -> Option<Note> {
        let which = match self.ignored.as_slice() {
            [] => return None,
            [one] => format!("the column {one} drives nothing and is ignored"),
            more => format!("the columns {} drive nothing and are ignored", more.join(", ")),
        };
        Some(Remark::IgnoredColumn.note(which).at(path))
    }
}

/// The names of the columns, none twice.
pub(super) fn names(rows: &Rows, example: &str) -> Result<Vec<String>, InputError> {
    check_separator(rows, example)?;
    let names: Vec<String> = rows.fields().map(str::to_owned).collect();
    match (1..names.len()).find(|&i| names[..i].contains(&names[i])) {
        Some(i) => Err(rows.fault(Some(&names[i]), "the column is given twice", "remove one of the two")),
        None => Ok(names),
    }
}

fn check_separator(rows: &Rows, example: &str) -> Result<(), InputError> {
    let line = rows.fields().collect::<Vec<_>>().join(",");
    let fault = |problem: &str, remedy: &str| Err(rows.fault(None, problem, remedy));
    if line.contains(';') {
        return fault("the fields are separated by semicolons", "separate them with commas, and write decimals with a point");
    }
    if line.contains('\t') {
        return fault("the fields are separated by tabs", "separate them with commas, and write decimals with a point");
    }
    if line.contains('\r') {
        return fault("the lines end in carriage returns alone", "save the file with line feeds (Unix) or both (Windows)");
    }
    if rows.fields().all(|field| field.parse::<f64>().is_ok()) {
        return fault("the first line holds numbers, not the names of the columns", &format!("put a line {example} above it"));
    }
    Ok(())
}

/// Refuses a column that would drive nothing in this design.
fn check_drive(rows: &Rows, name: &str, drive: Drive, design: &Design) -> Result<(), InputError> {
    match drive {
        Drive::Mount(side) if design.heat.mounts.iter().all(|mount| mount.side != side) => {
            let problem = format!("the design has no mount at the side {side:?}");
            Err(rows.fault(Some(name), problem, "remove the column, or add the mount to heat.mounts of the coil file"))
        }
        Drive::EndWall(_) if design.heat.film.is_some() => {
            let problem = "the design has a film in place of the medium, so no end wall acts on it";
            Err(rows.fault(Some(name), problem, "remove the column, or heat.film_w_per_m2k from the coil file"))
        }
        _ => Ok(()),
    }
}

fn unknown(rows: &Rows, name: &str) -> InputError {
    let known: Vec<&str> = [TIME].into_iter().chain(DRIVES.iter().map(|(name, _)| *name)).collect();
    let remedy = format!("a profile has {}; {} may stand beside them and are ignored", known.join(", "), RESULTS.join(", "));
    rows.fault(None, format!("unknown column {}", quoted(name)), remedy)
}
