//! A library's responses to the chamber of one recording.

use crate::library::{Functionals, Library};
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Bonds, Error, Output, Profile, Reduced};
use diagnosis::State;
use nalgebra::DMatrix;

/// Mean bias parts in every row \[deg/h\]: Shupe, elasto-optic axial and radial.
pub type Parts = [Vec<f64>; 3];

/// Rows that end this much later than the averaging span after the row before are gaps \[spans\].
const GAP: f64 = 1.5;
/// Relative change of the first chamber temperature for the effect of an unsettled start \[K\].
const OFF_REST: f64 = 1.0;

/// Instants of a recording and those before them at which a reading that follows a gap begins.
#[derive(Debug, Clone)]
pub(crate) struct Clock {
    pub(crate) time: Vec<f64>,
    pub(crate) chamber: Vec<f64>,
    /// place of each row of the recording
    pub(crate) rows: Vec<usize>,
    /// whether a reading begins at an instant that is not a row's
    begins: Vec<bool>,
}

/// Parts into which an interval is divided to follow the chamber between its readings.
const BETWEEN: usize = 4;

impl Clock {
    /// Between readings the chamber is smooth ([`Profile::smoothed`]), without corners. After a gap one begins `averaging` seconds before.
    pub(crate) fn new(time: &[f64], chamber: &[f64], averaging: f64) -> Self {
        let (mut t, mut c) = (Vec::with_capacity(time.len()), Vec::with_capacity(time.len()));
        let (mut rows, mut starts) = (Vec::with_capacity(time.len()), Vec::new());
        for n in 0..time.len() {
            let dt = if n > 0 { time[n] - time[n - 1] } else { 0.0 };
            if averaging > 0.0 && dt > GAP * averaging {
                starts.push(t.len() * BETWEEN);
                t.push(time[n] - averaging);
                c.push(chamber[n] - (chamber[n] - chamber[n - 1]) * averaging / dt);
            }
            rows.push(t.len() * BETWEEN);
            t.push(time[n]);
            c.push(chamber[n]);
        }
        let Profile { time, mut drives } = Profile { time: t, drives: vec![c] }.smoothed(BETWEEN);
        let mut begins = vec![false; time.len()];
        starts.into_iter().for_each(|n| begins[n] = true);
        Self { time, chamber: drives.swap_remove(0), rows, begins }
    }

    /// Means over the reading of each row of something that is a mean since the instant before.
    fn means(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let (mut sum, mut span, mut row) = (0.0, 0.0, 0);
        let mut means = Vec::with_capacity(self.rows.len());
        for n in 0..self.time.len() {
            let dt = if n > 0 { self.time[n] - self.time[n - 1] } else { 0.0 };
            sum += value(n) * dt;
            span += dt;
            if self.rows.get(row) == Some(&n) {
                means.push(if span > 0.0 { sum / span } else { 0.0 });
                row += 1;
                (sum, span) = (0.0, 0.0);
            } else if self.begins[n] {
                (sum, span) = (0.0, 0.0);
            }
        }
        means
    }
}

/// Thermometer and bias parts of one model in the rows of a recording.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(crate) sensor: Vec<f64>,
    pub(crate) parts: Parts,
}

/// Drives and modes of one reduced model in the rows of a recording, and their mean rates.
#[derive(Debug, Clone)]
pub(crate) struct Course {
    /// rows × (drives + modes)
    pub(crate) states: DMatrix<f64>,
    pub(crate) rates: DMatrix<f64>,
}

