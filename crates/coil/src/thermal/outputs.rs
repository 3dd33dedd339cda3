//! Outputs of a coil: two temperatures, and the phases whose increase is the bias.

use super::state::{ThermalState, dot};
use nalgebra::DVector;

/// Outputs of a coil, each an `F`: a functional of the nodal temperature, one of drives and modes ([`Output`]), or a value.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Outputs<F> {
    /// Temperature at the thermometer's place \[K\].
    pub thermometer: F,
    /// Mean temperature of the coil \[K\].
    pub coil_mean: F,
    /// Phases \[rad\] in every mechanical state, whose increase per time is the Shupe, the elasto-optic axial and the elasto-optic
    /// radial part of the bias. The first state is that at rest: bonds hold, nothing has relaxed, the first row of a table; where a
    /// bond can open, the second is the open one.
    pub parts: Vec<[F; 3]>,
}

impl<F> Outputs<F> {
    /// All of them, in the order of [`Self::map`].
    pub(crate) fn iter(&self) -> impl Iterator<Item = &F> {
        [&self.thermometer, &self.coil_mean].into_iter().chain(self.parts.iter().flatten())
    }

    /// As [`Self::iter`].
    pub(crate) fn iter_mut(&mut self) -> impl Iterator<Item = &mut F> {
        [&mut self.thermometer, &mut self.coil_mean].into_iter().chain(self.parts.iter_mut().flatten())
    }

    /// The same outputs by another means.
    pub fn map<G>(&self, mut of: impl FnMut(&F) -> G) -> Outputs<G> {
        Outputs {
            thermometer: of(&self.thermometer),
            coil_mean: of(&self.coil_mean),
            parts: self.parts.iter().map(|parts| parts.each_ref().map(&mut of)).collect(),
        }
    }
}

/// An output of a reduced model: linear in drives and modes.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Output {
    /// Value per unit of each drive at rest.
    pub(crate) at_rest: Vec<f64>,
    /// Value per unit of each mode.
    pub(crate) modal: Vec<f64>,
}

impl Output {
    /// Its value in a state.
    pub fn of(&self, state: &ThermalState) -> f64 {
        dot(&self.at_rest, &state.drives) + dot(&self.modal, &state.amplitudes)
    }

    /// Its value per unit of each drive, then of each mode, as [`ThermalState::vector`] orders them.
    pub fn vector(&self) -> DVector<f64> {
        DVector::from_iterator(self.at_rest.len() + self.modal.len(), self.at_rest.iter().chain(&self.modal).copied())
    }
}
