//! Lines of the table of faults.

use std::path::Path;
use std::time::Duration;

use proof::Failure;
use tempfile::TempDir;

use super::work::{Left, Outputs, Work, said};

/// A line of the table.
pub(super) struct Row {
    pub(super) fault: String,
    pub(super) runs: usize,
    pub(super) left: Left,
    /// Number of refusals, of runs that end by themselves.
    pub(super) refused: usize,
    /// Faults: states that must not occur.
    pub(super) faults: Vec<String>,
}

impl Row {
    pub(super) fn new(fault: impl Into<String>) -> Self {
        Self { fault: fault.into(), runs: 0, left: Left::default(), refused: 0, faults: Vec::new() }
    }

    pub(super) fn is_sound(&self) -> bool {
        self.left.wrong == 0 && self.faults.is_empty()
    }
}

impl Row {
    /// A run that ended by itself: it answered, with all outputs, or refused in words: with none, or, of outputs that are never replaced, because another
    /// run's are there.
    pub(super) fn ended(
        &mut self,
        work: &Work,
        run: &std::process::Output,
        folder: &Path,
        right: &[&Outputs],
        must_answer: bool,
    ) -> Result<(), Failure> {
        let left = work.left(folder, right)?;
        let none = left.absent == work.outputs.len();
        self.runs += 1;
        self.left += left;
        match run.status.code() {
            Some(0) if left.whole == work.outputs.len() => {}
            Some(0) => {
                self.faults.push(format!("it claims to have answered, with {} outputs of {}", left.whole, work.outputs.len()))
            }
            Some(2) if !run.stderr.is_empty() && (none && !must_answer || work.keeps && left.whole == work.outputs.len()) => {
                self.refused += 1;
            }
            _ => self.faults.push(said(run)),
        }
        Ok(())
    }
}

/// A folder for kept models, and what an undisturbed run with and without them takes.
pub(super) fn reference(work: &Work, program: &Path) -> Result<(TempDir, Outputs, [Duration; 2]), Failure> {
    let cache = TempDir::new()?;
    let (outputs, cold) = work.undisturbed(program, cache.path())?;
    let (again, warm) = work.undisturbed(program, cache.path())?;
    if again != outputs {
        return Err(Failure(format!("{}: two undisturbed runs differ", work.name)));
    }
    Ok((cache, outputs, [cold, warm]))
}
