//! The mechanical model: coil and spool, factorised; strain at every turn for a given temperature field.

use crate::grid::Grading;
use crate::probe::{Probe, Prober, Sums};
use crate::{Dehomogenization, Design, Domain, Error, Grid, Layout, MechanicalState, MeshFineness, Region, TurnValues};
use bias::{Bias, Coefficients, Slice};
use fem_core::material::ThermoElastic;
use fem_core::{Condensed, Constraints, Coupling, DofMap, Form, Problem};
use nalgebra::DMatrix;
use std::sync::OnceLock;
use winding::Winding;

/// Voigt rows (x = radial, y = axial, z = hoop of the law) of the axisymmetric strains rr, yy, hoop, ry.
const AXISYMMETRIC: [usize; 4] = [0, 1, 2, 5];

/// A design with its winding laid, its mesh and its factorised stiffness.
pub struct Model {
    winding: Winding,
    coefficients: Coefficients,
    dehomogenization: Dehomogenization,
    fibre_expansion: f64,
    grid: Grid,
    map: DofMap,
    factor: Condensed,
    thermal_stresses: Vec<Option<DMatrix<f64>>>,
    /// thermal stress of the coil's transverse expansion, as it is drawn
    transverse_stresses: Vec<Option<DMatrix<f64>>>,
    coupling: OnceLock<Coupling>,
    probes: Vec<Probe>,
    bore: Probe,
}

/// The bias as a linear functional of the nodal temperature rates: one adjoint solution per elasto-optic part.
#[derive(Debug, Clone, PartialEq)]
pub struct BiasOperator {
    /// Shupe part, [rad/s] per [K/s] at each node of [`Model::grid`].
    pub shupe: Vec<f64>,
    /// Elasto-optic part of the axial strain.
    pub eo_axial: Vec<f64>,
    /// Elasto-optic part of the radial strain.
    pub eo_radial: Vec<f64>,
}

fn at<T>(part: &'static str, result: Result<T, fem_core::Error>) -> Result<T, Error> {
    result.map_err(|source| Error::Solve { part, source })
}

fn axisymmetric(law: &ThermoElastic) -> (DMatrix<f64>, DMatrix<f64>) {
    let stiffness = DMatrix::from_fn(4, 4, |i, j| law.stiffness[(AXISYMMETRIC[i], AXISYMMETRIC[j])]);
    let stress = DMatrix::from_fn(4, 1, |i, _| law.thermal_stress[AXISYMMETRIC[i]]);
    (stiffness, stress)
}

impl Model {
    /// Winds, meshes and factorises `design`.
    ///
    /// # Errors
    /// [`Error`] names the dimension, property, winding or optical constant at fault, or the solve that failed.
    pub fn new(design: &Design, resolution: &MeshFineness) -> Result<Self, Error> {
        Self::in_state(design, resolution, &MechanicalState::NOMINAL)
    }

