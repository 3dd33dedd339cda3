//! The optimum, checked by the full model and explained.

use coil::{Band, Design, Layout, STEADY, SteadySensitivity, Tolerances, sensitivity_on};
use rayon::prelude::*;
use winding::wind;

use super::evaluate::Tried;
use super::measure::Measures;
use super::plan::Plan;
use crate::Error;
use crate::input::{CoilCase, warnings};
use crate::sweep::{Points, Sampling};
use crate::variants::{Dimensions, Factor, Value, Variants};

/// An optimum that was checked.
pub struct Checked {
    /// Its design, with the warnings that it has and the drawing has not.
    pub case: CoilCase,
    /// The design that was tried.
    pub tried: Tried,
    /// The sensitivity with its numerical error.
    pub steady: SteadySensitivity,
    /// Its spread by tolerances to first order.
    pub band: Band,
    /// |S| of designs within the tolerances, the least first.
    pub within: Vec<f64>,
    /// Way from the drawing to it, change by change.
    pub path: Vec<Change>,
}

/// A change on the way: key, value, sensitivity then; `None` where there is no design on the way.
pub(super) type Change = (String, String, Option<f64>);

/// Designs within the tolerances.
const UNITS: usize = 256;

/// Checks a design that was tried.
///
/// # Errors
/// [`files::Error::Coil`] if it cannot be modelled.
pub fn check(plan: &Plan, tried: &Tried) -> Result<Checked, Error> {
    let drawn = &plan.variants.case;
    let at = Error::of_coil(&drawn.file);
    let variant = plan.variants.at(&tried.point).map_err(Error::usage)?;
    let winding = wind(&variant.design.winding).map_err(|error| at(error.into()))?;
    let layout = Layout::new(&variant.design).map_err(at)?;
    let mut warnings = warnings(&variant.design, &layout, &winding);
    warnings.retain(|warning| !drawn.warnings.contains(warning));
    let case = CoilCase { design: variant.design, winding, warnings, ..drawn.clone() };
    let (steady, band) = (case.steady_sensitivity()?, case.sensitivity_band()?);
    let within = within(plan, &case);
    Ok(Checked { path: path(plan, tried), case, tried: tried.clone(), steady, band, within })
}

/// |S| of designs within the tolerances of one, sorted.
fn within(plan: &Plan, case: &CoilCase) -> Vec<f64> {
    let factors = Factor::within_tolerances(&case.design, &case.tolerances);
    let points = Points::new(Sampling::LatinHypercube(UNITS), plan.seed, Vec::new(), vec![0; factors.len()]);
    let variants = Variants::new(plan.variants.drawing_of(case.clone()), factors, Dimensions::AsDrawn);
    let of = |n: usize| Some(sensitivity_on(&variants.at(&points.point(n)).ok()?.design, &STEADY).ok()?.total().abs());
    let mut all: Vec<f64> = (0..UNITS).into_par_iter().filter_map(of).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// Effect of each change, in the plan's order, each beside those before it.
fn path(plan: &Plan, tried: &Tried) -> Vec<Change> {
    let mut written: Vec<(usize, Value)> = Vec::new();
    let mut steps = Vec::new();
    for (n, value) in tried.values.iter().enumerate().filter_map(|(n, value)| Some((n, value.clone()?))) {
        let shown = value.shown();
        written.push((n, value));
        let design: Option<Design> = plan.variants.with(&written).ok();
        let sensitivity = design.and_then(|design| Some(sensitivity_on(&design, &STEADY).ok()?.total()));
        steps.push((plan.variants.factors[n].key.clone(), shown, sensitivity));
    }
    steps
}

impl Checked {
    /// Share of the units within the tolerances whose |S| is below a bound.
    pub fn share_below(&self, bound: f64) -> f64 {
        self.within.iter().filter(|magnitude| **magnitude < bound).count() as f64 / self.within.len().max(1) as f64
    }

    /// Value below which 95 % of the units stay, and the largest value.
    pub fn quantiles(&self) -> [f64; 2] {
        let last = self.within.len().saturating_sub(1);
        [(0.95 * last as f64).round() as usize, last].map(|n| self.within.get(n).copied().unwrap_or(f64::NAN))
    }

    /// Its coil file.
    pub fn file(&self, plan: &Plan, drawn: &Measures) -> String {
        let known: &Tolerances = &self.case.tolerances;
        let comment = format!(
            "Chosen by fogcoil optimise: |S| {:.4} in place of {:.4} (deg/h)/(degC/min), one standard deviation by tolerances {:.4}.",
            self.steady.sensitivity.total().abs(),
            drawn.sensitivity.abs(),
            self.band.sd
        );
        let plan = plan.files.first().map(|file| format!("Plan: {}", files::shown_path(&file.file)));
        crate::output::coil_file(&self.case.name, &self.case.design, known, &[vec![comment], plan.into_iter().collect()].concat())
    }
}
