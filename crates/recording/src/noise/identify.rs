//! The noise of a recording from the recording itself, by maximum likelihood.

use super::data::{Data, Series};
use super::regression::Regression;
use super::{NoiseModel, Whitener};
use crate::Error;
use crate::median_interval;
use crate::minimise::{Effort, nelder_mead};
use nalgebra::{Cholesky, DMatrix};

/// A term of the noise beside the white one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Term {
    /// Exponentially correlated drift.
    Drift,
    /// Rate random walk.
    Walk,
    /// Quantisation of the integrated rate.
    Quantisation,
}

/// Where the noise is sought.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// Span of a sample \[s\]; see [`NoiseModel`].
    pub averaging: f64,
    /// Shortest and longest correlation time of the drift \[s\].
    pub drift_time: [f64; 2],
    /// The terms that are tried, alone and together; white noise is always there.
    pub terms: Vec<Term>,
}

impl Bounds {
    /// Drift and walk; correlation times from four median intervals to the whole length.
    pub fn new(averaging: f64, time: &[f64]) -> Self {
        let length = time.last().copied().unwrap_or(1.0) - time.first().copied().unwrap_or(0.0);
        let shortest = 4.0 * median_interval(time).unwrap_or(1.0);
        Self { averaging, drift_time: [shortest, length.max(2.0 * shortest)], terms: vec![Term::Drift, Term::Walk] }
    }
}

/// Standard error of the natural logarithm of each parameter (for small ones: its relative standard error).
///
/// `None` where the term is absent, or where the likelihood has no maximum inside the bounds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StandardErrors {
    /// Uncertainty of the white noise.
    pub white: Option<f64>,
    /// Uncertainty of the drift's standard deviation.
    pub drift: Option<f64>,
    /// Uncertainty of its correlation time.
    pub drift_time: Option<f64>,
    /// Uncertainty of the rate random walk.
    pub walk: Option<f64>,
    /// Uncertainty of the quantisation.
    pub quantisation: Option<f64>,
}

impl StandardErrors {
    /// From the covariance of the logarithms: white, then as in the terms.
    fn of(terms: &[Term], covariance: &DMatrix<f64>) -> Self {
        let variances = covariance.diagonal();
        let mut sds = variances.iter().map(|variance| variance.sqrt());
        let mut errors = Self { white: sds.next(), ..Self::default() };
        for term in terms {
            match term {
                Term::Drift => (errors.drift, errors.drift_time) = (sds.next(), sds.next()),
                Term::Walk => errors.walk = sds.next(),
                Term::Quantisation => errors.quantisation = sds.next(),
            }
        }
        errors
    }
}

/// One combination of terms at its best.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The terms beside white noise.
    pub terms: Vec<Term>,
    /// Its best parameters.
    pub model: NoiseModel,
    /// Log likelihood, the columns' amounts integrated out (restricted likelihood; Patterson and Thompson 1971).
    pub log_likelihood: f64,
    /// −2 log likelihood + (number of parameters) ln (number of rows).
    pub bic: f64,
}

/// The noise of a series.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseEstimate {
    /// The best model.
    pub model: NoiseModel,
    /// Standard errors of its parameters.
    pub standard_errors: StandardErrors,
    /// Its log likelihood; comparable between candidates of one call only.
    pub log_likelihood: f64,
    /// The terms that are significant: those of the least BIC.
    pub terms: Vec<Term>,
    /// All combinations tried, best first.
    pub candidates: Vec<Candidate>,
    /// Values used.
    pub rows: usize,
    /// Rows averaged into one value; 1 unless the series is very long.
    pub group: usize,
    /// Covariance of the logarithms of the parameters: white, then as in the terms.
    pub(super) covariance: Option<DMatrix<f64>>,
}

/// Sizes of terms relative to the white noise of a value.
const RELATIVE: [f64; 2] = [1e-3, 1e4];
/// Accuracy of a log likelihood, far below what decides anything, and evaluations that reach it several times over.
const EFFORT: Effort = Effort { tolerance: 1e-5, evaluations: 1000 };
/// Edge of the first simplex: the variables are logarithms.
const EDGE: f64 = 0.7;

