//! Construction of a design's models: full solutions, side by side.

use crate::bond::{self, Bond, FOLLOWED};
use crate::catalogue::debond;
use crate::design::{heatable_flanges, with_heater};
use crate::heat_path::HeatPath;
use crate::library::{Library, Models, unheated};
use crate::mechanism::Mechanism;
use coil::{
    Bonds, COARSE, Design, Error, MechanicalState, Model, ModelEffort, Parameter, ParametricModel, Projected, Range, Side,
    Tolerances,
};
use progress::Step;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The task, as it is told.
const TASK: &str = "modelling the design and what may be left out of it";

/// Relative change of a constant by which a bond's slopes are found: small beside what is left of incompressibility, large beside rounding, and towards where every
/// constant may lie.
const SLOPE: f64 = -1e-3;

/// The paths of heat that a design has, by the ids of their mechanisms and their places.
fn heat_paths(design: &Design, mechanisms: &[&dyn Mechanism]) -> Vec<(String, usize, HeatPath)> {
    let of = |m: &&dyn Mechanism| {
        let facts = m.facts();
        facts.heat_path.map(|path| (facts.id.to_owned(), path))
    };
    let places = |(id, path): (String, HeatPath)| (0..(path.places)(design)).map(move |place| (id.clone(), place, path.clone()));
    mechanisms.iter().filter_map(of).flat_map(places).collect()
}

/// The ranges that a parametric model of `design` must hold for: its parameters' `tolerances`, and from any design within them as far as the
/// `mechanisms` go.
pub fn ranges(design: &Design, tolerances: &Tolerances, mechanisms: &[&dyn Mechanism]) -> Vec<Range> {
    let usual = Range::tolerated(design, tolerances);
    let mut ranges = usual.clone();
    let at_end = |end: fn(&Range) -> f64| usual.iter().fold(design.clone(), |d, range| range.parameter.set(&d, end(range)));
    let tolerated = [design.clone(), at_end(|range| range.low), at_end(|range| range.high)];
    for (_, place, path) in heat_paths(design, mechanisms) {
        for from in &tolerated {
            path.nodes.iter().for_each(|x| Range::widened(&mut ranges, design, &(path.design)(from, place, *x)));
        }
    }
    for side in heatable_flanges(design) {
        Range::widened(&mut ranges, design, &with_heater(design, side, 1.0));
    }
    ranges
}

impl Models {
    /// Makes every model that the `mechanisms` need of a drawing with its tolerances; `progress` is told how many are made.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn build(
        drawing: &Design,
        tolerances: &Tolerances,
        mechanisms: &[&dyn Mechanism],
        progress: &(dyn Fn(Step) + Sync),
    ) -> Result<Self, Error> {
        let design = &unheated(drawing);
        let (open, shares) = (debond::flanges(design), bond::shares(design.winding.layers));
        let of_slopes = bond::of_slopes(&shares);
        let (done, all) = (AtomicUsize::new(0), ModelEffort::default().solutions() + open.len() * shares.len());
        let one = || progress(Step::counted(TASK, done.fetch_add(1, Ordering::Relaxed) + 1, all));
        let mut ranges = ranges(design, tolerances, mechanisms);
        for heater in &drawing.heat.heaters {
            Range::widened(&mut ranges, design, &with_heater(design, heater.side, 1.0));
        }
        let model = ParametricModel::new(design, &ranges, &COARSE, &ModelEffort::default(), &one)?;
        // temperatures at which the bond opens do not matter: both states are known
        let [below, hysteresis] = debond::OPENS;
        let open_at = |design: &Design, side: Side, share: f64| debond::with_opening(design, side, below, hysteresis, share);
        let solved =
            |opened: &Design, bonds| Model::in_state(opened, &COARSE, &MechanicalState { bonds, ..MechanicalState::NOMINAL });
        // the bias as drawn, per relative change of the transverse expansion, and of each constant that is followed, if any is here
        let projected = |side: Side, share: f64, followed: &[Parameter], bonds| -> Result<Vec<Projected>, Error> {
            let full = solved(&open_at(design, side, share), bonds)?;
            let fields = model.fields_on(full.grid())?;
            let [drawn, per_expansion] = full.bias_operator_and_per_expansion()?.map(|operator| fields.project(&operator));
            let slope = |parameter: &Parameter| {
                let Some(value) = parameter.of(design) else { return Ok(drawn.less(&drawn)) };
                let moved = parameter.set(design, (1.0 + SLOPE) * value);
                let operator = solved(&open_at(&moved, side, share), bonds)?.bias_operator()?;
                Ok(fields.project(&operator).less(&drawn).over(SLOPE))
            };
            let slopes = followed.iter().map(slope).collect::<Result<Vec<_>, Error>>()?;
            Ok([drawn, per_expansion].into_iter().chain(slopes).collect())
        };
        let opening = |side: Side, share: f64| -> Result<_, Error> {
            let followed = if of_slopes.contains(&share) { &FOLLOWED[..] } else { &[] };
            let [opened, closed] = [Bonds::Opened, Bonds::Closed].map(|bonds| projected(side, share, followed, bonds));
            one();
            Ok((share, opened?.iter().zip(&closed?).map(|(opened, closed)| opened.less(closed)).collect()))
        };
        let bond = |side: Side| -> Result<_, Error> {
            Ok(Bond::new(shares.par_iter().map(|share| opening(side, *share)).collect::<Result<_, _>>()?))
        };
        let bonds = open.into_iter().map(bond).collect::<Result<_, _>>()?;
        Ok(Self { drawing: drawing.clone(), tolerances: tolerances.clone(), model, bonds })
    }
}

impl Library {
    /// Makes every model that the `mechanisms` need, for the usual tolerances; `progress` is told how many are made.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn build(design: &Design, mechanisms: &[&dyn Mechanism], progress: &(dyn Fn(Step) + Sync)) -> Result<Self, Error> {
        Self::new(Models::build(design, &Tolerances::default(), mechanisms, progress)?, mechanisms)
    }

    /// The models of the drawing itself; the `mechanisms` are those that `models` were built for.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn new(models: Models, mechanisms: &[&dyn Mechanism]) -> Result<Self, Error> {
        let design = unheated(&models.drawing);
        let paths = heat_paths(&design, mechanisms);
        Self::at(Arc::new(models), paths, design, Vec::new())
    }
}
