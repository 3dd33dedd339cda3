//! A program that holds all mutants: its tests, the mutants that each test reaches, and a mutant's trial by those tests alone.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{Mutex, mpsc};
use std::time::{Duration, Instant};

use proof::Failure;
use proof::files::{failed, read, write};

use super::outcome::Outcome;

/// Tests that take less are run together, in seconds.
const QUICK: f64 = 1.0;
/// Least time that a trial may take before it is said never to end, in seconds, and the multiple of the unchanged program's.
const PATIENCE: (f64, f64) = (20.0, 5.0);
/// Least time for which a test is followed that is too slow for a trial, in seconds, and the multiple of the slowest that is not: it has reached by then
/// nearly all that it reaches.
const FOLLOWED: (f64, f64) = (20.0, 10.0);
/// Time between two looks at a test that runs.
const LOOK: Duration = Duration::from_millis(10);
/// Models that a process of all tests makes.
const MODELS: f64 = 10.0;
/// Variables that name the folder of what tests share: what other crates answer, and models, which the crate itself makes.
const SHARED: [&str; 2] = ["FOGCOIL_KEPT", "FOGCOIL_KEPT_MODELS"];
/// Most memory of a trial, KiB: a mutant may ask for ever more.
const MEMORY: usize = 8 << 20;

/// A test program, and the folder in which it runs.
#[derive(Debug, Clone)]
pub(super) struct Program {
    pub(super) path: PathBuf,
    pub(super) folder: PathBuf,
}

/// A test with what it reaches.
#[derive(Debug, Clone, serde::Serialize, serde::Deserialize)]
struct Test {
    /// Of the programs.
    program: usize,
    name: String,
    /// In seconds; of one that was followed for a while alone, that while.
    takes: f64,
    /// The same where all that tests share is made in its process, too.
    anew: f64,
    reaches: BTreeSet<usize>,
    /// Those that act while models are made which tests share.
    made: BTreeSet<usize>,
}

/// The tests of a crate.
#[derive(Debug)]
pub(super) struct Tests {
    programs: Vec<Program>,
    tests: Vec<Test>,
    /// The folder of what tests share, which other mutants than the `made` may use.
    shared: PathBuf,
    made: BTreeSet<usize>,
}

impl Program {
    fn command(&self) -> Command {
        let mut command = Command::new("sh");
        command.args(["-c", &format!("ulimit -v {MEMORY}; exec \"$0\" \"$@\"")]).arg(&self.path);
        command.current_dir(&self.folder).env("CARGO_MANIFEST_DIR", &self.folder).stdin(Stdio::null()).stderr(Stdio::null());
        command
    }

    fn listed(&self, more: &[&str]) -> Result<BTreeSet<String>, Failure> {
        let output = self.command().args(["--list", "--format", "terse"]).args(more).output()?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(text.lines().filter_map(|line| line.strip_suffix(": test")).map(str::to_owned).collect())
    }
}

