//! The chamber: programmes of the five families, a controller that lags and wanders.

use super::random::Random;
use std::f64::consts::TAU;

/// Time between the points of a course \[s\].
pub(super) const STEP: f64 = 5.0;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProgrammeFamily {
    /// There and back at about 0.2 K/min with soaks.
    P1,
    /// The same at about 1 K/min, long soaks.
    P2,
    /// Staircase of 10 K at about 2 K/min.
    P3,
    /// Sine and pseudo-random steps about four means.
    P4,
    /// Two equal cycles at about 0.5 K/min.
    P5,
}

impl ProgrammeFamily {
    pub(super) const ALL: [Self; 5] = [Self::P1, Self::P2, Self::P3, Self::P4, Self::P5];
}

/// The temperature of the chamber's wall every [`STEP`] seconds, linear in between.
pub(super) struct Course {
    /// \[°C\]
    pub(super) temperature: Vec<f64>,
    /// Whether the programme turns within a minute.
    pub(super) turns: Vec<bool>,
}

/// Corners of a programme \[s\], \[°C\].
struct Programme(Vec<(f64, f64)>);

impl Programme {
    fn end(&self) -> (f64, f64) {
        self.0[self.0.len() - 1]
    }

    fn hold(&mut self, minutes: f64) {
        let (time, temperature) = self.end();
        self.0.push((time + 60.0 * minutes, temperature));
    }

    /// `rate` in K/min, > 0.
    fn ramp(&mut self, to: f64, rate: f64) {
        let (time, from) = self.end();
        if to != from {
            self.0.push((time + 60.0 * (to - from).abs() / rate, to));
        }
    }

    fn draw(family: ProgrammeFamily, random: &mut Random) -> Self {
        let start = random.uniform(18.0, 22.0);
        let mut programme = Self(vec![(0.0, start)]);
        programme.hold(random.uniform(25.0, 45.0));
        let mut ends = [random.uniform(-42.0, -36.0), random.uniform(52.0, 62.0)];
        if random.chance(0.5) {
            ends.reverse();
        }
        match family {
            ProgrammeFamily::P1 => programme.cycle(start, ends, random.uniform(0.17, 0.3), random.uniform(45.0, 90.0)),
            ProgrammeFamily::P2 => programme.cycle(start, ends, random.uniform(0.8, 1.2), random.uniform(150.0, 190.0)),
            ProgrammeFamily::P3 => programme.staircase(start, ends, random.uniform(1.6, 2.2), random.uniform(45.0, 60.0)),
            ProgrammeFamily::P4 => programme.wandering(ends, random),
            ProgrammeFamily::P5 => {
                let (rate, soak) = (random.uniform(0.4, 0.6), random.uniform(40.0, 70.0));
                programme.cycle(start, ends, rate, soak);
                programme.cycle(start, ends, rate, soak);
            }
        }
        programme
    }

    fn cycle(&mut self, start: f64, [first, second]: [f64; 2], rate: f64, soak: f64) {
        for to in [first, second, start] {
            self.ramp(to, rate);
            self.hold(soak);
        }
    }

    fn staircase(&mut self, start: f64, [first, second]: [f64; 2], rate: f64, dwell: f64) {
        for (to, height) in [(first, 10.0), (second, 10.0), (start, 20.0)] {
            while self.end().1 != to {
                let left = to - self.end().1;
                // a last step of less than half a step is taken with the one before
                let next = if left.abs() < 1.5 * height { to } else { self.end().1 + height * left.signum() };
                self.ramp(next, rate);
                self.hold(dwell);
            }
        }
    }

    fn wandering(&mut self, ends: [f64; 2], random: &mut Random) {
        const ROW: f64 = 0.5;
        const FASTEST: f64 = 2.0;
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let mut means = [0.15, 0.4, 0.63, 0.87].map(|share| low + share * (high - low));
        for k in (1..means.len()).rev() {
            means.swap(k, random.below(k + 1));
        }
        for mean in means {
            let (amplitude, period, phase) = (random.uniform(4.0, 9.0), random.uniform(60.0, 150.0), random.uniform(0.0, TAU));
            let (mut step, mut left, mut minutes) = (0.0, 0.0, random.uniform(210.0, 270.0));
            while minutes > 0.0 {
                if left <= 0.0 {
                    step = random.sign() * random.uniform(5.0, 15.0) / 2.0;
                    left = random.uniform(10.0, 30.0);
                }
                let target = (mean + amplitude * (TAU * minutes / period + phase).sin() + step).clamp(low, high);
                let (time, now) = self.end();
                self.0.push((time + 60.0 * ROW, now + (target - now).clamp(-FASTEST * ROW, FASTEST * ROW)));
                (minutes, left) = (minutes - ROW, left - ROW);
            }
        }
    }

    fn at(&self, time: f64) -> f64 {
        let after = self.0.partition_point(|p| p.0 <= time).min(self.0.len() - 1);
        let ((t0, c0), (t1, c1)) = (self.0[after - 1], self.0[after]);
        c0 + (c1 - c0) * ((time - t0) / (t1 - t0)).clamp(0.0, 1.0)
    }
}

impl Course {
    /// A programme of `family` behind a first-order controller, with an exponentially correlated wander of some hundredths of a kelvin.
    pub(super) fn draw(family: ProgrammeFamily, random: &mut Random) -> Self {
        let programme = Programme::draw(family, random);
        let count = (programme.end().0 / STEP) as usize + 1;
        let wanted: Vec<f64> = (0..count).map(|n| programme.at(n as f64 * STEP)).collect();
        let keep = (-STEP / random.uniform(50.0, 100.0)).exp();
        let (size, time) = (random.uniform(0.015, 0.03), random.uniform(400.0, 1200.0));
        let (forget, fresh) = ((-STEP / time).exp(), size * (-(-2.0 * STEP / time).exp_m1()).sqrt());
        let (mut wander, mut now) = (0.0, wanted[0]);
        let mut temperature = Vec::with_capacity(count);
        for target in &wanted {
            now = target + wander + (now - target - wander) * keep;
            temperature.push(now);
            wander = wander * forget + fresh * random.normal();
        }
        // the controller has settled some minutes after a corner
        const SETTLING: usize = 72;
        let bent = |n: &usize| (wanted[n + 1] - 2.0 * wanted[*n] + wanted[n - 1]).abs() > 1e-9;
        let mut turns = vec![false; count];
        for n in (1..count - 1).filter(bent) {
            turns[n - n.min(12)..(n + SETTLING).min(count)].fill(true);
        }
        Self { temperature, turns }
    }
}
