//! Processes that end with the trial, as Linux tells of them.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use proof::Failure;

/// Longest that anything is waited for.
const PATIENCE: Duration = Duration::from_secs(600);
/// Interval between two looks.
const LOOK: Duration = Duration::from_millis(20);

/// Runs a command that has to succeed.
pub(super) fn done(command: &mut Command) -> Result<(), Failure> {
    let status = command.status().map_err(|error| failed(command, error))?;
    if status.success() { Ok(()) } else { Err(failed(command, status)) }
}

/// Runs a command that has to succeed; its processor time \[s\].
pub(super) fn timed(command: &mut Command) -> Result<f64, Failure> {
    let before = proof::peers::children().unwrap_or(f64::NAN);
    done(command)?;
    Ok(proof::peers::children().unwrap_or(f64::NAN) - before)
}

/// Runs a command that has to succeed; the most memory that it had \[bytes\].
pub(super) fn peak(command: &mut Command) -> Result<u64, Failure> {
    let mut child = command.spawn().map_err(|error| failed(command, error))?;
    let file = format!("/proc/{}/status", child.id());
    let mut peak = 0;
    let status = loop {
        let about = fs::read_to_string(&file).unwrap_or_default();
        let kilobytes = about.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse().ok());
        peak = peak.max(kilobytes.map_or(0, |k: u64| 1024 * k));
        if let Some(status) = child.try_wait()? {
            break status;
        }
        std::thread::sleep(Duration::from_millis(1));
    };
    if status.success() { Ok(peak) } else { Err(failed(command, status)) }
}

fn failed(command: &Command, why: impl std::fmt::Display) -> Failure {
    Failure(format!("{}: {why}", command.get_program().display()))
}

/// Waits until something is so.
pub(super) fn until(what: &str, mut is_so: impl FnMut() -> Result<bool, Failure>) -> Result<(), Failure> {
    let begun = Instant::now();
    while !is_so()? {
        if begun.elapsed() > PATIENCE {
            return Err(Failure(format!("{what}: waited for in vain")));
        }
        std::thread::sleep(LOOK);
    }
    Ok(())
}

/// A process that ends with the trial.
pub(super) struct Running(Child);

impl Running {
    pub(super) fn start(command: &mut Command) -> Result<Self, Failure> {
        let child = command.stdin(Stdio::piped()).spawn();
        child.map(Self).map_err(|error| failed(command, error))
    }

    /// Starts it, and waits until it says that it is ready.
    pub(super) fn ready(command: &mut Command) -> Result<Self, Failure> {
        let mut running = Self::start(command.stdout(Stdio::piped()))?;
        let said = running.0.stdout.take().map(BufReader::new);
        let is_ready = said.is_some_and(|said| said.lines().map_while(Result::ok).any(|line| line == "ready"));
        if is_ready { Ok(running) } else { Err(failed(command, "does not start")) }
    }

    /// Waits for its end; whether it ended well.
    pub(super) fn wait(mut self) -> Result<bool, Failure> {
        Ok(self.0.wait()?.success())
    }

    /// Processes below it.
    pub(super) fn below(&self) -> Result<Vec<u32>, Failure> {
        let parents: Vec<(u32, u32)> = all()?.into_iter().filter_map(|process| Some((process, parent(process)?))).collect();
        let mut found = vec![self.0.id()];
        let mut next = 0;
        while let Some(at) = found.get(next).copied() {
            found.extend(parents.iter().filter(|(_, parent)| *parent == at).map(|(process, _)| *process));
            next += 1;
        }
        Ok(found.split_off(1))
    }

    /// Ends it at once, and then `others`.
    pub(super) fn kill(self, others: &[u32]) -> Result<(), Failure> {
        drop(self);
        for process in others {
            // a process that has ended cannot be killed any more
            let _ = Command::new("kill").args(["-KILL", &process.to_string()]).stderr(Stdio::null()).status()?;
        }
        Ok(())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Fields of a process's line behind its name: state, parent, ….
fn fields(process: &str) -> Option<Vec<String>> {
    let about = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    Some(about.rsplit_once(')')?.1.split_whitespace().map(str::to_owned).collect())
}

fn parent(process: u32) -> Option<u32> {
    fields(&process.to_string())?.get(1)?.parse().ok()
}

fn all() -> Result<Vec<u32>, Failure> {
    Ok(fs::read_dir("/proc")?.flatten().filter_map(|entry| entry.file_name().to_str()?.parse().ok()).collect())
}

/// Processes that have all `variables`, NAME=VALUE, in their environment, each behind the process that started it.
pub(super) fn with_variables(variables: &[String]) -> Result<Vec<u32>, Failure> {
    let has = |process: &u32| {
        let environment = fs::read(format!("/proc/{process}/environ")).unwrap_or_default();
        variables.iter().all(|variable| environment.split(|byte| *byte == 0).any(|one| one == variable.as_bytes()))
    };
    let parents = |process: u32| parent(process).filter(|parent| *parent > 1).into_iter().chain([process]);
    Ok(all()?.into_iter().filter(has).flat_map(parents).collect())
}
