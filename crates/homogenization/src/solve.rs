//! Periodic cell problems: fluctuations under unit macroscopic loads, effective stiffness, thermal stress, conductivity.

use crate::cell::Phases;
use crate::{Error, FibreCell};
use fem_core::material::ThermoElastic;
use fem_core::{Condensed, Constraints, DofMap, Form, Mesh, Problem, polynomial};
use nalgebra::{DMatrix, Matrix2, Matrix6, SMatrix, Vector6};
use rve_mesh::{CellMesh, Extent, Resolution};

/// Order and mesh of one cell solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Discretization {
    /// Polynomial order of the elements.
    pub order: usize,
    /// Divisions of the mesh.
    pub resolution: Resolution,
    /// Whole cell or its symmetric quarter.
    pub extent: Extent,
}

/// In-plane loads in the order xx, yy, zz, xy, ΔT.
pub(crate) const LOADS: usize = 5;
/// Voigt rows of the first four loads.
pub(crate) const VOIGT: [usize; 4] = [0, 1, 2, 5];
/// The load whose macroscopic strain each row of the glass strain (xx, yy, xy) matches.
pub(crate) const GLASS_ROWS: [usize; 3] = [0, 1, 3];
/// Voigt rows of the in-plane strains xx, yy, xy of [`Form::PLANE_STRAIN`].
const PLANE: [usize; 3] = [0, 1, 5];
/// A mesh's area must match the exact one to this relative tolerance (an order-4 arc of 30° is within 1e-8).
const AREA_TOLERANCE: f64 = 1e-6;

/// Effective response of a cell: macroscopic stress `C ε − β ΔT`, heat flux `−k ∇T`, and the mean strain of the glass.
#[derive(Debug, Clone, PartialEq)]
pub struct Effective {
    /// Stiffness \[Pa\], Voigt order xx, yy, zz, yz, xz, xy, z = fibre.
    pub stiffness: Matrix6<f64>,
    /// Thermal stress vector \[Pa/K\].
    pub thermal_stress: Vector6<f64>,
    /// Conductivity across the fibre \[W/(m K)\].
    pub conductivity: Matrix2<f64>,
    /// Conductivity along the fibre \[W/(m K)\].
    pub conductivity_z: f64,
    /// Mean strains xx, yy, xy of the glass (rows) per unit macroscopic xx, yy, zz, xy and per K at zero macroscopic strain.
    pub glass_strain: SMatrix<f64, 3, LOADS>,
    /// Unknowns of the in-plane problem (its largest system).
    pub unknowns: usize,
    /// Largest relative difference between a phase's meshed and exact area.
    pub area_error: f64,
}

impl Effective {
    /// The conductivity along the fibre; what takes a solution is to be added.
    pub(crate) fn begun(phases: &Phases) -> Self {
        Self {
            stiffness: Matrix6::zeros(),
            thermal_stress: Vector6::zeros(),
            conductivity: Matrix2::zeros(),
            conductivity_z: phases.mean(|i| phases.conductivities[i]),
            glass_strain: SMatrix::zeros(),
            unknowns: 0,
            area_error: 0.0,
        }
    }
}

/// A cell on its mesh, with its constituents' laws.
pub(crate) struct CellProblem {
    mesh: Mesh,
    cell_mesh: CellMesh,
    phases: Phases,
    area: f64,
    area_error: f64,
    volumetric: Integration,
}

/// How the volumetric part of the plane stiffness, `λ (ε_xx + ε_yy + ε_zz)² / 2`, and of its loads is integrated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Integration {
    /// As everything else, with two points per direction more than the order.
    Full,
    /// With as many points per direction as the order: elements of low order do not lock where a solid is nearly incompressible.
    Reduced,
}

/// One symmetry class of loads with the displacement components that vanish on the mirror planes.
struct Class<'a> {
    loads: &'a [usize],
    on_mirror_x: Option<usize>,
    on_mirror_y: Option<usize>,
}

