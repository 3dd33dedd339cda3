//! The cell problems on a periodic mesh.

use super::response::anisotropy;
use super::{LOADS, Phase, Response, TEMPERATURE};
use crate::solve::dot;
use crate::{Error, Role};
use fem_core::material::ThermoElastic;
use fem_core::{Constraints, DofMap, Form, Mesh, Problem};
use nalgebra::{DMatrix, Matrix2, Matrix6, SMatrix, Vector6};
use rve_mesh::PeriodicMesh;

/// Loads of the in-plane problem.
const PLANE_LOADS: [usize; 5] = [0, 1, 2, 5, TEMPERATURE];
/// Voigt rows of the in-plane strains xx, yy, xy of [`Form::PLANE_STRAIN`].
const PLANE: [usize; 3] = [0, 1, 5];
/// Voigt rows of the gradient (∂x, ∂y) of the displacement along z; also its loads.
const ANTIPLANE: [usize; 2] = [4, 3];
/// A mesh's area must match the exact one to this relative tolerance.
const AREA_TOLERANCE: f64 = 1e-5;

/// The cell's fluctuations under each unit load and its response.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The mesh.
    pub mesh: Mesh,
    /// The mesh with its periodicity and the inclusion of each element.
    pub periodic: PeriodicMesh,
    /// The phases.
    pub phases: Vec<Phase>,
    /// Macroscopic response of the cell.
    pub response: Response,
    /// in-plane fluctuations (x, y at each node) of [`PLANE_LOADS`]
    plane: Vec<Vec<f64>>,
    /// fluctuations along z of [`ANTIPLANE`]
    antiplane: Vec<Vec<f64>>,
}

impl Solution {
    /// Solves on a given mesh.
    ///
    /// # Errors
    /// [`Error::Area`] if the mesh misses a phase's area; [`Error::Solve`].
    pub fn new(periodic: PeriodicMesh, phases: &[Phase]) -> Result<Self, Error> {
        let (nodes, elements) = (periodic.nodes.clone(), periodic.elements.clone());
        let mesh = Mesh::new(periodic.order, nodes, elements, periodic.phases.clone())?;
        let mut areas = Problem::new(&mesh, Form::DIFFUSION, mesh.order() + 2).region_measures()?;
        areas.resize(phases.len().max(areas.len()), 0.0);
        let mut area_error: f64 = 0.0;
        for (phase, (&area, &exact)) in
            areas.iter().zip(&periodic.phase_areas).enumerate().filter(|(_, (_, exact))| **exact > 0.0)
        {
            area_error = area_error.max((area / exact - 1.0).abs());
            if (area / exact - 1.0).abs() > AREA_TOLERANCE {
                let name = phases.get(phase).map_or_else(|| format!("phase {phase}"), |phase| phase.name.clone());
                return Err(Error::Area { phase, name, area, exact });
            }
        }
        let [[ax, ay], [bx, by]] = periodic.lattice;
        let whole = ax * by - ay * bx;
        let problem = CellProblem { mesh: &mesh, periodic: &periodic, phases, whole, areas: &areas };
        let mut response = Response {
            stiffness: Matrix6::zeros(),
            thermal_stress: Vector6::zeros(),
            conductivity: Matrix2::zeros(),
            conductivity_z: areas.iter().zip(phases).map(|(a, p)| a / whole * p.solid.conductivity_z).sum(),
            phase_strain: vec![SMatrix::zeros(); phases.len()],
            glass_strain: SMatrix::zeros(),
            fractions: areas.iter().map(|a| a / whole).collect(),
            anisotropy: 0.0,
            area_error,
            unknowns: 0,
        };
        let plane = problem.plane(&mut response)?;
        let antiplane = problem.antiplane(&mut response)?;
        response.conductivity = problem.conduction()?;
        response.anisotropy = anisotropy(&response.stiffness);
        let glass = |(_, phase): &(&f64, &Phase)| phase.role == Role::Glass;
        let glass_area: f64 = areas.iter().zip(phases).filter(glass).map(|(a, _)| a).sum();
        for ((area, _), strain) in areas.iter().zip(phases).zip(&response.phase_strain).filter(|(pair, _)| glass(pair)) {
            response.glass_strain += strain * (area / glass_area);
        }
        Ok(Self { mesh, periodic, phases: phases.to_vec(), response, plane, antiplane })
    }

