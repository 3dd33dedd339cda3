//! The coil's chain as a forward model for diagnosis: nominal constants, their uncertainties, and the library of mechanisms.

use crate::catalogue::air_path;
use crate::chain::{Chain, add};
use crate::library::Library;
use crate::mechanism::{Change, Effect, Extent, Mechanism, Naming, Offer, Readings, Sight};
use crate::nuisances::{self, channels, nuisances};
use crate::response::{Parts, Prepared};
use coil::{Design, Error};
use diagnosis::{Active, Channel, ForwardModel, Latent, Nuisance, State};
use std::cell::RefCell;
use std::sync::Arc;

/// Order of the channels.
pub const SPOOL: usize = 0;
/// Order of the channels.
pub const RATE: usize = 1;

/// A design's library and the recordings it is compared with.
pub struct Gyro<'m> {
    chain: Chain,
    records: Vec<Prepared>,
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    kinds: Vec<&'m dyn Mechanism>,
    mechanisms: Vec<diagnosis::Omission>,
    /// the last effects that were worked out, by record and mechanism
    known: RefCell<Vec<(usize, Active, Arc<Known>)>>,
}

/// An effect, and what share of every nominal part is in its change of that part.
struct Known {
    effect: Effect,
    gain: [f64; 3],
}

/// Effects that are kept.
const KEPT: usize = 12;

impl<'m> Gyro<'m> {
    /// A forward model of `records`, each prepared by [`Prepared::new`], with those of the `mechanisms` that the design leaves a place.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn new(library: Library, mechanisms: &[&'m dyn Mechanism], records: Vec<Prepared>) -> Result<Self, Error> {
        let all = records.len();
        Self::fitted_to(library, mechanisms, records, all)
    }

    /// The same where only the first `fitted` of the records are fitted: the others' temperatures say nothing beforehand.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn fitted_to(
        library: Library,
        mechanisms: &[&'m dyn Mechanism],
        records: Vec<Prepared>,
        fitted: usize,
    ) -> Result<Self, Error> {
        let temperatures = || records.iter().take(fitted).flat_map(|r| r.coil.iter().copied());
        let coldest = temperatures().fold(f64::INFINITY, f64::min);
        let range = [coldest, temperatures().fold(f64::NEG_INFINITY, f64::max).max(coldest + 1e-3)];
        let offered = mechanisms.iter().filter_map(|m| Some((*m, entry(*m, library.design(), range)?)));
        let (kinds, mechanisms) = offered.unzip();
        let averaging = records.first().map_or(0.0, |r| r.averaging);
        Ok(Self {
            chain: Chain::new(library)?,
            records,
            channels: channels(averaging),
            nuisances: nuisances(),
            kinds,
            mechanisms,
            known: RefCell::default(),
        })
    }

    /// The models of the design.
    pub fn library(&self) -> &Library {
        self.chain.library()
    }

    /// Number of a mechanism by its id.
    pub fn find(&self, id: &str) -> Option<usize> {
        self.mechanisms.iter().position(|m| m.id == id)
    }

    /// A mechanism by its number, with all that is known of it.
    pub fn mechanism(&self, number: usize) -> &'m dyn Mechanism {
        self.kinds[number]
    }

    /// Where a mechanism acts; `choices` are the first and the last value of its choice that are not excluded.
    pub fn extent(&self, active: &Active, choices: Option<[f64; 2]>) -> Extent {
        let known = (!self.records.is_empty()).then(|| self.effect(0, active).ok()).flatten();
        let change = known.as_ref().and_then(|known| known.change());
        let first = self.records.first().zip(change);
        (self.kinds[active.mechanism].facts().extent)(active, &Sight { design: self.library().design(), choices, first })
    }

    /// A design with a mechanism put in at its place; `None` if a design has no place for it, or the place is taken.
    pub fn extended(&self, design: &Design, active: &Active) -> Option<Design> {
        self.kinds[active.mechanism].extended(design, active)
    }

    /// Parts and thermometer of the nominal model with its uncertain numbers at `u`.
    fn recalibrated(&self, record: &Prepared, u: &[f64]) -> (Parts, Vec<f64>) {
        let (mut parts, mut sensor) = (record.nominal.parts.clone(), record.nominal.sensor.clone());
        for (k, of) in record.constants.iter().enumerate() {
            let by = u[nuisances::LINEAR + k] - 1.0;
            (0..3).filter(|_| by != 0.0).for_each(|p| add(&mut parts[p], &of[p], by));
        }
        let thermo_optic = {
            let o = &self.library().design().optics;
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
            change(&self.chain.softened(record, |_| (modulus, alpha)), None, 1.0);
        }
        let air = u[nuisances::AIR] * u[nuisances::CONDUCTIVITY];
        if air != 1.0 {
            let path = self.chain.along(record, air_path::ID, air_path::coordinate(air));
            change(&path.parts, path.thermometer.as_ref(), 1.0);
        }
        (parts, sensor)
    }

    /// What a mechanism does in a record; kept for as long as other unknowns are varied.
    fn effect(&self, record: usize, active: &Active) -> Result<Arc<Known>, Error> {
        let mut known = self.known.borrow_mut();
        if let Some((.., effect)) = known.iter().find(|(r, a, _)| *r == record && a == active) {
            return Ok(Arc::clone(effect));
        }
        let prepared = &self.records[record];
        let effect = self.kinds[active.mechanism].effect(&self.chain, prepared, active)?;
        let gain = match &effect {
            Effect::Coil(change) => [0, 1, 2].map(|p: usize| share(&change.parts[p], &prepared.nominal.parts[p])),
            Effect::Readings(_) => [0.0; 3],
        };
        let effect = Arc::new(Known { effect, gain });
        if known.len() == KEPT {
            known.remove(0);
        }
        known.push((record, active.clone(), Arc::clone(&effect)));
        Ok(effect)
    }
}

