//! Temperature, displacement and strain over the section of coil and spool, for any state of a reduced model.

use crate::probe::{Probe, Prober};
use crate::{Bonds, Dehomogenization, Design, Domain, Error, Grid, Layout, MeshFineness, Region, ThermalState};
use nalgebra::DMatrix;

/// Linear maps from the drives and modes of a [`crate::Reduced`] to the nodes of coil and spool: one column per drive, then one per mode.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SectionFields {
    /// Temperature \[K\], one row per node.
    temperature: DMatrix<f64>,
    /// Displacement \[m\], two rows per node: along r, along y.
    displacement: DMatrix<f64>,
}

impl SectionFields {
    /// Maps of nodal temperatures \[K\] and the displacements \[m\] that they cause, a list for each column.
    pub(crate) fn new(temperatures: &[Vec<f64>], displacements: &[Vec<f64>]) -> Self {
        let of = |columns: &[Vec<f64>]| {
            DMatrix::from_iterator(columns.first().map_or(0, Vec::len), columns.len(), columns.iter().flatten().copied())
        };
        Self { temperature: of(temperatures), displacement: of(displacements) }
    }
}

/// The meshed section of a coil and its spool, with its drives.
#[derive(Debug)]
pub struct Section<'a> {
    grid: Grid,
    fields: &'a SectionFields,
    dehomogenization: Dehomogenization,
}

/// Fields of a section at one instant.
#[derive(Debug)]
pub struct SectionState<'a> {
    section: &'a Section<'a>,
    /// Temperature at each node.
    temperature: Vec<f64>,
    /// Temperature difference from the strain-free state, at each node.
    warming: Vec<f64>,
    displacement: Vec<f64>,
}

/// Temperature, displacement and strain at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointValues {
    /// Temperature, as the drives [°C].
    pub temperature: f64,
    /// Displacement along r and along y \[m\]; each connected body is held at one point along y.
    pub displacement: [f64; 2],
    /// Total strain rr, yy, hoop, and the engineering shear ry.
    pub strain: [f64; 4],
    /// Strain of the glass across the fibre, dehomogenised; NaN outside the coil.
    pub glass_radial: f64,
}

/// Points of a section, found once in its mesh.
#[derive(Debug)]
pub struct Places(Vec<Option<(Probe, bool)>>);

/// An element of a section: its (p + 1)² nodes, p being the order, those along r first.
#[derive(Debug, Clone)]
pub struct SectionElement {
    /// The solid to which it belongs.
    pub region: Region,
    /// Positions (r, y) \[m\].
    pub points: Vec<[f64; 2]>,
    /// Values at them; those of strain are the element's own, as it jumps from one to the next.
    pub values: Vec<PointValues>,
}

impl<'a> Section<'a> {
    /// The section of `design` on the mesh on which `fields` were made, in the nominal mechanical state.
    ///
    /// # Errors
    /// As [`crate::Model::new`].
    pub fn new(design: &Design, fineness: &MeshFineness, fields: &'a SectionFields) -> Result<Self, Error> {
        let grid = Grid::new(&Layout::new(design)?, fineness, Domain::Solids, Bonds::Closed)?;
        if grid.mesh().nodes().len() != fields.temperature.nrows() {
            return Err(Error::Resolution("the section's mesh is not that of its fields".into()));
        }
        Ok(Self { grid, fields, dehomogenization: design.dehomogenization })
    }

    /// Its mesh.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Finds points (r, y) \[m\] in the mesh; one on the coil's face is the coil's.
    pub fn places(&self, points: &[[f64; 2]]) -> Places {
        let mut prober = Prober::new(&self.grid);
        let mut place = |&[r, y]: &[f64; 2]| {
            let in_coil = prober.probe("winding", r, y).ok().map(|probe| (probe, true));
            in_coil.or_else(|| prober.probe("section", r, y).ok().map(|probe| (probe, false)))
        };
        Places(points.iter().map(&mut place).collect())
    }

    /// A state of the reduced model; displacements and strains are those since the drives were at `rest`.
    pub fn at(&self, state: &ThermalState, rest: &[f64]) -> SectionState<'_> {
        let since = ThermalState { drives: state.drives.iter().zip(rest).map(|(u, rest)| u - rest).collect(), ..state.clone() };
        let of = |map: &DMatrix<f64>, state: &ThermalState| (map * state.vector()).as_slice().to_vec();
        SectionState {
            section: self,
            temperature: of(&self.fields.temperature, state),
            warming: of(&self.fields.temperature, &since),
            displacement: of(&self.fields.displacement, &since),
        }
    }
}

impl SectionState<'_> {
    /// Values at points; `None` outside coil and spool.
    pub fn at_places(&self, places: &Places) -> Vec<Option<PointValues>> {
        let value = |(probe, in_coil): &(Probe, bool)| {
            let ([rr, yy, hoop], u) = (probe.strain_of(&self.displacement), &self.displacement);
            let shear = probe.shear_of(u);
            let warming = probe.value_of(&self.warming);
            let displacement = [0, 1].map(|c| probe.component_of(u, c));
            self.values(probe.value_of(&self.temperature), warming, displacement, [rr, yy, hoop, shear], *in_coil)
        };
        places.0.iter().map(|place| place.as_ref().map(value)).collect()
    }

    fn values(&self, temperature: f64, warming: f64, displacement: [f64; 2], strain: [f64; 4], in_coil: bool) -> PointValues {
        let (m, [rr, yy, hoop, _]) = (self.section.dehomogenization, strain);
        let glass = m.m_rx * rr + m.m_ry * yy + m.m_rz * hoop + m.m_rt * warming;
        PointValues { temperature, displacement, strain, glass_radial: if in_coil { glass } else { f64::NAN } }
    }

    /// All elements with the values at their nodes.
    pub fn elements(&self) -> Vec<SectionElement> {
        let slopes = self.section.grid.slopes();
        (0..self.section.grid.regions().len()).map(|element| self.element(element, &slopes)).collect()
    }

    /// An element; `slopes` of each shape function along a side of −1 … 1 at each node.
    fn element(&self, element: usize, slopes: &[Vec<f64>]) -> SectionElement {
        let (grid, n) = (&self.section.grid, slopes.len());
        let (nodes, region) = (&grid.mesh().elements()[element], grid.regions()[element]);
        let points: Vec<[f64; 2]> = nodes.iter().map(|&node| grid.mesh().nodes()[node]).collect();
        let half = [0, 1].map(|c| (points[n * n - 1][c] - points[0][c]) / 2.0);
        let u = |node: usize, c: usize| self.displacement[2 * nodes[node] + c];
        let value = |at: usize| {
            let (i, j) = (at % n, at / n);
            let d_r = |c: usize| (0..n).map(|k| slopes[i][k] * u(j * n + k, c)).sum::<f64>() / half[0];
            let d_y = |c: usize| (0..n).map(|k| slopes[j][k] * u(k * n + i, c)).sum::<f64>() / half[1];
            let strain = [d_r(0), d_y(1), u(at, 0) / points[at][0], d_y(0) + d_r(1)];
            let (temperature, warming) = (self.temperature[nodes[at]], self.warming[nodes[at]]);
            self.values(temperature, warming, [u(at, 0), u(at, 1)], strain, region == Region::Coil)
        };
        let values = (0..n * n).map(value).collect();
        SectionElement { region, points, values }
    }
}