/// Finds the noise model that makes a series most likely, with as many terms as the BIC allows.
///
/// The likelihood is exact: the innovations of [`Whitener`]. The scale is eliminated in closed form, the ratios of the terms and the
/// correlation time are searched from a grid by Nelder and Mead.
///
/// # Errors
/// [`Error::Length`], [`Error::Time`], [`Error::Value`] for bad series; [`Error::Parameter`] for bad bounds; [`Error::TooFew`];
/// [`Error::NoNoise`] if nothing but rounding is left beside the columns.
pub fn identify(series: &Series, bounds: &Bounds) -> Result<NoiseEstimate, Error> {
    let data = Data::new(series)?;
    check_bounds(bounds)?;
    let problem = Problem { data: &data, bounds };
    let mut candidates: Vec<(Candidate, Vec<f64>)> = Vec::new();
    for terms in subsets(bounds) {
        candidates.push(problem.fit(&terms)?);
    }
    candidates.sort_by(|a, b| a.0.bic.total_cmp(&b.0.bic));
    let (best, shape) = candidates[0].clone();
    let covariance = problem.covariance(&best, &shape)?;
    Ok(NoiseEstimate {
        model: best.model,
        standard_errors: covariance.as_ref().map_or_else(StandardErrors::default, |known| StandardErrors::of(&best.terms, known)),
        covariance,
        log_likelihood: best.log_likelihood,
        terms: best.terms,
        candidates: candidates.into_iter().map(|(candidate, _)| candidate).collect(),
        rows: data.rows(),
        group: data.group,
    })
}

/// Residual of a series when the columns are taken off in the amounts that are best under the model; NaN in rows that are not used.
///
/// # Errors
/// As [`identify`].
pub fn residual(series: &Series, model: &NoiseModel) -> Result<Vec<f64>, Error> {
    let data = Data::new(series)?;
    let whitener = Whitener::new(&data.model(model), &data.time, &data.mask)?;
    let columns = data.columns.iter().map(|column| whitener.apply(column)).collect();
    let amounts = Regression::new(columns, whitener.apply(&data.values)).amounts;
    let rest = |row: usize| {
        let taken = |(amount, &number): (&f64, &usize)| amount * series.columns[number][row];
        series.values[row] - amounts.iter().zip(&data.numbers).map(taken).sum::<f64>()
    };
    Ok((0..series.time.len()).map(|row| if series.mask[row] { rest(row) } else { f64::NAN }).collect())
}

fn check_bounds(bounds: &Bounds) -> Result<(), Error> {
    let [shortest, longest] = bounds.drift_time;
    NoiseModel { drift_time: shortest, ..NoiseModel::white(1.0, bounds.averaging) }.check()?;
    if longest.is_finite() && longest >= shortest {
        return Ok(());
    }
    Err(Error::Parameter { name: "drift_time", value: longest, range: "finite and not less than the shortest" })
}

/// Every combination of the terms, none first.
fn subsets(bounds: &Bounds) -> Vec<Vec<Term>> {
    let possible = |term: Term| bounds.terms.contains(&term) && (term != Term::Quantisation || bounds.averaging > 0.0);
    let all: Vec<Term> = [Term::Drift, Term::Walk, Term::Quantisation].into_iter().filter(|term| possible(*term)).collect();
    let subset = |bits: usize| all.iter().enumerate().filter(|(i, _)| bits >> i & 1 == 1).map(|(_, term)| *term).collect();
    (0..1 << all.len()).map(subset).collect()
}

struct Problem<'a> {
    data: &'a Data,
    bounds: &'a Bounds,
}

