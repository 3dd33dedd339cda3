//! The folder of a trial: the plan's runs, their rows as they come, processes that end with the trial.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use proof::Failure;
use proof::files::{failed, root, write};
use proof::program::hex;
use sha2::{Digest, Sha256};
use tempfile::TempDir;

use crate::tools::program;

/// 512 designs in 16 files of rows.
const DESIGNS: usize = 512;
/// Files of rows that a whole plan has.
pub(super) const FILES: usize = 16;
/// Tasks of an array.
pub(super) const SHARES: usize = 16;
/// Files of rows after which a worker is killed.
const HALF: usize = 6;
/// Longest that anything is waited for.
const PATIENCE: Duration = Duration::from_secs(600);

pub(super) struct Place {
    folder: TempDir,
    program: PathBuf,
}

impl Place {
    pub(super) fn new() -> Result<Self, Failure> {
        let place = Self { program: program()?, folder: tempfile::tempdir()? };
        let drawing = root().join("fixtures/coil-reference.ron");
        let plan = format!("(design: {drawing:?}, sampling: MonteCarlo({DESIGNS}), others: WithinTolerances)\n");
        write(&place.plan(), &plan)?;
        Ok(place)
    }

    /// A file in the folder.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The script of an array's task.
    pub(super) fn script(&self, name: &str) -> PathBuf {
        root().join("fixtures/cluster").join(name)
    }

    pub(super) fn plan(&self) -> PathBuf {
        self.path("plan.ron")
    }

    /// A command in the folder that finds the program.
    pub(super) fn command(&self, name: impl AsRef<std::ffi::OsStr>) -> Command {
        let mut command = Command::new(name);
        let path = std::env::var("PATH").unwrap_or_default();
        let own = self.program.parent().unwrap_or(Path::new("")).display();
        command.env("PATH", format!("{own}:{path}")).current_dir(self.folder.path());
        command
    }

    /// Computes the plan in one run.
    pub(super) fn alone(&self) -> Result<(), Failure> {
        done(self.sweep("one.parquet").arg("--quiet").stdout(Stdio::null()))
    }

    /// Makes the table of the shares.
    pub(super) fn merge(&self, table: &str) -> Result<(), Failure> {
        done(self.sweep(table).args(["--merge", "--quiet"]).stdout(Stdio::null()))
    }

    fn sweep(&self, table: &str) -> Command {
        let mut command = self.command(&self.program);
        command.arg("sweep").arg(self.plan()).args(["--out", table]);
        command
    }

    /// SHA-256 of a table, which is told.
    pub(super) fn told(&self, how: &str, table: &str) -> Result<String, Failure> {
        let path = self.path(table);
        let mut hash = Sha256::new();
        hash.update(fs::read(&path).map_err(failed(&path))?);
        let hash = hex(hash);
        println!("{hash}  {how}");
        Ok(hash)
    }

    /// Waits until a part of a table's rows is kept, kills the worker with `kill`, and says how many files of rows there were.
    pub(super) fn kill_half_way(&self, table: &str, kill: impl FnOnce() -> Result<(), Failure>) -> Result<usize, Failure> {
        let kept = || self.kept(table);
        until("the first rows", || Ok(kept() >= HALF))?;
        kill()?;
        let there = kept();
        if there >= FILES { Err(Failure("all was computed before the worker was killed".into())) } else { Ok(there) }
    }

    fn kept(&self, table: &str) -> usize {
        let files = fs::read_dir(self.path(&format!("{table}.parts")));
        files.map_or(0, |files| files.flatten().filter(|file| file.path().extension().is_some_and(|end| end == "part")).count())
    }
}

/// Runs a command that has to succeed.
pub(super) fn done(command: &mut Command) -> Result<(), Failure> {
    let status = command.status().map_err(|error| Failure(format!("{}: {error}", command.get_program().display())))?;
    if status.success() { Ok(()) } else { Err(Failure(format!("{}: {status}", command.get_program().display()))) }
}

/// Waits until something is so.
pub(super) fn until(what: &str, mut is_so: impl FnMut() -> Result<bool, Failure>) -> Result<(), Failure> {
    let begun = Instant::now();
    while !is_so()? {
        if begun.elapsed() > PATIENCE {
            return Err(Failure(format!("{what}: waited for in vain")));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    Ok(())
}

/// A process that ends with the trial.
pub(super) struct Running(Child);

impl Running {
    pub(super) fn start(command: &mut Command) -> Result<Self, Failure> {
        let child = command.stdin(Stdio::piped()).spawn();
        child.map(Self).map_err(|error| Failure(format!("{}: {error}", command.get_program().display())))
    }

    /// Starts it, and waits until it says that it is ready.
    pub(super) fn ready(command: &mut Command) -> Result<Self, Failure> {
        let mut running = Self::start(command.stdout(Stdio::piped()))?;
        let said = running.0.stdout.take().map(BufReader::new);
        let is_ready = said.is_some_and(|said| said.lines().map_while(Result::ok).any(|line| line == "ready"));
        if is_ready { Ok(running) } else { Err(Failure(format!("{}: does not start", command.get_program().display()))) }
    }

    /// Whether it ended well, once it has ended.
    pub(super) fn wait(mut self) -> Result<bool, Failure> {
        Ok(self.0.wait()?.success())
    }

    /// Ends it at once, with all processes that it started; how many those were.
    pub(super) fn kill(self) -> Result<usize, Failure> {
        let below = descendants(self.0.id())?;
        drop(self);
        for process in &below {
            // one that has ended cannot be killed any more
            let _ = Command::new("kill").args(["-KILL", &process.to_string()]).stderr(Stdio::null()).status()?;
        }
        Ok(below.len())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Processes below one, as Linux tells them.
fn descendants(of: u32) -> Result<Vec<u32>, Failure> {
    let parent = |process: u32| -> Option<u32> {
        let about = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
        about.rsplit_once(')')?.1.split_whitespace().nth(1)?.parse().ok()
    };
    let all = fs::read_dir("/proc")?.flatten().filter_map(|entry| entry.file_name().to_str()?.parse().ok());
    let parents: Vec<(u32, u32)> = all.filter_map(|process| Some((process, parent(process)?))).collect();
    let mut found = vec![of];
    let mut next = 0;
    while let Some(at) = found.get(next).copied() {
        found.extend(parents.iter().filter(|(_, parent)| *parent == at).map(|(process, _)| *process));
        next += 1;
    }
    Ok(found.split_off(1))
}
