//! One axis of a closed-loop fibre-optic gyroscope at rest: nominal is a constant rate under white noise. Its feedback is a serrodyne ramp that is reset at
//! every 2π of phase (Lefèvre 2014), and ramps of the other axes run beside it.

use super::noise;
use super::plant::{Acts, Facts, Kind, Moment, Place, Plant, Quantity};
use diagnosis::Channel;

const QUANTITIES: [Quantity; 4] = [
    Quantity { name: "ramp 1", unit: "cycle", kind: Kind::Phase },
    Quantity { name: "ramp 2", unit: "cycle", kind: Kind::Phase },
    Quantity { name: "ramp 3", unit: "cycle", kind: Kind::Phase },
    Quantity { name: "the time", unit: "s", kind: Kind::Time },
];
const PLACES: [Place; 1] = [Place { name: "the rate that is read", unit: "nrad/s", own: None, acts: Acts::Reading(0) }];

#[derive(Clone)]
pub(crate) struct Ramp {
    time: Vec<f64>,
    /// \[cycle\]
    ramps: [Vec<f64>; 3],
    facts: Facts,
}

impl Ramp {
    /// An axis' rate \[nrad/s\] in the rows that are fitted, with the ramps of all axes, in cycles.
    pub(crate) fn new(time: Vec<f64>, ramps: [Vec<f64>; 3], rate: &[f64]) -> Self {
        let noise = noise::of_record(rate, 0.0, time[rate.len() - 1]);
        let spread = super::offered::spread(rate.iter().copied());
        let mean = rate.iter().sum::<f64>() / rate.len() as f64;
        // the rate is the Earth's about an axis of unknown direction
        let offset = (mean, 100.0 * spread);
        let channel = Channel { name: "rate".into(), unit: "nrad/s".into(), offset, averaging: 0.0, noise };
        let facts = Facts { channels: vec![channel], nuisances: Vec::new(), quantities: &QUANTITIES, places: &PLACES };
        Self { time, ramps, facts }
    }
}

impl Plant for Ramp {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn time(&self, _: usize) -> &[f64] {
        &self.time
    }

    fn run(&self, _: usize, _: &[f64], laws: &mut dyn FnMut(Moment<'_>)) -> Vec<Vec<f64>> {
        let mut rate = Vec::with_capacity(self.time.len());
        for n in 0..self.time.len() {
            let step = if n > 0 { self.time[n] - self.time[n - 1] } else { 0.0 };
            let [a, b, c] = [0, 1, 2].map(|k| self.ramps[k][n]);
            let mut places = [0.0];
            laws(Moment { step, quantities: &[a, b, c, self.time[n]], places: &mut places });
            rate.push(places[0]);
        }
        vec![rate]
    }
}