    /// As [`Self::new`], in a state of the design's [`crate::Mechanics`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn in_state(design: &Design, resolution: &MeshFineness, state: &MechanicalState) -> Result<Self, Error> {
        Self::graded(design, resolution, Grading::Even, state)
    }

    /// As [`Self::in_state`], on a mesh of the given grading.
    pub(crate) fn graded(
        design: &Design,
        resolution: &MeshFineness,
        grading: Grading,
        state: &MechanicalState,
    ) -> Result<Self, Error> {
        Self::on(&Layout::new(design)?, design, resolution, grading, state)
    }

    /// As [`Self::graded`], on a layout of the design.
    pub(crate) fn on(
        layout: &Layout,
        design: &Design,
        resolution: &MeshFineness,
        grading: Grading,
        state: &MechanicalState,
    ) -> Result<Self, Error> {
        let winding = winding::wind(&design.winding)?;
        let coefficients = design.optics.coefficients(winding.length())?;
        let grid = Grid::graded(layout, resolution, grading, Domain::Solids, state.bonds)?;
        let (map, factor, thermal_stresses) = assemble(design, &grid, state)?;
        let transverse_stresses = transverse_stresses(design, state)?;
        let mut prober = Prober::new(&grid);
        let probes = winding.turns().iter().map(|t| prober.probe("winding", t.r, t.y)).collect::<Result<_, _>>()?;
        let lowest = layout.solids.iter().filter(|s| s.r[0] == layout.bore).map(|s| s.y[0]).fold(f64::INFINITY, f64::min);
        let highest = layout.solids.iter().filter(|s| s.r[0] == layout.bore).map(|s| s.y[1]).fold(f64::NEG_INFINITY, f64::max);
        let bore = grid.probe("sensor", layout.bore, design.sensor.y.clamp(lowest, highest))?;
        Ok(Self {
            winding,
            coefficients,
            dehomogenization: design.dehomogenization,
            fibre_expansion: design.optics.thermal_expansion,
            grid,
            map,
            factor,
            thermal_stresses,
            transverse_stresses,
            coupling: OnceLock::new(),
            probes,
            bore,
        })
    }

    /// The winding.
    pub fn winding(&self) -> &Winding {
        &self.winding
    }

    /// The mesh of coil and spool; temperatures are given at its nodes.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Unknowns of the mechanical system.
    pub fn unknowns(&self) -> usize {
        self.factor.unknowns()
    }

    /// Temperature at the centre of every turn, in the winding's order, from nodal temperatures \[K\].
    pub fn temperature_at_turns(&self, temperature: &[f64]) -> Vec<f64> {
        self.probes.iter().map(|p| p.value_of(temperature)).collect()
    }

    /// Temperature and strain of the glass at the centre of every turn for each of some fields of nodal temperature differences from the stress-free state
    /// \[K\]: temperature and total strain.
    ///
    /// # Errors
    /// [`Error::Solve`] if a solve leaves a residual.
    pub fn at_turns(&self, temperatures: &[Vec<f64>]) -> Result<Vec<TurnValues>, Error> {
        Ok(self.at_turns_of(temperatures, &self.displacements(temperatures)?))
    }

    /// As [`Self::at_turns`], from the [displacements](Self::displacements) that the temperatures cause.
    pub(crate) fn at_turns_of(&self, temperatures: &[Vec<f64>], displacements: &[Vec<f64>]) -> Vec<TurnValues> {
        let m = self.dehomogenization;
        let values = |(u, nodal): (&Vec<f64>, &Vec<f64>)| {
            let temperature = self.temperature_at_turns(nodal);
            let strain = |(p, t): (&Probe, &f64)| {
                let [rr, yy, hoop] = p.strain_of(u);
                (hoop, m.m_rx * rr + m.m_ry * yy + m.m_rz * hoop + m.m_rt * t)
            };
            let (axial, radial) = self.probes.iter().zip(&temperature).map(strain).unzip();
            TurnValues { temperature, axial, radial, bore: self.temperature_at_bore(nodal) }
        };
        displacements.iter().zip(temperatures).map(values).collect()
    }

    /// Nodal displacements caused by fields of nodal temperature \[m\], component fastest.
    pub(crate) fn displacements(&self, temperatures: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        let coupling = self.coupling()?;
        let loads: Vec<_> = temperatures.iter().map(|t| self.map.restrict(&coupling.multiply(t))).collect();
        Ok(at("structure", self.factor.solve(&loads))?.iter().map(|u| self.map.expand(u)).collect())
    }

    /// For each list of weights of the turns the adjoint displacements of their sums of axial and of radial strain.
    pub(crate) fn adjoints(&self, weights: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        let (nodes, m) = (self.grid.mesh().nodes().len(), self.dehomogenization);
        let mut loads = Vec::new();
        for weights in weights {
            let turns = Sums::new(&self.probes, weights.iter().copied(), nodes);
            let (mut axial, mut radial) = (vec![0.0; 2 * nodes], vec![0.0; 2 * nodes]);
            for node in 0..nodes {
                axial[2 * node] = turns.over_r[node];
                radial[2 * node] = m.m_rx * turns.d_r[node] + m.m_rz * turns.over_r[node];
                radial[2 * node + 1] = m.m_ry * turns.d_y[node];
            }
            loads.extend([self.map.restrict(&axial), self.map.restrict(&radial)]);
        }
        Ok(at("structure", self.factor.solve(&loads))?.iter().map(|u| self.map.expand(u)).collect())
    }

    /// Temperature of the hub's bore, which the tails share, from nodal temperatures \[K\].
    pub fn temperature_at_bore(&self, temperature: &[f64]) -> f64 {
        self.bore.value_of(temperature)
    }

    /// The fibre as slices for [`bias::bias`]: every turn, and the tails, which expand freely at the bore's temperature.
    ///
    /// # Errors
    /// [`Error::Solve`] if the solve leaves a residual.
    pub fn slices(&self, temperature_rate: &[f64]) -> Result<Vec<Slice>, Error> {
        let values = self.at_turns(&[temperature_rate.to_vec()])?.remove(0);
        Ok(values.slices(&self.winding, self.fibre_expansion))
    }

    fn problem(&self) -> Problem<'_> {
        Problem::new(self.grid.mesh(), Form::AXISYMMETRIC_ELASTICITY, self.grid.mesh().order() + 1)
    }

    /// Load of a nodal temperature; computed when it is first asked for, a uniform temperature does without.
    fn coupling(&self) -> Result<&Coupling, Error> {
        if let Some(coupling) = self.coupling.get() {
            return Ok(coupling);
        }
        let coupling = at("structure", self.problem().coupling(&self.thermal_stresses))?;
        Ok(self.coupling.get_or_init(|| coupling))
    }

    /// Parts of the bias that act on the temperature directly, and the adjoint displacements of the two elasto-optic parts.
    fn adjoint(&self) -> Result<(BiasOperator, Vec<Vec<f64>>), Error> {
        let nodes = self.grid.mesh().nodes().len();
        let (c, m) = (self.coefficients, self.dehomogenization);
        let turns = Sums::new(&self.probes, self.winding.weights(), nodes);
        let scaled = |factor: f64| turns.value.iter().map(|v| factor * v).collect::<Vec<_>>();
        let mut direct = BiasOperator {
            shupe: scaled(c.shupe),
            eo_axial: scaled(c.axial_per_temperature_rate),
            eo_radial: scaled(c.radial * m.m_rt + c.radial_per_temperature_rate),
        };
        let (mut axial, mut radial) = (vec![0.0; 2 * nodes], vec![0.0; 2 * nodes]);
        for node in 0..nodes {
            axial[2 * node] = c.axial * turns.over_r[node];
            radial[2 * node] = c.radial * (m.m_rx * turns.d_r[node] + m.m_rz * turns.over_r[node]);
            radial[2 * node + 1] = c.radial * m.m_ry * turns.d_y[node];
        }
        let w = self.winding.tail_weight();
        self.bore.add_value(&mut direct.shupe, w * c.shupe);
        self.bore.add_value(&mut direct.eo_axial, w * (c.axial * self.fibre_expansion + c.axial_per_temperature_rate));
        self.bore.add_value(&mut direct.eo_radial, w * (c.radial * self.fibre_expansion + c.radial_per_temperature_rate));
        let adjoint = at("structure", self.factor.solve(&[self.map.restrict(&axial), self.map.restrict(&radial)]))?;
        Ok((direct, adjoint))
    }

    /// The bias parts as functionals of the nodal temperature rate, by one adjoint solve each.
    ///
    /// # Errors
    /// [`Error::Solve`] if a solve leaves a residual.
    pub fn bias_operator(&self) -> Result<BiasOperator, Error> {
        let (mut operator, adjoint) = self.adjoint()?;
        self.add_through(&mut operator, self.coupling()?, &adjoint);
        Ok(operator)
    }

    /// The same, and what each relative change of the coil's transverse expansion adds to it: strains are linear in what expands.
    ///
    /// # Errors
    /// As [`Self::bias_operator`].
    pub fn bias_operator_and_per_expansion(&self) -> Result<[BiasOperator; 2], Error> {
        let (mut operator, adjoint) = self.adjoint()?;
        let none = vec![0.0; operator.shupe.len()];
        let mut per_expansion = BiasOperator { shupe: none.clone(), eo_axial: none.clone(), eo_radial: none };
        self.add_through(&mut operator, self.coupling()?, &adjoint);
        let coupling = at("structure", self.problem().coupling(&self.transverse_stresses))?;
        self.add_through(&mut per_expansion, &coupling, &adjoint);
        Ok([operator, per_expansion])
    }

    /// Adds to the elasto-optic parts of an operator what a temperature's load does by their adjoint displacements.
    fn add_through(&self, operator: &mut BiasOperator, coupling: &Coupling, adjoint: &[Vec<f64>]) {
        for (part, adjoint) in [&mut operator.eo_axial, &mut operator.eo_radial].into_iter().zip(adjoint) {
            let through = coupling.multiply_transposed(&self.map.expand(adjoint));
            part.iter_mut().zip(through).for_each(|(g, t)| *g += t);
        }
    }

    /// Bias in a steady ramp of 1 K/s: the operator applied to a uniform rate, whose load needs no matrix.
    ///
    /// # Errors
    /// [`Error::Solve`] if a solve leaves a residual.
    pub fn bias_in_ramp(&self) -> Result<Bias, Error> {
        let (direct, adjoint) = self.adjoint()?;
        let load = self.map.restrict(&at("structure", self.problem().loads(&self.thermal_stresses))?[0]);
        let through = |adjoint: &[f64]| adjoint.iter().zip(&load).map(|(a, l)| a * l).sum::<f64>();
        let sum = |part: &[f64]| part.iter().sum::<f64>();
        Ok(Bias {
            shupe: sum(&direct.shupe),
            eo_axial: sum(&direct.eo_axial) + through(&adjoint[0]),
            eo_radial: sum(&direct.eo_radial) + through(&adjoint[1]),
        })
    }
}

