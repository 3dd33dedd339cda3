//! A compiler that has a standard library for WebAssembly.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use proof::Failure;
use proof::files::{below, failed, names, root};

use crate::tools::printed;

/// Of the page.
pub(super) const TARGET: &str = "wasm32-unknown-unknown";

/// Suite of Debian whose compiler is taken: that of the stable one is too old.
const SUITE: &str = "testing";
/// Packages that are fetched with all that they need; the compiler itself would bring one for C along.
const NEEDED: [&str; 2] = ["libstd-rust-dev", "libstd-rust-dev-wasm32"];
const COMPILER: &str = "rustc";
/// Parts of the packages that nothing here needs.
const UNNEEDED: [&str; 3] = ["usr/share", "usr/lib/rustlib/wasm32-wasip1", "usr/lib/rustlib/wasm32-wasip2"];
const REMEDY: &str = "`rustup target add wasm32-unknown-unknown` adds the standard library for wasm32 to the compiler, where rustup reaches its server; \
                      or run this where apt-get and dpkg reach Debian's packages";

/// A compiler.
pub(super) struct Compiler {
    /// The script that starts it; `None`: cargo's own.
    program: Option<PathBuf>,
    /// Linker for WebAssembly; `None`: the compiler's own.
    linker: Option<PathBuf>,
}

impl Compiler {
    /// Has cargo build with it.
    pub(super) fn used_by(&self, build: &mut Command) {
        if let Some(program) = &self.program {
            build.env("RUSTC", program);
        }
        if let Some(linker) = &self.linker {
            build.env("CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_LINKER", linker);
        }
    }
}

/// Cargo's own compiler if it has the library, else the one in target/tools, which is fetched if it is not there.
pub(super) fn compiler() -> Result<Compiler, Failure> {
    if printed(Command::new(COMPILER).args(["--print", "target-libdir", "--target", TARGET]))
        .is_ok_and(|place| Path::new(place.trim()).is_dir())
    {
        return Ok(Compiler { program: None, linker: None });
    }
    let folder = root().join("target/tools/wasm");
    let program = folder.join("bin").join(COMPILER);
    if !program.exists() {
        fetch(&folder).map_err(|error| Failure(format!("no compiler for WebAssembly: {error}; {REMEDY}")))?;
    }
    Ok(Compiler { program: Some(program), linker: Some(linker()?) })
}

/// The linker that comes with cargo's own compiler.
fn linker() -> Result<PathBuf, Failure> {
    let about = printed(Command::new(COMPILER).arg("-vV"))?;
    let host = about.lines().find_map(|line| line.strip_prefix("host: ")).unwrap_or_default();
    let sysroot = printed(Command::new(COMPILER).args(["--print", "sysroot"]))?;
    let linker = Path::new(sysroot.trim()).join("lib/rustlib").join(host).join("bin/rust-lld");
    if linker.is_file() { Ok(linker) } else { Err(Failure(format!("{} is not there; {REMEDY}", linker.display()))) }
}

/// Fetches Debian's compiler, its libraries and those that these need, down to the C library, and unpacks them into a folder; nothing is installed.
fn fetch(folder: &Path) -> Result<(), Failure> {
    let work = folder.with_extension("part");
    if work.exists() {
        fs::remove_dir_all(&work).map_err(failed(&work))?;
    }
    for inner in ["state/lists/partial", "cache/archives/partial", "bin"] {
        fs::create_dir_all(work.join(inner)).map_err(failed(&work))?;
    }
    let write = |name: &str, text: &str| fs::write(work.join(name), text).map_err(failed(&work));
    write("sources.list", &format!("deb {} {SUITE} main\n", mirror()?))?;
    write("status", "")?;
    let place = work.display();
    write(
        "apt.conf",
        &format!(
            "Dir::State \"{place}/state\";\nDir::State::status \"{place}/status\";\nDir::Cache \"{place}/cache\";\n\
             Dir::Etc::sourcelist \"{place}/sources.list\";\nDir::Etc::sourceparts \"/dev/null\";\n\
             APT::Install-Recommends \"false\";\nAPT::Sandbox::User \"\";\nAcquire::Languages \"none\";\n"
        ),
    )?;
    eprintln!("fetching a compiler for WebAssembly (200 MB)");
    let archives = work.join("cache/archives");
    let apt = |words: &[&str]| {
        let mut apt = Command::new("apt-get");
        printed(apt.args(["--quiet", "--yes"]).args(words).current_dir(&archives).env("APT_CONFIG", work.join("apt.conf")))
    };
    apt(&["update"])?;
    apt(&[&["install", "--download-only"][..], &NEEDED].concat())?;
    apt(&["download", COMPILER])?;
    for package in names(&archives)?.iter().filter(|name| name.ends_with(".deb")) {
        printed(Command::new("dpkg").arg("--extract").arg(archives.join(package)).arg(work.join("root")))?;
    }
    for unneeded in
        UNNEEDED.map(|inner| work.join("root").join(inner)).into_iter().chain([work.join("cache"), work.join("state")])
    {
        if unneeded.exists() {
            fs::remove_dir_all(&unneeded).map_err(failed(&unneeded))?;
        }
    }
    // the program is run by the C library that came with it: this system's may be older
    let libraries = below(&work.join("root/usr/lib"))?;
    let loader =
        libraries.iter().find(|file| file.file_name().is_some_and(|name| name.to_string_lossy().starts_with("ld-linux")));
    let loader = loader.ok_or_else(|| Failure("the packages hold no loader of programs".into()))?;
    let parent = loader.parent().unwrap_or(Path::new(""));
    let script = format!(
        "#!/bin/sh\nroot={}\nexec \"$root/usr/lib/{}\" --library-path \"$root/usr/lib/{}\" \"$root/usr/bin/{COMPILER}\" --sysroot \"$root/usr\" \"$@\"\n",
        folder.join("root").display(),
        loader.display(),
        parent.display()
    );
    write("bin/rustc", &script)?;
    printed(Command::new("chmod").arg("+x").arg(work.join("bin").join(COMPILER)))?;
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(failed(folder))?;
    }
    fs::rename(&work, folder).map_err(failed(folder))?;
    printed(Command::new(folder.join("bin").join(COMPILER)).arg("--version")).map(drop)
}

/// Where this system takes Debian's packages from.
fn mirror() -> Result<String, Failure> {
    let listed =
        printed(Command::new("apt-get").args(["indextargets", "--format", "$(ORIGIN) $(REPO_URI)", "Created-By: Packages"]))?;
    let found = listed.lines().find_map(|line| line.strip_prefix("Debian "));
    found.map(str::to_owned).ok_or_else(|| Failure("this system takes no packages from Debian".into()))
}
