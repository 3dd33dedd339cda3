//! The fields of `COIL.ron` as they are written: coil, winding, optics.

use schemars::JsonSchema;
use serde::Deserialize;

use super::limits::{
    CONDUCTIVITY, CURVATURE_PER_K2, DENSITY, DRIFT_DEG_PER_H_PER_K, EXPANSION_PER_K, INDEX, LENGTH_MM, MODULUS_GPA, MODULUS_MPA,
    PHOTOELASTIC, PITCH_MM, RATIO, SPECIFIC_HEAT, STRAIN_RATIO, TAIL_M, TEMPERATURE_C, within,
};
use super::mechanics::MechanicsFile;
pub(crate) use super::spool_file::{FlangeFile, HeatFile, SensorFile, SolidFile, SpoolFile, SurroundingsFile};

/// A coil on its spool, `COIL.ron`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CoilFile {
    /// Its name.
    pub(crate) name: String,
    /// How the fibre lies.
    pub(crate) winding: WindingFile,
    /// The potted winding as a body.
    pub(crate) coil: BodyFile,
    /// What it is wound on; none is a free coil.
    pub(crate) spool: Option<SpoolFile>,
    /// The medium around the solids.
    pub(crate) surroundings: SurroundingsFile,
    /// What of stiffness and bond depends on temperature or time; Elastic unless given.
    #[serde(default)]
    pub(crate) mechanics: MechanicsFile,
    /// Heat paths besides conduction.
    #[serde(default)]
    pub(crate) heat: HeatFile,
    /// The spool's thermometer.
    pub(crate) sensor: SensorFile,
    /// The fibre's optics.
    pub(crate) optics: OpticsFile,
    /// What vanishes at a reference temperature.
    #[serde(default)]
    pub(crate) drifts: DriftsFile,
    /// From the coil's strains to those of the glass.
    pub(crate) dehomogenization: DehomogenizationFile,
}

/// How the fibre lies.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WindingFile {
    /// Which layer belongs to which half.
    pub(crate) pattern: PatternFile,
    /// Number of layers, 1 to 10000.
    pub(crate) layers: usize,
    /// Turns of layers 1, 3, 5, ..., 1 to 100000.
    pub(crate) turns_odd_layers: usize,
    /// Turns of layers 2, 4, 6, ...: as many, or one fewer.
    pub(crate) turns_even_layers: usize,
    /// Radius on which the first layer lies.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) inner_radius_mm: f64,
    /// Distance of neighbouring turns.
    #[schemars(transform = within(&PITCH_MM))]
    pub(crate) pitch_mm: f64,
    /// Side at which the CW half passes from layer to layer; Right is +y.
    pub(crate) cw_climbs: SideFile,
    /// True: 2 pi r; Equal: every turn the mean length.
    pub(crate) turn_length: TurnLengthFile,
    /// Bare fibre beyond the winding.
    pub(crate) tails_m: TailsFile,
    /// A layer wound wrongly; None unless given.
    #[serde(default)]
    pub(crate) defect: Option<DefectFile>,
}

/// A layer wound wrongly.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DefectFile {
    /// Which, from 1, outwards.
    pub(crate) layer: usize,
    /// Turns too many, or if negative too few, of the half that owns the layer.
    pub(crate) turns: i32,
}

/// What vanishes at a reference temperature.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct DriftsFile {
    /// The temperature; 20 unless given.
    #[schemars(transform = within(&TEMPERATURE_C))]
    pub(crate) reference_c: f64,
    /// b of dn/dT = (dn/dT)0 + b (T - reference); 0 unless given.
    #[schemars(transform = within(&CURVATURE_PER_K2))]
    pub(crate) thermo_optic_curvature_per_k2: f64,
    /// Bias of the read-out per kelvin of the thermometer's place; 0 unless given.
    #[schemars(transform = within(&DRIFT_DEG_PER_H_PER_K))]
    pub(crate) read_out_deg_per_h_per_k: f64,
}

impl Default for DriftsFile {
    fn default() -> Self {
        Self { reference_c: 20.0, thermo_optic_curvature_per_k2: 0.0, read_out_deg_per_h_per_k: 0.0 }
    }
}

/// Which layer belongs to which half.
#[derive(Deserialize, JsonSchema)]
pub(crate) enum PatternFile {
    Cylindrical,
    Dipole,
    Quadrupole,
    PracticalQuadrupole,
    Octupole,
}

