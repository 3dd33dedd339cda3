//! The fields of `CELL.ron` as they are written.

use schemars::JsonSchema;
use serde::{Deserialize, Deserializer};

use super::limits::{
    ANGLE_DEG, CONDUCTIVITY, DENSITY, EXPANSION_PER_K, FIBRE_UM, MODULUS_MPA, PLACE_UM, RATIO, SPECIFIC_HEAT, TEMPERATURE_C,
    within,
};

/// A fibre's cell, `CELL.ron`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct CellFile {
    /// Its name.
    pub(super) name: String,
    /// Distance of neighbouring fibres; not beside `cell_um`.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&FIBRE_UM))]
    pub(super) pitch_um: Option<f64>,
    /// Concentric rings of the fibre, from the inside out, 1 to 16.
    pub(super) rings: Vec<RingFile>,
    /// What fills the rest of the cell.
    pub(super) adhesive: MaterialFile,
    /// Lattice; hexagonal unless given.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "PackingFile")]
    pub(super) packing: Option<PackingFile>,
    /// Fibres of a cell along x; 1 unless given.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "usize")]
    pub(super) columns: Option<usize>,
    /// Fibres of a cell along y; 1 unless given.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "usize")]
    pub(super) rows: Option<usize>,
    /// Fibres moved at random from the lattice.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "DisplacedFile")]
    pub(super) displaced: Option<DisplacedFile>,
    /// Two lattice vectors (x, y), in place of `pitch_um` and `packing`.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "[(f64, f64); 2]", transform = within(&PLACE_UM))]
    pub(super) cell_um: Option<[(f64, f64); 2]>,
    /// Fibre axes (x, y), with `cell_um`, at most 100.
    #[serde(default)]
    #[schemars(transform = within(&PLACE_UM))]
    pub(super) centres_um: Vec<(f64, f64)>,
    /// Pockets without adhesive; none unless given.
    #[serde(default)]
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
    #[schemars(transform = within(&FIBRE_UM))]
    pub(super) most_um: f64,
    /// Thinnest film left between two fibres.
    #[schemars(transform = within(&FIBRE_UM))]
    pub(super) least_film_um: f64,
    /// Of the random numbers; realisation k takes `seed` + k.
    pub(super) seed: u64,
    /// How many cells are solved and averaged; 1 unless given.
    #[serde(default = "one")]
    pub(super) realisations: usize,
}

/// A pocket without adhesive.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct VoidFile {
    /// Its centre (x, y).
    #[schemars(transform = within(&PLACE_UM))]
    pub(super) centre_um: (f64, f64),
    /// Its two axes.
    #[schemars(transform = within(&FIBRE_UM))]
    pub(super) diameters_um: (f64, f64),
    /// Of the first axis from x; 0 unless given.
    #[serde(default)]
    #[schemars(transform = within(&ANGLE_DEG))]
    pub(super) angle_deg: f64,
}

/// A ring of the fibre.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RingFile {
    /// Its name.
    pub(super) name: String,
    /// Of a round ring.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&FIBRE_UM))]
    pub(super) outer_diameter_um: Option<f64>,
    /// The two axes of an ellipse, in place of `outer_diameter_um`.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "(f64, f64)", transform = within(&FIBRE_UM))]
    pub(super) outer_diameters_um: Option<(f64, f64)>,
    /// Of the ellipse's first axis from x; 0 unless given.
    #[serde(default)]
    #[schemars(transform = within(&ANGLE_DEG))]
    pub(super) angle_deg: f64,
    /// Its centre (x, y) from the fibre's axis; (0, 0) unless given.
    #[serde(default)]
    #[schemars(transform = within(&PLACE_UM))]
    pub(super) offset_um: (f64, f64),
    /// Whether the row M reports its mean strain.
    pub(super) glass: bool,
    /// What it is made of.
    pub(super) material: MaterialFile,
}

