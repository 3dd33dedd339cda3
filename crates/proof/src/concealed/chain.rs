//! Prediction of a unit's two records by the coil's chain: the nominal design, and the design with the truth built in.

use std::path::PathBuf;

use coil::COARSE;
use diagnosis::{Active, ForwardModel};
use fogcoil::cache::Cache;
use fogcoil::input::{CHAMBER, CoilCase, RATE, RecordCase, SPOOL};
use mechanisms::{CATALOGUE, Gyro, Library, Models, Prepared};

use super::answer::record;
use super::score::HeldOut;
use crate::Failure;
use crate::truth::{ConcealedEffect, Kind, Truth};

/// The place of the record that is fitted, and of the one that is held out.
pub(crate) const FIT: usize = 0;
pub(crate) const HOLDOUT: usize = 1;
/// Contribution of the noise of the recorded chamber temperature to a rate that is computed from it \[deg/h\].
const CHAMBER_NOISE: f64 = 0.002;

/// Places in its prior at which a parameter is tried that the truth does not name (the time of a heater before the first row), standard deviations.
const UNNAMED: [f64; 9] = [-4.0, -3.0, -2.0, -1.5, -1.0, -0.5, 0.0, 1.0, 2.0];

/// The design's library, from the cache if it is there.
pub(crate) fn library(coil: &CoilCase, cache: &Cache) -> Result<Library, Failure> {
    let key = (&coil.design, &coil.tolerances, COARSE);
    let models = cache.load_or_build("models", &key, || Models::build(&coil.design, &coil.tolerances, CATALOGUE, &|_| ()))?.0;
    Ok(Library::new(models, CATALOGUE)?)
}

/// Recorded values of a channel; NaN where they cannot be used.
pub(crate) type Series = Vec<f64>;

pub(crate) struct Unit {
    pub(crate) gyro: Gyro<'static>,
    /// Channels of both records, in the order of the model's.
    pub(crate) recorded: [[Series; 2]; 2],
    pub(crate) time: [Series; 2],
    averaging: f64,
}

/// Root mean square of what is not NaN.
pub(crate) fn rms(values: impl Iterator<Item = f64>) -> f64 {
    mean(values.map(|v| v * v)).sqrt()
}

/// Mean of what is not NaN.
pub(crate) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.filter(|v| !v.is_nan()).fold((0.0, 0_usize), |(sum, count), v| (sum + v, count + 1));
    sum / count.max(1) as f64
}

pub(crate) fn used(case: &RecordCase, channel: &str) -> Result<Series, Failure> {
    let missing = || Failure(format!("{}: there is no {channel}", case.fingerprint.file.display()));
    Ok(case.report.used(&case.recording).channel(channel).ok_or_else(missing)?.values.clone())
}

/// Values that cannot be used replaced by the last that can.
fn held(mut values: Series) -> Series {
    let mut last = values.iter().copied().find(|v| v.is_finite()).unwrap_or(f64::NAN);
    for value in &mut values {
        if value.is_finite() {
            last = *value;
        } else {
            *value = last;
        }
    }
    values
}

impl Unit {
    /// Reads both records and runs the library under their chambers.
    pub(crate) fn new(library: &Library, [fit, holdout]: &[PathBuf; 2]) -> Result<Self, Failure> {
        let cases = [record(fit)?, record(holdout)?];
        let prepared = |case: &RecordCase| -> Result<Prepared, Failure> {
            Ok(Prepared::new(library, case.kept().time(), &held(used(case, CHAMBER)?), case.averaging)?)
        };
        let recorded = |case: &RecordCase| -> Result<[Series; 2], Failure> { Ok([used(case, SPOOL)?, used(case, RATE)?]) };
        let gyro = Gyro::new(library.clone(), CATALOGUE, cases.iter().map(prepared).collect::<Result<_, _>>()?)?;
        let time = cases.each_ref().map(|case| case.kept().time().to_vec());
        Ok(Self { gyro, recorded: [recorded(&cases[FIT])?, recorded(&cases[HOLDOUT])?], time, averaging: cases[FIT].averaging })
    }