    /// Fluctuation (x, y, z) of each node \[m\] under macroscopic strains and a temperature change, all loads together.
    pub(crate) fn fluctuation(&self, load: &SMatrix<f64, LOADS, 1>) -> Vec<[f64; 3]> {
        let sum = |solutions: &[Vec<f64>], loads: &[usize], i: usize| -> f64 {
            solutions.iter().zip(loads).map(|(u, &l)| u[i] * load[l]).sum()
        };
        let node = |n: usize| {
            let (x, y) = (sum(&self.plane, &PLANE_LOADS, 2 * n), sum(&self.plane, &PLANE_LOADS, 2 * n + 1));
            [x, y, sum(&self.antiplane, &ANTIPLANE, n)]
        };
        (0..self.mesh.nodes().len()).map(node).collect()
    }
}

struct CellProblem<'a> {
    mesh: &'a Mesh,
    periodic: &'a PeriodicMesh,
    phases: &'a [Phase],
    /// area of the cell, voids included
    whole: f64,
    areas: &'a [f64],
}

/// Stress per unit load at zero fluctuation.
fn source(law: &ThermoElastic, load: usize) -> Vector6<f64> {
    if load == TEMPERATURE { -law.thermal_stress } else { law.stiffness.column(load).into_owned() }
}

/// Fluctuations of some loads, and the work of all load vectors on them.
struct Solved {
    fluctuations: Vec<Vec<f64>>,
    work: Vec<Vec<f64>>,
    unknowns: usize,
}

