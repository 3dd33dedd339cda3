//! Serial numbers of the units of a batch, and those that stand for several.

use std::collections::BTreeSet;

use files::Remark;

use super::row::{Row, trailing};

/// Gives a unit without a serial number the digits that its name ends in; its whole name where another unit has the same.
pub(super) fn settle(rows: &mut [Row]) {
    let digits: Vec<Option<String>> =
        rows.iter().map(|row| trailing(row.serial.as_ref().unwrap_or(&row.unit)).map(str::to_owned)).collect();
    for (row, own) in rows.iter_mut().zip(&digits).filter(|(row, _)| row.serial.is_none()) {
        let alone = digits.iter().filter(|other| *other == own).count() == 1;
        row.serial = own.as_ref().map(|digits| if alone { digits.clone() } else { row.unit.clone() });
    }
}

/// Serial numbers that more than one unit has, with these units' names.
pub(super) fn repeated<'a>(rows: &[&'a Row]) -> Vec<(&'a str, Vec<&'a str>)> {
    shared(rows.iter().filter_map(|row| Some((row.serial.as_deref()?, row.unit.as_str()))))
}

/// Units that have a recording in common, byte for byte: of each such recording their names.
pub(super) fn copied<'a>(rows: &[&'a Row]) -> Vec<Vec<&'a str>> {
    let all = rows.iter().flat_map(|row| row.hashes.iter().map(|hash| (hash.as_str(), row.unit.as_str())));
    let mut units: Vec<Vec<&str>> = shared(all).into_iter().map(|(_, units)| units).collect();
    units.dedup();
    units
}

/// Puts the warning that a recording is another unit's, too, into the rows of both.
pub(super) fn warn_of_copies(rows: &mut [Row]) {
    let copied: BTreeSet<String> = copied(&rows.iter().collect::<Vec<_>>()).into_iter().flatten().map(str::to_owned).collect();
    for row in rows.iter_mut().filter(|row| copied.contains(&row.unit)) {
        row.warnings.push(Remark::CopiedRecording.id().to_owned());
    }
}

/// What several units have, with their names.
fn shared<'a>(all: impl Iterator<Item = (&'a str, &'a str)>) -> Vec<(&'a str, Vec<&'a str>)> {
    let mut known: Vec<(&str, Vec<&str>)> = Vec::new();
    for (what, unit) in all {
        match known.iter_mut().find(|(other, _)| *other == what) {
            Some((_, units)) if units.last() == Some(&unit) => {}
            Some((_, units)) => units.push(unit),
            None => known.push((what, vec![unit])),
        }
    }
    known.retain(|(_, units)| units.len() > 1);
    known
}

/// Number in a unit's serial number.
pub(super) fn number(row: &Row) -> Option<f64> {
    trailing(row.serial.as_deref()?)?.parse().ok()
}

/// Whether no two units have the same number in their serial numbers.
pub(super) fn tell_apart(rows: &[&Row]) -> bool {
    let mut numbers: Vec<f64> = rows.iter().filter_map(|row| number(row)).collect();
    numbers.sort_by(f64::total_cmp);
    numbers.windows(2).all(|pair| pair[0] < pair[1])
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn settled(units: &[(&str, Option<&str>)]) -> Vec<Row> {
        let mut rows: Vec<Row> = units.iter().map(|(unit, serial)| Row::of(&json!({"unit": unit, "serial": serial}))).collect();
        settle(&mut rows);
        rows
    }

    fn serials(rows: &[Row]) -> Vec<Option<&str>> {
        rows.iter().map(|row| row.serial.as_deref()).collect()
    }

    #[test]
    fn digits_that_repeat_are_no_serial_number() {
        let lots = settled(&[("L1-01", None), ("L1-02", None), ("L2-01", None), ("spare", None)]);
        assert_eq!(serials(&lots), [Some("L1-01"), Some("02"), Some("L2-01"), None]);
        let all: Vec<&Row> = lots.iter().collect();
        assert!(!tell_apart(&all) && tell_apart(&all[..2]) && repeated(&all).is_empty());
    }

    #[test]
    fn both_units_of_one_recording_are_warned_of() {
        let row = |unit: &str, hashes: &[&str]| Row::of(&json!({"unit": unit, "sha256": hashes}));
        let mut rows = [row("A", &["1", "2"]), row("B", &["3"]), row("C", &["2"])];
        warn_of_copies(&mut rows);
        let warned = rows.each_ref().map(|row| row.warnings.join(","));
        assert_eq!(warned, ["copied-recording", "", "copied-recording"]);
    }

    #[test]
    fn serial_numbers_of_meta_files_stay_and_are_noted_where_they_repeat() {
        let rows = settled(&[("A", Some("0007")), ("B", Some("0007")), ("U0008", None)]);
        assert_eq!(serials(&rows), [Some("0007"), Some("0007"), Some("0008")]);
        assert_eq!(repeated(&rows.iter().collect::<Vec<_>>()), [("0007", vec!["A", "B"])]);
    }
}
