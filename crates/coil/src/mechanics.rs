//! States of a coil whose stiffness or bond changes, and the way of a course of temperature between them.

use crate::{Bonds, Design, FactorsAt, Mechanics};
use fem_core::material::TransverselyIsotropic;
use nalgebra::DMatrix;

/// One state of the coil's mechanics, for which a linear model is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MechanicalState {
    /// Factor on E_r and G_zr.
    pub transverse_modulus: f64,
    /// Factor on α_r.
    pub transverse_expansion: f64,
    /// Whether the bond that can open is open.
    pub bonds: Bonds,
}

impl MechanicalState {
    /// The state of the design's constants.
    pub const NOMINAL: Self = Self { transverse_modulus: 1.0, transverse_expansion: 1.0, bonds: Bonds::Closed };

    pub(crate) fn elastic(&self, nominal: &TransverselyIsotropic) -> TransverselyIsotropic {
        TransverselyIsotropic {
            e_r: nominal.e_r * self.transverse_modulus,
            g_zr: nominal.g_zr * self.transverse_modulus,
            alpha_r: nominal.alpha_r * self.transverse_expansion,
            ..*nominal
        }
    }
}

/// Degree of the polynomial in x = 1/(1 + sτ) that stands for a relaxing coil's response. The response is a rational function of the
/// modulus 1 − g x, smooth up to the pole near x = 1/g; for g = 0.8 the interpolation gains a factor of 2.6 a degree and is within
/// 2e-4 of the response at degree 8 (tests/dynamics.rs).
const DEGREE: usize = 8;

/// Largest change of a factor between two states of a temperature table; responses are linear between states, which leaves less than
/// 3e-3 of the response (tests/dynamics.rs).
const FACTOR_STEP: f64 = 0.1;

/// States of a table at most: each is a model.
const MOST_STATES: usize = 64;

/// Rates of the three bias parts.
type Parts = [f64; 3];

/// Combination of the responses of the states along a course.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) enum Blend {
    Elastic,
    Table(Vec<f64>),
    Relaxing(Box<Relaxation>),
    Opening { below: f64, above: f64, bond: Bonds },
}

/// A response that follows a relaxing modulus, put together from the responses at constant moduli.
///
/// The modulus is `1 − fraction x` with x = 1/(1 + s `time`): x = 0 is unrelaxed, x = 1 relaxed. The response is interpolated in x by a
/// polynomial, whose powers are chains of first-order followers; by Horner's scheme one chain serves all of them.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Relaxation {
    time: f64,
    to_coefficients: DMatrix<f64>,
    /// follower k follows follower k + 1 and the polynomial's coefficient k + 1; the last follows its coefficient alone
    followers: [Parts; DEGREE],
}

impl Relaxation {
    /// At rest; `time` is the relaxation time \[s\], > 0.
    pub fn new(time: f64) -> Self {
        let x = Self::nodes();
        let powers = DMatrix::from_fn(x.len(), x.len(), |i, j| x[i].powi(j as i32));
        let identity = DMatrix::identity(x.len(), x.len());
        let to_coefficients = powers.lu().solve(&identity).expect("a Vandermonde matrix of distinct points is regular");
        Self { time, to_coefficients, followers: [[0.0; 3]; DEGREE] }
    }

    /// Points x at which [`Self::rates`] wants the responses.
    pub fn nodes() -> Vec<f64> {
        (0..=DEGREE).map(|k| (1.0 - (std::f64::consts::PI * k as f64 / DEGREE as f64).cos()) / 2.0).collect()
    }

    /// Mean rates over the next interval `dt` \[s\] from the rates that the modulus of each node alone would give; `states` has one entry
    /// a node.
    pub fn rates(&mut self, states: &[Parts], dt: f64) -> Parts {
        // what is left of the followers' differences from where they tend to, after `dt` and in the mean
        let h = (dt / self.time).max(f64::MIN_POSITIVE);
        let (mut left, mut mean) = ([0.0; DEGREE], [0.0; DEGREE]);
        let (mut term, mut gone) = ((-h).exp(), -(-h).exp_m1());
        for m in 0..DEGREE {
            (left[m], mean[m]) = (term, gone.max(0.0) / h);
            term *= h / (m + 1) as f64;
            gone -= term;
        }
        [0, 1, 2].map(|part: usize| {
            let coefficient = |j: usize| (0..=DEGREE).map(|i| self.to_coefficients[(j, i)] * states[i][part]).sum::<f64>();
            // a follower tends to the sum of its coefficient and all behind it
            let (mut tends, mut off) = ([0.0; DEGREE], [0.0; DEGREE]);
            let mut sum = 0.0;
            for k in (0..DEGREE).rev() {
                sum += coefficient(k + 1);
                (tends[k], off[k]) = (sum, self.followers[k][part] - sum);
            }
            for k in 0..DEGREE {
                self.followers[k][part] = tends[k] + (k..DEGREE).map(|i| left[i - k] * off[i]).sum::<f64>();
            }
            coefficient(0) + sum + (0..DEGREE).map(|i| mean[i] * off[i]).sum::<f64>()
        })
    }
}

