//! Constants, strains and what is identified of a few cells, held as they were.

use crate::common::{cells, on, reference, solve};
use crate::figures_kit::Figures;
use homogenization::fields::{Component, Convention, Fields, Load};
use homogenization::identify::literature::Kind;
use homogenization::identify::{Family, Prior, RingPrior, Target, Uncertainty, identify};
use homogenization::irregular::{Arrangement, Cell};
use homogenization::{Extent, Role, effective, homogenize};
use nalgebra::Vector6;

const KEPT: &str = include_str!("figures.txt");

#[test]
fn of_constants() {
    let mut figures = Figures::default();
    for (n, cell) in cells().enumerate() {
        figures.add(&format!("constants {n}"), &homogenize(&cell).unwrap().constants);
        // one element across a phase: far enough from converged that each number of the mesh shows
        let (effective, coarse) = solve(&cell, 3, Extent::Quarter);
        figures.add(&format!("constants {n} coarse"), &coarse);
        figures.add(&format!("constants {n} coarse across"), &effective.shear_moduli_across());
        figures.series(&format!("constants {n} stiffness"), effective.stiffness.as_slice());
    }
    let hexagon = effective(&reference(), &on(&reference(), 4, Extent::Whole)).unwrap();
    figures.series("constants of a whole hexagon", hexagon.stiffness.as_slice());
    figures.hold(KEPT, "constants");
}

#[test]
fn of_fields() {
    let mut figures = Figures::default();
    let cell = Cell::of_fibres(&reference(), &Arrangement::hexagonal(170e-6, 1, 1).unwrap()).unwrap();
    let solution = cell.solve(4, 1.0).unwrap();
    let load = Load { strain: Vector6::new(1e-4, -2e-4, 3e-5, 5e-5, -4e-5, 7e-5), temperature: 12.0 };
    let fields = Fields::new(&solution, load);
    for phase in fields.summary().unwrap() {
        for component in Component::ALL {
            for convention in [Convention::Total, Convention::Mechanical] {
                let spread = phase.get(component, convention);
                let name = format!("fields {} {} {convention:?}", phase.phase, component.name());
                figures.add(&name, &[spread.mean, spread.least, spread.most].map(|strain| 1e6 * strain));
            }
        }
    }
    let sample = fields.sample(2);
    let series = |of: &dyn Fn(&homogenization::fields::State) -> f64| sample.states.iter().map(of).collect::<Vec<f64>>();
    figures.series("fields x", &series(&|state| 1e6 * state.position[0]));
    figures.series("fields of von Mises", &series(&|state| state.von_mises()));
    for c in 0..3 {
        figures.series(&format!("fields displacement {c}"), &series(&|state| 1e9 * state.displacement[c]));
    }
    figures.add("fields corners", &(sample.quadrilaterals.len(), sample.quadrilaterals[1], sample.quadrilaterals.last()));
    figures.hold(KEPT, "fields");
}

#[test]
fn of_what_is_identified() {
    let mut figures = Figures::default();
    let silica = RingPrior {
        name: "silica".into(),
        outer_diameter: Prior::linear(124e-6, 126e-6),
        role: Role::Glass,
        material: Kind::Silica.prior(),
    };
    let family = Family { name: "bare".into(), pitch: 170e-6, rings: vec![silica], adhesive: Kind::Adhesive.prior() };
    for parameter in family.parameters() {
        figures.add("identified parameter", &parameter);
    }
    let middle = homogenize(&family.cell(&[0.0; 9]).unwrap()).unwrap().constants;
    let target = |name: &str, value: f64| Target::new(name, value, Uncertainty::Normal(0.02 * value)).unwrap();
    let targets = [target("e_z", 1.02 * middle.e_z), target("e_r", 0.9 * middle.e_r), target("alpha_r", middle.alpha_r)];
    let found = identify(std::slice::from_ref(&family), &targets, 1, &|_| {}).unwrap();
    let posterior = found.posterior.unwrap();
    // drawn: known to a few per cent
    let rough = |value: f64| (20.0 * value).round() / 20.0;
    figures.add("identified rank", &posterior.rank());
    let gains: Vec<f64> = posterior.directions.iter().map(|direction| rough(direction.shrinkage())).collect();
    figures.add("identified shrinkage", &gains);
    figures.hold(KEPT, "identified");
}
