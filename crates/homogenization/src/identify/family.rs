//! A kind of cell: known geometry within tolerances, constituents within their priors.

use super::Prior;
use crate::{Constituent, FibreCell, Ring, Role};
use fem_core::material::Isotropic;

/// Priors of a constituent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MaterialPrior {
    /// Young's modulus \[Pa\].
    pub youngs_modulus: Prior,
    /// Resistance to a change of volume.
    pub volume: Volume,
    /// Linear expansion \[1/K\].
    pub thermal_expansion: Prior,
    /// Conductivity \[W/(m K)\].
    pub conductivity: Prior,
}

/// The second elastic constant: for rubbers the bulk modulus, which all of them share, for glasses Poisson's ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Volume {
    /// Bulk modulus \[Pa\].
    BulkModulus(Prior),
    /// Poisson's ratio.
    PoissonRatio(Prior),
}

/// Priors of one ring.
#[derive(Debug, Clone, PartialEq)]
pub struct RingPrior {
    /// Its name.
    pub name: String,
    /// Outer diameter \[m\].
    pub outer_diameter: Prior,
    /// Its role.
    pub role: Role,
    /// Its material.
    pub material: MaterialPrior,
}

/// Cells that differ in their constituents and tolerances.
#[derive(Debug, Clone, PartialEq)]
pub struct Family {
    /// Its name, e.g. "dual coating".
    pub name: String,
    /// Distance between neighbouring fibre axes \[m\].
    pub pitch: f64,
    /// Rings from the inside out.
    pub rings: Vec<RingPrior>,
    /// Fills the rest of the hexagon.
    pub adhesive: MaterialPrior,
}

/// Quantity of a parameter.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// Young's modulus \[Pa\].
    YoungsModulus,
    /// Bulk modulus \[Pa\].
    BulkModulus,
    /// Poisson's ratio.
    PoissonRatio,
    /// Linear expansion \[1/K\].
    ThermalExpansion,
    /// Conductivity \[W/(m K)\].
    Conductivity,
    /// Outer diameter \[m\].
    OuterDiameter,
}

/// One unknown of a family.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Name of the ring, or "adhesive".
    pub phase: String,
    /// Its meaning.
    pub quantity: Quantity,
    /// Its prior distribution, before the measurement.
    pub prior: Prior,
}

/// Unknowns of each constituent, diameters apart.
const PER_MATERIAL: usize = 4;

impl Family {
    /// The unknowns: four of each ring from the inside out, four of the adhesive, then the diameters.
    pub fn parameters(&self) -> Vec<Parameter> {
        let mut all = Vec::new();
        let materials = self.rings.iter().map(|ring| (ring.name.as_str(), &ring.material));
        for (phase, material) in materials.chain([("adhesive", &self.adhesive)]) {
            let volume = match material.volume {
                Volume::BulkModulus(prior) => (Quantity::BulkModulus, prior),
                Volume::PoissonRatio(prior) => (Quantity::PoissonRatio, prior),
            };
            all.extend(
                [
                    (Quantity::YoungsModulus, material.youngs_modulus),
                    volume,
                    (Quantity::ThermalExpansion, material.thermal_expansion),
                    (Quantity::Conductivity, material.conductivity),
                ]
                .map(|(quantity, prior)| Parameter { phase: phase.into(), quantity, prior }),
            );
        }
        all.extend(self.rings.iter().map(|ring| Parameter {
            phase: ring.name.clone(),
            quantity: Quantity::OuterDiameter,
            prior: ring.outer_diameter,
        }));
        all
    }

    /// The cell whose unknowns lie `u` standard deviations from their medians; `None` where no such cell can be: Poisson's ratio
    /// not between 0 and 1/2, rings out of order or no adhesive left between fibres.
    pub fn cell(&self, u: &[f64]) -> Option<FibreCell> {
        let material = |i: usize, prior: &MaterialPrior| {
            let u = &u[PER_MATERIAL * i..];
            let youngs_modulus = prior.youngs_modulus.value(u[0]);
            let poisson_ratio = match prior.volume {
                Volume::BulkModulus(bulk) => 0.5 - youngs_modulus / (6.0 * bulk.value(u[1])),
                Volume::PoissonRatio(ratio) => ratio.value(u[1]),
            };
            let elastic = Isotropic { youngs_modulus, poisson_ratio, thermal_expansion: prior.thermal_expansion.value(u[2]) };
            let conductivity = prior.conductivity.value(u[3]);
            (0.0 < poisson_ratio && poisson_ratio < 0.5).then(|| Constituent::new(elastic, conductivity))
        };
        let diameters = &u[PER_MATERIAL * (self.rings.len() + 1)..];
        let mut rings = Vec::with_capacity(self.rings.len());
        let mut inside = 0.0;
        for (i, ring) in self.rings.iter().enumerate() {
            let outer_radius = ring.outer_diameter.value(diameters[i]) / 2.0;
            if outer_radius <= inside * (1.0 + THINNEST) {
                return None;
            }
            inside = outer_radius;
            rings.push(Ring { outer_radius, constituent: material(i, &ring.material)?, role: ring.role });
        }
        if inside * (1.0 + THINNEST) >= self.pitch / 2.0 {
            return None;
        }
        Some(FibreCell {
            packing: crate::Packing::Hexagonal,
            pitch: self.pitch,
            rings,
            adhesive: material(self.rings.len(), &self.adhesive)?,
        })
    }
}

/// Least relative thickness of a ring and of the film between two fibres.
const THINNEST: f64 = 1e-3;
