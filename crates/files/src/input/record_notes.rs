//! Notes for the user on the reading of a recording.

use recording::Seconds;

use super::meta::Meta;
use super::record_columns::RecordColumns;
use super::record_format::{ColumnFormat, RecordFormat};
use super::record_options::Key;
use super::rows::quoted;
use super::unit_names::{bracketed, ending, foreign, is_temperature};
use crate::note::Note;
use crate::remark::Remark;

/// Notes on the columns; `dates` is the note on instants that are not seconds of a column.
pub(super) fn notes(columns: &RecordColumns, format: &RecordFormat, dates: Option<Note>) -> Vec<Note> {
    let mut notes = Vec::new();
    for key in Key::ALL {
        match columns.column(key) {
            // the note on the instants tells of a clock that is not read
            None if key == Key::Time && columns.unread_clock.is_some() => {}
            None => notes.push(absent(key)),
            Some(column) => {
                let (name, form) = (&columns.names[column], format.column(key));
                // dates have no unit
                let has_unit = key != Key::Time || dates.is_none();
                notes.extend(of_column(key, name, form).into_iter().filter(|note| has_unit || !note.is_warning()));
            }
        }
    }
    notes.extend(dates);
    let ignored = columns.ignored();
    notes.extend(unused_temperatures(columns, &ignored));
    match ignored[..] {
        [] => {}
        [name] => notes.push(Remark::IgnoredColumn.note(format!("the column {} is not used", quoted(name)))),
        ref names => {
            let message = format!("{} columns are not used: {}", names.len(), listed(names));
            notes.push(Remark::IgnoredColumn.note(message));
        }
    }
    notes
}

fn listed(names: &[&str]) -> String {
    names.iter().map(|name| quoted(name)).collect::<Vec<_>>().join(", ")
}

fn absent(key: Key) -> Note {
    let without = match key {
        Key::Time => {
            return Remark::DeclaredInterval.note("there is no column of instants: the interval that was declared stands for it");
        }
        Key::Spool => "a diagnosis can do without it, less surely",
        Key::Chamber | Key::Rate => "without it there is no diagnosis",
    };
    Remark::AbsentColumn.note(format!("there is no column {}; {without}", key.standard()))
}

/// Note on a column of instants that is not read but for its gaps, of rows that last `rows` \[s\] by the interval that was declared, and `column` \[s\] by that column, if its
/// instants can be read.
pub(super) fn unread_clock(name: &str, gaps: usize, rows: f64, column: Option<f64>) -> Note {
    /// Ratio of the two from which one of them is taken to be wrong; a clock that is put forward or back, or shows no seconds, changes less.
    const FAR: f64 = 1.5;
    let but = match gaps {
        0 => String::new(),
        1 => ", but for a gap, over which its clock goes on".to_owned(),
        many => format!(", but for {many} gaps, over which its clock goes on"),
    };
    let text = format!(
        "the instants of the column {} are not read: the interval that was declared stands for them{but}; the rows last {} s",
        quoted(name),
        Seconds(rows)
    );
    let Some(column) = column else { return Remark::DeclaredInterval.note(text) };
    let text = format!("{text}, by the column {} s", Seconds(column));
    let is_far = rows > 0.0 && !(1.0 / FAR..FAR).contains(&(column / rows));
    if is_far { Remark::DeclaredInterval.warning(text) } else { Remark::DeclaredInterval.note(text) }
}

/// Notes on name and unit of a column that is read; those on the unit are warnings.
pub(super) fn of_column(key: Key, name: &str, form: &ColumnFormat) -> Vec<Note> {
    mapped(key, name, form).into_iter().chain(unit(key, name, form)).collect()
}

/// Note on a column that is not the standard one.
fn mapped(key: Key, name: &str, form: &ColumnFormat) -> Option<Note> {
    let counts = if form.count == 1.0 { String::new() } else { format!("counts of {} ", form.count) };
    let unit = form.unit.names[0];
    let message = || format!("{} is read from the column {}, in {counts}{unit}", key.name(), quoted(name));
    (name != key.standard() || !form.is_standard(key)).then(|| Remark::MappedColumn.note(message()))
}

/// Note on the unit in a column's name if it is not the one that is read.
fn unit(key: Key, name: &str, form: &ColumnFormat) -> Option<Note> {
    let (read, shown, key_name) = (form.unit.names[0], quoted(name), key.name());
    // what the user says wins over an ending like that of `TC K`
    let is_heard = bracketed(name).is_some() || !form.is_said;
    if let Some(named) = ending(name, key).filter(|named| is_heard && *named != form.unit) {
        let named = named.names[0];
        let message = format!("the column {shown} is read in {read}; if its name is right, add --unit {key_name}={named}");
        return Some(Remark::UnitInName.warning(message));
    }
    let text = quoted(foreign(name, key).filter(|_| !form.is_said)?);
    let message = format!(
        "the column {shown} is read in {read}; {text} is no unit of {key_name} here: say what it holds by --unit {key_name}=UNIT and \
         --scale {key_name}=FACTOR, or unit and scale in the map file"
    );
    Some(Remark::UnknownUnit.warning(message))
}

/// Note on temperatures that are not used although one is wanted.
fn unused_temperatures(columns: &RecordColumns, ignored: &[&str]) -> Option<Note> {
    let wanted: Vec<Key> = [Key::Chamber, Key::Spool].into_iter().filter(|key| columns.column(*key).is_none()).collect();
    let unused: Vec<&str> = ignored.iter().copied().filter(|name| is_temperature(name)).collect();
    if wanted.is_empty() || unused.is_empty() {
        return None;
    }
    let flags: Vec<String> = wanted.iter().map(|key| format!("--column {}=NAME", key.name())).collect();
    let (verb, whose) = if unused.len() == 1 { ("temperature is", "it is") } else { ("temperatures are", "they are") };
    let message = format!(
        "{} {verb} not used: {}; if {whose} wanted, say which is which: {}",
        unused.len(),
        listed(&unused),
        flags.join(", ")
    );
    Some(Remark::UnusedTemperature.warning(message))
}

/// Note on rows whose distance is not the meta file's.
pub(super) fn interval_note(meta: &Meta, interval: f64) -> Option<Note> {
    let nominal = meta.sample_interval_s;
    let differs = nominal > 0.0 && interval > 0.0 && (interval / nominal - 1.0).abs() > 0.02;
    let message = || format!("the rows are {} s apart, the meta file says {nominal} s", Seconds(interval));
    differs.then(|| Remark::IntervalDiffers.note(message()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_model_does_without_the_spool_alone() {
        let said = [Key::Chamber, Key::Spool, Key::Rate].map(|key| absent(key).text.contains("without it there is no diagnosis"));
        assert_eq!(said, [true, false, true]);
    }
}
