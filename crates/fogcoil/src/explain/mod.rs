//! `fogcoil explain`: changes of a coil that would give a measured sensitivity, and their distance from the expected coil.

mod explanation;
mod say;
mod solve;
mod test;

use coil::{Design, MechanicalState, sensitivity_in};
use diagnosis::{ForwardModel, Prior, Role, expected};
use mechanisms::{CATALOGUE, Chamber, Gyro, Mechanism, Prepared, RATE, Steady};
use progress::Step;

use crate::Error;
use crate::cache::Cache;
use crate::input::CoilCase;
use crate::other_drawing::{OtherDrawing, other_drawings};
use crate::prepare::library;
use crate::recommend::{Limits, prepared, programmes};

pub use explanation::{Explanation, PLAUSIBLE, Reach, STRAINED};
pub use say::{json, text};
pub use test::Test;

/// All explanations of a sensitivity.
#[derive(Debug, Clone)]
pub struct Explained {
    /// The measured sensitivity with the sign it was taken with, (deg/h)/(degC/min).
    pub measured: f64,
    /// Whether that sign is the design's own: it was measured as a magnitude.
    pub magnitude: bool,
    /// Sensitivity of the design.
    pub nominal: f64,
    /// Numerical error of the design's.
    pub error: f64,
    /// Remainder of the difference beside the design's own constants, uncertain together \[σ\].
    pub recalibrate: f64,
    /// Their joint standard uncertainty, (deg/h)/(degC/min).
    pub constants: f64,
    /// Explanations, in the library's order.
    pub explanations: Vec<Explanation>,
    /// What the design gives with one word of the drawing changed: key and value, and the sensitivity.
    pub drawings: Vec<(String, f64)>,
    /// Tests that tell the plausible ones apart.
    pub tests: Vec<Test>,
}

/// Explains a measured sensitivity, (deg/h)/(degC/min); a positive one without a sign (`magnitude`) is taken with that of the design.
///
/// # Errors
/// [`files::Error::Usage`] for a sensitivity that is not a number; [`files::Error::Coil`] if the design cannot be modelled.
pub fn explain(
    case: &CoilCase,
    measured: f64,
    magnitude: bool,
    cache: &Cache,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Explained, Error> {
    if !measured.is_finite() || measured.abs() > MOST {
        return Err(Error::usage(format!("--sensitivity {measured}: give a magnitude up to {MOST} (deg/h)/(degC/min)")));
    }
    let magnitude = magnitude && measured >= 0.0;
    let coil = Error::of_coil(&case.file);
    let steady = case.steady_sensitivity()?;
    let nominal = steady.sensitivity.total();
    let measured = if magnitude { measured.copysign(nominal) } else { measured };
    let library = library(case, cache, progress)?;
    // one of each family
    let mut programmes = programmes(&Limits::USUAL);
    programmes.dedup_by_key(|programme| programme.family);
    let (time, chamber) = ramp();
    let ramp = std::iter::once(Prepared::under(&library, &time, &Chamber::given(&time, &chamber), 0.0));
    let records = ramp.chain(programmes.iter().map(|programme| prepared(&library, programme)));
    let records = records.collect::<Result<Vec<_>, _>>().map_err(coil)?;
    let gyro = Gyro::new(library, CATALOGUE, records).map_err(coil)?;
    progress(Step::begins("solving for every mechanism"));
    let problem = Problem { design: &case.design, target: measured, error: steady.error_estimate, nominal };
    let all = gyro.mechanisms().iter().enumerate();
    let explanations: Vec<Explanation> = all.flat_map(|(k, entry)| problem.explanations(entry, gyro.mechanism(k))).collect();
    let constants = constants(&gyro).map_err(coil)?;
    let given = |other: OtherDrawing| Some((other.words, problem.sensitivity(&other.design, &MechanicalState::NOMINAL)?));
    let drawings = other_drawings(&case.design).into_iter().filter_map(given).collect();
    let tests = test::tests(&gyro, &explanations, &programmes, progress).map_err(Error::of_diagnosis(&case.file))?;
    Ok(Explained {
        measured,
        magnitude,
        nominal,
        error: steady.error_estimate,
        recalibrate: (measured - nominal) / constants,
        constants,
        explanations,
        drawings,
        tests,
    })
}

/// Largest sensitivity that is explained, (deg/h)/(degC/min).
const MOST: f64 = 1000.0;

/// A ramp of ten hours over the range of the tests, long enough to be steady: instants \[s\] and temperatures \[°C\].
fn ramp() -> (Vec<f64>, Vec<f64>) {
    const ROWS: u32 = 601;
    let share = |n: u32| f64::from(n) / f64::from(ROWS - 1);
    let Limits { coldest, hottest, .. } = Limits::USUAL;
    let chamber = |n| coldest + (hottest - coldest) * share(n);
    ((0..ROWS).map(|n| 60.0 * f64::from(n)).collect(), (0..ROWS).map(chamber).collect())
}

/// Standard uncertainty that the design's constants leave together, (deg/h)/(degC/min): the record 0 is the ramp.
fn constants(gyro: &Gyro) -> Result<f64, coil::Error> {
    let middle = expected(gyro.nuisances());
    let (time, chamber) = ramp();
    let per_minute = 60.0 * (chamber[1] - chamber[0]) / (time[1] - time[0]);
    let steady = |nuisances: &[f64]| -> Result<f64, coil::Error> {
        let rate = gyro.respond(0, nuisances, &[])?.swap_remove(RATE);
        Ok(rate[rate.len() - 1] / per_minute)
    };
    let nominal = steady(&middle)?;
    let mut square = 0.0;
    for (k, nuisance) in gyro.nuisances().iter().enumerate().filter(|(_, n)| n.role == Role::Constant) {
        let mut moved = middle.clone();
        moved[k] = nuisance.parameter.prior.value(1.0);
        square += (steady(&moved)? - nominal).powi(2);
    }
    Ok(square.sqrt())
}

/// Reason why a mechanism that leaves the fields of a steady ramp as they are cannot change the sensitivity.
const EVEN: &str = "in a steady ramp everything warms at the same rate: no heat path matters";

struct Problem<'a> {
    design: &'a Design,
    target: f64,
    /// numerical error of a sensitivity
    error: f64,
    /// sensitivity of the design as it is
    nominal: f64,
}

