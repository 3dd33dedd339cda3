//! Effective constants of a general cell at a temperature, and their spread over realisations.

use homogenization::Constants;
use homogenization::irregular::{Cell, HomogenizedCell};

use super::cell_general::GeneralCase;
use crate::Error;

/// The constants of a cell at one temperature.
pub struct AtTemperature {
    /// The temperature \[°C\]; none if the constituents do not depend on it.
    pub celsius: Option<f64>,
    /// The first (mostly the only) realisation, with numerical errors and fields.
    pub first: HomogenizedCell,
    /// Mean density \[kg/m³\] and heat capacity of a volume \[J/(m³ K)\], if those of every phase are known.
    pub heavy: [Option<f64>; 2],
    /// The nearest transversely isotropic constants, mean over realisations.
    pub nearest: Option<Constants>,
    /// Distance of the farthest realisation from transverse isotropy.
    pub anisotropy: f64,
    /// Mean and standard deviation of each constant over several realisations.
    pub spread: Option<Spread>,
}

/// Statistics over realisations.
pub struct Spread {
    /// Number of realisations.
    pub count: usize,
    /// Mean of each constant, in the order of their names.
    pub mean: Vec<f64>,
    /// Standard deviation of each among the realisations.
    pub deviation: Vec<f64>,
}

/// Homogenizes a case at one temperature, each constant of its first realisation to a relative error; the others on elements of the same
/// order and size.
///
/// # Errors
/// [`Error::Usage`] if a table does not cover it; [`Error::Homogenization`] if a cell cannot be solved to it.
pub fn at_temperature(case: &GeneralCase, celsius: Option<f64>, relative_error: f64) -> Result<AtTemperature, Error> {
    let cells: Vec<Cell> = case.layouts.iter().map(|layout| case.cell(layout, celsius)).collect::<Result<_, _>>()?;
    let failed = |source| Error::Homogenization { file: case.file.clone(), source };
    let heavy = [cells[0].density(), cells[0].heat_capacity()].map(|value| value.map_err(failed));
    let [density, heat_capacity] = heavy;
    let first = cells[0].homogenize_to(relative_error).map_err(failed)?;
    let mut responses = vec![first.response.clone()];
    for cell in &cells[1..] {
        responses.push(cell.solve(first.solution.mesh.order(), first.fineness).map_err(failed)?.response);
    }
    let values: Vec<_> = responses.iter().filter_map(|r| r.constants()).map(|c| c.named()).collect();
    let share = 1.0 / responses.len() as f64;
    let all: Option<Vec<Constants>> = responses.iter().map(|r| r.transversely_isotropic()).collect();
    let nearest = all.and_then(|all| {
        let shares = all.iter().map(|one| one.combine(one, |v, _| share * v));
        shares.reduce(|sum, one| sum.combine(&one, |a, b| a + b))
    });
    let anisotropy = responses.iter().map(|r| r.anisotropy).fold(0.0, f64::max);
    let spread = (values.len() > 1).then(|| Spread::new(&values));
    Ok(AtTemperature { celsius, first, heavy: [density?, heat_capacity?], nearest, anisotropy, spread })
}

impl Spread {
    fn new(values: &[Vec<(&'static str, f64)>]) -> Self {
        let count = values.len();
        let over = |i: usize, f: &dyn Fn(f64) -> f64| values.iter().map(|v| f(v[i].1)).sum::<f64>();
        let mean: Vec<f64> = (0..values[0].len()).map(|i| over(i, &|v| v) / count as f64).collect();
        let variance = |i: usize| over(i, &|v| (v - mean[i]).powi(2)) / (count - 1) as f64;
        let deviation = (0..mean.len()).map(|i| variance(i).sqrt()).collect();
        Self { count, mean, deviation }
    }
}
