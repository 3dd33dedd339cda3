//! Everything of a design that does not depend on a recording: reduced models at chosen values of every mechanism's parameters.

use crate::catalogue::{debond, self_heating, tail_asymmetry};
use crate::interpolation::{cubic_weights, nodes};
use crate::mechanism::{HeatPath, Mechanism};
use coil::{
    COARSE, Design, Drive, Dynamics, Error, Fidelity, MechanicalState, Mechanics, Model, Reduced, Reduction, ThermalModel,
    TurnFields, functionals,
};
use nalgebra::{DMatrix, DVector};
use progress::Step;
use rayon::prelude::*;
use winding::{Half, LayerDefect, Winding};

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

/// The three bias parts as functionals of drives and modes.
pub(crate) type Functionals = [DVector<f64>; 3];

/// The coil along a path of heat.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Tabulated {
    /// Id of the mechanism whose path it is.
    pub(crate) id: String,
    /// Nodes in the path's coordinate, increasing.
    pub(crate) nodes: Vec<f64>,
    /// Which node is the nominal design.
    pub(crate) nominal: usize,
    /// A model at every other node, in their order.
    pub(crate) models: Vec<Reduced>,
}

/// Reduced models of a design and of what it may leave out.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Library {
    pub(crate) design: Design,
    /// the design as it is, whatever its mechanics
    pub(crate) nominal: Dynamics,
    /// thermometer, mean of the coil, nominal parts
    pub(crate) base: Reduced,
    pub(crate) fields: TurnFields,
    /// ln of the factor on the transverse moduli at the nodes, and the parts there with the nominal α_r and per unit of its factor;
    /// empty if the design's mechanics is not constant
    pub(crate) modulus: Vec<(f64, Functionals, Functionals)>,
    /// parts per relative change of E_z, α_z and the spool's expansion
    pub(crate) constants: Vec<Functionals>,
    pub(crate) paths: Vec<Tabulated>,
    /// thermometer, mean of the coil, closed parts, open parts at each open share
    pub(crate) openings: Vec<(f64, Reduced)>,
    /// driven by the chamber and by a heater of 1 W
    pub(crate) heater: Option<Reduced>,
}

/// Relative steps of the constants of [`Library::constants`]: their usual uncertainties.
pub(crate) const CONSTANT_STEPS: [f64; 3] = [0.03, 0.03, 0.02];

fn chamber() -> Vec<Drive> {
    vec![Drive::Chamber]
}

fn fidelity() -> Fidelity {
    Fidelity { resolution: COARSE, modes: MODES }
}

/// What a job of the build makes.
enum Made {
    Path(usize, usize, Reduced),
    Opening(usize, f64, Reduced),
    Heater(Reduced),
    Modulus(usize, f64, Functionals, Functionals),
    Constant(usize, Functionals),
}

#[derive(Clone, Copy)]
enum Job {
    Path(usize, usize, f64),
    Opening(usize, f64),
    Heater,
    Modulus(usize, f64),
    Constant(usize),
}

impl Library {
    /// Makes every model that the `mechanisms` need; `progress` is told how many are made.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault, or the solve that failed.
    pub fn build(design: &Design, mechanisms: &[&dyn Mechanism], progress: &(dyn Fn(Step) + Sync)) -> Result<Self, Error> {
        let thermal = ThermalModel::new(design, &COARSE, &chamber())?;
        let model = Model::new(design, &COARSE)?;
        let Reduction { reduced: base, modes, .. } = Reduction::new(&thermal, &functionals(design, &model, &thermal)?, MODES)?;
        let fields = TurnFields::new(&model, &thermal, &modes)?;
        let elastic = design.mechanics == Mechanics::Elastic;
        let mut jobs: Vec<Job> = Vec::new();
        let of = |m: &&dyn Mechanism| {
            let facts = m.facts();
            facts.heat_path.map(|path| (facts.id.to_owned(), path))
        };
        let paths: Vec<(String, HeatPath)> =
            mechanisms.iter().filter_map(of).filter(|(_, path)| (path.applies)(design)).collect();
        for (number, (_, path)) in paths.iter().enumerate() {
            let others = path.nodes.iter().enumerate().filter(|(_, x)| !same(**x, path.nominal));
            jobs.extend(others.map(|(k, x)| Job::Path(number, k, *x)));
        }
        if debond::applies(design) {
            jobs.extend(OPEN.iter().enumerate().map(|(k, share)| Job::Opening(k, *share)));
        }
        if self_heating::applies(design) {
            jobs.push(Job::Heater);
        }
        if elastic {
            let x = nodes(MODULUS[0].ln(), MODULUS[1].ln(), MODULUS_NODES);
            jobs.extend(x.into_iter().enumerate().map(|(k, x)| Job::Modulus(k, x)));
        }
        jobs.extend((0..CONSTANT_STEPS.len()).map(Job::Constant));
        let done = std::sync::atomic::AtomicUsize::new(0);
        let run = |job: &Job| -> Result<Made, Error> {
            let dynamics = |design: &Design, drives: &[Drive]| {
                Dynamics::new(design, drives, &fidelity()).map(|dynamics| dynamics.reduced().clone())
            };
            let parts = |design: &Design, state: &MechanicalState| -> Result<Functionals, Error> {
                let model = Model::in_state(design, &COARSE, state)?;
                TurnFields::new(&model, &thermal, &modes)?.bias_parts(&design.optics, model.winding())
            };
            let made = match *job {
                Job::Path(path, k, x) => Made::Path(path, k, dynamics(&(paths[path].1.design)(design, x), &chamber())?),
                // temperatures at which the bond opens do not matter: both states are outputs
                Job::Opening(k, share) => {
                    let [below, hysteresis] = debond::OPENS;
                    Made::Opening(k, share, dynamics(&debond::with_opening(design, below, hysteresis, share), &chamber())?)
                }
                Job::Heater => {
                    Made::Heater(dynamics(&self_heating::with_heater(design, 1.0), &[Drive::Chamber, Drive::Heaters])?)
                }
                Job::Modulus(k, x) => {
                    let state = MechanicalState { transverse_modulus: x.exp(), ..MechanicalState::NOMINAL };
                    let nominal = parts(design, &state)?;
                    let doubled = parts(design, &MechanicalState { transverse_expansion: 2.0, ..state })?;
                    let per_factor = [0, 1, 2].map(|p: usize| &doubled[p] - &nominal[p]);
                    Made::Modulus(k, x, nominal, per_factor)
                }
                Job::Constant(k) => {
                    let changed = parts(&with_constant(design, k, 1.0 + CONSTANT_STEPS[k]), &MechanicalState::NOMINAL)?;
                    let nominal = fields.bias_parts(&design.optics, model.winding())?;
                    Made::Constant(k, [0, 1, 2].map(|p: usize| (&changed[p] - &nominal[p]) / CONSTANT_STEPS[k]))
                }
            };
            let count = done.fetch_add(1, std::sync::atomic::Ordering::Relaxed) + 1;
            progress(Step::counted("modelling the design and what may be left out of it", count, jobs.len()));
            Ok(made)
        };
        let mut made: Vec<Made> = jobs.par_iter().map(run).collect::<Result<_, _>>()?;
        // the order of the jobs, whichever thread did them
        made.sort_by_key(|m| match m {
            Made::Path(_, k, _) | Made::Opening(k, ..) | Made::Modulus(k, ..) | Made::Constant(k, _) => *k,
            Made::Heater(_) => 0,
        });
        let mut library = Self {
            design: design.clone(),
            nominal: Dynamics::new(design, &chamber(), &fidelity())?,
            base,
            fields,
            modulus: Vec::new(),
            constants: Vec::new(),
            paths: paths.into_iter().map(|(id, path)| Tabulated::new(id, path)).collect(),
            openings: Vec::new(),
            heater: None,
        };
        for made in made {
            match made {
                Made::Path(path, _, model) => library.paths[path].models.push(model),
                Made::Opening(_, share, model) => library.openings.push((share, model)),
                Made::Heater(model) => library.heater = Some(model),
                Made::Modulus(_, x, nominal, per_factor) => library.modulus.push((x, nominal, per_factor)),
                Made::Constant(_, parts) => library.constants.push(parts),
            }
        }
        Ok(library)
    }

