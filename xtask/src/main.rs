//! Project chores.

mod bench;
mod browser;
mod cluster;
mod crates;
mod dist;
mod docs;
mod faults;
mod figures;
mod fuzz;
mod mechanisms;
mod mutants;
mod pages;
mod sabotage;
mod supply;
mod tools;
mod validate;
mod web;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;

/// Project chores. Exit status 0: done, and all is as asked; 1: something is not; 2: the command is not understood.
#[derive(Debug, Parser)]
#[command(name = "xtask", bin_name = "cargo xtask")]
enum Chore {
    /// Run the whole chain and compare with the paper's Tables I to IV
    ///
    /// Writes docs/validation.md and the README's headline table. Exit status 1 if a row that must hold does not.
    Validate {
        /// The comparison as JSON
        #[arg(long, value_name = "FILE")]
        json: Option<PathBuf>,
        /// The comparison as one HTML page
        #[arg(long, value_name = "FILE.html")]
        report: Option<PathBuf>,
    },
    Prove(proof::Prove),
    /// Draw the reference coil's figures as SVG files
    Figures {
        /// Where they go
        #[arg(long, value_name = "DIR", default_value = "docs/pictures")]
        out: PathBuf,
    },
    Pages(pages::Pages),
    /// Solve cells of many kinds to 1e-6, each against a much finer solution, finite elements and NGSolve
    ///
    /// Writes docs/cells.md. Exit status 1 if an error is above its estimate or the tolerance, or NGSolve does not agree.
    Cells {
        /// A Python that has NGSolve, which is then run anew (minutes); else its kept values are compared
        #[arg(long, value_name = "PATH")]
        peers_python: Option<PathBuf>,
    },
    /// Measure which mechanisms are mistaken for which: the numbers and pictures of docs/mechanisms
    Mechanisms,
    DocsCheck(docs::DocsCheck),
    Identify(proof::Identify),
    Survey(proof::Survey),
    /// Break the cell's crates in a copy, one line at a time, and list the tests that turn red
    ///
    /// Writes crates/proof/src/validation/sabotage.md. Exit status 1 if no test sees one of the breaks.
    Sabotage,
    /// Each library by itself: what it promises, its own features, its tests, its package
    Crates,
    Cluster(cluster::Cluster),
    Supply(supply::Supply),
    Dist(dist::Dist),
    Web(web::Web),
    Faults(faults::Faults),
    Fuzz(fuzz::Fuzz),
    Mutants(mutants::Mutants),
    /// Times beside errors, into docs/benchmarks.md
    #[command(subcommand)]
    Bench(bench::Bench),
}

fn main() -> ExitCode {
    let outcome = match Chore::parse() {
        Chore::Validate { json, report } => validate::run(json.as_deref(), report.as_deref()),
        Chore::Prove(prove) => prove.run(),
        Chore::Figures { out } => figures::run(&out),
        Chore::Pages(pages) => pages.run(),
        Chore::Cells { peers_python } => proof::cells::run(peers_python.as_deref()),
        Chore::Mechanisms => mechanisms::run(),
        Chore::DocsCheck(check) => check.run(),
        Chore::Identify(identify) => identify.run(),
        Chore::Survey(survey) => survey.run(),
        Chore::Sabotage => sabotage::run(),
        Chore::Crates => crates::run(),
        Chore::Cluster(cluster) => cluster.run(),
        Chore::Supply(supply) => supply.run(),
        Chore::Dist(dist) => dist.run(),
        Chore::Web(web) => web.run(),
        Chore::Faults(faults) => faults.run(),
        Chore::Fuzz(fuzz) => fuzz.run(),
        Chore::Mutants(mutants) => mutants.run(),
        Chore::Bench(bench) => bench.run(),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The chore that `words` behind `cargo xtask` name, or the exit status with which they are refused.
    fn parsed(words: &str) -> Result<Chore, i32> {
        Chore::try_parse_from(std::iter::once("xtask").chain(words.split(' '))).map_err(|e| e.exit_code())
    }

    #[test]
    fn chores_are_told_apart() {
        <Chore as clap::CommandFactory>::command().debug_assert();
        assert!(matches!(parsed("figures"), Ok(Chore::Figures { out }) if out.as_os_str() == "docs/pictures"));
        assert!(matches!(parsed("prove --sealed --again x"), Ok(Chore::Prove(_))));
        assert!(matches!(parsed("prove --ordinary --unit U1847 --unit U4615"), Ok(Chore::Prove(_))));
        assert!(matches!(parsed("prove --ordinary --changed --unit U7986"), Ok(Chore::Prove(_))));
        assert!(matches!(parsed("prove --ordinary --sealed"), Ok(Chore::Prove(_))));
        assert!(matches!(parsed("docs-check --page README.md"), Ok(Chore::DocsCheck(_))));
        assert!(matches!(parsed("dist --no-wheel"), Ok(Chore::Dist(_))));
        assert!(matches!(parsed("bench cell --repetitions 3"), Ok(Chore::Bench(_))));
        assert!(matches!(parsed("prove --synthetic --nulls 5 --seed 7 --concealed 0"), Ok(Chore::Prove(_))));
        assert_eq!(parsed("--help").unwrap_err(), 0);
    }

    #[test]
    fn what_is_no_chore_is_refused() {
        for words in [
            "",
            "valiate",
            "validate now",
            "prove 3",
            "prove --case",
            "prove --case three",
            "prove --sealed --case 3",
            "prove --sealed x",
            "prove --again x",
            "prove --seed 3",
            "prove --synthetic --nulls -1",
            "prove --synthetic --recommended",
            "prove --ordinary --case 3",
            "prove --unit U1847",
            "prove --changed",
            "docs-check --tutorial --write",
            "dist here",
            "identify --cells 0",
            "bench",
            "bench cell --repetitions 2",
            "bench coil --peers-python no/such/file",
        ] {
            assert_eq!(parsed(words).unwrap_err(), 2, "{words}");
        }
    }
}
