//! `cargo xtask prove --synthetic`: many units of the project's own generator, so that rates have tight intervals.

use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;

use clap::Args;
use fogcoil::cache::Cache;
use fogcoil::input;

use super::answer::{answered, of_unit, paths, records};
use super::answers::each;
use super::score::{Scored, score};
use super::summary::{ScoreRow, failures, summary};
use super::{chain, report};
use crate::files::{self, root};
use crate::generator::{self, Generator, Which};
use crate::statistics::{Measured, rate};
use crate::truth::{Kind, Truth};
use crate::{Failure, program};

/// Number of units, and their seed.
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
        let coil = input::read_coil(&root().join("fixtures/concealed/coil.ron"))?;
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
                let contents = of_unit(&coil, &folder.join(name), cache)?;
                files::write_all(&into.into_iter().zip(contents).collect::<Vec<_>>())?;
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

/// Makes, answers and scores the units of a plan; writes the section of docs/proof.md. Whether all scores are as asked.
pub(super) fn run(plan: &Plan) -> Result<bool, Failure> {
    let folder = root().join("target/prove/synthetic").join(plan.seed.to_string());
    let program = program::hash(&root())?;
    let cases = plan.cases(&folder, &Cache::of_user())?;
    let scored: Vec<Scored> = cases.iter().map(|case| case.scored.clone()).collect();
    let rows = summary(&scored);
    report::publish("synthetic", &program, &section(plan, &cases, &rows))?;
    println!("{}", report::lines(&rows));
    failures(&rows).for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(failures(&rows).next().is_none())
}

fn share(cases: &[&Case]) -> String {
    let raised = cases.iter().filter(|case| case.scored.detected).count();
    match rate(raised, cases.len()) {
        Some(Measured { value, interval: [low, high], cases }) => {
            format!("{raised} of {cases}: {:.1} % [{:.1} to {:.1}]", 100.0 * value, 100.0 * low, 100.0 * high)
        }
        None => "no unit".into(),
    }
}

/// Kind of an unseen noise: what its label says before its numbers.
fn kind(label: &str) -> &str {
    label.split(" of ").next().unwrap_or(label)
}

/// The scores, and the nulls by the noise they have.
fn section(plan: &Plan, cases: &[Case], rows: &[ScoreRow]) -> String {
    let nulls: Vec<&Case> = cases.iter().filter(|case| case.scored.kind == Kind::Null).collect();
    let mut out = format!(
        "Seed {}: {} units with nothing concealed, {} with something. Names that an answer gives count as inseparable from the truth where the \
         diagnosis' own forward model, fitted to the noise-free response of the truth, comes within three standard deviations of the noise; the tier of a unit is by what the constants, free within their tolerances, leave of the effect.\n\n{}",
        plan.seed,
        plan.nulls,
        plan.concealed,
        report::markdown(rows)
    );
    let _ = write!(
        out,
        "\n### Falsely detected, by the noise of the unit\n\n| noise beside white noise, drift and walk | falsely detected [90 %] |\n|---|---|\n"
    );
    let without: Vec<&Case> = nulls.iter().copied().filter(|case| case.unseen.is_none()).collect();
    let _ = writeln!(out, "| none | {} |", share(&without));
    let mut kinds: Vec<&str> = nulls.iter().filter_map(|case| case.unseen.as_deref()).map(kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for name in kinds {
        let of: Vec<&Case> = nulls.iter().copied().filter(|case| case.unseen.as_deref().map(kind) == Some(name)).collect();
        let _ = writeln!(out, "| {name} | {} |", share(&of));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::truth::Tier;

    #[test]
    fn units_are_answered() {
        made(1);
    }

    #[test]
    #[ignore = "minutes"]
    fn more_units_are_answered() {
        made(2);
    }

    #[test]
    #[ignore = "minutes"]
    fn units_with_strong_effects_are_answered() {
        let scored = made(4);
        let strong = || scored.iter().filter(|s| s.kind == Kind::Single && matches!(s.tier, Tier::Medium | Tier::Strong));
        assert!(strong().count() > 0 && strong().all(|s| s.detected && s.right));
    }

    /// A few units are made, answered and scored; a second run finds them done.
    fn made(concealed: usize) -> Vec<Scored> {
        let folder = tempfile::tempdir().unwrap();
        // the library that the program's tests have it keep, if they ran
        let built = std::env::current_exe().unwrap().ancestors().nth(2).unwrap().to_owned();
        let cache = Cache::in_folder(built.join("../tmp/cache")).of_code_in(built.join("fogcoil"));
        let plan = Plan { seed: 2, nulls: 1, concealed };
        let run = || plan.cases(folder.path(), &cache).unwrap_or_else(|e| panic!("{}", e.0));
        let scored: Vec<_> = run().into_iter().map(|case| case.scored).collect();
        println!("{scored:#?}");
        let of = |kind: Kind| scored.iter().filter(move |s| s.kind == kind);
        assert_eq!((scored.len(), of(Kind::Null).count()), (1 + concealed, 1));
        assert_eq!(of(Kind::Null).filter(|s| s.detected).count(), 0, "falsely detected");
        assert!(scored.iter().all(|s| !s.misnamed), "confident and wrong");
        // what constants may stand in for has no name to be right about, but is seen
        assert!(of(Kind::Single).all(|s| s.detected));
        // nothing is made or answered anew
        let written = || -> Vec<_> {
            let files = |folder: std::path::PathBuf| std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
            let answers = files(folder.path().join("answers")).flat_map(files);
            let mut all: Vec<_> = answers.map(|file| (file.metadata().unwrap().modified().unwrap(), file)).collect();
            all.sort();
            all
        };
        let before = written();
        let again: Vec<_> = run().into_iter().map(|case| case.scored).collect();
        assert!(scored == again && before.len() == 2 * (1 + concealed) && written() == before, "{before:?}");
        scored
    }
}
