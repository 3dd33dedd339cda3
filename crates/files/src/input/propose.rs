//! A map file for a logger's recording, from what the recording looks like.

use std::path::Path;

use super::encoding::Encoding;
use super::map_file::MapFile;
use super::record::{self, RecordCase};
use super::record_format::RecordFormat;
use super::record_options::{Key, RecordOptions};
use super::rows::quoted;
use super::sniff::{Sniffed, sniff};
use super::sniff_columns::{Found, find};
use super::timestamp;
use crate::Error;

/// A map file for a recording, `RECORD.map.ron`: its content, and the recording as it is read with it.
///
/// What `options` say wins over what the file looks like.
///
/// # Errors
/// As [`read_record`](super::read_record), and if the file shows no table.
pub fn propose_map(path: &Path, options: &RecordOptions) -> Result<(String, RecordCase), Error> {
    let table = sniff(path)?;
    let (mut map, doubts) = proposed(&table);
    map.declare(options);
    let mut format = RecordFormat::of(&map).map_err(|(field, problem)| Error::Usage(format!("{field}: {problem}")))?;
    format.declare(options).map_err(Error::Usage)?;
    let case = record::read_as(path, &format, options)?;
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let heading = format!("How {} is read, proposed by `fogcoil check --write-map`: see whether it is right.", quoted(&file));
    Ok((map.text(&heading, &doubts), case))
}

/// The map that a table suggests, and what is not sure of it.
fn proposed(table: &Sniffed) -> (MapFile, Vec<(Key, String)>) {
    let skipped = u32::try_from(table.preamble).unwrap_or(u32::MAX);
    let mut map = MapFile {
        encoding: if table.encoding == Encoding::Utf8 { String::new() } else { table.encoding.name().into() },
        preamble_lines: skipped,
        separator: if table.separator == "," { String::new() } else { table.separator.into() },
        decimal_comma: table.decimal_comma,
        ..MapFile::default()
    };
    let mut doubts = Vec::new();
    for key in Key::ALL {
        let Some(Found { column, unit, others }) = find(table, key) else { continue };
        let (name, standard) = (&table.names[column], key.units()[0].names[0]);
        let dates = key == Key::Time && table.rows.iter().all(|row| timestamp::date(&row[column]).is_some());
        let of = map.column_mut(key);
        if name != key.standard() {
            of.column.clone_from(name);
        }
        match unit.filter(|_| !dates) {
            Some(unit) if unit != standard => of.unit = unit.into(),
            None if !dates && name != key.standard() => doubts.push((key, format!("its name says no unit: taken as {standard}"))),
            _ => {}
        }
        if !others.is_empty() {
            let others: Vec<String> = others.iter().map(|other| quoted(&table.names[*other])).collect();
            doubts.push((key, format!("or {}", others.join(" or "))));
        }
    }
    (map, doubts)
}
