//! How a library is made: every model that the mechanisms need, side by side.

use crate::catalogue::{debond, self_heating};
use crate::interpolation::nodes;
use crate::library::{Functionals, Library, Tabulated};
use crate::mechanism::{HeatPath, Mechanism};
use crate::nuisances::with_constant;
use coil::{
    COARSE, Design, Drive, Dynamics, Error, Fidelity, MechanicalState, Mechanics, Model, Reduction, ThermalModel, TurnFields,
    functionals,
};
use progress::Step;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The task, as it is told.
const TASK: &str = "modelling the design and what may be left out of it";
/// Modes of every reduced model.
const MODES: usize = 32;

/// Range of the factor on the transverse moduli that is tabulated.
const MODULUS: [f64; 2] = [0.15, 2.2];
const MODULUS_NODES: usize = 9;

/// Open shares of a bond that are tabulated: the response follows the layers of the winding, steps and all.
const OPEN: [f64; 23] = [
    0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1, 0.125, 0.15, 0.18, 0.21, 0.25, 0.3, 0.36, 0.44, 0.53, 0.62, 0.71,
    0.8, 0.9,
];

/// Relative steps of the constants whose effects are tabulated: their usual uncertainties.
const CONSTANT_STEPS: [(&str, f64); 3] = [("E_z", 0.03), ("alpha_z", 0.03), ("spool expansion", 0.02)];

const CHAMBER: [Drive; 1] = [Drive::Chamber];
const FIDELITY: Fidelity = Fidelity { resolution: COARSE, modes: MODES };

/// Models that are made side by side, and how many of all are done.
struct Yard<'a> {
    progress: &'a (dyn Fn(Step) + Sync),
    done: AtomicUsize,
    all: usize,
}

impl Yard<'_> {
    /// What is made of each item, in their order, whichever thread does it.
    fn each<I: Copy + Sync, T: Send>(&self, items: &[I], make: impl Fn(I) -> Result<T, Error> + Sync) -> Result<Vec<T>, Error> {
        let one = |item: &I| {
            let made = make(*item)?;
            (self.progress)(Step::counted(TASK, self.done.fetch_add(1, Ordering::Relaxed) + 1, self.all));
            Ok(made)
        };
        items.par_iter().map(one).collect()
    }
}

/// The paths of heat that a design has, by the ids of their mechanisms.
fn paths(design: &Design, mechanisms: &[&dyn Mechanism]) -> Vec<(String, HeatPath)> {
    let of = |m: &&dyn Mechanism| {
        let facts = m.facts();
        facts.heat_path.map(|path| (facts.id.to_owned(), path))
    };
    mechanisms.iter().filter_map(of).filter(|(_, path)| (path.applies)(design)).collect()
}

impl Library {
    /// Makes every model that the `mechanisms` need; `progress` is told how many are made.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn build(design: &Design, mechanisms: &[&dyn Mechanism], progress: &(dyn Fn(Step) + Sync)) -> Result<Self, Error> {
        let thermal = ThermalModel::new(design, &COARSE, &CHAMBER)?;
        let model = Model::new(design, &COARSE)?;
        let Reduction { reduced: base, modes, .. } = Reduction::new(&thermal, &functionals(design, &model, &thermal)?, MODES)?;
        let fields = TurnFields::new(&model, &thermal, &modes)?;
        let paths = paths(design, mechanisms);
        let others = |(number, (_, path)): (usize, &(String, HeatPath))| -> Vec<(usize, f64)> {
            path.nodes.iter().filter(|x| !is_nominal(**x)).map(|x| (number, *x)).collect()
        };
        let along: Vec<(usize, f64)> = paths.iter().enumerate().flat_map(others).collect();
        let open = if debond::applies(design) { &OPEN[..] } else { &[] };
        let heaters = if self_heating::applies(design) { &[()][..] } else { &[] };
        let elastic = design.mechanics == Mechanics::Elastic;
        let moduli = if elastic { nodes(MODULUS[0].ln(), MODULUS[1].ln(), MODULUS_NODES) } else { Vec::new() };
        let all = along.len() + open.len() + heaters.len() + moduli.len() + CONSTANT_STEPS.len();
        let yard = Yard { progress, done: AtomicUsize::new(0), all };
        let dynamics =
            |design: &Design, drives: &[Drive]| Dynamics::new(design, drives, &FIDELITY).map(|made| made.reduced().clone());
        let parts = |design: &Design, state: &MechanicalState| -> Result<Functionals, Error> {
            let model = Model::in_state(design, &COARSE, state)?;
            TurnFields::new(&model, &thermal, &modes)?.bias_parts(&design.optics, model.winding())
        };
        let chambered = || -> Result<_, Error> {
            let models = yard.each(&along, |(path, x)| dynamics(&(paths[path].1.design)(design, x), &CHAMBER))?;
            // temperatures at which the bond opens do not matter: both states are outputs
            let [below, hysteresis] = debond::OPENS;
            let opened = |share| debond::with_opening(design, below, hysteresis, share);
            Ok((models, yard.each(open, |share| Ok((share, dynamics(&opened(share), &CHAMBER)?)))?))
        };
        let heated =
            || yard.each(heaters, |()| dynamics(&self_heating::with_heater(design, 1.0), &[Drive::Chamber, Drive::Heaters]));
        let modulus = |x: f64| -> Result<_, Error> {
            let state = MechanicalState { transverse_modulus: x.exp(), ..MechanicalState::NOMINAL };
            let nominal = parts(design, &state)?;
            let doubled = parts(design, &MechanicalState { transverse_expansion: 2.0, ..state })?;
            let per_factor = [0, 1, 2].map(|p: usize| &doubled[p] - &nominal[p]);
            Ok((x, nominal, per_factor))
        };
        let constant = |(name, step): (&str, f64)| -> Result<Functionals, Error> {
            let changed = with_constant(design, name, 1.0 + step).unwrap_or_else(|| design.clone());
            let changed = parts(&changed, &MechanicalState::NOMINAL)?;
            let nominal = fields.bias_parts(&design.optics, model.winding())?;
            Ok([0, 1, 2].map(|p: usize| (&changed[p] - &nominal[p]) / step))
        };
        let stiff =
            || -> Result<_, Error> { Ok((heated()?.pop(), yard.each(&moduli, modulus)?, yard.each(&CONSTANT_STEPS, constant)?)) };
        let (chambered, stiff) = rayon::join(chambered, stiff);
        let ((models, openings), (heater, modulus, constants)) = (chambered?, stiff?);
        let untabulated = |(id, HeatPath { nodes, .. }): (String, HeatPath)| {
            let nominal = nodes.iter().position(|x| is_nominal(*x)).unwrap_or(0);
            Tabulated { id, nodes, nominal, models: Vec::new() }
        };
        let mut tabulated: Vec<Tabulated> = paths.into_iter().map(untabulated).collect();
        along.iter().zip(models).for_each(|((path, _), model)| tabulated[*path].models.push(model));
        let nominal = Dynamics::new(design, &CHAMBER, &FIDELITY)?;
        let design = design.clone();
        Ok(Self { design, nominal, base, fields, modulus, constants, paths: tabulated, openings, heater })
    }
}

/// Whether a coordinate of a path, which is of the size of one, is that of the design as it is.
fn is_nominal(coordinate: f64) -> bool {
    coordinate.abs() <= 1e-12
}