    /// Channels of the design with mechanisms at work, its own constants as designed.
    pub(crate) fn respond(&self, record: usize, active: &[Active]) -> Result<[Series; 2], Failure> {
        let constants: Vec<f64> = self.gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        let response = self.gyro.respond(record, &constants, active)?;
        response.try_into().map_err(|_| Failure("the model has not two channels".into()))
    }

    /// Recorded less computed channel of a record, less the mean of that of the record that is fitted.
    pub(crate) fn residual(&self, record: usize, channel: usize, active: &[Active]) -> Result<Series, Failure> {
        let difference = |record: usize| -> Result<Series, Failure> {
            let response = self.respond(record, active)?;
            Ok(self.recorded[record][channel].iter().zip(&response[channel]).map(|(y, r)| y - r).collect())
        };
        let offset = mean(difference(FIT)?.into_iter());
        Ok(difference(record)?.into_iter().map(|d| d - offset).collect())
    }

    /// The true mechanisms at the true parameters; what the truth does not name lies `u` standard deviations from the middle of its prior.
    fn active(&self, truth: &Truth, u: f64) -> Result<Vec<Active>, Failure> {
        let unknown = |true_one: &ConcealedEffect| Failure(format!("the library has no {}", true_one.id));
        truth.concealed().map(|true_one| self.at_work(true_one, u).ok_or_else(|| unknown(true_one))).collect()
    }

    /// A true mechanism as the library has it, what is not named `u` standard deviations from the middle of its prior; `None` if it has it not.
    pub(crate) fn at_work(&self, true_one: &ConcealedEffect, u: f64) -> Option<Active> {
        let mechanism = self.gyro.find(&true_one.id)?;
        let entry = &self.gyro.mechanisms()[mechanism];
        let value = |p: &diagnosis::Parameter| true_one.parameters.get(&p.name).copied().unwrap_or(p.prior.value(u));
        let choice = entry.choice.as_ref().and_then(|(name, _)| true_one.parameters.get(name).copied());
        Some(Active { mechanism, values: entry.parameters.iter().map(value).collect(), choice })
    }

    /// Size of the noise in the record that is held out, from the truth \[deg/h\].
    pub(crate) fn noise(&self, truth: &Truth) -> f64 {
        let noise = &truth.noise;
        let white = noise.arw_deg_per_sqrt_h * (3600.0 / self.averaging).sqrt();
        let time = &self.time[HOLDOUT];
        let hours = time.last().zip(time.first()).map_or(0.0, |(b, a)| (b - a) / 3600.0);
        let walk = noise.rrw_deg_per_h_per_sqrt_h * (hours / 2.0).sqrt();
        [white, noise.gm_sigma_deg_per_h, walk, CHAMBER_NOISE].iter().map(|n| n * n).sum::<f64>().sqrt()
    }

    /// Error of a prediction of the held-out rate beside those of the nominal and the true model.
    ///
    /// The true model is the chain with the truth built in, its offset from the record that is fitted; what the truth does not name is such
    /// that the held-out record is met best. For what the library does not hold it is the noise.
    pub(crate) fn held_out(&self, truth: &Truth, prediction: &[f64]) -> Result<HeldOut, Failure> {
        let recorded = &self.recorded[HOLDOUT][mechanisms::RATE];
        if prediction.len() != recorded.len() {
            return Err(Failure(format!("a prediction has {} rows, the record {}", prediction.len(), recorded.len())));
        }
        let of = |active: &[Active]| Ok::<_, Failure>(rms(self.residual(HOLDOUT, mechanisms::RATE, active)?.into_iter()));
        let true_one = match truth.kind() {
            Kind::Outside => self.noise(truth),
            Kind::Null => of(&[])?,
            _ => UNNAMED
                .map(|u| of(&self.active(truth, u)?))
                .into_iter()
                .try_fold(f64::INFINITY, |best, r| Ok::<_, Failure>(r?.min(best)))?,
        };
        let model = rms(recorded.iter().zip(prediction).map(|(y, p)| y - p));
        Ok(HeldOut { nominal: of(&[])?, model, truth: true_one })
    }
}
