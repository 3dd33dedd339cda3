//! A map file for a logger's recording, proposed from its content.

use std::path::Path;

use recording::check::{Finding, FindingKind, Severity};

use super::encoding::Encoding;
use super::map_file::{MapFile, in_quotes};
use super::record::{self, RecordCase};
use super::record_expectations::{EARTH_DEG_PER_H, OFFSET_DEG_PER_H};
use super::record_format::RecordFormat;
use super::record_options::{Key, RATE, RecordOptions};
use super::rows::quoted;
use super::sniff::{Sniffed, sniff};
use super::sniff_columns::{
    Found, are_days, date_and_time, find, holds, is_counts, is_instant, perhaps, perhaps_temperatures, unit, unread_instants,
    unused_temperatures,
};
use super::timestamp::FORMS;
use crate::Error;
use crate::note::Note;
use crate::remark::Remark;

/// Most lines of temperatures that are not used.
const MOST_ASIDES: usize = 25;

/// A map file that is proposed.
#[derive(Debug, Clone, PartialEq)]
pub struct ProposedMap {
    /// Its content.
    pub text: String,
    /// The recording as it is read with it; an error are the names of the columns that are still to be chosen in it.
    pub case: Result<RecordCase, Vec<&'static str>>,
}

/// A map file for a recording, `RECORD.map.ron`, and the recording as it is read with it.
///
/// The `options` win over the proposal from the file's content. A map in which time or rate is still to be chosen lists what may be it.
///
/// # Errors
/// As [`read_record`](super::read_record), and if the file shows no table.
pub fn propose_map(path: &Path, options: &RecordOptions) -> Result<ProposedMap, Error> {
    let Proposal { mut map, mut doubts, asides, missing } = proposed(&sniff(path)?, options);
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let heading = format!("How {} is read, proposed by `fogcoil check --write-map`: see whether it is right.", quoted(&file));
    if !missing.is_empty() {
        RecordFormat::of_map(&map, options)?;
        let missing = missing.into_iter().map(Key::name).collect();
        return Ok(ProposedMap { text: map.text(&heading, &doubts, &asides), case: Err(missing) });
    }
    let mut case = read(path, &map, options)?;
    let others = other_units(&map, &case);
    let several = others.iter().filter(|(key, units)| *key == Key::Rate && units.len() > 1);
    let warnings: Vec<Note> = several.filter_map(|(_, units)| doubted_rate(units, &case)).collect();
    for (key, units) in &others {
        let standard = key.units()[0].names[0];
        let others: String = units[1..].iter().map(|other| format!(", or {other}")).collect();
        doubts.retain(|(of, doubt)| of != key || doubt.starts_with("or "));
        doubts.insert(0, (*key, format!("the values are not of the size of {standard}: taken as {}{others}", units[0])));
        map.column_mut(*key).unit.clone_from(&units[0]);
    }
    if !others.is_empty() {
        case = read(path, &map, options)?;
    }
    case.notes.extend(warnings);
    Ok(ProposedMap { text: map.text(&heading, &doubts, &asides), case: Ok(case) })
}

fn read(path: &Path, map: &MapFile, options: &RecordOptions) -> Result<RecordCase, Error> {
    record::read_as(path, &RecordFormat::of_map(map, options)?, options)
}

/// Columns with the units that their values admit, the likeliest first, where nothing states the unit and the standard one cannot be right.
fn other_units(map: &MapFile, case: &RecordCase) -> Vec<(Key, Vec<String>)> {
    let unsaid = |key: &Key| map.column(*key).unit.is_empty() && map.column(*key).scale == 0.0;
    let of = |finding: &Finding| match &finding.kind {
        FindingKind::Unit { candidates, key, range: [low, high], found, .. } if !candidates.is_empty() => {
            let beyond = finding.severity == Severity::Error || !(low..=high).contains(&found);
            let key = key.parse().ok().filter(unsaid).filter(|_| beyond);
            key.map(|key| (key, candidates.clone()))
        }
        _ => None,
    };
    case.report.findings.iter().filter_map(of).collect()
}

