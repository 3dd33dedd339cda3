//! States of a coil whose stiffness or bond changes, and how a course of temperature moves between them.

use crate::{Bonds, Design, Mechanics};
use fem_core::material::TransverselyIsotropic;
use nalgebra::DMatrix;

/// One state of the coil's mechanics: what a linear model is made for.
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
    /// As the design's constants say.
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

/// Degree of the polynomial in 1/(1 + sτ) that stands for a relaxing coil's response. The response is a smooth rational function of
/// the modulus; at degree 4 its error is below 1e-4 for any relaxing share up to 0.9.
const DEGREE: usize = 4;

/// Rates of the three bias parts.
type Parts = [f64; 3];

/// How the responses of the states combine along a course.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Blend {
    Elastic,
    Table(Vec<f64>),
    Relaxing { time: f64, to_coefficients: DMatrix<f64>, chains: Vec<Vec<Parts>> },
    Opening { below: f64, above: f64, open: bool },
}

/// Points of a polynomial in x on [0, 1].
fn nodes() -> Vec<f64> {
    (0..=DEGREE).map(|k| (1.0 - (std::f64::consts::PI * k as f64 / DEGREE as f64).cos()) / 2.0).collect()
}

impl Design {
    /// The states between which the coil moves, and how.
    pub(crate) fn states(&self) -> (Vec<MechanicalState>, Blend) {
        let nominal = MechanicalState::NOMINAL;
        match &self.mechanics {
            Mechanics::Elastic => (vec![nominal], Blend::Elastic),
            Mechanics::TemperatureTable(rows) => {
                let state = |row: &crate::FactorsAt| MechanicalState {
                    transverse_modulus: row.transverse_modulus,
                    transverse_expansion: row.transverse_expansion,
                    ..nominal
                };
                (rows.iter().map(state).collect(), Blend::Table(rows.iter().map(|row| row.temperature).collect()))
            }
            Mechanics::Relaxing { fraction, time } => {
                // modulus 1 − fraction x with x = 1/(1 + sτ): x = 0 is unrelaxed, x = 1 relaxed
                let state = |x: &f64| MechanicalState { transverse_modulus: 1.0 - fraction * x, ..nominal };
                let x = nodes();
                let powers = DMatrix::from_fn(x.len(), x.len(), |i, j| x[i].powi(j as i32));
                let identity = DMatrix::identity(x.len(), x.len());
                let to_coefficients = powers.lu().solve(&identity).unwrap_or(identity);
                let chains = (0..=DEGREE).map(|j| vec![[0.0; 3]; j]).collect();
                (x.iter().map(state).collect(), Blend::Relaxing { time: *time, to_coefficients, chains })
            }
            Mechanics::Opening(o) => {
                let opened = MechanicalState { bonds: Bonds::Opened, ..nominal };
                (vec![nominal, opened], Blend::Opening { below: o.below, above: o.below + o.hysteresis, open: false })
            }
        }
    }
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
            Self::Relaxing { time, to_coefficients, chains } => {
                let decay = (-dt / *time).exp();
                let forget = *time / dt * -(-dt / *time).exp_m1();
                let mut sum = [0.0; 3];
                for (j, chain) in chains.iter_mut().enumerate() {
                    for part in 0..3 {
                        let mut input: f64 = (0..states.len()).map(|i| to_coefficients[(j, i)] * states[i][part]).sum();
                        for follower in chain.iter_mut() {
                            let state = follower[part];
                            follower[part] = input + (state - input) * decay;
                            input += (state - input) * forget;
                        }
                        sum[part] += input;
                    }
                }
                sum
            }
            Self::Opening { below, above, open } => {
                *open = if middle < *below { true } else { *open && middle <= *above };
                states[usize::from(*open)]
            }
        }
    }
}
