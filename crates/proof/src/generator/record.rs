//! A record: what thermometers and gyro write of a course.

use super::chamber::{Course, STEP};
use super::noise::SPAN;
use super::plant::Run;
use super::random::Random;
use std::fmt::Write;

/// Noise of a thermometer \[K\].
pub(crate) const THERMOMETER: f64 = 0.01;
/// Resolution of the chamber's thermometer \[K\].
pub(super) const CHAMBER_RESOLUTION: f64 = 0.01;

/// Both channels at the instants of a record, without noise.
#[derive(Clone)]
pub(super) struct Signal {
    pub(super) spool: Vec<f64>,
    /// [deg/h]
    pub(super) rate: Vec<f64>,
}

/// Instants of a record \[s\]: every [`SPAN`], in some records jittered or with gaps where the programme does not turn.
pub(super) fn instants(course: &Course, random: &mut Random) -> Vec<f64> {
    let last = (course.temperature.len() - 1) as f64 * STEP;
    let jitter = if random.chance(0.12) { random.uniform(0.3, 2.0) } else { 0.0 };
    let mut gaps = Vec::new();
    if random.chance(0.25) {
        for _ in 0..=random.below(2) {
            let length = random.uniform(200.0, 900.0);
            let start = random.uniform(1800.0, last - 1800.0);
            let steps = (start / STEP) as usize..((start + length) / STEP) as usize + 1;
            if !course.turns[steps].iter().any(|turns| *turns) {
                gaps.push((start, start + length));
            }
        }
    }
    let mut instants: Vec<f64> = Vec::new();
    for row in 0..=(last / SPAN) as usize {
        let moved = (jitter * random.normal()).clamp(-6.0, 6.0);
        let t = ((row as f64 * SPAN + moved).clamp(0.0, last) * 10.0).round() / 10.0;
        let lost = gaps.iter().any(|(start, end)| *start < t && t < *end);
        if !lost && instants.last().is_none_or(|before| t > *before) {
            instants.push(t);
        }
    }
    instants
}

/// The value of a course at an instant: the cubic through the four points about it.
pub(super) fn at(course: &[f64], time: f64) -> f64 {
    let x = (time / STEP).max(0.0);
    let first = (x as usize).saturating_sub(1).min(course.len() - 4);
    let x = x - first as f64;
    let weight = |k: usize| -> f64 { (0..4).filter(|j| *j != k).map(|j| (x - j as f64) / (k as f64 - j as f64)).product() };
    (0..4).map(|k| weight(k) * course[first + k]).sum()
}

/// A record without noise; a reading of the rate is the mean over the [`SPAN`] that ends at its instant, before the start the
/// unit is at rest.
pub(super) fn signal(run: &Run, time: &[f64], rest: f64) -> Signal {
    let angle = |t: f64| if t > 0.0 { at(&run.angle, t) } else { rest * t };
    Signal {
        spool: time.iter().map(|t| at(&run.sensor, *t)).collect(),
        rate: time.iter().map(|t| (angle(*t) - angle(t - SPAN)) / SPAN).collect(),
    }
}

pub(super) struct Sensors {
    /// Of the spool's thermometer \[K\].
    pub(super) resolution: f64,
    /// Of the spool's thermometer \[K\].
    pub(super) offset: f64,
}

impl Sensors {
    pub(super) fn draw(random: &mut Random) -> Self {
        Self { resolution: if random.chance(0.35) { 0.0625 } else { 0.01 }, offset: 0.04 * random.normal() }
    }

    /// The file of a record. `rate` is read with its noise; a few outliers may be added.
    pub(super) fn write(
        &self,
        course: &Course,
        time: &[f64],
        signal: &Signal,
        noise: &[f64],
        white: f64,
        random: &mut Random,
    ) -> String {
        let mut rate: Vec<f64> = signal.rate.iter().zip(noise).map(|(s, n)| s + n).collect();
        if random.chance(0.2) {
            for _ in 0..=random.below(4) {
                rate[random.below(time.len())] += white * random.sign() * random.uniform(10.0, 40.0);
            }
        }
        let mut text = String::from("time_s,chamber_c,spool_c,rate_deg_per_h\n");
        let mut read = |value: f64, resolution: f64| ((value + THERMOMETER * random.normal()) / resolution).round() * resolution;
        let digits = if self.resolution > 0.01 { 4 } else { 2 };
        for (n, t) in time.iter().enumerate() {
            let chamber = read(at(&course.temperature, *t), CHAMBER_RESOLUTION);
            let spool = read(signal.spool[n] + self.offset, self.resolution);
            let _ = writeln!(text, "{t},{chamber:.2},{spool:.digits$},{:.5}", rate[n]);
        }
        text
    }
}
