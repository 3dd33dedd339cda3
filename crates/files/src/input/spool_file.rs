//! The spool of `COIL.ron`, its surroundings and its thermometer: as they are written, and in SI.

use coil::{Contact, Flange, Sensor, Solid, Spool, Surroundings};
use fem_core::material::Isotropic;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::InputError;
use super::group::Group;
use super::mirror::{Mirror, mirrored, says_default};
use super::quantity::{
    Conductivity, Density, ExpansionPerK, ExtraLengthMm, LagS, MarginMm, MediumConductivity, MediumDensity, MediumSpecificHeat,
    ModulusGpa, PositionMm, SpecificHeat, WallMm,
};
use super::winding_file::SideFile;
use crate::units::to_mm;

/// The medium around the solids.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurroundingsFile {
    /// Still air, or another medium.
    pub(crate) medium: MediumFile,
    /// From the solids' bounding box to the chamber's wall.
    pub(crate) margin_mm: MarginMm,
}

/// A medium that conducts heat and carries no stress.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MediumFile {
    /// Thermal conductivity.
    pub(crate) conductivity_w_per_mk: MediumConductivity,
    /// Density.
    pub(crate) density_kg_per_m3: MediumDensity,
    /// Specific heat.
    pub(crate) specific_heat_j_per_kgk: MediumSpecificHeat,
}

mirrored! {
    /// An isotropic solid.
    SolidFile is Solid {
        [elastic: Isotropic {
            /// Young's modulus.
            youngs_modulus_gpa: ModulusGpa = youngs_modulus,
            /// Greater than -1 and less than 0.5.
            #[schemars(extend("exclusiveMinimum" = -1.0, "exclusiveMaximum" = 0.5))]
            poisson_ratio: f64 = poisson_ratio,
            /// Linear expansion.
            thermal_expansion_per_k: ExpansionPerK = thermal_expansion,
        }]
        /// Thermal conductivity.
        conductivity_w_per_mk: Conductivity = conductivity,
        /// Density.
        density_kg_per_m3: Density = density,
        /// Specific heat.
        specific_heat_j_per_kgk: SpecificHeat = specific_heat,
    }

    /// The spool on which the coil is wound.
    SpoolFile is Spool {
        /// Its material.
        material: SolidFile = material,
        /// Radial thickness of the hub.
        hub_thickness_mm: WallMm = hub_thickness,
        /// Whether the coil is bonded to the hub; if not, a gap of 0.2 mm.
        hub_bonded: bool = hub_contact,
        /// None, one or two.
        flanges: Vec<FlangeFile> = flanges,
    }

    /// A flange.
    FlangeFile is Flange {
        /// Side of the coil.
        side: SideFile = side,
        /// Thickness along y.
        thickness_mm: WallMm = thickness,
        /// Beyond the coil's outer radius.
        overhang_mm: ExtraLengthMm = overhang,
        /// Whether the coil is bonded to it; if not, a gap of 0.2 mm.
        bonded: bool = contact,
    }

    /// The spool's thermometer.
    SensorFile is Sensor {
        /// Where it is.
        radius_mm: ExtraLengthMm = radius,
        /// Where it is.
        y_mm: PositionMm = y,
        /// Its own first-order lag; 0 unless given.
        #[serde(default, skip_serializing_if = "says_default::<f64, _>")]
        #[schemars(!skip_serializing_if)]
        lag_s: LagS = lag,
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
        let remedy = format!("make it less than {room} mm, or check winding.inner_radius_mm, which is in mm");
        return Err(at.fault("hub_thickness_mm", problem, remedy));
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
