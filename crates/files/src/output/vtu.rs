//! Fields of a cell as a VTK unstructured grid (`.vtu`), for ParaView. SI.

use std::io::{self, Write};

use homogenization::fields::{Component, Convention, Sample, State};
use vtu::{Array, Grid};

/// VTK's order of a symmetric tensor in Voigt rows, and its names.
const TENSOR: [(usize, &str, bool); 6] =
    [(0, "XX", false), (1, "YY", false), (2, "ZZ", false), (5, "XY", true), (3, "YZ", true), (4, "XZ", true)];

/// Writes the sampled fields: points of each element apart, so that strain and stress may jump; `inclusions` of each element.
///
/// Strains are tensors (shear components are half the engineering shears); radial and hoop strains are NaN in the matrix.
///
/// # Errors
/// The error of the writer.
pub fn vtu(out: &mut dyn Write, sample: &Sample, inclusions: &[Option<usize>]) -> io::Result<()> {
    let of_element = sample.divisions * sample.divisions;
    let inclusion = |k: usize| inclusions.get(k / of_element).copied().flatten().map_or(-1, |i| i as i32);
    let grid = Grid {
        points: sample.states.iter().map(|s| [s.position[0], s.position[1], 0.0]).collect(),
        quadrilaterals: sample.quadrilaterals.clone(),
        of_points: at_points(sample),
        of_cells: vec![
            Array::whole("phase", sample.quadrilaterals.iter().map(|q| sample.states[q[0]].phase as i32).collect()),
            Array::whole("inclusion", (0..sample.quadrilaterals.len()).map(inclusion).collect()),
        ],
    };
    grid.write(out)
}

fn at_points(sample: &Sample) -> Vec<Array> {
    let tensor = |name: &str, row: &dyn Fn(&State, usize, bool) -> f64| {
        let values = sample.states.iter().flat_map(|s| TENSOR.map(|(k, _, shear)| row(s, k, shear))).collect();
        Array::components(name, &TENSOR.map(|(_, name, _)| name), values)
    };
    let strain = |convention: Convention| {
        move |s: &State, row: usize, shear: bool| s.strain(convention)[row] * if shear { 0.5 } else { 1.0 }
    };
    let displacement = sample.states.iter().flat_map(|s| s.displacement).collect();
    let mut arrays = vec![
        Array::components("displacement_m", &["X", "Y", "Z"], displacement),
        tensor("total_strain", &strain(Convention::Total)),
        tensor("mechanical_strain", &strain(Convention::Mechanical)),
        tensor("stress_pa", &|s, row, _| s.stress[row]),
    ];
    for component in [Component::MeanRadial, Component::Radial, Component::Hoop] {
        for (name, convention) in [("total", Convention::Total), ("mechanical", Convention::Mechanical)] {
            let value = |s: &State| component.of(s.strain(convention), s.axis).unwrap_or(f64::NAN);
            arrays.push(Array::scalar(format!("{name}_{}", component.name()), sample.states.iter().map(value).collect()));
        }
    }
    arrays.push(Array::scalar("von_mises_pa", sample.states.iter().map(State::von_mises).collect()));
    arrays
}
