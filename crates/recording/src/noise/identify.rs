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
/// `None` where the term is absent, or where the likelihood has no maximum inside the bounds: see [`NoiseEstimate::at_edge`].
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
    /// From the covariance of the logarithms of these parameters, without those at an edge.
    fn of(parameters: &[Parameter], covariance: &DMatrix<f64>, at_edge: &[Parameter]) -> Self {
        let mut errors = Self::default();
        for (parameter, variance) in parameters.iter().zip(covariance.diagonal().iter()) {
            let error = Some(variance.sqrt()).filter(|_| !at_edge.contains(parameter));
            match parameter {
                Parameter::White => errors.white = error,
                Parameter::Drift => errors.drift = error,
                Parameter::DriftTime => errors.drift_time = error,
                Parameter::Walk => errors.walk = error,
                Parameter::Quantisation => errors.quantisation = error,
            }
        }
        errors
    }
}

/// A parameter of a [`NoiseModel`] that is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parameter {
    /// The white noise.
    White,
    /// The drift's standard deviation.
    Drift,
    /// Its correlation time.
    DriftTime,
    /// The rate random walk.
    Walk,
    /// The quantisation.
    Quantisation,
}

impl Parameter {
    /// Those of a model with these terms.
    pub(super) fn all(terms: &[Term]) -> Vec<Self> {
        let of = |term: &Term| match term {
            Term::Drift => vec![Self::Drift, Self::DriftTime],
            Term::Walk => vec![Self::Walk],
            Term::Quantisation => vec![Self::Quantisation],
        };
        std::iter::once(Self::White).chain(terms.iter().flat_map(of)).collect()
    }

