//! Two tanks, one above the other: a pump fills the upper one, it drains into the lower one, the lower one into a basin; the lower level is read. Nominal is
//! Bernoulli's law.

use super::noise;
use super::plant::{Acts, Facts, Kind, Moment, Place, Plant, Quantity};
use diagnosis::{Channel, Nuisance, Parameter, Prior, Role};

/// Input of the pump \[V\], held for a step \[s\], and the lower level \[V\].
#[derive(Debug, Clone)]
pub(crate) struct Feed {
    pub(crate) time: Vec<f64>,
    pub(crate) pump: Vec<f64>,
    pub(crate) lower: Vec<f64>,
}

/// Parts of an interval in which the levels are integrated.
pub(crate) const PARTS: usize = 4;
const QUANTITIES: [Quantity; 4] = [
    Quantity { name: "the pump's voltage", unit: "V", kind: Kind::Flow },
    Quantity { name: "the upper level", unit: "V", kind: Kind::Level },
    Quantity { name: "the lower level", unit: "V", kind: Kind::Level },
    Quantity { name: "the time", unit: "s", kind: Kind::Time },
];
const PLACES: [Place; 5] = [
    Place { name: "the flow into the upper tank", unit: "V/s", own: Some(1), acts: Acts::Flow },
    Place { name: "the flow into the lower tank", unit: "V/s", own: Some(2), acts: Acts::Flow },
    Place { name: "the outflow of the upper tank", unit: "V/s", own: Some(1), acts: Acts::Loss },
    Place { name: "the outflow of the lower tank", unit: "V/s", own: Some(2), acts: Acts::Loss },
    Place { name: "the level that is read", unit: "V", own: Some(2), acts: Acts::Reading(0) },
];

#[derive(Clone)]
pub(crate) struct Cascade {
    feeds: Vec<Feed>,
    facts: Facts,
}

impl Cascade {
    pub(crate) fn new(feeds: Vec<Feed>) -> Self {
        let duration = feeds[0].time.last().copied().unwrap_or(1.0);
        // the level is known to what the sensor's zero is off: some hundredths of its 10 V
        let channel = Channel {
            name: "lower level".into(),
            unit: "V".into(),
            offset: (0.0, 0.3),
            averaging: 0.0,
            noise: noise::of_record(&feeds[0].lower, 0.0, duration),
        };
        // orders of magnitude: tanks that fill in some minutes
        let unknown = |name: &str, median: f64| Nuisance {
            parameter: Parameter::new(name, Prior::LogNormal { median, spread: 0.7 }),
            role: Role::Constant,
            local: false,
        };
        let nuisances = vec![
            unknown("drain of the upper tank", 0.05),
            unknown("inflow of the lower tank", 0.05),
            unknown("drain of the lower tank", 0.05),
            unknown("gain of the pump", 0.05),
            unknown("upper level at the start V", 4.0),
            Nuisance::normal("level at which the sensor reads zero V", 0.0, 1.0, Role::Sensor),
        ];
        Self { feeds, facts: Facts { channels: vec![channel], nuisances, quantities: &QUANTITIES, places: &PLACES } }
    }
}

impl Plant for Cascade {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn time(&self, test: usize) -> &[f64] {
        &self.feeds[test].time
    }

    fn run(&self, test: usize, constants: &[f64], laws: &mut dyn FnMut(Moment<'_>)) -> Vec<Vec<f64>> {
        let feed = &self.feeds[test];
        let [drain_upper, inflow, drain_lower, gain, start, zero] = [0, 1, 2, 3, 4, 5].map(|k: usize| constants[k]);
        let (mut upper, mut lower) = (start, feed.lower[0] + zero);
        let mut read = Vec::with_capacity(feed.time.len());
        for n in 0..feed.time.len() {
            let whole = if n + 1 < feed.time.len() { feed.time[n + 1] - feed.time[n] } else { 0.0 };
            let step = whole / PARTS as f64;
            for part in 0..PARTS {
                let (above, below) = (upper.max(0.0).sqrt(), lower.max(0.0).sqrt());
                let mut places = [gain * feed.pump[n], 0.0, drain_upper * above, drain_lower * below, lower - zero];
                let quantities = [feed.pump[n], upper, lower, feed.time[n] + part as f64 * step];
                laws(Moment { step, quantities: &quantities, places: &mut places });
                if part == 0 {
                    read.push(places[4]);
                }
                // what leaves the upper tank enters the lower one
                lower = (lower + step * (places[1] + places[2] * inflow / drain_upper - places[3])).max(0.0);
                upper = (upper + step * (places[0] - places[2])).max(0.0);
            }
        }
        vec![read]
    }
}
