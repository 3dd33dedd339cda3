//! `cargo xtask fuzz`: readers of files, fed with inputs that are guided by the code that they reach.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use proof::Failure;
use proof::files::{failed, names, read, renew, root};
use proof::peers::children;

use crate::tools::tool;

/// The runner, and the engine that it brings.
const RUNNER: [&str; 2] = ["cargo-bolero", "0.13.5"];
const PAGE: &str = "docs/trust.md";
const MARKS: [&str; 2] = ["<!-- fuzz: written by `cargo xtask fuzz` -->", "<!-- fuzz end -->"];
/// Longest input of the corpus that is kept \[bytes\], and most inputs of a reader; the shortest come first.
const LONGEST: u64 = 2048;
const MOST: usize = 150;

/// Readers by the names of their tests, with files of the repository, whole or a folder's, that fuzzing starts from.
const READERS: [(&str, &[&str]); 10] = [
    ("coils", &["fixtures/coil-reference.ron", "fixtures/designs", "crates/fogcoil/templates/coil.ron"]),
    ("cells", &["fixtures/cell-reference.ron", "fixtures/cells", "crates/fogcoil/templates/cell.ron"]),
    ("targets", &["fixtures/identify", "crates/fogcoil/templates/targets.ron"]),
    ("mechanisms", &["crates/fogcoil/templates/mechanism.ron"]),
    ("expressions", &[]),
    ("profiles", &["crates/fogcoil/templates/profile.csv"]),
    ("thermometers", &[]),
    ("recordings", &["fixtures/recordings"]),
    ("plans", &["fixtures/plans"]),
    ("batches", &["crates/fogcoil/templates/limits.ron"]),
];

/// Feed every reader of files with inputs that are guided by the code that they reach
///
/// The runner is installed into target/tools. Writes docs/trust.md, where processor times and inputs of all runs add up, and the corpus that `cargo test`
/// replays, fuzz/src/__fuzz__. Exit status 1 if an input crashes a reader: it is kept there, too.
#[derive(Debug, clap::Args)]
pub(crate) struct Fuzz {
    /// Readers, by the names of their tests in fuzz/src/readers.rs [default: all]
    readers: Vec<String>,
    /// Time for which each of them is fed
    #[arg(long, value_name = "MINUTES", default_value_t = 60)]
    minutes: u64,
}

/// Outcome of one reader.
struct Fed {
    reader: &'static str,
    inputs: u64,
    /// Processor time \[s\].
    seconds: u64,
    /// Edges of code that inputs reach.
    edges: u64,
    kept: usize,
    crashes: usize,
}

impl Fuzz {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let known = |name: &String| READERS.iter().any(|(reader, _)| reader == name);
        if let Some(name) = self.readers.iter().find(|name| !known(name)) {
            return Err(Failure(format!("{name}: no such reader; choose {}", READERS.map(|(reader, _)| reader).join(", "))));
        }
        let chosen = |reader: &str| self.readers.is_empty() || self.readers.iter().any(|name| name == reader);
        let (page, mut crashes) = (root().join(PAGE), 0);
        for (reader, seeds) in READERS.iter().filter(|(reader, _)| chosen(reader)) {
            let fed = fed(reader, seeds, 60 * self.minutes)?;
            crashes += fed.crashes;
            // what was fed is told even if the next reader's run is stopped
            renew(&page, MARKS, &table(&[fed], &read(&page)?))?;
        }
        print!("{}", table(&[], &read(&page)?));
        Ok(crashes == 0)
    }
}

/// All readers: minutes and inputs of those that were fed are added to what the page tells of them, as each run goes on from the inputs that were kept.
fn table(fed: &[Fed], page: &str) -> String {
    let mut table = String::from(
        "\n| reader | minutes of one core, in all | inputs, in all | edges of code reached | kept inputs | crashes |\n|---|---|---|---|---|---|\n",
    );
    for (name, _) in READERS {
        let known = page.lines().find(|line| line.starts_with(&format!("| {name} |")));
        let cell = |at: usize| known.and_then(|line| line.split('|').nth(at)?.trim().parse::<u64>().ok()).unwrap_or(0);
        table += &match fed.iter().find(|fed| fed.reader == name) {
            Some(Fed { inputs, seconds, edges, kept, crashes, .. }) => {
                format!("| {name} | {} | {} | {edges} | {kept} | {crashes} |\n", cell(2) + seconds / 60, cell(3) + inputs)
            }
            None => known.map_or_else(|| format!("| {name} | 0 | 0 | | | |\n"), |line| format!("{line}\n")),
        };
    }
    table
}

/// A command of the runner for a reader.
fn runner(command: &str, reader: &str) -> Result<Command, Failure> {
    let mut runner = tool(RUNNER)?;
    // the engine needs no sanitizer here, for there is no unsafe code; the toolchain at hand will do
    runner.args(["bolero", command, "--package", "fuzz", "--rustc-bootstrap", "--sanitizer", "NONE"]);
    runner.arg("--target-dir").arg(root().join("target/fuzz"));
    runner.arg(format!("readers::{reader}")).current_dir(root()).stdin(Stdio::null()).stdout(Stdio::null());
    Ok(runner)
}

