//! How a library is made: every model that the mechanisms need, side by side.

use crate::catalogue::{debond, self_heating};
use crate::interpolation::nodes;
use crate::library::{Functionals, Library, Tabulated};
use crate::mechanism::{HeatPath, Mechanism};
use crate::nuisances::with_constant;
use coil::{
    Bonds, COARSE, Design, Drive, Dynamics, Error, Fidelity, HeatPaths, MechanicalState, Mechanics, Model, ModelEffort,
    ParametricModel, Range, Reduced,
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

const FIDELITY: Fidelity = Fidelity { resolution: COARSE, modes: MODES };

/// Models that are made side by side, and how many of all are done.
struct Yard<'a> {
    progress: &'a (dyn Fn(Step) + Sync),
    done: AtomicUsize,
    all: usize,
}

impl Yard<'_> {
    /// One more is done.
    fn one(&self) {
        (self.progress)(Step::counted(TASK, self.done.fetch_add(1, Ordering::Relaxed) + 1, self.all));
    }

    /// What is made of each item, in their order, whichever thread does it.
    fn each<I: Copy + Sync, T: Send>(&self, items: &[I], make: impl Fn(I) -> Result<T, Error> + Sync) -> Result<Vec<T>, Error> {
        let one = |item: &I| {
            let made = make(*item)?;
            self.one();
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

/// The ranges that a parametric model of `design` must hold for: its parameters' usual tolerances, and as far as the `mechanisms` go.
pub fn ranges(design: &Design, mechanisms: &[&dyn Mechanism]) -> Vec<Range> {
    let mut ranges = Range::usual(design);
    let paths = paths(design, mechanisms);
    let ends = paths.iter().flat_map(|(_, path)| path.nodes.iter().map(|x| (path.design)(design, *x)));
    let heated = self_heating::applies(design).then(|| self_heating::with_heater(design, 1.0));
    ends.chain(heated).for_each(|changed| Range::widened(&mut ranges, design, &changed));
    ranges
}

impl Library {
    /// Makes every model that the `mechanisms` need; `progress` is told how many are made.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn build(design: &Design, mechanisms: &[&dyn Mechanism], progress: &(dyn Fn(Step) + Sync)) -> Result<Self, Error> {
        // a heater of the design's own stays out: it is no drive of a recording
        let as_designed = design;
        let design = &Design { heat: HeatPaths { heaters: Vec::new(), ..design.heat.clone() }, ..design.clone() };
        let paths = paths(design, mechanisms);
        let open = if debond::applies(design) { &OPEN[..] } else { &[] };
        let heated = self_heating::applies(as_designed).then(|| self_heating::with_heater(design, 1.0));
        let ranges = ranges(design, mechanisms);
        let all = ModelEffort::default().solutions() + open.len();
        let yard = Yard { progress, done: AtomicUsize::new(0), all };
        let model = ParametricModel::new(design, &ranges, &COARSE, &ModelEffort::default(), &|| yard.one())?;
        let nominal_state = [MechanicalState::NOMINAL];
        let base = model.in_states(design, &nominal_state)?;
        let fields = model.fields(design, &MechanicalState::NOMINAL)?;
        let mut tabulated: Vec<Tabulated> = Vec::new();
        for (id, path) in paths {
            let mut of_path = Tabulated::new(id, &path);
            for x in path.nodes.iter().filter(|x| !is_nominal(**x)) {
                of_path.models.push(model.in_states(&(path.design)(design, *x), &nominal_state)?);
            }
            tabulated.push(of_path);
        }
        // temperatures at which the bond opens do not matter: both states are outputs
        let [below, hysteresis] = debond::OPENS;
        let openings = yard.each(open, |share| {
            let opened = debond::with_opening(design, below, hysteresis, share);
            let at = |bonds| Model::in_state(&opened, &COARSE, &MechanicalState { bonds, ..MechanicalState::NOMINAL });
            Ok((share, model.with_mechanics(design, &[at(Bonds::Closed)?, at(Bonds::Opened)?])?))
        })?;
        let vectors = |reduced: &Reduced, state: usize| reduced.outputs().parts[state].each_ref().map(coil::Output::vector);
        let elastic = design.mechanics == Mechanics::Elastic;
        let moduli = if elastic { nodes(MODULUS[0].ln(), MODULUS[1].ln(), MODULUS_NODES) } else { Vec::new() };
        let modulus = moduli.into_iter().map(|x| {
            let state = MechanicalState { transverse_modulus: x.exp(), ..MechanicalState::NOMINAL };
            let both = model.in_states(design, &[state, MechanicalState { transverse_expansion: 2.0, ..state }])?;
            let (nominal, doubled) = (vectors(&both, 0), vectors(&both, 1));
            let per_factor = [0, 1, 2].map(|p: usize| &doubled[p] - &nominal[p]);
            Ok((x, nominal, per_factor))
        });
        let modulus = modulus.collect::<Result<Vec<_>, Error>>()?;
        let constant = |(name, step): (&str, f64)| -> Result<Functionals, Error> {
            let changed = with_constant(design, name, 1.0 + step).unwrap_or_else(|| design.clone());
            let (changed, nominal) = (vectors(&model.in_states(&changed, &nominal_state)?, 0), vectors(&base, 0));
            Ok([0, 1, 2].map(|p: usize| (&changed[p] - &nominal[p]) / step))
        };
        let constants = CONSTANT_STEPS.into_iter().map(constant).collect::<Result<_, _>>()?;
        let heater = heated.map(|heated| model.in_states(&heated, &nominal_state)).transpose()?;
        let nominal = Dynamics::new(as_designed, &[Drive::Chamber], &FIDELITY)?;
        Ok(Self { design: as_designed.clone(), nominal, base, fields, modulus, constants, paths: tabulated, openings, heater })
    }
}

impl Tabulated {
    fn new(id: String, path: &HeatPath) -> Self {
        let nominal = path.nodes.iter().position(|x| is_nominal(*x)).unwrap_or(0);
        Self { id, nominal, nodes: path.nodes.clone(), models: Vec::new() }
    }
}

/// Whether a coordinate of a path, which is of the size of one, is that of the design as it is.
fn is_nominal(x: f64) -> bool {
    x.abs() <= 1e-12
}
