//! The load on the cell, and the local state at a point of an element.

use super::Convention;
use crate::irregular::{LOADS, Solid, Solution, TEMPERATURE};
use nalgebra::{SMatrix, Vector6};

/// A macroscopic total strain and a temperature change.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Strain xx, yy, zz, yz, xz, xy with engineering shear; z = fibre.
    pub strain: Vector6<f64>,
    /// Temperature change \[K\].
    pub temperature: f64,
}

impl Load {
    /// The strains, then the temperature change.
    fn column(&self) -> SMatrix<f64, LOADS, 1> {
        let mut column = SMatrix::<f64, LOADS, 1>::zeros();
        column.fixed_view_mut::<6, 1>(0, 0).copy_from(&self.strain);
        column[TEMPERATURE] = self.temperature;
        column
    }
}

/// The cell under one load.
#[derive(Debug)]
pub struct Fields<'a> {
    pub(super) solution: &'a Solution,
    load: Load,
    /// of each node \[m\]
    fluctuation: Vec<[f64; 3]>,
    /// free expansion of each phase under the load
    free: Vec<Vector6<f64>>,
}

/// State at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Position \[m\].
    pub position: [f64; 2],
    /// Displacement x, y, z \[m\] at z = 0, less the rotation and translation that no strain determines.
    pub displacement: [f64; 3],
    /// Phase.
    pub phase: usize,
    /// Unit vector away from the axis of the inclusion; none in the matrix.
    pub axis: Option<[f64; 2]>,
    /// Total strain, Voigt order.
    pub strain: Vector6<f64>,
    /// Strain less the free expansion of the phase.
    pub mechanical: Vector6<f64>,
    /// Stress \[Pa\].
    pub stress: Vector6<f64>,
}

impl State {
    /// The strain in a convention.
    pub fn strain(&self, convention: Convention) -> &Vector6<f64> {
        match convention {
            Convention::Total => &self.strain,
            Convention::Mechanical => &self.mechanical,
        }
    }

    /// Von Mises' equivalent stress \[Pa\].
    pub fn von_mises(&self) -> f64 {
        let [x, y, z, yz, xz, xy]: [f64; 6] = self.stress.into();
        let normal = (x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2);
        (normal / 2.0 + 3.0 * (yz * yz + xz * xz + xy * xy)).sqrt()
    }
}

fn expansion(solid: &Solid) -> Vector6<f64> {
    // the law was checked: its stiffness is positive definite
    solid.law.stiffness.try_inverse().map_or_else(Vector6::zeros, |compliance| compliance * solid.law.thermal_stress)
}

impl<'a> Fields<'a> {
    /// The cell of `solution` under `load`.
    pub fn new(solution: &'a Solution, load: Load) -> Self {
        let free = solution.phases.iter().map(|p| expansion(&p.solid) * load.temperature).collect();
        Self { solution, load, fluctuation: solution.fluctuation(&load.column()), free }
    }

    /// The state in element `e` where the shape functions and their gradients are `shape`: N, ∂N/∂x, ∂N/∂y.
    pub(super) fn state(&self, e: usize, [value, dx, dy]: [&[f64]; 3]) -> State {
        let mesh = &self.solution.mesh;
        let (mut position, mut w, mut gradient) = ([0.0; 2], [0.0; 3], [[0.0; 2]; 3]);
        for (a, &node) in mesh.elements()[e].iter().enumerate() {
            (0..2).for_each(|c| position[c] += value[a] * mesh.nodes()[node][c]);
            for (c, u) in self.fluctuation[node].iter().enumerate() {
                w[c] += value[a] * u;
                gradient[c] = [gradient[c][0] + dx[a] * u, gradient[c][1] + dy[a] * u];
            }
        }
        let [[xx, xy], [yx, yy], [zx, zy]] = gradient;
        let macroscopic = &self.load.strain;
        let strain = macroscopic + Vector6::new(xx, yy, 0.0, zy, zx, xy + yx);
        let phase = mesh.regions()[e];
        let mechanical = strain - self.free[phase];
        let [x, y] = position;
        let displacement = [
            macroscopic[0] * x + macroscopic[5] / 2.0 * y + w[0],
            macroscopic[5] / 2.0 * x + macroscopic[1] * y + w[1],
            macroscopic[4] * x + macroscopic[3] * y + w[2],
        ];
        let axis = self.solution.periodic.inclusions[e].map(|i| self.solution.periodic.centres[i]).and_then(|[u, v]| {
            let distance = (x - u).hypot(y - v);
            (distance > 0.0).then(|| [(x - u) / distance, (y - v) / distance])
        });
        let stress = self.solution.phases[phase].solid.law.stiffness * mechanical;
        State { position, displacement, phase, axis, strain, mechanical, stress }
    }
}
