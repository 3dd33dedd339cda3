//! The coil's chain as a forward model for diagnosis: nominal constants, their uncertainties, and the library of mechanisms.

mod nominal;
mod recalibrated;
mod simulated;
mod together;

pub use simulated::InFull;

use crate::REFERENCE_C;
use crate::constants::{Constant, number_of};
use crate::course::{Delay, RATE, Series, add, total};
use crate::design::chosen;
use crate::heat_path::AtWork;
use crate::instruments::{self, Instruments, MINUTE, channels, nuisances};
use crate::law_tools::Chain;
use crate::library::Library;
use crate::mechanism::{Change, Effect, Extent, Mechanism, Naming, Offer, Readings, Scene, Sight, Stage};
use crate::passed::Passed;
use crate::record_to_bias::Prepared;
use crate::series::{middles, read_late};
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Design, Drifts, Error, Number, Parameter, Tolerances};
use diagnosis::{Active, Channel, Failure, ForwardModel, Latent, Nuisance, State};
use nalgebra::DMatrix;
use recalibrated::{Recalibrated, share};
use recording::median_interval;
use std::cell::RefCell;
use std::sync::Arc;
use together::{Acting, Kind, together};

/// A design's library and the recordings it is compared with.
pub struct Gyro<'m> {
    chain: Chain,
    records: Vec<Prepared>,
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    /// of the nuisances, where constants of the design go together
    precision: Option<DMatrix<f64>>,
    kinds: Vec<&'m dyn Mechanism>,
    mechanisms: Vec<diagnosis::Omission>,
    scene: Scene,
    /// places of constants on which a mechanism's parameter is a factor, and the mechanisms' ids
    factored: Vec<(usize, String)>,
    /// constants that were told and what came of them, by record
    moved: RefCell<Vec<(usize, Vec<f64>, Series)>>,
    /// the nominal model at the last nuisances that were told, by record
    recalibrated: RefCell<Vec<Arc<Recalibrated>>>,
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

/// Standard deviations by which a constant may move before the model is made anew about it: conductivities act far from linearly where a sensitive
/// gyroscope sees a thousandth of their tolerance.
const NEAR: f64 = 0.02;
/// Standard deviations from the drawing within which the model is made; beyond it is extrapolated.
const MOST: f64 = 2.9;
/// Change of a heat path's coordinate, which is of the size of one, from which the model is made anew about it: what the constants do beside the path
/// follows it.
const ALONG: f64 = 0.02;

