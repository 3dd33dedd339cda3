//! The units of `fixtures/concealed`: answered first, all of them, and only then held against their truths.

use std::path::{Path, PathBuf};
use std::time::Instant;

use fogcoil::cache::Cache;
use fogcoil::input::{self, CoilCase};
use rayon::prelude::*;

use super::answer::{Answer, Written, answered, of_unit, paths, records};
use super::baselines::{REGRESSIONS, regressions, selection};
use super::chain::{self, Unit};
use super::score::{HeldOut, Scored, score};
use crate::files::{self, root};
use crate::truth::Truth;
use crate::{Failure, program};

const THREADS: usize = 2;

/// A unit with everything that is said of it.
pub(crate) struct Case {
    pub(crate) truth: Truth,
    pub(crate) answer: Answer,
    pub(crate) scored: Scored,
    pub(crate) held: HeldOut,
    /// Size of the noise as it was made \[deg/h\].
    pub(crate) noise: f64,
    /// Held-out root mean squares of the regressions.
    pub(crate) regressions: [f64; REGRESSIONS.len()],
    /// Answer of BIC in white noise.
    pub(crate) selection: Scored,
}

fn folder() -> PathBuf {
    root().join("fixtures/concealed")
}

/// The reference coil, and its library kept where every unit finds it.
fn prepared() -> Result<(CoilCase, Cache, mechanisms::Library), Failure> {
    let coil = input::read_coil(&root().join("fixtures/concealed/coil.ron"))?;
    let cache = Cache::of_user();
    let library = chain::library(&coil, &cache)?;
    Ok((coil, cache, library))
}

fn units(folder: &Path) -> Result<Vec<String>, Failure> {
    Ok(files::names(folder)?.into_iter().filter(|name| folder.join(name).is_dir()).collect())
}

/// Does something for every unit, [`THREADS`] at once; the results in the units' order.
pub(crate) fn each<T: Send>(units: &[String], work: impl Fn(&str) -> Result<T, Failure> + Sync) -> Result<Vec<T>, Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build()?;
    let named = |unit: &String| work(unit).map_err(|Failure(problem)| Failure(format!("{unit}: {problem}")));
    // one unit at a time to whoever is free: they take unequally long
    pool.install(|| units.par_iter().with_max_len(1).map(named).collect())
}

fn answers(from: &Path, units: &[String], coil: &CoilCase, cache: &Cache, clock: Instant) -> Result<Vec<Written>, Failure> {
    each(units, |unit| {
        let (start, at) = (Instant::now(), from.join(unit));
        let files = of_unit(coil, &at, cache)?;
        eprintln!("[{:5.1} s] {unit} is answered ({:.0} s)", clock.elapsed().as_secs_f64(), start.elapsed().as_secs_f64());
        Ok(files)
    })
}

/// Writes the answers into a folder, all or none.
pub(crate) fn write(into: &Path, units: &[String], answers: &[Written], program: Option<&str>) -> Result<(), Failure> {
    let contents = answers.iter().flatten().cloned();
    let mut all: Vec<(PathBuf, String)> = units.iter().flat_map(|unit| paths(into, unit)).zip(contents).collect();
    all.extend(program.map(|hash| (into.join(PROGRAM), format!("{hash}\n"))));
    files::write_all(&all)
}

/// Answers the open units, or those named, writes the answers to `target/prove/open`, then opens the truths and scores.
pub(crate) fn open(only: &[String]) -> Result<Vec<Case>, Failure> {
    let clock = Instant::now();
    let from = folder().join("open");
    let mut names = units(&from)?;
    if let Some(missing) = only.iter().find(|unit| !names.contains(unit)) {
        return Err(Failure(format!("there is no open unit {missing}; there are {}", names.join(", "))));
    }
    names.retain(|unit| only.is_empty() || only.contains(unit));
    let (coil, cache, library) = prepared()?;
    let files = answers(&from, &names, &coil, &cache, clock)?;
    let into = root().join("target/prove/open");
    write(&into, &names, &files, None)?;
    drop(files);
    eprintln!("[{:5.1} s] all answers are in {}; the truths are opened", clock.elapsed().as_secs_f64(), into.display());
    each(&names, |unit| {
        let truth = Truth::read(&folder().join("truth").join(format!("{unit}.ron")))?;
        let (answer, predicted) = answered(&into, unit)?;
        let model = Unit::new(&library, &records(&from.join(unit)))?;
        let held = model.held_out(&truth, &predicted)?;
        Ok(Case {
            scored: score(unit, &truth, &answer, Some(held)),
            held,
            noise: model.noise(&truth),
            regressions: regressions(&model)?,
            selection: score(unit, &truth, &selection(&model)?, None),
            truth,
            answer,
        })
    })
}

/// Name of the file that says which program answered.
pub(crate) const PROGRAM: &str = "PROGRAM";

/// Answers the sealed units into `fixtures/concealed/answers`, once.
pub(crate) fn sealed() -> Result<bool, Failure> {
    let into = folder().join("answers");
    if into.exists() {
        let problem = "the sealed units have been answered, and are answered once";
        let remedy = "to check that the answers reproduce, give another folder: cargo xtask prove --sealed --again DIR";
        return Err(Failure(format!("{}: {problem}; {remedy}", into.display())));
    }
    let units = answer_sealed(&into)?;
    println!("{} sealed units are answered in {}", units.len(), into.display());
    Ok(true)
}

/// Answers the sealed units again, into another folder, and says whether the answers are the same.
pub(crate) fn sealed_again(into: &Path) -> Result<bool, Failure> {
    let first = folder().join("answers");
    let inside = |path: &Path| path.canonicalize().is_ok_and(|path| first.canonicalize().is_ok_and(|f| path.starts_with(f)));
    if inside(into) || into.parent().is_some_and(inside) {
        return Err(Failure(format!("{}: these are the answers themselves; give another folder", into.display())));
    }
    if !first.join(PROGRAM).is_file() {
        return Err(Failure(format!("{}: the sealed units are not answered yet: cargo xtask prove --sealed", first.display())));
    }
    let units = answer_sealed(into)?;
    let same = |name: &str| -> Result<bool, Failure> { Ok(files::read(&into.join(name))? == files::read(&first.join(name))?) };
    let files = units.iter().flat_map(|unit| ["json", "csv"].map(|kind| format!("{unit}.{kind}")));
    let mut differ = Vec::new();
    for file in files.chain([PROGRAM.to_owned()]) {
        if !same(&file)? {
            differ.push(file);
        }
    }
    println!("{} of {} files reproduce", 2 * units.len() + 1 - differ.len(), 2 * units.len() + 1);
    differ.iter().for_each(|file| println!("differs: {file}"));
    Ok(differ.is_empty())
}

fn answer_sealed(into: &Path) -> Result<Vec<String>, Failure> {
    let clock = Instant::now();
    let from = folder().join("sealed");
    let names = units(&from)?;
    let program = program::hash(&root())?;
    let (coil, cache, _) = prepared()?;
    let files = answers(&from, &names, &coil, &cache, clock)?;
    if program::hash(&root())? != program {
        return Err(Failure("a source changed while the units were answered; nothing is written".into()));
    }
    write(into, &names, &files, Some(&program))?;
    Ok(names)
}
