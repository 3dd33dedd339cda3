//! Other programs that chores run: the build tool, tools from the registry, our own program.

use std::path::PathBuf;
use std::process::Command;

use proof::Failure;
use proof::files::root;

/// Runs a command where the workspace is; whether it went well.
pub(crate) fn run(command: &mut Command) -> Result<bool, Failure> {
    Ok(command.current_dir(root()).status()?.success())
}

/// The build tool that runs this.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// A tool of this version, which is installed if it is not there yet.
pub(crate) fn tool([name, version]: [&str; 2]) -> Result<Command, Failure> {
    let tools = root().join("target/tools").join(version);
    let program = tools.join("bin").join(name);
    if !program.exists() {
        eprintln!("installing {name} {version}");
        let install = ["install", "--quiet", "--locked", "--version", version, "--root"];
        if !run(cargo().args(install).arg(&tools).arg(name))? {
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