/// An end of the coil: Left is y = 0, Right +y.
#[derive(Deserialize, JsonSchema, Clone, Copy)]
pub(crate) enum SideFile {
    Left,
    Right,
}

/// How long a turn is.
#[derive(Deserialize, JsonSchema)]
pub(crate) enum TurnLengthFile {
    True,
    Equal,
}

/// Bare fibre beyond the winding, at the temperature of the hub's bore.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct TailsFile {
    /// At the CW half's outer end.
    #[schemars(transform = within(&TAIL_M))]
    pub(crate) cw: f64,
    /// At the CCW half's outer end.
    #[schemars(transform = within(&TAIL_M))]
    pub(crate) ccw: f64,
}

/// The potted winding as a body.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyFile {
    /// Its outer radius.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) outer_radius_mm: f64,
    /// From y = 0 to its right face.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) height_mm: f64,
    /// Density.
    #[schemars(transform = within(&DENSITY))]
    pub(crate) density_kg_per_m3: f64,
    /// Specific heat.
    #[schemars(transform = within(&SPECIFIC_HEAT))]
    pub(crate) specific_heat_j_per_kgk: f64,
    /// Its effective constants.
    pub(crate) material: MaterialFile,
}

/// Effective constants: written, or of a cell file, whose path is relative to this file.
#[derive(Deserialize, JsonSchema)]
pub(crate) enum MaterialFile {
    Constants(ConstantsFile),
    FromCell(String),
}

/// Effective constants, transversely isotropic; z is the fibre (hoop), r across it.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConstantsFile {
    /// Young's modulus along the fibre.
    #[schemars(transform = within(&MODULUS_GPA))]
    pub(crate) e_z_gpa: f64,
    /// Young's modulus across it.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(crate) e_r_mpa: f64,
    /// Shear modulus along the fibre.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(crate) g_zr_mpa: f64,
    /// Contraction across per extension along the fibre.
    #[schemars(transform = within(&RATIO))]
    pub(crate) nu_zr: f64,
    /// Poisson's ratio across; the stiffness must be positive definite.
    pub(crate) nu_r: f64,
    /// Expansion along the fibre.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(crate) alpha_z_per_k: f64,
    /// Expansion across it.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(crate) alpha_r_per_k: f64,
    /// Conductivity along the fibre.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(crate) k_z_w_per_mk: f64,
    /// Conductivity across it.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(crate) k_r_w_per_mk: f64,
}

/// The fibre's optics.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OpticsFile {
    /// n.
    #[schemars(transform = within(&INDEX))]
    pub(crate) refractive_index: f64,
    /// dn/dT.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(crate) thermo_optic_per_k: f64,
    /// Expansion of the glass.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(crate) thermal_expansion_per_k: f64,
    /// Photoelastic constant.
    #[schemars(transform = within(&PHOTOELASTIC))]
    pub(crate) p11: f64,
    /// Photoelastic constant.
    #[schemars(transform = within(&PHOTOELASTIC))]
    pub(crate) p12: f64,
    /// Effective diameter D.
    #[schemars(transform = within(&LENGTH_MM))]
    pub(crate) sagnac_diameter_mm: f64,
    /// The strain in eq. (2).
    pub(crate) strain: StrainFile,
}

/// The strain in eq. (2): as printed, or without the free expansion.
#[derive(Deserialize, JsonSchema)]
pub(crate) enum StrainFile {
    Total,
    Mechanical,
}

/// The row M: written, of a cell file, or as the paper prints it.
#[derive(Deserialize, JsonSchema)]
pub(crate) enum DehomogenizationFile {
    Matrix(MatrixFile),
    FromCell(String),
    Printed,
}

/// eps_r of the glass = m_rx eps_rr + m_ry eps_yy + m_rz eps_hoop + m_rt dT, with total strains.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct MatrixFile {
    /// Of the coil's radial strain.
    #[schemars(transform = within(&STRAIN_RATIO))]
    pub(crate) m_rx: f64,
    /// Of the coil's axial strain.
    #[schemars(transform = within(&STRAIN_RATIO))]
    pub(crate) m_ry: f64,
    /// Of the hoop strain.
    #[schemars(transform = within(&STRAIN_RATIO))]
    pub(crate) m_rz: f64,
    /// Of the temperature difference.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(crate) m_rt_per_k: f64,
}
