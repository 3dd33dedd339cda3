//! Everything of a design that does not depend on a recording: reduced models at chosen values of every mechanism's parameters.

use crate::design::with_tail;
use crate::interpolation::cubic_weights;
use coil::{Design, Dynamics, Error, Reduced, TurnFields};
use nalgebra::{DMatrix, DVector};
use winding::{Half, LayerDefect, Winding};

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
    /// ln of the factor on the transverse moduli at nodes, parts with the nominal α_r and per unit of its factor; empty if mechanics changes
    pub(crate) modulus: Vec<(f64, Functionals, Functionals)>,
    /// parts per relative change of E_z, α_z and the spool's expansion
    pub(crate) constants: Vec<Functionals>,
    pub(crate) paths: Vec<Tabulated>,
    /// thermometer, mean of the coil, closed parts, open parts at each open share
    pub(crate) openings: Vec<(f64, Reduced)>,
    /// driven by the chamber and by a heater of 1 W
    pub(crate) heater: Option<Reduced>,
}

impl Library {
    /// The design it was made for.
    pub fn design(&self) -> &Design {
        &self.design
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
        moved(&self.fields, &sound, &wound, defect.map_or(0, |d| d.layer)).bias_parts(&design.optics, &wound)
    }
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
