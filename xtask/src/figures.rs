//! `cargo xtask figures`: the reference coil's figures as SVG files.

use std::path::Path;

use fogcoil::cache::Cache;
use fogcoil::homogenize::{Quantity, words};
use fogcoil::{figures, input, picture, picture_cell, simulate};
use homogenization::fields::{Component, Convention, Fields, Load};
use homogenization::irregular::{Arrangement, Cell};

use crate::validate::on_spools;
use proof::Failure;
use proof::validation::{over_spools, printed};

const COIL: &str = "fixtures/coil-reference.ron";
const PROFILE: &str = "fixtures/profiles/paper.csv";
const CELL: &str = "fixtures/cell-reference.ron";
/// Table IV: three coils of one design, with the design's sign.
const MEASURED: [figures::Measured; 3] = [("coil 1, measured", -3.01), ("coil 2, measured", -1.39), ("coil 3, measured", -1.98)];
/// Divisions of an element's side in the picture of the cell.
const DIVISIONS: usize = 12;

/// Draws all figures into `folder`, which is made if it is not there; always `true`.
pub(crate) fn run(folder: &Path) -> Result<bool, Failure> {
    let case = input::read_coil(COIL.as_ref())?;
    let profile = input::read_profile(PROFILE.as_ref(), &case.design, &[])?;
    let (model, fields) = simulate::model_with_fields(&case, &profile.drives, &Cache::NONE)?;
    let simulation = simulate::simulate(&case, &profile, &model)?;
    let mut documents = figures::documents(&simulation, Some(&fields), &MEASURED);
    documents.push(figures::convergence(&case)?);
    documents.push(("winding", picture::svg(&case.name, &case.winding)));
    documents.push(("cell", cell()?));
    let (label, value) = printed()?;
    documents.push(figures::spools(&on_spools(&over_spools()?), (&label, value)));
    documents.push(figures::signatures(&case, &Cache::of_user())?);
    std::fs::create_dir_all(folder)?;
    for (name, svg) in documents {
        let path = folder.join(format!("{name}.svg"));
        std::fs::write(&path, &svg)?;
        println!("{} ({} kB)", path.display(), svg.len().div_ceil(1000));
    }
    Ok(true)
}

/// The reference cell held in all directions and 10 K warmer: its radial strain.
fn cell() -> Result<String, Failure> {
    let case = input::read_cell(CELL.as_ref())?;
    let general = Cell::of_fibres(&case.cell, &Arrangement::hexagonal(case.cell.pitch, 1, 1)?)?;
    let load = Load { temperature: 10.0, ..Load::default() };
    let quantity = Quantity::Strain(Component::MeanRadial, Convention::Mechanical);
    let solution = general.homogenize_to(homogenization::TOLERANCE)?.solution;
    let caption = format!("{} under {}", quantity.label(), words(&load));
    let sample = Fields::new(&solution, load).sample(DIVISIONS);
    Ok(picture_cell::svg(&case.name, &caption, &solution, &sample, Some(quantity)))
}
