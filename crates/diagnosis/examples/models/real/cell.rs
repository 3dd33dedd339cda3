//! A cell in a chamber: one heat capacity, Newton's cooling, and the heat that current makes against its own open-circuit voltage (Bernardi et al. 1985,
//! its irreversible part).

use super::noise;
use super::plant::{Acts, Facts, Kind, Moment, Place, Plant, Quantity};
use diagnosis::{Channel, Nuisance, Parameter, Prior, Role};

/// A test of a cell.
#[derive(Debug, Clone)]
pub(crate) struct Test {
    pub(crate) time: Vec<f64>,
    /// Discharging is positive \[A\].
    pub(crate) current: Vec<f64>,
    pub(crate) voltage: Vec<f64>,
    /// \[°C\]
    pub(crate) surface: Vec<f64>,
    /// Open-circuit voltage at every state of charge, which rises.
    pub(crate) open_circuit: Vec<[f64; 2]>,
}

/// Last digit of the thermometer \[K\].
const DIGIT: f64 = 0.1;
/// Heat capacity of an 18650 cell: 45 g of 800 to 1100 J/(kg K); its logarithm's standard deviation is generous.
const HEAT_CAPACITY: Prior = Prior::LogNormal { median: 43.0, spread: 0.3 };
/// Loss to still or moved air: 5 to 50 W/(m² K) over 42 cm².
const LOSS: Prior = Prior::LogNormal { median: 0.07, spread: 0.7 };

const QUANTITIES: [Quantity; 4] = [
    Quantity { name: "the current", unit: "A", kind: Kind::Flow },
    Quantity { name: "the state of charge", unit: "1", kind: Kind::Level },
    Quantity { name: "the cell's temperature", unit: "degC", kind: Kind::Level },
    Quantity { name: "the time", unit: "s", kind: Kind::Time },
];
const PLACES: [Place; 3] = [
    Place { name: "the heat", unit: "W", own: Some(2), acts: Acts::Flow },
    Place { name: "the loss", unit: "W", own: Some(2), acts: Acts::Loss },
    Place { name: "the thermometer's reading", unit: "K", own: Some(2), acts: Acts::Reading(0) },
];

#[derive(Clone)]
pub(crate) struct Cell {
    tests: Vec<Test>,
    /// Of every test: the state of charge, and the heat against the open-circuit voltage \[W\].
    drives: Vec<(Vec<f64>, Vec<f64>)>,
    facts: Facts,
}

impl Cell {
    /// Tests of cells of a capacity \[Ah\], each full and as warm as its chamber at first; the noise is that of those that are fitted.
    pub(crate) fn new(tests: Vec<Test>, capacity: f64, fitted: &[usize]) -> Self {
        let known = || fitted.iter().map(|test| &tests[*test]);
        let duration = known().filter_map(|t| t.time.last()).copied().fold(f64::INFINITY, f64::min);
        let scatter: Vec<f64> = known().flat_map(|t| t.surface.iter().copied()).collect();
        let channel = Channel {
            name: "surface".into(),
            unit: "K".into(),
            offset: (0.0, f64::INFINITY),
            averaging: 0.0,
            noise: noise::of_record(&scatter, DIGIT, duration),
        };
        let constant =
            |name: &str, prior| Nuisance { parameter: Parameter::new(name, prior), role: Role::Constant, local: false };
        let drives = tests.iter().map(|test| drive(test, capacity)).collect();
        Self {
            tests,
            drives,
            facts: Facts {
                channels: vec![channel],
                nuisances: vec![constant("heat capacity J/K", HEAT_CAPACITY), constant("loss W/K", LOSS)],
                quantities: &QUANTITIES,
                places: &PLACES,
            },
        }
    }
}

fn drive(test: &Test, capacity: f64) -> (Vec<f64>, Vec<f64>) {
    let mut charge = 1.0;
    let mut socs = Vec::new();
    for n in 0..test.time.len() {
        let step = if n > 0 { test.time[n] - test.time[n - 1] } else { 0.0 };
        charge -= test.current[n] * step / 3600.0 / capacity;
        socs.push(charge);
    }
    let heat = |n: usize| test.current[n] * (between(&test.open_circuit, socs[n]) - test.voltage[n]);
    let heats = (0..test.time.len()).map(heat).collect();
    (socs, heats)
}

/// A piecewise linear function.
fn between(points: &[[f64; 2]], x: f64) -> f64 {
    let at = points.partition_point(|p| p[0] < x).clamp(1, points.len() - 1);
    let ([x0, y0], [x1, y1]) = (points[at - 1], points[at]);
    if x1 > x0 { y0 + (y1 - y0) * ((x - x0) / (x1 - x0)).clamp(0.0, 1.0) } else { y1 }
}

impl Plant for Cell {
    fn facts(&self) -> &Facts {
        &self.facts
    }

    fn time(&self, test: usize) -> &[f64] {
        &self.tests[test].time
    }

    fn run(&self, test: usize, constants: &[f64], laws: &mut dyn FnMut(Moment<'_>)) -> Vec<Vec<f64>> {
        let (own, (soc, heat)) = (&self.tests[test], &self.drives[test]);
        let (capacity, loss) = (constants[0], constants[1]);
        let chamber = own.surface[0];
        let mut t = chamber;
        let mut surface = Vec::with_capacity(soc.len());
        let mut flow = 0.0;
        for n in 0..soc.len() {
            let step = if n > 0 { own.time[n] - own.time[n - 1] } else { 0.0 };
            // what was made in the interval before this instant
            t += flow / loss * -(-step * loss / capacity).exp_m1();
            let nominal = loss * (t - chamber);
            let mut places = [heat[n], nominal, t];
            let quantities = [own.current[n], soc[n], t, own.time[n]];
            laws(Moment { step, quantities: &quantities, places: &mut places });
            flow = places[0] - places[1];
            surface.push(places[2]);
        }
        vec![surface]
    }
}
