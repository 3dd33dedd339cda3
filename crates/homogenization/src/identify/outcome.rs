//! Agreement that a family of cells can reach with the entries.

use super::response::{Known, Response, known};
use super::{Family, Target};
use crate::FibreCell;

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
    pub(super) known: Known,
    pub(super) response: Response,
}

impl Fit {
    pub(super) fn new(family: &Family, targets: &[Target], u: Vec<f64>, response: Response) -> Option<Self> {
        let known = known(&response);
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

/// Best fits of a family.
#[derive(Debug, Clone, PartialEq)]
pub struct FamilyFit {
    /// The cell that meets the entries best, however far from the priors.
    pub best: Fit,
    /// The ordinary cell that misses least, where the best one is not ordinary or does not meet all entries.
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
