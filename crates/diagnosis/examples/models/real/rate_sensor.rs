//! A rate sensor at rest beside its own thermometer: nominal is a rate that is constant, or a polynomial of the temperature as calibrations have it.

use super::noise;
use super::offered::spread;
use super::plant::{Acts, Facts, Kind, Moment, Place, Plant, Quantity};
use diagnosis::{Channel, Nuisance, Parameter, Prior, Role};

const QUANTITIES: [Quantity; 2] = [
    Quantity { name: "the temperature", unit: "degC", kind: Kind::Level },
    Quantity { name: "the time", unit: "s", kind: Kind::Time },
];
const PLACES: [Place; 1] = [Place { name: "the rate that is read", unit: "rad/s", own: Some(0), acts: Acts::Reading(0) }];
const TERMS: [&str; 3] = ["linear rad/s", "quadratic rad/s", "cubic rad/s"];
/// Room temperature, about which polynomials are told \[°C\], and the range over which such sensors work, either way \[K\].
const MIDDLE_C: f64 = 25.0;
const RANGE_K: f64 = 60.0;

#[derive(Clone)]
pub(crate) struct RateSensor {
    /// Instants [s] and temperatures [degC] of every test.
    tests: Vec<(Vec<f64>, Vec<f64>)>,
    facts: Facts,
}

impl RateSensor {
    /// A rate \[rad/s\] over temperature \[°C\], of which the first `fitted` rows are fitted; `degree` of the nominal polynomial, at most 3.
    pub(crate) fn new(time: Vec<f64>, temperature: Vec<f64>, rate: &[f64], fitted: usize, degree: usize) -> Self {
        let known = &rate[..fitted];
        let duration = time[fitted - 1] - time[0];
        let size = spread(known.iter().copied());
        let mean = known.iter().sum::<f64>() / fitted as f64;
        let channel = Channel {
            name: "rate".into(),
            unit: "rad/s".into(),
            offset: (mean, 10.0 * size),
            averaging: 0.0,
            noise: noise::of_record(known, 0.0, duration),
        };
        // a term over the sensor's whole range may be several times what the record shows
        let prior = Prior::Normal { mean: 0.0, sd: 10.0 * size };
        let term = |name: &&str| Nuisance { parameter: Parameter::new(*name, prior), role: Role::Constant, local: false };
        let nuisances = TERMS[..degree].iter().map(term).collect();
        let facts = Facts { channels: vec![channel], nuisances, quantities: &QUANTITIES, places: &PLACES };
        Self { tests: vec![(time, temperature)], facts }
    }

    /// The same with a test that may be made.
    pub(crate) fn with_test(mut self, time: Vec<f64>, temperature: Vec<f64>) -> Self {
        self.tests.push((time, temperature));
        self
    }
}

impl Plant for RateSensor {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn time(&self, test: usize) -> &[f64] {
        &self.tests[test].0
    }

    fn run(&self, test: usize, constants: &[f64], laws: &mut dyn FnMut(Moment<'_>)) -> Vec<Vec<f64>> {
        let (time, temperature) = &self.tests[test];
        let mut rate = Vec::with_capacity(time.len());
        for n in 0..time.len() {
            let step = if n > 0 { time[n] - time[n - 1] } else { 0.0 };
            let x = (temperature[n] - MIDDLE_C) / RANGE_K;
            let mut places = [constants.iter().rev().fold(0.0, |sum, term| x * (sum + term))];
            laws(Moment { step, quantities: &[temperature[n], time[n]], places: &mut places });
            rate.push(places[0]);
        }
        vec![rate]
    }
}