    pub(super) fn of(self, model: &mut NoiseModel) -> &mut f64 {
        match self {
            Self::White => &mut model.white,
            Self::Drift => &mut model.drift,
            Self::DriftTime => &mut model.drift_time,
            Self::Walk => &mut model.walk,
            Self::Quantisation => &mut model.quantisation,
        }
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
    /// Parameters of which the series tells only that they are no smaller, or no larger, than the model's: the likelihood is greatest at an end of the
    /// search. A drift's size is one with its time. The errors of the others are those at this end.
    pub at_edge: Vec<Parameter>,
    /// All combinations tried, best first.
    pub candidates: Vec<Candidate>,
    /// Values used.
    pub rows: usize,
    /// Rows averaged into one value; 1 unless the series is very long.
    pub group: usize,
    /// Covariance of the logarithms of [`Parameter::all`]; what stands at an end of the search is held there.
    pub(super) covariance: Option<DMatrix<f64>>,
}

/// Share of the least size relative to white noise that a series can tell at which the search for it ends.
const UNSEEN: f64 = 0.01;
/// Accuracy of a log likelihood, far below what decides anything, and evaluations that reach it several times over.
const EFFORT: Effort = Effort { tolerance: 1e-5, evaluations: 1000 };
/// Edge of the first simplex: the variables are logarithms.
const EDGE: f64 = 0.7;

/// Finds the noise model that makes a series most likely, with as many terms as the BIC allows.
///
/// An offset is no noise: the series may have any, whether or not one is among its columns.
///
/// The likelihood is exact: the innovations of [`Whitener`]. The scale is eliminated in closed form, the ratios of the terms and the
/// correlation time are searched from a grid by Nelder and Mead.
///
/// # Errors
/// [`Error::Length`], [`Error::Time`], [`Error::Value`] for bad series; [`Error::Parameter`] for bad bounds; [`Error::TooFew`];
/// [`Error::NoNoise`] if nothing but rounding is left beside the columns.
pub fn identify(series: &Series, bounds: &Bounds) -> Result<NoiseEstimate, Error> {
    let data = Data::with_offset(series)?;
    check_bounds(bounds)?;
    let problem = Problem { data: &data, bounds };
    let mut candidates: Vec<(Candidate, Vec<f64>)> = Vec::new();
    for terms in subsets(bounds) {
        candidates.push(problem.fit(&terms)?);
    }
    candidates.sort_by(|a, b| a.0.bic.total_cmp(&b.0.bic));
    let (best, shape) = candidates[0].clone();
    let (parameters, at_edge) = (Parameter::all(&best.terms), problem.at_edge(&best.terms, &shape));
    let covariance = problem.covariance(&best, &at_edge)?;
    let errors = |known| StandardErrors::of(&parameters, known, &at_edge);
    Ok(NoiseEstimate {
        model: best.model,
        standard_errors: covariance.as_ref().map_or_else(StandardErrors::default, errors),
        covariance,
        at_edge,
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

    /// Length of the series in spacings.
    fn length(&self) -> f64 {
        let span = self.data.time.last().zip(self.data.time.first()).map_or(0.0, |(last, first)| last - first);
        (span / self.spacing()).max(self.rows())
    }

    /// Bounds of the logarithms that shape a model: a drift's size and time, a walk's size, a quantisation's size.
    ///
    /// Of sizes relative to the white noise of a value a series of n values tells, in magnitude, a walk from 1/n to n^¼, a drift from n^−½ to n^¾, and a
    /// quantisation from n^−¼ to n: all lie between 1/n and n.
    fn shape_bounds(&self, terms: &[Term]) -> Vec<[f64; 2]> {
        let least = UNSEEN / self.length();
        let relative = [least, least.recip()].map(f64::ln);
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
        // a walk that few values tell, and by decades one that the whole length does
        let decades = (0.1 * self.length()).log10().floor().max(2.0) as i32;
        let walks: Vec<f64> = (1..=decades).rev().map(|decade| 0.1_f64.powi(decade)).chain([0.5]).collect();
        let of = |term: &Term| match term {
            Term::Drift => vec![[0.1, 0.5, 2.0].to_vec(), times.to_vec()],
            Term::Walk => vec![walks.clone()],
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

    /// What a shape at an end of the search leaves untold. A size at its lower end is itself untold; one at its upper end has no white noise beside it.
    fn at_edge(&self, terms: &[Term], shape: &[f64]) -> Vec<Parameter> {
        let margin = 2.0 * CURVATURE_STEP;
        let mut untold = Vec::new();
        let shaping = Parameter::all(terms).into_iter().skip(1);
        for ((parameter, x), [low, high]) in shaping.zip(shape).zip(self.shape_bounds(terms)) {
            match (parameter, *x <= low + margin, *x >= high - margin) {
                (_, false, false) => {}
                (Parameter::DriftTime, ..) => untold.extend([Parameter::Drift, parameter]),
                (_, true, _) => untold.push(parameter),
                (_, false, true) => untold.push(Parameter::White),
            }
        }
        untold
    }

    /// Covariance of the logarithms of the parameters, from the curvature of the log likelihood; what is held at an end of the search has none.
    fn covariance(&self, best: &Candidate, at_edge: &[Parameter]) -> Result<Option<DMatrix<f64>>, Error> {
        // of a drift whose time is held the size at that time is told
        let is_held = |parameter: &Parameter| match parameter {
            Parameter::Drift if at_edge.contains(&Parameter::DriftTime) => false,
            other => at_edge.contains(other),
        };
        let parameters = Parameter::all(&best.terms);
        let free: Vec<usize> = (0..parameters.len()).filter(|n| !is_held(&parameters[*n])).collect();
        let curvature = self.curvature(best)?.select_rows(&free).select_columns(&free);
        Ok(Cholesky::new(curvature).map(|factor| {
            let known = factor.inverse();
            let mut covariance = DMatrix::zeros(parameters.len(), parameters.len());
            for (i, row) in free.iter().enumerate() {
                for (j, column) in free.iter().enumerate() {
                    covariance[(*row, *column)] = known[(i, j)];
                }
            }
            covariance
        }))
    }

    /// Minus the second derivatives, by central differences; in the order of [`Parameter::all`].
    fn curvature(&self, best: &Candidate) -> Result<DMatrix<f64>, Error> {
        let parameters = Parameter::all(&best.terms);
        let count = parameters.len();
        let at = |changes: &[(usize, f64)]| -> Result<f64, Error> {
            let mut model = best.model;
            for &(number, change) in changes {
                *parameters[number].of(&mut model) *= change.exp();
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
