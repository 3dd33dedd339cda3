//! The coil's chain as a forward model for diagnosis: nominal constants, their uncertainties, and the library of mechanisms.

use crate::catalogue::{Law, entries};
use crate::laws::{Change, Laws, add, lagged, share};
use crate::library::{Library, Path};
use crate::nuisances::{self, channels, nuisances};
use crate::record::{Parts, Prepared};
use coil::Error;
use diagnosis::{Active, Channel, ForwardModel, Latent, Mechanism, Nuisance, State};
use std::cell::RefCell;
use std::sync::Arc;

/// Temperature at which ∂n/∂T has its nominal value, and at which a read-out's temperature coefficient is zero \[°C\].
pub const REFERENCE_C: f64 = 20.0;

/// Order of the channels.
pub const SPOOL: usize = 0;
/// Order of the channels.
pub const RATE: usize = 1;

/// Where a mechanism acts; `None` where the question makes no sense.
#[derive(Debug, Clone, PartialEq)]
pub struct Located {
    /// Part of the chain.
    pub stage: String,
    /// Temperatures of the coil \[°C\].
    pub temperature: Option<[f64; 2]>,
    /// Instants \[s\].
    pub time: Option<[f64; 2]>,
    /// Layers, 1 = innermost.
    pub layers: Option<[usize; 2]>,
}

/// A design's library and the recordings it is compared with.
pub struct Gyro {
    laws: Laws,
    records: Vec<Prepared>,
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    kinds: Vec<Law>,
    mechanisms: Vec<Mechanism>,
    /// the last changes that were worked out, by record and mechanism
    known: RefCell<Vec<(usize, Active, Arc<Change>)>>,
}

/// Share of its final rise at which a heated unit has settled.
const RISEN: f64 = 0.95;
/// Changes that are kept.
const KEPT: usize = 12;

impl Gyro {
    /// A forward model of `records`, each prepared by [`Prepared::new`].
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn new(library: Library, records: Vec<Prepared>) -> Result<Self, Error> {
        let all = records.len();
        Self::fitted_to(library, records, all)
    }

    /// The same where only the first `fitted` of the records are fitted: the others' temperatures say nothing beforehand.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn fitted_to(library: Library, records: Vec<Prepared>, fitted: usize) -> Result<Self, Error> {
        let temperatures = || records.iter().take(fitted).flat_map(|r| r.coil.iter().copied());
        let range = [temperatures().fold(f64::INFINITY, f64::min), temperatures().fold(f64::NEG_INFINITY, f64::max)];
        let (kinds, mechanisms) = entries(&library, range).into_iter().unzip();
        let averaging = records.first().map_or(0.0, |r| r.averaging);
        Ok(Self {
            laws: Laws::new(library)?,
            records,
            channels: channels(averaging),
            nuisances: nuisances(),
            kinds,
            mechanisms,
            known: RefCell::default(),
        })
    }

    /// The design.
    pub fn library(&self) -> &Library {
        &self.laws.library
    }

    /// Number of a mechanism by its id.
    pub fn find(&self, id: &str) -> Option<usize> {
        self.mechanisms.iter().position(|m| m.id == id)
    }

    /// Where a mechanism acts; `layers` are those that are not excluded, where it acts on one of them.
    pub fn located(&self, active: &Active, layers: Option<[f64; 2]>) -> Located {
        let v = &active.values;
        let none =
            Located { stage: self.mechanisms[active.mechanism].stage.clone(), temperature: None, time: None, layers: None };
        match self.kinds[active.mechanism] {
            // nearly nine tenths of a logistic step lie within two widths
            Law::GlassTransition => Located { temperature: Some([v[0] - 2.0 * v[1], v[0] + 2.0 * v[1]]), ..none },
            Law::Debond => Located { temperature: Some([v[0], v[0] + v[1]]), ..none },
            // a layer among all is not located
            Law::Defect => {
                let half = self.laws.library.design().winding.layers as f64 / 2.0;
                let few = layers.filter(|[first, last]| last - first < half);
                Located { layers: few.map(|ends| ends.map(|layer| layer as usize)), ..none }
            }
            Law::SelfHeating => Located { time: self.heating(active), ..none },
            _ => none,
        }
    }

    /// From the switch-on until the thermometer has risen by nearly all that it ever will in the first record.
    fn heating(&self, active: &Active) -> Option<[f64; 2]> {
        let record = self.records.first()?;
        let change = self.change(0, active).ok()?;
        let rise = change.sensor.as_ref()?;
        let settled = RISEN * rise.last()?;
        let at = rise.iter().position(|r| r.abs() >= settled.abs())?;
        Some([record.time[0], record.time[at]])
    }

    /// Parts and thermometer of the nominal model with its uncertain numbers at `u`.
    fn recalibrated(&self, record: &Prepared, u: &[f64]) -> (Parts, Vec<f64>) {
        let (mut parts, mut sensor) = (record.nominal.parts.clone(), record.nominal.sensor.clone());
        for (k, of) in record.constants.iter().enumerate() {
            let by = u[nuisances::LINEAR + k] - 1.0;
            (0..3).filter(|_| by != 0.0).for_each(|p| add(&mut parts[p], &of[p], by));
        }
        let thermo_optic = {
            let o = &self.laws.library.design().optics;
            let (a, b) = (o.thermo_optic, o.refractive_index * o.thermal_expansion);
            (a * u[nuisances::THERMO_OPTIC] + b) / (a + b)
        };
        let shupe = thermo_optic * u[nuisances::SHUPE];
        parts[0].iter_mut().for_each(|s| *s *= shupe);
        let mut change = |of: &Parts, thermometer: Option<&Vec<f64>>, factor: f64| {
            parts.iter_mut().zip(of).for_each(|(part, change)| add(part, change, factor));
            if let Some(thermometer) = thermometer {
                add(&mut sensor, thermometer, factor);
            }
        };
        change(&record.off_rest.parts, Some(&record.off_rest.sensor), u[nuisances::REST]);
        let (modulus, alpha) = (u[nuisances::MODULUS], u[nuisances::ALPHA_R]);
        if (modulus != 1.0 || alpha != 1.0) && !record.modulus.is_empty() {
            change(&self.laws.softened(record, |_| (modulus, alpha)), None, 1.0);
        }
        let air = u[nuisances::AIR] * u[nuisances::CONDUCTIVITY];
        if air != 1.0 {
            let path = self.laws.path(record, Path::Air, air);
            change(&path.parts, path.sensor.as_ref(), 1.0);
        }
        (parts, sensor)
    }

    /// What a mechanism changes in the chain up to the optics; kept for as long as other unknowns are varied.
    fn change(&self, record: usize, active: &Active) -> Result<Arc<Change>, Error> {
        let mut known = self.known.borrow_mut();
        if let Some((.., change)) = known.iter().find(|(r, a, _)| *r == record && a == active) {
            return Ok(Arc::clone(change));
        }
        let prepared = &self.records[record];
        let mut change = self.laws.change(prepared, self.kinds[active.mechanism], active)?;
        change.gain = [0, 1, 2].map(|p: usize| share(&change.parts[p], &prepared.nominal.parts[p]));
        let change = Arc::new(change);
        if known.len() == KEPT {
            known.remove(0);
        }
        known.push((record, active.clone(), Arc::clone(&change)));
        Ok(change)
    }
}

