//! Recordings in folders.

use std::path::{Path, PathBuf};

use super::InputError;

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
