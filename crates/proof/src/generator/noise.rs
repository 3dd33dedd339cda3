//! The gyro's noise: what the identification expects, and in some units what it does not.

use super::random::Random;
use crate::truth;
use std::f64::consts::TAU;

/// Span of a reading \[s\].
pub(crate) const SPAN: f64 = 30.0;

/// A unit's noise; rates in deg/h.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Noise {
    /// [deg/√h]
    pub(super) arw: f64,
    /// Standard deviation [deg/h] and correlation time \[s\].
    pub(super) drift: (f64, f64),
    /// [deg/h/√h]
    pub(super) walk: f64,
    pub(super) offset: f64,
    pub(super) unseen: Option<Unseen>,
}

/// Families that the noise identification has no term for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Unseen {
    /// A second drift, faster or slower: standard deviation, correlation time \[s\].
    SecondDrift(f64, f64),
    /// Jumps between two rates ± this, after this long on average \[s\].
    Telegraph(f64, f64),
    /// 1/f noise of this size in each of its [`FLICKER`] scales.
    Flicker(f64),
    /// A sine of this amplitude, period \[s\] and phase.
    Daily(f64, f64, f64),
    /// White noise of Student's t with this many degrees of freedom, variance as ever.
    HeavyTails(usize),
    /// White noise whose size swings by this share, with this period \[s\] and phase.
    Breathing(f64, f64, f64),
}

/// Correlation times whose drifts together are 1/f noise from minutes to a day \[s\].
const FLICKER: [f64; 6] = [60.0, 240.0, 960.0, 3840.0, 15360.0, 61440.0];

/// A component of the coloured noise as a linear system.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Component {
    /// Standard deviation, correlation time \[s\].
    Markov(f64, f64),
    /// Standard deviation gained in a second, squared.
    Walk(f64),
    /// Root mean square, angular frequency \[rad/s\].
    Wave(f64, f64),
}

impl Noise {
    /// The sizes of the described records; unseen families in two units of five.
    pub(super) fn draw(random: &mut Random) -> Self {
        let unseen = random.chance(0.4).then(|| match random.below(6) {
            0 if random.chance(0.5) => Unseen::SecondDrift(random.uniform(0.001, 0.003), random.log_uniform(200.0, 900.0)),
            0 => Unseen::SecondDrift(random.uniform(0.001, 0.003), random.log_uniform(2e4, 6e4)),
            1 => Unseen::Telegraph(random.uniform(0.001, 0.003), random.log_uniform(2e3, 1e4)),
            2 => Unseen::Flicker(random.uniform(0.0007, 0.0015)),
            3 => Unseen::Daily(random.uniform(0.001, 0.0025), random.uniform(6e4, 1e5), random.uniform(0.0, TAU)),
            4 => Unseen::HeavyTails(3 + random.below(4)),
            _ => Unseen::Breathing(random.uniform(0.3, 0.6), random.log_uniform(7e3, 6e4), random.uniform(0.0, TAU)),
        });
        Self {
            arw: random.log_uniform(0.0003, 0.002),
            drift: (random.uniform(0.001, 0.005), random.uniform(3600.0, 10800.0)),
            walk: if random.chance(0.3) { random.log_uniform(0.0003, 0.0015) } else { 0.0 },
            offset: random.uniform(-0.1, 0.1),
            unseen,
        }
    }

    /// As the truth files hold it.
    pub(super) fn truth(&self) -> truth::Noise {
        truth::Noise {
            arw_deg_per_sqrt_h: self.arw,
            gm_sigma_deg_per_h: self.drift.0,
            gm_tau_s: self.drift.1,
            rrw_deg_per_h_per_sqrt_h: self.walk,
            offset_deg_per_h: self.offset,
            unseen: self.unseen.map(|unseen| unseen.label()),
        }
    }

    /// Standard deviation of the white noise of a reading.
    pub(super) fn white(&self, time: f64) -> f64 {
        let swing = match self.unseen {
            Some(Unseen::Breathing(share, period, phase)) => 1.0 + share * (TAU * time / period + phase).sin(),
            _ => 1.0,
        };
        swing * self.arw / (SPAN / 3600.0).sqrt()
    }

