//! `cargo xtask supply`: what the program is made of, and whether a second build of it is the same.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::tools::{DATE, cargo, remapped, run, tool};
use proof::Failure;
use proof::files::{below, failed, read, renew, root};
use proof::program::{hash, hash_of_file};
use serde_json::Value;

const PAGE: &str = "docs/trust.md";
const MARKS: [&str; 2] = ["<!-- supply: written by `cargo xtask supply` -->", "<!-- supply end -->"];
/// Begins the row of the builds, which stands until two builds are compared again.
const BUILDS: &str = "| the program, built twice in two folders |";

/// Tools from the registry, each with its version: an answer must not change because a tool did.
const DENY: [&str; 2] = ["cargo-deny", "0.20.2"];
const BILL: [&str; 2] = ["cargo-cyclonedx", "0.5.9"];
/// Parts of the repository that a build of the program needs.
const SOURCES: [&str; 5] = ["crates", "xtask", "tests", "python", "fuzz"];
const FILES: [&str; 2] = ["Cargo.toml", "Cargo.lock"];

/// Check what the program is made of, and whether a second build of it is the same
///
/// Licences, duplicates and sources of all packages by cargo-deny and deny.toml; a software bill of materials (CycloneDX) in target/supply. Writes
/// docs/trust.md. Exit status 1 if something is not allowed, or the builds differ. The tools are installed into target/tools.
#[derive(Debug, clap::Args)]
pub(crate) struct Supply {
    /// Build the program twice, in two folders, and compare the bytes (minutes)
    #[arg(long)]
    twice: bool,
}

impl Supply {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let into = root().join("target/supply");
        fs::create_dir_all(&into).map_err(failed(&into))?;
        let allowed = run(tool(DENY)?.args(["--all-features", "--locked", "check", "bans", "licenses", "sources"]))?;
        let bill = bill(&into)?;
        let alike = if self.twice { Some(built_alike(&into)?) } else { None };
        let page = root().join(PAGE);
        let builds = match &alike {
            Some((_, row)) => Some(row.clone()),
            None => read(&page)?.lines().find(|line| line.starts_with(BUILDS)).map(str::to_owned),
        };
        let text = table(&serde_json::from_str(&read(&bill)?)?, allowed, builds.as_deref());
        print!("{text}");
        println!("the bill of materials is {}", bill.display());
        renew(&page, MARKS, &text)?;
        Ok(allowed && alike.is_none_or(|(alike, _)| alike))
    }
}

/// The program's packages by licence, whether they are allowed, and the row of the builds.
fn table(bill: &Value, allowed: bool, builds: Option<&str>) -> String {
    let packages: Vec<&Value> = bill["components"].as_array().into_iter().flatten().collect();
    let mut licences: BTreeMap<String, usize> = BTreeMap::new();
    for package in &packages {
        let licence = package["licenses"].as_array().into_iter().flatten();
        let of = |l: &Value| l["expression"].as_str().or(l["license"]["id"].as_str()).unwrap_or("another").replace('/', " OR ");
        let licence = licence.map(of).collect::<Vec<_>>().join(", ");
        *licences.entry(if licence.is_empty() { "of no licence".into() } else { licence }).or_default() += 1;
    }
    let mut licences: Vec<(String, usize)> = licences.into_iter().collect();
    licences.sort_by_key(|(name, count)| (std::cmp::Reverse(*count), name.clone()));
    let mut text = String::from("\n| | |\n|---|---|\n");
    let _ = writeln!(text, "| packages in the program | {} |", packages.len());
    let said = if allowed { "as deny.toml allows" } else { "FAILS" };
    let _ = writeln!(text, "| licences, duplicates and sources, of its tests' packages, too | {said} |");
    let listed: Vec<String> = licences.iter().map(|(name, count)| format!("{count} {name}")).collect();
    let _ = writeln!(text, "| its packages by licence | {} |", listed.join("; "));
    builds.iter().for_each(|row| text += &format!("{row}\n"));
    text
}