impl<'m> Gyro<'m> {
    /// A forward model of `records`, each prepared by [`Prepared::new`], with those of the `mechanisms` that the design leaves a place.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn new(library: Library, mechanisms: &[&'m dyn Mechanism], records: Vec<Prepared>) -> Result<Self, Error> {
        let all = records.len();
        Self::fitted_to(library, mechanisms, records, all, &Instruments::default())
    }

    /// The same where only the first `fitted` of the records are fitted: the others' temperatures say nothing beforehand; read by these `instruments`.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub fn fitted_to(
        library: Library,
        mechanisms: &[&'m dyn Mechanism],
        records: Vec<Prepared>,
        fitted: usize,
        instruments: &Instruments,
    ) -> Result<Self, Error> {
        let temperatures = || records.iter().take(fitted).flat_map(|r| r.coil.iter().copied());
        let coldest = temperatures().fold(f64::INFINITY, f64::min);
        let range = [coldest, temperatures().fold(f64::NEG_INFINITY, f64::max).max(coldest + 1e-3)];
        let (averaging, interval) =
            records.first().map_or((0.0, MINUTE), |r| (r.averaging, median_interval(&r.time).unwrap_or(MINUTE)));
        let scene =
            Scene { temperatures: range, noise: instruments.white[RATE] * (interval / MINUTE).sqrt(), earth: instruments.earth };
        let records: Vec<Prepared> = records.into_iter().map(|record| record.turning_with(instruments.earth)).collect();
        let offered = mechanisms.iter().filter_map(|m| Some((*m, entry(*m, library.design(), &scene)?)));
        let (kinds, mechanisms) = offered.unzip();
        let noise = records.iter().take(fitted).map(Prepared::noise).fold(0.0, f64::max);
        let nuisances = nuisances(library.design(), library.tolerances(), instruments, noise);
        Ok(Self {
            channels: channels(averaging, instruments, interval, records.first().map_or(Passed::NONE, |r| r.passed)),
            precision: precision(&nuisances, library.tolerances())?,
            nuisances,
            factored: library.factored(),
            chain: Chain::new(library),
            records,
            kinds,
            mechanisms,
            scene,
            moved: RefCell::default(),
            recalibrated: RefCell::default(),
            known: RefCell::default(),
        })
    }

    /// The same model with more mechanisms behind its own; each starts from here.
    #[must_use]
    pub fn beside<'a>(&self, more: &[&'a dyn Mechanism]) -> Gyro<'a>
    where
        'm: 'a,
    {
        let design = self.library().design();
        let offered = more.iter().filter_map(|m| Some((*m, entry(*m, design, &self.scene)?)));
        let (new, omissions): (Vec<&'a dyn Mechanism>, Vec<diagnosis::Omission>) = offered.unzip();
        Gyro {
            chain: Chain::new(self.library().clone()),
            records: self.records.clone(),
            channels: self.channels.clone(),
            nuisances: self.nuisances.clone(),
            precision: self.precision.clone(),
            kinds: self.kinds.iter().map(|kind| *kind as &'a dyn Mechanism).chain(new).collect(),
            mechanisms: self.mechanisms.iter().cloned().chain(omissions).collect(),
            factored: self.factored.clone(),
            scene: self.scene,
            moved: RefCell::default(),
            recalibrated: RefCell::default(),
            known: RefCell::default(),
        }
    }

    /// Largest |part| of the bias as designed in the first of its records \[deg/h\]: Shupe, elasto-optic axial and radial, and the sum.
    pub fn largest_parts(&self, records: usize) -> [f64; 4] {
        let largest = |series: &[f64]| series.iter().fold(0.0_f64, |most, rate| most.max(rate.abs()));
        let of = |record: &Prepared| {
            let [shupe, axial, radial] = record.nominal.parts.each_ref().map(|part| largest(part));
            [shupe, axial, radial, largest(&total(&record.nominal.parts))]
        };
        let most = |a: [f64; 4], b: [f64; 4]| [0, 1, 2, 3].map(|k: usize| a[k].max(b[k]));
        self.records.iter().take(records).map(of).fold([0.0; 4], most)
    }

    /// The coldest and the hottest that the chamber was in the first of its records \[°C\].
    pub fn chamber_range(&self, records: usize) -> [f64; 2] {
        let all = self.records.iter().take(records).flat_map(|record| &record.chamber);
        all.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], t| [low.min(*t), high.max(*t)])
    }

    /// Range of the coil in the fitted records, and noise of the gyroscope.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Constants and delays at which this model is linear: nuisances at which its response is exact.
    fn here(&self) -> Vec<f64> {
        let mut here = diagnosis::expected(&self.nuisances);
        let delay = self.records.first().map_or(Delay::default(), |r| r.delay);
        here[instruments::CHAMBER_DELAY] = delay.total();
        here[instruments::CHAMBER_LAG_SQUARED] = delay.lag.powi(2);
        let library = self.library();
        for (k, (constant, value)) in library.constants.iter().zip(library.values()).enumerate() {
            here[instruments::CONSTANTS + k] = constant.told(value);
        }
        here
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

    /// Extent of a mechanism in a record; `choices` are the first and the last value of its choice that are not excluded.
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

    /// Nuisances where a mechanism that is a factor on a constant takes its place, and the mechanisms that are left. Such a factor is all that the
    /// unit deviates by from the drawing: what the constant's tolerance adds to the factor's own spread is little, and no record could tell them apart.
    fn with_factors<'a>(&self, u: &[f64], active: &'a [Active]) -> (Vec<f64>, Vec<&'a Active>) {
        let (mut moved, mut others) = (u.to_vec(), Vec::new());
        for active in active {
            match self.stands_for(active.mechanism) {
                Some(number) => moved[number] = active.values[0],
                None => others.push(active),
            }
        }
        (moved, others)
    }

    /// The paths of heat among mechanisms that leave the constants as they are.
    fn paths_of(&self, active: &[Active]) -> Vec<AtWork> {
        let of = |active: &Active| {
            let facts = self.kinds[active.mechanism].facts();
            let path = facts.heat_path?;
            let coordinate = (path.coordinate?)(active.values[0]).clamp(path.nodes[0], *path.nodes.last()?);
            Some(AtWork { id: facts.id.to_owned(), place: chosen(active), coordinate })
        };
        active.iter().filter_map(of).collect()
    }

    /// Whether the models have just these paths of heat at work.
    fn is_about(&self, at_work: &[AtWork]) -> bool {
        let own = &self.library().at_work;
        let near = |a: &AtWork| own.iter().any(|b| a.is(&b.id, b.place) && (a.coordinate - b.coordinate).abs() <= ALONG);
        own.len() == at_work.len() && at_work.iter().all(near)
    }

    fn kind(&self, mechanism: usize) -> Kind {
        let facts = self.kinds[mechanism].facts();
        match facts.stage {
            // another path of heat leaves the constants as they are
            Stage::Thermal if facts.heat_path.is_some() => Kind::Path,
            Stage::Winding | Stage::Bond => Kind::Beside,
            _ => Kind::Other,
        }
    }

    /// The paths of heat that the models have at work and a hypothesis has not, as they are drawn.
    fn taken_away(&self, active: &[Active]) -> Vec<Active> {
        let of = |own: &AtWork| {
            let mechanism = self.find(&own.id)?;
            let kept = active.iter().any(|a| a.mechanism == mechanism && chosen(a) == own.place);
            let choice = self.mechanisms[mechanism].choice.as_ref().map(|(_, candidates)| candidates[own.place]);
            let nowhere = self.kinds[mechanism].facts().heat_path?.nowhere;
            (!kept).then(|| Active { mechanism, values: vec![nowhere], choice })
        };
        self.library().at_work.iter().filter_map(of).collect()
    }

    /// Effect of a mechanism in a record; kept for as long as other unknowns are varied.
    fn effect(&self, record: usize, active: &Active) -> Result<Arc<Known>, Error> {
        let mut known = self.known.borrow_mut();
        if let Some((.., effect)) = known.iter().find(|(r, a, _)| *r == record && a == active) {
            return Ok(Arc::clone(effect));
        }
        let prepared = &self.records[record];
        let effect = self.kinds[active.mechanism].effect(&self.chain, prepared, active)?;
        let gain = match &effect {
            Effect::Coil(change) => [0, 1, 2].map(|p: usize| share(&change.parts[p], prepared, p)),
            Effect::Readings(_) => [0.0; 3],
        };
        let effect = Arc::new(Known { effect, gain });
        if known.len() == KEPT {
            known.remove(0);
        }
        known.push((record, active.clone(), Arc::clone(&effect)));
        Ok(effect)
    }

    /// How much warmer the coil is in a row, per unit of a nuisance as it is told; `None` if the nuisance does not warm it.
    fn warms<'a>(&'a self, record: &'a Prepared, nuisance: usize) -> Option<Box<dyn Fn(usize) -> f64 + 'a>> {
        match nuisance {
            instruments::CHAMBER_DELAY => Some(Box::new(|row| record.coil_later[row])),
            instruments::CHAMBER_GAIN => Some(Box::new(|row| record.coil[0] - record.coil[row])),
            _ => {
                let constant = nuisance.checked_sub(instruments::CONSTANTS)?;
                let (constant, slope) = (self.library().constants.get(constant)?, &record.coil_slopes[constant]);
                Some(Box::new(move |row| slope[row] * constant.value(1.0)))
            }
        }
    }

    /// Relative change of a constant from where the models are made.
    fn relative(&self, u: &[f64], parameter: Parameter) -> f64 {
        let library = self.library();
        let mut all = library.constants.iter().zip(library.values()).zip(&u[instruments::CONSTANTS..]);
        let of = all.find(|((constant, own), _)| constant.parameter == parameter && *own != 0.0);
        of.map_or(0.0, |((constant, own), told)| constant.value(*told) / own - 1.0)
    }

    /// Response of every channel in a record, with nuisances `u` and mechanisms at work.
    ///
    /// # Errors
    /// [`Error`] if a mechanism cannot be put in.
    pub fn respond(&self, record: usize, u: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Error> {
        let number = record;
        let record = &self.records[number];
        let (moved, others) = self.with_factors(u, active);
        let u = &moved;
        let without = self.recalibrated(number, u);
        let mut thermometer = without.thermometer.clone();
        let away = self.taken_away(active);
        let at_work = others.into_iter().chain(&away);
        let effects =
            at_work.map(|a| Ok((self.kind(a.mechanism), self.effect(number, a)?))).collect::<Result<Vec<_>, Error>>()?;
        let changes: Vec<Acting> = effects
            .iter()
            .filter_map(|(kind, known)| {
                let change = known.change()?;
                let kind = if change.apart.is_some() { Kind::Apart } else { *kind };
                let moved = change.per.iter().map(|per| self.relative(u, per.parameter)).collect();
                Some(Acting { change, gain: known.gain, kind, moved, tail: u[instruments::TAIL] })
            })
            .collect();
        let by_heat = changes.iter().any(|acting| acting.kind == Kind::Beside).then(|| self.by_heat(&without));
        let parts = together(&record.nominal.parts, &without, by_heat, &changes);
        for Acting { change, moved, .. } in &changes {
            let per = change.per.iter().zip(moved).filter_map(|(per, moved)| Some((per.thermometer.as_ref()?, *moved)));
            let courses = change.thermometer.iter().map(|course| (course, 1.0)).chain(per);
            courses.for_each(|(course, much)| add(&mut thermometer, course, much));
        }
        let mut rate = total(&parts);
        rate.iter_mut().for_each(|r| *r *= u[instruments::GAIN]);
        for added in changes.iter().filter_map(|acting| acting.change.rate.as_ref()) {
            add(&mut rate, added, 1.0);
        }
        // whatever the thermometer's lag
        let Drifts { read_out, reference, .. } = self.library().design().drifts;
        add(&mut rate, &middles(&thermometer, |t| t - reference), read_out * DEG_PER_H_PER_RAD_PER_S);
        self.read(record, &mut thermometer, u);
        let mut readings = Readings { time: &record.time, thermometer, rate };
        for (_, known) in &effects {
            if let Effect::Readings(act) = &known.effect {
                act(&mut readings);
            }
        }
        if instruments::may_be_late(&self.nuisances) {
            readings.rate = read_late(&record.time, &readings.rate, u[instruments::RATE_DELAY], u[instruments::RATE_FILTER]);
        }
        let gain = u[instruments::SPOOL_GAIN];
        let thermometer = readings.thermometer.iter().map(|t| REFERENCE_C + (t - REFERENCE_C) * gain).collect();
        Ok(vec![thermometer, readings.rate])
    }
}

