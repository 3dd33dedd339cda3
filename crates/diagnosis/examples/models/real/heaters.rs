//! A board with two heaters, each with a thermometer: nominal are two separate lumps, each with its own heater and loss to the room.

use super::noise;
use super::plant::{Acts, Facts, Kind, Moment, Place, Plant, Quantity};
use diagnosis::{Channel, Nuisance, Parameter, Prior, Role};

/// A test of the board: powers of both heaters \[%\] and what both thermometers read \[°C\].
#[derive(Debug, Clone)]
pub(crate) struct Test {
    pub(crate) time: Vec<f64>,
    pub(crate) heaters: [Vec<f64>; 2],
    pub(crate) thermometers: [Vec<f64>; 2],
}

/// Last digit of the thermometers, as they are written \[K\].
const DIGIT: f64 = 0.03;
/// Possible error of a thermometer of 10 bits over 3.3 V at 10 mV/K \[K\].
const OFFSET: f64 = 0.32;
/// Power of each heater over its setting [W/%]: the makers of the board publish 1 W and 0.75 W at 100 % (APMonitor, temperature control lab, energy balance);
/// boards and supplies differ by a third or so.
const POWER: [Prior; 2] = [Prior::LogNormal { median: 0.01, spread: 0.3 }, Prior::LogNormal { median: 0.0075, spread: 0.3 }];
/// A transistor with its thermometer, by the same source: 4 g of 500 J/(kg K). Neither number is measured, so that a factor of two either way is likely.
const HEAT_CAPACITY: Prior = Prior::LogNormal { median: 2.0, spread: 0.7 };
/// Loss to still air, by the same source 10 W/(m2 K) over 10 cm2; fits of such boards give 4 to 5 by convection, to which radiation at an emissivity of 0.9
/// adds 5.5: a factor of two either way.
const LOSS: Prior = Prior::LogNormal { median: 0.01, spread: 0.7 };

const QUANTITIES: [Quantity; 5] = [
    Quantity { name: "heater 1", unit: "%", kind: Kind::Flow },
    Quantity { name: "heater 2", unit: "%", kind: Kind::Flow },
    Quantity { name: "temperature 1", unit: "degC", kind: Kind::Level },
    Quantity { name: "temperature 2", unit: "degC", kind: Kind::Level },
    Quantity { name: "the time", unit: "s", kind: Kind::Time },
];
const PLACES: [Place; 6] = [
    Place { name: "heat 1", unit: "W", own: Some(2), acts: Acts::Flow },
    Place { name: "heat 2", unit: "W", own: Some(3), acts: Acts::Flow },
    Place { name: "loss 1", unit: "W", own: Some(2), acts: Acts::Loss },
    Place { name: "loss 2", unit: "W", own: Some(3), acts: Acts::Loss },
    Place { name: "reading 1", unit: "K", own: Some(2), acts: Acts::Reading(0) },
    Place { name: "reading 2", unit: "K", own: Some(3), acts: Acts::Reading(1) },
];

#[derive(Clone)]
pub(crate) struct Heaters {
    tests: Vec<Test>,
    facts: Facts,
}

impl Heaters {
    /// Tests of one board that begin at the room's temperature; the first rows of the first are fitted.
    pub(crate) fn new(tests: Vec<Test>, fitted: usize) -> Self {
        let duration = tests[0].time[fitted - 1];
        let channel = |k: usize| Channel {
            name: format!("temperature {}", k + 1),
            unit: "K".into(),
            offset: (0.0, OFFSET),
            averaging: 0.0,
            noise: noise::of_record(&tests[0].thermometers[k][..fitted], DIGIT, duration),
        };
        let constant =
            |name: &str, prior| Nuisance { parameter: Parameter::new(name, prior), role: Role::Constant, local: false };
        let nuisances = vec![
            constant("power 1 W/%", POWER[0]),
            constant("power 2 W/%", POWER[1]),
            constant("heat capacity 1 J/K", HEAT_CAPACITY),
            constant("heat capacity 2 J/K", HEAT_CAPACITY),
            constant("loss 1 W/K", LOSS),
            constant("loss 2 W/K", LOSS),
        ];
        let facts = Facts { channels: [0, 1].map(channel).to_vec(), nuisances, quantities: &QUANTITIES, places: &PLACES };
        Self { facts, tests }
    }
}

impl Plant for Heaters {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn time(&self, test: usize) -> &[f64] {
        &self.tests[test].time
    }

    fn run(&self, test: usize, constants: &[f64], laws: &mut dyn FnMut(Moment<'_>)) -> Vec<Vec<f64>> {
        let own = &self.tests[test];
        let of = |k: usize| (constants[k], constants[2 + k], constants[4 + k]);
        let room = [0, 1].map(|k| own.thermometers[k][0]);
        let (mut t, mut flow) = (room, [0.0; 2]);
        let mut read = vec![Vec::new(); 2];
        for n in 0..own.time.len() {
            let step = if n > 0 { own.time[n] - own.time[n - 1] } else { 0.0 };
            for k in 0..2 {
                let (_, capacity, loss) = of(k);
                t[k] += flow[k] / loss * -(-step * loss / capacity).exp_m1();
            }
            let heat = |k: usize| of(k).0 * own.heaters[k][n];
            let off = |k: usize| of(k).2 * (t[k] - room[k]);
            let mut places = [heat(0), heat(1), off(0), off(1), t[0], t[1]];
            let quantities = [own.heaters[0][n], own.heaters[1][n], t[0], t[1], own.time[n]];
            laws(Moment { step, quantities: &quantities, places: &mut places });
            flow = [places[0] - places[2], places[1] - places[3]];
            read[0].push(places[4]);
            read[1].push(places[5]);
        }
        read
    }
}
