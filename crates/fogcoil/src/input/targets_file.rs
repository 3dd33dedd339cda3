//! A file of targets as it is written.

use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TargetsFile {
    pub(crate) name: String,
    pub(crate) pitch_um: f64,
    pub(crate) targets: Entries,
    pub(crate) cells: Vec<CellPrior>,
}

#[derive(Deserialize, Default)]
pub(crate) enum Entry {
    #[default]
    Absent,
    Printed(String),
    Measured(f64, f64),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
#[derive(Default)]
pub(crate) struct Entries {
    pub(crate) e_z_gpa: Entry,
    pub(crate) e_r_mpa: Entry,
    pub(crate) g_zr_mpa: Entry,
    pub(crate) g_r_mpa: Entry,
    pub(crate) k_plane_strain_mpa: Entry,
    pub(crate) nu_zr: Entry,
    pub(crate) nu_r: Entry,
    pub(crate) nu_rz: Entry,
    pub(crate) alpha_z_per_k: Entry,
    pub(crate) alpha_r_per_k: Entry,
    pub(crate) k_z_w_per_mk: Entry,
    pub(crate) k_r_w_per_mk: Entry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CellPrior {
    pub(crate) name: String,
    pub(crate) rings: Vec<RingFile>,
    pub(crate) adhesive: MaterialFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RingFile {
    pub(crate) name: String,
    pub(crate) outer_diameter_um: (f64, f64),
    pub(crate) glass: bool,
    pub(crate) material: MaterialFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MaterialFile {
    pub(crate) kind: KindFile,
    #[serde(default)]
    pub(crate) youngs_modulus_mpa: RangeFile,
    #[serde(default)]
    pub(crate) bulk_modulus_mpa: RangeFile,
    #[serde(default)]
    pub(crate) poisson_ratio: RangeFile,
    #[serde(default)]
    pub(crate) thermal_expansion_per_k: RangeFile,
    #[serde(default)]
    pub(crate) conductivity_w_per_mk: RangeFile,
}

#[derive(Deserialize, Clone, Copy)]
pub(crate) enum KindFile {
    Silica,
    SoftPrimary,
    HardSecondary,
    AnyCoating,
    Adhesive,
}

#[derive(Deserialize, Clone, Copy, Default)]
pub(crate) enum RangeFile {
    #[default]
    Literature,
    Between(f64, f64),
}
