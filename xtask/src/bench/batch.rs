//! `cargo xtask bench batch`: thirty records of a production by `fogcoil batch`.

use super::publish::{Progress, publish, reference_coil};
use proof::Failure;
use proof::files::{read, root, write_all};
use proof::generator::{Produced, production};
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

const SEED: u64 = 1;
const DRAWING: &str = "fixtures/coil-reference.ron";

pub(crate) fn run() -> Result<(), Failure> {
    let progress = Progress::new();
    let program = crate::tools::program()?;
    let folder = root().join("target/bench/batch");
    let (records, out) = (folder.join("records"), folder.join("out"));
    if folder.exists() {
        std::fs::remove_dir_all(&folder)?;
    }
    progress.say("making the units");
    let units = production(&reference_coil()?, SEED)?;
    for Produced { name, record, meta, .. } in &units {
        let at = records.join(name);
        write_all(&[(at.join("run.csv"), record.clone()), (at.join("meta.ron"), meta.clone())])?;
    }
    // the first unit alone, for the model to be in the cache
    batch(&program, &records.join(&units[0].name), &folder.join("first"))?;
    progress.say("the batch");
    let before = proof::peers::children();
    let clock = Instant::now();
    batch(&program, &records, &out)?;
    let wall = clock.elapsed().as_secs_f64();
    let cpu = proof::peers::children().zip(before).map(|(after, before)| after - before);
    let mut table = String::from("| unit | concealed | verdict | set | right |\n|---|---|---|---|---|\n");
    let (mut good, mut found, mut good_right) = (0, 0, 0);
    for unit in &units {
        let said: Value = serde_json::from_str(&read(&out.join("units").join(format!("{}.json", unit.name)))?)?;
        let verdict = said["diagnosis"]["verdict"].as_str().unwrap_or_default().to_owned();
        let set: Vec<&str> = said["diagnosis"]["set"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        let right = match &unit.fault {
            None => ["none", "recalibrate"].contains(&verdict.as_str()),
            Some(fault) => set.contains(&fault.as_str()),
        };
        match &unit.fault {
            None => (good, good_right) = (good + 1, good_right + usize::from(right)),
            Some(_) => found += usize::from(right),
        }
        if unit.fault.is_some() || !right {
            let (fault, right) = (unit.fault.as_deref().unwrap_or("nothing"), if right { "yes" } else { "no" });
            let _ = writeln!(table, "| {} | {fault} | {verdict} | {} | {right} |", unit.name, set.join(", "));
        }
    }
    let cpu = cpu.map_or(String::new(), |cpu| format!(", {cpu:.0} CPU s"));
    let cores = std::thread::available_parallelism()?;
    let faulty = units.len() - good;
    publish(
        "batch",
        &format!(
            "{} units in {wall:.0} s on {cores} cores{cpu}: {good_right} of {good} good ones left alone, {found} of {faulty} faults named. Those that \
             are faulty, and those that were answered wrongly:\n\n{table}",
            units.len()
        ),
    )
}

/// Runs the program on recordings; that a limit or a verdict fails is no failure here.
fn batch(program: &Path, records: &Path, out: &Path) -> Result<(), Failure> {
    let mut command = Command::new(program);
    command.arg("batch").arg(root().join(DRAWING)).arg(records).arg("--out").arg(out).stdout(Stdio::null());
    match command.status()?.code() {
        Some(0 | 1) => Ok(()),
        other => Err(Failure(format!("fogcoil batch ended with {other:?}"))),
    }
}