/// The warning of a rate that may be in several `units`, read in the standard one, with a hint where in one of them alone the rate at rest is what Earth's may be
/// and no bias is: a bias in another unit may be as large, so the hint decides nothing.
fn doubted_rate(units: &[String], case: &RecordCase) -> Option<Note> {
    let read = case.number(RATE).map(|number| case.report.channels[number].median)?;
    let median = |name: &String| case.rate_units.iter().find(|other| other.name == *name).map(|other| other.scale * read);
    let medians: Vec<(&String, f64)> = units.iter().filter_map(|name| Some((name, median(name)?))).collect();
    let is_earths = |(_, median): &&(&String, f64)| (OFFSET_DEG_PER_H..=EARTH_DEG_PER_H).contains(&median.abs());
    let hint = match medians.iter().filter(is_earths).collect::<Vec<_>>()[..] {
        [(name, median)] => {
            format!("; in {name} alone its median, {median:.2} deg/h, may be Earth's rate, if that was not taken off")
        }
        _ => String::new(),
    };
    let (taken, others) = units.split_first()?;
    let others = others.join(" or ");
    Some(Remark::Unit.warning(format!(
        "no unit of the rate is told, and its values may be in {taken} or {others}: the map takes {taken}{hint}; see which it is, and write it into the map"
    )))
}

/// The map that a table suggests.
struct Proposal {
    map: MapFile,
    /// Uncertainties about a column.
    doubts: Vec<(Key, String)>,
    /// Lines that may be in the map.
    asides: Vec<String>,
    /// Columns without which no recording is read.
    missing: Vec<Key>,
}

fn proposed(table: &Sniffed, options: &RecordOptions) -> Proposal {
    let skipped = u32::try_from(table.preamble).unwrap_or(u32::MAX);
    let mut map = MapFile {
        encoding: if table.encoding == Encoding::Utf8 { String::new() } else { table.encoding.name().into() },
        preamble_lines: skipped,
        lines_below_names: u32::from(!table.units.is_empty()),
        separator: if table.separator == "," { String::new() } else { table.separator.into() },
        decimal_comma: table.decimal_comma,
        ..MapFile::default()
    };
    let (mut doubts, mut taken) = (Vec::new(), Vec::new());
    let said = |key: Key| options.units.iter().any(|(of, _)| *of == key) || options.scales.iter().any(|(of, _)| *of == key);
    for key in Key::ALL {
        let two = date_and_time(table).filter(|_| key == Key::Time);
        let found = match options.columns.iter().find(|(of, _)| *of == key) {
            Some((_, name)) => table.names.iter().position(|other| other == name).map(|column| Found::of(table, column, key)),
            // a count is no unit of a rate, and there is none that is usual
            None => find(table, key).filter(|found| said(key) || found.unit.is_some() || !is_counts(&table.names[found.column])),
        };
        if let Some((day, time)) =
            two.filter(|(day, time)| found.as_ref().is_none_or(|found| [*day, *time].contains(&found.column)))
        {
            map.time.column.clone_from(&table.names[day]);
            map.time_of_day.clone_from(&table.names[time]);
            taken.extend([day, time]);
        } else if let Some(found) = found {
            propose_column(table, key, &found, &mut map, &mut doubts);
            taken.push(found.column);
        }
    }
    map.declare(options);
    doubts.retain(|(key, doubt)| doubt.starts_with("or ") || !said(*key));
    let missing: Vec<Key> = [Key::Time, Key::Rate].into_iter().filter(|key| !has(table, &map, *key)).collect();
    Proposal { asides: asides(table, &map, &taken, &missing), map, doubts, missing }
}

/// Whether a map, or the name of a column, says which column is a key's; an interval stands for the time.
fn has(table: &Sniffed, map: &MapFile, key: Key) -> bool {
    !map.column(key).column.is_empty()
        || table.names.iter().any(|name| name == key.standard())
        || key == Key::Time && map.interval_s > 0.0
}

