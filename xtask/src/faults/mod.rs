//! `cargo xtask faults`: the program is killed, starved and confused; its outputs are whole or absent, its kept models never wrong.

mod disk;
mod row;
mod work;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Child;
use std::thread::sleep;
use std::time::{Duration, SystemTime};

use proof::Failure;
use proof::files::{below, failed, renew, root};
use rand::rngs::SmallRng;
use rand::{Rng, SeedableRng};
use tempfile::TempDir;

use crate::tools::program;
use row::{Row, reference};
use work::{Left, Outputs, WORKS, Work, said};

const PAGE: &str = "docs/trust.md";
const MARKS: [&str; 2] = ["<!-- faults: written by `cargo xtask faults` -->", "<!-- faults end -->"];
/// Seed of the random instants.
const SEED: u64 = 1;
/// Kills after which the kept models are thrown away, so that kills meet their making, too.
const COLD_EVERY: usize = 8;
/// Longest that a kill waits beyond an undisturbed run, as a share of it.
const BEYOND: f64 = 0.1;
/// Error of the clock.
const WRONG_CLOCK: Duration = Duration::from_secs(30 * 86_400);
/// Runs at once.
const AT_ONCE: usize = 4;

/// Kill, starve and confuse the program: outputs are whole or absent, kept models never wrong
///
/// Kills at random instants, full and read-only disks, a clock that goes backwards, an input that changes during the run, four runs at once. Writes
/// docs/trust.md. Exit status 1 if an output is neither whole nor absent, or a run afterwards is not as ever.
#[derive(Debug, clap::Args)]
pub(crate) struct Faults {
    /// Kills in all
    #[arg(long, value_name = "N", default_value_t = 600)]
    kills: usize,
}

impl Faults {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let program = program()?;
        let mut rows = Vec::new();
        let mut random = SmallRng::seed_from_u64(SEED);
        for work in &WORKS {
            eprintln!("{}: kills", work.name);
            rows.push(killed(work, &program, self.kills.div_ceil(WORKS.len()), &mut random)?);
        }
        for work in &WORKS {
            eprintln!("{}: full and read-only disks, a wrong clock, inputs that change, runs at once", work.name);
            rows.extend(disk::rows(work, &program)?);
            rows.push(wrong_clock(work, &program)?);
            rows.push(changed(work, &program, &mut random)?);
            rows.push(at_once(work, &program)?);
        }
        let table = table(&rows);
        renew(&root().join(PAGE), MARKS, &table)?;
        print!("{table}");
        Ok(rows.iter().all(Row::is_sound))
    }
}

/// A run with the same kept models writes what it always does.
fn recovers(work: &Work, program: &Path, cache: &Path, right: &Outputs) -> Result<Option<String>, Failure> {
    let (outputs, _) = work.undisturbed(program, cache)?;
    Ok((outputs != *right).then(|| "a run afterwards is another".to_owned()))
}

fn killed(work: &Work, program: &Path, kills: usize, random: &mut SmallRng) -> Result<Row, Failure> {
    let (_, right, [cold, warm]) = reference(work, program)?;
    let mut row = Row::new(format!("`{}`, killed", work.name));
    let mut cache = TempDir::new()?;
    for kill in 0..kills {
        let is_cold = kill % COLD_EVERY == 0;
        if is_cold {
            row.faults.extend(recovers(work, program, cache.path(), &right)?);
            cache = TempDir::new()?;
        }
        let place = work.place()?;
        let whole = if is_cold { cold } else { warm };
        let mut child = work.start(program, place.folder.path(), cache.path())?;
        sleep(whole.mul_f64(random.random_range(0.0..1.0 + BEYOND)));
        // one that has ended cannot be killed any more
        let _ = child.kill();
        child.wait()?;
        row.runs += 1;
        row.left += work.left(place.folder.path(), &[&right])?;
    }
    row.faults.extend(recovers(work, program, cache.path(), &right)?);
    Ok(row)
}