impl CellProblem<'_> {
    fn map(&self, problem: &Problem, components: usize) -> Result<DofMap, Error> {
        let mut constraints = Constraints::new(self.mesh.nodes().len() * components);
        for c in 0..components {
            constraints.hold(c)?; // node 0: removes the translation
            for [copy, original] in &self.periodic.periodic {
                constraints.tie(copy * components + c, original * components + c, 1.0)?;
            }
        }
        Ok(constraints.eliminate(&problem.used(|_| true)))
    }

    /// Fluctuations of the first `count` loads.
    fn solve(&self, form: Form, laws: &[Option<DMatrix<f64>>], loads: &[Vec<f64>], count: usize) -> Result<Solved, Error> {
        let problem = Problem::new(self.mesh, form, self.mesh.order() + 2);
        let map = self.map(&problem, form.components)?;
        let factor = problem.condense(&map, laws)?;
        let reduced: Vec<_> = loads.iter().map(|f| map.restrict(f)).collect();
        let mut solutions = factor.solve(&reduced[..count])?;
        solutions.iter_mut().flatten().for_each(|u| *u = -*u);
        let work = solutions.iter().map(|u| reduced.iter().map(|f| dot(f, u)).collect()).collect();
        Ok(Solved { fluctuations: solutions.iter().map(|u| map.expand(u)).collect(), work, unknowns: factor.unknowns() })
    }

    /// Load vectors of `sources` (one column for each load, one row for each strain of `form`), then of the mean strains of each phase.
    fn loads(&self, form: Form, sources: impl Fn(&Phase) -> DMatrix<f64>) -> Result<Vec<Vec<f64>>, Error> {
        let problem = Problem::new(self.mesh, form, self.mesh.order() + 2);
        let stresses: Vec<_> = self.phases.iter().map(|p| Some(sources(p))).collect();
        let mut loads = problem.loads(&stresses)?;
        let rows = form.strains;
        for (phase, area) in self.areas.iter().enumerate() {
            let mean = |p: usize| (p == phase).then(|| DMatrix::identity(rows, rows) / *area);
            let means: Vec<_> = (0..self.phases.len()).map(mean).collect();
            let mut of_phase = problem.loads(&means)?;
            of_phase.resize(rows, vec![0.0; self.mesh.nodes().len() * form.components]);
            loads.extend(of_phase);
        }
        Ok(loads)
    }

    fn plane(&self, response: &mut Response) -> Result<Vec<Vec<f64>>, Error> {
        let stress = |p: &Phase| DMatrix::from_fn(3, 5, |i, j| source(&p.solid.law, PLANE_LOADS[j])[PLANE[i]]);
        let loads = self.loads(Form::PLANE_STRAIN, stress)?;
        let law = |p: &Phase| Some(DMatrix::from_fn(3, 3, |i, j| p.solid.law.stiffness[(PLANE[i], PLANE[j])]));
        let laws: Vec<_> = self.phases.iter().map(law).collect();
        let solved = self.solve(Form::PLANE_STRAIN, &laws, &loads, PLANE_LOADS.len())?;
        response.unknowns = solved.unknowns;
        for (work, load) in solved.work.iter().zip(PLANE_LOADS) {
            self.add(response, load, &PLANE_LOADS[..4], &PLANE, work);
            // nothing varies along z
            if load == 2 {
                response.phase_strain.iter_mut().for_each(|strain| strain[(2, 2)] = 1.0);
            }
        }
        Ok(solved.fluctuations)
    }

    fn antiplane(&self, response: &mut Response) -> Result<Vec<Vec<f64>>, Error> {
        let law = |p: &Phase| DMatrix::from_fn(2, 2, |i, j| p.solid.law.stiffness[(ANTIPLANE[i], ANTIPLANE[j])]);
        let loads = self.loads(Form::DIFFUSION, law)?;
        let laws: Vec<_> = self.phases.iter().map(|p| Some(law(p))).collect();
        let solved = self.solve(Form::DIFFUSION, &laws, &loads, ANTIPLANE.len())?;
        for (work, load) in solved.work.iter().zip(ANTIPLANE) {
            self.add(response, load, &ANTIPLANE, &ANTIPLANE, work);
        }
        Ok(solved.fluctuations)
    }

    /// Adds the mean stress and strains of `load`: of the uniform strain, and `work` of the stresses of `rows` and the means of `strains` on
    /// its fluctuation.
    fn add(&self, response: &mut Response, load: usize, rows: &[usize], strains: &[usize], work: &[f64]) {
        for (i, &row) in rows.iter().enumerate() {
            let uniform: f64 = self.areas.iter().zip(self.phases).map(|(a, p)| a * source(&p.solid.law, load)[row]).sum();
            let stress = (uniform + work[i]) / self.whole;
            if load == TEMPERATURE {
                response.thermal_stress[row] = -stress;
            } else {
                response.stiffness[(row, load)] = stress;
            }
        }
        let means = work[work.len() - strains.len() * self.phases.len()..].chunks(strains.len());
        for (strain, means) in response.phase_strain.iter_mut().zip(means) {
            for (&row, mean) in strains.iter().zip(means) {
                strain[(row, load)] = mean + f64::from(row == load);
            }
        }
    }

    fn conduction(&self) -> Result<Matrix2<f64>, Error> {
        let law = |p: &Phase| DMatrix::from_column_slice(2, 2, p.solid.conductivity.as_slice());
        let loads = self.loads(Form::DIFFUSION, law)?;
        let laws: Vec<_> = self.phases.iter().map(|p| Some(law(p))).collect();
        let solved = self.solve(Form::DIFFUSION, &laws, &loads, 2)?;
        let uniform = self.areas.iter().zip(self.phases).fold(Matrix2::zeros(), |sum, (a, p)| sum + p.solid.conductivity * *a);
        Ok((uniform + Matrix2::from_fn(|i, j| solved.work[j][i])) / self.whole)
    }
}
