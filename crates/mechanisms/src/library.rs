//! Reduced models of a design, and of what it may leave out: once for every design of a box, and at one of them.

use crate::bond::Bond;
use crate::constants::{Constant, constants};
use crate::course::Functionals;
use crate::design::{heatable_flanges, with_heater, with_tail};
use crate::heat_path::{AtWork, HeatPath};
use crate::interpolation::{cubic_weights, nodes};

use coil::{
    Design, Error, HeatPaths, Heater, MODULI, MechanicalState, Mechanics, Output, Parameter, ParametricModel, Projected, Reduced,
    Side, Slopes, Tolerances, TurnFields,
};
use std::collections::HashMap;
use std::sync::Arc;
use winding::{LayerDefect, Winding};

/// Factors on the transverse moduli that are tabulated, within the range that is modelled.
const MODULUS_NODES: usize = 9;

/// The full solutions for a design: a parametric model, and the mechanics of open bonds.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Models {
    pub(crate) drawing: Design,
    pub(crate) tolerances: Tolerances,
    pub(crate) model: ParametricModel,
    /// of each flange whose bond can open: opened less closed
    pub(crate) bonds: Vec<Bond<Projected>>,
}

/// The coil along a path of heat.
#[derive(Debug, Clone)]
pub(crate) struct Tabulated {
    /// Id of the mechanism whose path it is.
    pub(crate) id: String,
    /// Number of the place, of those at which the design has it.
    pub(crate) place: usize,
    /// Coordinate of the library's own design.
    pub(crate) own: f64,
    /// Nodes in the path's coordinate, increasing.
    pub(crate) nodes: Vec<f64>,
    /// A model at every node; `None` at that of the library's own design.
    pub(crate) models: Vec<Option<Reduced>>,
}

/// Reduced models of a design and of what it may leave out, with the derivatives by its constants.
#[derive(Debug, Clone)]
pub struct Library {
    models: Arc<Models>,
    /// those that conduct heat, by their ids and places
    heat_paths: Vec<(String, usize, HeatPath)>,
    /// the drawing with its constants at the values that this is made for
    unchanged: Design,
    /// paths of heat that are at work beside them
    pub(crate) at_work: Vec<AtWork>,
    /// with these, too
    design: Design,
    pub(crate) constants: Vec<Constant>,
    /// thermometer, mean of the coil, nominal parts; parts at each modulus, the same with twice the expansion; of each bond
    pub(crate) base: Reduced,
    pub(crate) slopes: Slopes,
    pub(crate) fields: TurnFields,
    /// ln of the factor on the transverse moduli at nodes; empty if mechanics changes
    pub(crate) moduli: Vec<f64>,
    pub(crate) paths: Vec<Tabulated>,
    /// driven by the chamber and by 1 W in a flange: of each that may be heated
    pub(crate) heaters: Vec<Reduced>,
    /// the power of each heater of the drawing \[W\], and the same of 1 W there
    pub(crate) drawn_heaters: Vec<(f64, Reduced)>,
}

