//! The effort of making a model, and the states of the mechanics that it holds for.

/// Factors on the transverse moduli that states may have.
pub const MODULI: [f64; 2] = [0.15, 2.2];

/// Effort of making a model.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Effort {
    /// Designs whose heat flow is solved in full.
    pub heat: usize,
    /// Designs whose mechanics is solved in full.
    pub mechanics: usize,
    /// Fields of temperature below this, relative to the largest, are left out.
    pub least_temperature: f64,
    /// Fields of displacement, likewise.
    pub least_displacement: f64,
    /// Temperature fields at most.
    pub most_temperatures: usize,
    /// Displacement fields at most.
    pub most_displacements: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self {
            heat: 40,
            mechanics: 15,
            least_temperature: 1e-6,
            least_displacement: 1e-4,
            most_temperatures: 100,
            most_displacements: 200,
        }
    }
}

impl Effort {
    /// Designs that are solved in full, the nominal one included.
    pub fn solutions(&self) -> usize {
        self.heat + self.mechanics + 2
    }
}