impl Problem<'_> {
    /// `None` where a change is too large to be modelled.
    fn sensitivity(&self, design: &Design, state: &MechanicalState) -> Option<f64> {
        Some(sensitivity_in(design, state).ok()?.total())
    }

    fn explanations(&self, entry: &diagnosis::Omission, mechanism: &dyn Mechanism) -> Vec<Explanation> {
        let of = |steady: Steady| {
            let prior = |parameter: usize| &entry.parameters[parameter].prior;
            let (outcome, parameter, when) = match steady {
                Steady::Nothing(why) => (Reach::Unable { why }, None, ""),
                Steady::Design(changed) => {
                    (self.change(prior(0), |design, x| (changed(design, x), MechanicalState::NOMINAL)), Some(0), "")
                }
                Steady::Rewinds { turns, changed } => (self.rewinding(prior(turns), changed), Some(turns), ""),
                Steady::Changes { parameter, changed, when } => (self.change(prior(parameter), changed), Some(parameter), when),
            };
            let parameter = parameter.map_or(String::new(), |p| entry.parameters[p].name.clone());
            Explanation { id: entry.id.clone(), parameter, when, outcome }
        };
        mechanism.facts().steady.into_iter().map(of).collect()
    }

    fn change(&self, prior: &Prior, changed: impl Fn(&Design, f64) -> (Design, MechanicalState)) -> Reach {
        let at = |u: f64| {
            let (design, state) = changed(self.design, prior.value(u));
            self.sensitivity(&design, &state)
        };
        let course = solve::course(&at);
        let (low, high) = course.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.1), h.max(p.1)));
        let nominal = self.nominal;
        if high - low < 1e-6 * nominal.abs() && (high - nominal).abs() < 1e-6 * nominal.abs() {
            return Reach::Unable { why: EVEN };
        }
        match solve::nearest(&course, self.target, &at) {
            None => Reach::OutOfReach { range: [low, high] },
            Some((u, slope)) => {
                let value = prior.value(u);
                let per_u = (prior.value(u + 1e-3) - prior.value(u - 1e-3)) / 2e-3;
                Reach::Gives { value, error: (self.error * per_u / slope).abs(), sigma: u, layer: None }
            }
        }
    }

    /// The fewest turns in any layer.
    fn rewinding(&self, prior: &Prior, changed: fn(&Design, usize, i32) -> Design) -> Reach {
        let most = prior.value(solve::REACH).floor() as i32;
        let mut best: Option<(i32, usize, f64)> = None;
        let (mut plausible, mut range) = (0, [f64::INFINITY, f64::NEG_INFINITY]);
        for layer in 1..=self.design.winding.layers {
            let at = |turns: i32| self.sensitivity(&changed(self.design, layer, turns), &MechanicalState::NOMINAL);
            let Some((turns, slope)) = solve::whole(self.target, most, self.nominal, &at, &mut range) else { continue };
            plausible += usize::from(prior.standard(f64::from(turns)).abs() <= PLAUSIBLE);
            if best.is_none_or(|(least, ..)| turns.abs() < least.abs()) {
                best = Some((turns, layer, slope));
            }
        }
        match best {
            None => Reach::OutOfReach { range },
            Some((turns, layer, slope)) => {
                let value = f64::from(turns);
                let error = (self.error / slope).abs().max(0.5);
                Reach::Gives { value, error, sigma: prior.standard(value), layer: Some((layer, plausible)) }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error is of the mesh behind the value: the design's own sensitivity is met without any change.
    #[test]
    fn what_is_solved_for_and_its_error_are_of_one_mesh() {
        let case =
            crate::input::read_coil(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron").as_ref()).unwrap();
        let steady = case.steady_sensitivity().unwrap();
        let nominal = steady.sensitivity.total();
        let problem = Problem { design: &case.design, target: nominal, error: steady.error_estimate, nominal };
        assert_eq!(problem.sensitivity(&case.design, &MechanicalState::NOMINAL), Some(nominal));
    }
}
