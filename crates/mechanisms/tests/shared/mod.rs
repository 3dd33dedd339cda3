//! Models and full solutions that tests share: made in each process, but once for all in trials of mutants, which are thousands.

use coil::{Design, Tolerances};
use mechanisms::{Library, Mechanism, Models};
use progress::Step;
use serde::{Serialize, de::DeserializeOwned};
use std::fmt::Debug;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::Write as _;
use std::path::PathBuf;

/// Variable that names a folder in which trials keep what other crates answer.
const KEPT: &str = "FOGCOIL_KEPT";
/// The same for models, which the crate has a part in: not set in the trial of a mutant that acts while they are made.
const KEPT_MODELS: &str = "FOGCOIL_KEPT_MODELS";
/// The file of the mutants that a test reaches: everything is made anew, and those that making models reaches are told in a file beside it.
const REACHED: &str = "FOGCOIL_REACHED";

fn path(variable: &str) -> Option<PathBuf> {
    std::env::var_os(variable).map(PathBuf::from)
}

/// Whether models may be older than this process.
pub(crate) fn are_models_kept() -> bool {
    path(KEPT_MODELS).is_some()
}

/// The answer of `make` to a key, from the folder that a variable names if it is there.
fn kept<T: Serialize + DeserializeOwned>(variable: &str, key: &impl Debug, make: impl FnOnce() -> T) -> T {
    let Some(folder) = path(variable) else { return make() };
    let mut hash = DefaultHasher::new();
    format!("{key:?}").hash(&mut hash);
    let name = format!("{:016x}", hash.finish());
    let file = folder.join(&name);
    if path(REACHED).is_none() {
        let kept = || postcard::from_bytes(&std::fs::read(file).ok()?).ok();
        return kept().unwrap_or_else(make);
    }
    // of the unchanged program
    let made = make();
    let part = folder.join(format!("{name}-{}", std::process::id()));
    std::fs::write(&part, postcard::to_stdvec(&made).expect("bytes")).expect("a folder");
    std::fs::rename(part, file).expect("a folder");
    made
}

/// Tells what is reached by making.
fn followed<T>(make: impl FnOnce() -> T) -> T {
    let Some(reached) = path(REACHED) else { return make() };
    let so_far = || std::fs::read(&reached).expect("a file");
    let before = so_far().len();
    let made = make();
    let mut told = std::fs::OpenOptions::new().create(true).append(true).open(reached.with_extension("made")).expect("a file");
    told.write_all(&so_far()[before..]).expect("a file");
    made
}

/// A full solution by all that it depends on, which is other crates' alone.
pub(crate) fn solved<T: Serialize + DeserializeOwned>(key: &impl Debug, solve: impl FnOnce() -> T) -> T {
    kept(KEPT, key, solve)
}

/// The library of a design, for the usual tolerances.
pub(crate) fn library(design: &Design, mechanisms: &[&dyn Mechanism], progress: &(dyn Fn(Step) + Sync)) -> Library {
    let make = || Models::build(design, &Tolerances::default(), mechanisms, progress).expect("models");
    let key = (design, mechanisms.len());
    Library::new(kept(KEPT_MODELS, &key, || followed(make)), mechanisms).expect("library")
}
