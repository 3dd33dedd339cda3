//! The plan of an optimisation, `PLAN.ron`, read and checked.

use std::path::Path;

use serde::Deserialize;

use super::measure::Measure;
use crate::Error;
use crate::input::{Fingerprint, InputError, check_ron, fault_in, meant, read_ron};
use crate::variants::{Dimensions, Drawing, Others, Variants, Varied, each_once, variants};

/// Paths inside are relative to the plan's own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlanFile {
    design: String,
    #[serde(deserialize_with = "each_once")]
    vary: Vec<(String, Varied)>,
    #[serde(default)]
    dimensions: Dimensions,
    minimise: Vec<Measure>,
    #[serde(default, deserialize_with = "each_once")]
    limits: Vec<(String, (f64, f64))>,
    #[serde(default = "usual_trials")]
    trials: usize,
    #[serde(default)]
    seed: u64,
}

fn usual_trials() -> usize {
    1000
}

/// Designs that may be tried.
const TRIALS: std::ops::RangeInclusive<usize> = 10..=1_000_000;
/// Most combinations of choices.
const MOST_COMBINATIONS: usize = 10_000;

/// A plan: numbers to minimise, varied keys and limits.
pub struct Plan {
    /// The plan's file and all that it names.
    pub files: Vec<Fingerprint>,
    /// The varied keys.
    pub variants: Variants,
    /// Numbers to minimise; the first decides which design is the optimum.
    pub minimise: Vec<Measure>,
    /// Numbers that must lie within two ends.
    pub limits: Vec<(Measure, [f64; 2])>,
    /// About how many designs are tried.
    pub trials: usize,
    /// Seed of the points.
    pub seed: u64,
}

/// Reads and checks a plan and the files that it names.
///
/// # Errors
/// As [`check_plan`].
pub fn read_plan(path: &Path) -> Result<Plan, Error> {
    checked(path, read_ron(path)?)
}

/// Checks a plan that is not in a file, with the content of one, and reads the files that it names; messages call it `path`, and its paths start there.
///
/// # Errors
/// [`files::Error::Input`] says what is wrong, in which file, line and field, and how to mend it.
pub fn check_plan(path: &Path, text: &str) -> Result<Plan, Error> {
    checked(path, check_ron(path, text)?)
}

fn checked(path: &Path, (file, own): (PlanFile, Fingerprint)) -> Result<Plan, Error> {
    check_measures(path, &file)?;
    let drawing = Drawing::read(&path.parent().unwrap_or(Path::new("")).join(&file.design))?;
    let files = [vec![own], drawing.case.fingerprints.clone()].concat();
    let variants = variants(path, drawing, &file.vary, Others::AsDrawn, file.dimensions)?;
    if let Some((key, _)) = file.vary.iter().find(|(_, varied)| matches!(varied, Varied::Tolerance | Varied::Normal(..))) {
        let problem = format!("{key:?} has a distribution, but what is optimised is chosen");
        return Err(fault(path, "vary", problem, "give its ends, e.g. Uniform(2.0, 6.0), or choices").into());
    }
    let combinations = variants.factors.iter().filter(|factor| factor.is_choice()).filter_map(|factor| factor.levels());
    let combinations = combinations.fold(1_usize, usize::saturating_mul);
    if combinations > MOST_COMBINATIONS.min(file.trials) {
        let problem = format!("the choices make {combinations} combinations, of which each is tried");
        let remedy = format!("give at most {MOST_COMBINATIONS}, and trials for each, or some of them as Whole(from, to, by)");
        return Err(fault(path, "vary", problem, &remedy).into());
    }
    let limits = limits(path, &file)?;
    Ok(Plan { files, variants, minimise: file.minimise, limits, trials: file.trials, seed: file.seed })
}

fn fault(path: &Path, field: &str, problem: String, remedy: &str) -> InputError {
    fault_in(path, field, problem, remedy.to_owned())
}

fn check_measures(path: &Path, file: &PlanFile) -> Result<(), Error> {
    let twice = (1..file.minimise.len()).any(|n| file.minimise[..n].contains(&file.minimise[n]));
    if file.minimise.is_empty() || twice {
        let problem = if twice { "something is given twice" } else { "nothing is minimised" }.to_owned();
        return Err(fault(path, "minimise", problem, "give some of Sensitivity, Spread, Worst, Mass, Length, each once").into());
    }
    if !TRIALS.contains(&file.trials) {
        let problem = format!("{} designs are to be tried", file.trials);
        return Err(fault(path, "trials", problem, &format!("give {} to {}", TRIALS.start(), TRIALS.end())).into());
    }
    Ok(())
}

fn limits(path: &Path, file: &PlanFile) -> Result<Vec<(Measure, [f64; 2])>, Error> {
    let of = |(name, (low, high)): &(String, (f64, f64))| {
        let known = Measure::ALL.into_iter().find(|measure| measure.name() == name);
        let Some(measure) = known else {
            let names = Measure::ALL.map(Measure::name);
            let remedy = format!("give some of {}{}", names.join(", "), meant(name, names));
            return Err(fault(path, "limits", format!("{name:?} is nothing that is limited"), &remedy).into());
        };
        if low.is_nan() || high.is_nan() || low >= high {
            let problem = format!("{name:?}: from {low} to {high} is no range");
            return Err(fault(path, "limits", problem, "give two numbers, the lower first").into());
        }
        Ok((measure, [*low, *high]))
    };
    file.limits.iter().map(of).collect()
}

impl Plan {
    /// Whether a measure is minimised or limited.
    pub fn asks(&self, of: impl Fn(Measure) -> bool) -> bool {
        self.minimise.iter().chain(self.limits.iter().map(|(measure, _)| measure)).any(|measure| of(*measure))
    }
}
