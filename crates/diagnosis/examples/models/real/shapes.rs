//! The small laws' shapes: what a law makes of one quantity, in the quantity's own scale. They are the same for every recording.

use super::plant::Kind;
use diagnosis::{Parameter, Prior};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Function of a quantity x in a law; x runs from about −1 to 1, and so does its rate r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    Linear,
    Square,
    Cube,
    Rate,
    Speed,
    Direction,
    RateByLevel,
    Lag,
    Memory,
    Play,
    Highest,
    Lowest,
    Threshold,
    Knee,
    Stop,
    Bump,
    Growth,
    Ripple,
    Fading,
    Harmonic(u8),
    Sawtooth,
    AfterReset,
    LateAfterReset,
    AboutPhase,
}

use Shape::*;

const OF_LEVEL: [Shape; 18] = [
    Linear,
    Square,
    Cube,
    Rate,
    Speed,
    Direction,
    RateByLevel,
    Lag,
    Memory,
    Play,
    Highest,
    Lowest,
    Threshold,
    Knee,
    Bump,
    Growth,
    Ripple,
    Stop,
];
const OF_TIME: [Shape; 5] = [Linear, Square, Threshold, Knee, Fading];
const OF_PHASE: [Shape; 12] = [
    Harmonic(1),
    Harmonic(2),
    Harmonic(3),
    Harmonic(4),
    Harmonic(5),
    Harmonic(6),
    Harmonic(7),
    Harmonic(8),
    Sawtooth,
    AfterReset,
    LateAfterReset,
    AboutPhase,
];
const IN_PRODUCT: [Shape; 6] = [Linear, Square, Cube, Threshold, Bump, Ripple];
const OF_TIME_IN_PRODUCT: [Shape; 2] = [Linear, Threshold];
/// Width of logistic functions in a quantity's scale: bounded functions need no scale of their own.
const WIDTH: f64 = 0.1;
/// A stop does in this share of a quantity's scale what a knee does in all of it.
const STEEP: f64 = 0.05;
/// Shapes of a quantity by which something is passed on from its body to another.
pub(crate) const PASSED_ON: [Shape; 2] = [Knee, Stop];

/// Shapes that are tried of a quantity alone.
pub(crate) fn alone(kind: Kind) -> &'static [Shape] {
    match kind {
        Kind::Level | Kind::Flow => &OF_LEVEL,
        Kind::Time => &OF_TIME,
        Kind::Phase => &OF_PHASE,
    }
}

/// Shapes of a quantity with which another one is multiplied.
pub(crate) fn in_product(kind: Kind) -> &'static [Shape] {
    match kind {
        Kind::Level | Kind::Flow => &IN_PRODUCT,
        Kind::Time => &OF_TIME_IN_PRODUCT,
        Kind::Phase => &[],
    }
}

/// A parameter beside the size: what is known of it, and where fits start.
pub(crate) struct Beside {
    pub(crate) parameter: Parameter,
    pub(crate) starts: Vec<f64>,
}

fn beside(name: &str, prior: Prior, starts: &[f64]) -> Beside {
    Beside { parameter: Parameter::new(name, prior).with_step(0.01), starts: starts.to_vec() }
}

impl Shape {
    /// Its parameters beside the size, for records of a duration \[s\].
    pub(crate) fn beside(self, duration: f64) -> Vec<Beside> {
        let time = |share: f64| {
            beside(
                "tau_s",
                Prior::LogNormal { median: share * duration, spread: 1.0 },
                &[0.2, 1.0, 4.0].map(|by| by * share * duration),
            )
        };
        let at = || beside("at", Prior::Uniform { low: -1.1, high: 1.1 }, &[-0.7, -0.35, 0.0, 0.35, 0.7]);
        let width = |median: f64| beside("width", Prior::LogNormal { median, spread: 0.7 }, &[median]);
        match self {
            Lag | Memory => vec![time(0.1)],
            Fading => vec![time(0.2)],
            AfterReset | LateAfterReset => vec![time(0.001)],
            AboutPhase => {
                vec![beside("at", Prior::Uniform { low: 0.0, high: 1.0 }, &[0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95]), width(0.05)]
            }
            Play => vec![beside("width", Prior::LogNormal { median: 0.3, spread: 0.8 }, &[0.1, 0.3, 0.8])],
            Threshold => vec![at(), width(WIDTH)],
            Knee | Stop => vec![at()],
            Bump => vec![at(), width(0.25)],
            Growth => vec![beside("scale", Prior::LogNormal { median: 0.7, spread: 0.5 }, &[0.4, 1.0])],
            Ripple => vec![
                beside("period", Prior::LogNormal { median: 0.8, spread: 0.7 }, &[0.3, 0.5, 0.8, 1.3]),
                beside("phase", Prior::Uniform { low: -PI, high: PI }, &[0.0, FRAC_PI_2]),
            ],
            Harmonic(_) => vec![beside("phase", Prior::Uniform { low: -PI, high: PI }, &[0.0, FRAC_PI_2])],
            _ => Vec::new(),
        }
    }

