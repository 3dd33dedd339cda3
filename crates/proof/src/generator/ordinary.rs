//! Units that conceal nothing, or a tail, but are ordinary: a constant off the drawing, instruments that read otherwise, a noisier gyroscope.

use super::chamber::{Course, ProgrammeFamily, STEP};
use super::noise::Noise;
use super::plant::Plant;
use super::random::Random;
use super::record::{Sensors, Signal, at};
use super::scene::Scene;
use super::unit::{Generator, meta};
use crate::Failure;
use coil::{Mount, Side};
use std::f64::consts::TAU;

/// Ordinary properties of a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ordinary {
    /// Earth's rate in the record [deg/h].
    pub earth: f64,
    /// Factor on the gyroscope's noise.
    pub noise: f64,
    /// Offset of the spool's thermometer \[K\].
    pub spool_offset: f64,
    /// Gains of the chamber's and the spool's thermometer, less one, about 20 °C.
    pub gains: [f64; 2],
    /// Time constant of the chamber's thermometer, and how late its clock is \[s\].
    pub chamber_late: [f64; 2],
    /// Amplitude of a ripple of the chamber, which moves from the first row on \[K\].
    pub ripple: f64,
    /// Factors on k_r, on the coil's specific heat, and on E_r and G.
    pub constants: [f64; 3],
    /// CW tail \[m\].
    pub tail: f64,
    /// Conductance of the right flange to the chamber [W/(m² K)], contact resistance of the hub [m² K/W], factor on the conductivity of the surroundings.
    pub heat: [f64; 3],
    /// Electronics that follow the spool with a time constant \[s\] and add a rate for every kelvin that they are behind \[deg/h/K\].
    pub board: (f64, f64),
}

/// Nothing.
pub(crate) const NOTHING: Ordinary = Ordinary {
    earth: 0.0,
    noise: 1.0,
    spool_offset: 0.0,
    gains: [0.0; 2],
    chamber_late: [0.0; 2],
    ripple: 0.0,
    constants: [1.0; 3],
    tail: 0.0,
    heat: [0.0, 0.0, 1.0],
    board: (0.0, 0.0),
};

/// Temperature about which gains act \[°C\].
const MIDDLE: f64 = 20.0;
/// Period of a ripple \[s\].
const PERIOD: f64 = 240.0;
/// Programmes of the record that is fitted, and of the one that judges.
const FIRST: ProgrammeFamily = ProgrammeFamily::P2;
const SECOND: ProgrammeFamily = ProgrammeFamily::P4;

impl Ordinary {
    /// The course as the chamber's thermometer and log tell it.
    pub(super) fn read(&self, course: &Course) -> Course {
        let [lag, late] = self.chamber_late;
        let forget = if lag > 0.0 { (-STEP / lag).exp() } else { 0.0 };
        let mut behind = course.temperature[0];
        let lagged: Vec<f64> = course
            .temperature
            .iter()
            .map(|t| {
                behind = t + (behind - t) * forget;
                behind
            })
            .collect();
        let told = |n: usize| MIDDLE + (at(&lagged, n as f64 * STEP - late) - MIDDLE) * (1.0 + self.gains[0]);
        Course { temperature: (0..lagged.len()).map(told).collect(), turns: course.turns.clone() }
    }

    pub(super) fn signal(&self, time: &[f64], signal: &Signal) -> Signal {
        let board = self.slow_board(time, &signal.spool);
        Signal {
            spool: signal.spool.iter().map(|t| MIDDLE + (t - MIDDLE) * (1.0 + self.gains[1])).collect(),
            rate: signal.rate.iter().zip(board).map(|(rate, board)| rate + self.earth + board).collect(),
        }
    }

    /// Contribution of slow electronics: they are settled at first, and the spool is linear between rows.
    fn slow_board(&self, time: &[f64], spool: &[f64]) -> Vec<f64> {
        let (tau, size) = self.board;
        let (mut behind, mut before) = (0.0, 0.0);
        let of = |n: usize| {
            if n == 0 || tau == 0.0 {
                return 0.0;
            }
            let dt = time[n] - time[n - 1];
            let forget = (-dt / tau).exp();
            // behind' = slope − behind/τ
            behind = behind * forget + (spool[n] - spool[n - 1]) / dt * tau * (1.0 - forget);
            let mean = size * (behind + before) / 2.0;
            before = behind;
            mean
        };
        (0..time.len()).map(of).collect()
    }
}

impl Generator {
    /// Two records of an ordinary unit, as CSV, and how they were sampled: always the same for one seed. [`Failure`] if a system cannot be
    /// solved.
    pub(crate) fn ordinary(&self, seed: u64, of: &Ordinary) -> Result<[String; 3], Failure> {
        let random = &mut Random::new(seed, 0);
        let mut noise = Noise { unseen: None, ..Noise::draw(random) };
        noise.arw *= of.noise;
        noise.drift.0 *= of.noise;
        noise.walk *= of.noise;
        let sensors = Sensors { resolution: 0.01, offset: of.spool_offset };
        let mut build = self.specimen(random);
        let [k_r, specific_heat, stiffness] = of.constants;
        let design = &mut build.design;
        design.body.conductivity_r *= k_r;
        design.body.specific_heat *= specific_heat;
        design.body.elastic.e_r *= stiffness;
        design.body.elastic.g_zr *= stiffness;
        design.winding.tails.cw += of.tail;
        let [conductance, resistance, medium] = of.heat;
        design.surroundings.conductivity *= medium;
        design.heat.hub_resistance += resistance;
        if conductance > 0.0 {
            design.heat.mounts.push(Mount { side: Side::Right, conductance });
        }
        let plant = Plant::new(build, None)?;
        let mut since = 0.0;
        let mut record = |family: ProgrammeFamily| {
            let mut scene = Scene::draw(family, random);
            let ripple = |n: usize| of.ripple * (TAU * n as f64 * STEP / PERIOD).sin();
            scene.course.temperature.iter_mut().enumerate().for_each(|(n, t)| *t += ripple(n));
            let signal = of.signal(&scene.time, &scene.signal(&plant, &[]));
            let readings = noise.sample(&scene.time, since, random);
            since += scene.time[scene.time.len() - 1] + 6.0 * 3600.0;
            sensors.write(&of.read(&scene.course), &scene.time, &signal, &readings, noise.white(0.0), random)
        };
        let [fit, holdout] = [FIRST, SECOND].map(&mut record);
        Ok([fit, holdout, meta(&sensors, None)])
    }
}
