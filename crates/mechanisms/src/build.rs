//! Construction of a design's models: full solutions, side by side.

use crate::catalogue::debond;
use crate::design::{heatable_flanges, with_heater};
use crate::heat_path::HeatPath;
use crate::library::{Library, Models, Opened, unheated};
use crate::mechanism::Mechanism;
use coil::{Bonds, COARSE, Design, Error, MechanicalState, Model, ModelEffort, ParametricModel, Range, Side, Tolerances};
use progress::Step;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The task, as it is told.
const TASK: &str = "modelling the design and what may be left out of it";

/// Open shares of a bond that are tabulated: the response follows the layers of the winding, steps and all.
const OPEN: [f64; 23] = [
    0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.125, 0.15, 0.18, 0.21, 0.25, 0.3, 0.36, 0.44, 0.53, 0.62, 0.71,
    0.8, 0.9,
];

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
        let open = debond::flanges(design);
        let (done, all) = (AtomicUsize::new(0), ModelEffort::default().solutions() + open.len() * OPEN.len());
        let one = || progress(Step::counted(TASK, done.fetch_add(1, Ordering::Relaxed) + 1, all));
        let mut ranges = ranges(design, tolerances, mechanisms);
        for heater in &drawing.heat.heaters {
            Range::widened(&mut ranges, design, &with_heater(design, heater.side, 1.0));
        }
        let model = ParametricModel::new(design, &ranges, &COARSE, &ModelEffort::default(), &one)?;
        // temperatures at which the bond opens do not matter: both states are known
        let [below, hysteresis] = debond::OPENS;
        let opening = |side: Side, share: f64| -> Result<_, Error> {
            let opened = debond::with_opening(design, side, below, hysteresis, share);
            let at = |bonds, transverse_expansion| {
                let state = MechanicalState { bonds, transverse_expansion, ..MechanicalState::NOMINAL };
                model.project(&Model::in_state(&opened, &COARSE, &state)?)
            };
            let change = |factor| Ok::<_, Error>(at(Bonds::Opened, factor)?.less(&at(Bonds::Closed, factor)?));
            // strains are linear in what expands
            let (drawn, doubled) = (change(1.0)?, change(2.0)?);
            one();
            Ok(Opened { share, per_expansion: doubled.less(&drawn), drawn })
        };
        let of_flange = |side: Side| OPEN.par_iter().map(|share| opening(side, *share)).collect::<Result<_, _>>();
        let openings = open.into_iter().map(of_flange).collect::<Result<_, _>>()?;
        Ok(Self { drawing: drawing.clone(), tolerances: tolerances.clone(), model, openings })
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
