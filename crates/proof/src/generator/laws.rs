//! Laws that no library lists, drawn for one unit: what follows temperatures, their rates, their past or the time, and adds to the rate.

use super::chamber::STEP;
use super::plant::Run;
use super::random::Random;
use crate::truth::ConcealedEffect;
use std::f64::consts::TAU;

/// Temperature on which a law depends.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Body {
    Chamber,
    Bore,
    Coil,
}

/// A law's form with its numbers beside the size. Temperatures \[°C\], times \[s\].
#[derive(Debug, Clone, Copy, PartialEq)]
enum Form {
    /// A sine of the temperature, of which an incoherent source washes out what is far from the middle.
    Ripple {
        period: f64,
        phase: f64,
        coherence: f64,
    },
    /// A step at a time, over some minutes.
    Step {
        at: f64,
        width: f64,
    },
    /// An effect of the direction of a change.
    Direction {
        slow: f64,
    },
    /// An effect that fades from the start.
    Fading {
        time: f64,
    },
    /// Current of a chamber's heater above the balance of pump and walls.
    HeaterCurrent {
        walls: f64,
    },
    RateSquared,
    LevelSquared,
    Speed,
    /// Second derivative, as a filter of this time sees it.
    Bend {
        time: f64,
    },
    /// Lag of a part behind the temperature.
    Lag {
        time: f64,
    },
    /// Lag of the mean of a slab, into which heat or moisture diffuses from one side.
    Slab {
        time: f64,
    },
    /// Lag of a part with friction: it follows when it is this far off.
    Play {
        width: f64,
    },
    /// As play, but the part jumps all the way once it lets go.
    Slip {
        width: f64,
    },
    /// Distance from the highest so far.
    Highest,
    /// Latent heat.
    Pulse {
        at: f64,
        width: f64,
    },
    Threshold {
        at: f64,
        width: f64,
    },
    Knee {
        at: f64,
    },
    /// Arrhenius' law, of this activation energy \[eV\].
    Activated {
        energy: f64,
    },
    Drift,
    /// A constant of the coil that depends on its temperature: the bias grows with it.
    OfBias,
}

/// Forms.
pub(super) const LAWS: usize = 20;
/// Cells of a slab.
const CELLS: usize = 20;
/// Boltzmann's constant \[eV/K\].
const BOLTZMANN: f64 = 8.617e-5;
const KELVIN: f64 = 273.15;
const MIDDLE: f64 = 20.0;

/// A law, its size the rate \[deg/h\] where its form is 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drawn {
    form: Form,
    body: Body,
    size: f64,
}

impl Drawn {
    /// The `kind`-th form.
    pub(super) fn draw(kind: usize, random: &mut Random) -> Self {
        let body = [Body::Chamber, Body::Bore, Body::Coil][random.below(3)];
        let at = random.uniform(-25.0, 45.0);
        let width = random.log_uniform(1.5, 8.0);
        let form = match kind % LAWS {
            0 => Form::Ripple {
                period: random.log_uniform(6.0, 25.0),
                phase: random.uniform(0.0, TAU),
                coherence: random.log_uniform(60.0, 300.0),
            },
            1 => Form::Step { at: random.uniform(3.0, 9.0) * 3600.0, width: random.log_uniform(10.0, 600.0) },
            2 => Form::Direction { slow: random.log_uniform(0.02, 0.2) / 60.0 },
            3 => Form::Fading { time: random.log_uniform(1.0, 6.0) * 3600.0 },
            4 => Form::HeaterCurrent { walls: random.log_uniform(20.0, 90.0) * 60.0 },
            5 => Form::RateSquared,
            6 => Form::LevelSquared,
            7 => Form::Speed,
            8 => Form::Bend { time: random.log_uniform(60.0, 400.0) },
            9 => Form::Lag { time: random.log_uniform(300.0, 8000.0) },
            10 => Form::Slab { time: random.log_uniform(2000.0, 30_000.0) },
            11 => Form::Play { width: random.log_uniform(3.0, 25.0) },
            12 => Form::Slip { width: random.log_uniform(3.0, 15.0) },
            13 => Form::Highest,
            14 => Form::Pulse { at, width },
            15 => Form::Threshold { at, width },
            16 => Form::Knee { at },
            17 => Form::Activated { energy: random.uniform(0.2, 0.7) },
            18 => Form::Drift,
            _ => Form::OfBias,
        };
        Self { form, body, size: 0.005 * random.sign() }
    }