impl CellProblem {
    pub(crate) fn new(cell: &FibreCell, d: &Discretization, volumetric: Integration) -> Result<Self, Error> {
        let mut phases = Phases::new(cell)?;
        let outline = cell.outline()?;
        let cell_mesh = rve_mesh::mesh(&outline, d.extent, &d.resolution, &polynomial::gauss_lobatto(d.order))?;
        let mesh = Mesh::new(d.order, cell_mesh.nodes.clone(), cell_mesh.elements.clone(), cell_mesh.phases.clone())?;
        let areas = Problem::new(&mesh, Form::DIFFUSION, d.order + 2).region_measures()?;
        let area = areas.iter().sum::<f64>();
        let share = (outline.area() / area).round().recip(); // 1 or a quarter
        let mut area_error: f64 = 0.0;
        for (phase, (area, exact)) in areas.iter().zip(outline.phase_areas()).enumerate() {
            let exact = exact * share;
            area_error = area_error.max((area / exact - 1.0).abs());
            if (area / exact - 1.0).abs() > AREA_TOLERANCE {
                return Err(Error::Area { phase, name: cell.phase_name(phase), area: *area, exact });
            }
        }
        phases.fractions = areas.iter().map(|a| a / area).collect();
        Ok(Self { mesh, cell_mesh, phases, area, area_error, volumetric })
    }

    fn map(&self, problem: &Problem, components: usize, class: &Class) -> Result<DofMap, Error> {
        let mut constraints = Constraints::new(self.mesh.nodes().len() * components);
        let symmetry = &self.cell_mesh.symmetry;
        for c in 0..components {
            constraints.hold(c)?; // the fibre axis, node 0: removes the translation, zero by symmetry in every class
            for [slave, master] in &symmetry.translations {
                constraints.tie(slave * components + c, master * components + c, 1.0)?;
            }
            for [slave, master] in &symmetry.inversions {
                constraints.tie(slave * components + c, master * components + c, -1.0)?;
            }
        }
        for (nodes, held) in [(&symmetry.mirror_x, class.on_mirror_x), (&symmetry.mirror_y, class.on_mirror_y)] {
            for node in nodes {
                held.map_or(Ok(()), |c| constraints.hold(node * components + c))?;
            }
        }
        Ok(constraints.eliminate(&problem.used(|_| true)))
    }

