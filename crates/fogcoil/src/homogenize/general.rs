//! Cells of any arrangement: constants along x, y, z at each temperature, their spread over realisations.

use homogenization::Constants;
use homogenization::irregular::{Cell, HomogenizedCell};
use serde_json::{Map, Value, json};

use super::presentation;
use crate::Error;
use crate::input::GeneralCase;
use crate::table::{plus_minus, significant, table};

/// The constants of a cell at one temperature.
pub struct AtTemperature {
    /// The temperature \[°C\]; none if the constituents do not depend on it.
    pub celsius: Option<f64>,
    /// The first (mostly the only) realisation, with numerical errors and fields.
    pub first: HomogenizedCell,
    /// Mean density \[kg/m³\] and heat capacity of a volume \[J/(m³ K)\], if those of every phase are known.
    heavy: [Option<f64>; 2],
    /// The nearest transversely isotropic constants, mean over realisations.
    pub nearest: Option<Constants>,
    /// How far the realisation that is farthest is from transversely isotropic.
    pub anisotropy: f64,
    /// Mean and standard deviation of each constant over several realisations.
    pub spread: Option<Spread>,
}

/// Statistics over realisations.
pub struct Spread {
    /// How many there are.
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
        responses.push(cell.solve(first.solution.mesh().order(), first.fineness).map_err(failed)?.response().clone());
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

/// Keys, units and meanings of [`AtTemperature::heavy`].
const HEAVY: [[&str; 3]; 2] = [
    ["density_kg_per_m3", "kg/m3", "density"],
    ["heat_capacity_j_per_m3k", "J/(m3 K)", "heat capacity of a volume, thermoelastic part neglected"],
];

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

impl AtTemperature {
    /// The constants in SI under their own names, `error_estimate`, and what else the response says.
    pub fn json(&self) -> Value {
        let object = |pairs: Vec<(&'static str, f64)>| -> Map<String, Value> {
            pairs.into_iter().map(|(key, value)| (key.to_owned(), value.into())).collect()
        };
        let response = &self.first.response;
        let mut all = Map::new();
        if let Some(celsius) = self.celsius {
            all.insert("temperature_c".into(), celsius.into());
        }
        all.append(&mut object(self.first.constants.named()));
        all.insert("error_estimate".into(), object(self.first.relative_error.clone()).into());
        for ([key, ..], value) in HEAVY.into_iter().zip(self.heavy) {
            all.extend(value.map(|value| (key.to_owned(), value.into())));
        }
        all.insert("anisotropy".into(), self.anisotropy.into());
        all.insert("void_fraction".into(), self.void_fraction().into());
        let rows = |m: &nalgebra::Matrix6<f64>| (0..6).map(|i| m.row(i).iter().copied().collect()).collect::<Vec<Vec<f64>>>();
        all.insert("stiffness".into(), json!(rows(&response.stiffness)));
        all.insert("thermal_stress".into(), json!(response.thermal_stress.as_slice()));
        if let Some(nearest) = &self.nearest {
            all.insert("transversely_isotropic".into(), object(nearest.named().to_vec()).into());
        }
        if let Some(spread) = &self.spread {
            let names = || self.first.constants.named().into_iter().map(|(name, _)| name);
            let of = |values: &[f64]| object(names().zip(values.iter().copied()).collect());
            let all_of =
                json!({"realisations": spread.count, "mean": of(&spread.mean), "standard_deviation": of(&spread.deviation)});
            all.insert("spread".into(), all_of);
        }
        all.into()
    }

    fn void_fraction(&self) -> f64 {
        let share = 1.0 - self.first.response.fractions.iter().sum::<f64>();
        // rounding of areas is no void
        if share.abs() < 1e-9 { 0.0 } else { share }
    }

    /// The constants as a table with units and numerical errors.
    pub fn text(&self, case: &GeneralCase) -> String {
        let mut rows = vec![["constant", "value", "numerical error"].map(String::from).to_vec()];
        if self.spread.is_some() {
            rows[0].extend(["mean of all", "standard deviation"].map(String::from));
        }
        rows[0].extend(["unit", "meaning"].map(String::from));
        let constants = self.first.constants.named().into_iter().zip(&self.first.relative_error);
        for (i, ((key, value), (_, relative))) in constants.enumerate() {
            let (unit, convert, meaning) = presentation(key);
            // what vanishes in symmetric cells has an error relative to its kind's size, which says nothing here
            let error = if vanishing(key) { "-".into() } else { plus_minus(relative * convert(value).abs()) };
            let mut row = vec![key.into(), significant(convert(value), 6), error];
            if let Some(spread) = &self.spread {
                row.extend([significant(convert(spread.mean[i]), 6), significant(convert(spread.deviation[i]), 2)]);
            }
            row.extend([unit.into(), meaning.into()]);
            rows.push(row);
        }
        for ([key, unit, meaning], value) in HEAVY.into_iter().zip(self.heavy) {
            let gap = vec![String::new(); rows[0].len() - 4];
            let row = |value| [vec![key.into(), significant(value, 6)], gap, vec![unit.into(), meaning.into()]].concat();
            rows.extend(value.map(row));
        }
        let at = self.celsius.map_or(String::new(), |t| format!(" at {t} degC"));
        let fibres = case.layouts[0].inclusions().len();
        let mut text = format!(
            "{}{at}: effective constants; z = fibre (the coil's hoop), x and y across it\n\n{}\n",
            case.name,
            table(&rows)
        );
        let response = &self.first.response;
        text += &format!(
            "{fibres} inclusions, {} elements of order {}, {} unknowns; void {:.3} % of the area; the errors are numerical, they say nothing about the \
             constituents\nnot transversely isotropic by {:.2e}: the largest relative difference of strain energy from the mean over all turns about z\n",
            self.first.solution.mesh().elements().len(),
            self.first.solution.mesh().order(),
            response.unknowns,
            100.0 * self.void_fraction(),
            self.anisotropy
        );
        if let Some(t) = &self.nearest {
            let line = [
                ("e_z_gpa", t.e_z / 1e9),
                ("e_r_mpa", t.e_r / 1e6),
                ("g_zr_mpa", t.g_zr / 1e6),
                ("nu_zr", t.nu_zr),
                ("nu_r", t.nu_r),
                ("k_z", t.k_z),
                ("k_r", t.k_r),
                ("m_rx = m_ry", t.m_rx),
                ("m_rz", t.m_rz),
            ];
            let line = line.map(|(key, value)| format!("{key} {}", significant(value, 6)));
            text += &format!(
                "that mean, for a coil: {}, alpha_z {:.5e}, alpha_r {:.5e}, m_rt {:.5e} 1/K\n",
                line.join(", "),
                t.alpha_z,
                t.alpha_r,
                t.m_rt
            );
        }
        if let Some(spread) = &self.spread {
            let count = spread.count;
            text += &format!(
                "value and errors are of the first of {count} realisations, the mean for a coil of all, the distance of the farthest\n"
            );
        }
        text
    }
}

fn vanishing(key: &str) -> bool {
    ["alpha_xy", "k_xy", "m_rxy"].contains(&key)
}
