//! Names in an answer that the fitted record cannot separate from the truth.

use diagnosis::{Active, ForwardModel, Hypothesis, Observation, Plan, alternatives, separation};
use mechanisms::{RATE, SPOOL};
use recording::noise::NoiseModel;

use super::answer::Answer;
use super::chain::{self, FIT};
use crate::Failure;
use crate::generator::{SPAN, THERMOMETER};
use crate::truth::{Kind, Truth};

/// Squared distance of the noise-free responses, in standard deviations of the noise, up to which two are taken as inseparable.
const NEAREST: f64 = 9.0;
/// Stands for a term of the noise that a channel has not; thousandths of what could be seen.
const NONE: f64 = 1e-7;
/// Correlation time of a drift that is not there \[s\].
const ANY: f64 = 3600.0;

/// Noise of the channels, as far as the diagnosis has terms for it.
fn noise(truth: &Truth) -> [NoiseModel; 2] {
    let spool = (THERMOMETER.powi(2) + truth.spool_sensor.quantisation_c.powi(2) / 12.0).sqrt();
    let n = &truth.noise;
    let rate = NoiseModel {
        drift: n.gm_sigma_deg_per_h,
        drift_time: n.gm_tau_s,
        // per root of an hour to per root of a second
        walk: (n.rrw_deg_per_h_per_sqrt_h / 60.0).max(NONE),
        ..NoiseModel::white(n.arw_deg_per_sqrt_h / (SPAN / 3600.0).sqrt(), SPAN)
    };
    let spool = NoiseModel { drift: NONE, drift_time: ANY, walk: NONE, ..NoiseModel::white(spool, 0.0) };
    if SPOOL < RATE { [spool, rate] } else { [rate, spool] }
}

/// Takes the strength of what is concealed for what the design's tolerances leave of it, and adds to the truth's sets what the answer names and the record cannot separate: the best fit of the other family to the noise-free response
/// lies within [`NEAREST`], amplitudes and shapes free, the forward model granted its errors.
pub(super) fn extend(truth: &mut Truth, answer: &Answer, model: &chain::Unit) -> Result<(), Failure> {
    if !matches!(truth.kind(), Kind::Single | Kind::Double) {
        return Ok(());
    }
    let confident = answer.mechanisms.iter().filter(|m| m.probability >= 0.5).map(|m| &m.id);
    let mut others: Vec<String> = answer.set.iter().chain(confident).filter(|id| !truth.admits(id)).cloned().collect();
    others.sort();
    others.dedup();
    let gyro = &model.gyro;
    let entries = gyro.mechanisms();
    let instants = [Observation { time: model.time[FIT].clone(), channels: model.recorded[FIT].to_vec() }];
    let noise = noise(truth);
    let plan = Plan { records: &[FIT], instants: &instants, noise: Some(&noise) };
    let concealed: Vec<_> = truth.concealed().cloned().collect();
    // what the design's constants leave of an effect within their tolerances is all that can be found
    for true_one in &concealed {
        let Some(active) = model.at_work(true_one, -3.0) else { continue };
        let left = separation(gyro, &plan, &[active], &[Hypothesis::RECALIBRATED])
            .map_err(|e| Failure(format!("{} against the constants: {e}", true_one.id)))?;
        let left = left.squared.sqrt();
        truth.snr.iter_mut().filter(|s| s.id == true_one.id).for_each(|s| s.snr = s.snr.min(left));
    }
    for (place, true_one) in concealed.iter().enumerate() {
        // what the truth does not name is at its smallest: a heater is switched on with the record
        let Some(active) = model.at_work(true_one, -3.0) else { continue };
        for other in &others {
            let Some(rival) = gyro.find(other) else { continue };
            let nearest = separation(gyro, &plan, std::slice::from_ref(&active), &alternatives(gyro, rival))
                .map_err(|e| Failure(format!("{} against {other}: {e}", true_one.id)))?;
            let paid = |a: &Active| -> f64 {
                entries[a.mechanism].parameters.iter().zip(&a.values).map(|(p, v)| p.prior.standard(*v).powi(2)).sum()
            };
            if nearest.squared - nearest.rival.active.iter().map(paid).sum::<f64>() < NEAREST {
                truth.confusable_sets[place].push(other.clone());
            }
        }
    }
    Ok(())
}
