//! Running a program and reading the line `RESULT {…}` that it prints (benches/peers/README.md).

use super::{Failure, root};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// What a program printed.
#[derive(Debug, Clone, Deserialize)]
pub(crate) struct Printed {
    pub(crate) dof: usize,
    #[serde(default)]
    pub(crate) dof2: usize,
    phases: BTreeMap<String, f64>,
    /// Mean CPU seconds of later calls in the same process.
    #[serde(default)]
    pub(crate) warm: Option<f64>,
    pub(crate) out: BTreeMap<String, f64>,
    #[serde(default)]
    pub(crate) course: Vec<[f64; 5]>,
}

impl Printed {
    /// CPU seconds of all phases but the interpreter's imports.
    pub(crate) fn compute(&self) -> f64 {
        self.phases.iter().filter(|(name, _)| *name != "import").map(|(_, s)| s).sum()
    }
}

/// One run of a program.
#[derive(Debug, Clone)]
pub(crate) struct Run {
    /// Wall time of the process \[s\].
    pub(crate) wall: f64,
    /// CPU time of the process \[s\], if the system tells.
    pub(crate) cpu: Option<f64>,
    pub(crate) printed: Printed,
}

/// CPU time of the children that have ended \[s\]: Linux counts it in hundredths.
pub(crate) fn children() -> Option<f64> {
    counted(16)
}

/// CPU time of this process on all its threads \[s\], in hundredths.
pub(crate) fn own() -> Option<f64> {
    counted(14)
}

/// User and system time, of which `first` is the first field in /proc/self/stat \[s\].
fn counted(first: usize) -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // the name, field 2, is in brackets and may hold spaces
    let fields: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| fields.get(field - 3)?.parse::<f64>().ok();
    Some((ticks(first)? + ticks(first + 1)?) / 100.0)
}

/// Runs `program` on one thread in benches/peers and returns what follows `RESULT ` on each such line that it prints.
///
/// # Errors
/// [`Failure`] if it cannot be started, fails, or prints no result.
pub(crate) fn results(program: &Path, arguments: &[OsString]) -> Result<Vec<String>, Failure> {
    let called = || called(program, arguments);
    let mut command = Command::new(std::path::absolute(program)?);
    command.args(arguments).current_dir(root().join("benches/peers"));
    for threads in ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "RAYON_NUM_THREADS"] {
        command.env(threads, "1");
    }
    let output = command.output().map_err(|e| Failure(format!("{}: {e}", called())))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let lines: Vec<_> = text.lines().filter_map(|line| line.strip_prefix("RESULT ")).map(String::from).collect();
    if lines.is_empty() || !output.status.success() {
        let last = String::from_utf8_lossy(&output.stderr).lines().last().unwrap_or("no result").to_string();
        return Err(Failure(format!("{}: {}: {last}", called(), output.status)));
    }
    Ok(lines)
}

fn called(program: &Path, arguments: &[OsString]) -> String {
    format!("{} {}", program.display(), arguments.join(" ".as_ref()).to_string_lossy())
}

/// Runs `program` as [`results`] does, and measures it.
///
/// # Errors
/// As [`results`], or if the result is not understood.
pub(crate) fn run(program: &Path, arguments: &[OsString]) -> Result<Run, Failure> {
    let (start, before) = (Instant::now(), children());
    let lines = results(program, arguments)?;
    let (wall, cpu) = (start.elapsed().as_secs_f64(), children().zip(before).map(|(after, before)| after - before));
    let printed = serde_json::from_str(&lines[0]).map_err(|e| Failure(format!("{}: {e}", called(program, arguments))))?;
    Ok(Run { wall, cpu, printed })
}

/// Whether `python` has a module.
pub(crate) fn has(python: &Path, module: &str) -> bool {
    Command::new(python).args(["-c", &format!("import {module}")]).output().is_ok_and(|o| o.status.success())
}
