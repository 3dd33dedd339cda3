//! Amounts of a design's columns, over the noises that may stand beside it.

use super::absent::Absent;
use super::design::{Design, Weights};
use super::estimate::Estimate;
use crate::noise::{Bounds, Fitted, NoiseEstimate, NoiseModel, Series, fitted_within, identify};

/// A design that was fitted.
pub(super) struct Model {
    pub(super) design: Design,
    pub(super) noise: NoiseEstimate,
    /// Amounts under each noise, with its probability.
    fits: Vec<(f64, Fitted)>,
    /// Under white noise of size 1: how well the columns alone tell their amounts.
    plain: Fitted,
}

/// A series without its columns, and the span of its means \[s\].
#[derive(Clone, Copy)]
pub(super) struct Observed<'a> {
    pub(super) time: &'a [f64],
    pub(super) values: &'a [f64],
    pub(super) mask: &'a [bool],
    pub(super) averaging: f64,
}

impl<'a> Observed<'a> {
    fn beside(self, columns: &'a [&'a [f64]]) -> Series<'a> {
        Series { time: self.time, values: self.values, mask: self.mask, columns }
    }
}

/// Noises less probable than this beside the best are left out.
const IMPROBABLE: f64 = 1e-3;
/// Largest share of what tells an amount that may be the thermometer's noise: it takes the square of it off.
const MOST_NOISE: f64 = 0.1;

impl Model {
    /// Identifies the noise beside the columns of a design, and fits these.
    pub(super) fn new(design: Design, observed: Observed) -> Result<Self, Absent> {
        Self::within(design, observed, &[])
    }

    /// The same with sums of amounts that are `known` beforehand to be 0 within 1.
    pub(super) fn within(design: Design, observed: Observed, known: &[Weights]) -> Result<Self, Absent> {
        let columns: Vec<&[f64]> = design.columns.iter().map(Vec::as_slice).collect();
        let series = observed.beside(&columns);
        let noise = identify(&series, &Bounds::new(observed.averaging, observed.time))?;
        let fit = |(probability, model): (f64, NoiseModel)| Ok((probability, fitted_within(&series, &model, known)?));
        let fits = noises(&noise).into_iter().map(fit).collect::<Result<_, Absent>>()?;
        // what is known weighs as much beside a noise of 1 as it does beside the series' own
        let scaled = |row: &Weights| row.iter().map(|(number, weight)| (*number, weight * noise.model.white)).collect();
        let beside: Vec<Weights> = known.iter().map(scaled).collect();
        let plain = fitted_within(&series, &NoiseModel::white(1.0, observed.averaging), &beside)?;
        Ok(Self { design, noise, fits, plain })
    }

    /// A weighted sum of amounts over all noises; an error where the series does not tell it.
    pub(super) fn sum(&self, weights: &Weights) -> Result<Estimate, Absent> {
        let each = self.fits.iter().map(|(p, fit)| fit.sum(weights).map(|(value, sd)| (*p, value, sd)));
        each.collect::<Option<Vec<_>>>().map(|each| Estimate::mixed(&each)).ok_or(Absent::Indistinct)
    }

    /// The same, unless noise of a thermometer's reading \[K\] would tell it nearly as well as the course of the temperature.
    pub(super) fn told(&self, weights: &Weights, reading: f64) -> Result<Estimate, Absent> {
        let (_, sd) = self.plain.sum(weights).ok_or(Absent::Indistinct)?;
        // as a rate in the slowest lag's column, all rows together
        let noise = reading / self.design.lags[0] * (self.noise.rows as f64).sqrt();
        if noise * sd > MOST_NOISE { Err(Absent::Indistinct) } else { self.sum(weights) }
    }

    /// All amounts; 0 where one is not told.
    pub(super) fn amounts(&self) -> Vec<f64> {
        (0..self.design.columns.len()).map(|n| self.sum(&vec![(n, 1.0)]).map_or(0.0, |estimate| estimate.value)).collect()
    }
}

/// The mean over models that are as probable as each other: what they differ by counts as an error.
pub(super) fn over(models: &[Model], of: impl Fn(&Model) -> Result<Estimate, Absent>) -> Result<Estimate, Absent> {
    let share = 1.0 / models.len() as f64;
    let each = models.iter().map(|model| of(model).map(|estimate| (share, estimate.value, estimate.sd)));
    Ok(Estimate::mixed(&each.collect::<Result<Vec<_>, _>>()?))
}

/// The candidates of an identified noise with their probabilities e^(−BIC/2) (Schwarz 1978; Hoeting et al. 1999), the best one spread over the errors of
/// its parameters.
fn noises(noise: &NoiseEstimate) -> Vec<(f64, NoiseModel)> {
    let Some(best) = noise.candidates.first() else { return vec![(1.0, noise.model)] };
    let others = noise.candidates[1..].iter().map(|other| (((best.bic - other.bic) / 2.0).exp(), other.model));
    let mut all: Vec<(f64, NoiseModel)> = noise.about();
    all.extend(others.filter(|(probability, _)| *probability > IMPROBABLE));
    let total: f64 = all.iter().map(|(probability, _)| probability).sum();
    all.iter_mut().for_each(|(probability, _)| *probability /= total);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::noise::Candidate;

    /// A noise that is 3 worse by the BIC is e^(−3/2) times as probable.
    #[test]
    fn exact_noises_have_the_probabilities_of_their_bic() {
        let values: Vec<f64> = (0..400).map(|n| f64::from((n * n / 7) % 2)).collect();
        let (time, mask): (Vec<f64>, Vec<bool>) = (0..400).map(|n| (10.0 * f64::from(n), true)).unzip();
        let series = Series { time: &time, values: &values, mask: &mask, columns: &[&vec![1.0; 400]] };
        let mut noise = identify(&series, &Bounds::new(10.0, &time)).expect("a noise");
        let best = noise.candidates[0].clone();
        noise.candidates =
            vec![best.clone(), Candidate { bic: best.bic + 3.0, ..best.clone() }, Candidate { bic: best.bic + 300.0, ..best }];
        let all = noises(&noise);
        let (about, other) = all.split_at(all.len() - 1);
        let best: f64 = about.iter().map(|(probability, _)| probability).sum();
        assert!(
            (best + other[0].0 - 1.0).abs() < 1e-12 && (other[0].0 / best - (-1.5_f64).exp()).abs() < 1e-12,
            "{best} {other:?}"
        );
    }
}