/// A constituent: isotropic constants, or `orthotropic`, or `table`.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    /// Young's modulus; isotropic.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&MODULUS_MPA))]
    pub(super) youngs_modulus_mpa: Option<f64>,
    /// Poisson's ratio, greater than -1 and less than 0.5; isotropic.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64")]
    pub(super) poisson_ratio: Option<f64>,
    /// Linear expansion; isotropic.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&EXPANSION_PER_K))]
    pub(super) thermal_expansion_per_k: Option<f64>,
    /// Thermal conductivity; isotropic.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&CONDUCTIVITY))]
    pub(super) conductivity_w_per_mk: Option<f64>,
    /// Optional, for the cell's mean density.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&DENSITY))]
    pub(super) density_kg_per_m3: Option<f64>,
    /// Optional, for the cell's mean heat capacity.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "f64", transform = within(&SPECIFIC_HEAT))]
    pub(super) specific_heat_j_per_kgk: Option<f64>,
    /// Orthotropic constants, in place of the isotropic ones.
    #[serde(default, deserialize_with = "given")]
    #[schemars(with = "OrthotropicFile")]
    pub(super) orthotropic: Option<OrthotropicFile>,
    /// Isotropic constants by rising temperature, linear between the rows, in place of one set.
    #[serde(default)]
    pub(super) table: Vec<RowFile>,
}

/// Orthotropic constants in axes x, y, z, z along the fibre; `nu_xz` is the contraction along z per extension along x under stress along x.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct OrthotropicFile {
    /// Young's modulus along x.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) e_x_mpa: f64,
    /// Young's modulus along y.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) e_y_mpa: f64,
    /// Young's modulus along z.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) e_z_mpa: f64,
    /// Shear modulus yz.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) g_yz_mpa: f64,
    /// Shear modulus xz.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) g_xz_mpa: f64,
    /// Shear modulus xy.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) g_xy_mpa: f64,
    /// Poisson's ratio yz.
    #[schemars(transform = within(&RATIO))]
    pub(super) nu_yz: f64,
    /// Poisson's ratio xz.
    #[schemars(transform = within(&RATIO))]
    pub(super) nu_xz: f64,
    /// Poisson's ratio xy.
    #[schemars(transform = within(&RATIO))]
    pub(super) nu_xy: f64,
    /// Expansion along x.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(super) alpha_x_per_k: f64,
    /// Expansion along y.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(super) alpha_y_per_k: f64,
    /// Expansion along z.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(super) alpha_z_per_k: f64,
    /// Conductivity along x.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(super) k_x_w_per_mk: f64,
    /// Conductivity along y.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(super) k_y_w_per_mk: f64,
    /// Conductivity along z.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(super) k_z_w_per_mk: f64,
    /// Of the material's x from the cell's; 0 unless given.
    #[serde(default)]
    #[schemars(transform = within(&ANGLE_DEG))]
    pub(super) angle_deg: f64,
}

/// Isotropic constants at a temperature.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RowFile {
    /// The temperature.
    #[schemars(transform = within(&TEMPERATURE_C))]
    pub(super) temperature_c: f64,
    /// Young's modulus.
    #[schemars(transform = within(&MODULUS_MPA))]
    pub(super) youngs_modulus_mpa: f64,
    /// Poisson's ratio, greater than -1 and less than 0.5.
    pub(super) poisson_ratio: f64,
    /// Linear expansion.
    #[schemars(transform = within(&EXPANSION_PER_K))]
    pub(super) thermal_expansion_per_k: f64,
    /// Thermal conductivity.
    #[schemars(transform = within(&CONDUCTIVITY))]
    pub(super) conductivity_w_per_mk: f64,
}

fn one() -> usize {
    1
}

/// A field that may be left out, written without `Some`.
fn given<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<T>, D::Error> {
    T::deserialize(deserializer).map(Some)
}

impl CellFile {
    /// The first key that a regular cell of concentric round rings does not have.
    pub(super) fn general_key(&self) -> Option<String> {
        let ring = |(i, ring): (usize, &RingFile)| {
            let at = |key: &str| format!("rings[{i}].{key}");
            let key = if ring.outer_diameters_um.is_some() {
                "outer_diameters_um"
            } else if ring.offset_um != (0.0, 0.0) {
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
    fn general_key(&self) -> Option<&'static str> {
        if self.orthotropic.is_some() { Some("orthotropic") } else { (!self.table.is_empty()).then_some("table") }
    }
}