impl ForwardModel for Gyro {
    type Error = Error;

    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Mechanism] {
        &self.mechanisms
    }

    fn respond(&self, record: usize, u: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Error> {
        let number = record;
        let record = &self.records[number];
        let nominal = &record.nominal.parts;
        let (mut parts, mut sensor) = self.recalibrated(record, u);
        let changes = active.iter().map(|a| self.change(number, a)).collect::<Result<Vec<_>, _>>()?;
        // mechanisms act on a coil that has the others: each one's gain on a part acts on the others' changes, too
        let mut gain: [f64; 3] = [0, 1, 2].map(|p: usize| share(&parts[p], &nominal[p]));
        for change in &changes {
            for p in 0..3 {
                let (own, scaled) = (change.gain[p], gain[p]);
                // what was there grows by this one's gain; what this adds beyond its gain grows by what was there
                for ((part, changed), nominal) in parts[p].iter_mut().zip(&change.parts[p]).zip(&nominal[p]) {
                    *part += own * *part + scaled * (changed - own * nominal);
                }
                gain[p] *= 1.0 + own;
            }
            if let Some(s) = &change.sensor {
                add(&mut sensor, s, 1.0);
            }
        }
        let mut rate: Vec<f64> =
            (0..sensor.len()).map(|n| u[nuisances::GAIN] * (parts[0][n] + parts[1][n] + parts[2][n])).collect();
        for added in changes.iter().filter_map(|c| c.rate.as_ref()) {
            add(&mut rate, added, 1.0);
        }
        for active in active {
            match self.kinds[active.mechanism] {
                Law::ReadOut => {
                    for (n, rate) in rate.iter_mut().enumerate() {
                        *rate += active.values[0] * ((sensor[n] + sensor[n.saturating_sub(1)]) / 2.0 - REFERENCE_C);
                    }
                }
                Law::SensorLag => sensor = lagged(&record.time, &sensor, active.values[0]),
                _ => {}
            }
        }
        Ok(vec![sensor, rate])
    }

    fn latent(&self, record: usize) -> Result<Vec<Latent>, Error> {
        self.laws.latent(&self.records[record])
    }

    /// The layers, innermost first, with one turn more.
    fn members(&self, record: usize) -> Result<Option<Latent>, Error> {
        self.laws.layers(&self.records[record]).map(Some)
    }

    fn state(&self, record: usize) -> &State {
        &self.records[record].state
    }
}
