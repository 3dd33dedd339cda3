//! How well the white noise is known: as well as the fit says, unless another look at the record contradicts it.
//!
//! The fit is as good as its model. A line that wanders, a drift of another kind or a thermometer's noise are shared out among the terms that it has, and the
//! curvature of the likelihood does not tell. Two numbers do, which need no model: the differences of neighbours in the rate itself, and the Allan deviation.

use recording::statistics::normal_quantile;

use super::GyroNoise;

/// Relative standard deviation of a standard deviation from fourth differences of so many rows, times their root: √(½ Σ ρ²) with ρ the correlations of the
/// differences of white noise, −56/70, 28/70, −8/70, 1/70; of second differences it is 0.99.
const BY_NEIGHBOURS: f64 = 1.15;
/// Share of the white noise in the variance of the model from which on an Allan deviation tells its size.
const RULES: f64 = 0.5;
/// Standard deviations by which an Allan deviation refutes the model: of the dozens of a table chance makes none.
const REFUTED: f64 = 3.3;

/// Another estimate of the white noise: its ratio to the fitted one, and its relative standard deviation.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Witness {
    ratio: f64,
    error: f64,
}

impl GyroNoise {
    /// Ends of an interval of the white noise, over the fitted one, so many standard deviations to either side: that of the fit, and of whatever contradicts
    /// it. `None` where the likelihood does not tell it apart from other noise.
    pub fn white_ends(&self, sds: f64) -> Option<[f64; 2]> {
        let error = self.estimate.standard_errors.white?;
        Some(around(error, self.witnesses(error), sds))
    }

    /// Larger of the relative standard deviations of the white noise to either side; `None` where it is not known.
    pub fn white_error(&self) -> Option<f64> {
        self.white_ends(1.0).map(|[low, high]| (-low.ln()).max(high.ln()))
    }

    /// Whether something contradicts the fit's own error.
    pub(super) fn is_contradicted(&self) -> bool {
        self.estimate.standard_errors.white.is_some_and(|error| self.witnesses(error).next().is_some() && self.white().is_some())
    }

    /// What contradicts a fit with this relative standard deviation.
    fn witnesses(&self, error: f64) -> impl Iterator<Item = Witness> {
        let fitted = normal_quantile(0.95) * error;
        let outside = self.neighbours().into_iter().filter(move |witness| witness.ratio.ln().abs() > fitted);
        outside.chain(self.refuting())
    }

    fn neighbours(&self) -> Option<Witness> {
        let (sd, rows) = self.neighbours?;
        let white = self.estimate.model.white;
        (white > 0.0).then(|| Witness { ratio: sd / white, error: BY_NEIGHBOURS / (rows as f64).sqrt() })
    }

    /// The Allan deviations that the model does not explain, where its white noise rules: up to the span over the number of slow courses that were taken off
    /// with it, which take the power of as many half waves over the span.
    fn refuting(&self) -> impl Iterator<Item = Witness> {
        let model = &self.estimate.model;
        let span = if model.averaging > 0.0 { model.averaging } else { self.interval };
        let of = move |point: &recording::allan::AllanPoint| {
            let modelled = model.allan_deviation(point.tau, self.interval);
            let rules = model.white.powi(2) * span / point.tau > RULES * modelled.powi(2);
            let witness = Witness { ratio: point.deviation / modelled, error: (0.5 / point.freedom).sqrt() };
            let untouched = point.tau * self.taken_off_count() as f64 <= self.span;
            (rules && untouched && witness.ratio.ln().abs() > REFUTED * witness.error).then_some(witness)
        };
        self.allan.iter().filter_map(of)
    }
}

/// Ends of an interval about 1 that holds every witness with its error.
fn around(error: f64, witnesses: impl Iterator<Item = Witness>, sds: f64) -> [f64; 2] {
    let own = Witness { ratio: 1.0, error };
    let ends = |witness: Witness| [-1.0, 1.0].map(|side: f64| witness.ratio * (side * sds * witness.error).exp());
    witnesses.map(ends).fold(ends(own), |[low, high], [a, b]| [low.min(a), high.max(b)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_interval_holds_what_contradicts_the_fit_with_its_own_error() {
        let of = |ratios: &[f64]| around(0.05, ratios.iter().map(|&ratio| Witness { ratio, error: 0.02 }), 2.0);
        let close = |found: [f64; 2], ends: [f64; 2]| found.iter().zip(ends).all(|(a, b)| (a / b - 1.0).abs() < 1e-12);
        let [own, other] = [0.1_f64.exp(), 0.04_f64.exp()];
        assert!(close(of(&[]), [1.0 / own, own]));
        assert!(close(of(&[0.8]), [0.8 / other, own]));
        assert!(close(of(&[1.3, 0.7]), [0.7 / other, 1.3 * other]));
    }
}