    /// The coloured part, up to second order.
    pub(super) fn components(&self) -> Vec<Component> {
        let mut components = vec![Component::Markov(self.drift.0, self.drift.1)];
        if self.walk > 0.0 {
            components.push(Component::Walk(self.walk * self.walk / 3600.0));
        }
        match self.unseen {
            Some(Unseen::SecondDrift(size, time)) => components.push(Component::Markov(size, time)),
            // jumps of rate 1/dwell decorrelate at twice that
            Some(Unseen::Telegraph(size, dwell)) => components.push(Component::Markov(size, dwell / 2.0)),
            Some(Unseen::Flicker(size)) => components.extend(FLICKER.map(|time| Component::Markov(size, time))),
            Some(Unseen::Daily(size, period, _)) => components.push(Component::Wave(size / 2.0_f64.sqrt(), TAU / period)),
            Some(Unseen::HeavyTails(_) | Unseen::Breathing(..)) | None => {}
        }
        components
    }

    /// Noise of readings that end at `time`, `since` seconds after the unit's first record began; the offset is in it.
    pub(super) fn sample(&self, time: &[f64], since: f64, random: &mut Random) -> Vec<f64> {
        let mut sum: Vec<f64> = time.iter().map(|t| self.offset + self.white(*t) * self.standard(random)).collect();
        let mut markov = |size: f64, tau: f64, random: &mut Random| {
            let mut state = size * random.normal();
            for n in 0..time.len() {
                let keep = if n > 0 { (-(time[n] - time[n - 1]) / tau).exp() } else { 1.0 };
                state = keep * state + size * (1.0 - keep * keep).sqrt() * random.normal();
                sum[n] += state;
            }
        };
        markov(self.drift.0, self.drift.1, random);
        match self.unseen {
            Some(Unseen::SecondDrift(size, tau)) => markov(size, tau, random),
            Some(Unseen::Flicker(size)) => FLICKER.iter().for_each(|tau| markov(size, *tau, random)),
            Some(Unseen::Telegraph(size, dwell)) => {
                let mut state = size * random.sign();
                let mut until = -dwell * random.uniform(0.0, 1.0).ln();
                for (sum, t) in sum.iter_mut().zip(time) {
                    while *t > until {
                        state = -state;
                        until -= dwell * random.uniform(0.0, 1.0).ln();
                    }
                    *sum += state;
                }
            }
            Some(Unseen::Daily(size, period, phase)) => {
                sum.iter_mut().zip(time).for_each(|(sum, t)| *sum += size * (TAU * (t + since) / period + phase).sin());
            }
            Some(Unseen::HeavyTails(_) | Unseen::Breathing(..)) | None => {}
        }
        let mut walk = 0.0;
        for n in 1..time.len() {
            walk += self.walk * ((time[n] - time[n - 1]) / 3600.0).sqrt() * random.normal();
            sum[n] += walk;
        }
        sum
    }

    /// A draw of unit variance.
    fn standard(&self, random: &mut Random) -> f64 {
        match self.unseen {
            Some(Unseen::HeavyTails(freedom)) => {
                let squares: f64 = (0..freedom).map(|_| random.normal().powi(2)).sum();
                // variance of Student's t: ν/(ν − 2)
                random.normal() * ((freedom - 2) as f64 / squares).sqrt()
            }
            _ => random.normal(),
        }
    }
}

impl Unseen {
    /// As the truth files name it.
    pub(super) fn label(&self) -> String {
        match self {
            Self::SecondDrift(size, time) => format!("second drift of {size:.5} deg/h over {time:.0} s"),
            Self::Telegraph(size, dwell) => format!("random telegraph of {size:.5} deg/h, {dwell:.0} s"),
            Self::Flicker(size) => format!("1/f noise of {size:.5} deg/h per factor of four"),
            Self::Daily(size, period, _) => format!("sine of {size:.5} deg/h, {period:.0} s"),
            Self::HeavyTails(freedom) => format!("heavy-tailed white noise of {freedom} degrees of freedom (Student's t)"),
            Self::Breathing(share, period, _) => format!("swinging white noise of {share:.2} over {period:.0} s"),
        }
    }
}