impl Course {
    /// Runs `drives` from rest at `rest`; both in the order of the model's drives.
    pub(crate) fn new(model: &Reduced, clock: &Clock, drives: &[Vec<f64>], rest: &[f64]) -> Self {
        let mut steps = model.steps(&clock.time, drives, rest);
        // where the reading of the row began
        let (mut began, mut before) = (0, steps.state().vector());
        let mut states = DMatrix::zeros(clock.rows.len(), before.len());
        let (mut rates, mut row) = (states.clone(), 0);
        for n in 0..clock.time.len() {
            if n > 0 {
                steps.next();
            }
            let now = steps.state().vector();
            if clock.rows.get(row) == Some(&n) {
                states.set_row(row, &now.transpose());
                if n > 0 {
                    rates.set_row(row, &((&now - before) / (clock.time[n] - clock.time[began])).transpose());
                }
                row += 1;
                (began, before) = (n, now);
            } else if clock.begins[n] {
                (began, before) = (n, now);
            }
        }
        Self { states, rates }
    }

    pub(crate) fn output(&self, output: &Output) -> Vec<f64> {
        (&self.states * output.vector()).as_slice().to_vec()
    }

    /// Mean bias parts in every row.
    pub(crate) fn parts(&self, functionals: &Functionals) -> Parts {
        [0, 1, 2].map(|p: usize| (&self.rates * (&functionals[p] * DEG_PER_H_PER_RAD_PER_S)).as_slice().to_vec())
    }

    fn series(&self, model: &Reduced) -> Series {
        Series { sensor: self.output(model.thermometer()), parts: self.parts(&model.parts().each_ref().map(Output::vector)) }
    }
}

fn minus(a: &Series, b: &Series) -> Series {
    Series { sensor: less(&a.sensor, &b.sensor), parts: difference(&a.parts, &b.parts) }
}

fn difference(a: &Parts, b: &Parts) -> Parts {
    [0, 1, 2].map(|p: usize| less(&a[p], &b[p]))
}

