//! A copy of the workspace in which one crate holds all of its mutants, and the test programs that are built of it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Stdio;

use proof::Failure;
use proof::files::{below, failed, read, root};
use proof::program::hex;
use serde_json::Value;
use sha2::{Digest as _, Sha256};

use super::list::{Genre, Mutant, of_json};
use super::runner::runner;
use super::trial::Program;
use super::weave::{Place, SWITCHES, place_of, weave};
use crate::tools::{cargo, printed};

/// Most builds until one holds no fault: the compiler tells faults by stages.
const BUILDS: usize = 40;

/// Test programs of a crate that hold its mutants.
#[derive(Debug)]
pub(super) struct Woven {
    pub(super) mutants: Vec<Mutant>,
    /// Mutants that are not in the programs because the language does not allow them.
    pub(super) unviable: BTreeSet<usize>,
    /// Mutants that could not be put beside the source, and have to be tried one by one.
    pub(super) alone: BTreeSet<usize>,
    pub(super) programs: Vec<Program>,
    /// Hash of the text that the programs are built of, which builds of their own may make other bytes of.
    pub(super) hash: String,
}

/// The copy of the workspace, its files as they are now; those that are alike stay untouched, so that little is built anew.
fn copied() -> Result<PathBuf, Failure> {
    let into = root().join("target/mutants/woven");
    let listed = printed(
        std::process::Command::new("git").args(["ls-files", "--cached", "--others", "--exclude-standard"]).current_dir(root()),
    )?;
    for path in listed.lines().filter(|path| root().join(path).is_file()) {
        let bytes = std::fs::read(root().join(path)).map_err(failed(Path::new(path)))?;
        renewed(&into.join(path), &bytes)?;
    }
    Ok(into)
}

/// Writes a file if it holds something else.
fn renewed(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if std::fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(failed(folder))?;
    }
    std::fs::write(path, bytes).map_err(failed(path))
}

/// All mutants of a crate in the copy, those too of files that only a macro names.
fn listed(copy: &Path, name: &str) -> Result<Vec<Mutant>, Failure> {
    let list = |what: &[&str]| -> Result<String, Failure> {
        printed(runner()?.args(["--colors", "never", "--package", name, "--dir"]).arg(copy).args(what))
    };
    let source = copy.join("crates").join(name).join("src");
    let of = |path: &Path| path.strip_prefix(copy).map(|path| path.to_string_lossy().into_owned()).unwrap_or_default();
    // a file that is named may name others
    loop {
        let seen: BTreeSet<String> = list(&["--list-files"])?.lines().map(str::to_owned).collect();
        let mut changed = false;
        for file in below(&source)?.iter().map(|file| source.join(file)) {
            let (folder, stem) = (file.parent().unwrap_or(&source), file.file_stem().unwrap_or_default().to_string_lossy());
            if file.extension().is_none_or(|end| end != "rs") || seen.contains(&of(&file)) || stem == "lib" || stem == "mod" {
                continue;
            }
            let parent = folder.join("mod.rs");
            if !seen.contains(&of(&parent)) {
                continue;
            }
            let line = format!("\n#[cfg(any())]\nmod {stem};");
            let text = read(&parent)?;
            if !text.contains(&line) {
                std::fs::write(&parent, text + &line).map_err(failed(&parent))?;
                changed = true;
            }
        }
        if !changed {
            return of_json(&list(&["--list", "--json"])?, copy);
        }
    }
}

/// The test programs of a crate with its mutants.
///
/// # Errors
/// [`Failure`] if they cannot be built for a reason that no mutant explains.
pub(super) fn woven(name: &str) -> Result<Woven, Failure> {
    let copy = copied()?;
    let mutants = listed(&copy, name)?;
    let mut files = BTreeMap::<&str, Vec<usize>>::new();
    for (id, mutant) in mutants.iter().enumerate() {
        files.entry(&mutant.file).or_default().push(id);
    }
    let plain: BTreeMap<&str, String> =
        files.keys().map(|file| Ok((*file, read(&copy.join(file))?))).collect::<Result<_, Failure>>()?;
    let library = copy.join("crates").join(name).join("src/lib.rs");
    let library_name = format!("crates/{name}/src/lib.rs");
    let head = plain.get(library_name.as_str()).cloned().map_or_else(|| read(&library), Ok)?;
    // such a function answers with one type, which the answer put in is not
    let hidden = |&id: &usize| mutants[id].genre == Genre::FnValue && mutants[id].returns.contains("impl ");
    let (mut unviable, mut alone) = (BTreeSet::new(), (0..mutants.len()).filter(hidden).collect::<BTreeSet<_>>());
    for build in 0..BUILDS {
        let mut texts = BTreeMap::from([(library_name.clone(), head.clone())]);
        for (file, ids) in &files {
            let with: Vec<(usize, &Mutant)> =
                ids.iter().filter(|id| !unviable.contains(*id) && !alone.contains(*id)).map(|&id| (id, &mutants[id])).collect();
            let woven = weave(&plain[file], &with).map_err(|Failure(why)| Failure(format!("{file}: {why}")))?;
            alone.extend(woven.unplaced);
            texts.insert((*file).to_owned(), woven.text);
        }
        if let Some(text) = texts.get_mut(&library_name) {
            text.push_str(SWITCHES);
        }
        for (file, text) in &texts {
            renewed(&copy.join(file), text.as_bytes())?;
        }
        let (programs, faults) = built(&copy, name)?;
        if faults.is_empty() {
            return Ok(Woven { mutants, unviable, alone, programs, hash: hash_of(&copy)? });
        }
        eprintln!("build {}: {} faults", build + 1, faults.len());
        let before = unviable.len() + alone.len();
        for (file, at, told) in faults {
            let place = texts.get(&file).and_then(|text| place_of(text, at));
            match place {
                Some(Place::Mutant(id)) => _ = unviable.insert(id),
                Some(Place::Among(ids)) => alone.extend(ids),
                None => return Err(Failure(format!("{file}: no mutant explains: {told}"))),
            }
        }
        if unviable.len() + alone.len() == before {
            return Err(Failure("a fault stays in place".into()));
        }
    }
    Err(Failure(format!("{name} is not built in {BUILDS} times")))
}