    /// The same so many times as large.
    pub(super) fn times(self, factor: f64) -> Self {
        Self { size: factor * self.size, ..self }
    }

    /// As a truth names it.
    pub(super) fn effect(&self) -> ConcealedEffect {
        let Self { form, body, size } = self;
        ConcealedEffect { id: format!("{form:?} of {body:?}"), parameters: [("size_deg_per_h".to_owned(), *size)].into() }
    }

    /// Adds what it does to the angle of a run; the rate that it begins with [deg/h].
    pub(super) fn act(&self, chamber: &[f64], run: &mut Run) -> f64 {
        let body = match self.body {
            Body::Chamber => chamber,
            Body::Bore => &run.bore,
            Body::Coil => &run.coil,
        };
        let bias: Vec<f64> = run.angle.windows(2).map(|w| (w[1] - w[0]) / STEP).collect();
        let mut past = Past::new(body[0]);
        let mut angle = 0.0;
        let added: Vec<f64> = (1..run.angle.len())
            .map(|n| {
                angle += STEP * self.size * past.step(self.form, [body[n - 1], body[n]], n as f64 * STEP, bias[n - 1]);
                angle
            })
            .collect();
        let first = added.first().map_or(0.0, |angle| angle / STEP);
        run.angle[1..].iter_mut().zip(added).for_each(|(angle, added)| *angle += added);
        first
    }
}

/// Memory of a law.
struct Past {
    lagging: f64,
    rate: f64,
    highest: f64,
    cells: [f64; CELLS],
}

impl Past {
    fn new(start: f64) -> Self {
        Self { lagging: start, rate: 0.0, highest: start, cells: [start; CELLS] }
    }

    /// The form over a step between two temperatures that ends at a time, beside this bias [deg/h]: of the order of 1 in a day's cycle.
    fn step(&mut self, form: Form, [before, now]: [f64; 2], time: f64, bias: f64) -> f64 {
        const PER_MINUTE: f64 = 1.0 / 60.0;
        let rate = (now - before) / STEP;
        let off = now - MIDDLE;
        match form {
            Form::Ripple { period, phase, coherence } => (TAU * now / period + phase).sin() * (-(off / coherence).powi(2)).exp(),
            Form::Step { at, width } => 0.5 + ((time - at) / width).atan() / std::f64::consts::PI,
            Form::Direction { slow } => rate / (rate * rate + slow * slow).sqrt(),
            Form::Fading { time: fades } => (-time / fades).exp(),
            Form::HeaterCurrent { walls } => ((rate * walls + now + 20.0) / 140.0).max(0.0),
            Form::RateSquared => (rate / PER_MINUTE).powi(2),
            Form::LevelSquared => ((now - 10.0) / 50.0).powi(2),
            Form::Speed => (rate / PER_MINUTE).abs(),
            Form::Bend { time } => {
                let change = (rate - self.rate) * -(-STEP / time).exp_m1();
                self.rate += change;
                change / STEP / (PER_MINUTE / 600.0)
            }
            Form::Lag { time } => {
                self.lagging = now + (self.lagging - now) * (-STEP / time).exp();
                (now - self.lagging) / 10.0
            }
            Form::Slab { time } => {
                self.diffuse(now, time);
                (now - self.cells.iter().sum::<f64>() / CELLS as f64) / 10.0
            }
            Form::Play { width } => {
                self.lagging = self.lagging.clamp(now - width / 2.0, now + width / 2.0);
                (now - self.lagging) / 10.0
            }
            Form::Slip { width } => {
                if (now - self.lagging).abs() > width / 2.0 {
                    self.lagging = now;
                }
                (now - self.lagging) / 10.0
            }
            Form::Highest => {
                self.highest = self.highest.max(now);
                (self.highest - now) / 50.0
            }
            Form::Pulse { at, width } => rate / PER_MINUTE * (-((now - at) / width).powi(2)).exp(),
            Form::Threshold { at, width } => 0.5 + 0.5 * ((now - at) / (2.0 * width)).tanh(),
            Form::Knee { at } => (now - at).max(0.0) / 30.0,
            Form::Activated { energy } => {
                let inverse = |t: f64| 1.0 / (BOLTZMANN * (t + KELVIN));
                (energy * (inverse(50.0) - inverse(now))).exp()
            }
            Form::Drift => time / 40_000.0,
            Form::OfBias => bias * off / 50.0,
        }
    }

