//! A small law as a mechanism's file, and the ranges of records on which its parameters depend.

use std::fmt::Write as _;

use mechanisms::Scene;

/// Ranges of the quantities that laws depend on, in the fitted records.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ranges {
    /// Coldest and hottest \[°C\].
    pub(super) temperatures: [f64; 2],
    /// Largest distance from 20 °C \[K\].
    pub(super) far: f64,
    /// Largest rate of the spool \[K/s\].
    pub(super) rate: f64,
    /// Longest record \[s\].
    pub(super) duration: f64,
    /// Largest |part| of the bias as designed, and of the sum \[deg/h\].
    pub(super) parts: [f64; 4],
    /// Size that is expected of an effect \[deg/h\].
    pub(super) size: f64,
}

/// Size that is expected of an effect, in noises of a reading of a minute: a larger effect is seen by eye, a smaller one hardly at all.
const EXPECTED: f64 = 30.0;
/// Span over which a rate is stated \[s\]: no law shows in less.
const MINUTE_S: f64 = 60.0;
/// Most cycles of a ripple over the range of temperatures of which fits start.
const MOST_CYCLES: f64 = 25.0;

impl Ranges {
    pub(crate) fn new(scene: &Scene, rate: f64, duration: f64, parts: [f64; 4]) -> Self {
        let temperatures = scene.temperatures;
        let far = temperatures.map(|t| (t - mechanisms::REFERENCE_C).abs()).into_iter().fold(1.0, f64::max);
        Self {
            temperatures,
            far,
            rate: rate.max(1e-9),
            duration: duration.max(1.0),
            parts: parts.map(|part| part.max(1e-12)),
            size: EXPECTED * scene.noise,
        }
    }

    /// An unknown time constant \[s\]: its prior has the middle between a minute and the longest record, in logarithms, and a quarter of the way between as its
    /// standard deviation. Beside it stand the starts of fits.
    pub(super) fn memory(&self) -> Beside {
        between(MINUTE_S, self.duration)
    }

    /// The same for a filter: between a minute and the middle of the former.
    pub(super) fn filter(&self) -> Beside {
        between(MINUTE_S, (MINUTE_S * self.duration).sqrt())
    }

    /// Range from the coldest to the hottest \[K\], a kelvin at least.
    pub(super) fn span(&self) -> f64 {
        let [low, high] = self.temperatures;
        (high - low).max(1.0)
    }

    /// Periods \[K\] that differ by a third of a cycle over the range, or somewhat more, from two cycles in it on: a fit finds the periods between them.
    pub(super) fn periods(&self) -> Vec<f64> {
        const STEPS: u32 = 49;
        let step = (MOST_CYCLES - 2.0) / f64::from(STEPS);
        (0..=STEPS).map(|k| self.span() / (2.0 + step * f64::from(k))).collect()
    }

    /// Temperatures over the range, not farther apart than these kelvin, or a fiftieth of it: each sees what lies half-way to the next.
    pub(super) fn every(&self, step: f64) -> Vec<f64> {
        self.across((self.span() / step).ceil().clamp(1.0, 50.0) as u32)
    }

    /// So many temperatures evenly over the range.
    pub(super) fn across(&self, count: u32) -> Vec<f64> {
        let [low, high] = self.temperatures;
        (0..count).map(|k| low + (high - low) * (f64::from(k) + 0.5) / f64::from(count)).collect()
    }
}

/// A time constant between two.
fn between(least: f64, most: f64) -> Beside {
    let (middle, spread) = ((least * most).sqrt(), (most / least).ln().max(1.0) / 4.0);
    let starts = [-1.0, 0.0, 1.0].map(|sd: f64| middle * (sd * spread).exp()).to_vec();
    ("tau", "s", format!("LogNormal({}, {})", two(middle), two(spread)), starts)
}

/// A law as a mechanism's file, and the known physics that has its form.
pub(crate) struct Law {
    pub(crate) text: String,
    pub(crate) known: &'static str,
}

/// A parameter beside the size: name, unit, prior, starts.
pub(super) type Beside = (&'static str, &'static str, String, Vec<f64>);

pub(super) struct Form<'a> {
    pub(super) id: String,
    pub(super) title: String,
    pub(super) known: &'static str,
    pub(super) stage: &'static str,
    /// largest value of the law at size 1 in its unit
    pub(super) per_size: f64,
    pub(super) unit: &'a str,
    pub(super) beside: Vec<Beside>,
    pub(super) states: String,
    pub(super) target: &'static str,
    pub(super) law: String,
}

/// Numbers of a prior, to two digits.
pub(super) fn two(x: f64) -> String {
    format!("{x:.1e}").parse::<f64>().map_or_else(|_| x.to_string(), |x| format!("{x:?}"))
}

impl Form<'_> {
    pub(super) fn law(&self, expected: f64) -> Law {
        let sd = two(expected / self.per_size);
        let mut parameters = format!("        (name: \"size\", unit: \"{}\", prior: Size({sd}), starts: [{sd}]),\n", self.unit);
        for (name, unit, prior, starts) in &self.beside {
            let starts: Vec<String> = starts.iter().map(|x| two(*x)).collect();
            let starts = starts.join(", ");
            let _ = writeln!(parameters, "        (name: \"{name}\", unit: \"{unit}\", prior: {prior}, starts: [{starts}]),");
        }
        let Self { id, title, stage, states, target, law, .. } = self;
        let states = if states.is_empty() { String::new() } else { format!("    states: [\n{states}    ],\n") };
        let text = format!(
            "(\n    id: \"{id}\",\n    title: \"{title}\",\n    stage: {stage},\n    meaning: \"a law of this form predicts the records; it names no \
             cause\",\n    inspection: \"seek the cause among the known physics of this form\",\n    source: \"composed by fogcoil diagnose; \
             known physics of this form: {}\",\n    parameters: [\n{parameters}    ],\n{states}    laws: [{target}(\"{law}\")],\n)\n",
            self.known
        );
        Law { text, known: self.known }
    }
}

/// A state that follows `of` with a time constant.
pub(super) fn lag(name: &str, of: &str, tau: &str) -> String {
    state(name, "degC", of, tau)
}

/// The same of any quantity.
pub(super) fn state(name: &str, unit: &str, of: &str, tau: &str) -> String {
    format!("        (name: \"{name}\", unit: \"{unit}\", goes: Rate(rate: \"({of} - {name}) / ({tau})\", first: \"{of}\")),\n")
}
