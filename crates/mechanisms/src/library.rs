//! Reduced models of a design, and of what it may leave out: once for every design of a box, and at one of them.

use crate::constants::{Constant, constants};
use crate::design::{heatable_flanges, with_heater, with_tail};
use crate::heat_path::HeatPath;
use crate::interpolation::{cubic_weights, nodes};

use coil::{
    Design, Error, HeatPaths, MODULI, MechanicalState, Mechanics, Output, Parameter, ParametricModel, Projected, Reduced, Side,
    Slopes, Tolerances, TurnFields,
};
use nalgebra::DVector;
use std::collections::HashMap;
use std::sync::Arc;
use winding::{Half, LayerDefect, Winding};

/// The three bias parts as functionals of drives and modes.
pub(crate) type Functionals = [DVector<f64>; 3];

/// Factors on the transverse moduli that are tabulated, within the range that is modelled.
const MODULUS_NODES: usize = 9;

/// The full solutions for a design: a parametric model, and the mechanics of open bonds.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Models {
    pub(crate) drawing: Design,
    pub(crate) tolerances: Tolerances,
    pub(crate) model: ParametricModel,
    /// of each flange whose bond can open, by the open share: opened less closed
    pub(crate) openings: Vec<Vec<(f64, Projected)>>,
}

/// The coil along a path of heat.
#[derive(Debug, Clone)]
pub(crate) struct Tabulated {
    /// Id of the mechanism whose path it is.
    pub(crate) id: String,
    /// Number of the place, of those at which the design has it.
    pub(crate) place: usize,
    /// Nodes in the path's coordinate, increasing.
    pub(crate) nodes: Vec<f64>,
    /// Number of the node that is the unchanged design.
    pub(crate) nominal: usize,
    /// A model at every other node, in their order.
    pub(crate) models: Vec<Reduced>,
}

/// Reduced models of a design and of what it may leave out, with the derivatives by its constants.
#[derive(Debug, Clone)]
pub struct Library {
    models: Arc<Models>,
    /// those that conduct heat, by their ids and places
    heat_paths: Vec<(String, usize, HeatPath)>,
    /// the drawing with its constants at the values that this is made for
    design: Design,
    pub(crate) constants: Vec<Constant>,
    /// thermometer, mean of the coil, nominal parts; parts at each modulus, the same with twice the expansion; of each opening
    pub(crate) base: Reduced,
    pub(crate) slopes: Slopes,
    pub(crate) fields: TurnFields,
    /// ln of the factor on the transverse moduli at nodes; empty if mechanics changes
    pub(crate) moduli: Vec<f64>,
    pub(crate) paths: Vec<Tabulated>,
    /// driven by the chamber and by 1 W in a flange: of each that may be heated
    pub(crate) heaters: Vec<Reduced>,
}

/// A design without a heater of its own: that is no drive of a recording.
pub(crate) fn unheated(design: &Design) -> Design {
    Design { heat: HeatPaths { heaters: Vec::new(), ..design.heat.clone() }, ..design.clone() }
}

impl Models {
    /// The model of every design within a box about the drawing.
    pub fn parametric(&self) -> &ParametricModel {
        &self.model
    }
}

impl Library {
    /// The same of the drawing with its constants at other values, in their order; of one outside the range that was modelled, at the range's end.
    ///
    /// # Errors
    /// [`Error::Design`] if the design cannot be solved.
    pub fn about(&self, values: &[f64]) -> Result<Self, Error> {
        let set = |design: Design, (constant, value): (&Constant, &f64)| constant.parameter.set(&design, *value);
        let design = self.constants.iter().zip(values).fold(unheated(&self.models.drawing), set);
        let design = self.models.model.nearest(&design);
        Self::at(Arc::clone(&self.models), self.heat_paths.clone(), design)
    }

    pub(crate) fn at(models: Arc<Models>, heat_paths: Vec<(String, usize, HeatPath)>, design: Design) -> Result<Self, Error> {
        let model = &models.model;
        let moduli = if design.mechanics == Mechanics::Elastic {
            nodes(MODULI[0].ln(), MODULI[1].ln(), MODULUS_NODES)
        } else {
            Vec::new()
        };
        let softer = |x: &f64| MechanicalState { transverse_modulus: x.exp(), ..MechanicalState::NOMINAL };
        let wider = |x: &f64| MechanicalState { transverse_expansion: 2.0, ..softer(x) };
        let states: Vec<MechanicalState> =
            [MechanicalState::NOMINAL].into_iter().chain(moduli.iter().map(softer)).chain(moduli.iter().map(wider)).collect();
        let openings: Vec<Projected> = models.openings.iter().flatten().map(|(_, opened)| opened.clone()).collect();
        let base = model.in_states_and(&design, &states, &openings)?;
        let fields = model.fields(&design, &MechanicalState::NOMINAL)?;
        let constants = constants(&models.drawing, &models.tolerances);
        let parameters: Vec<_> = constants.iter().map(|c| c.parameter).collect();
        let slopes = model.slopes(&design, &parameters)?;
        let mut paths = Vec::new();
        for (id, place, path) in &heat_paths {
            let nominal = path.nodes.iter().position(|x| is_nominal(*x)).unwrap_or(0);
            let others = path.nodes.iter().filter(|x| !is_nominal(**x));
            let at =
                others.map(|x| model.in_states(&model.nearest(&(path.design)(&design, *place, *x)), &[MechanicalState::NOMINAL]));
            let models = at.collect::<Result<_, _>>()?;
            paths.push(Tabulated { id: id.clone(), place: *place, nominal, nodes: path.nodes.clone(), models });
        }
        let heated = |side: Side| model.in_states(&with_heater(&design, side, 1.0), &[MechanicalState::NOMINAL]);
        let heaters = heatable_flanges(&models.drawing).into_iter().map(heated).collect::<Result<_, _>>()?;
        Ok(Self { models, heat_paths, design, constants, base, slopes, fields, moduli, paths, heaters })
    }

