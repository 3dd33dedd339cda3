//! The pages that are looked at, made from the fixtures.

use std::fs;
use std::path::{Path, PathBuf};

use fogcoil::cache::Cache;
use fogcoil::diagnose::diagnose;
use fogcoil::figures::Convergence;
use fogcoil::input::{self, RecordOptions};
use fogcoil::{report, simulate};

use crate::validate;
use proof::Failure;

const COIL: &str = "fixtures/coil-reference.ron";
const PROFILE: &str = "fixtures/profiles/paper.csv";
/// Units of fixtures/concealed/open by what is said of them.
const UNITS: [(&str, &str); 3] = [("explained", "case_13"), ("unknown", "case_16"), ("none", "case_09")];

/// Writes all pages into `folder`; their files.
pub(super) fn all(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let case = input::read_coil(COIL.as_ref())?;
    let cache = Cache::of_user();
    let mut files = Vec::new();
    let mut write = |name: &str, html: String| -> Result<(), Failure> {
        let path = folder.join(format!("{name}.html"));
        eprintln!("{} ({} kB)", path.display(), html.len().div_ceil(1000));
        files.push(path.canonicalize().or_else(|_| fs::write(&path, "").and_then(|()| path.canonicalize()))?);
        Ok(fs::write(path, html)?)
    };
    let profile = input::read_profile(PROFILE.as_ref(), &case.design, &[])?;
    let (model, fields) = simulate::model_with_fields(&case, &profile.drives, &cache)?;
    let simulation = simulate::simulate(&case, &profile, &model)?;
    write("simulate", report::html(&simulation, Some(&fields), Some(&Convergence::measure(&case, &cache)?), None))?;
    for (verdict, unit) in UNITS {
        let record = |file: &str| {
            let path = Path::new("fixtures/concealed/open").join(unit).join(file);
            input::read_record(&path, &RecordOptions::default())
        };
        let outcome =
            diagnose(&case, mechanisms::CATALOGUE, &[], &[record("fit.csv")?], &[record("holdout.csv")?], &cache, &|_| ())?;
        write(&format!("diagnose-{verdict}"), outcome.report())?;
    }
    write("validate", validate::html()?)?;
    Ok(files)
}
