//! A record of a unit to be, and the signal-to-noise ratio that an effect has in it.

use super::chamber::{self, Course};
use super::effect::Effect;
use super::matched::{Whitening, beyond};
use super::noise::Noise;
use super::plant::{Plant, Run};
use super::random::Random;
use super::record::{Sensors, Signal, THERMOMETER, instants, signal};
use crate::truth::Strength;

/// Standard deviations that a forward model is granted: rate gain and conductivity of the air, relative.
const GRANTED: f64 = 0.003;
/// Of the channels' offsets \[K\], [deg/h].
const OFFSETS: [f64; 2] = [0.1, 0.1];
/// Relative change of the air's conductivity that a derivative is taken with.
pub(super) const AIRIER: f64 = 0.02;

pub(super) struct Scene {
    pub(super) course: Course,
    pub(super) time: Vec<f64>,
}

impl Scene {
    pub(super) fn draw(family: chamber::ProgrammeFamily, random: &mut Random) -> Self {
        let course = Course::draw(family, random);
        let time = instants(&course, random);
        Self { course, time }
    }

    fn run(&self, plant: &Plant) -> Run {
        plant.run(&self.course.temperature)
    }

    pub(super) fn signal(&self, plant: &Plant, effects: &[Effect]) -> Signal {
        let mut run = self.run(plant);
        for effect in effects {
            if let Effect::Outside(outside) = effect {
                outside.act(&self.course.temperature, &mut run);
            }
        }
        // before the start only the read-out's coefficient says something
        signal(&run, &self.time, plant.read_out_at(run.bore[0]))
    }
}

/// Whitened difference from the nominal response in the record that is fitted.
pub(super) struct Judge<'a> {
    whitening: Whitening,
    spool_sd: f64,
    nominal: &'a Signal,
    granted: Vec<Vec<f64>>,
}

pub(super) fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

pub(super) fn times(a: &[f64], factor: f64) -> Vec<f64> {
    a.iter().map(|a| a * factor).collect()
}

impl<'a> Judge<'a> {
    /// `air` is the design as it is, and with [`AIRIER`] air.
    pub(super) fn new(air: [&Plant; 2], scene: &Scene, nominal: &'a Signal, noise: &Noise, sensors: &Sensors) -> Self {
        let whitening = Whitening::new(noise, &scene.time);
        let spool_sd = (THERMOMETER.powi(2) + sensors.resolution.powi(2) / 12.0).sqrt();
        let rows = scene.time.len();
        let [base, airier] = air.map(|plant| scene.signal(plant, &[]));
        let mut judge = Self { whitening, spool_sd, nominal, granted: Vec::new() };
        let (none, one) = (vec![0.0; rows], vec![1.0; rows]);
        let per_air = |a: &[f64], b: &[f64]| times(&minus(a, b), GRANTED / AIRIER);
        judge.granted = vec![
            judge.joined(&times(&one, OFFSETS[0]), &none),
            judge.joined(&none, &times(&one, OFFSETS[1])),
            judge.joined(&none, &times(&nominal.rate, GRANTED)),
            judge.joined(&per_air(&airier.spool, &base.spool), &per_air(&airier.rate, &base.rate)),
        ];
        judge
    }

    /// Whitened channels, one after the other.
    fn joined(&self, spool: &[f64], rate: &[f64]) -> Vec<f64> {
        let mut whitened = times(spool, 1.0 / self.spool_sd);
        whitened.extend(self.whitening.apply(rate));
        whitened
    }

    /// The signal-to-noise ratio of both channels, then that of each without anything granted but its offset.
    pub(super) fn strength(&self, id: &str, signal: &Signal) -> Strength {
        let (spool, rate) = (minus(&signal.spool, &self.nominal.spool), minus(&signal.rate, &self.nominal.rate));
        let none = vec![0.0; rate.len()];
        let alone = |spool: &[f64], rate: &[f64]| beyond(&self.joined(spool, rate), &self.granted[..2]);
        Strength {
            id: id.into(),
            snr: beyond(&self.joined(&spool, &rate), &self.granted),
            snr_noise_only_rate: alone(&none, &rate),
            snr_noise_only_spool: alone(&spool, &none),
        }
    }
}
