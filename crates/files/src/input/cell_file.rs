//! The fields of `CELL.ron` as they are written.

use fem_core::material::Orthotropic;
use schemars::JsonSchema;
use serde::Deserialize;

use super::given::Given;
use super::mirror::mirrored;
use super::quantity::{
    AngleDeg, Conductivity, Density, ExpansionPerK, FibreUm, ModulusMpa, PlaceUm, Ratio, SpecificHeat, TemperatureC,
};

/// A fibre's cell, `CELL.ron`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CellFile {
    /// Its name.
    #[serde(deserialize_with = "super::name::printable")]
    pub(super) name: String,
    /// Distance of neighbouring fibres; not beside `cell_um`.
    #[serde(default)]
    pub(super) pitch_um: Given<FibreUm>,
    /// Concentric rings of the fibre, from the inside out, 1 to 16.
    #[schemars(length(min = 1, max = 16))]
    pub(super) rings: Vec<RingFile>,
    /// Material of the rest of the cell.
    pub(super) adhesive: MaterialFile,
    /// Lattice; hexagonal unless given.
    #[serde(default)]
    pub(super) packing: Given<PackingFile>,
    /// Fibres of a cell along x; 1 unless given.
    #[serde(default)]
    #[schemars(range(min = 1, max = 100))]
    pub(super) columns: Given<usize>,
    /// Fibres of a cell along y; 1 unless given.
    #[serde(default)]
    #[schemars(range(min = 1, max = 100))]
    pub(super) rows: Given<usize>,
    /// Fibres moved at random from the lattice.
    #[serde(default)]
    pub(super) displaced: Given<DisplacedFile>,
    /// Two lattice vectors (x, y), in place of `pitch_um` and `packing`.
    #[serde(default)]
    pub(super) cell_um: Given<[(PlaceUm, PlaceUm); 2]>,
    /// Fibre axes (x, y), with `cell_um`, at most 100.
    #[serde(default)]
    #[schemars(length(max = 100))]
    pub(super) centres_um: Vec<(PlaceUm, PlaceUm)>,
    /// Pockets without adhesive; none unless given.
    #[serde(default)]
    #[schemars(length(max = 100))]
    pub(super) voids: Vec<VoidFile>,
}

/// Lattice of the fibres.
#[derive(Deserialize, JsonSchema, Clone, Copy, PartialEq)]
pub(super) enum PackingFile {
    Hexagonal,
    Square,
}

/// Fibres displaced at random.
#[derive(Deserialize, JsonSchema, Clone, Copy)]
#[serde(deny_unknown_fields)]
pub(super) struct DisplacedFile {
    /// Farthest move of an axis.
    pub(super) most_um: FibreUm,
    /// Thinnest film left between two fibres.
    pub(super) least_film_um: FibreUm,
    /// Seed of the random numbers; realisation k takes `seed` + k.
    pub(super) seed: u64,
    /// Number of cells that are solved and averaged; 1 unless given.
    #[serde(default = "one")]
    #[schemars(range(min = 1, max = 1000))]
    pub(super) realisations: usize,
}

/// A pocket without adhesive.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct VoidFile {
    /// Its centre (x, y).
    pub(super) centre_um: (PlaceUm, PlaceUm),
    /// Its two axes.
    pub(super) diameters_um: (FibreUm, FibreUm),
    /// Angle of the first axis from x; 0 unless given.
    #[serde(default)]
    pub(super) angle_deg: AngleDeg,
}

/// A ring of the fibre.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RingFile {
    /// Its name.
    #[serde(deserialize_with = "super::name::printable")]
    pub(super) name: String,
    /// Outer diameter of a round ring.
    #[serde(default)]
    pub(super) outer_diameter_um: Given<FibreUm>,
    /// The two axes of an ellipse, in place of `outer_diameter_um`.
    #[serde(default)]
    pub(super) outer_diameters_um: Given<(FibreUm, FibreUm)>,
    /// Angle of the ellipse's first axis from x; 0 unless given.
    #[serde(default)]
    pub(super) angle_deg: AngleDeg,
    /// Its centre (x, y) from the fibre's axis; (0, 0) unless given.
    #[serde(default)]
    pub(super) offset_um: (PlaceUm, PlaceUm),
    /// Whether the row M reports its mean strain.
    pub(super) glass: bool,
    /// Its material.
    pub(super) material: MaterialFile,
}