/// The precision of nuisances of which the tolerances say that some go together.
fn precision(nuisances: &[Nuisance], tolerances: &Tolerances) -> Result<Option<DMatrix<f64>>, Error> {
    if tolerances.correlations.is_empty() {
        return Ok(None);
    }
    let numbers: Vec<Option<Number>> = nuisances.iter().map(|n| number_of(&n.parameter.name)).collect();
    let all: Vec<Number> = numbers.iter().copied().flatten().collect();
    let Some(factor) = tolerances.correlation(&all).cholesky() else {
        return Err(Error::Design { field: "correlations".into(), problem: "contradict each other".into() });
    };
    let (inverse, mut precision) = (factor.inverse(), DMatrix::identity(nuisances.len(), nuisances.len()));
    let places: Vec<usize> = (0..numbers.len()).filter(|n| numbers[*n].is_some()).collect();
    for (i, a) in places.iter().enumerate() {
        places.iter().enumerate().for_each(|(j, b)| precision[(*a, *b)] = inverse[(i, j)]);
    }
    Ok(Some(precision))
}

fn entry(mechanism: &dyn Mechanism, design: &Design, scene: &Scene) -> Option<diagnosis::Omission> {
    let facts = mechanism.facts();
    let Offer { parameters, choice, starts } = mechanism.offer(design, scene)?;
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

/// Deviation at which the square of a time constant of which nothing is known is that of half the usual one.
const HALF_A_LAG: f64 = 0.25;

impl ForwardModel for Gyro<'_> {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn stands_for(&self, mechanism: usize) -> Option<usize> {
        let id = &self.mechanisms[mechanism].id;
        self.factored.iter().find(|(_, own)| own == id).map(|(k, _)| instruments::CONSTANTS + k)
    }

    fn precision(&self) -> Option<&DMatrix<f64>> {
        self.precision.as_ref()
    }

    fn mechanisms(&self) -> &[diagnosis::Omission] {
        &self.mechanisms
    }

    /// A rate that may be late is late with what mechanisms add; a small delay acts on the design's part alone.
    fn acts_on_mechanisms(&self, nuisance: usize) -> bool {
        [instruments::RATE_DELAY, instruments::RATE_FILTER].contains(&nuisance) && instruments::may_be_late(&self.nuisances)
    }

    /// Where the coil passes a threshold, the mean of all passages.
    fn carries(&self, nuisance: usize, active: &Active) -> Vec<f64> {
        let mut sums: Vec<(f64, Vec<f64>)> = Vec::new();
        for (number, record) in self.records.iter().enumerate() {
            let Some(warms) = self.warms(record, nuisance) else { continue };
            let Ok(known) = self.effect(number, active) else { continue };
            for passed in known.change().into_iter().flat_map(|change| &change.thresholds) {
                if sums.len() <= passed.number {
                    sums.resize(passed.number + 1, (0.0, vec![0.0; passed.parameters.len()]));
                }
                let (count, sum) = &mut sums[passed.number];
                *count += 1.0;
                sum.iter_mut().zip(&passed.parameters).for_each(|(sum, by)| *sum += by * warms(passed.row));
            }
        }
        let mut all = Vec::new();
        for (count, sum) in sums.iter().filter(|(count, _)| *count > 0.0) {
            all.resize(sum.len().max(all.len()), 0.0);
            all.iter_mut().zip(sum).for_each(|(all, sum)| *all += sum / count);
        }
        all
    }

    fn respond(&self, record: usize, u: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, Failure> {
        Ok(Gyro::respond(self, record, u, active)?)
    }

    fn about(&self, u: &[f64], active: &[Active]) -> Result<Option<Self>, Failure> {
        let (here, (u, _)) = (self.here(), self.with_factors(u, active));
        // no thermometer has a negative square: that is left to what is linear
        let wanted = |k: usize| if k == instruments::CHAMBER_LAG_SQUARED { u[k].max(0.0) } else { u[k] };
        let moved = |k: usize| (wanted(k) - here[k]).abs() / self.nuisances[k].parameter.prior.sd();
        let places = (instruments::CONSTANTS..u.len()).chain([instruments::CHAMBER_DELAY, instruments::CHAMBER_LAG_SQUARED]);
        let at_work = self.paths_of(active);
        if places.map(moved).fold(0.0, f64::max) <= NEAR && self.is_about(&at_work) {
            return Ok(None);
        }
        let library = self.library();
        let within = |(k, (c, told)): (usize, (&Constant, &f64))| {
            let value = c.value(*told);
            // one that a path of heat follows goes as far as the path, which its library sees to
            let follows = self.factored.iter().any(|(place, _)| *place == k);
            let by = MOST * c.tolerance;
            if follows { value } else { value.clamp(c.drawn - by, c.drawn + by) }
        };
        let values: Vec<f64> = library.constants.iter().zip(&u[instruments::CONSTANTS..]).enumerate().map(within).collect();
        let library = library.about(&values, at_work)?;
        let lag = u[instruments::CHAMBER_LAG_SQUARED].max(0.0).sqrt();
        let delay = Delay { lag, clock: u[instruments::CHAMBER_DELAY] - lag };
        let records = self.records.iter().map(|r| r.again(&library, delay)).collect::<Result<_, _>>()?;
        Ok(Some(Self {
            chain: Chain::new(library),
            records,
            channels: self.channels.clone(),
            nuisances: self.nuisances.clone(),
            precision: self.precision.clone(),
            kinds: self.kinds.clone(),
            mechanisms: self.mechanisms.clone(),
            factored: self.factored.clone(),
            scene: self.scene,
            moved: RefCell::default(),
            recalibrated: RefCell::default(),
            known: RefCell::default(),
        }))
    }

    /// With a thermometer in the chamber of half a usual time constant, of a whole one, and a very slow one, whose readings are as late as was found:
    /// beyond its two cumulants its lag is not linear. The delay itself is found from anywhere; about a model with another one, fits of the lag end at
    /// another coil.
    fn starts(&self, found: &[f64]) -> Vec<Vec<f64>> {
        let squared = self.nuisances[instruments::CHAMBER_LAG_SQUARED].parameter.prior;
        let with_lag = |deviations: f64| {
            let mut start = diagnosis::expected(&self.nuisances);
            start[instruments::CHAMBER_LAG_SQUARED] = squared.value(deviations);
            start[instruments::CHAMBER_DELAY] = found[instruments::CHAMBER_DELAY];
            start
        };
        [HALF_A_LAG, 1.0, 3.0].map(with_lag).to_vec()
    }

    fn latent(&self, record: usize) -> Result<Vec<Latent>, Failure> {
        Ok(self.chain.latent(&self.kinds, &self.records[record])?)
    }

    /// The layers, innermost first, with one turn more.
    fn members(&self, record: usize) -> Result<Option<Latent>, Failure> {
        Ok(Some(self.chain.layers(&self.records[record])?))
    }

    fn state(&self, record: usize) -> &State {
        &self.records[record].state
    }
}