/// The files of a folder, or the file.
fn files(place: &str) -> Result<Vec<PathBuf>, Failure> {
    let path = root().join(place);
    if path.is_file() {
        return Ok(vec![path]);
    }
    let all = names(&path)?.into_iter().map(|name| path.join(name));
    Ok(all.filter(|path| path.extension().is_some_and(|kind| kind == "ron" || kind == "csv")).collect())
}

fn fed(reader: &'static str, seeds: &[&str], seconds: u64) -> Result<Fed, Failure> {
    eprintln!("{reader}: {seconds} s");
    let own = root().join("fuzz/src/__fuzz__").join(format!("readers__{reader}"));
    let (kept, crashes, corpus) = (own.join("corpus"), own.join("crashes"), root().join("target/fuzz/corpus").join(reader));
    for folder in [&kept, &crashes, &corpus] {
        fs::create_dir_all(folder).map_err(failed(folder))?;
    }
    let seeds = seeds.iter().map(|place| files(place)).collect::<Result<Vec<_>, _>>()?;
    for (number, seed) in seeds.into_iter().flatten().enumerate() {
        fs::copy(&seed, corpus.join(format!("seed-{number}"))).map_err(failed(&seed))?;
    }
    for name in names(&kept)? {
        fs::copy(kept.join(&name), corpus.join(&name)).map_err(failed(&kept))?;
    }
    let fed_for = |seconds: u64| -> Result<Output, Failure> {
        let mut command = runner("test", reader)?;
        command.arg("--corpus-dir").arg(&corpus).arg("--crashes-dir").arg(&crashes);
        Ok(command.arg("-T").arg(format!("{seconds}s")).stderr(Stdio::piped()).output()?)
    };
    // what compiles before the first input counts for nothing
    fed_for(1)?;
    let time = || children().ok_or_else(|| Failure("this system does not tell the processor time of commands".into()));
    let before = time()?;
    let run = fed_for(seconds)?;
    let lasted = (time()? - before) as u64;
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    // by the clock: a machine that stood still makes any input slow
    let crashed = names(&crashes)?.iter().filter(|name| !name.starts_with("slow-unit")).count();
    if !run.status.success() && crashed == 0 {
        return Err(Failure(format!("{reader} was not fuzzed: {}", said.lines().rev().take(5).collect::<Vec<_>>().join("; "))));
    }
    let number = |word: &str| said.rsplit_once(word)?.1.split_whitespace().next()?.parse::<u64>().ok();
    let (inputs, edges) = (number("Done ").unwrap_or(0), number(" cov: ").unwrap_or(0));
    // inputs that reach what no other does; the runner looks for them where they are kept
    renewed(&kept, &corpus, &names(&corpus)?)?;
    if !runner("reduce", reader)?.stderr(Stdio::null()).status()?.success() {
        return Err(Failure(format!("{reader}: the corpus cannot be reduced")));
    }
    renewed(&corpus, &kept, &names(&kept)?)?;
    let size = |name: String| Ok((fs::metadata(corpus.join(&name)).map_err(failed(&corpus))?.len(), name));
    let mut reduced = names(&corpus)?.into_iter().map(size).collect::<Result<Vec<_>, Failure>>()?;
    reduced.retain(|(size, _)| *size <= LONGEST);
    reduced.sort();
    reduced.truncate(MOST);
    let reduced: Vec<String> = reduced.into_iter().map(|(_, name)| name).collect();
    renewed(&kept, &corpus, &reduced)?;
    Ok(Fed { reader, inputs, seconds: lasted, edges, kept: reduced.len(), crashes: crashed })
}

/// Fills a folder anew with files of another.
fn renewed(folder: &Path, from: &Path, names: &[String]) -> Result<(), Failure> {
    fs::remove_dir_all(folder).and_then(|()| fs::create_dir_all(folder)).map_err(failed(folder))?;
    names.iter().try_for_each(|name| fs::copy(from.join(name), folder.join(name)).map(drop).map_err(failed(folder)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_a_reader_add_up_and_leave_the_others_as_they_were() {
        let fed = |inputs| Fed { reader: "coils", inputs, seconds: 180, edges: 70, kept: 5, crashes: 0 };
        let first = table(&[fed(1000)], "no table yet");
        assert!(first.contains("| coils | 3 | 1000 | 70 | 5 | 0 |\n") && first.contains("| cells | 0 | 0 | | | |\n"), "{first}");
        let second = table(&[fed(500)], &first);
        assert!(second.contains("| coils | 6 | 1500 | 70 | 5 | 0 |\n"), "{second}");
        let other = table(&[Fed { reader: "cells", ..fed(7) }], &second);
        assert!(
            other.contains("| coils | 6 | 1500 | 70 | 5 | 0 |\n") && other.contains("| cells | 3 | 7 | 70 | 5 | 0 |\n"),
            "{other}"
        );
        assert_eq!(other.lines().count(), READERS.len() + 3);
    }
}
