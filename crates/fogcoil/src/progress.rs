//! Progress on standard error: notes, and a bar for tasks that take longer than a second; a line in its place where nobody watches.

use std::io::{IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use ::progress::Step;
use fogcoil::glossary::Note;
use fogcoil::output::{self, Content};
use fogcoil::{Error, input};
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use crate::signals;

/// Duration from which a task is named.
const PATIENCE: Duration = Duration::from_secs(1);
/// Least time between two lines on how far a task is.
const AGAIN: Duration = Duration::from_secs(60);
/// Interval between two pictures of a bar that turns.
const TICK: Duration = Duration::from_millis(120);
/// Duration of a counted task from which the time left is said where nobody watches, and the least time that is worth a line.
const KNOWN: Duration = Duration::from_secs(3);
const LONG: Duration = Duration::from_secs(10);
/// A bar, and its form where nothing can be counted.
const COUNTED: &str = "{spinner} {msg} [{bar:32}] {pos} of {len}, {elapsed}{left}";
const UNCOUNTED: &str = "{spinner} {msg} {elapsed}";
/// Longest that an interrupt waits for files which are being written; then it waits as long for them to be given up.
const LEAVE: Duration = Duration::from_secs(5);
/// Exit status of an interrupted program: this and the signal's number.
const INTERRUPTED: i32 = 128;

#[derive(Clone, Copy, PartialEq)]
enum How {
    /// Bars on a terminal.
    Bars,
    /// Lines into a file or a pipe.
    Lines,
    Silent,
}

/// Tells the user, and keeps files whole that are being written when the user interrupts.
pub(crate) struct Progress {
    how: How,
    bar: Arc<Mutex<Option<ProgressBar>>>,
    /// The task that was named last, where there are no bars.
    named: Mutex<Named>,
    /// The files that are written; locked while some are being written.
    written: Arc<Mutex<Vec<String>>>,
    /// Whether files that are being written are to be given up.
    stop: Arc<AtomicBool>,
    /// The files that the run reads: no result may replace one.
    inputs: Mutex<Vec<PathBuf>>,
    /// Results that the work keeps as it goes on, if it does.
    kept: Arc<Mutex<Option<Kept>>>,
    /// The expected end of the task that is counted.
    expected: Arc<Mutex<Expected>>,
}

/// Results that are kept as work goes on, so that an interrupted run is not lost.
struct Kept {
    folder: String,
    /// Their name in the plural.
    name: &'static str,
    /// The task that makes them.
    task: &'static str,
    /// Number that is kept, and of all, once it is known.
    count: Option<(usize, usize)>,
}

impl Kept {
    /// Words for the user who has interrupted; `None` as long as nothing is known to be kept.
    fn said(&self) -> Option<String> {
        let Self { folder, name, count, .. } = self;
        count.map(|(done, all)| format!("{done} of {all} {name} are kept in {folder}; the same command goes on from there"))
    }
}

/// The task that was named last, and when it was.
#[derive(Default)]
struct Named {
    task: String,
    at: Option<Instant>,
}

impl Named {
    /// The line about a step: of a task that begins its name, of one that is counted from time to time how far it is.
    fn says(&mut self, step: Step, now: Instant) -> Option<String> {
        let begins = self.task != step.task;
        let is_due = step.done.is_some() && self.at.is_some_and(|at| now.duration_since(at) >= AGAIN);
        if !begins && !is_due {
            return None;
        }
        *self = Self { task: step.task.to_owned(), at: Some(now) };
        Some(if begins { step.task.to_owned() } else { step.to_string() })
    }
}

/// The expected end of a task: it is reckoned anew whenever a part is done, and the time left runs down in between.
#[derive(Default)]
struct Expected {
    task: String,
    /// Begin of the counting, and the number that was done then.
    begun: Option<(Instant, usize)>,
    done: usize,
    end: Option<Instant>,
    /// Whether it was said once, where there is no bar.
    said: bool,
}

impl Expected {
    fn told(&mut self, task: &str, (done, all): (usize, usize), now: Instant) {
        let Some((since, first)) = self.begun.filter(|(_, first)| self.task == task && *first <= done) else {
            *self = Self { task: task.to_owned(), begun: Some((now, done)), done, ..Self::default() };
            return;
        };
        if done > self.done {
            let each = now.duration_since(since).div_f64((done - first) as f64);
            self.done = done;
            self.end = Some(now + each.mul_f64(all.saturating_sub(done) as f64));
        }
    }

    /// What is done and the time left, once for each task, as soon as it is known well enough; not where little is left.
    fn once(&mut self, (done, all): (usize, usize), now: Instant) -> Option<String> {
        let known = self.begun.is_some_and(|(since, _)| now.duration_since(since) >= KNOWN);
        let long = self.end.is_some_and(|end| end.saturating_duration_since(now) >= LONG);
        (known && long && !std::mem::replace(&mut self.said, true))
            .then(|| format!("{}: {done} of {all}{}", self.task, self.left(now)))
    }

    /// The time left, in words after those of a bar; empty where it is not known.
    fn left(&self, now: Instant) -> String {
        let left = self.end.map(|end| end.saturating_duration_since(now)).filter(|left| !left.is_zero());
        left.map_or(String::new(), |left| format!(", {:#} left", HumanDuration(Duration::from_secs(1 + left.as_secs()))))
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Progress {
    /// Bars if standard error is a terminal that can draw them, else lines; nothing if `quiet`.
    pub(crate) fn new(quiet: bool) -> Self {
        let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let how = match (quiet, std::io::stderr().is_terminal() && !dumb) {
            (true, _) => How::Silent,
            (false, true) => How::Bars,
            (false, false) => How::Lines,
        };
        let progress = Self {
            how,
            bar: Arc::default(),
            named: Mutex::default(),
            written: Arc::default(),
            stop: Arc::default(),
            inputs: Mutex::default(),
            kept: Arc::default(),
            expected: Arc::default(),
        };
        let kept = Arc::clone(&progress.kept);
        let (bar, written, stop) = (Arc::clone(&progress.bar), Arc::clone(&progress.written), Arc::clone(&progress.stop));
        signals::on_end(move |signal| leave(signal, &bar, (&written, &kept), &stop));
        progress
    }

    /// Says from now on, if the user interrupts, how many of the results that a counted task makes are kept in a folder.
    pub(crate) fn keeps(&self, folder: &Path, name: &'static str, task: &'static str) {
        *lock(&self.kept) = Some(Kept { folder: files::shown_path(folder), name, task, count: None });
    }

    pub(crate) fn is_silent(&self) -> bool {
        self.how == How::Silent
    }

    /// Says warnings and notes, of which `quiet` leaves the warnings.
    pub(crate) fn tell(&self, notes: &[Note]) {
        notes.iter().filter(|note| note.is_warning() || !self.is_silent()).for_each(|note| self.say(&note.line()));
    }

    pub(crate) fn note(&self, text: &str) {
        if !self.is_silent() {
            self.say(&format!("note: {text}"));
        }
    }

    fn say(&self, line: &str) {
        // nobody is left to tell if standard error is closed
        let say = || drop(writeln!(std::io::stderr().lock(), "{}", files::shown(line)));
        match lock(&self.bar).as_ref() {
            Some(bar) => bar.suspend(say),
            None => say(),
        }
    }

    fn task(&self, Step { task, done }: Step) {
        if let (Some(kept), Some(count)) = (lock(&self.kept).as_mut(), done)
            && kept.task == task
        {
            kept.count = Some(count);
        }
        let left = done.and_then(|count| {
            let (mut expected, now) = (lock(&self.expected), Instant::now());
            expected.told(task, count, now);
            if self.how == How::Lines { expected.once(count, now) } else { None }
        });
        if let Some(bar) = lock(&self.bar).as_ref() {
            if let Some((done, all)) = done {
                bar.set_length(all as u64);
                bar.set_position(done as u64);
            }
            let expected = Arc::clone(&self.expected);
            let left = move |_: &ProgressState, out: &mut dyn std::fmt::Write| {
                // a bar that cannot be drawn is no failure
                let _ = out.write_str(&lock(&expected).left(Instant::now()));
            };
            bar.set_style(style(if done.is_some() { COUNTED } else { UNCOUNTED }).with_key("left", left));
            bar.set_message(task.to_owned());
            return;
        }
        if let Some(line) = lock(&self.named).says(Step { task, done }, Instant::now()) {
            self.note(&line);
        }
        left.iter().for_each(|left| self.note(left));
    }

    /// Does work that tells its tasks.
    pub(crate) fn tasks<T>(&self, work: impl FnOnce(&(dyn Fn(Step) + Sync)) -> T) -> T {
        self.watched(None, || work(&|step| self.task(step)))
    }

    /// Does `work`, and names it if it takes long.
    pub(crate) fn during<T>(&self, name: &str, work: impl FnOnce() -> T) -> T {
        self.watched(Some(name), work)
    }

    fn watched<T>(&self, name: Option<&str>, work: impl FnOnce() -> T) -> T {
        let bar = (self.how == How::Bars).then(|| {
            let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::hidden()).with_style(style(UNCOUNTED));
            bar.with_message(name.unwrap_or_default().to_owned())
        });
        lock(&self.bar).clone_from(&bar);
        let (done, watch) = channel::<()>();
        let result = thread::scope(|scope| {
            let (bar, name) = (bar.as_ref(), name);
            scope.spawn(move || {
                if watch.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
                    return;
                }
                match (bar, name) {
                    (Some(bar), _) => {
                        bar.set_draw_target(ProgressDrawTarget::stderr());
                        bar.enable_steady_tick(TICK);
                    }
                    (None, Some(name)) => self.note(&format!("{name} ...")),
                    (None, None) => {}
                }
            });
            let result = work();
            drop(done);
            result
        });
        *lock(&self.bar) = None;
        if let Some(bar) = bar {
            bar.finish_and_clear();
        }
        result
    }

    /// Keeps in mind files that the run reads, and refuses results that could not be written, or would replace one of all these.
    pub(crate) fn reads(&self, inputs: &[PathBuf], outputs: &[Option<&Path>]) -> Result<(), Error> {
        let mut known = lock(&self.inputs);
        known.extend_from_slice(inputs);
        Ok(output::check_outputs(&known, outputs)?)
    }

    /// Writes files, if any, and says so; an interrupt waits until they are whole. None of them replaces a file that the run
    /// [reads](Self::reads).
    pub(crate) fn save(&self, files: &[(&Path, Content)]) -> Result<(), Error> {
        if files.is_empty() {
            return Ok(());
        }
        self.reads(&[], &files.iter().map(|(path, _)| Some(*path)).collect::<Vec<_>>())?;
        let names: Vec<String> = files.iter().map(|(path, _)| files::shown_path(path)).collect();
        {
            let mut written = lock(&self.written);
            output::write_files_unless(&self.stop, files)?;
            written.extend_from_slice(&names);
        }
        self.note(&are_written(&names));
        Ok(())
    }

    /// As [`Self::read_coil`], after a check that no output would overwrite the coil file, a cell file that it names, or another input.
    pub(crate) fn read_coil_for(
        &self,
        path: &Path,
        inputs: &[PathBuf],
        outputs: &[Option<&Path>],
    ) -> Result<input::CoilCase, Error> {
        self.reads(&[&[path.to_owned()], inputs].concat(), outputs)?;
        let case = self.read_coil(path)?;
        let files: Vec<PathBuf> = case.fingerprints.iter().map(|read| read.file.clone()).collect();
        self.reads(&files, outputs)?;
        Ok(case)
    }

    /// Reads a coil file and says what in it looks like a mistake.
    pub(crate) fn read_coil(&self, path: &Path) -> Result<input::CoilCase, Error> {
        let case = self.during(&format!("reading {}", files::shown_path(path)), || input::read_coil(path))?;
        case.warnings.iter().for_each(|warning| self.say(&warning.clone().at(path).line()));
        Ok(case)
    }
}

/// Ends the program that was interrupted, as soon as no file is being written, and says what is written. Files that take long are
/// given up.
fn leave(
    signal: i32,
    bar: &Mutex<Option<ProgressBar>>,
    (written, kept): (&Mutex<Vec<String>>, &Mutex<Option<Kept>>),
    stop: &AtomicBool,
) -> ! {
    let asked = Instant::now();
    let mut files = written.try_lock();
    while matches!(files, Err(TryLockError::WouldBlock)) && asked.elapsed() < 2 * LEAVE {
        stop.store(asked.elapsed() > LEAVE, Ordering::Relaxed);
        thread::sleep(Duration::from_millis(10));
        files = written.try_lock();
    }
    let told = lock(kept).as_ref().and_then(Kept::said);
    let state = match (files.as_ref(), told) {
        (Ok(files), Some(told)) if files.is_empty() => told,
        (Ok(files), _) => are_written(files),
        (Err(_), _) => "each file that was being written is whole or absent".into(),
    };
    if let Some(bar) = lock(bar).take() {
        bar.finish_and_clear();
    }
    // nobody is left to tell if standard error is closed
    let _ = writeln!(std::io::stderr().lock(), "interrupted; {state}");
    process::exit(INTERRUPTED + signal)
}

/// Says that files are written; of more than four it names the first.
fn are_written(files: &[String]) -> String {
    match files {
        [] => "nothing is written".into(),
        [file] => format!("{file} is written"),
        [first, more @ ..] if more.len() > 3 => format!("{first} and {} more files are written", more.len()),
        [files @ .., last] => format!("{} and {last} are written", files.join(", ")),
    }
}

fn style(template: &str) -> ProgressStyle {
    // the templates are constants; were one wrong, the library's own would do
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()).progress_chars("=> ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_files_are_named() {
        let files = ["a", "b", "c", "d", "e"].map(str::to_owned);
        let said = [0, 1, 2, 4, 5].map(|count| are_written(&files[..count]));
        let expected = [
            "nothing is written",
            "a is written",
            "a and b are written",
            "a, b, c and d are written",
            "a and 4 more files are written",
        ];
        assert_eq!(said, expected);
    }

    #[test]
    fn no_file_that_the_run_reads_is_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let [read, new] = ["read.ron", "new.ron"].map(|name| folder.path().join(name));
        std::fs::write(&read, "read").unwrap();
        let progress = Progress::new(true);
        progress.reads(std::slice::from_ref(&read), &[Some(&new)]).unwrap();
        let text = || Content::Text("written".to_owned());
        // a result whose name is known only once it is found
        let refused = progress.save(&[(new.as_path(), text()), (read.as_path(), text())]);
        assert!(refused.unwrap_err().to_string().contains("read.ron: is given twice, or is an input"));
        assert!(progress.save(&[(new.as_path(), text()), (new.as_path(), text())]).is_err());
        assert_eq!((std::fs::read_to_string(&read).unwrap().as_str(), new.exists()), ("read", false));
        progress.save(&[(new.as_path(), text())]).unwrap();
    }

    #[test]
    fn units_that_are_kept_are_told() {
        let progress = Progress::new(true);
        let said = || lock(&progress.kept).as_ref().and_then(Kept::said);
        progress.keeps("lot/units".as_ref(), "units", "diagnosing units");
        progress.task(Step::begins("reading the records"));
        // models are counted, too, and are no units
        progress.task(Step::counted("modelling the design", 76, 80));
        assert_eq!(said(), None);
        progress.task(Step::counted("diagnosing units", 7, 30));
        assert_eq!(said().unwrap(), "7 of 30 units are kept in lot/units; the same command goes on from there");
    }

    #[test]
    fn without_bars_a_counted_task_is_told_once_a_minute() {
        let (mut named, begin) = (Named::default(), Instant::now());
        let mut says = |step: Step, seconds: u64| named.says(step, begin + Duration::from_secs(seconds));
        assert_eq!(says(Step::counted("diagnosing units", 0, 30), 0).as_deref(), Some("diagnosing units"));
        assert_eq!(says(Step::counted("diagnosing units", 3, 30), 59), None);
        assert_eq!(says(Step::counted("diagnosing units", 7, 30), 61).as_deref(), Some("diagnosing units (7 of 30)"));
        assert_eq!(says(Step::counted("diagnosing units", 9, 30), 100), None);
        assert_eq!(says(Step::begins("writing"), 101).as_deref(), Some("writing"));
        assert_eq!(says(Step::begins("writing"), 1000), None);
    }

    #[test]
    fn the_time_left_runs_down() {
        let (mut expected, begin) = (Expected::default(), Instant::now());
        let at = |seconds: u64| begin + Duration::from_secs(seconds);
        expected.told("units", (3, 10), at(0));
        assert_eq!(expected.left(at(50)), "");
        expected.told("units", (4, 10), at(100));
        // six more at 100 s each, whatever goes by without one that is done
        let left = [100, 300, 500].map(|now| {
            expected.told("units", (4, 10), at(now));
            expected.left(at(now))
        });
        assert_eq!(left, [", 10m left", ", 7m left", ", 3m left"]);
        assert_eq!(expected.left(at(1000)), "");
        expected.told("another", (0, 2), at(1000));
        assert_eq!(expected.left(at(1000)), "");
    }

    #[test]
    fn where_nobody_watches_the_time_left_is_said_once() {
        let (mut expected, begin) = (Expected::default(), Instant::now());
        let mut at = |seconds: u64, done: usize| {
            let now = begin + Duration::from_secs(seconds);
            expected.told("trying designs", (done, 100), now);
            expected.once((done, 100), now)
        };
        let said = [(0, 0), (1, 1), (4, 4), (50, 50)].map(|(seconds, done)| at(seconds, done));
        assert_eq!(said, [None, None, Some("trying designs: 4 of 100, 2m left".to_owned()), None]);
        // little is left of a short task
        assert_eq!([(0, 0), (4, 50)].map(|(seconds, done)| at(100 + seconds, done)), [None, None]);
    }

    #[test]
    fn the_templates_are_read() {
        assert!([COUNTED, UNCOUNTED].iter().all(|template| ProgressStyle::with_template(template).is_ok()));
    }
}
