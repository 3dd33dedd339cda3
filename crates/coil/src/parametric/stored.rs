//! A parametric model as it is kept on disk: all but its mesh, which its design and its fineness give again.

use super::effort::Effort;
use super::heat::Heat;
use super::model::ParametricModel;
use super::project::Fields;
use super::range::Range;
use super::section::Section;
use super::structure::Structure;
use super::turns::Turns;
use crate::layout::Skins;
use crate::{Bonds, Design, Domain, Error, Grid, Layout, MeshFineness};
use nalgebra::DVector;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Serialize, Deserialize)]
struct Stored {
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
        let grid = Grid::new(&layout, &resolution, Domain::of_heat(&design), Bonds::Closed)?;
        Ok(Self { design, ranges, resolution, effort, section, grid, temperatures, heat, structure, turns, coil_mean })
    }
}

impl Serialize for ParametricModel {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        Stored::from(self.clone()).serialize(to)
    }
}

impl<'de> Deserialize<'de> for ParametricModel {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        Stored::deserialize(from)?.try_into().map_err(D::Error::custom)
    }
}
