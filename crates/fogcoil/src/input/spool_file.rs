//! The fields of `COIL.ron` as they are written: spool, surroundings, heat.

use schemars::JsonSchema;
use serde::Deserialize;

use super::coil_file::SideFile;
use super::limits::{
    CONDUCTANCE, CONDUCTIVITY, DENSITY, EXPANSION_PER_K, EXTRA_LENGTH_MM, LAG_S, LENGTH_MM, MODULUS_GPA, POSITION_MM, POWER_W,
    RESISTANCE, SPECIFIC_HEAT, within,
};

/// What the coil is wound on.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpoolFile {
    /// What it is made of.
    pub(crate) material: SolidFile,
    /// Radial thickness of the hub.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) hub_thickness_mm: f64,
    /// Whether the coil is bonded to the hub; if not, a gap of 0.2 mm.
    pub(crate) hub_bonded: bool,
    /// None, one or two.
    pub(crate) flanges: Vec<FlangeFile>,
}

/// An isotropic solid.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SolidFile {
    /// Young's modulus.
    #[schemars(transform = within(&MODULUS_GPA))]
    pub(crate) youngs_modulus_gpa: f64,
    /// Greater than -1 and less than 0.5.
    pub(crate) poisson_ratio: f64,
    /// Linear expansion.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(crate) thermal_expansion_per_k: f64,
    /// Thermal conductivity.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(crate) conductivity_w_per_mk: f64,
    /// Density.
    #[schemars(transform = within(&DENSITY))]
    pub(crate) density_kg_per_m3: f64,
    /// Specific heat.
    #[schemars(transform = within(&SPECIFIC_HEAT))]
    pub(crate) specific_heat_j_per_kgk: f64,
}

/// A flange.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct FlangeFile {
    /// On which side of the coil.
    pub(crate) side: SideFile,
    /// Along y.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) thickness_mm: f64,
    /// Beyond the coil's outer radius.
    #[schemars(transform = within(&EXTRA_LENGTH_MM))]
    pub(crate) overhang_mm: f64,
    /// Whether the coil is bonded to it; if not, a gap of 0.2 mm.
    pub(crate) bonded: bool,
}

/// The medium around the solids.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurroundingsFile {
    /// Still air, or what else there is.
    pub(crate) medium: MediumFile,
    /// From the solids' bounding box to the chamber's wall.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) margin_mm: f64,
}

/// A medium that conducts heat and carries no stress.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MediumFile {
    /// Thermal conductivity.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(crate) conductivity_w_per_mk: f64,
    /// Density.
    #[schemars(transform = within(&DENSITY))]
    pub(crate) density_kg_per_m3: f64,
    /// Specific heat.
    #[schemars(transform = within(&SPECIFIC_HEAT))]
    pub(crate) specific_heat_j_per_kgk: f64,
}

/// The spool's thermometer.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SensorFile {
    /// Where it is.
    #[schemars(transform = within(&EXTRA_LENGTH_MM))]
    pub(crate) radius_mm: f64,
    /// Where it is.
    #[schemars(transform = within(&POSITION_MM))]
    pub(crate) y_mm: f64,
    /// Its own first-order lag; 0 unless given.
    #[serde(default)]
    #[schemars(transform = within(&LAG_S))]
    pub(crate) lag_s: f64,
}

/// Heat paths besides conduction.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct HeatFile {
    /// Contact resistance between hub and coil, where they are bonded; 0 unless given.
    #[schemars(transform = within(&RESISTANCE))]
    pub(crate) hub_resistance_m2k_per_w: f64,
    /// Paths from a flange to its mount; none unless given.
    pub(crate) mounts: Vec<MountFile>,
    /// Heat dissipated in a flange; none unless given.
    pub(crate) heaters: Vec<HeaterFile>,
    /// Film coefficient of every surface to the chamber, in place of the still medium; None unless given.
    #[schemars(transform = within(&CONDUCTANCE))]
    pub(crate) film_w_per_m2k: Option<f64>,
}

/// A path from a flange's outer face to its mount, or to the chamber.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MountFile {
    /// Of the flange.
    pub(crate) side: SideFile,
    /// Conductance per area.
    #[schemars(transform = within(&CONDUCTANCE))]
    pub(crate) conductance_w_per_m2k: f64,
}

/// Heat dissipated evenly in a flange, on from the first row of the profile.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct HeaterFile {
    /// Of the flange.
    pub(crate) side: SideFile,
    /// Power.
    #[schemars(transform = within(&POWER_W))]
    pub(crate) power_w: f64,
}
