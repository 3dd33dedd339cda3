//! `cargo xtask crates`: each library crate by itself, as another project would take it.

use crate::tools::{self, printed};
use proof::Failure;
use proof::files::root;
use serde_json::Value;
use std::path::Path;
use std::time::Instant;

fn cargo(arguments: &[&str]) -> Result<String, Failure> {
    printed(tools::cargo().args(arguments).current_dir(root()))
}

fn workspace() -> Result<Vec<Value>, Failure> {
    let metadata: Value = serde_json::from_str(&cargo(&["metadata", "--no-deps", "--format-version", "1"])?)?;
    metadata["packages"].as_array().cloned().ok_or_else(|| Failure("cargo metadata names no packages".into()))
}

/// Packages that are published: all but the proof, the chores and what has a home of its own. `publish = false` is an empty list of registries.
fn published(package: &Value) -> bool {
    package["publish"].as_array().is_none_or(|registries| !registries.is_empty())
}

fn has(package: &Value, kind: &str) -> bool {
    package["targets"].as_array().is_some_and(|all| all.iter().any(|target| target["kind"][0] == kind))
}

/// Parts that another project expects in the package at `folder`, and that are missing.
fn missing(package: &Value, folder: &Path) -> Vec<String> {
    let readme = std::fs::read_to_string(folder.join("README.md")).unwrap_or_default();
    let by_path = |d: &&Value| d["path"].is_string() && d["req"] == "*";
    let alone = package["dependencies"].as_array().into_iter().flatten().filter(by_path);
    let path_only = alone.map(|d| format!("{} is taken by its path only, give it a version", d["name"]));
    let wanted = [
        (package["description"].is_string(), "no description in Cargo.toml"),
        (readme.contains("```rust"), "no example in README.md"),
        (readme.contains("Version 0."), "README.md does not say what a version promises"),
    ];
    wanted.into_iter().filter(|(found, _)| !found).map(|(_, missing)| missing.to_owned()).chain(path_only).collect()
}

/// Checks a library with its own features only and with all of them, and runs its tests. What has a program is checked without it as
/// well: other projects take it so.
fn alone(name: &str, package: &Value) -> Result<(), Failure> {
    let run = |words: &[&str]| cargo(&[words, &["--quiet", "--package", name]].concat());
    if has(package, "bin") {
        run(&["check", "--no-default-features", "--lib"])?;
    }
    run(&["check"])?;
    if package["features"].as_object().is_some_and(|features| !features.is_empty()) {
        run(&["check", "--all-features"])?;
    }
    run(&["test"]).map(drop)
}

/// Checks and tests every library by itself, packages all that is published, and builds each package from what was packed; always `true`.
pub(crate) fn run() -> Result<bool, Failure> {
    let start = Instant::now();
    let packages = workspace()?;
    let folder = root().join("crates");
    for package in &packages {
        let (Some(name), Some(manifest)) = (package["name"].as_str(), package["manifest_path"].as_str()) else { continue };
        let Some(here) = Path::new(manifest).parent().filter(|here| has(package, "lib") && here.starts_with(&folder)) else {
            continue;
        };
        let missing = missing(package, here);
        if !missing.is_empty() {
            return Err(Failure(format!("{name}: {}", missing.join("; "))));
        }
        alone(name, package)?;
        println!("[{:4.0} s] {name} stands alone", start.elapsed().as_secs_f64());
    }
    // cargo keeps what it unpacked of a package by the place it was packed at and its version: a place that was never used holds nothing old
    let targets = root().join("target");
    std::fs::create_dir_all(&targets)?;
    let place = tempfile::tempdir_in(targets)?;
    let target = place.path().to_string_lossy();
    let kept = packages.iter().filter(|package| !published(package)).filter_map(|package| package["name"].as_str());
    let excluded = kept.flat_map(|name| ["--exclude", name]);
    let words = ["package", "--workspace", "--allow-dirty", "--target-dir", &*target];
    cargo(&words.into_iter().chain(excluded).collect::<Vec<_>>())?;
    println!("[{:4.0} s] every package is complete", start.elapsed().as_secs_f64());
    Ok(true)
}