impl Problem<'_> {
    fn rows(&self) -> f64 {
        self.data.rows() as f64
    }

    fn spacing(&self) -> f64 {
        self.data.interval * self.data.group as f64
    }

    /// Bounds of the logarithms that shape a model: a drift's size and time, a walk's size, a quantisation's size.
    fn shape_bounds(&self, terms: &[Term]) -> Vec<[f64; 2]> {
        let relative = RELATIVE.map(f64::ln);
        let of = |term: &Term| match term {
            Term::Drift => vec![relative, self.bounds.drift_time.map(f64::ln)],
            Term::Walk | Term::Quantisation => vec![relative],
        };
        terms.iter().flat_map(of).collect()
    }

    /// Points from which the best is searched.
    fn grid(&self, terms: &[Term]) -> Vec<Vec<f64>> {
        let [shortest, longest] = self.bounds.drift_time;
        let times = [0.1, 0.35, 0.6, 0.85].map(|share: f64| (shortest.ln() * (1.0 - share) + longest.ln() * share).exp());
        let of = |term: &Term| match term {
            Term::Drift => vec![[0.1, 0.5, 2.0].to_vec(), times.to_vec()],
            Term::Walk => vec![[0.01, 0.1, 0.5].to_vec()],
            Term::Quantisation => vec![[0.2, 2.0].to_vec()],
        };
        let axes: Vec<Vec<f64>> = terms.iter().flat_map(of).collect();
        let extend = |points: Vec<Vec<f64>>, axis: &Vec<f64>| -> Vec<Vec<f64>> {
            points.iter().flat_map(|point| axis.iter().map(|x| [&point[..], &[x.ln()]].concat())).collect()
        };
        axes.iter().fold(vec![Vec::new()], extend)
    }

    /// The model of a row of the original: white noise and the logarithms of the others' sizes relative to that of a value.
    fn model(&self, terms: &[Term], white: f64, shape: &[f64]) -> NoiseModel {
        let mut model = NoiseModel::white(white, self.bounds.averaging);
        let value = white / (self.data.group as f64).sqrt();
        let mut shape = shape.iter().map(|x| x.exp());
        let mut next = || shape.next().unwrap_or(1.0);
        for term in terms {
            match term {
                Term::Drift => (model.drift, model.drift_time) = (value * next(), next()),
                Term::Walk => model.walk = value * next() / self.spacing().sqrt(),
                Term::Quantisation => model.quantisation = value * next() * self.data.model(&model).averaging,
            }
        }
        model
    }

    /// Sum of squares and log determinants of whitened series and columns.
    fn squares(&self, model: &NoiseModel) -> Result<(f64, f64), Error> {
        let whitener = Whitener::new(&self.data.model(model), &self.data.time, &self.data.mask)?;
        let columns = self.data.columns.iter().map(|column| whitener.apply(column)).collect();
        let regression = Regression::new(columns, whitener.apply(&self.data.values));
        Ok((regression.squares, whitener.log_det() + regression.log_det))
    }

    fn freedom(&self) -> f64 {
        self.rows() - self.data.columns.len() as f64
    }

    fn log_likelihood(&self, model: &NoiseModel) -> Result<f64, Error> {
        let (squares, log_det) = self.squares(model)?;
        Ok(-0.5 * (squares + log_det + self.freedom() * std::f64::consts::TAU.ln()))
    }

    /// White noise and log likelihood of a shape.
    fn profile(&self, terms: &[Term], shape: &[f64]) -> Result<(f64, f64), Error> {
        let (squares, log_det) = self.squares(&self.model(terms, 1.0, shape))?;
        let variance = squares / self.freedom();
        let log_likelihood = -0.5 * (self.freedom() * ((std::f64::consts::TAU * variance).ln() + 1.0) + log_det);
        Ok((variance.sqrt(), log_likelihood))
    }

    fn fit(&self, terms: &[Term]) -> Result<(Candidate, Vec<f64>), Error> {
        let scale = self.data.values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        let (white, _) = self.profile(&[], &[])?;
        if white <= 1e-13 * scale {
            return Err(Error::NoNoise);
        }
        let limits = self.shape_bounds(terms);
        // every model in the box is valid, so that the function is finite; infinity is refused like a wall
        let cost = |shape: &[f64]| self.profile(terms, shape).map_or(f64::INFINITY, |(_, log_likelihood)| -log_likelihood);
        let grid = self.grid(terms);
        let start = grid.into_iter().map(|point| (cost(&point), point)).min_by(|a, b| a.0.total_cmp(&b.0));
        let start = start.map_or_else(Vec::new, |(_, point)| point);
        let edges: Vec<f64> =
            start.iter().zip(&limits).map(|(x, [_, high])| if x + EDGE <= *high { EDGE } else { -EDGE }).collect();
        let (shape, _) = nelder_mead(cost, &start, &edges, &limits, EFFORT);
        let (white, log_likelihood) = self.profile(terms, &shape)?;
        let parameters = 1.0 + shape.len() as f64;
        let bic = -2.0 * log_likelihood + parameters * self.rows().ln();
        let model = self.model(terms, white, &shape);
        Ok((Candidate { terms: terms.to_vec(), model, log_likelihood, bic }, shape))
    }

    /// Covariance of the logarithms of the parameters, from the curvature of the log likelihood.
    fn covariance(&self, best: &Candidate, shape: &[f64]) -> Result<Option<DMatrix<f64>>, Error> {
        let margin = 2.0 * CURVATURE_STEP;
        let inside =
            shape.iter().zip(self.shape_bounds(&best.terms)).all(|(x, [low, high])| *x > low + margin && *x < high - margin);
        Ok(Cholesky::new(self.curvature(best)?).filter(|_| inside).map(|factor| factor.inverse()))
    }

    /// Minus the second derivatives, by central differences; order: white, then as in the terms.
    fn curvature(&self, best: &Candidate) -> Result<DMatrix<f64>, Error> {
        let count = 1 + self.shape_bounds(&best.terms).len();
        let at = |changes: &[(usize, f64)]| -> Result<f64, Error> {
            let mut model = best.model;
            for &(number, change) in changes {
                *parameter(&mut model, &best.terms, number) *= change.exp();
            }
            self.log_likelihood(&model)
        };
        let h = CURVATURE_STEP;
        let second = |i: usize, j: usize| -> Result<f64, Error> {
            if i == j {
                return Ok((2.0 * best.log_likelihood - at(&[(i, h)])? - at(&[(i, -h)])?) / (h * h));
            }
            let corner = |a: f64, b: f64| at(&[(i, a * h), (j, b * h)]);
            Ok((corner(1.0, -1.0)? + corner(-1.0, 1.0)? - corner(1.0, 1.0)? - corner(-1.0, -1.0)?) / (4.0 * h * h))
        };
        // symmetric by construction: both halves are the same differences
        let rows: Vec<f64> = (0..count * count)
            .map(|k| second((k / count).max(k % count), (k / count).min(k % count)))
            .collect::<Result<_, _>>()?;
        Ok(DMatrix::from_vec(count, count, rows))
    }
}

