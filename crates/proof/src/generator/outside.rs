//! Effects that the library does not hold, added to the rate.

use super::chamber::STEP;
use super::plant::Run;
use super::random::Random;
use crate::truth::ConcealedEffect;
use std::f64::consts::TAU;

/// The shape of its course; parameters beside the size.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shape {
    /// `sin(2π T/period + phase)`: polarisation coupling; period \[K\].
    Ripple { period: f64, phase: f64 },
    /// A step at an instant of every record \[s\].
    Step { at: f64 },
    /// `tanh` of the coil's temperature rate over a small one: what changes sign with the direction.
    Direction,
    /// `1 − e^(−t/τ)` from the start of every record: drying; τ \[s\].
    Drying { time: f64 },
    /// Current of the chamber's heater, which works above a balance: its magnetic field.
    HeaterCurrent,
    /// Square of the coil's temperature rate.
    RateSquared,
    /// Square of the temperature's distance from its mid-range.
    LevelSquared,
}

/// An effect outside the library; its size is the largest rate \[deg/h\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outside {
    pub(super) shape: Shape,
    pub(super) size: f64,
}

pub(super) const SHAPES: usize = 7;

impl Outside {
    /// The `kind`-th shape; its size is to be scaled.
    pub(super) fn draw(kind: usize, random: &mut Random) -> Self {
        let shape = match kind % SHAPES {
            0 => Shape::Ripple { period: random.log_uniform(6.0, 25.0), phase: random.uniform(0.0, TAU) },
            1 => Shape::Step { at: random.uniform(3.0, 9.0) * 3600.0 },
            2 => Shape::Direction,
            3 => Shape::Drying { time: random.log_uniform(2.0, 10.0) * 3600.0 },
            4 => Shape::HeaterCurrent,
            5 => Shape::RateSquared,
            _ => Shape::LevelSquared,
        };
        Self { shape, size: 0.005 * random.sign() }
    }

    pub(super) fn mechanism(&self) -> ConcealedEffect {
        let (id, own): (&str, &[(&str, f64)]) = match &self.shape {
            Shape::Ripple { period, phase } => ("polarisation-ripple", &[("period_k", *period), ("phase_rad", *phase)]),
            Shape::Step { at } => ("step-in-time", &[("at_s", *at)]),
            Shape::Direction => ("sign-of-temperature-rate", &[]),
            Shape::Drying { time } => ("slow-drying", &[("tau_s", *time)]),
            Shape::HeaterCurrent => ("heater-current", &[]),
            Shape::RateSquared => ("square-of-temperature-rate", &[]),
            Shape::LevelSquared => ("square-of-temperature", &[]),
        };
        let all = [[("amplitude_deg_per_h", self.size)].as_slice(), own].concat();
        ConcealedEffect {
            id: format!("unknown:{id}"),
            parameters: all.into_iter().map(|(name, value)| (name.into(), value)).collect(),
        }
    }

    pub(super) fn act(&self, chamber: &[f64], run: &mut Run) {
        const PER_MINUTE: f64 = 1.0 / 60.0;
        let mut angle = 0.0;
        for n in 1..run.coil.len() {
            let (temperature, rate) = (run.coil[n], (run.coil[n] - run.coil[n - 1]) / STEP);
            let value = match self.shape {
                Shape::Ripple { period, phase } => (TAU * temperature / period + phase).sin(),
                Shape::Step { at } => f64::from(n as f64 * STEP > at),
                Shape::Direction => (rate / (0.05 * PER_MINUTE)).tanh(),
                Shape::Drying { time } => -(-(n as f64) * STEP / time).exp_m1(),
                Shape::HeaterCurrent => {
                    // heat that the walls take up and lose to a room of 20 °C, over a pump that takes as much as 40 K lose
                    let slope = (chamber[n] - chamber[n - 1]) / STEP;
                    ((slope / PER_MINUTE * 60.0 + (chamber[n] + 20.0)) / 140.0).max(0.0)
                }
                Shape::RateSquared => (rate / PER_MINUTE).powi(2),
                Shape::LevelSquared => ((temperature - 10.0) / 50.0).powi(2),
            };
            angle += STEP * self.size * value;
            run.angle[n] += angle;
        }
    }
}
