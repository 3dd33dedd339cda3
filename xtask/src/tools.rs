//! Other programs that chores run: the build tool, tools from the registry, our own program.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use proof::Failure;
use proof::files::root;

/// Second of the clock that files are dated with, so that they do not change from day to day: 1 January 2026.
pub(crate) const DATE: u64 = 1_767_225_600;

/// Runs a command where the workspace is; whether it went well.
pub(crate) fn run(command: &mut Command) -> Result<bool, Failure> {
    Ok(command.current_dir(root()).status()?.success())
}

/// Output of a command that has to succeed. [`Failure`] names the command and ends with its complaint.
pub(crate) fn printed(command: &mut Command) -> Result<String, Failure> {
    /// Most lines of a complaint: the last ones.
    const LINES: usize = 40;
    let words = [command.get_program()].into_iter().chain(command.get_args()).map(|word| word.to_string_lossy().into_owned());
    let name = words.collect::<Vec<_>>().join(" ");
    let output = command.stdin(Stdio::null()).output().map_err(|error| Failure(format!("{name} does not start ({error})")))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    let lines: Vec<&str> = complaint.trim().lines().collect();
    Err(Failure(format!("{name}: {}", lines[lines.len().saturating_sub(LINES)..].join("\n"))))
}

/// The build tool that runs this.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A tool of this version, which is installed if it is not there yet.
pub(crate) fn tool(of: [&str; 2]) -> Result<Command, Failure> {
    tool_with(of, &[])
}

/// A tool of this version, built with these flags if it is not there yet.
pub(crate) fn tool_with([name, version]: [&str; 2], flags: &[&str]) -> Result<Command, Failure> {
    let tools = root().join("target/tools").join(version);
    let program = tools.join("bin").join(name);
    if !program.exists() {
        eprintln!("installing {name} {version}");
        let install = ["install", "--quiet", "--locked", "--version", version, "--root"];
        if !run(cargo().args(install).arg(&tools).args(flags).arg(name))? {
            return Err(Failure(format!("{name} {version} cannot be installed")));
        }
    }
    Ok(Command::new(program))
}

/// Our program, built beside this one in its profile.
pub(crate) fn program() -> Result<PathBuf, Failure> {
    let this = std::env::current_exe()?;
    let folder = this.parent().ok_or_else(|| Failure("this program has no folder".into()))?;
    let mut build = cargo();
    build.args(["build", "--quiet"]);
    if folder.ends_with("release") {
        build.args(["--release", "--package", "fogcoil"]);
    } else {
        // so cargo takes what `cargo test --workspace` has built: for one package it would resolve the features anew
        build.args(["--workspace", "--bins", "--tests"]);
    }
    if !run(build.env("CARGO_TARGET_DIR", folder.parent().unwrap_or(folder)))? {
        return Err(Failure("fogcoil cannot be built".into()));
    }
    Ok(folder.join(format!("fogcoil{}", std::env::consts::EXE_SUFFIX)))
}

/// Flags of the compiler, as CARGO_ENCODED_RUSTFLAGS, by which no name of a folder gets into what it makes of `sources`.
pub(crate) fn remapped(sources: &Path) -> String {
    let home = std::env::var_os("CARGO_HOME").map(PathBuf::from);
    let home = home.or_else(|| Some(std::env::home_dir()?.join(".cargo"))).unwrap_or_default();
    let folders = [(sources, "fogcoil"), (&home, "cargo")];
    folders.map(|(from, to)| format!("--remap-path-prefix={}=/{to}", from.display())).join("\u{1f}")
}

/// The folder of the programs of an environment for Python that has a package of this version, which is installed if it is not there yet.
pub(crate) fn python_with([package, version]: [&str; 2]) -> Result<PathBuf, Failure> {
    let folder = root().join("target/tools").join(format!("{package}-{version}"));
    let (programs, finished) = (programs(&folder), folder.join("installed"));
    if !finished.exists() {
        eprintln!("installing {package} {version}");
        environment(&folder)?;
        let wanted = format!("{package}=={version}");
        let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", &wanted];
        printed(Command::new(programs.join("python")).args(install))?;
        proof::files::write(&finished, "")?;
    }
    Ok(programs)
}

fn programs(environment: &Path) -> PathBuf {
    environment.join(if cfg!(windows) { "Scripts" } else { "bin" })
}

/// A new environment for Python in `folder`; its programs' folder.
pub(crate) fn environment(folder: &Path) -> Result<PathBuf, Failure> {
    let made = Command::new("python3").args(["-m", "venv", "--clear"]).arg(folder).output();
    let remedy = "install Python 3.9 or later with its module venv";
    match made {
        Ok(done) if done.status.success() => Ok(programs(folder)),
        Ok(done) => {
            let said = String::from_utf8_lossy(&done.stderr);
            Err(Failure(format!("python3 makes no environment: {}; {remedy}", said.trim())))
        }
        Err(error) => Err(Failure(format!("python3 does not start ({error}); {remedy}"))),
    }
}