fn less(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// A recording's instants and chamber, and what every model of a library does under it.
#[derive(Debug, Clone)]
pub struct Prepared {
    pub(crate) time: Vec<f64>,
    /// freed of its sensor's noise \[°C\]
    pub(crate) chamber: Vec<f64>,
    pub(crate) averaging: f64,
    pub(crate) course: Course,
    pub(crate) nominal: Series,
    /// mean temperature of the coil \[°C\]
    pub(crate) coil: Vec<f64>,
    pub(crate) state: State,
    /// change per kelvin that the start was off the first chamber temperature
    pub(crate) off_rest: Series,
    /// parts at each node of the transverse modulus, with the nominal α_r and per unit of its factor
    pub(crate) modulus: Vec<(f64, Parts, Parts)>,
    pub(crate) constants: Vec<Parts>,
    /// changes at every node of each mechanism's path, zero at the nominal one
    pub(crate) paths: Vec<(String, Vec<f64>, Vec<Series>)>,
    /// open minus closed
    pub(crate) openings: Vec<(f64, Parts)>,
    pub(crate) heater: Option<Heating>,
}

/// A watt in a flange that is switched on some time before the first row: every mode decays on its own.
#[derive(Debug, Clone)]
pub(crate) struct Heating {
    /// amplitude of every mode in every row, switched on at the first, and its mean rate; the rates of the first row are not used
    course: Course,
    averaging: f64,
}

impl Heating {
    fn new(model: &Reduced, clock: &Clock, averaging: f64) -> Self {
        let n = clock.time.len();
        Self { course: Course::new(model, clock, &[vec![0.0; n], vec![1.0; n]], &[0.0, 0.0]), averaging }
    }

    /// Response to 1 W that is switched on `before` the first row \[s\].
    pub(crate) fn at(&self, model: &Reduced, before: f64) -> Series {
        let mut course = self.course.clone();
        let drives = course.states.ncols() - model.rates().len();
        for (i, rate) in model.rates().iter().enumerate() {
            let (k, decayed) = (drives + i, (-rate * before).exp());
            // the first reading began before its row, but sees nothing from before the heater was on
            let began = course.states[(0, k)] * (-rate * (before - self.averaging).max(0.0)).exp();
            course.states.column_mut(k).scale_mut(decayed);
            course.rates.column_mut(k).scale_mut(decayed);
            course.rates[(0, k)] = if self.averaging > 0.0 { (course.states[(0, k)] - began) / self.averaging } else { 0.0 };
        }
        course.series(model)
    }
}

impl Prepared {
    /// Instants \[s\].
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Temperature of the chamber in every row, freed of its sensor's noise \[°C\].
    pub fn chamber(&self) -> &[f64] {
        &self.chamber
    }

    /// Mean temperature of the coil as designed in every row \[°C\].
    pub fn coil(&self) -> &[f64] {
        &self.coil
    }

    /// Temperature of the spool's thermometer as designed in every row \[°C\].
    pub fn spool(&self) -> &[f64] {
        &self.nominal.sensor
    }

    /// Bias parts as designed in every row \[deg/h\].
    pub fn parts(&self) -> &Parts {
        &self.nominal.parts
    }

    /// Runs every model of `library` under a recorded chamber temperature \[°C\], first freed of its sensor's noise
    /// ([`recording::smooth`]): passed through the model, that noise would be correlated with every mechanism. Readings of the rate are means
    /// over `averaging` seconds, or since the row before where that is nearer.
    ///
    /// # Errors
    /// [`Error::Profile`] names the instant that is out of order or not finite.
    pub fn new(library: &Library, time: &[f64], chamber: &[f64], averaging: f64) -> Result<Self, Error> {
        // what is too short or out of order is left to the simulation, which says so
        let smooth = recording::smooth::smoothed(time, chamber);
        let clock = Clock::new(time, smooth.as_ref().map_or(chamber, |s| &s.values), averaging);
        let profile = Profile { time: clock.time.clone(), drives: vec![clock.chamber.clone()] };
        let responses = library.nominal.simulate(&profile)?;
        let first = clock.chamber[0];
        let run = |model: &Reduced| Course::new(model, &clock, std::slice::from_ref(&clock.chamber), &[first]);
        let course = run(&library.base);
        let base = course.series(&library.base);
        let part = |f: fn(&bias::Bias) -> f64| -> Vec<f64> { clock.means(|n| f(&responses[n].bias) * DEG_PER_H_PER_RAD_PER_S) };
        let nominal = Series {
            sensor: clock.rows.iter().map(|&n| responses[n].sensor).collect(),
            parts: [part(|b| b.shupe), part(|b| b.eo_axial), part(|b| b.eo_radial)],
        };
        let off = Course::new(&library.base, &clock, std::slice::from_ref(&clock.chamber), &[first + OFF_REST]);
        let paths = library.paths.iter().map(|path| {
            let mut changes: Vec<Series> = path.models.iter().map(|model| minus(&run(model).series(model), &base)).collect();
            changes.insert(path.nominal, minus(&base, &base));
            (path.id.clone(), path.nodes.clone(), changes)
        });
        let opening = |(share, model): &(f64, Reduced)| {
            let course = run(model);
            let parts = |bond| course.parts(&model.parts_with(bond).each_ref().map(Output::vector));
            (*share, difference(&parts(Bonds::Opened), &parts(Bonds::Closed)))
        };
        let heater = library.heater.as_ref().map(|model| Heating::new(model, &clock, averaging));
        let coil = course.output(library.base.coil_mean());
        let level = nominal.sensor.clone();
        let rate = recording::condition::slopes(time, &level);
        Ok(Self {
            time: time.to_vec(),
            chamber: clock.rows.iter().map(|&n| clock.chamber[n]).collect(),
            averaging,
            off_rest: minus(&off.series(&library.base), &base),
            modulus: library.modulus.iter().map(|(x, n, f)| (*x, course.parts(n), course.parts(f))).collect(),
            constants: library.constants.iter().map(|f| course.parts(f)).collect(),
            paths: paths.collect(),
            openings: library.openings.iter().map(opening).collect(),
            heater,
            course,
            nominal,
            coil,
            state: State { level, rate },
        })
    }
}