/// Rows between which factors change little, linear between the given ones.
fn refined(rows: &[FactorsAt]) -> Vec<FactorsAt> {
    let wanted = |w: &[FactorsAt]| {
        let change = |a: f64, b: f64| (a - b).abs() / a.abs().min(b.abs()).max(f64::MIN_POSITIVE);
        let modulus = change(w[0].transverse_modulus, w[1].transverse_modulus);
        (modulus.max(change(w[0].transverse_expansion, w[1].transverse_expansion)) / FACTOR_STEP).ceil().clamp(1.0, 1e3) as usize
    };
    let total: usize = rows.windows(2).map(wanted).sum();
    // a table that would need too many is divided as finely as the limit allows
    let coarser = (total as f64 / MOST_STATES as f64).max(1.0);
    let mut fine = Vec::new();
    for w in rows.windows(2) {
        let parts = (wanted(w) as f64 / coarser).ceil() as usize;
        fine.extend((0..parts).map(|k| {
            let at = |a: f64, b: f64| a + (b - a) * k as f64 / parts as f64;
            FactorsAt {
                temperature: at(w[0].temperature, w[1].temperature),
                transverse_modulus: at(w[0].transverse_modulus, w[1].transverse_modulus),
                transverse_expansion: at(w[0].transverse_expansion, w[1].transverse_expansion),
            }
        }));
    }
    fine.extend(rows.last());
    fine
}

impl Design {
    /// The states between which the coil moves, and their combination.
    pub(crate) fn states(&self) -> (Vec<MechanicalState>, Blend) {
        let nominal = MechanicalState::NOMINAL;
        match &self.mechanics {
            Mechanics::Elastic => (vec![nominal], Blend::Elastic),
            Mechanics::TemperatureTable(rows) => {
                let state = |row: &FactorsAt| MechanicalState {
                    transverse_modulus: row.transverse_modulus,
                    transverse_expansion: row.transverse_expansion,
                    ..nominal
                };
                let rows = refined(rows);
                (rows.iter().map(state).collect(), Blend::Table(rows.iter().map(|row| row.temperature).collect()))
            }
            Mechanics::Relaxing { fraction, time } => {
                let state = |x: &f64| MechanicalState { transverse_modulus: 1.0 - fraction * x, ..nominal };
                (Relaxation::nodes().iter().map(state).collect(), Blend::Relaxing(Box::new(Relaxation::new(*time))))
            }
            Mechanics::Opening(o) => {
                let opened = MechanicalState { bonds: Bonds::Opened, ..nominal };
                (vec![nominal, opened], Blend::Opening { below: o.below, above: o.below + o.hysteresis, bond: Bonds::Closed })
            }
        }
    }
}

/// Share of an interval for which a bond is open that opens below one temperature and closes above another, while the temperature goes evenly; the bond's
/// state afterwards.
fn opened(bond: &mut Bonds, [below, above]: [f64; 2], from: f64, to: f64) -> f64 {
    let beyond = |temperature: f64, before: Bonds| match temperature {
        t if t < below => Bonds::Opened,
        t if t > above => Bonds::Closed,
        _ => before,
    };
    let before = beyond(from, *bond);
    *bond = beyond(to, before);
    // before the temperature at which it changes
    let share = match (before, *bond) {
        (Bonds::Closed, Bonds::Closed) => return 0.0,
        (Bonds::Opened, Bonds::Opened) => return 1.0,
        (Bonds::Closed, Bonds::Opened) => (below - from) / (to - from),
        (Bonds::Opened, Bonds::Closed) => (above - from) / (to - from),
    };
    if before == Bonds::Opened { share } else { 1.0 - share }
}