/// Kept models that seem to be from the future, and from long ago.
fn wrong_clock(work: &Work, program: &Path) -> Result<Row, Failure> {
    let (cache, right, _) = reference(work, program)?;
    let mut row = Row::new(format!("`{}`, kept models of another month, before and behind", work.name));
    let now = SystemTime::now();
    for then in [now + WRONG_CLOCK, now - WRONG_CLOCK] {
        for file in below(cache.path())? {
            let path = cache.path().join(file);
            fs::File::options().write(true).open(&path).and_then(|f| f.set_modified(then)).map_err(failed(&path))?;
        }
        let place = work.place()?;
        let run = work.command(program, place.folder.path(), cache.path()).output()?;
        row.ended(work, &run, place.folder.path(), &[&right], true)?;
    }
    Ok(row)
}

/// An input that is replaced, and one that is written over where it stands, at random instants.
fn changed(work: &Work, program: &Path, random: &mut SmallRng) -> Result<Row, Failure> {
    const TIMES: usize = 10;
    let (cache, right, [_, warm]) = reference(work, program)?;
    let mut row = Row::new(format!("`{}`, an input changes", work.name));
    for time in 0..TIMES {
        let place = work.place()?;
        let input = work.input(place.folder.path());
        // another remark at its end changes a file's hash, and nothing else
        let mut text = fs::read_to_string(&input).map_err(failed(&input))?;
        text.push('\n');
        let other = {
            let place = work.place()?;
            fs::write(work.input(place.folder.path()), &text)?;
            let run = work.command(program, place.folder.path(), cache.path()).output()?;
            if !run.status.success() {
                return Err(Failure(format!("{}: {}", work.name, said(&run))));
            }
            work.read(place.folder.path())?
        };
        let child = work.start(program, place.folder.path(), cache.path())?;
        sleep(warm.mul_f64(random.random_range(0.0..1.0)));
        if time % 2 == 0 {
            let beside = place.folder.path().join("..new");
            fs::write(&beside, &text)?;
            fs::rename(&beside, &input)?;
        } else {
            fs::write(&input, &text)?;
        }
        let run = child.wait_with_output()?;
        row.ended(work, &run, place.folder.path(), &[&right, &other], false)?;
    }
    Ok(row)
}

/// Four runs at once with the same models to make, in folders of their own, then in one.
fn at_once(work: &Work, program: &Path) -> Result<Row, Failure> {
    let (_, right, _) = reference(work, program)?;
    let mut row = Row::new(format!("`{}`, four at once", work.name));
    let cache = TempDir::new()?;
    let places = (0..AT_ONCE).map(|_| work.place()).collect::<Result<Vec<_>, _>>()?;
    let shared = work.place()?;
    for folders in [places.iter().map(|p| p.folder.path()).collect::<Vec<_>>(), vec![shared.folder.path(); AT_ONCE]] {
        let children = folders.iter().map(|f| work.start(program, f, cache.path())).collect::<Result<Vec<_>, _>>()?;
        // what others are still writing is no stray
        let runs = children.into_iter().map(Child::wait_with_output).collect::<Result<Vec<_>, _>>()?;
        for (run, folder) in runs.iter().zip(folders) {
            row.ended(work, run, folder, &[&right], true)?;
        }
    }
    row.faults.extend(recovers(work, program, cache.path(), &right)?);
    Ok(row)
}

fn table(rows: &[Row]) -> String {
    let mut table =
        "\n| fault | runs | outputs whole | absent | wrong | runs refused in words | strays | |\n|---|---|---|---|---|---|---|---|\n".to_owned();
    for row in rows {
        let Left { whole, absent, wrong, strays } = row.left;
        let verdict = if row.is_sound() { "holds".to_owned() } else { format!("**FAILS** {}", row.faults.join("; ")) };
        let _ = writeln!(
            table,
            "| {} | {} | {whole} | {absent} | {wrong} | {} | {strays} | {verdict} |",
            row.fault, row.runs, row.refused
        );
    }
    table
}