/// A parameter of a model with these terms, by its number: white, then as in the terms.
pub(super) fn parameter<'m>(model: &'m mut NoiseModel, terms: &[Term], number: usize) -> &'m mut f64 {
    let names = terms.iter().flat_map(|term| match term {
        Term::Drift => vec![1, 2],
        Term::Walk => vec![3],
        Term::Quantisation => vec![4],
    });
    match std::iter::once(0).chain(names).nth(number) {
        Some(1) => &mut model.drift,
        Some(2) => &mut model.drift_time,
        Some(3) => &mut model.walk,
        Some(4) => &mut model.quantisation,
        _ => &mut model.white,
    }
}

/// Step of the second derivatives in the logarithms.
const CURVATURE_STEP: f64 = 0.05;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curvature_along_the_scale_is_exact() {
        // sizes scaled together by eᵃ: −ln L = (freedom) a + ½ squares e^(−2a), whose second derivative at the best is 2 freedom
        let time: Vec<f64> = (0..400).map(f64::from).collect();
        let values: Vec<f64> = (0..400).map(|i| f64::from((i * i) % 37) + 20.0 * (f64::from(i) / 60.0).sin()).collect();
        let series = Series { time: &time, values: &values, mask: &[true; 400], columns: &[&[1.0; 400]] };
        let (data, bounds) = (Data::new(&series).unwrap(), Bounds::new(1.0, &time));
        let problem = Problem { data: &data, bounds: &bounds };
        let (best, _) = problem.fit(&[Term::Drift]).unwrap();
        let curvature = problem.curvature(&best).unwrap();
        let along: f64 = curvature.view((0, 0), (2, 2)).sum();
        assert!((along / (2.0 * problem.freedom()) - 1.0).abs() < 0.01, "{along}");
    }
}
