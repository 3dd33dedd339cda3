//! Running a program and reading the line `RESULT {…}` that it prints (benches/peers/README.md).

use crate::Failure;
use crate::files::root;
use crate::statistics::middle;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// Output of a program.
#[derive(Debug, Clone, Deserialize)]
pub struct Printed {
    /// Unknowns.
    pub dof: usize,
    /// Unknowns of a second system, 0 where there is none.
    #[serde(default)]
    pub dof2: usize,
    phases: BTreeMap<String, f64>,
    /// Mean CPU seconds of later calls in the same process.
    #[serde(default)]
    pub warm: Option<f64>,
    /// Results by name.
    pub out: BTreeMap<String, f64>,
    /// The coil job's results at every stored instant.
    #[serde(default)]
    pub course: Vec<[f64; 5]>,
}

impl Printed {
    /// CPU seconds of all phases but the interpreter's imports.
    pub fn compute(&self) -> f64 {
        self.phases.iter().filter(|(name, _)| *name != "import").map(|(_, s)| s).sum()
    }
}

/// One run of a program.
#[derive(Debug, Clone)]
pub struct Run {
    /// Wall time of the process \[s\].
    pub wall: f64,
    /// CPU time of the process \[s\], if the system tells.
    pub cpu: Option<f64>,
    /// Its output.
    pub printed: Printed,
}

/// A program with its runs.
#[derive(Debug)]
pub struct Program {
    /// Its name in the tables.
    pub name: String,
    /// The executable.
    pub path: PathBuf,
    /// Its arguments.
    pub arguments: Vec<OsString>,
    /// Its runs so far.
    pub runs: Vec<Run>,
}

impl Program {
    /// One that has not run yet.
    pub fn new(name: impl Into<String>, path: impl Into<PathBuf>, arguments: impl IntoIterator<Item: Into<OsString>>) -> Self {
        let arguments = arguments.into_iter().map(Into::into).collect();
        Self { name: name.into(), path: path.into(), arguments, runs: Vec::new() }
    }

    /// Median over the runs; NaN if there is none.
    pub fn median(&self, of: impl Fn(&Run) -> f64) -> f64 {
        middle(self.runs.iter().map(of).collect())
    }

    /// Median seconds of computing, without imports.
    pub fn compute(&self) -> f64 {
        self.median(|r| r.printed.compute())
    }

    /// Median CPU time of the process, or wall time where the system does not tell \[s\].
    pub fn process(&self) -> f64 {
        self.median(|r| r.cpu.unwrap_or(r.wall))
    }

    /// Output of its first run.
    pub fn printed(&self) -> &Printed {
        &self.runs[0].printed
    }
}

/// Runs each program once more. One that fails is left out, and `say` told so, if it is not of the first `ours`.
/// [`Failure`] if one of ours fails.
pub fn run_each(programs: &mut Vec<Program>, ours: usize, say: impl Fn(&str)) -> Result<(), Failure> {
    let mut kept = Vec::new();
    for mut program in std::mem::take(programs) {
        match run(&program.path, &program.arguments) {
            Ok(run) => {
                program.runs.push(run);
                kept.push(program);
            }
            Err(error) if kept.len() < ours => return Err(error),
            Err(error) => say(&format!("{} is left out: {error}", program.name)),
        }
    }
    *programs = kept;
    Ok(())
}

/// CPU time of this thread, which does all the work, in laps \[s\]; wall time where the system does not tell.
pub struct Stopwatch {
    start: Instant,
    last: f64,
}

impl Stopwatch {
    /// Starts.
    pub fn start() -> Self {
        let mut watch = Self { start: Instant::now(), last: 0.0 };
        watch.lap();
        watch
    }

    /// Seconds since the start or the last lap.
    pub fn lap(&mut self) -> f64 {
        let nanoseconds =
            std::fs::read_to_string("/proc/thread-self/schedstat").ok().and_then(|s| s.split(' ').next()?.parse::<f64>().ok());
        let now = nanoseconds.map_or(self.start.elapsed().as_secs_f64(), |n| n * 1e-9);
        now - std::mem::replace(&mut self.last, now)
    }
}

/// CPU time of the children that have ended \[s\]: Linux counts it in hundredths.
pub fn children() -> Option<f64> {
    counted(16)
}

/// CPU time of this process on all its threads \[s\], in hundredths.
pub fn own() -> Option<f64> {
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
/// [`Failure`] if it cannot be started, fails, or prints no result.
pub fn results(program: &Path, arguments: &[OsString]) -> Result<Vec<String>, Failure> {
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

/// Runs `program` as [`results`] does, and measures it. As [`results`], or if the result is not understood.
pub fn run(program: &Path, arguments: &[OsString]) -> Result<Run, Failure> {
    let (start, before) = (Instant::now(), children());
    let lines = results(program, arguments)?;
    let (wall, cpu) = (start.elapsed().as_secs_f64(), children().zip(before).map(|(after, before)| after - before));
    let printed = serde_json::from_str(&lines[0]).map_err(|e| Failure(format!("{}: {e}", called(program, arguments))))?;
    Ok(Run { wall, cpu, printed })
}

/// Whether `python` has a module.
pub fn has(python: &Path, module: &str) -> bool {
    Command::new(python).args(["-c", &format!("import {module}")]).output().is_ok_and(|o| o.status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn program(word: &str) -> Program {
        Program::new(word, "/bin/echo", ["RESULT", word])
    }

    #[test]
    fn a_peer_that_fails_is_left_out_and_one_of_ours_is_not() {
        let good = r#"{"dof": 3, "phases": {"import": 9.0, "solve": 0.5}, "out": {"x": 1.0}}"#;
        let mut programs = vec![program(good), program("no JSON"), program(good)];
        run_each(&mut programs, 1, |said| assert!(said.starts_with("no JSON is left out: /bin/echo"), "{said}")).unwrap();
        assert_eq!(programs.iter().map(|p| (p.printed().dof, p.compute())).collect::<Vec<_>>(), [(3, 0.5); 2]);
        assert!(run_each(&mut vec![program(good), program("no JSON")], 2, |_| ()).is_err());
    }
}