    /// The design that it was made for, as it is drawn.
    pub fn design(&self) -> &Design {
        &self.models.drawing
    }

    /// Tolerances of a unit about the drawing.
    pub fn tolerances(&self) -> &Tolerances {
        &self.models.tolerances
    }

    /// Values of the constants that it stands at.
    pub fn values(&self) -> Vec<f64> {
        self.constants.iter().map(|c| c.parameter.of(&self.design).unwrap_or(c.drawn)).collect()
    }

    /// Parts at each node of the modulus, and what they change per unit of the factor on α_r.
    pub(crate) fn of_modulus(&self) -> impl Iterator<Item = (f64, Functionals, Functionals)> + '_ {
        let count = self.moduli.len();
        self.moduli.iter().enumerate().map(move |(k, x)| {
            let (nominal, doubled) = (self.functionals(1 + k), self.functionals(1 + count + k));
            (*x, nominal.clone(), [0, 1, 2].map(|p: usize| &doubled[p] - &nominal[p]))
        })
    }

    /// Constants on which the parameter of a mechanism is a factor: their places, and the ids.
    pub(crate) fn factored(&self) -> Vec<(usize, String)> {
        let place = |parameter: Parameter| self.constants.iter().position(|c| c.parameter == parameter);
        self.heat_paths.iter().filter_map(|(id, _, path)| Some((place(path.factor_on?)?, id.clone()))).collect()
    }

    /// Changes of the parts by each opening of each flange, by its open share.
    pub(crate) fn of_openings(&self) -> Vec<Vec<(f64, Functionals)>> {
        let mut states = 1 + 2 * self.moduli.len()..;
        let mut of = |(share, _): &(f64, Projected)| Some((*share, self.functionals(states.next()?)));
        self.models.openings.iter().map(|flange| flange.iter().filter_map(&mut of).collect()).collect()
    }

    fn functionals(&self, state: usize) -> Functionals {
        self.base.outputs().parts[state].each_ref().map(Output::vector)
    }

    /// The bias parts with another winding of the same fields.
    pub(crate) fn rewound(&self, tail: f64, defect: Option<LayerDefect>) -> Result<Functionals, Error> {
        let mut design = with_tail(&self.design, tail);
        let sound = winding::wind(&self.design.winding)?;
        if defect.is_none() {
            return self.fields.bias_parts(&design.optics, &winding::wind(&design.winding)?);
        }
        design.winding.defect = defect;
        let wound = winding::wind(&design.winding)?;
        let weights = moved(&sound, &wound, defect.map_or(0, |d| d.layer));
        self.fields.bias_parts_weighted(&design.optics, &wound, weights)
    }
}

/// Whether a coordinate of a path, which is of the size of one, is that of the design as it is.
fn is_nominal(x: f64) -> bool {
    x.abs() <= 1e-12
}

/// Weights of the turns of a sound winding in one with a defect in a layer: fields are cubic along that layer, elsewhere unchanged \[m²\].
fn moved(sound: &Winding, wound: &Winding, layer: usize) -> Vec<f64> {
    let mut along: Vec<(f64, usize)> =
        sound.turns().iter().enumerate().filter(|(_, t)| t.layer == layer).map(|(i, t)| (t.y, i)).collect();
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    let places: Vec<f64> = along.iter().map(|p| p.0).collect();
    // both windings have the other layers' turns in one order along each half
    let key = |t: &winding::Turn| (t.layer, t.turn, t.half == Half::Cw);
    let others: HashMap<_, usize> = sound.turns().iter().enumerate().map(|(i, t)| (key(t), i)).collect();
    let mut weights = vec![0.0; sound.turns().len()];
    for (t, weight) in wound.turns().iter().zip(wound.weights()) {
        match others.get(&key(t)) {
            Some(&i) if t.layer != layer => weights[i] += weight,
            _ => cubic_weights(&places, t.y).into_iter().zip(&along).for_each(|(share, (_, i))| weights[*i] += share * weight),
        }
    }
    weights
}
