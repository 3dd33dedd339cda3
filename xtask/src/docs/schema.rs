//! The schemas of docs/schema: those of files are what the types give; files and outputs keep theirs.

use std::fs;
use std::path::Path;
use std::process::Command;

use fogcoil::{input, schema};
use serde_json::Value;

use super::notation;
use proof::{Failure, files};

const FOLDER: &str = "docs/schema";

const FILES: [(&str, &str); 11] = [
    ("coil", "fixtures/coil-reference.ron"),
    ("coil", "crates/fogcoil/templates/coil.ron"),
    ("cell", "fixtures/cell-reference.ron"),
    ("cell", "fixtures/cells/displaced.ron"),
    ("cell", "fixtures/cells/faults.ron"),
    ("cell", "fixtures/cells/temperature.ron"),
    ("cell", "crates/fogcoil/templates/cell.ron"),
    ("targets", "fixtures/identify/table-one.ron"),
    ("targets", "crates/fogcoil/templates/targets.ron"),
    ("meta", "fixtures/concealed/open/case_13/meta.ron"),
    ("map", "fixtures/recordings/logger.map.ron"),
];

/// Commands whose output must keep a schema. COIL, CELL, PROFILE, FIT and HOLDOUT stand for files.
const OUTPUTS: [(&str, &str); 19] = [
    ("homogenize", "homogenize CELL --json"),
    ("homogenize", "homogenize fixtures/cells/temperature.ron --temperatures -40,20 --tolerance 1e-3 --load dt=10 --json"),
    ("identify", "identify fixtures/identify/table-one.ron --json"),
    ("wind", "wind COIL --json"),
    ("sensitivity", "sensitivity COIL --json"),
    ("compare", "compare COIL fixtures/ordinary/B/drawing.ron --json"),
    ("compare", "compare COIL COIL --profile PROFILE --json"),
    ("sweep", "sweep fixtures/plans/spools.ron --out OUT.csv --json"),
    ("trim", "trim COIL --profile PROFILE --json"),
    ("simulate", "simulate COIL --profile PROFILE --out OUT --json"),
    ("check", "check fixtures/recordings/logger.csv --json"),
    ("check", "check FIT --json"),
    ("measure", "measure fixtures/recordings/logger.csv --json"),
    ("measure", "measure FIT COIL --json"),
    ("explain", "explain COIL --sensitivity 1.39 --json"),
    ("glossary", "explain --json"),
    ("diagnose", "diagnose COIL --fit FIT --holdout HOLDOUT --json"),
    ("diagnose", "diagnose COIL --fit fixtures/concealed/open/case_16/fit.csv --json"),
    ("recommend", "recommend COIL --between debond,nominal --json"),
];

pub(super) fn write(root: &Path) -> Result<(), Failure> {
    for (name, schema) in input::schemas() {
        fs::write(root.join(file(name)), text(&schema))?;
    }
    Ok(())
}

/// Whether the schemas of files are what the types give, and the project's files keep them.
pub(super) fn files(root: &Path) -> Result<Vec<String>, Failure> {
    let mut faults = Vec::new();
    for (name, schema) in input::schemas() {
        if fs::read_to_string(root.join(file(name))).ok() != Some(text(&schema)) {
            faults.push(format!("{}: is not what the types give; write it by `cargo xtask docs-check --write`", file(name)));
        }
    }
    for (name, path) in FILES {
        let read = files::read(&root.join(path))?;
        let of = input::schemas().into_iter().find(|(of, _)| *of == name).map_or(Value::Null, |(_, schema)| schema);
        match notation::json(&read) {
            Ok(value) => faults.extend(schema::misfit(&value, &of).map(|misfit| format!("{path}: {}: {misfit}", file(name)))),
            Err((line, problem)) => faults.push(format!("{path}:{line}: {problem}")),
        }
    }
    Ok(faults)
}

/// Whether what the program at `program` prints keeps its schemas.
pub(super) fn outputs(root: &Path, program: &Path, cache: &Path) -> Result<Vec<String>, Failure> {
    let out = tempfile::NamedTempFile::new()?;
    let table = tempfile::Builder::new().suffix(".csv").tempfile()?;
    let case = |name: &str| format!("fixtures/concealed/open/case_13/{name}.csv");
    let meant = |word: &str| match word {
        "COIL" => "fixtures/coil-reference.ron".into(),
        "CELL" => "fixtures/cell-reference.ron".into(),
        "PROFILE" => "crates/fogcoil/templates/profile.csv".into(),
        "FIT" => case("fit"),
        "HOLDOUT" => case("holdout"),
        "OUT" => out.path().display().to_string(),
        "OUT.csv" => table.path().display().to_string(),
        other => other.to_owned(),
    };
    let mut faults = Vec::new();
    for (name, command) in OUTPUTS {
        let of = files::read(&root.join(file(name)))?;
        let of: Value = serde_json::from_str(&of)?;
        let mut run = Command::new(program);
        run.args(command.split(' ').map(meant)).current_dir(root).env("FOGCOIL_CACHE", cache);
        let output = run.output()?;
        let said = String::from_utf8_lossy(&output.stderr);
        let fault = match serde_json::from_slice(&output.stdout) {
            Ok(value) if output.status.success() => schema::misfit(&value, &of),
            Ok(_) => Some(format!("{}: {said}", output.status)),
            Err(error) => Some(format!("prints no JSON: {error}: {said}")),
        };
        faults.extend(fault.map(|fault| format!("`fogcoil {command}`: {}: {fault}", file(name))));
    }
    Ok(faults)
}

fn file(name: &str) -> String {
    format!("{FOLDER}/{name}.schema.json")
}

fn text(schema: &Value) -> String {
    format!("{schema:#}\n")
}
