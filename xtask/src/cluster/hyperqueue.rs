//! A server of HyperQueue and two workers.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use proof::Failure;
use proof::files::{failed, root};

use super::place::{FILES, Place, SHARES, Trial};
use super::processes::{Running, done};

const VERSION: &str = "0.27.0";
const LOOPBACK: &str = include_str!("loopback.py");
const TABLE: &str = "hyperqueue.parquet";

/// Sweeps the plan with one of two workers killed.
pub(super) fn sweep(place: &Place) -> Result<Trial, Failure> {
    let python = python()?;
    let script = place.path("loopback.py");
    fs::write(&script, LOOPBACK).map_err(failed(&script))?;
    // a worker's server, and the server's own folder
    let start = |role: &str, name: &str| {
        Running::ready(place.command(&python).arg(&script).args([role, name, "server"]).stderr(Stdio::null()))
    };
    let _server = start("server", "server")?;
    let (_first, second) = (start("worker", "first")?, start("worker", "second")?);
    let job = Running::start(
        place
            .command(&python)
            .arg(place.script("submit_hq.py"))
            .arg(place.plan())
            .args([TABLE, &SHARES.to_string(), "server"])
            .stdout(Stdio::null())
            .stderr(Stdio::null()),
    )?;
    let there = place.kill_half_way(TABLE, second, Running::below)?;
    if !job.wait()? {
        return Err(Failure("HyperQueue: the job did not end well".into()));
    }
    let course = format!("a worker killed at its task when {there} of {FILES} files of rows were there");
    Ok(Trial { scheduler: format!("HyperQueue {VERSION}"), course, table: TABLE })
}

/// A Python that has HyperQueue.
fn python() -> Result<PathBuf, Failure> {
    let environment = root().join("target/tools").join(format!("hyperqueue-{VERSION}"));
    let python = environment.join("bin/python");
    if !Command::new(&python)
        .args(["-c", "import hyperqueue"])
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success())
    {
        done(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&environment))?;
        let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
        done(Command::new(&python).args(install).arg(format!("hyperqueue=={VERSION}")))?;
    }
    Ok(python)
}
