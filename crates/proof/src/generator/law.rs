//! The phase as a function of the temperature where stiffness or bonds depend on temperature and history.

use super::build::{Build, Softening};
use super::chamber::STEP;
use super::heat::{Heat, MESH, dot};
use coil::{Bonds, Error, MechanicalState, Mechanics, Model, Opening, functionals};
use nalgebra::{DMatrix, DVector};

/// Values of a logistic step at which the mechanics is solved; in between a polynomial.
const SHARES: [f64; 5] = [0.0, 0.146_446_609_406_726_24, 0.5, 0.853_553_390_593_273_8, 1.0];
/// Relaxed parts of the modulus at which the mechanics is solved.
const RELAXED: [f64; 7] = [0.0, 0.1, 0.25, 0.45, 0.65, 0.85, 1.0];
/// Exponentials that stand for a relaxing coil.
const EXPONENTIALS: usize = 4;
/// Largest error that they may leave in the response.
const LEFT: f64 = 1e-3;

/// Functionals of drives and modes \[rad\].
type Functional = Vec<f64>;

pub(super) enum Law {
    Elastic(Functional),
    Softening(Softening, Vec<Functional>),
    /// The immediate response, and the responses that follow with a time constant \[s\].
    Relaxing(Functional, Vec<(f64, Functional)>),
    /// Closed, open.
    Opening(Opening, [Functional; 2]),
}

pub(super) struct Running<'a> {
    law: &'a Law,
    /// phases at the step before
    phases: Vec<f64>,
    /// what follows, less where it started
    following: Vec<f64>,
    open: bool,
}

impl Law {
    /// `nominal` is the functional with the design's constants, every bond closed.
    pub(super) fn new(build: &Build, heat: &Heat, nominal: Functional) -> Result<Self, Error> {
        let design = &build.design;
        let in_state = |state: MechanicalState| -> Result<Functional, Error> {
            Ok(heat.total(&functionals(design, &Model::in_state(design, &MESH, &state)?, &heat.model)?))
        };
        if let Mechanics::Opening(opening) = design.mechanics {
            let open = in_state(MechanicalState { bonds: Bonds::Opened, ..MechanicalState::NOMINAL })?;
            return Ok(Self::Opening(opening, [nominal, open]));
        }
        if let Some(step) = build.softening {
            let state = |share: f64| MechanicalState {
                transverse_modulus: 1.0 + (step.modulus - 1.0) * share,
                transverse_expansion: 1.0 + (step.expansion - 1.0) * share,
                ..MechanicalState::NOMINAL
            };
            let states = SHARES.iter().map(|share| in_state(state(*share))).collect::<Result<_, _>>()?;
            return Ok(Self::Softening(step, states));
        }
        if let Some((fraction, time)) = build.relaxing {
            let state = |x: f64| MechanicalState { transverse_modulus: 1.0 - fraction * x, ..MechanicalState::NOMINAL };
            let states = RELAXED.iter().map(|x| in_state(state(*x))).collect::<Result<Vec<_>, _>>()?;
            return relaxing(fraction, time, &states);
        }
        Ok(Self::Elastic(nominal))
    }

    /// At rest with drives and modes `y`.
    pub(super) fn start(&self, y: &[f64]) -> Running<'_> {
        let followers = if let Self::Relaxing(_, followers) = self { followers.len() } else { 0 };
        Running { law: self, phases: self.phases(y), following: vec![0.0; followers], open: false }
    }

    fn phases(&self, y: &[f64]) -> Vec<f64> {
        match self {
            Self::Elastic(f) => vec![dot(f, y)],
            Self::Softening(_, states) => states.iter().map(|f| dot(f, y)).collect(),
            Self::Relaxing(at_once, later) => [dot(at_once, y)].into_iter().chain(later.iter().map(|(_, f)| dot(f, y))).collect(),
            Self::Opening(_, states) => states.iter().map(|f| dot(f, y)).collect(),
        }
    }
}

impl Running<'_> {
    /// Gain of the phase in a step to `y`, in which the coil's mean temperature goes `from` … `to` \[rad\].
    pub(super) fn advance(&mut self, y: &[f64], from: f64, to: f64) -> f64 {
        let now = self.law.phases(y);
        let gains: Vec<f64> = now.iter().zip(&self.phases).map(|(now, before)| now - before).collect();
        self.phases = now;
        let middle = (from + to) / 2.0;
        match self.law {
            Law::Elastic(_) => gains[0],
            Law::Softening(step, _) => {
                let share = 1.0 / (1.0 + (-(middle - step.at) / step.width).exp());
                lagrange(&SHARES, share).iter().zip(&gains).map(|(w, g)| w * g).sum()
            }
            Law::Relaxing(_, later) => {
                let mut gain = gains[0];
                for (k, (time, _)) in later.iter().enumerate() {
                    // ż = ẏ − z/τ in what has not yet followed, by the trapezium rule
                    let x = STEP / (2.0 * time);
                    let behind = (self.following[k] * (1.0 - x) + gains[k + 1]) / (1.0 + x);
                    gain += gains[k + 1] - (behind - self.following[k]);
                    self.following[k] = behind;
                }
                gain
            }
            Law::Opening(opening, _) => {
                self.open = middle < opening.below || (self.open && middle <= opening.below + opening.hysteresis);
                gains[usize::from(self.open)]
            }
        }
    }
}

/// Weights of the values at `nodes` for the polynomial at `x`.
fn lagrange(nodes: &[f64], x: f64) -> Vec<f64> {
    let others = |k: usize| nodes.iter().enumerate().filter(move |(j, _)| *j != k);
    (0..nodes.len()).map(|k| others(k).map(|(_, node)| (x - node) / (nodes[k] - node)).product()).collect()
}

/// A modulus `1 − g/(1 + s τ)` makes the response a rational function of s with real poles between −1/τ and about −(1 − g)/τ
/// (correspondence principle): it is collocated by exponentials there.
fn relaxing(fraction: f64, time: f64, states: &[Functional]) -> Result<Law, Error> {
    let longest = 1.0 / (1.0 - fraction).min(0.7);
    let ratio = |k: usize| longest.powf((k as f64 + 0.5) / EXPONENTIALS as f64);
    // 1/(1 + s τ_k) with s τ = 1/x − 1
    let share = |x: f64, k: usize| if x == 0.0 { 0.0 } else { 1.0 / (1.0 + (1.0 / x - 1.0) * ratio(k)) };
    let design = DMatrix::from_fn(RELAXED.len(), EXPONENTIALS + 1, |i, k| if k == 0 { 1.0 } else { share(RELAXED[i], k - 1) });
    let values = DMatrix::from_fn(RELAXED.len(), states[0].len(), |i, j| states[i][j]);
    let solved = design.clone().svd(true, true).solve(&values, 1e-9).map_err(|e| Error::Resolution(e.into()))?;
    let left = (&design * &solved - &values).amax() / values.amax();
    if left > LEFT {
        return Err(Error::Resolution(format!("exponentials leave {left:.1e} of a response that relaxes by {fraction}")));
    }
    let row = |k: usize| -> Functional { DVector::from(solved.row(k).transpose()).as_slice().to_vec() };
    Ok(Law::Relaxing(row(0), (0..EXPONENTIALS).map(|k| (time * ratio(k), row(k + 1))).collect()))
}
