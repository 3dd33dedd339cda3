//! `cargo xtask supply`: what the program is made of, and whether a second build of it is the same.

use std::fs;
use std::path::{Path, PathBuf};

use crate::tools::{DATE, cargo, remapped, run, tool};
use proof::Failure;
use proof::files::{below, failed, root};
use proof::program::hash_of_file;

/// Tools from the registry, each with its version: an answer must not change because a tool did.
const DENY: [&str; 2] = ["cargo-deny", "0.20.2"];
const BILL: [&str; 2] = ["cargo-cyclonedx", "0.5.9"];
/// Parts of the repository that a build of the program needs.
const SOURCES: [&str; 5] = ["crates", "xtask", "tests", "python", "fuzz"];
const FILES: [&str; 2] = ["Cargo.toml", "Cargo.lock"];

/// Check what the program is made of, and whether a second build of it is the same
///
/// Licences, duplicates and sources of all packages by cargo-deny and deny.toml; a software bill of materials (CycloneDX) in target/supply. Exit status 1
/// if something is not allowed, or the builds differ. The tools are installed into target/tools.
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
        println!("licences, duplicates and sources: {}", if allowed { "as deny.toml allows" } else { "FAILS" });
        println!("the bill of materials is {}", bill(&into)?.display());
        Ok(allowed && (!self.twice || built_alike(&into)?))
    }
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

/// Whether two builds of copies of the sources, in folders with other names, give the same bytes.
fn built_alike(into: &Path) -> Result<bool, Failure> {
    let folders = ["first", "second-and-elsewhere"].map(|name| into.join(name));
    // both before a build, in whose minutes somebody may edit
    folders.iter().try_for_each(|folder| copied(folder))?;
    let [first, second] = folders.map(|folder| built(&folder));
    let (first, second) = (first?, second?);
    println!(
        "the program, built twice in two folders: {first} and {second}{}",
        if first == second { "" } else { ": they DIFFER" }
    );
    Ok(first == second)
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