/// A design without a heater of its own: it is no drive of a recording, but is added to what the chamber drives.
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
    /// The same of the drawing with its constants at other values, in their order, and with paths of heat at work; of a value outside the range that was
    /// modelled, at the range's end.
    ///
    /// # Errors
    /// [`Error::Design`] if the design cannot be solved.
    pub fn about(&self, values: &[f64], at_work: Vec<AtWork>) -> Result<Self, Error> {
        let set = |design: Design, (constant, value): (&Constant, &f64)| constant.parameter.set(&design, *value);
        let design = self.constants.iter().zip(values).fold(unheated(&self.models.drawing), set);
        let design = self.models.model.nearest(&design);
        Self::at(Arc::clone(&self.models), self.heat_paths.clone(), design, at_work)
    }

    pub(crate) fn at(
        models: Arc<Models>,
        heat_paths: Vec<(String, usize, HeatPath)>,
        unchanged: Design,
        at_work: Vec<AtWork>,
    ) -> Result<Self, Error> {
        let model = &models.model;
        // with the paths of heat at work, but one
        let with_paths = |but: Option<usize>| {
            let put_in = |design: Design, (k, (id, place, path)): (usize, &(String, usize, HeatPath))| {
                let own = at_work.iter().find(|own| own.is(id, *place)).filter(|_| but != Some(k));
                own.map_or_else(|| design.clone(), |own| (path.design)(&design, *place, own.coordinate))
            };
            heat_paths.iter().enumerate().fold(unchanged.clone(), put_in)
        };
        let design = model.nearest(&with_paths(None));
        let moduli = if design.mechanics == Mechanics::Elastic {
            nodes(MODULI[0].ln(), MODULI[1].ln(), MODULUS_NODES)
        } else {
            Vec::new()
        };
        let softer = |x: &f64| MechanicalState { transverse_modulus: x.exp(), ..MechanicalState::NOMINAL };
        let wider = |x: &f64| MechanicalState { transverse_expansion: 2.0, ..softer(x) };
        let states: Vec<MechanicalState> =
            [MechanicalState::NOMINAL].into_iter().chain(moduli.iter().map(softer)).chain(moduli.iter().map(wider)).collect();
        let bonds: Vec<Projected> = models.bonds.iter().flat_map(Bond::iter).cloned().collect();
        let base = model.in_states_and(&design, &states, &bonds)?;
        let fields = model.fields(&design, &MechanicalState::NOMINAL)?;
        let constants = constants(&models.drawing, &models.tolerances);
        let parameters: Vec<_> = constants.iter().map(|c| c.parameter).collect();
        let slopes = model.slopes(&design, &parameters)?;
        let mut paths = Vec::new();
        for (k, (id, place, path)) in heat_paths.iter().enumerate() {
            let mut from = with_paths(Some(k));
            // a factor acts on the constant as it is drawn
            let factored = path.factor_on.and_then(|parameter| constants.iter().find(|c| c.parameter == parameter));
            let own = match factored {
                Some(constant) => {
                    let value = constant.parameter.of(&from).unwrap_or(constant.drawn);
                    from = constant.parameter.set(&from, constant.drawn);
                    (value / constant.drawn).ln()
                }
                None => at_work.iter().find(|own| own.is(id, *place)).map_or(0.0, |own| own.coordinate),
            };
            let at = |x: &f64| {
                let changed =
                    |x: f64| model.in_states(&model.nearest(&(path.design)(&from, *place, x)), &[MechanicalState::NOMINAL]);
                (!is_same(*x, own)).then(|| changed(*x)).transpose()
            };
            let models = path.nodes.iter().map(at).collect::<Result<_, _>>()?;
            paths.push(Tabulated { id: id.clone(), place: *place, own, nodes: path.nodes.clone(), models });
        }
        let heated = |side: Side| model.in_states(&with_heater(&design, side, 1.0), &[MechanicalState::NOMINAL]);
        let heaters = heatable_flanges(&models.drawing).into_iter().map(heated).collect::<Result<_, _>>()?;
        let drawn = |heater: &Heater| heated(heater.side).map(|model| (heater.power, model));
        let drawn_heaters = models.drawing.heat.heaters.iter().map(drawn).collect::<Result<_, _>>()?;
        Ok(Self {
            models,
            heat_paths,
            unchanged,
            design,
            at_work,
            constants,
            base,
            slopes,
            fields,
            moduli,
            paths,
            heaters,
            drawn_heaters,
        })
    }

    /// The design that it was made for, as it is drawn.
    pub fn design(&self) -> &Design {
        &self.models.drawing
    }

    /// The design with its constants where the models are made about, and no path of heat at work.
    pub(crate) fn unchanged(&self) -> &Design {
        &self.unchanged
    }

    /// Tolerances of a unit about the drawing.
    pub fn tolerances(&self) -> &Tolerances {
        &self.models.tolerances
    }

    /// Values of the constants that it stands at.
    pub fn values(&self) -> Vec<f64> {
        self.constants.iter().map(|c| c.parameter.of(&self.unchanged).unwrap_or(c.drawn)).collect()
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

    /// Changes of the parts by each opening of each flange, about the design's own constants.
    pub(crate) fn bonds(&self) -> Vec<Bond<Functionals>> {
        let relative = |parameter: Parameter| {
            let [own, drawn] = [&self.design, &self.models.drawing].map(|design| parameter.of(design).unwrap_or(0.0));
            if drawn == 0.0 { 0.0 } else { own / drawn - 1.0 }
        };
        let mut states = 1 + 2 * self.moduli.len()..;
        let mut of = |bond: &Bond<Projected>| bond.map(|_| self.functionals(states.next().unwrap_or(0))).moved(relative);
        self.models.bonds.iter().map(&mut of).collect()
    }

    /// Derivatives of the response to a watt in one of the flanges that may be heated, by every constant; and what a metre more of the CW tail changes of
    /// the parts.
    pub(crate) fn heater_slopes(&self, side: Side) -> Result<(Slopes, Functionals), Error> {
        let (design, model) = (with_heater(&self.design, side, 1.0), &self.models.model);
        let parameters: Vec<_> = self.constants.iter().map(|c| c.parameter).collect();
        let fields = model.fields(&design, &MechanicalState::NOMINAL)?;
        let [longer, drawn] =
            [1.0, 0.0].map(|tail| fields.bias_parts(&design.optics, &winding::wind(&with_tail(&design, tail).winding)?));
        let (longer, drawn) = (longer?, drawn?);
        Ok((model.slopes(&design, &parameters)?, [0, 1, 2].map(|p: usize| &longer[p] - &drawn[p])))
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

/// Whether coordinates of a path, which are of the size of one, are the same.
fn is_same(x: f64, own: f64) -> bool {
    (x - own).abs() <= 1e-12
}

/// Weights of the turns of a sound winding in one with a defect in a layer: fields are cubic along that layer, elsewhere unchanged \[m²\].
fn moved(sound: &Winding, wound: &Winding, layer: usize) -> Vec<f64> {
    let mut along: Vec<(f64, usize)> =
        sound.turns().iter().enumerate().filter(|(_, t)| t.layer == layer).map(|(i, t)| (t.y, i)).collect();
    along.sort_by(|a, b| a.0.total_cmp(&b.0));
    let places: Vec<f64> = along.iter().map(|p| p.0).collect();
    // both windings have the other layers' turns in one order along each half
    let key = |t: &winding::Turn| (t.layer, t.turn, t.half);
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
