//! Numbers that follow from an identified noise, with their errors.

use super::NoiseModel;
use super::identify::{NoiseEstimate, Parameter};

/// Step of the derivatives in the logarithms of the parameters.
const STEP: f64 = 1e-4;

impl NoiseEstimate {
    /// Standard error of the natural logarithm of a positive number that follows from the model, to first order, with the correlation of the
    /// parameters, without those at an edge; `None` where the likelihood is too flat to tell.
    pub fn relative_error(&self, of: impl Fn(&NoiseModel) -> f64) -> Option<f64> {
        let covariance = self.covariance.as_ref()?;
        let parameters = Parameter::all(&self.terms);
        let scaled = |number: usize, by: f64| {
            let mut model = self.model;
            *parameters[number].of(&mut model) *= by.exp();
            of(&model).ln()
        };
        let slope = |number: usize| (scaled(number, STEP) - scaled(number, -STEP)) / (2.0 * STEP);
        let slopes = nalgebra::DVector::from_iterator(covariance.nrows(), (0..covariance.nrows()).map(slope));
        let error = slopes.dot(&(covariance * &slopes)).sqrt();
        error.is_finite().then_some(error)
    }

    /// Models about this one that stand for what it may be, each with its weight: mean and variance of a smooth number over them are those over
    /// the errors of the slow terms (unscented transform; Julier and Uhlmann 1997). Without known errors it is this model alone.
    pub fn about(&self) -> Vec<(f64, NoiseModel)> {
        let errors = &self.standard_errors;
        let slow = [
            (errors.drift, (|model| &mut model.drift) as fn(&mut NoiseModel) -> &mut f64),
            (errors.drift_time, |model| &mut model.drift_time),
            (errors.walk, |model| &mut model.walk),
        ];
        let known: Vec<_> = slow.into_iter().filter_map(|(error, of)| error.map(|error| (error.min(MOST_ERROR), of))).collect();
        // n numbers: weight 1/6 at ±√3 standard deviations of each, the rest in the middle
        let shifted = |error: f64, of: fn(&mut NoiseModel) -> &mut f64| {
            let mut model = self.model;
            *of(&mut model) *= (3.0_f64.sqrt() * error).exp();
            (1.0 / 6.0, model)
        };
        let around = known.iter().flat_map(|&(error, of)| [shifted(error, of), shifted(-error, of)]);
        let middle = 1.0 - known.len() as f64 / 3.0;
        std::iter::once((middle, self.model)).chain(around).filter(|(weight, _)| *weight > 1e-9).collect()
    }
}

impl NoiseModel {
    /// Averaging time \[s\] between the ends given at which the Allan deviation is least, and that deviation \[u\]; `None` where the deviation still
    /// falls at the longer end: it has no floor there, nor between ends that are not 0 < shortest ≤ longest < ∞. `interval` is that of the rows \[s\].
    pub fn floor(&self, [shortest, longest]: [f64; 2], interval: f64) -> Option<(f64, f64)> {
        if !(shortest > 0.0 && shortest <= longest && longest.is_finite()) {
            return None;
        }
        let steps = (PER_OCTAVE * (longest / shortest).log2()).ceil().max(1.0);
        let tau = |n: usize| shortest * (longest / shortest).powf(n as f64 / steps);
        let deviation = |n: usize| self.allan_deviation(tau(n), interval);
        let least = (0..=steps as usize).min_by(|a, b| deviation(*a).total_cmp(&deviation(*b)))?;
        (least < steps as usize).then(|| (tau(least), deviation(least)))
    }
}

/// Largest error of a logarithm that is taken as it is: beyond, the likelihood is no parabola.
const MOST_ERROR: f64 = 1.0;
/// Averaging times in an octave at which the floor is sought: the deviation is flat there, and known to 1e-3 of itself.
const PER_OCTAVE: f64 = 16.0;

#[cfg(test)]
mod tests {
    use super::*;

    /// White noise N and a walk K have the least Allan deviation √(2 N K/√3) at √3 N/K.
    #[test]
    fn exact_the_floor_of_white_noise_and_a_walk() {
        // the least at one of the sixteenths of an octave
        let tau = 2.0 * (23.0_f64 / 16.0).exp2();
        let model = NoiseModel { walk: 3.0_f64.sqrt() / tau, ..NoiseModel::white(1.0, 1.0) };
        let (at, least) = model.floor([2.0, 16.0], 1.0).expect("a floor");
        assert!((at / tau - 1.0).abs() < 1e-12 && (least / (2.0 / tau).sqrt() - 1.0).abs() < 1e-12, "{at} {least}");
    }

    #[test]
    fn what_falls_to_the_longer_end_has_no_floor() {
        assert_eq!(NoiseModel::white(1.0, 1.0).floor([2.0, 16.0], 1.0), None);
        let drifts = NoiseModel { walk: 1.0, ..NoiseModel::white(1.0, 1.0) };
        for ends in [[0.0, 10.0], [-1.0, 10.0], [1.0, f64::INFINITY], [16.0, 2.0], [f64::NAN, 2.0], [1.0, f64::NAN]] {
            assert_eq!(drifts.floor(ends, 1.0), None, "{ends:?}");
        }
        // what rises from the shorter end on has it there
        let walk = NoiseModel { walk: 1.0, ..NoiseModel::white(1e-9, 1.0) };
        assert_eq!(walk.floor([2.0, 16.0], 1.0).map(|(at, _)| at), Some(2.0));
    }
}
