//! `COIL.ron` as it is written: the whole, the winding as a body, optics, drifts, dehomogenisation.

use bias::{Optics, StrainConvention};
use coil::{Dehomogenization, Design, Drifts, HeatPaths, Mechanics, Tolerances};
use fem_core::material::TransverselyIsotropic;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::heat::HeatFile;
use super::mechanics::MechanicsFile;
use super::mirror::{Mirror, mirrored, mirrored_choice, says_default};
use super::quantity::{
    Conductivity, CurvaturePerK2, Density, DriftDegPerHPerK, ExpansionPerK, Index, LengthMm, ModulusGpa, ModulusMpa,
    Photoelastic, Ratio, SpecificHeat, StrainRatio, TemperatureC, ThermoOpticPerK,
};
use super::spool_file::{SensorFile, SpoolFile, SurroundingsFile};
use super::tolerances::{self, CorrelationFile, TolerancesFile};
use super::winding_file::WindingFile;

/// A coil on its spool, `COIL.ron`.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CoilFile {
    /// Its name.
    #[serde(deserialize_with = "super::name::printable")]
    pub(crate) name: String,
    /// Places of the turns.
    pub(crate) winding: WindingFile,
    /// The potted winding as a body.
    pub(crate) coil: BodyFile,
    /// The spool; none is a free coil.
    pub(crate) spool: Option<SpoolFile>,
    /// The medium around the solids.
    pub(crate) surroundings: SurroundingsFile,
    /// Dependence of stiffness and bond on temperature or time; Elastic unless given.
    #[serde(default, skip_serializing_if = "says_default::<Mechanics, _>")]
    pub(crate) mechanics: MechanicsFile,
    /// Heat paths besides conduction.
    #[serde(default, skip_serializing_if = "says_default::<HeatPaths, _>")]
    pub(crate) heat: HeatFile,
    /// The spool's thermometer.
    pub(crate) sensor: SensorFile,
    /// The fibre's optics.
    pub(crate) optics: OpticsFile,
    /// Terms that vanish at a reference temperature.
    #[serde(default, skip_serializing_if = "says_default::<Drifts, _>")]
    pub(crate) drifts: DriftsFile,
    /// Map from the coil's strains to those of the glass.
    pub(crate) dehomogenization: DehomogenizationFile,
    /// One standard deviation of a unit's deviation from this drawing, by the keys of its numbers; usual ones where none is given.
    #[serde(default, deserialize_with = "super::tolerances::each_once", skip_serializing_if = "TolerancesFile::is_empty")]
    pub(crate) tolerances: TolerancesFile,
    /// Correlations of two numbers that have a tolerance, by their keys: of a lot whose units were calibrated; all others are independent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) correlations: Vec<CorrelationFile>,
}

/// The potted winding as a body.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyFile {
    /// Its outer radius.
    pub(crate) outer_radius_mm: LengthMm,
    /// Height from y = 0 to its right face.
    pub(crate) height_mm: LengthMm,
    /// Density.
    pub(crate) density_kg_per_m3: Density,
    /// Specific heat.
    pub(crate) specific_heat_j_per_kgk: SpecificHeat,
    /// Its effective constants.
    pub(crate) material: MaterialFile,
}

/// Effective constants: written, or of a cell file, whose path is relative to this file.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(crate) enum MaterialFile {
    Constants(ConstantsFile),
    FromCell(String),
}

/// Effective constants in SI.
pub(crate) struct Constants {
    pub(crate) elastic: TransverselyIsotropic,
    pub(crate) conductivity_z: f64,
    pub(crate) conductivity_r: f64,
}

/// The row M: written, of a cell file, or as the paper prints it.
#[derive(Serialize, Deserialize, JsonSchema)]
pub(crate) enum DehomogenizationFile {
    Matrix(MatrixFile),
    FromCell(String),
    Printed,
}

/// A length that the file leaves out.
fn not_given() -> LengthMm {
    LengthMm(f64::NAN)
}