/// A constituent: isotropic constants, or `orthotropic`, or `table`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    /// Young's modulus; isotropic.
    #[serde(default)]
    pub(super) youngs_modulus_mpa: Given<ModulusMpa>,
    /// Poisson's ratio, greater than -1 and less than 0.5; isotropic.
    #[serde(default)]
    #[schemars(extend("exclusiveMinimum" = -1.0, "exclusiveMaximum" = 0.5))]
    pub(super) poisson_ratio: Given<f64>,
    /// Linear expansion; isotropic.
    #[serde(default)]
    pub(super) thermal_expansion_per_k: Given<ExpansionPerK>,
    /// Thermal conductivity; isotropic.
    #[serde(default)]
    pub(super) conductivity_w_per_mk: Given<Conductivity>,
    /// Density; optional, for the cell's mean density.
    #[serde(default)]
    pub(super) density_kg_per_m3: Given<Density>,
    /// Specific heat; optional, for the cell's mean heat capacity.
    #[serde(default)]
    pub(super) specific_heat_j_per_kgk: Given<SpecificHeat>,
    /// Orthotropic constants, in place of the isotropic ones.
    #[serde(default)]
    pub(super) orthotropic: Given<OrthotropicFile>,
    /// Isotropic constants by rising temperature, linear between the rows, in place of one set.
    #[serde(default)]
    #[schemars(length(max = 1000))]
    pub(super) table: Vec<RowFile>,
}

/// An orthotropic solid in SI, turned by its angle.
pub(super) struct OrthotropicSolid {
    pub(super) law: Orthotropic,
    pub(super) k_x: f64,
    pub(super) k_y: f64,
    pub(super) k_z: f64,
    pub(super) angle: f64,
}

mirrored! {
    /// Orthotropic constants in axes x, y, z, z along the fibre; `nu_xz` is the contraction along z per extension along x under stress along x.
    OrthotropicFile is OrthotropicSolid {
        [law: Orthotropic {
            /// Young's modulus along x.
            e_x_mpa: ModulusMpa = e_x,
            /// Young's modulus along y.
            e_y_mpa: ModulusMpa = e_y,
            /// Young's modulus along z.
            e_z_mpa: ModulusMpa = e_z,
            /// Shear modulus yz.
            g_yz_mpa: ModulusMpa = g_yz,
            /// Shear modulus xz.
            g_xz_mpa: ModulusMpa = g_xz,
            /// Shear modulus xy.
            g_xy_mpa: ModulusMpa = g_xy,
            /// Poisson's ratio yz.
            nu_yz: Ratio = nu_yz,
            /// Poisson's ratio xz.
            nu_xz: Ratio = nu_xz,
            /// Poisson's ratio xy.
            nu_xy: Ratio = nu_xy,
            /// Expansion along x.
            alpha_x_per_k: ExpansionPerK = alpha_x,
            /// Expansion along y.
            alpha_y_per_k: ExpansionPerK = alpha_y,
            /// Expansion along z.
            alpha_z_per_k: ExpansionPerK = alpha_z,
        }]
        /// Conductivity along x.
        k_x_w_per_mk: Conductivity = k_x,
        /// Conductivity along y.
        k_y_w_per_mk: Conductivity = k_y,
        /// Conductivity along z.
        k_z_w_per_mk: Conductivity = k_z,
        /// Angle of the material's x from the cell's; 0 unless given.
        #[serde(default)]
        angle_deg: AngleDeg = angle,
    }
}

/// Isotropic constants at a temperature.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RowFile {
    /// The temperature.
    pub(super) temperature_c: TemperatureC,
    /// Young's modulus.
    pub(super) youngs_modulus_mpa: ModulusMpa,
    /// Poisson's ratio, greater than -1 and less than 0.5.
    #[schemars(extend("exclusiveMinimum" = -1.0, "exclusiveMaximum" = 0.5))]
    pub(super) poisson_ratio: f64,
    /// Linear expansion.
    pub(super) thermal_expansion_per_k: ExpansionPerK,
    /// Thermal conductivity.
    pub(super) conductivity_w_per_mk: Conductivity,
}

fn one() -> usize {
    1
}

impl CellFile {
    /// The first key that a regular cell of concentric round rings does not have.
    pub(super) fn general_key(&self) -> Option<String> {
        let ring = |(i, ring): (usize, &RingFile)| {
            let at = |key: &str| format!("rings[{i}].{key}");
            let key = if ring.outer_diameters_um.is_some() {
                "outer_diameters_um"
            } else if ring.offset_um != Default::default() {
                "offset_um"
            } else {
                return ring.material.general_key().map(|key| at(&format!("material.{key}")));
            };
            Some(at(key))
        };
        let alone = [
            ("columns", self.columns.is_some_and(|n| n > 1)),
            ("rows", self.rows.is_some_and(|n| n > 1)),
            ("displaced", self.displaced.is_some()),
            ("cell_um", self.cell_um.is_some()),
            ("centres_um", !self.centres_um.is_empty()),
            ("voids", !self.voids.is_empty()),
        ];
        let of_cell = alone.into_iter().find(|(_, given)| *given).map(|(key, _)| key.to_owned());
        let of_adhesive = || self.adhesive.general_key().map(|key| format!("adhesive.{key}"));
        of_cell.or_else(|| self.rings.iter().enumerate().find_map(ring)).or_else(of_adhesive)
    }
}

impl MaterialFile {
    /// The key that stands in place of one set of isotropic constants.
    pub(super) fn general_key(&self) -> Option<&'static str> {
        if self.orthotropic.is_some() { Some("orthotropic") } else { (!self.table.is_empty()).then_some("table") }
    }
}
