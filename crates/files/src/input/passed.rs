//! The table of a batch: records of the units that passed.

use std::path::{Path, PathBuf};

use super::InputError;
use super::rows::{Dialect, Rows, quoted};
use crate::{Remark, shown};

/// Between the files of a unit in the table of a batch.
pub const BETWEEN_FILES: &str = "; ";

/// Units that passed.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Passed {
    /// Records of each.
    pub units: Vec<Vec<PathBuf>>,
    /// Names of those left out: a warning says that a record of them is read wrongly, or is none of the unit.
    pub left_out: Vec<String>,
}

/// Units that passed, of the `table.csv` that `fogcoil batch --out` writes; the paths of their records are as that command was given them.
///
/// # Errors
/// The fault, in which file, line and column, and how to mend it.
pub fn read_passed(path: &Path) -> Result<Passed, InputError> {
    let mut rows = Rows::open(path, "the table of a batch (table.csv)", Dialect::STANDARD)?;
    rows.header("unit,judged,files")?;
    let names: Vec<String> = rows.fields().map(str::to_owned).collect();
    let place = |name: &str| {
        let remedy = "give the table.csv of a folder that fogcoil batch --out wrote";
        names.iter().position(|known| known == name).ok_or_else(|| rows.fault(Some(name), "the column is missing", remedy))
    };
    let [judged, files] = [place("judged")?, place("files")?];
    // an older table may have none
    let [unit, reason, warnings] = ["unit", "reason", "warnings"].map(|name| names.iter().position(|known| known == name));
    let mut passed = Passed::default();
    let mut first_not = None;
    while rows.advance()? {
        rows.check_count(names.len(), ",", |_, _| "give the table as fogcoil batch wrote it")?;
        let field = |place: Option<usize>| place.map_or("", |place| rows.field(place));
        if rows.field(judged) != "pass" {
            let why = [field(unit), field(reason)];
            first_not = first_not.or_else(|| why.iter().all(|text| !text.is_empty()).then(|| why.map(shown)));
            continue;
        }
        let is_void = |id: &str| Remark::ALL.iter().any(|remark| remark.id() == id && remark.voids());
        if field(warnings).split(BETWEEN_FILES).any(is_void) {
            passed.left_out.push(field(unit).to_owned());
            continue;
        }
        let records: Vec<PathBuf> =
            rows.field(files).split(BETWEEN_FILES).filter(|file| !file.is_empty()).map(PathBuf::from).collect();
        if records.is_empty() {
            let problem = format!("{} is no list of records", quoted(rows.field(files)));
            return Err(rows.fault(Some("files"), problem, "give the table as fogcoil batch wrote it"));
        }
        passed.units.push(records);
    }
    if passed.units.is_empty() && !passed.left_out.is_empty() {
        let remedy = "record them again, or name the units and the records to take with --unit";
        return Err(rows.whole_fault("of every unit that passed a warning says that a record is read wrongly", remedy));
    }
    if passed.units.is_empty() {
        let remedy = "let fogcoil batch judge them by --limits, or name the units with --unit";
        let why = first_not.map_or(String::new(), |[unit, reason]| format!("; of the first, {unit}: {reason}"));
        return Err(rows.whole_fault(&format!("no unit has passed{why}"), remedy));
    }
    Ok(passed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Passed, String> {
        let folder = tempfile::tempdir().unwrap();
        let table = folder.path().join("table.csv");
        std::fs::write(&table, text).unwrap();
        read_passed(&table).map_err(|error| error.to_string())
    }

    #[test]
    fn units_that_passed_are_read_with_their_records() {
        let table = "unit,judged,reason,files\nA,pass,,a/1.csv; a/2.csv\nB,fail,\"arw is 0.1, more than 0.01\",b.csv\nC,pass,,c.csv\nD,not known,\"a \"\"b\"\"\",d.csv\n";
        let of = |files: &[&str]| files.iter().map(PathBuf::from).collect::<Vec<_>>();
        let units = vec![of(&["a/1.csv", "a/2.csv"]), of(&["c.csv"])];
        assert_eq!(read(table), Ok(Passed { units, left_out: Vec::new() }));
        // of one whose thermometer fell off nothing is learnt; other warnings leave it good
        let table = "unit,judged,warnings,files\nA,pass,held-out-left; loose-thermometer,a.csv\nB,pass,gap,b.csv\n";
        assert_eq!(read(table), Ok(Passed { units: vec![of(&["b.csv"])], left_out: vec!["A".into()] }));
        let table = table.replace("B,pass", "B,fail");
        assert!(read(&table).unwrap_err().contains("of every unit that passed a warning says"), "{table}");
    }

    #[test]
    fn a_table_without_any_is_refused() {
        let refused = |text: &str| read(text).unwrap_err();
        assert!(refused("unit,judged,files\nA,fail,a.csv\n").contains("no unit has passed; let fogcoil batch judge them"));
        // the reason of the first, where the table has reasons
        let unsure =
            refused("unit,judged,reason,files\nA,not known,\"verdict_probability is 0.7, not within 0.9 and 1\",a.csv\n");
        assert!(
            unsure.contains("no unit has passed; of the first, ") && unsure.contains("verdict_probability is 0.7"),
            "{unsure}"
        );
        assert!(
            refused("unit,files\nA,a.csv\n").contains("judged: the column is missing"),
            "{}",
            refused("unit,files\nA,a.csv\n")
        );
        let without = refused("unit,judged,files\nA,pass,\n");
        assert!(without.contains(":2:") && without.contains("files") && without.contains("no list of records"), "{without}");
        assert!(refused("unit,judged,files\nA,pass\n").contains("has 2 fields where the header has 3"));
        assert!(refused("").contains("is empty"));
    }
}