mirrored! {
    /// Effective constants, transversely isotropic; z is the fibre (hoop), r across it.
    ConstantsFile is Constants {
        [elastic: TransverselyIsotropic {
            /// Young's modulus along the fibre.
            e_z_gpa: ModulusGpa = e_z,
            /// Young's modulus across it.
            e_r_mpa: ModulusMpa = e_r,
            /// Shear modulus along the fibre.
            g_zr_mpa: ModulusMpa = g_zr,
            /// Contraction across per extension along the fibre.
            nu_zr: Ratio = nu_zr,
            /// Poisson's ratio across; the stiffness must be positive definite.
            #[schemars(extend("exclusiveMinimum" = -1.0, "exclusiveMaximum" = 1.0))]
            nu_r: f64 = nu_r,
            /// Expansion along the fibre.
            alpha_z_per_k: ExpansionPerK = alpha_z,
            /// Expansion across it.
            alpha_r_per_k: ExpansionPerK = alpha_r,
        }]
        /// Conductivity along the fibre.
        k_z_w_per_mk: Conductivity = conductivity_z,
        /// Conductivity across it.
        k_r_w_per_mk: Conductivity = conductivity_r,
    }

    /// Terms that vanish at a reference temperature.
    #[serde(default)]
    DriftsFile is Drifts {
        /// The temperature; 20 unless given.
        reference_c: TemperatureC = reference,
        /// b of dn/dT = (dn/dT)0 + b (T - reference); 0 unless given.
        thermo_optic_curvature_per_k2: CurvaturePerK2 = thermo_optic_curvature,
        /// Bias of the read-out per kelvin of the thermometer's place; 0 unless given.
        read_out_deg_per_h_per_k: DriftDegPerHPerK = read_out,
    }

    /// The fibre's optics at the wavelength that is used; the bias does not depend on the wavelength itself, which cancels.
    OpticsFile is Optics {
        /// Refractive index n.
        refractive_index: Index = refractive_index,
        /// Thermo-optic coefficient dn/dT.
        thermo_optic_per_k: ThermoOpticPerK = thermo_optic,
        /// Expansion of the glass.
        thermal_expansion_per_k: ExpansionPerK = thermal_expansion,
        /// Photoelastic constant.
        p11: Photoelastic = p11,
        /// Photoelastic constant.
        p12: Photoelastic = p12,
        /// Effective diameter D; unless given the coil's mean diameter, or that of the turns where the coil reaches more than a pitch beyond them.
        #[serde(default = "not_given")]
        #[schemars(extend("default" = "mean diameter"))]
        sagnac_diameter_mm: LengthMm = sagnac_diameter,
        /// The strain in eq. (2).
        strain: StrainFile = strain,
    }

    /// eps_r of the glass = m_rx eps_rr + m_ry eps_yy + m_rz eps_hoop + m_rt dT, with total strains.
    MatrixFile is Dehomogenization {
        /// Factor on the coil's radial strain.
        m_rx: StrainRatio = m_rx,
        /// Factor on the coil's axial strain.
        m_ry: StrainRatio = m_ry,
        /// Factor on the hoop strain.
        m_rz: StrainRatio = m_rz,
        /// Factor on the temperature difference.
        m_rt_per_k: ExpansionPerK = m_rt,
    }
}

mirrored_choice! {
    /// The strain in eq. (2): as printed, or without the free expansion.
    StrainFile is StrainConvention: { Total, Mechanical }
}

impl Default for DriftsFile {
    fn default() -> Self {
        Self::of(&Drifts::default())
    }
}

impl CoilFile {
    /// The file of `design`, with its constants written out and the tolerances of a unit.
    pub(crate) fn new(name: &str, design: &Design, known: &Tolerances) -> Self {
        let body = &design.body;
        let (elastic, conductivity_z, conductivity_r) = (body.elastic, body.conductivity_z, body.conductivity_r);
        let coil = BodyFile {
            outer_radius_mm: Mirror::of(&body.outer_radius),
            height_mm: Mirror::of(&body.height),
            density_kg_per_m3: Mirror::of(&body.density),
            specific_heat_j_per_kgk: Mirror::of(&body.specific_heat),
            material: MaterialFile::Constants(Mirror::of(&Constants { elastic, conductivity_z, conductivity_r })),
        };
        Self {
            name: name.to_owned(),
            winding: Mirror::of(&design.winding),
            coil,
            spool: Mirror::of(&design.spool),
            surroundings: Mirror::of(&design.surroundings),
            mechanics: Mirror::of(&design.mechanics),
            heat: Mirror::of(&design.heat),
            sensor: Mirror::of(&design.sensor),
            optics: Mirror::of(&design.optics),
            drifts: Mirror::of(&design.drifts),
            dehomogenization: DehomogenizationFile::Matrix(Mirror::of(&design.dehomogenization)),
            tolerances: tolerances::written(known, design),
            correlations: tolerances::correlated(known, design),
        }
    }
}
