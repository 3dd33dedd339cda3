//! The plan of a sweep, `PLAN.ron`, read and checked.

use std::path::{Path, PathBuf};

use files::{Note, Remark};
use serde::Deserialize;
use sha2::{Digest, Sha256};

use super::outputs::{Output, TOTAL};
use super::points::{LONGEST_SEQUENCE, Points, Sampling};
use crate::input::{CoilCase, Fingerprint, InputError, check_ron, fault_in, hexadecimal, read_profile, read_ron};
use crate::variants::{
    Choice, Dimensions, Drawing, Factor, Group, Kind, MOST_FACTORS, Others, Variants, Varied, each_once, variants,
};
use crate::{Error, program};

/// Most points of a plan.
pub const MOST_POINTS: usize = 10_000_000;
/// Most points of a Latin hypercube, whose order is held in memory.
const MOST_OF_HYPERCUBE: usize = 1_000_000;

/// Paths inside are relative to the plan's own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlanFile {
    design: String,
    sampling: Sampling,
    #[serde(default)]
    seed: u64,
    #[serde(default, deserialize_with = "each_once")]
    vary: Vec<(String, Varied)>,
    #[serde(default)]
    others: Others,
    #[serde(default)]
    dimensions: Dimensions,
    #[serde(default = "usual_outputs")]
    outputs: Vec<OutputFile>,
}

#[derive(Deserialize, Clone, PartialEq)]
enum OutputFile {
    Sensitivity,
    Tolerances,
    Winding,
    Simulation(String),
}

fn usual_outputs() -> Vec<OutputFile> {
    vec![OutputFile::Sensitivity]
}

/// A plan: factors, points and outputs.
pub struct Plan {
    /// The plan's file and all that it names.
    pub files: Vec<Fingerprint>,
    /// Choice of points.
    pub sampling: Sampling,
    /// Seed of the points.
    pub seed: u64,
    /// The varied factors.
    pub variants: Variants,
    /// The points.
    pub points: Points,
    /// The groups of factors that are there.
    pub groups: Vec<Group>,
    /// The computed outputs.
    pub outputs: Vec<Output>,
    /// Whether the factors are the numbers with a tolerance and nothing else.
    pub is_band: bool,
    count: usize,
    /// The file that holds this code; `None`: the executable.
    code: Option<PathBuf>,
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
    let drawing = Drawing::read(&beside(path, &file.design))?;
    let case = &drawing.case;
    check_tolerances(path, &file, case)?;
    let mut files = [vec![own], case.fingerprints.clone()].concat();
    let outputs = outputs(path, &file.outputs, case, &mut files)?;
    let is_band = file.vary.iter().all(|(_, varied)| *varied == Varied::Tolerance) && file.others == Others::WithinTolerances;
    let variants = variants(path, drawing, &file.vary, file.others, file.dimensions)?;
    files.extend(variants.cells.iter().cloned());
    let groups: Vec<Group> =
        Group::ALL.into_iter().filter(|group| variants.factors.iter().any(|factor| factor.group == *group)).collect();
    let points = points(path, &file, &variants, &groups)?;
    let count = points.count().filter(|count| (1..=MOST_POINTS).contains(count)).ok_or_else(|| {
        let count = points.count().map_or("more than a machine counts".to_owned(), |count| count.to_string());
        fault(path, "sampling", format!("these are {count} points"), &format!("give 1 to {MOST_POINTS}"))
    })?;
    Ok(Plan { files, sampling: file.sampling, seed: file.seed, variants, points, groups, outputs, is_band, count, code: None })
}

fn beside(plan: &Path, named: &str) -> PathBuf {
    plan.parent().unwrap_or(Path::new("")).join(named)
}

fn fault(path: &Path, field: &str, problem: String, remedy: &str) -> InputError {
    fault_in(path, field, problem, remedy.to_owned())
}

fn check_tolerances(path: &Path, file: &PlanFile, case: &CoilCase) -> Result<(), Error> {
    let correlated = !case.tolerances.correlations.is_empty();
    if correlated && matches!(file.sampling, Sampling::Indices(_)) {
        let problem = "Sobol' indices are of independent numbers, but the drawing has correlations".to_owned();
        return Err(fault(path, "sampling", problem, "give another sampling, or a drawing without correlations").into());
    }
    Ok(())
}

