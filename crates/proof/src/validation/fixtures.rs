//! Inputs of the comparison: the two reference files, the paper's tables, the independent values, the spool materials.

use crate::Failure;
use crate::files::root;
use fogcoil::input::{read_cell, read_coil, read_ron};
use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Printed {
    pub(crate) id: String,
    pub(crate) table: String,
    pub(crate) quantity: String,
    pub(crate) printed: String,
    pub(crate) unit: String,
    pub(crate) scale: f64,
}

impl Printed {
    pub(crate) fn value(&self) -> Result<f64, Failure> {
        self.printed.parse().map_err(|_| Failure(format!("{}: not a number", self.id)))
    }

    /// Half a unit of the last printed digit, in SI.
    pub(crate) fn half_digit(&self) -> f64 {
        let exponent = self.printed.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
        0.5 * 10f64.powi(exponent - decimals(&self.printed) as i32) * self.scale
    }
}

pub(super) fn decimals(printed: &str) -> usize {
    printed.split_once('.').map_or(0, |(_, fraction)| fraction.bytes().take_while(u8::is_ascii_digit).count())
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Tables {
    rows: Vec<Printed>,
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Known {
    pub(crate) value: f64,
    pub(crate) relative_tolerance: f64,
}

impl Known {
    pub(crate) fn holds(&self, computed: f64) -> bool {
        (computed / self.value - 1.0).abs() <= self.relative_tolerance
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Independent {
    pub(crate) cell: BTreeMap<String, f64>,
    pub(crate) cell_tolerance: f64,
    pub(crate) sensitivity: Known,
    pub(crate) eo_axial: Known,
    pub(crate) ideal_quadrupole: Known,
}

/// What a spool's material has to do with a steady sensitivity; the fixture has its thermal numbers, too.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct SpoolMaterial {
    pub(crate) name: String,
    pub(crate) youngs_modulus_gpa: f64,
    pub(crate) poisson_ratio: f64,
    pub(crate) thermal_expansion_per_k: f64,
}

pub(crate) struct Fixtures {
    pub(crate) cell: homogenization::FibreCell,
    pub(crate) coil: coil::Design,
    pub(crate) independent: Independent,
    pub(crate) spools: Vec<SpoolMaterial>,
    printed: Vec<Printed>,
}

impl Fixtures {
    pub(crate) fn read() -> Result<Self, Failure> {
        let at = root().join("fixtures");
        Ok(Self {
            cell: read_cell(&at.join("cell-reference.ron"))?.cell,
            coil: read_coil(&at.join("coil-reference.ron"))?.design,
            independent: read_ron(&at.join("independent.ron"))?.0,
            spools: read_ron(&at.join("spool-materials.ron"))?.0,
            printed: read_ron::<Tables>(&at.join("paper/tables.ron"))?.0.rows,
        })
    }

    pub(crate) fn printed(&self, id: &str) -> Result<&Printed, Failure> {
        self.printed.iter().find(|row| row.id == id).ok_or_else(|| Failure(format!("fixtures/paper/tables.ron has no row {id}")))
    }

    pub(crate) fn table(&self, table: &str) -> impl Iterator<Item = &Printed> {
        self.printed.iter().filter(move |row| row.table == table)
    }
}
