//! The fields of `COIL.ron` as they are written.

use serde::Deserialize;

use super::mechanics::MechanicsFile;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CoilFile {
    pub(crate) name: String,
    pub(crate) winding: WindingFile,
    pub(crate) coil: BodyFile,
    pub(crate) spool: Option<SpoolFile>,
    pub(crate) surroundings: SurroundingsFile,
    #[serde(default)]
    pub(crate) mechanics: MechanicsFile,
    #[serde(default)]
    pub(crate) heat: HeatFile,
    pub(crate) sensor: SensorFile,
    pub(crate) optics: OpticsFile,
    #[serde(default)]
    pub(crate) drifts: DriftsFile,
    pub(crate) dehomogenization: DehomogenizationFile,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindingFile {
    pub(crate) pattern: PatternFile,
    pub(crate) layers: usize,
    pub(crate) turns_odd_layers: usize,
    pub(crate) turns_even_layers: usize,
    pub(crate) inner_radius_mm: f64,
    pub(crate) pitch_mm: f64,
    pub(crate) cw_climbs: SideFile,
    pub(crate) turn_length: TurnLengthFile,
    pub(crate) tails_m: TailsFile,
    #[serde(default)]
    pub(crate) defect: Option<DefectFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct DefectFile {
    pub(crate) layer: usize,
    pub(crate) turns: i32,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct DriftsFile {
    pub(crate) reference_c: f64,
    pub(crate) thermo_optic_curvature_per_k2: f64,
    pub(crate) read_out_deg_per_h_per_k: f64,
}

impl Default for DriftsFile {
    fn default() -> Self {
        Self { reference_c: 20.0, thermo_optic_curvature_per_k2: 0.0, read_out_deg_per_h_per_k: 0.0 }
    }
}

#[derive(Deserialize)]
pub(crate) enum PatternFile {
    Cylindrical,
    Dipole,
    Quadrupole,
    PracticalQuadrupole,
    Octupole,
}

#[derive(Deserialize, Clone, Copy)]
pub(crate) enum SideFile {
    Left,
    Right,
}

#[derive(Deserialize)]
pub(crate) enum TurnLengthFile {
    True,
    Equal,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TailsFile {
    pub(crate) cw: f64,
    pub(crate) ccw: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyFile {
    pub(crate) outer_radius_mm: f64,
    pub(crate) height_mm: f64,
    pub(crate) density_kg_per_m3: f64,
    pub(crate) specific_heat_j_per_kgk: f64,
    pub(crate) material: MaterialFile,
}

#[derive(Deserialize)]
pub(crate) enum MaterialFile {
    Constants(ConstantsFile),
    FromCell(String),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConstantsFile {
    pub(crate) e_z_gpa: f64,
    pub(crate) e_r_mpa: f64,
    pub(crate) g_zr_mpa: f64,
    pub(crate) nu_zr: f64,
    pub(crate) nu_r: f64,
    pub(crate) alpha_z_per_k: f64,
    pub(crate) alpha_r_per_k: f64,
    pub(crate) k_z_w_per_mk: f64,
    pub(crate) k_r_w_per_mk: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpoolFile {
    pub(crate) material: SolidFile,
    pub(crate) hub_thickness_mm: f64,
    pub(crate) hub_bonded: bool,
    pub(crate) flanges: Vec<FlangeFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SolidFile {
    pub(crate) youngs_modulus_gpa: f64,
    pub(crate) poisson_ratio: f64,
    pub(crate) thermal_expansion_per_k: f64,
    pub(crate) conductivity_w_per_mk: f64,
    pub(crate) density_kg_per_m3: f64,
    pub(crate) specific_heat_j_per_kgk: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FlangeFile {
    pub(crate) side: SideFile,
    pub(crate) thickness_mm: f64,
    pub(crate) overhang_mm: f64,
    pub(crate) bonded: bool,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurroundingsFile {
    pub(crate) medium: MediumFile,
    pub(crate) margin_mm: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MediumFile {
    pub(crate) conductivity_w_per_mk: f64,
    pub(crate) density_kg_per_m3: f64,
    pub(crate) specific_heat_j_per_kgk: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SensorFile {
    pub(crate) radius_mm: f64,
    pub(crate) y_mm: f64,
    #[serde(default)]
    pub(crate) lag_s: f64,
}

#[derive(Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct HeatFile {
    pub(crate) hub_resistance_m2k_per_w: f64,
    pub(crate) mounts: Vec<MountFile>,
    pub(crate) heaters: Vec<HeaterFile>,
    pub(crate) film_w_per_m2k: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MountFile {
    pub(crate) side: SideFile,
    pub(crate) conductance_w_per_m2k: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HeaterFile {
    pub(crate) side: SideFile,
    pub(crate) power_w: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OpticsFile {
    pub(crate) refractive_index: f64,
    pub(crate) thermo_optic_per_k: f64,
    pub(crate) thermal_expansion_per_k: f64,
    pub(crate) p11: f64,
    pub(crate) p12: f64,
    pub(crate) sagnac_diameter_mm: f64,
    pub(crate) strain: StrainFile,
}

#[derive(Deserialize)]
pub(crate) enum StrainFile {
    Total,
    Mechanical,
}

#[derive(Deserialize)]
pub(crate) enum DehomogenizationFile {
    Matrix(MatrixFile),
    FromCell(String),
    Printed,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MatrixFile {
    pub(crate) m_rx: f64,
    pub(crate) m_ry: f64,
    pub(crate) m_rz: f64,
    pub(crate) m_rt_per_k: f64,
}
