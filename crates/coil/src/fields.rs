//! Temperature and strain of the glass at every turn, for any state of a reduced model.

use crate::{Error, Model, SectionFields, ThermalModel, ThermalState, TurnValues};
use bias::Optics;
use nalgebra::{DMatrix, DVector};
use winding::Winding;

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
        Ok(Self::with_section(model, thermal, modes)?.0)
    }

    /// As [`Self::new`], with the fields everywhere in coil and spool.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_section(model: &Model, thermal: &ThermalModel, modes: &[Vec<f64>]) -> Result<(Self, SectionFields), Error> {
        let shared = model.grid().shared_nodes(thermal.grid())?;
        let onto = |field: &Vec<f64>| shared.iter().map(|&node| field[node]).collect::<Vec<f64>>();
        let columns: Vec<Vec<f64>> = thermal.shapes().iter().chain(modes).map(onto).collect();
        let displacements = model.displacements(&columns)?;
        let turns = Self::of(model, &model.at_turns_of(&columns, &displacements));
        Ok((turns, SectionFields::new(&columns, &displacements)))
    }

    /// Fields of the values of each column.
    fn of(model: &Model, values: &[TurnValues]) -> Self {
        let of = |value: fn(&TurnValues) -> &Vec<f64>| {
            DMatrix::from_iterator(model.winding().turns().len(), values.len(), values.iter().flat_map(value).copied())
        };
        Self {
            temperature: of(|v| &v.temperature),
            axial: of(|v| &v.axial),
            radial: of(|v| &v.radial),
            bore: values.iter().map(|v| v.bore).collect(),
        }
    }

    /// The parts of the bias as functionals of drives and modes, for these turns in a fibre wound as `winding`: phases \[rad\] whose
    /// increase per time is the Shupe, the elasto-optic axial and the elasto-optic radial part.
    ///
    /// # Errors
    /// [`Error::Bias`] if an optical constant is out of range.
    pub fn bias_parts(&self, optics: &Optics, winding: &Winding) -> Result<[DVector<f64>; 3], Error> {
        self.bias_parts_weighted(optics, winding, winding.weights())
    }

    /// The same where the fields are at other turns than the winding's, with the weight of each in `weights` \[m²\].
    ///
    /// # Errors
    /// As [`Self::bias_parts`].
    ///
    /// # Panics
    /// If there are not as many weights as turns.
    pub fn bias_parts_weighted(&self, optics: &Optics, winding: &Winding, weights: Vec<f64>) -> Result<[DVector<f64>; 3], Error> {
        let (c, w) = (optics.coefficients(winding.length())?, DVector::from_vec(weights));
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

    /// Values in a state, or rates for rates of drives and amplitudes: their differences over an interval give means.
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
