//! The licences of the packages that the program holds, as each of them asks to be passed on.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use proof::Failure;
use proof::files::names;
use serde_json::Value;

use crate::tools::{cargo, printed};

/// Beginnings of the names of files with the terms under which a package is passed on.
const NAMES: [&str; 6] = ["license", "licence", "copying", "copyright", "notice", "unlicense"];

/// Every package within the program on this platform with its licence, and every text once.
pub(super) fn of_packages(platform: &str) -> Result<String, Failure> {
    let arguments = ["metadata", "--locked", "--format-version", "1", "--filter-platform", platform];
    let metadata: Value = serde_json::from_str(&printed(cargo().args(arguments).current_dir(proof::files::root()))?)?;
    let within = within(&metadata);
    let mut list = BTreeMap::new();
    let mut texts: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let packages = metadata["packages"].as_array().into_iter().flatten();
    // packages without a source are our own
    for package in packages.filter(|p| p["source"].is_string() && p["id"].as_str().is_some_and(|id| within.contains(id))) {
        let text = |key: &str| package[key].as_str().unwrap_or_default();
        let name = format!("{} {}", text("name"), text("version"));
        let found = of_package(Path::new(text("manifest_path")).parent().unwrap_or(Path::new("")))?;
        found.into_iter().for_each(|found| texts.entry(found).or_default().push(name.clone()));
        list.insert(name, text("license").to_owned());
    }
    let listed: String = list.iter().map(|(name, licence)| format!("{name}: {licence}\n")).collect();
    let quoted = texts.into_iter().map(|(text, of)| format!("\n{}\n{}:\n\n{text}\n", "-".repeat(80), of.join(", ")));
    Ok(format!(
        "The program holds these packages, each under the terms beside it; their texts follow.\n\n{listed}{}",
        quoted.collect::<String>()
    ))
}

/// Ids of what the program needs when it runs.
fn within(metadata: &Value) -> BTreeSet<&str> {
    let nodes = metadata["resolve"]["nodes"].as_array().into_iter().flatten();
    let nodes: BTreeMap<&str, &Value> = nodes.filter_map(|node| Some((node["id"].as_str()?, node))).collect();
    let program = nodes.keys().copied().find(|id| id.contains("/crates/fogcoil#"));
    let (mut found, mut open) = (BTreeSet::new(), Vec::from_iter(program));
    while let Some(id) = open.pop() {
        if found.insert(id) {
            let needed = nodes.get(id).and_then(|node| node["deps"].as_array()).into_iter().flatten();
            let runs =
                |need: &&Value| need["dep_kinds"].as_array().is_some_and(|all| all.iter().any(|kind| kind["kind"].is_null()));
            open.extend(needed.filter(runs).filter_map(|need| need["pkg"].as_str()));
        }
    }
    found
}

/// The texts in a package's folder.
fn of_package(folder: &Path) -> Result<Vec<String>, Failure> {
    let files = names(folder)?.into_iter().filter(|name| NAMES.iter().any(|begin| name.to_lowercase().starts_with(begin)));
    let paths = files.map(|name| folder.join(name)).filter(|path| path.is_file());
    Ok(paths.filter_map(|path| fs::read_to_string(path).ok()).map(|text| text.trim_end().replace('\r', "")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn what_only_builds_or_tests_the_program_is_left_out() {
        let needs = |id: &str, kind: Value| json!({"pkg": id, "dep_kinds": [{"kind": kind}]});
        let metadata = json!({"resolve": {"nodes": [
            {"id": "path+file:///x/crates/fogcoil#0.1.0", "deps": [needs("a", Value::Null), needs("b", json!("dev")), needs("c", json!("build"))]},
            {"id": "a", "deps": [needs("d", Value::Null)]},
            {"id": "c", "deps": [needs("e", Value::Null)]},
        ]}});
        assert_eq!(within(&metadata).into_iter().collect::<Vec<_>>(), ["a", "d", "path+file:///x/crates/fogcoil#0.1.0"]);
    }

    #[test]
    fn texts_are_told_by_the_names_of_their_files() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [("LICENSE-MIT", "mit\r\n"), ("Copying", "copy"), ("README.md", "read")] {
            fs::write(folder.path().join(name), text).unwrap();
        }
        assert_eq!(of_package(folder.path()).unwrap(), ["copy", "mit"]);
    }
}
