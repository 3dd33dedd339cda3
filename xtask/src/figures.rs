//! `cargo xtask figures`: the reference coil's figures as SVG files.

use std::path::Path;

use fogcoil::cache::Cache;
use fogcoil::{figures, input, picture, simulate};

use crate::validate::Failure;

const COIL: &str = "fixtures/coil-reference.ron";
const PROFILE: &str = "fixtures/profiles/paper.csv";

/// Draws all figures into `folder`, which is made if it is not there; always `true`.
pub(crate) fn run(folder: &Path) -> Result<bool, Failure> {
    let case = input::read_coil(COIL.as_ref())?;
    let profile = input::read_profile(PROFILE.as_ref(), &case.design)?;
    let (model, fields) = simulate::model_with_fields(&case, &profile.drives, &Cache::NONE)?;
    let simulation = simulate::simulate(&case, &profile, &model)?;
    let mut documents = figures::documents(&simulation, Some(&fields));
    documents.push(figures::convergence(&case)?);
    documents.push(("winding", picture::svg(&case.name, &case.winding)));
    std::fs::create_dir_all(folder)?;
    for (name, svg) in documents {
        let path = folder.join(format!("{name}.svg"));
        std::fs::write(&path, &svg)?;
        println!("{} ({} kB)", path.display(), svg.len().div_ceil(1000));
    }
    Ok(true)
}
