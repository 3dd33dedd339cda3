//! The units: a file each, or a folder with all records of one.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::Error;
use crate::input::{InputError, below, is_record, no_recording};

/// A unit and its records.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unit {
    /// Its name: that of its folder, or of its file without the end.
    pub name: String,
    /// Records that are fitted; at least one.
    pub fits: Vec<PathBuf>,
    /// Records that are held out: of a folder those whose names begin with `holdout`, if there are others.
    pub holdouts: Vec<PathBuf>,
    /// Its lot where no meta file tells one: the folder in which its own folder lies, or its file.
    pub lot: Option<String>,
}

impl Unit {
    /// Number of its records.
    pub fn records(&self) -> usize {
        self.fits.len() + self.holdouts.len()
    }
}

/// Begins the name of a record that judges.
const HELD_OUT: &str = "holdout";

/// Folders beside those of units that have no recording: whose files are missing, perhaps.
///
/// # Errors
/// [`files::Error::Input`] of a folder that cannot be read.
pub fn without_recordings(paths: &[PathBuf], out: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut empty = Vec::new();
    for path in paths.iter().filter(|path| path.is_dir()) {
        for folder in below(path)?.into_iter().filter(|inside| inside.is_dir() && !is_same(inside, out)) {
            let inside = below(&folder)?;
            // what has folders alone is no unit's
            if !inside.iter().any(|file| is_record(file) || file.is_dir()) {
                empty.push(folder);
            }
        }
    }
    Ok(empty)
}

fn is_same(a: &Path, b: &Path) -> bool {
    a.canonicalize().ok().zip(b.canonicalize().ok()).is_some_and(|(a, b)| a == b)
}

/// The units that paths name, by their names: a recording; a folder with the recordings (`*.csv`) of one unit; a folder of such folders. The batch's own
/// folder `out` is none of them.
///
/// # Errors
/// [`files::Error::Input`] of a path without recordings, of two units of one name, or where results would lie among recordings.
pub fn units(paths: &[PathBuf], out: &Path) -> Result<Vec<Unit>, Error> {
    let is_out = |folder: &Path| is_same(folder, out);
    let mut all: BTreeMap<String, Unit> = BTreeMap::new();
    let mut add = |at: &Path, unit: Unit| match all.insert(unit.name.clone(), unit) {
        None => Ok(()),
        Some(other) => {
            let problem = format!("is the second unit of the name {}", other.name);
            Err(InputError::whole(at, problem, "give every unit once, and each a name of its own"))
        }
    };
    for path in paths {
        if !path.is_dir() {
            let name = named(path.file_stem());
            let lot = lot(&path.canonicalize().unwrap_or_else(|_| path.clone()));
            add(path, Unit { name, fits: vec![path.clone()], holdouts: Vec::new(), lot })?;
            continue;
        }
        let mut found = 0;
        if is_out(path) {
            return Err(InputError::whole(path, "has recordings, and would have the results", "give another --out").into());
        }
        let folders: Vec<PathBuf> = below(path)?.into_iter().filter(|inside| inside.is_dir() && !is_out(inside)).collect();
        for folder in std::iter::once(path).chain(&folders) {
            let records: Vec<PathBuf> = below(folder)?.into_iter().filter(|file| is_record(file)).collect();
            if !records.is_empty() {
                add(folder, of_folder(folder, records))?;
                found += 1;
            }
        }
        if found == 0 {
            return Err(no_recording(path, "a folder with the recordings of one unit, or a folder of such folders").into());
        }
    }
    Ok(all.into_values().collect())
}

fn of_folder(folder: &Path, records: Vec<PathBuf>) -> Unit {
    // a folder that is named from inside has its name elsewhere
    let whole = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let judges = |record: &PathBuf| named(record.file_stem()).to_ascii_lowercase().starts_with(HELD_OUT);
    let (holdouts, fits): (Vec<PathBuf>, Vec<PathBuf>) = records.into_iter().partition(judges);
    let (name, lot) = (named(whole.file_name()), lot(&whole));
    let (fits, holdouts) = if fits.is_empty() { (holdouts, fits) } else { (fits, holdouts) };
    Unit { name, fits, holdouts, lot }
}

/// Name of the folder in which a unit's folder or file lies.
fn lot(whole: &Path) -> Option<String> {
    Some(whole.parent()?.file_name()?.to_string_lossy().into_owned())
}

/// A name that is one of a file anywhere.
fn named(name: Option<&std::ffi::OsStr>) -> String {
    let plain = |c: char| if c.is_alphanumeric() || "-_.+".contains(c) { c } else { '_' };
    let name: String = name.unwrap_or_default().to_string_lossy().chars().map(plain).collect();
    if name.trim_matches('.').is_empty() { "unit".into() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_folders_and_folders_of_folders() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["lot/U1", "lot/U2", "lone", "empty"] {
            std::fs::create_dir_all(at(name)).unwrap();
        }
        for name in ["lot/U1/run1.csv", "lot/U1/holdout.csv", "lot/U1/meta.ron", "lot/U2/holdout.csv", "lone/a.csv", "one b.csv"]
        {
            std::fs::write(at(name), "").unwrap();
        }
        let found = units(&[at("lot"), at("lone"), at("one b.csv")], &at("out")).unwrap();
        let told: Vec<String> =
            found.iter().map(|unit| format!("{} {} {}", unit.name, unit.fits.len(), unit.holdouts.len())).collect();
        assert_eq!(told, ["U1 1 1", "U2 1 0", "lone 1 0", "one_b 1 0"]);
        assert_eq!((found[0].lot.as_deref(), found[3].lot.as_deref()), (Some("lot"), found[2].lot.as_deref()));
        let says = |paths: &[PathBuf]| units(paths, &at("out")).unwrap_err().to_string();
        assert!(says(&[at("empty")]).contains("each recording by its name"));
        assert!(says(&[at("lot"), at("lot/U1")]).contains("is the second unit of the name U1"));
        let without = |paths: &[PathBuf]| without_recordings(paths, &at("lot/out")).unwrap();
        assert!(without(&[at("lot"), at("one b.csv")]).is_empty());
        for name in ["lot/U3", "lot/out", "lot/deep/U4"] {
            std::fs::create_dir_all(at(name)).unwrap();
        }
        assert_eq!(without(&[at("lot")]), [at("lot/U3")]);
        // tables of an earlier run are no recordings
        assert_eq!(units(&[at("lot")], &at("lot/U2")).unwrap().len(), 1);
        assert!(units(&[at("lone")], &at("lone")).unwrap_err().to_string().contains("give another --out"));
    }
}
