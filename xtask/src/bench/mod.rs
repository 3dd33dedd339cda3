//! `cargo xtask bench`: times beside errors, against other programs and against the full model. Each subcommand prints a table and
//! rewrites its section of docs/benchmarks.md.

mod cell;
mod coil;
mod diagnose;
mod job;
pub(crate) mod peers;
mod reduced;
mod sensitivity;

pub(crate) use peers::own as processor;

use crate::validate::Failure;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Fewest repetitions from which a median is taken.
const FEWEST: u64 = 3;

/// CPU time of this thread, which does all the work, in laps \[s\]; wall time where the system does not tell.
pub(crate) struct Stopwatch {
    start: Instant,
    last: f64,
}

impl Stopwatch {
    /// Starts.
    pub(crate) fn start() -> Self {
        let mut watch = Self { start: Instant::now(), last: 0.0 };
        watch.lap();
        watch
    }

    /// Seconds since the start or the last lap.
    pub(crate) fn lap(&mut self) -> f64 {
        let nanoseconds =
            std::fs::read_to_string("/proc/thread-self/schedstat").ok().and_then(|s| s.split(' ').next()?.parse::<f64>().ok());
        let now = nanoseconds.map_or(self.start.elapsed().as_secs_f64(), |n| n * 1e-9);
        now - std::mem::replace(&mut self.last, now)
    }
}

/// Prints what is going on, with the seconds since the start.
struct Progress(Instant);

impl Progress {
    fn new() -> Self {
        Self(Instant::now())
    }

    fn say(&self, what: &str) {
        eprintln!("[{:5.1} s] {what}", self.0.elapsed().as_secs_f64());
    }
}

/// Options of a comparison with other programs.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// A Python with the other programs' packages; without it they are skipped
    #[arg(long = "peers-python", value_name = "PATH", env = "FOGCOIL_PEERS_PYTHON", value_parser = file)]
    python: Option<PathBuf>,
    /// Runs of which the median is taken
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(FEWEST..))]
    repetitions: Option<u64>,
}

fn file(path: &str) -> Result<PathBuf, String> {
    Some(PathBuf::from(path)).filter(|path| path.is_file()).ok_or_else(|| "no such file".into())
}

/// What is timed.
#[derive(Debug, Subcommand)]
pub(crate) enum Bench {
    /// The reference cell, ours and the other programs'
    Cell(Options),
    /// The reference cell, ours alone
    #[command(hide = true)]
    CellJob { name: String },
    /// The coil job, ours and the other programs'
    Coil(Options),
    /// The coil job, ours alone under a named setting
    #[command(hide = true)]
    CoilJob { name: String },
    /// Whole diagnoses
    Diagnose,
    /// The reduced against the full model
    Reduced,
    /// The steady sensitivity, ours and NGSolve's
    Sensitivity(Options),
}

impl Bench {
    /// Runs it; always `true`.
    ///
    /// # Errors
    /// [`Failure`] says what went wrong.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        match self {
            Self::Cell(options) => cell::run(options.python.as_deref(), options.repetitions.unwrap_or(11))?,
            Self::CellJob { name } => cell::child(name)?,
            Self::Coil(options) => coil::run(options.python.as_deref(), options.repetitions.unwrap_or(FEWEST))?,
            Self::CoilJob { name } => coil::child(name)?,
            Self::Diagnose => diagnose::run()?,
            Self::Reduced => reduced::run()?,
            Self::Sensitivity(options) => sensitivity::run(options.python.as_deref(), options.repetitions.unwrap_or(21))?,
        }
        Ok(true)
    }
}

/// The workspace's root.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map_or_else(PathBuf::new, Path::to_path_buf)
}

fn reference_coil() -> Result<::coil::Design, Failure> {
    Ok(fogcoil::input::read_coil(&root().join("fixtures/coil-reference.ron"))?.design)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    if n == 0 { f64::NAN } else { (values[(n - 1) / 2] + values[n / 2]) / 2.0 }
}

/// Prints a section and puts it into docs/benchmarks.md.
fn publish(name: &str, section: &str) -> Result<(), Failure> {
    println!("\n{section}");
    let path = root().join("docs/benchmarks.md");
    let failed = |e: std::io::Error| Failure(format!("{}: {e}", path.display()));
    let text = std::fs::read_to_string(&path).map_err(failed)?;
    let (begin, end) = (format!("<!-- {name}: written by `cargo xtask bench {name}` -->"), format!("<!-- {name} end -->"));
    let missing = || Failure(format!("docs/benchmarks.md lacks the lines {begin:?} and {end:?}"));
    let (before, rest) = text.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    std::fs::write(&path, format!("{before}{begin}\n\n{section}\n{end}{after}")).map_err(failed)
}
