//! Constituents from measured effective constants: what fits, what is determined, what is not, and what to measure next.
//!
//! The unknowns of a [`Family`] (moduli, expansions, conductivities, diameters within tolerance) are normal or log-normal before the
//! measurement; u counts their standard deviations from the median. The entries ([`Target`]) are printed numbers, flat over their
//! rounding interval, or values with a standard deviation. Every number reported rests on the solved cell ([`crate::homogenize`]); a composite-cylinder model
//! with a Gaussian process through its differences from them (`emulator`) stands for them where thousands of cells are needed.
//!
//! 1. Starts from the priors alone, Levenberg–Marquardt on the emulator, refined until the solved cell agrees (`search`).
//! 2. Draws from the posterior about every minimum that counts, on an emulator trained where the draws lie (`posterior`).
//! 3. The two draws farthest apart, moved onto the same entries with solved cells, and what would tell them apart (`alternatives`).

mod alternatives;
mod emulator;
mod family;
mod fit;
pub mod literature;
mod measurement;
mod outcome;
mod posterior;
mod prior;
mod region;
mod response;
mod sample;
mod search;
mod target;

pub use crate::random::Random;
pub use family::{Family, MaterialPrior, Parameter, Quantity, RingPrior, Volume};
pub use measurement::Measurement;
pub use outcome::{FamilyFit, Fit, ORDINARY};
pub use posterior::{Direction, Posterior};
pub use prior::{Prior, Scale, Z95};
pub use region::Region;
pub use response::Known;
pub use search::starts;
pub use target::{Target, Uncertainty};

use emulator::Emulator;
use progress::Step;
use search::{Demand, Found, search};

/// Two sets of constituents that explain the entries alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternatives {
    /// The sets.
    pub sets: [Fit; 2],
    /// Further measurements, the one that would narrow the posterior most first.
    pub measurements: Vec<Measurement>,
}

/// Result of an identification.
#[derive(Debug, Clone)]
pub struct Identification {
    /// Fit of each family in the order given.
    pub outcomes: Vec<FamilyFit>,
    /// The family that the rest is about: of those that explain the entries the one closest to its priors, else that with the least misfit.
    pub chosen: usize,
    /// Posterior of its parameters; `None` if no family explains the entries, or none of its minima that chains may start from does.
    pub posterior: Option<Posterior>,
    /// Two of its cells; `None` if they cannot be found.
    pub alternatives: Option<Alternatives>,
}

/// Identifies the constituents behind `targets` among `families`; `None` if a family has no cell that can be solved.
///
/// `progress` is told each task as it begins, and how far it is.
pub fn identify(families: &[Family], targets: &[Target], seed: u64, progress: &dyn Fn(Step)) -> Option<Identification> {
    let mut searched = Vec::new();
    let mut outcomes = Vec::new();
    let mut costs = Vec::new();
    for family in families {
        let searching = |what: &'static str| {
            let task = format!("searching the {what} of the {}", family.name);
            move |done, all| progress(Step::counted(&task, done, all))
        };
        let mut emulator = Emulator::new(family);
        let dimensions = family.parameters().len();
        let fit = |found: Found| Some((Fit::new(family, targets, found.u, found.response)?, found.cost));
        let minima = search(&mut emulator, targets, Demand::Data, &starts(dimensions, seed), &searching("cells"));
        let (best, cost) = fit(minima.first()?.clone())?;
        let mut ordinary = None;
        if !(best.reproduces() && best.is_ordinary()) {
            let starts = starts(dimensions, seed + 1);
            let found = search(&mut emulator, targets, Demand::Ordinary, &starts, &searching("ordinary cells"));
            ordinary = found.into_iter().next().and_then(fit).map(|(fit, _)| fit);
        }
        outcomes.push(FamilyFit { best, ordinary });
        costs.push(cost);
        searched.push((emulator, minima));
    }
    let explains = |i: &usize| outcomes[*i].explains();
    let by_cost = |a: &usize, b: &usize| costs[*a].total_cmp(&costs[*b]);
    let chosen = (0..families.len()).filter(explains).min_by(by_cost).or_else(|| (0..families.len()).min_by(by_cost))?;
    if !outcomes[chosen].explains() {
        return Some(Identification { outcomes, chosen, posterior: None, alternatives: None });
    }
    let (family, (emulator, minima)) = (&families[chosen], &mut searched[chosen]);
    let best = outcomes[chosen].fit();
    let sampling = |done, all| progress(Step::counted("sampling what else explains the entries", done, all));
    let posterior = posterior::posterior(emulator, targets, minima, seed, &sampling);
    progress(Step::begins("looking for two sets that explain them alike"));
    let alternatives = posterior.as_ref().and_then(|posterior| {
        let [a, b] = alternatives::pair(emulator, targets, &best.response, &posterior.draws)?;
        let [a, b] = [Fit::new(family, targets, a.0, a.1)?, Fit::new(family, targets, b.0, b.1)?];
        let measurements = measurement::measurements(emulator, targets, [&a, &b], &posterior.draws);
        Some(Alternatives { sets: [a, b], measurements })
    });
    Some(Identification { outcomes, chosen, posterior, alternatives })
}