/// Puts a column that was found into the map, and its uncertainties among the doubts.
fn propose_column(table: &Sniffed, key: Key, found: &Found, map: &mut MapFile, doubts: &mut Vec<(Key, String)>) {
    let Found { column, unit, foreign, others } = found;
    let (name, standard) = (&table.names[*column], key.units()[0].names[0]);
    let dates = key == Key::Time && holds(table, *column, is_instant);
    let of = map.column_mut(key);
    if name != key.standard() {
        of.column.clone_from(name);
    }
    match unit.filter(|_| !dates) {
        Some(unit) if unit != standard => of.unit = unit.into(),
        None if key == Key::Time && are_days(table, *column) => {
            of.unit = "d".into();
            doubts.push((key, "numbers of days, as a spreadsheet writes dates: taken as d".into()));
        }
        None if !dates && name != key.standard() => doubts.push((key, no_unit(foreign.as_deref(), standard))),
        _ => {}
    }
    if !others.is_empty() {
        let others: Vec<String> = others.iter().map(|other| quoted(&table.names[*other])).collect();
        doubts.push((key, format!("or {}", others.join(" or "))));
    }
}

/// Columns of unknown meaning, as lines of the map for the keys that are wanted.
fn asides(table: &Sniffed, map: &MapFile, taken: &[usize], missing: &[Key]) -> Vec<String> {
    let line = |key: Key, column: usize, unsaid: &str| {
        let (name, standard) = (&table.names[column], key.units()[0].names[0]);
        let unit = unit(table, column, key).unwrap_or(unsaid);
        let unit = if [standard, ""].contains(&unit) { String::new() } else { format!(", unit: {}", in_quotes(unit)) };
        format!("{}: (column: {}{unit}),", key.name(), in_quotes(name))
    };
    let (mut asides, mut instants) = (Vec::new(), taken.to_vec());
    for key in missing {
        let columns = perhaps(table, *key, &instants);
        let unread = if *key == Key::Time && columns.is_empty() { unread_instants(table, &instants) } else { Vec::new() };
        if !unread.is_empty() {
            asides.push(format!(
                "no column's name says that it is the time; these seem to hold instants in a form that is not read: write them as numbers, or dates like {FORMS}; or write interval_s: SECONDS:"
            ));
            asides.extend(unread.iter().take(MOST_ASIDES).map(|column| line(*key, *column, "")));
            instants.extend(unread);
            continue;
        }
        let without =
            if *key == Key::Time { "dates need none; without instants write interval_s: SECONDS" } else { "or give a scale" };
        asides.push(format!(
            "no column's name says that it is the {}; take the // from the line that is right, and put its unit for ?; {without}:",
            key.name()
        ));
        let unsaid = |column: &usize| if holds(table, *column, is_instant) { "" } else { "?" };
        asides.extend(columns.iter().take(MOST_ASIDES).map(|column| line(*key, *column, unsaid(column))));
        if *key == Key::Time {
            instants.extend(columns);
        }
    }
    let named = unused_temperatures(table, taken);
    let (unused, heading) = if named.is_empty() {
        (perhaps_temperatures(table, &instants), "columns that may be temperatures; take the // from the lines that are right:")
    } else {
        (named, "temperatures that are not used; take the // from the lines that are right:")
    };
    let wanted = [Key::Chamber, Key::Spool].into_iter().filter(|key| !has(table, map, *key));
    let lines: Vec<String> = wanted
        .flat_map(|key| unused.iter().map(move |column| (key, *column)))
        .map(|(key, column)| line(key, column, ""))
        .collect();
    let heading = (!lines.is_empty()).then(|| heading.to_owned());
    asides.extend(heading.into_iter().chain(lines).take(MOST_ASIDES));
    asides
}

/// Remark on a column whose name has no unit, or a text in its place that is none.
fn no_unit(foreign: Option<&str>, standard: &str) -> String {
    match foreign {
        Some(text) => format!("{} is no unit here: taken as {standard}; write unit: ..., scale: ...", quoted(text)),
        None => format!("its name says no unit: taken as {standard}"),
    }
}