/// Stiffness \[Pa\] and thermal stress \[Pa/K\] of a solid region, strains in the order rr, yy, hoop, ry.
pub(crate) fn region_law(
    design: &Design,
    region: Region,
    state: &MechanicalState,
) -> Result<(DMatrix<f64>, DMatrix<f64>), Error> {
    let law = match (region, &design.spool) {
        (Region::Coil, _) | (_, None) => at("coil", state.elastic(&design.body.elastic).law())?,
        (_, Some(spool)) => at("spool", spool.material.elastic.law())?,
    };
    Ok(axisymmetric(&law))
}

/// Unknowns, factor, and thermal stress of each region.
type Assembled = (DofMap, Condensed, Vec<Option<DMatrix<f64>>>);

fn assemble(design: &Design, grid: &Grid, state: &MechanicalState) -> Result<Assembled, Error> {
    let mesh = grid.mesh();
    let mut laws = vec![None; Region::COUNT];
    let mut stresses = vec![None; Region::COUNT];
    for &region in grid.regions() {
        if laws[region as usize].is_none() {
            let (stiffness, stress) = region_law(design, region, state)?;
            (laws[region as usize], stresses[region as usize]) = (Some(stiffness), Some(stress));
        }
    }
    let problem = Problem::new(mesh, Form::AXISYMMETRIC_ELASTICITY, mesh.order() + 1);
    let mut constraints = Constraints::new(2 * mesh.nodes().len());
    for node in one_node_of_each_body(mesh) {
        at("structure", constraints.hold(2 * node + 1))?;
    }
    let map = constraints.eliminate(&problem.used(|_| true));
    let factor = at("structure", problem.condense(&map, &laws))?;
    Ok((map, factor, stresses))
}

/// Thermal stress of the coil's transverse expansion in a state, by regions; of the others nothing.
fn transverse_stresses(design: &Design, state: &MechanicalState) -> Result<Vec<Option<DMatrix<f64>>>, Error> {
    let with = |factor: f64| {
        let state = MechanicalState { transverse_expansion: factor, ..*state };
        region_law(design, Region::Coil, &state).map(|(_, stress)| stress)
    };
    let mut stresses = vec![None; Region::COUNT];
    stresses[Region::Coil as usize] = Some(with(1.0)? - with(0.0)?);
    Ok(stresses)
}

/// One node of every connected body: each is free to move along the axis until it is held.
fn one_node_of_each_body(mesh: &fem_core::Mesh) -> Vec<usize> {
    let mut body: Vec<usize> = (0..mesh.nodes().len()).collect();
    fn root(body: &mut [usize], mut i: usize) -> usize {
        while body[i] != i {
            body[i] = body[body[i]];
            i = body[i];
        }
        i
    }
    for element in mesh.elements() {
        let first = root(&mut body, element[0]);
        for &node in &element[1..] {
            let other = root(&mut body, node);
            body[other] = first;
        }
    }
    (0..body.len()).filter(|&i| body[i] == i).collect()
}
