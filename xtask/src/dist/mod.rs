//! `cargo xtask dist`: files that are installed without a compiler, built for this platform and tried as its user would.

mod archive;
mod licences;
mod trial;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use proof::Failure;
use proof::files::{below, failed, names, renew, root, write};
use proof::program::hash_of_file;

use crate::tools::{DATE, cargo, printed, python_with, remapped, run};
use archive::{Entry, packed};

const FOLDER: &str = "target/dist";
const SUMS: &str = "SHA256SUMS";
const PAGE: &str = "docs/install.md";
const MARKS: [&str; 2] = ["<!-- dist: written by `cargo xtask dist` -->", "<!-- dist end -->"];
const PROFILE: [&str; 3] = ["--locked", "--profile", "packed"];
const MATURIN: [&str; 2] = ["maturin", "1.16.0"];
/// Shells, and the names under which they look for the completions of the program.
const SHELLS: [(&str, &str); 5] = [
    ("bash", "fogcoil.bash"),
    ("elvish", "fogcoil.elv"),
    ("fish", "fogcoil.fish"),
    ("powershell", "_fogcoil.ps1"),
    ("zsh", "_fogcoil"),
];

/// Build what is installed without a compiler, for this platform, and try it
///
/// Into target/dist: an archive with the program, its manual pages, completions and licences; the Python wheel; their SHA-256. The archive is unpacked
/// in an empty folder and its program run; the wheel is installed where no compiler is found, and called. Writes the sizes into docs/install.md. Exit
/// status 1 if one of them does not work.
#[derive(Debug, clap::Args)]
pub(crate) struct Dist {
    /// Leave the Python wheel out
    #[arg(long)]
    no_wheel: bool,
}

impl Dist {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let into = root().join(FOLDER);
        if into.exists() {
            fs::remove_dir_all(&into).map_err(failed(&into))?;
        }
        fs::create_dir_all(&into).map_err(failed(&into))?;
        let platform = platform()?;
        let program = program()?;
        let name = format!("fogcoil-{}-{platform}", env!("CARGO_PKG_VERSION"));
        let entries = entries(&program, &platform)?;
        let archive = into.join(format!("{name}.tar.gz"));
        fs::write(&archive, packed(&name, &entries)?).map_err(failed(&archive))?;
        if !self.no_wheel {
            wheel(&into)?;
        }
        let files = names(&into)?;
        let sums: Vec<String> = files
            .iter()
            .map(|file| Ok(format!("{}  {file}\n", hash_of_file(&into.join(file))?)))
            .collect::<Result<_, Failure>>()?;
        write(&into.join(SUMS), &sums.concat())?;
        let mut sizes = String::from("| file | size | unpacked |\n|---|---|---|\n");
        for file in &files {
            let path = into.join(file);
            let (packed, unpacked) = (fs::metadata(&path).map_err(failed(&path))?.len(), trial::tried(&path, &name)?);
            sizes += &format!("| `{file}` | {} | {} |\n", megabytes(packed), megabytes(unpacked));
        }
        print!("{sizes}");
        if !self.no_wheel {
            renew(&root().join(PAGE), MARKS, &format!("\n{sizes}"))?;
        }
        println!("all of them work; they are in {FOLDER}, with {SUMS}");
        Ok(true)
    }
}

fn megabytes(bytes: u64) -> String {
    format!("{:.1} MB", bytes as f64 / 1e6)
}

/// The compiler's name of this platform.
fn platform() -> Result<String, Failure> {
    let said = printed(cargo().arg("-vV"))?;
    let host = said.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| Failure("cargo -vV names no host".into()))
}

/// The program, built without the names of this machine's folders.
fn program() -> Result<PathBuf, Failure> {
    let mut build = cargo();
    build.args(["build", "--quiet", "--package", "fogcoil"]).args(PROFILE).env("CARGO_ENCODED_RUSTFLAGS", remapped(&root()));
    if !run(&mut build)? {
        return Err(Failure("the program does not build".into()));
    }
    let target = std::env::current_exe()?.ancestors().nth(2).map(Path::to_owned).unwrap_or_default();
    Ok(target.join("packed").join(format!("fogcoil{}", std::env::consts::EXE_SUFFIX)))
}

/// The content of the archive.
fn entries(program: &Path, platform: &str) -> Result<Vec<Entry>, Failure> {
    let read = |path: &Path| fs::read(path).map_err(failed(path));
    let name = format!("fogcoil{}", std::env::consts::EXE_SUFFIX);
    let mut entries = vec![Entry::program(name, read(program)?)];
    for file in ["LICENSE-APACHE", "LICENSE-MIT", "README.md"] {
        entries.push(Entry::new(file, read(&root().join(file))?));
    }
    entries.push(Entry::new("LICENSES-THIRD-PARTY.txt", licences::of_packages(platform)?.into_bytes()));
    for (shell, file) in SHELLS {
        entries.push(Entry::new(
            format!("completions/{file}"),
            printed(Command::new(program).args(["completions", shell]))?.into_bytes(),
        ));
    }
    let manual = tempfile::tempdir()?;
    printed(Command::new(program).args(["man", "--quiet", "--dir"]).arg(manual.path()))?;
    for file in below(manual.path())? {
        entries.push(Entry::new(format!("man/man1/{}", file.display()), read(&manual.path().join(&file))?));
    }
    Ok(entries)
}

/// Builds the wheel into a folder.
fn wheel(into: &Path) -> Result<(), Failure> {
    let mut build = Command::new(python_with(MATURIN)?.join("maturin"));
    build.args(["build", "--quiet", "--manifest-path", "python/Cargo.toml", "--out"]).arg(into).args(PROFILE);
    build.env("CARGO_ENCODED_RUSTFLAGS", remapped(&root())).env("SOURCE_DATE_EPOCH", DATE.to_string());
    if run(&mut build)? { Ok(()) } else { Err(Failure("the wheel does not build".into())) }
}
