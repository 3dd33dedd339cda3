//! Material of a phase of a cell.

use crate::random::Random;
use crate::{Constituent, Error, Role};
use fem_core::material::ThermoElastic;
use nalgebra::{Matrix2, Rotation2};

/// A solid with z an axis of its symmetry. SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Stiffness and thermal stress; yz and xz must not couple with the others.
    pub law: ThermoElastic,
    /// Conductivity in the plane xy \[W/(m K)\], symmetric.
    pub conductivity: Matrix2<f64>,
    /// Conductivity along z \[W/(m K)\].
    pub conductivity_z: f64,
    /// Density \[kg/m³\], if it is known.
    pub density: Option<f64>,
    /// Specific heat \[J/(kg K)\], if it is known.
    pub specific_heat: Option<f64>,
}

/// A phase of the cell.
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    /// Its name.
    pub name: String,
    /// Its material.
    pub solid: Solid,
    /// Whether it counts as glass in the row M.
    pub role: Role,
}

impl Solid {
    /// An isotropic constituent.
    ///
    /// # Errors
    /// [`fem_core::Error::Material`] names the constant that is out of range.
    pub fn isotropic(constituent: &Constituent) -> Result<Self, fem_core::Error> {
        let Constituent { elastic, conductivity, density, specific_heat } = *constituent;
        let law = elastic.law()?;
        Ok(Self { law, conductivity: Matrix2::identity() * conductivity, conductivity_z: conductivity, density, specific_heat })
    }

    /// The same solid turned by `angle` \[rad\] about z.
    pub fn turned(&self, angle: f64) -> Self {
        let rotation = Rotation2::new(angle);
        let conductivity = rotation.matrix() * self.conductivity * rotation.matrix().transpose();
        Self { law: self.law.turned(angle), conductivity, ..*self }
    }

    /// Every number off by a rounding at most, another way for each state of `random`.
    pub(super) fn shaken(&self, random: &mut Random) -> Self {
        let mut shaken = *self;
        let mut shake = |value: f64| value * (1.0 + (2.0 * random.uniform() - 1.0) * f64::EPSILON);
        for i in 0..6 {
            shaken.law.thermal_stress[i] = shake(self.law.thermal_stress[i]);
            for j in 0..=i {
                let value = shake(self.law.stiffness[(i, j)]);
                (shaken.law.stiffness[(i, j)], shaken.law.stiffness[(j, i)]) = (value, value);
            }
        }
        shaken.conductivity *= shake(1.0);
        shaken
    }

    pub(super) fn check(&self, constituent: &str) -> Result<(), Error> {
        let least = self.conductivity.symmetric_eigenvalues().min().min(self.conductivity_z);
        if !(least > 0.0 && self.conductivity.iter().all(|k| k.is_finite()) && self.conductivity_z.is_finite()) {
            return Err(Error::conductivity(constituent.into(), least));
        }
        Ok(())
    }
}
