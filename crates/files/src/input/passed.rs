//! The table of a batch: records of the units that passed.

use std::path::{Path, PathBuf};

use super::InputError;
use super::rows::{Dialect, Rows, quoted};

/// Between the files of a unit in the table of a batch.
pub const BETWEEN_FILES: &str = "; ";

/// Records of each unit that passed, of the `table.csv` that `fogcoil batch --out` writes; their paths are as that command was given them.
///
/// # Errors
/// The fault, in which file, line and column, and how to mend it.
pub fn read_passed(path: &Path) -> Result<Vec<Vec<PathBuf>>, InputError> {
    let mut rows = Rows::open(path, "the table of a batch (table.csv)", Dialect::STANDARD)?;
    rows.header("unit,judged,files")?;
    let names: Vec<String> = rows.fields().map(str::to_owned).collect();
    let place = |name: &str| {
        let remedy = "give the table.csv of a folder that fogcoil batch --out wrote";
        names.iter().position(|known| known == name).ok_or_else(|| rows.fault(Some(name), "the column is missing", remedy))
    };
    let [judged, files] = [place("judged")?, place("files")?];
    let mut passed = Vec::new();
    while rows.advance()? {
        rows.check_count(names.len(), ",", |_, _| "give the table as fogcoil batch wrote it")?;
        if rows.field(judged) != "pass" {
            continue;
        }
        let records: Vec<PathBuf> =
            rows.field(files).split(BETWEEN_FILES).filter(|file| !file.is_empty()).map(PathBuf::from).collect();
        if records.is_empty() {
            let problem = format!("{} is no list of records", quoted(rows.field(files)));
            return Err(rows.fault(Some("files"), problem, "give the table as fogcoil batch wrote it"));
        }
        passed.push(records);
    }
    if passed.is_empty() {
        return Err(
            rows.whole_fault("no unit has passed", "let fogcoil batch judge them by --limits, or name the units with --unit")
        );
    }
    Ok(passed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<Vec<PathBuf>>, String> {
        let folder = tempfile::tempdir().unwrap();
        let table = folder.path().join("table.csv");
        std::fs::write(&table, text).unwrap();
        read_passed(&table).map_err(|error| error.to_string())
    }

    #[test]
    fn units_that_passed_are_read_with_their_records() {
        let table = "unit,judged,reason,files\nA,pass,,a/1.csv; a/2.csv\nB,fail,\"arw is 0.1, more than 0.01\",b.csv\nC,pass,,c.csv\nD,not known,\"a \"\"b\"\"\",d.csv\n";
        let of = |files: &[&str]| files.iter().map(PathBuf::from).collect::<Vec<_>>();
        assert_eq!(read(table), Ok(vec![of(&["a/1.csv", "a/2.csv"]), of(&["c.csv"])]));
    }

    #[test]
    fn a_table_without_any_is_refused() {
        let refused = |text: &str| read(text).unwrap_err();
        assert!(refused("unit,judged,files\nA,fail,a.csv\n").contains("no unit has passed; let fogcoil batch judge them"));
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