/// Writes the program's bill of materials.
fn bill(into: &Path) -> Result<PathBuf, Failure> {
    let mut tool = tool(BILL)?;
    let arguments = ["cyclonedx", "--quiet", "--format", "json", "--override-filename", "bill", "--manifest-path"];
    if !run(tool.env("SOURCE_DATE_EPOCH", DATE.to_string()).args(arguments).arg("crates/fogcoil/Cargo.toml"))? {
        return Err(Failure("the bill of materials cannot be written".into()));
    }
    // the tool writes one beside the manifest of every crate of the workspace
    let bill = into.join("fogcoil.cdx.json");
    for folder in SOURCES {
        for file in below(&root().join(folder))?.iter().filter(|file| file.ends_with("bill.json")) {
            let written = root().join(folder).join(file);
            if file.starts_with("fogcoil") {
                fs::copy(&written, &bill).map_err(failed(&bill))?;
            }
            fs::remove_file(&written).map_err(failed(&written))?;
        }
    }
    Ok(bill)
}

/// Whether two builds of copies of the sources, in folders with other names, give the same bytes; and the row that says so.
fn built_alike(into: &Path) -> Result<(bool, String), Failure> {
    let folders = ["first", "second-and-elsewhere"].map(|name| into.join(name));
    // both before a build, in whose minutes somebody may edit
    let sources = hash(&root())?;
    folders.iter().try_for_each(|folder| copied(folder))?;
    let [first, second] = folders.map(|folder| built(&folder));
    let (first, second) = (first?, second?);
    let said = if first == second { format!("the same bytes, {first}") } else { format!("they DIFFER, {first} and {second}") };
    Ok((first == second, format!("{BUILDS} {said} (SHA-256); crates' sources {} |", sources.get(..16).unwrap_or(&sources))))
}

/// Puts a copy of the sources into `folder`, and nothing else.
fn copied(folder: &Path) -> Result<(), Failure> {
    let sources = folder.join("sources");
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed(folder))?;
    }
    let within = |name: &&str| -> Result<Vec<PathBuf>, Failure> {
        Ok(below(&root().join(name))?.into_iter().map(|file| Path::new(name).join(file)).collect())
    };
    let all = SOURCES.iter().map(within).collect::<Result<Vec<_>, _>>()?;
    for file in all.into_iter().flatten().chain(FILES.map(PathBuf::from)) {
        let copy = sources.join(&file);
        let parent = copy.parent().unwrap_or(&sources);
        fs::create_dir_all(parent).map_err(failed(parent))?;
        fs::copy(root().join(&file), &copy).map_err(failed(&copy))?;
    }
    Ok(())
}

/// SHA-256 of the program, built from the copy of the sources in `folder`.
fn built(folder: &Path) -> Result<String, Failure> {
    eprintln!("building in {}", folder.display());
    let (sources, target) = (folder.join("sources"), folder.join("target"));
    // the whole folder is called alike: what build scripts write, and name, lies beside the sources
    let mut build = cargo();
    build.args(["build", "--quiet", "--release", "--locked", "--package", "fogcoil", "--bin", "fogcoil"]);
    build.env("CARGO_TARGET_DIR", &target).env("CARGO_ENCODED_RUSTFLAGS", remapped(folder)).current_dir(&sources);
    if !build.status()?.success() {
        return Err(Failure(format!("the program cannot be built in {}", sources.display())));
    }
    let program = target.join("release").join(format!("fogcoil{}", std::env::consts::EXE_SUFFIX));
    hash_of_file(&program)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_are_counted_by_licence() {
        let bill = r#"{"components": [
            {"licenses": [{"expression": "MIT OR Apache-2.0"}]}, {"licenses": [{"license": {"id": "Zlib"}}]},
            {"licenses": [{"expression": "MIT/Apache-2.0"}]}, {}
        ]}"#;
        let text = table(&serde_json::from_str(bill).unwrap(), false, Some("| builds |"));
        assert!(text.contains("| packages in the program | 4 |") && text.contains("| FAILS |"), "{text}");
        assert!(text.contains("| 2 MIT OR Apache-2.0; 1 Zlib; 1 of no licence |") && text.ends_with("| builds |\n"), "{text}");
    }
}