fn outputs(path: &Path, named: &[OutputFile], case: &CoilCase, files: &mut Vec<Fingerprint>) -> Result<Vec<Output>, Error> {
    let kind = |output: &OutputFile| std::mem::discriminant(output);
    let twice = (1..named.len()).any(|n| named[..n].iter().any(|other| kind(other) == kind(&named[n])));
    if named.is_empty() || twice {
        let problem = if twice { "an output is given twice" } else { "nothing is computed" };
        let remedy = "give some of Sensitivity, Tolerances, Winding, Simulation(\"profile.csv\"), each once";
        return Err(fault(path, "outputs", problem.to_owned(), remedy).into());
    }
    let of = |output: &OutputFile| {
        Ok(match output {
            OutputFile::Sensitivity => Output::Sensitivity,
            OutputFile::Tolerances => Output::Tolerances,
            OutputFile::Winding => Output::Winding,
            OutputFile::Simulation(profile) => {
                let mut profile = read_profile(&beside(path, profile), &case.design, &[])?;
                profile.note_long_rows("give it rows of half a minute");
                files.push(profile.fingerprint.clone());
                Output::Simulation(Box::new(profile))
            }
        })
    };
    named.iter().map(of).collect()
}

fn points(path: &Path, file: &PlanFile, variants: &Variants, groups: &[Group]) -> Result<Points, Error> {
    let at = |problem: String, remedy: &str| Err(fault(path, "sampling", problem, remedy).into());
    let factors = &variants.factors;
    let levels: Vec<Option<usize>> = factors.iter().map(Factor::levels).collect();
    match file.sampling {
        Sampling::Grid => {
            if let Some(n) = levels.iter().position(Option::is_none) {
                let problem = format!("{:?} has no values to go through", factors[n].key);
                return at(problem, "give Steps(from, to, count), Whole(from, to, by), OneOf([...]) or Named({...}) in a grid");
            }
        }
        Sampling::LatinHypercube(count) if count > MOST_OF_HYPERCUBE => {
            return at(
                format!("{count} points"),
                &format!("give a Latin hypercube of at most {MOST_OF_HYPERCUBE}, or MonteCarlo"),
            );
        }
        Sampling::Sobol(count) | Sampling::Indices(count) if count > LONGEST_SEQUENCE => {
            let remedy = format!("give at most {LONGEST_SEQUENCE}, or LatinHypercube or MonteCarlo");
            return at(format!("a Sobol' sequence of {count} points is not known"), &remedy);
        }
        Sampling::Indices(count) if count < 2 => return at(format!("{count} pairs tell nothing"), "give some hundreds"),
        Sampling::Indices(_) if !file.outputs.contains(&OutputFile::Sensitivity) => {
            return at("Sobol' indices are those of the sensitivity".into(), "add Sensitivity to outputs");
        }
        Sampling::Indices(_) if factors.len() > MOST_FACTORS => return at("too many numbers vary".into(), "vary fewer"),
        _ => {}
    }
    let place = |factor: &Factor| groups.iter().position(|group| *group == factor.group).unwrap_or(0);
    let levels = levels.into_iter().map(|levels| levels.unwrap_or(0)).collect();
    Ok(Points::new(file.sampling, file.seed, levels, factors.iter().map(place).collect()))
}

impl Plan {
    /// The same plan for code that is not in the executable but in a library that it loads, `file`.
    #[must_use]
    pub fn of_code_in(self, file: impl Into<PathBuf>) -> Self {
        Self { code: Some(file.into()), ..self }
    }

    /// Notes on the profiles whose rows are too long.
    pub fn notes(&self) -> impl Iterator<Item = &Note> {
        let notes = self.outputs.iter().flat_map(|output| match output {
            Output::Simulation(profile) => profile.notes.as_slice(),
            _ => &[],
        });
        notes.filter(|note| note.remark == Remark::LongRows)
    }

    /// Number of points.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Names of all outputs.
    pub fn names(&self) -> Vec<&'static str> {
        self.outputs.iter().flat_map(|output| output.names().iter().copied()).collect()
    }

    /// Whether there is a picture of it: of indices, or of the sensitivity against a number that it states.
    pub fn can_be_drawn(&self) -> bool {
        let is_number = |varied: &Varied| match varied {
            Varied::Named(_) => false,
            Varied::OneOf(choices) => choices.iter().any(|choice| matches!(choice, Choice::Number(_))),
            _ => true,
        };
        let states_one =
            || self.variants.factors.iter().any(|factor| matches!(&factor.kind, Kind::Key(varied) if is_number(varied)));
        matches!(self.sampling, Sampling::Indices(_)) || self.names().contains(&TOTAL) && states_one()
    }

    /// SHA-256 of all inputs of the rows: the program, the plan, the files that it names.
    pub fn hash(&self) -> String {
        let mut hash = Sha256::new().chain_update(format!("{}\n", program::hash(self.code.as_deref())));
        self.files.iter().for_each(|file| hash.update(format!("{}\n", file.sha256)));
        hexadecimal(&hash.finalize())
    }
}
