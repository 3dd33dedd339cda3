//! A server of HyperQueue and two workers.

use std::fs;
use std::process::Stdio;

use proof::Failure;
use proof::files::failed;

use super::place::{FILES, Place, SHARES, Trial};
use super::processes::Running;
use crate::tools::python_with;

const VERSION: &str = "0.27.0";
const LOOPBACK: &str = include_str!("loopback.py");
const TABLE: &str = "hyperqueue.parquet";

/// Sweeps the plan with one of two workers killed.
pub(super) fn sweep(place: &Place) -> Result<Trial, Failure> {
    let python = python_with(["hyperqueue", VERSION])?.join("python");
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
