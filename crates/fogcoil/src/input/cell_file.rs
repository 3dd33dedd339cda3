//! The fields of `CELL.ron` as they are written.

use serde::{Deserialize, Deserializer};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CellFile {
    pub(super) name: String,
    #[serde(default, deserialize_with = "given")]
    pub(super) pitch_um: Option<f64>,
    pub(super) rings: Vec<RingFile>,
    pub(super) adhesive: MaterialFile,
    #[serde(default, deserialize_with = "given")]
    pub(super) packing: Option<PackingFile>,
    #[serde(default, deserialize_with = "given")]
    pub(super) columns: Option<usize>,
    #[serde(default, deserialize_with = "given")]
    pub(super) rows: Option<usize>,
    #[serde(default, deserialize_with = "given")]
    pub(super) displaced: Option<DisplacedFile>,
    #[serde(default, deserialize_with = "given")]
    pub(super) cell_um: Option<[(f64, f64); 2]>,
    #[serde(default)]
    pub(super) centres_um: Vec<(f64, f64)>,
    #[serde(default)]
    pub(super) voids: Vec<VoidFile>,
}

#[derive(Deserialize, Clone, Copy, PartialEq)]
pub(super) enum PackingFile {
    Hexagonal,
    Square,
}

#[derive(Deserialize, Clone, Copy)]
#[serde(deny_unknown_fields)]
pub(super) struct DisplacedFile {
    pub(super) most_um: f64,
    pub(super) least_film_um: f64,
    pub(super) seed: u64,
    #[serde(default = "one")]
    pub(super) realisations: usize,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VoidFile {
    pub(super) centre_um: (f64, f64),
    pub(super) diameters_um: (f64, f64),
    #[serde(default)]
    pub(super) angle_deg: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RingFile {
    pub(super) name: String,
    #[serde(default, deserialize_with = "given")]
    pub(super) outer_diameter_um: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) outer_diameters_um: Option<(f64, f64)>,
    #[serde(default)]
    pub(super) angle_deg: f64,
    #[serde(default)]
    pub(super) offset_um: (f64, f64),
    pub(super) glass: bool,
    pub(super) material: MaterialFile,
}

/// Isotropic constants, or one of the groups.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialFile {
    #[serde(default, deserialize_with = "given")]
    pub(super) youngs_modulus_mpa: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) poisson_ratio: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) thermal_expansion_per_k: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) conductivity_w_per_mk: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) density_kg_per_m3: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) specific_heat_j_per_kgk: Option<f64>,
    #[serde(default, deserialize_with = "given")]
    pub(super) orthotropic: Option<OrthotropicFile>,
    #[serde(default)]
    pub(super) table: Vec<RowFile>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OrthotropicFile {
    pub(super) e_x_mpa: f64,
    pub(super) e_y_mpa: f64,
    pub(super) e_z_mpa: f64,
    pub(super) g_yz_mpa: f64,
    pub(super) g_xz_mpa: f64,
    pub(super) g_xy_mpa: f64,
    pub(super) nu_yz: f64,
    pub(super) nu_xz: f64,
    pub(super) nu_xy: f64,
    pub(super) alpha_x_per_k: f64,
    pub(super) alpha_y_per_k: f64,
    pub(super) alpha_z_per_k: f64,
    pub(super) k_x_w_per_mk: f64,
    pub(super) k_y_w_per_mk: f64,
    pub(super) k_z_w_per_mk: f64,
    #[serde(default)]
    pub(super) angle_deg: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RowFile {
    pub(super) temperature_c: f64,
    pub(super) youngs_modulus_mpa: f64,
    pub(super) poisson_ratio: f64,
    pub(super) thermal_expansion_per_k: f64,
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
