//! The spool of `COIL.ron`, what is around it, and its thermometer: as they are written, and in SI.

use coil::{Contact, Flange, Sensor, Solid, Spool, Surroundings};
use fem_core::material::Isotropic;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::InputError;
use super::group::Group;
use super::mirror::{Mirror, mirror};
use super::quantity::{
    Conductivity, Density, ExpansionPerK, ExtraLengthMm, LagS, LengthMm, ModulusGpa, PositionMm, SpecificHeat,
};
use super::winding_file::SideFile;
use crate::units::to_mm;

/// What the coil is wound on.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpoolFile {
    /// What it is made of.
    pub(crate) material: SolidFile,
    /// Radial thickness of the hub.
    pub(crate) hub_thickness_mm: LengthMm,
    /// Whether the coil is bonded to the hub; if not, a gap of 0.2 mm.
    pub(crate) hub_bonded: bool,
    /// None, one or two.
    pub(crate) flanges: Vec<FlangeFile>,
}

/// An isotropic solid.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SolidFile {
    /// Young's modulus.
    pub(crate) youngs_modulus_gpa: ModulusGpa,
    /// Greater than -1 and less than 0.5.
    pub(crate) poisson_ratio: f64,
    /// Linear expansion.
    pub(crate) thermal_expansion_per_k: ExpansionPerK,
    /// Thermal conductivity.
    pub(crate) conductivity_w_per_mk: Conductivity,
    /// Density.
    pub(crate) density_kg_per_m3: Density,
    /// Specific heat.
    pub(crate) specific_heat_j_per_kgk: SpecificHeat,
}

/// A flange.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FlangeFile {
    /// On which side of the coil.
    pub(crate) side: SideFile,
    /// Along y.
    pub(crate) thickness_mm: LengthMm,
    /// Beyond the coil's outer radius.
    pub(crate) overhang_mm: ExtraLengthMm,
    /// Whether the coil is bonded to it; if not, a gap of 0.2 mm.
    pub(crate) bonded: bool,
}

/// The medium around the solids.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurroundingsFile {
    /// Still air, or what else there is.
    pub(crate) medium: MediumFile,
    /// From the solids' bounding box to the chamber's wall.
    pub(crate) margin_mm: LengthMm,
}

/// A medium that conducts heat and carries no stress.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MediumFile {
    /// Thermal conductivity.
    pub(crate) conductivity_w_per_mk: Conductivity,
    /// Density.
    pub(crate) density_kg_per_m3: Density,
    /// Specific heat.
    pub(crate) specific_heat_j_per_kgk: SpecificHeat,
}

/// The spool's thermometer.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SensorFile {
    /// Where it is.
    pub(crate) radius_mm: ExtraLengthMm,
    /// Where it is.
    pub(crate) y_mm: PositionMm,
    /// Its own first-order lag; 0 unless given.
    #[serde(default, skip_serializing_if = "LagS::is_zero")]
    #[schemars(!skip_serializing_if)]
    pub(crate) lag_s: LagS,
}

mirror!(SpoolFile is Spool {
    material = material,
    hub_thickness_mm = hub_thickness,
    hub_bonded = hub_contact,
    flanges = flanges,
});
mirror!(FlangeFile is Flange { side = side, thickness_mm = thickness, overhang_mm = overhang, bonded = contact });
mirror!(SensorFile is Sensor { radius_mm = radius, y_mm = y, lag_s = lag });

impl Mirror<Solid> for SolidFile {
    fn model(&self) -> Solid {
        let elastic = Isotropic {
            youngs_modulus: self.youngs_modulus_gpa.model(),
            poisson_ratio: self.poisson_ratio,
            thermal_expansion: self.thermal_expansion_per_k.model(),
        };
        Solid {
            elastic,
            conductivity: self.conductivity_w_per_mk.model(),
            density: self.density_kg_per_m3.model(),
            specific_heat: self.specific_heat_j_per_kgk.model(),
        }
    }

    fn of(solid: &Solid) -> Self {
        Self {
            youngs_modulus_gpa: Mirror::of(&solid.elastic.youngs_modulus),
            poisson_ratio: solid.elastic.poisson_ratio,
            thermal_expansion_per_k: Mirror::of(&solid.elastic.thermal_expansion),
            conductivity_w_per_mk: Mirror::of(&solid.conductivity),
            density_kg_per_m3: Mirror::of(&solid.density),
            specific_heat_j_per_kgk: Mirror::of(&solid.specific_heat),
        }
    }
}

impl Mirror<Surroundings> for SurroundingsFile {
    fn model(&self) -> Surroundings {
        Surroundings {
            conductivity: self.medium.conductivity_w_per_mk.model(),
            density: self.medium.density_kg_per_m3.model(),
            specific_heat: self.medium.specific_heat_j_per_kgk.model(),
            margin: self.margin_mm.model(),
        }
    }

    fn of(around: &Surroundings) -> Self {
        let medium = MediumFile {
            conductivity_w_per_mk: Mirror::of(&around.conductivity),
            density_kg_per_m3: Mirror::of(&around.density),
            specific_heat_j_per_kgk: Mirror::of(&around.specific_heat),
        };
        Self { medium, margin_mm: Mirror::of(&around.margin) }
    }
}

/// The spool, if it has room inside a coil of `inner_radius` and at most one flange a side.
pub(super) fn spool(at: &Group, file: &SpoolFile, inner_radius: f64) -> Result<Spool, InputError> {
    let contact: Contact = file.hub_bonded.model();
    let (thickness, room) = (file.hub_thickness_mm.0, to_mm(inner_radius - contact.gap()));
    if thickness >= room {
        let problem = format!("{thickness} mm leaves no bore inside the coil's inner radius");
        return Err(at.fault("hub_thickness_mm", problem, format!("make it less than {room} mm")));
    }
    let spool: Spool = file.model();
    for (i, flange) in spool.flanges.iter().enumerate() {
        if spool.flanges[..i].iter().any(|other| other.side == flange.side) {
            let problem = format!("a second flange at the side {:?}", flange.side);
            let remedy = "give at most one flange a side, or set the other side";
            return Err(at.fault(&format!("flanges[{i}].side"), problem, remedy));
        }
    }
    at.group("material").law(spool.material.elastic.law())?;
    Ok(spool)
}
