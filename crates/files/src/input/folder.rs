//! Recordings in folders.

use std::path::{Path, PathBuf};

use super::InputError;
use super::profile_columns::DRIVES;
use super::record_options::{RecordOptions, TIME};
use super::rows::{Dialect, Rows};
use crate::note::Note;
use crate::remark::Remark;

/// Those of [`recordings`] that are read in a folder, and a note on each table that is left out: one of instants and drives alone is a profile, which has no rate.
///
/// # Errors
/// As [`recordings`], and if nothing is left.
pub fn recordings_without_profiles(paths: &[PathBuf], options: &RecordOptions) -> Result<(Vec<PathBuf>, Vec<Note>), InputError> {
    let left_out = |path: &PathBuf| !paths.contains(path) && options.map_of(path).is_none() && is_profile(path);
    let (profiles, records): (Vec<PathBuf>, Vec<PathBuf>) = recordings(paths)?.into_iter().partition(left_out);
    match profiles.first() {
        Some(profile) if records.is_empty() => {
            let others = "a folder with recordings, or a recording by its name";
            Err(InputError::whole(
                profile,
                "is a profile, which has no rate, and there is no recording beside it",
                format!("give {others}"),
            ))
        }
        _ => {
            let note = |path: &PathBuf| Remark::LeftOutTable.note("not read: a profile, which has no rate").at(path);
            let notes = profiles.iter().map(note).collect();
            Ok((records, notes))
        }
    }
}

/// Whether the first line of a table names instants and drives of a coil, and nothing else.
fn is_profile(path: &Path) -> bool {
    let is_known = |name: &str| name == TIME || DRIVES.iter().any(|(drive, _)| *drive == name);
    let Ok(mut rows) = Rows::open(path, "a recording (*.csv)", Dialect::STANDARD) else { return false };
    rows.header(TIME).is_ok() && rows.fields().any(|name| name == TIME) && rows.fields().all(is_known)
}

/// The recordings that paths name: a file itself; of a folder its `*.csv`, then those of the folders in it, by name.
///
/// # Errors
/// [`InputError`] of a folder that cannot be read, or holds no recording.
pub fn recordings(paths: &[PathBuf]) -> Result<Vec<PathBuf>, InputError> {
    let mut all = Vec::new();
    for path in paths {
        if !path.is_dir() {
            all.push(path.clone());
            continue;
        }
        let inside = below(path)?;
        let before = all.len();
        all.extend(inside.iter().filter(|file| is_record(file)).cloned());
        for folder in inside.iter().filter(|inside| inside.is_dir()) {
            all.extend(below(folder)?.into_iter().filter(|file| is_record(file)));
        }
        if all.len() == before {
            return Err(no_recording(path, "a folder with recordings"));
        }
    }
    Ok(all)
}

/// A folder without a recording, in place of which one may give `others`.
pub fn no_recording(folder: &Path, others: &str) -> InputError {
    let remedy = format!("give {others}, or each recording by its name, which may then have another ending");
    InputError::whole(folder, "has no recording (*.csv)", remedy)
}

/// Content of a folder, by name.
///
/// # Errors
/// [`InputError`] of a folder that cannot be read.
pub fn below(folder: &Path) -> Result<Vec<PathBuf>, InputError> {
    let unreadable = |error: std::io::Error| InputError::whole(folder, format!("cannot be read: {error}"), "check it");
    let entries = std::fs::read_dir(folder).map_err(unreadable)?;
    let mut below: Vec<PathBuf> = entries.map(|entry| entry.map(|e| e.path())).collect::<Result<_, _>>().map_err(unreadable)?;
    below.sort();
    Ok(below)
}

/// Whether a file in a folder is taken for a recording: by its ending.
pub fn is_record(file: &Path) -> bool {
    file.is_file() && file.extension().is_some_and(|end| end.eq_ignore_ascii_case("csv"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_profile_in_a_folder_is_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("lot")).unwrap();
        std::fs::write(at("lot/a.profile.csv"), "time_s,chamber_c\n0,20\n").unwrap();
        let of = |paths: &[PathBuf]| recordings_without_profiles(paths, &RecordOptions::default());
        let said = of(&[at("lot")]).unwrap_err().to_string();
        assert!(said.contains("a.profile.csv: is a profile, which has no rate, and there is no recording beside it"), "{said}");
        std::fs::write(at("lot/a.csv"), "time_s,chamber_c,rate_deg_per_h\n0,20,1\n").unwrap();
        std::fs::write(at("lot/b.csv"), "time_s,chamber_c,foo\n0,20,1\n").unwrap();
        let (found, notes) = of(&[at("lot")]).unwrap();
        assert_eq!(found, ["lot/a.csv", "lot/b.csv"].map(at));
        assert!(notes.len() == 1 && notes[0].to_string().contains("a.profile.csv: not read: a profile"), "{notes:?}");
        // one that is given by its name, or that a map says how to read, is read
        assert_eq!(of(&[at("lot/a.profile.csv")]).unwrap().0, [at("lot/a.profile.csv")]);
        std::fs::write(at("lot/a.profile.map.ron"), "()").unwrap();
        assert_eq!(of(&[at("lot")]).unwrap().0.len(), 3);
    }

    #[test]
    fn files_and_folders_and_folders_of_folders() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["lot/U1", "lot/U2", "empty"] {
            std::fs::create_dir_all(at(name)).unwrap();
        }
        let files = ["lot/a.csv", "lot/U1/b.CSV", "lot/U1/meta.ron", "lot/U2/c.csv", "one.txt"];
        files.iter().for_each(|name| std::fs::write(at(name), "").unwrap());
        let found = recordings(&[at("one.txt"), at("lot")]).unwrap();
        assert_eq!(found, ["one.txt", "lot/a.csv", "lot/U1/b.CSV", "lot/U2/c.csv"].map(at));
        let said = recordings(&[at("empty")]).unwrap_err().to_string();
        assert!(
            said.contains("has no recording (*.csv); give a folder with recordings, or each recording by its name"),
            "{said}"
        );
    }
}