    /// Implicit differences: one face of the slab has the temperature `face`, none passes the other; `time` is thickness squared over diffusivity.
    fn diffuse(&mut self, face: f64, time: f64) {
        let r = STEP / time * (CELLS * CELLS) as f64;
        // Thomas' algorithm; half a cell lies between the face and the first middle
        let (mut upper, mut right) = ([0.0; CELLS], [0.0; CELLS]);
        for n in 0..CELLS {
            let lower = if n > 0 { -r } else { 0.0 };
            let above = if n + 1 < CELLS { -r } else { 0.0 };
            let own = 1.0 - above + if n > 0 { r } else { 2.0 * r };
            let known = self.cells[n] + if n > 0 { 0.0 } else { 2.0 * r * face };
            let (before, solved) = if n > 0 { (upper[n - 1], right[n - 1]) } else { (0.0, 0.0) };
            let pivot = own - lower * before;
            (upper[n], right[n]) = (above / pivot, (known - lower * solved) / pivot);
        }
        let mut next = 0.0;
        for n in (0..CELLS).rev() {
            next = right[n] - upper[n] * next;
            self.cells[n] = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slab whose face rises by a kelvin: the mean follows Crank's series, The Mathematics of Diffusion, eq. 4.18.
    #[test]
    fn exact_a_slab_fills_as_cranks_series() {
        let time = 5000.0;
        let mut past = Past::new(0.0);
        for n in 1..=400 {
            past.diffuse(1.0, time);
            let x = f64::from(n) * STEP / time;
            let term = |m: u32| {
                let odd = f64::from(2 * m + 1) * TAU / 4.0;
                2.0 / (odd * odd) * (-odd * odd * x).exp()
            };
            let exact = 1.0 - (0..200).map(term).sum::<f64>();
            let mean = past.cells.iter().sum::<f64>() / CELLS as f64;
            assert!(n < 40 || (mean - exact).abs() < 4e-3, "step {n}: {mean} against {exact}");
        }
    }

    #[test]
    fn every_form_is_drawn_and_finite() {
        let mut random = Random::new(3, 0);
        let mut forms = std::collections::HashSet::new();
        for kind in 0..LAWS {
            let drawn = Drawn::draw(kind, &mut random);
            let mut past = Past::new(20.0);
            let course: Vec<f64> = (0..20_000).map(|n| 20.0 + 40.0 * (f64::from(n) * STEP / 10_000.0).sin()).collect();
            let values: Vec<f64> =
                (1..course.len()).map(|n| past.step(drawn.form, [course[n - 1], course[n]], n as f64 * STEP, 0.5)).collect();
            let most = values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
            assert!(values.iter().all(|v| v.is_finite()) && (1e-3..1e2).contains(&most), "{drawn:?}: {most}");
            forms.insert(std::mem::discriminant(&drawn.form));
        }
        assert_eq!(forms.len(), LAWS);
    }
}
