//! The folder of a trial: the plan's runs, and their rows as they come.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use proof::Failure;
use proof::files::{root, write};
use proof::program::hash_of_file;
use tempfile::TempDir;

use super::processes::{Running, done, peak, timed, until};
use crate::tools::program;

/// Designs of the plan.
pub(super) const DESIGNS: usize = 512;
/// Designs whose rows share a file until the merge.
pub(super) const PART: usize = 32;
/// Files of rows of the whole plan.
pub(super) const FILES: usize = DESIGNS / PART;
/// Tasks of an array.
pub(super) const SHARES: usize = 16;
/// Files of rows after which a worker is killed.
const HALF: usize = 6;
/// Table of one run.
pub(super) const ALONE: &str = "one.parquet";

pub(super) struct Place {
    folder: TempDir,
    program: PathBuf,
}

/// A finished sweep.
pub(super) struct Trial {
    /// The scheduler and its version.
    pub(super) scheduler: String,
    /// The course, with the loss.
    pub(super) course: String,
    /// The table's file.
    pub(super) table: &'static str,
}

impl Place {
    pub(super) fn new() -> Result<Self, Failure> {
        let place = Self { program: program()?, folder: tempfile::tempdir()? };
        place.write_plan(&place.plan(), DESIGNS, "Sensitivity")?;
        Ok(place)
    }

    fn write_plan(&self, file: &Path, designs: usize, output: &str) -> Result<(), Failure> {
        let drawing = root().join("fixtures/coil-reference.ron");
        let plan =
            format!("(design: {drawing:?}, sampling: MonteCarlo({designs}), others: WithinTolerances, outputs: [{output}])\n");
        write(file, &plan)
    }

    pub(super) fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// A file in the folder.
    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A script for clusters.
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

    fn sweep(&self, plan: &Path, table: &str) -> Command {
        let mut command = self.command(&self.program);
        command.arg("sweep").arg(plan).args(["--out", table, "--quiet"]).stdout(Stdio::null());
        command
    }

    /// Computes the plan in one run on one thread; its processor time \[s\].
    pub(super) fn alone(&self) -> Result<f64, Failure> {
        timed(self.sweep(&self.plan(), ALONE).env("RAYON_NUM_THREADS", "1"))
    }

    /// Makes the table of the shares.
    pub(super) fn merge(&self, table: &str) -> Result<(), Failure> {
        done(self.sweep(&self.plan(), table).arg("--merge"))
    }

    /// Size of the kept rows of the plan \[bytes\].
    pub(super) fn kept_bytes(&self) -> Result<u64, Failure> {
        const TABLE: &str = "kept.parquet";
        done(self.sweep(&self.plan(), TABLE).args(["--share", "1/1"]))?;
        let files = self.kept(TABLE);
        let sizes: Vec<u64> = files.iter().filter_map(|file| Some(fs::metadata(file).ok()?.len())).collect();
        if sizes.len() == FILES {
            Ok(sizes.iter().sum())
        } else {
            Err(Failure(format!("there are {} files of rows", sizes.len())))
        }
    }

    /// Memory of the merge of a plan of so many designs, whose windings alone are computed \[bytes\].
    pub(super) fn peak_of_merge(&self, designs: usize) -> Result<u64, Failure> {
        let (plan, table) = (self.path(&format!("{designs}.ron")), format!("{designs}.parquet"));
        self.write_plan(&plan, designs, "Winding")?;
        done(self.sweep(&plan, &table).args(["--share", "1/1"]))?;
        peak(self.sweep(&plan, &table).arg("--merge"))
    }

    /// SHA-256 of a table.
    pub(super) fn hash(&self, table: &str) -> Result<String, Failure> {
        hash_of_file(&self.path(table))
    }

    /// Kills a worker with its `tasks` once it has some and a part of the table's rows is kept; the number of files of rows at that moment.
    pub(super) fn kill_half_way(
        &self,
        table: &str,
        worker: Running,
        tasks: impl Fn(&Running) -> Result<Vec<u32>, Failure>,
    ) -> Result<usize, Failure> {
        let mut found = Vec::new();
        until("a task of the second worker", || {
            found = tasks(&worker)?;
            Ok(self.kept(table).len() >= HALF && !found.is_empty())
        })?;
        worker.kill(&found)?;
        let there = self.kept(table).len();
        if there >= FILES { Err(Failure("all was computed before the worker was killed".into())) } else { Ok(there) }
    }

    fn kept(&self, table: &str) -> Vec<PathBuf> {
        let files = fs::read_dir(self.path(&format!("{table}.parts"))).into_iter().flatten().flatten();
        files.map(|file| file.path()).filter(|file| file.extension().is_some_and(|end| end == "part")).collect()
    }
}