impl Tests {
    /// Runs every test of the programs alone, with no mutant at work, and keeps how long it takes and which it reaches; in the folder `scratch` for the next time.
    /// A test of far more than `slowest` seconds, which no trial runs, is followed for a while. What tests share they leave in a folder, and take less time
    /// the second time.
    ///
    /// # Errors
    /// [`Failure`] if a test fails.
    pub(super) fn measured(
        programs: Vec<Program>,
        hash: &str,
        jobs: usize,
        slowest: f64,
        scratch: &Path,
    ) -> Result<Self, Failure> {
        std::fs::create_dir_all(scratch).map_err(failed(scratch))?;
        let mut names = Vec::new();
        for (n, program) in programs.iter().enumerate() {
            let ignored = program.listed(&["--ignored"])?;
            names.extend(program.listed(&[])?.difference(&ignored).map(|name| (n, name.clone())));
        }
        let name = format!("{hash}-{slowest}");
        let (kept, shared) = (scratch.join(format!("{name}.json")), scratch.join(name));
        if let Some(tests) = read(&kept).ok().and_then(|text| serde_json::from_str(&text).ok()) {
            return Ok(Self::of(programs, tests, shared));
        }
        std::fs::create_dir_all(&shared).map_err(failed(&shared))?;
        let timed = |n: usize, name: &str, reached: Option<&Path>| -> Result<f64, Failure> {
            let start = Instant::now();
            let mut command = programs[n].command();
            command.args([name, "--exact", "--test-threads", "1"]).env(SHARED[0], &shared).env(SHARED[1], &shared);
            reached.into_iter().for_each(|reached| _ = command.env("FOGCOIL_REACHED", reached));
            let mut child = command.stdout(Stdio::null()).spawn()?;
            let followed = FOLLOWED.0.max(FOLLOWED.1 * slowest);
            let ended = loop {
                if let Some(status) = child.try_wait()? {
                    break status.success();
                }
                if start.elapsed().as_secs_f64() > followed {
                    child.kill()?;
                    child.wait()?;
                    break true;
                }
                std::thread::sleep(LOOK);
            };
            if !ended {
                return Err(Failure(format!("{name} of {} fails unchanged", programs[n].path.display())));
            }
            Ok(start.elapsed().as_secs_f64())
        };
        let measure = |(n, name): (usize, String)| -> Result<Test, Failure> {
            let reached = scratch.join(format!("{n}-{}", name.replace(':', "-")));
            let made = reached.with_extension("made");
            [&reached, &made].into_iter().try_for_each(|file| std::fs::write(file, "").map_err(failed(file)))?;
            let anew = timed(n, &name, Some(&reached))?;
            let [reaches, made] = [reached, made].map(|file| -> Result<_, Failure> {
                let ids = read(&file)?.lines().filter_map(|id| id.parse().ok()).collect();
                std::fs::remove_file(&file).map_err(failed(&file))?;
                Ok(ids)
            });
            Ok(Test { program: n, name, takes: anew, anew, reaches: reaches?, made: made? })
        };
        let queue = Mutex::new(names.into_iter());
        let work = || {
            let next = || queue.lock().ok()?.next();
            std::iter::from_fn(next).map(&measure).collect::<Result<Vec<Test>, Failure>>()
        };
        let measured = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..jobs.max(1)).map(|_| scope.spawn(work)).collect();
            let joined = workers.into_iter().map(std::thread::ScopedJoinHandle::join);
            joined.map(|done| done.unwrap_or_else(|_| Err(Failure("a thread panicked".into())))).collect::<Result<Vec<_>, _>>()
        });
        let mut tests: Vec<Test> = measured?.concat();
        let are_shared = std::fs::read_dir(&shared).map_err(failed(&shared))?.next().is_some();
        for test in tests.iter_mut().filter(|test| are_shared && test.anew > QUICK) {
            test.takes = timed(test.program, &test.name, None)?;
        }
        eprintln!("{} tests, {:.0} s", tests.len(), tests.iter().map(|test| test.takes).sum::<f64>());
        tests.sort_by(|a, b| a.takes.total_cmp(&b.takes));
        write(&kept, &serde_json::to_string(&tests)?)?;
        Ok(Self::of(programs, tests, shared))
    }

    fn of(programs: Vec<Program>, tests: Vec<Test>, shared: PathBuf) -> Self {
        let made = tests.iter().flat_map(|test| test.made.iter().copied()).collect();
        Self { programs, tests, shared, made }
    }

    /// Whether a mutant acts while models are made which tests share: its trials take longest.
    pub(super) fn makes(&self, id: usize) -> bool {
        self.made.contains(&id)
    }

    /// Whether a test fails, or never ends, while a mutant acts; `killers` counts the mutants of this function that each test caught. Tests that take
    /// more than `slowest` seconds are left out: `None` if such a test alone could tell.
    pub(super) fn outcome(
        &self,
        id: usize,
        slowest: f64,
        killers: &mut BTreeMap<usize, usize>,
    ) -> Result<Option<Outcome>, Failure> {
        let reaching = (0..self.tests.len()).filter(|&n| self.tests[n].reaches.contains(&id));
        let (mut reaching, left_out): (Vec<usize>, Vec<usize>) = reaching.partition(|&n| self.tests[n].takes <= slowest);
        reaching.sort_by_key(|n| std::cmp::Reverse(killers.get(n).copied().unwrap_or_default()));
        let mut rounds: Vec<Vec<usize>> = Vec::new();
        if let Some(&first) = reaching.first().filter(|n| killers.contains_key(n)) {
            rounds.push(vec![first]);
            reaching.remove(0);
        }
        let makes = self.makes(id);
        let takes = |n: usize| if makes { self.tests[n].anew } else { self.tests[n].takes };
        let (quick, mut slow): (Vec<usize>, Vec<usize>) = reaching.into_iter().partition(|&n| takes(n) < QUICK);
        slow.sort_by(|&a, &b| self.tests[a].takes.total_cmp(&self.tests[b].takes));
        let of = |program: usize, all: &[usize]| all.iter().copied().filter(|&n| self.tests[n].program == program).collect();
        rounds.extend((0..self.programs.len()).map(|program| of(program, &quick)));
        // what tests share is made once in a process
        if makes {
            rounds.extend((0..self.programs.len()).map(|program| of(program, &slow)));
        } else {
            rounds.extend(slow.into_iter().map(|n| vec![n]));
        }
        for round in rounds.iter().filter(|round| !round.is_empty()) {
            if let Some(killer) = self.killer(id, round)? {
                *killers.entry(killer).or_default() += 1;
                return Ok(Some(Outcome::Caught));
            }
        }
        Ok(left_out.is_empty().then_some(Outcome::Missed))
    }

    /// The test of those of one program that fails or does not end while a mutant acts.
    fn killer(&self, id: usize, round: &[usize]) -> Result<Option<usize>, Failure> {
        let makes = self.makes(id);
        let tests = || round.iter().map(|&n| &self.tests[n]);
        let making = tests().map(|test| test.anew - test.takes).fold(0.0, f64::max);
        let usual = tests().map(|test| test.takes).sum::<f64>() + if makes { MODELS * making } else { 0.0 };
        let mut command = self.programs[self.tests[round[0]].program].command();
        command.env(SHARED[0], &self.shared);
        if !makes {
            command.env(SHARED[1], &self.shared);
        }
        command.args(round.iter().map(|&n| self.tests[n].name.as_str())).args(["--exact", "--test-threads", "1"]);
        let mut child = command.env("FOGCOIL_MUTANT", id.to_string()).stdout(Stdio::piped()).spawn()?;
        let (sender, lines) = mpsc::channel();
        let stdout = child.stdout.take();
        let reader = std::thread::spawn(move || {
            for line in stdout.into_iter().flat_map(|out| BufReader::new(out).lines()).map_while(Result::ok) {
                if sender.send(line).is_err() {
                    break;
                }
            }
        });
        let end = Instant::now() + Duration::from_secs_f64(PATIENCE.0.max(PATIENCE.1 * usual));
        let mut running = round[0];
        let failed = loop {
            match lines.recv_timeout(end.saturating_duration_since(Instant::now())) {
                Ok(line) => {
                    let words = line.strip_prefix("test ").and_then(|rest| rest.split_once(" ... "));
                    let named = words.and_then(|(name, _)| round.iter().copied().find(|&n| self.tests[n].name == name));
                    running = named.unwrap_or(running);
                    if line.ends_with("FAILED") && named.is_some() {
                        break true;
                    }
                }
                Err(mpsc::RecvTimeoutError::Timeout) => break true,
                // the program has ended, with or without an answer
                Err(mpsc::RecvTimeoutError::Disconnected) => break !child.wait()?.success(),
            }
        };
        // it may have ended already
        let _ = child.kill();
        child.wait()?;
        let _ = reader.join();
        Ok(failed.then_some(running))
    }
}
