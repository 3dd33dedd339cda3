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
mod posterior;
mod prior;
mod random;
mod region;
mod response;
mod sample;
mod search;
mod target;

pub use family::{Family, MaterialPrior, Parameter, Quantity, RingPrior, Volume};
pub use measurement::Measurement;
pub use posterior::{Direction, Posterior};
pub use prior::{Prior, Scale, Z95};
pub use random::Random;
pub use region::Region;
pub use response::Known;
pub use search::starts;
pub use target::{Target, Uncertainty};

use crate::FibreCell;
use emulator::Emulator;
use progress::Step;
use search::{Demand, Found, search};

/// A constant within this many standard deviations of its prior's median is ordinary.
pub const ORDINARY: f64 = 3.0;

/// A cell and what it gives.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Its parameters in prior standard deviations.
    pub u: Vec<f64>,
    /// Its parameters, SI.
    pub values: Vec<f64>,
    /// The cell.
    pub cell: FibreCell,
    /// Each target's constant, solved.
    pub entries: Vec<f64>,
    /// Whether each is met.
    pub met: Vec<bool>,
    known: Known,
    response: response::Response,
}

impl Fit {
    fn new(family: &Family, targets: &[Target], u: Vec<f64>, response: response::Response) -> Option<Self> {
        let known = response::known(&response);
        let entries: Vec<f64> = targets.iter().map(|t| t.of(&known)).collect();
        let met = targets.iter().zip(&entries).map(|(t, value)| t.is_met(*value)).collect();
        let values = family.parameters().iter().zip(&u).map(|(p, u)| p.prior.value(*u)).collect();
        Some(Self { cell: family.cell(&u)?, u, values, entries, met, known, response })
    }

    /// Whether every entry is met.
    pub fn reproduces(&self) -> bool {
        self.met.iter().all(|met| *met)
    }

    /// The parameter farthest from its prior, and how many standard deviations that is.
    pub fn farthest(&self) -> (usize, f64) {
        self.u.iter().map(|u| u.abs()).enumerate().fold((0, 0.0), |most, next| if next.1 > most.1 { next } else { most })
    }

    /// Whether every constant is ordinary.
    pub fn is_ordinary(&self) -> bool {
        self.farthest().1 <= ORDINARY
    }
}

/// What a family can do.
#[derive(Debug, Clone, PartialEq)]
pub struct FamilyFit {
    /// The cell that meets the entries best, however far from the priors.
    pub best: Fit,
    /// Where that is not ordinary or does not meet all: the ordinary cell that misses least.
    pub ordinary: Option<Fit>,
}

impl FamilyFit {
    /// An ordinary cell that meets every entry.
    pub fn explains(&self) -> bool {
        self.fit().reproduces() && self.fit().is_ordinary()
    }

    /// The ordinary cell if there is need for one, else the best.
    pub fn fit(&self) -> &Fit {
        self.ordinary.as_ref().unwrap_or(&self.best)
    }
}

/// Two sets of constituents that explain the entries alike.
#[derive(Debug, Clone, PartialEq)]
pub struct Alternatives {
    /// The sets.
    pub sets: [Fit; 2],
    /// Further measurements, the one that would narrow the posterior most first.
    pub measurements: Vec<Measurement>,
}

/// What the measured constants say.
#[derive(Debug, Clone)]
pub struct Identification {
    /// Of each family in the order given.
    pub outcomes: Vec<FamilyFit>,
    /// The family that the rest is about: of those that explain the entries the one closest to its priors, else that with the least misfit.
    pub chosen: usize,
    /// What is known of its parameters; `None` if no family explains the entries, or none of its minima that chains may start from does.
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
