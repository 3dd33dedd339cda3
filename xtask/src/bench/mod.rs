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
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Fewest repetitions from which a median is taken.
const FEWEST: usize = 3;

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

/// Options of a subcommand.
pub(crate) struct Options {
    python: Option<PathBuf>,
    repetitions: usize,
}

impl Options {
    /// # Errors
    /// Names the word that is not understood.
    fn parse(words: &[&str], repetitions: usize) -> Result<Self, Failure> {
        let mut options = Self { python: std::env::var_os("FOGCOIL_PEERS_PYTHON").map(PathBuf::from), repetitions };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            let value = words.next().ok_or_else(|| Failure(format!("`{word}` needs a value")))?;
            match *word {
                "--peers-python" => options.python = Some(PathBuf::from(value)),
                "--repetitions" => {
                    let count = value.parse().ok().filter(|n| *n >= FEWEST);
                    options.repetitions =
                        count.ok_or_else(|| Failure(format!("--repetitions {value}: a number, at least {FEWEST}, is needed")))?;
                }
                _ => return Err(Failure(format!("`{word}` is not an option"))),
            }
        }
        match &options.python {
            Some(path) if !path.is_file() => Err(Failure(format!("--peers-python {}: no such file", path.display()))),
            _ => Ok(options),
        }
    }
}

/// A subcommand with its options.
pub(crate) enum Command {
    /// The reference cell, ours and the peers'.
    Cell(Options),
    /// Ours alone, as the process that [`Command::Cell`] starts.
    CellJob(String),
    /// The coil job, ours and the peers'.
    Coil(Options),
    /// Ours alone under a named setting, as the process that [`Command::Coil`] starts.
    CoilJob(String),
    /// Whole diagnoses.
    Diagnose,
    /// Reduced against full model.
    Reduced,
    /// Steady sensitivity beside NGSolve.
    Sensitivity(Options),
}

impl Command {
    /// # Errors
    /// Names the word that is not understood.
    pub(crate) fn parse(words: &[&str]) -> Result<Self, Failure> {
        match words {
            ["cell", rest @ ..] => Ok(Self::Cell(Options::parse(rest, 11)?)),
            ["cell-job", name] => Ok(Self::CellJob(name.to_string())),
            ["coil", rest @ ..] => Ok(Self::Coil(Options::parse(rest, FEWEST)?)),
            ["coil-job", name] => Ok(Self::CoilJob(name.to_string())),
            ["diagnose"] => Ok(Self::Diagnose),
            ["reduced"] => Ok(Self::Reduced),
            ["sensitivity", rest @ ..] => Ok(Self::Sensitivity(Options::parse(rest, 21)?)),
            _ => Err(Failure(format!("`bench {}` is not a command", words.join(" ")))),
        }
    }

    /// Runs it; always `true`.
    ///
    /// # Errors
    /// [`Failure`] says what went wrong.
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        match self {
            Self::Cell(options) => cell::run(options)?,
            Self::CellJob(name) => cell::child(name)?,
            Self::Coil(options) => coil::run(options)?,
            Self::CoilJob(name) => coil::child(name)?,
            Self::Diagnose => diagnose::run()?,
            Self::Reduced => reduced::run()?,
            Self::Sensitivity(options) => sensitivity::run(options)?,
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
