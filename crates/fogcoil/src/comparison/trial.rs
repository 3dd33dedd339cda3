//! Test whether a recommended programme tells two mechanisms apart: its recordings, made with noise and fitted by both.

use diagnosis::{Active, ForwardModel, Observation, expected, fitted};
use mechanisms::{CATALOGUE, Gyro};
use progress::Step;

use super::{Comparison, Told};
use crate::Error;
use crate::cache::Cache;
use crate::input::CoilCase;
use crate::prepare::library;
use crate::recommend::{Contender, Programme, everything, prepared, told_apart, usual};

/// Two mechanisms, and how often records of a programme named the one that was at work.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// Their ids.
    pub pair: [String; 2],
    /// The programme that is expected to tell them apart best.
    pub programme: String,
    /// Expected ln odds under it, of the direction that is told worse.
    pub expected: f64,
    /// The same under the slow ramp, which is what would be repeated.
    pub repeated: f64,
    /// ln of the evidence of the truth over the other's, one record with either at work; under the recommended programme and the slow ramp.
    pub found: [[f64; 2]; 2],
}

impl Trial {
    /// Whether the pair is separable by the programmes at hand.
    pub fn is_separable(&self) -> bool {
        told_apart(self.expected)
    }

    /// Whether either record under the recommended programme names its truth, and under the slow ramp.
    pub fn separated(&self) -> [bool; 2] {
        self.found.map(|odds| odds.iter().all(|o| *o > 0.0))
    }
}

impl Comparison {
    /// Tries the recommendation for every pair; `normal` draws from the standard normal distribution.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the design cannot be modelled.
    pub fn trials(
        &self,
        case: &CoilCase,
        cache: &Cache,
        normal: &mut dyn FnMut() -> f64,
        progress: &dyn Fn(Step),
    ) -> Result<Vec<Trial>, Error> {
        let coil = Error::of_coil(&case.file);
        let failed = Error::of_diagnosis(&case.file);
        let library = library(case, cache, &|_| ())?;
        let records = self.programmes.iter().map(|p| prepared(&library, p)).collect::<Result<Vec<_>, _>>().map_err(coil)?;
        let gyro = Gyro::new(library, CATALOGUE, records).map_err(coil)?;
        let contenders = self.entries.iter().filter_map(|entry| Contender::named(&gyro, &entry.id).transpose());
        let contenders = contenders.collect::<Result<Vec<_>, _>>().map_err(failed)?;
        let mut trials = Vec::new();
        for (a, first) in contenders.iter().enumerate() {
            for (b, second) in contenders.iter().enumerate().skip(a + 1) {
                let worse = |k: usize| -> f64 {
                    let odds = |told: &Option<Told>| told.as_ref().map_or(f64::INFINITY, |t| t.log_odds);
                    odds(&self.told[k][a][b]).min(odds(&self.told[k][b][a]))
                };
                let best = (0..self.programmes.len()).max_by(|x, y| worse(*x).total_cmp(&worse(*y))).unwrap_or(0);
                progress(Step::begins(&format!("{} and {}: {}", first.id, second.id, self.programmes[best].family)));
                let mut found = [[0.0; 2]; 2];
                for (of_programme, k) in found.iter_mut().zip([best, 0]) {
                    for (odds, (truth, rival)) in of_programme.iter_mut().zip([(first, second), (second, first)]) {
                        let Some(active) = &truth.truth else { continue };
                        let observed = recorded(&gyro, k, &self.programmes[k], active, normal).map_err(coil)?;
                        let evidence = |c: &Contender| {
                            fitted(&gyro, &[k], std::slice::from_ref(&observed), &c.hypotheses)
                                .map(|f| f.log_evidence)
                                .map_err(failed)
                        };
                        *odds = evidence(truth)? - evidence(rival)?;
                    }
                }
                let programme = self.programmes[best].family.to_string();
                let pair = [first.id.clone(), second.id.clone()];
                trials.push(Trial { pair, programme, expected: worse(best), repeated: worse(0), found });
            }
        }
        Ok(trials)
    }
}

/// A programme's record with a mechanism at work and usual noise: white, and a drift that decays as it is usual.
fn recorded(
    gyro: &Gyro,
    record: usize,
    programme: &Programme,
    active: &Active,
    normal: &mut dyn FnMut() -> f64,
) -> Result<Observation, coil::Error> {
    let middle = expected(gyro.nuisances());
    let mut observed = everything(programme);
    let response = gyro.respond(record, &middle, std::slice::from_ref(active))?;
    for ((series, response), noise) in observed.channels.iter_mut().zip(response).zip(usual(gyro)) {
        let mut drift = noise.drift * normal();
        for (n, (value, response)) in series.iter_mut().zip(response).enumerate() {
            if n > 0 {
                let keep = (-(observed.time[n] - observed.time[n - 1]) / noise.drift_time).exp();
                drift = keep * drift + noise.drift * (1.0 - keep * keep).sqrt() * normal();
            }
            *value = response + drift + noise.white * normal();
        }
    }
    Ok(observed)
}
