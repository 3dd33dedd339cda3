//! `fogcoil compare`: two designs A and B side by side: their differing keys, their sensitivities by part with errors and tolerances, their bias under a
//! profile; and B less A of each.

mod course;
mod drawing;
mod joint;
mod report;
mod text;

use coil::{Number, SteadySensitivity};
use files::{Note, Remark};
use progress::Step;

pub use course::CourseNumbers;
pub use drawing::Differing;
pub use report::report;
pub use text::{json, text};

use crate::Error;
use crate::cache::Cache;
use crate::input::{CoilCase, ProfileCase};
use crate::simulate::{Simulation, model, simulate};
use joint::Joint;

/// The parts of a sensitivity, and their sum.
pub const PARTS: [&str; 4] = ["shupe", "eo_axial", "eo_radial", "total"];

/// A part of the sensitivity in A, in B, and B less A, (deg/h)/(degC/min).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Value in A, value in B, and B less A.
    pub value: [f64; 3],
    /// Numerical error of each: an estimate; that of the difference is the sum of both.
    pub error: [f64; 3],
    /// One standard deviation of each by tolerances, to first order; of the difference, where the deviations of numbers that both designs share are the same.
    pub sd: [f64; 3],
    /// One standard deviation of the difference between two units that have no deviation in common.
    pub sd_apart: f64,
}

/// Effect of one standard deviation of a number on the sensitivity, (deg/h)/(degC/min).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Changed {
    /// Its key.
    pub key: &'static str,
    /// Change in A and in B; 0 where a design has no such number, or has it exactly.
    pub change: [f64; 2],
    /// Whether both designs have it with the same value, tolerance and correlations, so that its deviation is the same in both.
    pub shared: bool,
}

/// Two designs compared.
pub struct Comparison<'a> {
    /// A and B.
    pub cases: [&'a CoilCase; 2],
    /// Keys whose values differ, in the order of a coil file.
    pub differing: Vec<Differing>,
    /// Keys whose tolerances differ, in words.
    pub tolerances: Vec<Differing>,
    /// The parts, in the order of [`PARTS`].
    pub parts: [Part; 4],
    /// Change of each part, the largest change of the total first.
    pub changes: Vec<Changed>,
    /// Length of the fibre with tails \[m\].
    pub length: [f64; 2],
    /// Comparison under a profile.
    pub simulations: Option<[Simulation<'a>; 2]>,
}

/// Compares two designs; under a profile, if it is given, as each of them reads it.
///
/// # Errors
/// [`files::Error::Coil`] names the design that cannot be modelled.
pub fn compare<'a>(
    cases: [&'a CoilCase; 2],
    profiles: Option<&'a [ProfileCase; 2]>,
    cache: &Cache,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Comparison<'a>, Error> {
    let [a, b] = cases;
    progress(Step::begins("modelling both coils"));
    let steady = [a.steady_sensitivity()?, b.steady_sensitivity()?];
    progress(Step::begins("varying both within their tolerances"));
    let moved = [a.sensitivity_changes()?, b.sensitivity_changes()?];
    let numbers = [0, 1].map(|k| moved[k].iter().map(|change| change.number).collect::<Vec<Number>>());
    let joint = Joint::of(cases, [&numbers[0], &numbers[1]]);
    let each = [0, 1].map(|k| {
        moved[k].iter().map(|change| with_total([change.parts.shupe, change.parts.eo_axial, change.parts.eo_radial])).collect()
    });
    let simulations = match profiles {
        None => None,
        Some([for_a, for_b]) => {
            let run = |case: &'a CoilCase, profile: &'a ProfileCase, name: &str| {
                progress(Step::begins(name));
                simulate(case, profile, &model(case, &profile.drives, cache)?)
            };
            Some([run(a, for_a, "simulating A")?, run(b, for_b, "simulating B")?])
        }
    };
    Ok(Comparison {
        cases,
        differing: drawing::differing(cases),
        tolerances: drawing::tolerances(cases),
        parts: parts(&steady, &each, &joint),
        changes: changes(cases, &numbers, &each, &joint),
        length: steady.map(|steady| steady.length),
        simulations,
    })
}

impl Comparison<'_> {
    /// What the profile's rows are too long for, if they are.
    fn long_rows(&self) -> impl Iterator<Item = String> {
        let notes = self.simulations.iter().flat_map(|[a, _]| &a.profile.notes);
        notes.filter(|note| matches!(note.remark, Remark::LongRows)).map(Note::line)
    }
}

fn with_total([a, b, c]: [f64; 3]) -> [f64; 4] {
    [a, b, c, a + b + c]
}

fn parts(steady: &[SteadySensitivity; 2], each: &[Vec<[f64; 4]>; 2], joint: &Joint) -> [Part; 4] {
    let values = steady.map(|s| with_total([s.sensitivity.shupe, s.sensitivity.eo_axial, s.sensitivity.eo_radial]));
    let errors = steady.map(|s| [s.part_errors.shupe, s.part_errors.eo_axial, s.part_errors.eo_radial, s.error_estimate]);
    [0, 1, 2, 3].map(|part| {
        let ([a, b], [of_a, of_b]) = (values.map(|v| v[part]), errors.map(|e| e[part]));
        let changes = [0, 1].map(|k| each[k].iter().map(|parts| parts[part]).collect::<Vec<f64>>());
        let [sd_a, sd_b, difference] = joint.sd([&changes[0], &changes[1]]);
        Part { value: [a, b, b - a], error: [of_a, of_b, of_a + of_b], sd: [sd_a, sd_b, difference], sd_apart: sd_a.hypot(sd_b) }
    })
}

fn changes(cases: [&CoilCase; 2], numbers: &[Vec<Number>; 2], each: &[Vec<[f64; 4]>; 2], joint: &Joint) -> Vec<Changed> {
    let mut all: Vec<Number> = numbers[0].clone();
    all.extend(numbers[1].iter().filter(|number| !numbers[0].contains(number)));
    let of = |number: Number| {
        let change = [0, 1].map(|k| numbers[k].iter().position(|n| *n == number).map_or(0.0, |at| each[k][at][3]));
        let (key, _) = cases.iter().find_map(|case| crate::input::keyed(number, &case.design))?;
        Some(Changed { key, change, shared: joint.shares(number) })
    };
    let mut changes: Vec<Changed> = all.into_iter().filter_map(of).collect();
    let most = |changed: &Changed| changed.change.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    changes.sort_by(|a, b| most(b).total_cmp(&most(a)));
    changes
}
