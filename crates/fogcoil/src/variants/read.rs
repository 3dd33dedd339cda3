//! Variations of a drawing in a plan, checked: every key is one of the drawing's, every value one that it can have.

use std::path::Path;

use serde::Deserialize;

use super::design::{Drawing, Variants};
use super::factor::{Factor, Kind};
use super::follow::Dimensions;
use super::varied::Varied;
use crate::Error;
use crate::input::{InputError, fault_in};

/// Treatment of the numbers that a plan does not name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum Others {
    /// As the drawing has it.
    #[default]
    AsDrawn,
    /// Every number that has a tolerance deviates by it.
    WithinTolerances,
}

/// Most factors: dimensions of a Sobol' sequence, of which indices take two each.
pub const MOST_FACTORS: usize = 128;

/// Variations of a drawing by the plan in `file`.
///
/// # Errors
/// [`files::Error::Input`] names the key of the plan that the drawing has not, or whose values it cannot have.
pub fn variants(
    file: &Path,
    drawing: Drawing,
    vary: &[(String, Varied)],
    others: Others,
    dimensions: Dimensions,
) -> Result<Variants, Error> {
    let toleranced = Factor::within_tolerances(&drawing.case.design, &drawing.case.tolerances);
    let mut factors = Vec::new();
    for (key, varied) in vary {
        let fault = |problem: String, remedy: &str| in_plan(file, format!("{key:?}: {problem}"), remedy);
        if let Some(problem) = varied.fault() {
            return Err(fault(problem, "see the how-to, Sweep a design"));
        }
        match varied {
            Varied::Tolerance => {
                let own: Vec<&Factor> = toleranced.iter().filter(|factor| is_of(key, &factor.key)).collect();
                if own.is_empty() {
                    return Err(fault("has no tolerance".into(), "give a distribution, e.g. Uniform(2.0, 6.0)"));
                }
                factors.extend(own.into_iter().cloned());
            }
            _ => factors.push(Factor::of_keys(key, varied)),
        }
    }
    if others == Others::WithinTolerances {
        let known: Vec<String> = factors.iter().flat_map(|factor| factor.keys().map(str::to_owned)).collect();
        let free = |factor: &Factor| !known.iter().any(|key| is_of(key, &factor.key) || *key == factor.key);
        factors.extend(toleranced.into_iter().filter(free));
    }
    let keys: Vec<&str> = factors.iter().flat_map(Factor::keys).collect();
    if let Some(n) = (1..keys.len()).find(|n| keys[..*n].contains(&keys[*n])) {
        return Err(in_plan(file, format!("{:?} varies by two keys", keys[n]), "name a field in one key of the plan only"));
    }
    if factors.is_empty() || factors.len() > MOST_FACTORS {
        let problem = format!("{} numbers and choices vary", factors.len());
        return Err(in_plan(file, problem, &format!("vary 1 to {MOST_FACTORS}, or set others: WithinTolerances")));
    }
    let mut variants = Variants::new(drawing, factors, dimensions);
    check(file, &variants)?;
    let (cells, warnings) = variants.cells_of_choices();
    variants.cells = cells;
    variants.case.warnings.extend(warnings);
    Ok(variants)
}

/// Whether a key of a plan is that of a factor, or the common length of both tails.
fn is_of(key: &str, factor: &str) -> bool {
    let numbered = |key: &str| key.replace("[0]", "").replace("[1]", "");
    numbered(key) == factor || factor.strip_prefix(key).is_some_and(|rest| matches!(rest, ".cw" | ".ccw"))
}

fn in_plan(file: &Path, problem: String, remedy: &str) -> Error {
    fault_in(file, "vary", problem, remedy.to_owned()).into()
}

/// Checks that the drawing has each key, and that it can have its middle value, alone or with all others at theirs.
fn check(file: &Path, variants: &Variants) -> Result<(), Error> {
    let middle = vec![0.5; variants.factors.len()];
    let Err(together) = variants.at(&middle) else { return Ok(()) };
    for factor in variants.factors.iter().filter(|factor| matches!(factor.kind, Kind::Key(_))) {
        if let Err(problem) = variants.alone(factor) {
            return Err(refused(file, &factor.key, problem));
        }
    }
    Err(refused(file, "all at their middle", together))
}

fn refused(file: &Path, what: &str, problem: String) -> Error {
    InputError { problem: format!("{what}: {problem}"), ..fault_of(file) }.into()
}

fn fault_of(file: &Path) -> InputError {
    fault_in(file, "vary", String::new(), String::new())
}
