//! axe-core, which judges whether a page can be used by all.

use std::path::{Path, PathBuf};
use std::process::Command;

use proof::Failure;

pub(super) const VERSION: &str = "4.11.0";

/// Its source: of the file that is given, else of `folder`, into which npm puts it if it is not there.
pub(super) fn source(given: Option<&Path>, folder: &Path) -> Result<String, Failure> {
    let path = match given {
        Some(path) if path.is_dir() => path.join("axe.min.js"),
        Some(path) => path.to_owned(),
        None => fetched(folder)?,
    };
    std::fs::read_to_string(&path)
        .map_err(|e| Failure(format!("{}: {e}; --axe takes axe.min.js or the folder that holds it", path.display())))
}

fn fetched(folder: &Path) -> Result<PathBuf, Failure> {
    let package = folder.join("node_modules/axe-core");
    let path = package.join("axe.min.js");
    let there = std::fs::read_to_string(package.join("package.json"))
        .is_ok_and(|text| text.contains(&format!("\"version\": \"{VERSION}\"")));
    if there && path.is_file() {
        return Ok(path);
    }
    let wanted = format!("axe-core@{VERSION}");
    let remedy = format!("give its axe.min.js with --axe PATH, or install npm, which fetches {wanted}");
    let npm = Command::new("npm")
        .args(["install", "--silent", "--no-audit", "--no-fund", "--prefix"])
        .arg(folder)
        .arg(&wanted)
        .output();
    let done = npm.map_err(|e| Failure(format!("axe-core is not there and npm does not start ({e}); {remedy}")))?;
    if !done.status.success() {
        return Err(Failure(format!("npm does not fetch {wanted}: {}; {remedy}", String::from_utf8_lossy(&done.stderr).trim())));
    }
    Ok(path)
}