fn entry(mechanism: &dyn Mechanism, design: &Design, range: [f64; 2]) -> Option<diagnosis::Omission> {
    let facts = mechanism.facts();
    let Offer { parameters, choice, starts } = mechanism.offer(design, range)?;
    let (id, stage, named) = (facts.id.to_owned(), facts.stage.name().to_owned(), matches!(facts.naming, Naming::Named { .. }));
    Some(diagnosis::Omission { id, stage, parameters, choice, starts, named, weight: 1.0 })
}

impl Known {
    fn change(&self) -> Option<&Change> {
        match &self.effect {
            Effect::Coil(change) => Some(change),
            Effect::Readings(_) => None,
        }
    }
}

/// How much of a series another one is: ⟨a, b⟩/⟨b, b⟩.
fn share(a: &[f64], b: &[f64]) -> f64 {
    let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = of(b, b);
    if size > 0.0 { of(a, b) / size } else { 0.0 }
}

impl ForwardModel for Gyro<'_> {
    type Error = Error;

    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[diagnosis::Omission] {
        &self.mechanisms
    }

    fn respond(&self, record: usize, u: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Error> {
        let number = record;
        let record = &self.records[number];
        let nominal = &record.nominal.parts;
        let (mut parts, mut thermometer) = self.recalibrated(record, u);
        let effects = active.iter().map(|a| self.effect(number, a)).collect::<Result<Vec<_>, _>>()?;
        // mechanisms act on a coil that has the others: each one's gain on a part acts on the others' changes, too
        let mut gain: [f64; 3] = [0, 1, 2].map(|p: usize| share(&parts[p], &nominal[p]));
        let changes = || effects.iter().filter_map(|known| known.change().map(|change| (change, known.gain)));
        for (change, own) in changes() {
            for p in 0..3 {
                let (own, scaled) = (own[p], gain[p]);
                // what was there grows by this one's gain; what this adds beyond its gain grows by what was there
                for ((part, changed), nominal) in parts[p].iter_mut().zip(&change.parts[p]).zip(&nominal[p]) {
                    *part += own * *part + scaled * (changed - own * nominal);
                }
                gain[p] *= 1.0 + own;
            }
            if let Some(of_thermometer) = &change.thermometer {
                add(&mut thermometer, of_thermometer, 1.0);
            }
        }
        let mut rate: Vec<f64> =
            (0..thermometer.len()).map(|n| u[nuisances::GAIN] * (parts[0][n] + parts[1][n] + parts[2][n])).collect();
        for added in changes().filter_map(|(change, _)| change.rate.as_ref()) {
            add(&mut rate, added, 1.0);
        }
        let mut readings = Readings { time: &record.time, thermometer, rate };
        for known in &effects {
            if let Effect::Readings(act) = &known.effect {
                act(&mut readings);
            }
        }
        Ok(vec![readings.thermometer, readings.rate])
    }

    fn latent(&self, record: usize) -> Result<Vec<Latent>, Error> {
        self.chain.latent(&self.kinds, &self.records[record])
    }

    /// The layers, innermost first, with one turn more.
    fn members(&self, record: usize) -> Result<Option<Latent>, Error> {
        self.chain.layers(&self.records[record]).map(Some)
    }

    fn state(&self, record: usize) -> &State {
        &self.records[record].state
    }
}
