//! A parametric model as it is kept on disk: all but its mesh, which its design and its fineness give again.

use super::heat::Heat;
use super::project::Fields;
use super::section::{Section, domain};
use super::structure::Structure;
use super::{Effort, ParametricModel, Range, Turns};
use crate::layout::Skins;
use crate::{Bonds, Design, Error, Grid, Layout, MeshFineness};
use nalgebra::DVector;

#[derive(serde::Serialize, serde::Deserialize)]
pub(super) struct Stored {
    design: Design,
    ranges: Vec<Range>,
    resolution: MeshFineness,
    effort: Effort,
    section: Section,
    temperatures: Fields,
    heat: Heat,
    structure: Structure,
    turns: Turns,
    coil_mean: DVector<f64>,
}

impl From<ParametricModel> for Stored {
    fn from(model: ParametricModel) -> Self {
        let ParametricModel {
            design,
            ranges,
            resolution,
            effort,
            section,
            grid: _,
            temperatures,
            heat,
            structure,
            turns,
            coil_mean,
        } = model;
        Self { design, ranges, resolution, effort, section, temperatures, heat, structure, turns, coil_mean }
    }
}

impl TryFrom<Stored> for ParametricModel {
    type Error = Error;

    fn try_from(stored: Stored) -> Result<Self, Error> {
        let Stored { design, ranges, resolution, effort, section, temperatures, heat, structure, turns, coil_mean } = stored;
        let layout = Layout::with_skins(&design, Skins::All)?;
        let grid = Grid::new(&layout, &resolution, domain(&design), Bonds::Closed)?;
        Ok(Self { design, ranges, resolution, effort, section, grid, temperatures, heat, structure, turns, coil_mean })
    }
}