    /// Whole cell: all loads on one system. Quarter: loads that are even and odd about the mirror planes apart.
    fn classes(&self, [symmetric, odd, all]: [&'static [usize]; 3], plane: bool) -> Vec<Class<'static>> {
        if self.cell_mesh.symmetry.mirror_x.is_empty() {
            return vec![Class { loads: all, on_mirror_x: None, on_mirror_y: None }];
        }
        let other = plane.then_some(1);
        vec![
            Class { loads: symmetric, on_mirror_x: Some(0), on_mirror_y: other },
            Class { loads: odd, on_mirror_x: other, on_mirror_y: Some(0) },
        ]
    }

    /// Stress (xx, yy, xy) of each in-plane load at zero fluctuation, for one phase; and of zz beside it.
    fn source(law: &ThermoElastic, load: usize) -> Vector6<f64> {
        if load == 4 { -law.thermal_stress } else { law.stiffness.column(VOIGT[load]).into_owned() }
    }

    /// Load `∫ B` of stresses (xx, yy, xy) that xx and yy share: one column per load.
    fn volumetric(stresses: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(3, stresses.len(), |i, j| if i < 2 { stresses[j] } else { 0.0 })
    }

    fn condense(&self, problem: &Problem, map: &DofMap) -> Result<Condensed, Error> {
        let law = |l: &ThermoElastic| DMatrix::from_fn(3, 3, |i, j| l.stiffness[(PLANE[i], PLANE[j])]);
        let laws: Vec<_> = self.phases.laws.iter().map(law).collect();
        if self.volumetric == Integration::Full {
            return Ok(problem.condense(map, &laws.into_iter().map(Some).collect::<Vec<_>>())?);
        }
        let volumetric: Vec<_> = laws.iter().map(|d| Self::volumetric(&[d[(0, 1)], d[(0, 1)], 0.0])).collect();
        let rest: Vec<_> = laws.into_iter().zip(&volumetric).map(|(d, v)| Some(d - v)).collect();
        Ok(problem.condense_selective(map, &rest, &self.fewer_points(), &volumetric.into_iter().map(Some).collect::<Vec<_>>())?)
    }

    fn fewer_points(&self) -> Problem<'_> {
        Problem::new(&self.mesh, Form::PLANE_STRAIN, self.mesh.order())
    }

    /// Full load vectors: the five sources, then the glass means of xx, yy, xy.
    fn plane_loads(&self, problem: &Problem) -> Result<Vec<Vec<f64>>, Error> {
        let source = |law: &ThermoElastic| DMatrix::from_fn(3, LOADS, |i, load| Self::source(law, load)[PLANE[i]]);
        let sources: Vec<_> = self.phases.laws.iter().map(source).collect();
        let mut loads = if self.volumetric == Integration::Full {
            problem.loads(&sources.into_iter().map(Some).collect::<Vec<_>>())?
        } else {
            let part = |law: &ThermoElastic| {
                let lambda = law.stiffness[(0, 1)];
                Self::volumetric(&[lambda, lambda, lambda, 0.0, -law.thermal_stress[0]])
            };
            let parts: Vec<_> = self.phases.laws.iter().map(part).collect();
            let rest = sources.into_iter().zip(&parts).map(|(source, part)| Some(source - part));
            let mut loads = problem.loads(&rest.collect::<Vec<_>>())?;
            let fewer = self.fewer_points().loads(&parts.into_iter().map(Some).collect::<Vec<_>>())?;
            loads.iter_mut().flatten().zip(fewer.iter().flatten()).for_each(|(sum, part)| *sum += part);
            loads
        };
        let glass_area: f64 =
            self.area * self.phases.fractions.iter().zip(&self.phases.glass).filter(|(_, g)| **g).map(|(f, _)| f).sum::<f64>();
        let means = self.phases.glass.iter().map(|g| g.then(|| DMatrix::identity(3, 3) / glass_area));
        loads.extend(problem.loads(&means.collect::<Vec<_>>())?);
        Ok(loads)
    }

    pub(crate) fn effective(&self) -> Result<Effective, Error> {
        let mut effective = Effective { area_error: self.area_error, ..Effective::begun(&self.phases) };
        self.plane(&mut effective)?;
        let shear = |l: &ThermoElastic| DMatrix::from_fn(2, 2, |i, j| l.stiffness[(4 - i, 4 - j)]);
        let antiplane = self.scalar(&self.phases.laws.iter().map(|l| Some(shear(l))).collect::<Vec<_>>())?;
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            effective.stiffness[(4 - i, 4 - j)] = antiplane[(i, j)];
        }
        effective.conductivity =
            self.scalar(&self.phases.conductivities.iter().map(|k| Some(DMatrix::identity(2, 2) * *k)).collect::<Vec<_>>())?;
        Ok(effective)
    }

    fn plane(&self, effective: &mut Effective) -> Result<(), Error> {
        let problem = Problem::new(&self.mesh, Form::PLANE_STRAIN, self.mesh.order() + 2);
        let loads = self.plane_loads(&problem)?;
        let mean = |load: usize, row: usize| self.phases.mean(|i| Self::source(&self.phases.laws[i], load)[row]);
        for load in 0..LOADS {
            self.add_macroscopic(effective, load, |voigt| mean(load, voigt));
        }
        for class in self.classes([&[0, 1, 2, 4], &[3], &[0, 1, 2, 3, 4]], true) {
            let map = self.map(&problem, 2, &class)?;
            let factor = self.condense(&problem, &map)?;
            effective.unknowns = effective.unknowns.max(factor.unknowns());
            let reduced: Vec<_> = loads.iter().map(|f| map.restrict(f)).collect();
            let rhs: Vec<_> = class.loads.iter().map(|&load| reduced[load].clone()).collect();
            for (&load, u) in class.loads.iter().zip(factor.solve(&rhs)?) {
                // the fluctuation is −u
                self.add_fluctuation(effective, load, class.loads, |i| -dot(&reduced[i], &u));
            }
        }
        Ok(())
    }

