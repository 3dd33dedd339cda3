//! A file of targets as it is written.

use homogenization::identify::literature::Kind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::mirror::mirrored_choice;
use super::quantity::FibreUm;

/// Measured effective constants and the cells to try, `TARGETS.ron`.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TargetsFile {
    /// Its name.
    #[serde(deserialize_with = "super::name::printable")]
    pub(crate) name: String,
    /// Distance of neighbouring fibres, hexagonal.
    pub(crate) pitch_um: FibreUm,
    /// The measured constants.
    pub(crate) targets: Entries,
    /// Kinds of cell to try.
    #[schemars(length(min = 1, max = 6))]
    pub(crate) cells: Vec<CellPrior>,
}

/// A measured constant: Absent; Printed("14.5"), known to its last digit; Measured(value, standard deviation).
#[derive(Serialize, Deserialize, JsonSchema, Default)]
pub(crate) enum Entry {
    #[default]
    Absent,
    Printed(String),
    Measured(f64, f64),
}

/// Effective constants, any of them, in the unit of the key.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[derive(Default)]
pub(crate) struct Entries {
    /// Young's modulus along the fibre.
    pub(crate) e_z_gpa: Entry,
    /// Young's modulus across it.
    pub(crate) e_r_mpa: Entry,
    /// Shear modulus along the fibre.
    pub(crate) g_zr_mpa: Entry,
    /// Shear modulus across it.
    pub(crate) g_r_mpa: Entry,
    /// Plane-strain bulk modulus.
    pub(crate) k_plane_strain_mpa: Entry,
    /// Contraction across per extension along.
    pub(crate) nu_zr: Entry,
    /// Poisson's ratio across.
    pub(crate) nu_r: Entry,
    /// Contraction along per extension across.
    pub(crate) nu_rz: Entry,
    /// Expansion along the fibre.
    pub(crate) alpha_z_per_k: Entry,
    /// Expansion across it.
    pub(crate) alpha_r_per_k: Entry,
    /// Conductivity along the fibre.
    pub(crate) k_z_w_per_mk: Entry,
    /// Conductivity across it.
    pub(crate) k_r_w_per_mk: Entry,
}

/// A kind of cell.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CellPrior {
    /// Its name.
    #[serde(deserialize_with = "super::name::printable")]
    pub(crate) name: String,
    /// Rings from the inside out, 1 to 5.
    #[schemars(length(min = 1, max = 5))]
    pub(crate) rings: Vec<RingFile>,
    /// Material of the rest.
    pub(crate) adhesive: MaterialFile,
}

/// A ring.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RingFile {
    /// Its name.
    #[serde(deserialize_with = "super::name::printable")]
    pub(crate) name: String,
    /// Outer diameter: range that holds 90 % of the expectation.
    pub(crate) outer_diameter_um: (FibreUm, FibreUm),
    /// Whether it is of the glass.
    pub(crate) glass: bool,
    /// Its expected material.
    pub(crate) material: MaterialFile,
}

/// Expected material of a constituent.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialFile {
    /// Sets the ranges that are not given.
    pub(crate) kind: KindFile,
    /// Young's modulus.
    #[serde(default)]
    pub(crate) youngs_modulus_mpa: RangeFile,
    /// Bulk modulus; for rubbers in place of Poisson's ratio.
    #[serde(default)]
    pub(crate) bulk_modulus_mpa: RangeFile,
    /// Poisson's ratio; for stiff kinds.
    #[serde(default)]
    pub(crate) poisson_ratio: RangeFile,
    /// Linear expansion.
    #[serde(default)]
    pub(crate) thermal_expansion_per_k: RangeFile,
    /// Thermal conductivity.
    #[serde(default)]
    pub(crate) conductivity_w_per_mk: RangeFile,
}

/// A range that holds 90 % of the expectation: from the literature, or Between(low, high).
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Default)]
pub(crate) enum RangeFile {
    #[default]
    Literature,
    Between(f64, f64),
}

mirrored_choice! {
    /// A kind of material, with ranges from the literature.
    KindFile is Kind: { Silica, SoftPrimary, HardSecondary, AnyCoating, Adhesive }
}