    /// In words, of a quantity's name.
    pub(crate) fn words(self, of: &str) -> String {
        match self {
            Linear => format!("with {of}"),
            Square => format!("with the square of {of}"),
            Cube => format!("with the cube of {of}"),
            Rate => format!("with the rate of {of}"),
            Speed => format!("with the size of the rate of {of}"),
            Direction => format!("with the direction in which {of} goes"),
            RateByLevel => format!("with rate times level of {of}"),
            Lag => format!("with what a slow part lags behind {of}"),
            Memory => format!("with the memory of {of}"),
            Play => format!("with the play of {of}"),
            Highest => format!("with how far {of} is from its highest"),
            Lowest => format!("with how far {of} is from its lowest"),
            Threshold => format!("beyond a threshold of {of}"),
            Knee => format!("beyond a knee of {of}"),
            Stop => format!("steeply beyond a stop of {of}"),
            Bump => format!("about one value of {of}"),
            Growth => format!("that grows exponentially with {of}"),
            Ripple => format!("that is periodic in {of}"),
            Fading => "that fades after the start".to_owned(),
            Harmonic(k) => format!("with harmonic {k} of {of}"),
            Sawtooth => format!("with the sawtooth of {of}"),
            AfterReset => format!("that fades after every reset of {of}"),
            LateAfterReset => format!("that rises and fades after every reset of {of}"),
            AboutPhase => format!("about one phase of {of}"),
        }
    }

    /// Value at an instant; `p` are the parameters beside the size, `memory` is the law's own.
    pub(crate) fn at(self, x: f64, step: f64, rates: &Rates, p: &[f64], memory: &mut Past) -> f64 {
        let rate = |memory: &mut Past| rates.of(x, step, memory);
        let first = |i: usize| p.get(i).copied().unwrap_or(1.0);
        match self {
            Linear => x,
            Square => x * x,
            Cube => x.powi(3),
            Rate => rate(memory),
            Speed => rate(memory).abs(),
            Direction => (rate(memory) / WIDTH).tanh(),
            RateByLevel => x * rate(memory),
            Lag => x - memory.follow(0, x, step, first(0)),
            Memory => {
                let behind = [1.0, 5.0, 25.0].map(|by| by * first(0));
                x - (0..3).map(|k| memory.follow(k, x, step, behind[k])).sum::<f64>() / 3.0
            }
            Play => x - memory.play(x, first(0)),
            Highest => memory.extreme(x, f64::max) - x,
            Lowest => x - memory.extreme(x, f64::min),
            Threshold => 1.0 / (1.0 + (-(x - first(0)) / first(1)).exp()),
            Knee => (x - first(0)).max(0.0),
            Stop => (x - first(0)).max(0.0) / STEEP,
            Bump => (-((x - first(0)) / first(1)).powi(2)).exp(),
            Growth => ((x - 1.0) / first(0)).exp(),
            Ripple => (TAU * x / first(0) + first(1)).sin(),
            Fading => (-memory.elapsed(step) / first(0)).exp(),
            Harmonic(k) => (TAU * f64::from(k) * x + first(0)).sin(),
            Sawtooth => 2.0 * (x - x.floor()) - 1.0,
            AfterReset => memory.after_reset(x, step, first(0)),
            LateAfterReset => {
                let pulse = memory.after_reset(x, step, first(0));
                memory.late(pulse, step, first(0))
            }
            AboutPhase => {
                let off = x - first(0);
                (-((off - off.round()) / first(1)).powi(2)).exp()
            }
        }
    }
}

/// How a quantity's rate is scaled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Rates {
    /// Time over which a rate is taken \[s\].
    pub(crate) over: f64,
    /// Largest rate of the quantity in its scale, in the records that are fitted \[1/s\].
    pub(crate) largest: f64,
}

impl Rates {
    pub(crate) fn raw(&self, x: f64, step: f64, memory: &mut Past) -> f64 {
        (x - memory.follow(0, x, step, self.over)) / self.over
    }

    fn of(&self, x: f64, step: f64, memory: &mut Past) -> f64 {
        self.raw(x, step, memory) / self.largest.max(f64::MIN_POSITIVE)
    }
}

/// Memory of a law within a test.
#[derive(Debug, Clone, Default)]
pub(crate) struct Past {
    states: [Option<f64>; 3],
    elapsed: f64,
}

impl Past {
    /// A state that follows `x` with a time constant, from rest.
    pub(crate) fn follow(&mut self, state: usize, x: f64, step: f64, tau: f64) -> f64 {
        let y = self.states[state].unwrap_or(x);
        let y = y + (x - y) * -(-step / tau.max(1e-9)).exp_m1();
        self.states[state] = Some(y);
        y
    }

    fn play(&mut self, x: f64, width: f64) -> f64 {
        let y = self.states[0].unwrap_or(x).clamp(x - width / 2.0, x + width / 2.0);
        self.states[0] = Some(y);
        y
    }

    fn extreme(&mut self, x: f64, of: fn(f64, f64) -> f64) -> f64 {
        let y = of(self.states[0].unwrap_or(x), x);
        self.states[0] = Some(y);
        y
    }

    fn elapsed(&mut self, step: f64) -> f64 {
        self.elapsed += step;
        self.elapsed
    }

    /// exp(−time since the phase was last set back by a cycle / tau), signed by the way it was going.
    fn after_reset(&mut self, x: f64, step: f64, tau: f64) -> f64 {
        let jump = x - self.states[0].unwrap_or(x);
        let faded = self.states[1].unwrap_or(0.0) * (-step / tau.max(1e-9)).exp();
        let y = if jump.abs() > 0.5 { -jump.signum() } else { faded };
        self.states[0] = Some(x);
        self.states[1] = Some(y);
        y
    }

    /// A pulse behind a lag, of which nothing is left before it began.
    fn late(&mut self, pulse: f64, step: f64, tau: f64) -> f64 {
        let y = self.states[2].unwrap_or(0.0);
        // what the pulse was at the end of the last step drives this one
        let y = y + (pulse - y) * -(-step / tau.max(1e-9)).exp_m1();
        self.states[2] = Some(y);
        y
    }
}
