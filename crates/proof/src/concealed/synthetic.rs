//! `cargo xtask prove --synthetic`: many units of the project's own generator, so that rates have tight intervals.

use std::path::Path;
use std::time::Instant;

use fogcoil::cache::Cache;
use fogcoil::input;

use super::answer::{answer, answered, paths, records};
use super::chain;
use super::score::{Scored, score};
use super::units::each;
use crate::files::{self, root};
use crate::truth::Truth;
use clap::Args;

use crate::Failure;
use crate::generator::{self, Generator, Which};
use crate::program;

/// How many units of which seed.
#[derive(Debug, Clone, PartialEq, Eq, Args)]
pub(crate) struct Plan {
    /// Of the synthetic units
    #[arg(long, requires = "synthetic", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Synthetic units in which nothing is concealed
    #[arg(long, value_name = "N", requires = "synthetic", default_value_t = 300)]
    pub(crate) nulls: usize,
    /// Synthetic units in which something is
    #[arg(long, value_name = "N", requires = "synthetic", default_value_t = 200)]
    pub(crate) concealed: usize,
}

/// A unit with its answer held against its truth.
pub(crate) struct Case {
    pub(crate) scored: Scored,
    /// Noise that the identification has no term for.
    pub(crate) unseen: Option<String>,
}

impl Plan {
    fn units(&self) -> Vec<Which> {
        let all = (0..self.nulls.max(self.concealed)).flat_map(|n| [Which::Null(n), Which::Concealed(n)]);
        all.filter(|which| match which {
            Which::Null(n) => *n < self.nulls,
            Which::Concealed(n) => *n < self.concealed,
        })
        .collect()
    }

    /// All units in `folder`: made, then answered, and only then held against their truths.
    pub(crate) fn cases(&self, folder: &Path, cache: &Cache) -> Result<Vec<Case>, Failure> {
        let clock = Instant::now();
        // of the sources that this program was just built from
        let program = program::hash(&root())?;
        let say = |what: &str, unit: &str| eprintln!("[{:6.0} s] {unit} {what}", clock.elapsed().as_secs_f64());
        let names: Vec<String> = self.units().iter().map(|which| which.name()).collect();
        let coil = input::read_coil(&root().join("fixtures/coil-reference.ron"))?;
        check_generator(folder)?;
        let generator = Generator::new(coil.design.clone())?;
        let truth_of = |unit: &str| folder.join("truth").join(format!("{unit}.ron"));
        each(&names, |name| {
            let which = Which::of(name).ok_or_else(|| Failure("no unit has this name".into()))?;
            // written last of a unit's files
            if !truth_of(name).exists() {
                let unit = generator.unit(self.seed, which)?;
                let at = folder.join(name);
                let files = [("fit.csv", unit.fit), ("holdout.csv", unit.holdout), ("meta.ron", unit.meta)];
                files::write_all(&files.map(|(file, text)| (at.join(file), text)))?;
                files::write_all(&[(truth_of(name), unit.truth)])?;
                say("is made", name);
            }
            Ok(())
        })?;
        let answers = folder.join("answers").join(&program[..16]);
        // the library is built once, before the threads ask for it
        let library = chain::library(&coil, cache)?;
        each(&names, |name| {
            let into = paths(&answers, name);
            if !into.iter().all(|file| file.exists()) {
                let files = answer(&coil, &records(&folder.join(name)), cache)?;
                let [json, prediction] = into;
                files::write_all(&[(prediction, files.prediction), (json, files.json)])?;
                say("is answered", name);
            }
            Ok(())
        })?;
        each(&names, |name| {
            let mut truth = Truth::read(&truth_of(name))?;
            let (answer, predicted) = answered(&answers, name)?;
            let model = chain::Unit::new(&library, &records(&folder.join(name)))?;
            super::inseparable::extend(&mut truth, &answer, &model)?;
            let held = model.held_out(&truth, &predicted)?;
            Ok(Case { scored: score(name, &truth, &answer, Some(held)), unseen: truth.noise.unseen })
        })
    }
}

/// Units of another generator are not mixed with these.
fn check_generator(folder: &Path) -> Result<(), Failure> {
    let hash = generator::fingerprint();
    let file = folder.join("GENERATOR");
    if !file.exists() {
        return files::write_all(&[(file, hash)]);
    }
    if files::read(&file)? != hash {
        let problem = "these units are of another generator; remove the folder, or give another --seed";
        return Err(Failure(format!("{}: {problem}", folder.display())));
    }
    Ok(())
}