    /// The design it was made for.
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The bias parts with another winding of the same fields.
    pub(crate) fn rewound(&self, tail: f64, defect: Option<LayerDefect>) -> Result<Functionals, Error> {
        let mut design = tail_asymmetry::with_tail(&self.design, tail);
        let sound = winding::wind(&self.design.winding)?;
        if defect.is_none() {
            return self.fields.bias_parts(&design.optics, &winding::wind(&design.winding)?);
        }
        design.winding.defect = defect;
        let wound = winding::wind(&design.winding)?;
        moved(&self.fields, &sound, &wound, defect.map_or(0, |d| d.layer)).bias_parts(&design.optics, &wound)
    }
}

impl Tabulated {
    fn new(id: String, HeatPath { nodes, nominal, .. }: HeatPath) -> Self {
        Self { id, nominal: nodes.iter().position(|x| same(*x, nominal)).unwrap_or(0), nodes, models: Vec::new() }
    }
}

/// Whether two coordinates of a path, which are of the size of one, are the same.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12
}

fn with_constant(design: &Design, k: usize, factor: f64) -> Design {
    let mut changed = design.clone();
    match k {
        0 => changed.body.elastic.e_z *= factor,
        1 => changed.body.elastic.alpha_z *= factor,
        _ => {
            if let Some(spool) = &mut changed.spool {
                spool.material.elastic.thermal_expansion *= factor;
            }
        }
    }
    changed
}

/// Fields at the turns of a winding with a defect in one layer: cubic along that layer, as they are elsewhere.
fn moved(fields: &TurnFields, sound: &Winding, wound: &Winding, layer: usize) -> TurnFields {
    let mut along: Vec<(f64, usize)> =
        sound.turns().iter().enumerate().filter(|(_, t)| t.layer == layer).map(|(i, t)| (t.y, i)).collect();
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    let places: Vec<f64> = along.iter().map(|p| p.0).collect();
    // both windings have the other layers' turns in one order along each half
    let mut others: std::collections::HashMap<(usize, usize, bool), usize> = std::collections::HashMap::new();
    for (i, t) in sound.turns().iter().enumerate() {
        others.insert((t.layer, t.turn, t.half == Half::Cw), i);
    }
    let rows: Vec<Vec<(usize, f64)>> = wound
        .turns()
        .iter()
        .map(|t| match others.get(&(t.layer, t.turn, t.half == Half::Cw)) {
            Some(&i) if t.layer != layer => vec![(i, 1.0)],
            _ => cubic_weights(&places, t.y).into_iter().zip(&along).filter(|(w, _)| *w != 0.0).map(|(w, p)| (p.1, w)).collect(),
        })
        .collect();
    let of = |matrix: &DMatrix<f64>| {
        let mut result = DMatrix::zeros(rows.len(), matrix.ncols());
        for (i, row) in rows.iter().enumerate() {
            for (j, weight) in row {
                for k in 0..matrix.ncols() {
                    result[(i, k)] += weight * matrix[(*j, k)];
                }
            }
        }
        result
    };
    TurnFields {
        temperature: of(&fields.temperature),
        axial: of(&fields.axial),
        radial: of(&fields.radial),
        bore: fields.bore.clone(),
    }
}
