//! Fields of a cell as a VTK unstructured grid (`.vtu`, XML, text), for ParaView. SI.

use std::io::{self, Write};

use homogenization::fields::{Component, Convention, Sample, State};

/// VTK's number of a quadrilateral.
const QUADRILATERAL: usize = 9;
/// VTK's order of a symmetric tensor in Voigt rows, and its names.
const TENSOR: [(usize, &str, bool); 6] =
    [(0, "XX", false), (1, "YY", false), (2, "ZZ", false), (5, "XY", true), (3, "YZ", true), (4, "XZ", true)];

/// Writes the sampled fields: points of each element apart, so that strain and stress may jump; `inclusions` of each element.
///
/// Strains are tensors (shear components are half the engineering shears); radial and hoop strains are NaN in the matrix.
///
/// # Errors
/// What the writer says.
pub fn vtu(out: &mut dyn Write, sample: &Sample, inclusions: &[Option<usize>]) -> io::Result<()> {
    let (points, cells) = (sample.states.len(), sample.quadrilaterals.len());
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(out, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>")?;
    writeln!(out, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">")?;
    writeln!(out, "<Points>")?;
    array(out, sample, "position", &[], 3, |s| vec![s.position[0], s.position[1], 0.0])?;
    writeln!(out, "</Points>\n<PointData>")?;
    array(out, sample, "displacement_m", &[], 3, |s| s.displacement.to_vec())?;
    let names = TENSOR.map(|(_, name, _)| name);
    let strain = |convention: Convention| {
        move |s: &State| TENSOR.map(|(row, _, shear)| s.strain(convention)[row] * if shear { 0.5 } else { 1.0 }).to_vec()
    };
    array(out, sample, "total_strain", &names, 6, strain(Convention::Total))?;
    array(out, sample, "mechanical_strain", &names, 6, strain(Convention::Mechanical))?;
    array(out, sample, "stress_pa", &names, 6, |s| TENSOR.map(|(row, ..)| s.stress[row]).to_vec())?;
    for component in [Component::MeanRadial, Component::Radial, Component::Hoop] {
        for (name, convention) in [("total", Convention::Total), ("mechanical", Convention::Mechanical)] {
            let value = |s: &State| vec![component.of(s.strain(convention), s.axis).unwrap_or(f64::NAN)];
            array(out, sample, &format!("{name}_{}", component.name()), &[], 1, value)?;
        }
    }
    array(out, sample, "von_mises_pa", &[], 1, |s| vec![s.von_mises()])?;
    writeln!(out, "</PointData>\n<CellData>")?;
    whole(out, "Int32", "phase", sample.quadrilaterals.iter().map(|q| sample.states[q[0]].phase as i64))?;
    let of_element = sample.divisions * sample.divisions;
    let inclusion = |k: usize| inclusions.get(k / of_element).copied().flatten().map_or(-1, |i| i as i64);
    whole(out, "Int32", "inclusion", (0..cells).map(inclusion))?;
    writeln!(out, "</CellData>\n<Cells>")?;
    whole(out, "Int64", "connectivity", sample.quadrilaterals.iter().flatten().map(|&p| p as i64))?;
    whole(out, "Int64", "offsets", (1..=cells).map(|k| 4 * k as i64))?;
    whole(out, "UInt8", "types", (0..cells).map(|_| QUADRILATERAL as i64))?;
    writeln!(out, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

fn array(
    out: &mut dyn Write,
    sample: &Sample,
    name: &str,
    components: &[&str],
    count: usize,
    values: impl Fn(&State) -> Vec<f64>,
) -> io::Result<()> {
    let named: String = components.iter().enumerate().map(|(i, c)| format!(" ComponentName{i}=\"{c}\"")).collect();
    writeln!(out, "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{count}\"{named} format=\"ascii\">")?;
    for state in &sample.states {
        for value in values(state) {
            write!(out, "{value:.7e} ")?;
        }
        writeln!(out)?;
    }
    writeln!(out, "</DataArray>")
}

fn whole(out: &mut dyn Write, kind: &str, name: &str, values: impl Iterator<Item = i64>) -> io::Result<()> {
    writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">")?;
    for value in values {
        write!(out, "{value} ")?;
    }
    writeln!(out, "\n</DataArray>")
}
