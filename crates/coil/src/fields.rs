//! Temperature and strain of the glass at every turn, for any state of a reduced model.

use crate::dynamics::shared_nodes;
use crate::{Error, Model, ThermalModel, ThermalState, TurnStrain};
use bias::{Optics, Slice};
use nalgebra::{DMatrix, DVector};
use winding::Winding;

/// Temperature and strains of the glass at the centre of every turn, in the winding's order; or their rates \[…/s\].
#[derive(Debug, Clone, PartialEq)]
pub struct TurnValues {
    /// Temperature \[K or °C, as the drives\].
    pub temperature: Vec<f64>,
    /// Strain along the fibre: the coil's hoop strain.
    pub axial: Vec<f64>,
    /// Strain across the fibre: dehomogenised.
    pub radial: Vec<f64>,
    /// Temperature of the hub's bore, which the tails share.
    pub bore: f64,
}

impl TurnValues {
    /// Rates as slices for [`bias::bias`]: every turn, then the tails, which expand freely by `fibre_expansion` \[1/K\] at the bore's
    /// temperature.
    ///
    /// # Panics
    /// If `winding` has another number of turns.
    pub fn slices(&self, winding: &Winding, fibre_expansion: f64) -> Vec<Slice> {
        assert_eq!(winding.turns().len(), self.temperature.len(), "the winding these are the turns of");
        let turns = winding.turns().iter().enumerate().map(|(i, turn)| Slice {
            z_start: turn.z_start,
            z_end: turn.z_end,
            temperature_rate: self.temperature[i],
            axial_strain_rate: self.axial[i],
            radial_strain_rate: self.radial[i],
        });
        let (ccw, cw) = winding.tail_spans();
        let tails = [ccw, cw].into_iter().filter(|(start, end)| end > start).map(|(z_start, z_end)| Slice {
            z_start,
            z_end,
            temperature_rate: self.bore,
            axial_strain_rate: fibre_expansion * self.bore,
            radial_strain_rate: fibre_expansion * self.bore,
        });
        turns.chain(tails).collect()
    }
}

/// Linear maps from the drives and modes of a [`crate::Reduced`] to the turns: one row per turn, one column per drive, then one per
/// mode.
///
/// Strains are those of one mechanical state, caused by temperatures as differences from the strain-free one: drives in °C give the
/// strains that have grown since 0 °C. Rates do not depend on the zero.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TurnFields {
    /// Temperature \[K\].
    pub temperature: DMatrix<f64>,
    /// Strain along the fibre.
    pub axial: DMatrix<f64>,
    /// Strain across the fibre.
    pub radial: DMatrix<f64>,
    /// Temperature of the hub's bore \[K\], one entry per column.
    pub bore: Vec<f64>,
}

impl TurnFields {
    /// Fields in the mechanical state of `model`; `modes` are the nodal temperatures that [`crate::Reduction`] gives for `thermal`.
    ///
    /// # Errors
    /// [`Error::Solve`] if a solve leaves a residual; [`Error::Resolution`] if the two models differ in their
    /// [`crate::MeshFineness`].
    pub fn new(model: &Model, thermal: &ThermalModel, modes: &[Vec<f64>]) -> Result<Self, Error> {
        let shared = shared_nodes(model.grid(), thermal.grid())?;
        let onto = |field: &Vec<f64>| shared.iter().map(|&node| field[node]).collect::<Vec<f64>>();
        let columns: Vec<Vec<f64>> = thermal.shapes().iter().chain(modes).map(onto).collect();
        let strains = model.strains_at_turns(&columns)?;
        let turns = model.winding().turns().len();
        let of = |strain: fn(&TurnStrain) -> f64| DMatrix::from_fn(turns, columns.len(), |i, j| strain(&strains[j][i]));
        let temperature = columns.iter().flat_map(|c| model.temperature_at_turns(c));
        Ok(Self {
            temperature: DMatrix::from_iterator(turns, columns.len(), temperature),
            axial: of(|s| s.axial),
            radial: of(|s| s.radial),
            bore: columns.iter().map(|c| model.temperature_at_bore(c)).collect(),
        })
    }

    /// The parts of the bias as functionals of drives and modes, for these turns in a fibre wound as `winding`: phases \[rad\] whose
    /// increase per time is the Shupe, the elasto-optic axial and the elasto-optic radial part.
    ///
    /// # Errors
    /// [`Error::Bias`] if an optical constant is out of range.
    pub fn bias_parts(&self, optics: &Optics, winding: &Winding) -> Result<[DVector<f64>; 3], Error> {
        let (c, w) = (optics.coefficients(winding.length())?, DVector::from_vec(winding.weights()));
        let bore = DVector::from_column_slice(&self.bore) * winding.tail_weight();
        let temperature = self.temperature.tr_mul(&w) + &bore;
        let free = bore * optics.thermal_expansion;
        let (axial, radial) = (self.axial.tr_mul(&w) + &free, self.radial.tr_mul(&w) + free);
        Ok([
            &temperature * c.shupe,
            axial * c.axial + &temperature * c.axial_per_temperature_rate,
            radial * c.radial + temperature * c.radial_per_temperature_rate,
        ])
    }

    /// Sums over the fibre, tails included, that make the phase of a curved ∂n/∂T: Σ W t tᵀ and Σ W t \[m²\], with t the temperature of a
    /// turn from drives and modes and W = ∫ (L − 2z) dz.
    pub fn moments(&self, winding: &Winding) -> (DMatrix<f64>, DVector<f64>) {
        let w = DVector::from_vec(winding.weights());
        let mut weighted = self.temperature.clone();
        for (mut row, w) in weighted.row_iter_mut().zip(w.iter()) {
            row *= *w;
        }
        let (bore, tail) = (DVector::from_column_slice(&self.bore), winding.tail_weight());
        (self.temperature.tr_mul(&weighted) + &bore * bore.transpose() * tail, self.temperature.tr_mul(&w) + bore * tail)
    }

    /// Values in a state, or rates for rates of drives and amplitudes: their differences over an interval give means,
    /// [`crate::Reduced::rates_of`] the rates at an instant.
    ///
    /// # Panics
    /// If drives and amplitudes together are not as many as the columns.
    pub fn at(&self, state: &ThermalState) -> TurnValues {
        let state = state.vector();
        let of = |matrix: &DMatrix<f64>| (matrix * &state).as_slice().to_vec();
        TurnValues {
            temperature: of(&self.temperature),
            axial: of(&self.axial),
            radial: of(&self.radial),
            bore: self.bore.iter().zip(state.iter()).map(|(b, s)| b * s).sum(),
        }
    }
}