impl Blend {
    /// Mean rates over an interval `dt` \[s\] in which the coil's mean temperature goes `from` … `to`, from the rates that each state
    /// alone would give.
    pub(crate) fn rates(&mut self, states: &[Parts], from: f64, to: f64, dt: f64) -> Parts {
        let middle = (from + to) / 2.0;
        match self {
            Self::Elastic => states[0],
            Self::Table(rows) => {
                let upper = rows.partition_point(|t| *t <= middle).clamp(1, rows.len().max(2) - 1).min(rows.len() - 1);
                let lower = upper.saturating_sub(1);
                let width = rows[upper] - rows[lower];
                let share = if width > 0.0 { ((middle - rows[lower]) / width).clamp(0.0, 1.0) } else { 0.0 };
                [0, 1, 2].map(|p| (1.0 - share) * states[lower][p] + share * states[upper][p])
            }
            Self::Relaxing(relaxation) => relaxation.rates(states, dt),
            Self::Opening { below, above, bond } => {
                let open = opened(bond, [*below, *above], from, to);
                [0, 1, 2].map(|p| {
                    let [closed, opened] = [Bonds::Closed, Bonds::Opened].map(|bond| states[bond as usize][p]);
                    closed + open * (opened - closed)
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A response that is `x` itself, one follower: under a constant rate from t = 0 it rises as 1 − e^(−t/τ).
    #[test]
    fn exact_a_follower_has_the_relaxation_time_whatever_the_interval() {
        for dt in [5.0, 60.0, 600.0] {
            let x = Relaxation::nodes();
            let mut relaxation = Relaxation::new(600.0);
            let states: Vec<Parts> = x.iter().map(|x| [*x, x * x, 1.0]).collect();
            let mut sums = [0.0; 3];
            for _ in 0..(1200.0 / dt) as usize {
                let rates = relaxation.rates(&states, dt);
                (0..3).for_each(|p| sums[p] += rates[p] * dt);
            }
            // integrals over two relaxation times of 1 − e^−s and of 1 − (1 + s) e^−s
            let (e, tau) = ((-2.0f64).exp(), 600.0);
            let exact = [tau * (2.0 - (1.0 - e)), tau * (2.0 - (2.0 - 4.0 * e)), 2.0 * tau];
            for p in 0..3 {
                assert!((sums[p] / exact[p] - 1.0).abs() < 2e-3, "dt {dt}, part {p}: {} against {}", sums[p], exact[p]);
            }
        }
    }

    /// A course down and up again, through both temperatures: the mean is the same however it is divided.
    #[test]
    fn exact_a_bond_is_open_for_the_same_time_whatever_the_interval() {
        let corners = [20.0, -10.0, 30.0];
        let states: [Parts; 2] = [[1.0, 0.0, -2.0], [4.0, 1.0, -2.0]];
        let mean = |parts: usize| {
            let mut blend = Blend::Opening { below: 3.0, above: 8.0, bond: Bonds::Closed };
            let mut sum = [0.0; 3];
            for leg in corners.windows(2) {
                let at = |k: usize| leg[0] + (leg[1] - leg[0]) * k as f64 / parts as f64;
                for k in 0..parts {
                    let rates = blend.rates(&states, at(k), at(k + 1), 1.0);
                    (0..3).for_each(|p| sum[p] += rates[p] / parts as f64);
                }
            }
            sum
        };
        // open for 13 of 30 K of the way down and 18 of 40 K of the way up
        let open = 13.0 / 30.0 + 18.0 / 40.0;
        for parts in [1, 2, 7, 1000] {
            let found = mean(parts);
            for (p, exact) in [2.0 + 3.0 * open, open, -4.0].into_iter().enumerate() {
                assert!((found[p] - exact).abs() < 1e-9, "{parts} parts: {found:?}");
            }
        }
        // at rest it stays as it is between the two, and one that begins cold begins open
        let mut bond = Bonds::Closed;
        assert_eq!((opened(&mut bond, [3.0, 8.0], 5.0, 5.0), bond), (0.0, Bonds::Closed));
        assert_eq!((opened(&mut bond, [3.0, 8.0], -5.0, -5.0), bond), (1.0, Bonds::Opened));
        assert_eq!((opened(&mut bond, [3.0, 8.0], 5.0, 5.0), bond), (1.0, Bonds::Opened));
    }
}