    fn add_macroscopic(&self, effective: &mut Effective, load: usize, stress: impl Fn(usize) -> f64) {
        for voigt in VOIGT {
            if load == 4 {
                effective.thermal_stress[voigt] -= stress(voigt);
            } else {
                effective.stiffness[(voigt, VOIGT[load])] += stress(voigt);
            }
        }
        if let Some(row) = GLASS_ROWS.iter().position(|like| *like == load) {
            effective.glass_strain[(row, load)] += 1.0;
        }
    }

    /// Adds what the fluctuation of `load` contributes; responses outside its symmetry class `rows` vanish.
    fn add_fluctuation(&self, effective: &mut Effective, load: usize, rows: &[usize], product: impl Fn(usize) -> f64) {
        for &row in rows.iter().filter(|row| **row < 4) {
            let stress = product(row) / self.area;
            if load == 4 {
                effective.thermal_stress[VOIGT[row]] -= stress;
            } else {
                effective.stiffness[(VOIGT[row], VOIGT[load])] += stress;
            }
        }
        for row in (0..GLASS_ROWS.len()).filter(|row| rows.contains(&GLASS_ROWS[*row])) {
            effective.glass_strain[(row, load)] += product(LOADS + row);
        }
    }

    /// Effective 2×2 matrix of a scalar problem (antiplane shear, conduction).
    fn scalar(&self, laws: &[Option<DMatrix<f64>>]) -> Result<Matrix2<f64>, Error> {
        let problem = Problem::new(&self.mesh, Form::DIFFUSION, self.mesh.order() + 2);
        let loads = problem.loads(laws)?;
        let mut effective = Matrix2::zeros();
        for (f, law) in self.phases.fractions.iter().zip(laws.iter().flatten()) {
            effective += law.fixed_view::<2, 2>(0, 0) * *f;
        }
        for class in self.classes([&[0], &[1], &[0, 1]], false) {
            let map = self.map(&problem, 1, &class)?;
            let factor = problem.condense(&map, laws)?;
            let reduced: Vec<_> = loads.iter().map(|f| map.restrict(f)).collect();
            let rhs: Vec<_> = class.loads.iter().map(|&load| reduced[load].clone()).collect();
            for (&j, u) in class.loads.iter().zip(factor.solve(&rhs)?) {
                for &i in class.loads {
                    effective[(i, j)] -= dot(&reduced[i], &u) / self.area;
                }
            }
        }
        Ok(effective)
    }

    /// The cell under macroscopic strain (xx, yy, zz) and ΔT = 1 in one solve of its own: mean strains xx, yy of the glass and the
    /// mean stress (xx, yy, zz) by a second solve-free route, the virtual work of the unit macroscopic strains.
    pub(crate) fn combined(&self, strain: [f64; 3]) -> Result<([f64; 2], [f64; 3]), Error> {
        let problem = Problem::new(&self.mesh, Form::PLANE_STRAIN, self.mesh.order() + 2);
        let class = Class { loads: &[], on_mirror_x: Some(0), on_mirror_y: Some(1) };
        let map = self.map(&problem, 2, &class)?;
        let total = |law: &ThermoElastic| {
            law.stiffness * Vector6::new(strain[0], strain[1], strain[2], 0.0, 0.0, 0.0) - law.thermal_stress
        };
        let stresses: Vec<_> = self.phases.laws.iter().map(|l| Some(DMatrix::from_fn(3, 1, |i, _| total(l)[PLANE[i]]))).collect();
        let load = map.restrict(&problem.loads(&stresses)?[0]);
        let factor = self.condense(&problem, &map)?;
        let u = factor.solve(&[load])?;
        let reduced: Vec<_> = self.plane_loads(&problem)?.iter().map(|f| map.restrict(f)).collect();
        let mean = |row: usize| self.phases.mean(|i| total(&self.phases.laws[i])[row]);
        let glass = [0, 1].map(|row| strain[row] - dot(&reduced[LOADS + row], &u[0]));
        let stress = [0, 1, 2].map(|row| mean(row) - dot(&reduced[row], &u[0]) / self.area);
        Ok((glass, stress))
    }
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
