//! Dehomogenisation: strains at points against the means that the response knows, and against closed forms.

#![allow(clippy::unwrap_used)] // helpers of tests

use crate::common::{glass, reference, solid};
use approx::assert_relative_eq;
use homogenization::fields::{Component, Convention, Fields, Load};
use homogenization::irregular::{Arrangement, Cell, Inclusion, Layout, Outline, Phase, Solid};
use homogenization::{Role, homogenize};
use nalgebra::Vector6;

fn reference_cell() -> Cell {
    Cell::of_fibres(&reference(), &Arrangement::hexagonal(170e-6, 1, 1).unwrap()).unwrap()
}

fn load() -> Load {
    Load { strain: Vector6::new(1e-4, -2e-4, 3e-5, 5e-5, -4e-5, 7e-5), temperature: 12.0 }
}

/// Quadrature of the local fields returns the phase means that the solve knows by virtual work, and their sum the macroscopic strain.
#[test]
fn exact_means_of_the_fields_are_those_of_the_response() {
    let solution = reference_cell().solve(6, 1.0).unwrap();
    let (load, response) = (load(), &solution.response);
    let mut sum = Vector6::zeros();
    for phase in Fields::new(&solution, load).summary().unwrap() {
        let expected = response.phase_strain[phase.phase]
            * nalgebra::SVector::<f64, 7>::from_fn(|i, _| if i < 6 { load.strain[i] } else { load.temperature });
        for (row, component) in Component::ALL[..6].iter().enumerate() {
            let found = phase.get(*component, Convention::Total);
            assert!((found.mean - expected[row]).abs() < 1e-10 * load.strain.amax().max(expected.amax()), "{component:?}");
            assert!(found.least <= found.mean + 1e-15 && found.mean <= found.most + 1e-15);
            sum[row] += response.fractions[phase.phase] * found.mean;
        }
        let (radial, hoop) = (phase.get(Component::Radial, Convention::Total), phase.get(Component::Hoop, Convention::Total));
        if phase.phase == 3 {
            assert!(radial.mean.is_nan() && hoop.most.is_nan());
            continue;
        }
        // the trace does not depend on the axes
        let trace = 2.0 * phase.get(Component::MeanRadial, Convention::Total).mean;
        assert_relative_eq!(radial.mean + hoop.mean, trace, max_relative = 1e-9, epsilon = 1e-14);
    }
    assert!((sum - load.strain).amax() < 1e-10 * load.strain.amax(), "{sum}");
}

/// The row M is what the fields of the glass say.
#[test]
fn exact_row_m_from_the_fields() {
    let solution = reference_cell().solve(6, 1.0).unwrap();
    let c = homogenize(&reference()).unwrap().constants;
    let radial =
        |load: Load| Fields::new(&solution, load).summary().unwrap()[0].get(Component::MeanRadial, Convention::Total).mean;
    let strained = |i: usize| Load { strain: Vector6::from_fn(|k, _| f64::from(k == i)), temperature: 0.0 };
    for (found, exact) in [
        (radial(strained(0)), c.m_rx),
        (radial(strained(1)), c.m_ry),
        (radial(strained(2)), c.m_rz),
        (radial(Load { temperature: 1.0, ..Load::default() }), c.m_rt),
    ] {
        assert_relative_eq!(found, exact, max_relative = 1e-5);
    }
}

/// A free cell of one solid: total strain is free expansion, nothing is stressed, nothing strains mechanically.
#[test]
fn exact_conventions_in_free_expansion() {
    let mut cell = reference_cell();
    let matrix = Solid::isotropic(&solid(3e9, 0.38, 60e-6, 0.2)).unwrap();
    cell.phases.iter_mut().for_each(|p| p.solid = matrix);
    let solution = cell.solve(4, 1.0).unwrap();
    let free = Load { strain: Vector6::new(60e-6, 60e-6, 60e-6, 0.0, 0.0, 0.0) * 5.0, temperature: 5.0 };
    let fields = Fields::new(&solution, free);
    for phase in fields.summary().unwrap() {
        for component in [Component::Xx, Component::Yy, Component::Zz, Component::MeanRadial] {
            assert_relative_eq!(phase.get(component, Convention::Total).most, 300e-6, max_relative = 1e-8);
            assert!(phase.get(component, Convention::Mechanical).most.abs() < 1e-12);
        }
    }
    assert!(fields.sample(3).states.iter().all(|s| s.stress.amax() < 1.0 && s.von_mises() < 1.0));
}

/// A hole in a wide plate (Kirsch): under remote stress σ along x the hoop stress at the hole is 3σ at its flanks, −σ at its poles.
#[test]
fn exact_stress_concentration_at_a_void() {
    let phase = |name: &str, role| Phase { name: name.into(), solid: Solid::isotropic(&glass()).unwrap(), role };
    let layout = Layout::new([[1.0, 0.0], [0.0, 1.0]], vec![Inclusion::void(Outline::circle([0.5, 0.5], 0.02))], 0).unwrap();
    let solution = Cell { layout, phases: vec![phase("plate", Role::Glass)] }.solve(8, 1.0).unwrap();
    let compliance = solution.response.stiffness.try_inverse().unwrap();
    let strain = compliance * Vector6::new(1e6, 0.0, 0.0, 0.0, 0.0, 0.0);
    let sample = Fields::new(&solution, Load { strain, temperature: 0.0 }).sample(16);
    let most = sample.states.iter().map(|s| s.stress[0]).fold(0.0, f64::max);
    let least = sample.states.iter().map(|s| s.stress[1]).fold(0.0, f64::min);
    // the next hole is 50 radii away: corrections of some (a/d)^2
    assert_relative_eq!(most, 3e6, max_relative = 5e-3);
    assert_relative_eq!(least, -1e6, max_relative = 2e-2);
}

/// Over a small quadrilateral the displacement on its edges is the mean strain inside (Gauss' theorem), to second order in its size.
#[test]
fn the_displacement_has_the_strain_for_its_gradient() {
    let solution = reference_cell().solve(6, 1.0).unwrap();
    let fields = Fields::new(&solution, load());
    let off = |divisions: usize| {
        let sample = fields.sample(divisions);
        let (mut off, mut all) = (0.0, 0.0);
        for corners in &sample.quadrilaterals {
            let states = corners.map(|corner| sample.states[corner]);
            let (mut area, mut gradient) = (0.0, [[0.0; 2]; 3]);
            for (a, b) in (0..4).map(|k| (states[k], states[(k + 1) % 4])) {
                let [dx, dy] = [0, 1].map(|c| b.position[c] - a.position[c]);
                area += (a.position[0] * dy - a.position[1] * dx) / 2.0;
                for (c, row) in gradient.iter_mut().enumerate() {
                    let mean = (a.displacement[c] + b.displacement[c]) / 2.0;
                    (row[0], row[1]) = (row[0] + mean * dy, row[1] - mean * dx);
                }
            }
            let [[xx, xy], [yx, yy], [zx, zy]] = gradient;
            let inside = states.iter().map(|state| state.strain).sum::<Vector6<f64>>() / 4.0 * area;
            let around = Vector6::new(xx, yy, inside[2], zy, zx, xy + yx);
            (off, all) = (off + (around - inside).norm(), all + inside.norm());
        }
        off / all
    };
    let (coarse, fine) = (off(16), off(32));
    assert!(fine < 2e-3 && (3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
}