/// Hash of the manifests and of all that is in the crates of a copy.
fn hash_of(copy: &Path) -> Result<String, Failure> {
    let crates = copy.join("crates");
    let mut paths: Vec<PathBuf> = below(&crates)?.iter().map(|file| crates.join(file)).collect();
    paths.extend(["Cargo.toml", "Cargo.lock"].map(|file| copy.join(file)));
    paths.sort();
    let mut hash = Sha256::new();
    for path in paths {
        hash.update(path.to_string_lossy().as_bytes());
        hash.update(std::fs::read(&path).map_err(failed(&path))?);
    }
    Ok(hex(hash))
}

/// A fault that the compiler tells: file, byte, message.
type Fault = (String, usize, String);

/// The place in the copy whose macro calls led to this one: a macro's text, such as that of `vec!`, may be another library's.
fn called<'a>(span: &'a Value, copy: &Path) -> &'a Value {
    let outer = &span["expansion"]["span"];
    let ours = span["file_name"].as_str().is_some_and(|file| copy.join(file).starts_with(copy));
    if ours || outer.is_null() { span } else { called(outer, copy) }
}

/// The test programs, or the faults.
fn built(copy: &Path, name: &str) -> Result<(Vec<Program>, Vec<Fault>), Failure> {
    let mut build = cargo();
    build.args(["test", "--no-run", "--quiet", "--package", name, "--lib", "--tests", "--message-format", "json"]);
    build.current_dir(copy).env("CARGO_TARGET_DIR", root().join("target/mutants/build")).env("CARGO_INCREMENTAL", "1");
    let output = build.env("RUSTFLAGS", "--cap-lints=allow").stdin(Stdio::null()).stderr(Stdio::inherit()).output()?;
    let (mut programs, mut faults) = (Vec::new(), Vec::new());
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(said) = serde_json::from_str::<Value>(line) else { continue };
        if said["reason"] == "compiler-artifact" && said["profile"]["test"] == true {
            let manifest = said["manifest_path"].as_str().and_then(|path| Path::new(path).parent());
            if let (Some(path), Some(folder)) = (said["executable"].as_str(), manifest) {
                programs.push(Program { path: path.into(), folder: folder.to_owned() });
            }
        }
        if said["reason"] == "compiler-message" && said["message"]["level"] == "error" {
            let spans = said["message"]["spans"].as_array().map(Vec::as_slice).unwrap_or_default();
            let told = said["message"]["rendered"].as_str().unwrap_or_default();
            for span in spans.iter().filter(|span| span["is_primary"] == true).map(|span| called(span, copy)) {
                let at = span["byte_start"].as_u64().and_then(|at| usize::try_from(at).ok()).unwrap_or_default();
                faults.push((span["file_name"].as_str().unwrap_or_default().to_owned(), at, told.to_owned()));
            }
        }
    }
    if faults.is_empty() && !output.status.success() {
        return Err(Failure(format!("the tests of {name} with its mutants are not built")));
    }
    programs.sort_by(|a, b| a.path.cmp(&b.path));
    Ok((programs, faults))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_fault_in_another_library_s_macro_is_where_it_is_called() {
        let ours = json!({ "file_name": "crates/a/src/lib.rs", "byte_start": 7, "expansion": null });
        let theirs =
            json!({ "file_name": "/rustc/0/library/alloc/src/macros.rs", "byte_start": 1, "expansion": { "span": ours } });
        let inner =
            json!({ "file_name": "/rustc/0/library/core/src/macros.rs", "byte_start": 2, "expansion": { "span": theirs } });
        let copy = Path::new("/copy");
        assert!([&ours, &theirs, &inner].iter().all(|span| called(span, copy) == &ours));
        let alone = json!({ "file_name": "/rustc/0/library/alloc/src/macros.rs", "byte_start": 1, "expansion": null });
        assert_eq!(called(&alone, copy), &alone);
    }
}
