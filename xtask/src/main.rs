//! Project chores: `cargo xtask validate [--json FILE] [--report FILE.html]`, `cargo xtask prove`, `cargo xtask figures [--out DIR]`, `cargo xtask cells [--peers-python PATH]`,
//! `cargo xtask mechanisms`, `cargo xtask pages [--axe PATH] [--kept]`,
//! `cargo xtask identify [--cells N]`, `cargo xtask sabotage`,
//! `cargo xtask docs-check [--tutorial | --page FILE.md | --write]`, `cargo xtask bench NAME`.

mod bench;
mod cells;
mod cells_peer;
mod crates;
mod docs;
mod figures;
mod identify;
mod mechanisms;
mod pages;
mod prove;
mod sabotage;
mod validate;

use std::process::ExitCode;

const USAGE: &str = "usage: cargo xtask validate [--json FILE] [--report FILE.html]\n       cargo xtask prove [--case NN]...\n       \
    cargo xtask prove --sealed [--again DIR]\n       cargo xtask prove --recommended\n       cargo xtask prove --synthetic [--seed S] [--nulls N] [--concealed N]\n       \
    cargo xtask figures [--out DIR]\n       cargo xtask pages [--axe PATH] [--kept]\n       \
    cargo xtask cells [--peers-python PATH]\n       cargo xtask mechanisms\n       cargo xtask docs-check [--tutorial | --page FILE.md | --write]\n       cargo xtask identify [--cells N]\n       cargo xtask sabotage\n       cargo xtask crates [--check]\n       cargo xtask bench cell|coil|sensitivity [--peers-python PATH] [--repetitions N]\n       cargo xtask bench reduced|diagnose\n\n  \
    validate   run the whole chain, compare with the paper's Tables I to IV,\n             \
    write docs/validation.md and the README's headline table; exit 1 if a row that must hold does not\n  \
    prove      diagnose the units of fixtures/concealed/open, or those named, hold the answers against the truth,\n             \
    write docs/proof.md; exit 1 if a score is not as asked; --sealed: answer the sealed units, once\n             \
    (--again: into DIR, and compare with the answers that are there); --recommended: whether what is recommended tells\n             \
    mechanisms apart; --synthetic: units of the project's own generator,\n             \
    kept in target/prove, where a run that was stopped goes on\n  \
    figures    draw the reference coil's figures as SVG files into docs/pictures, or DIR\n  \
    pages      make the reports from the fixtures and judge them in headless Chromium (found by name, or $CHROMIUM) with axe-core, which\n             \
    npm fetches into target/pages (or PATH); writes docs/pages.md and, into target/pages, screenshots; exit 1 if a page is turned\n             \
    down; --kept: judge the pages that are there\n  \
    cells      cells of many kinds to 1e-6, each against a much finer solution, finite elements and NGSolve; writes docs/cells.md;\n             \
    exit 1 if an error is above its estimate or the tolerance, or NGSolve does not agree; with PATH, a Python that has it,\n             \
    NGSolve is run anew (minutes), else its kept values are compared\n  \
    docs-check run the commands of every page of README.md, docs and the crates in a folder like a fresh clone and compare what they\n             \
    print; check links, snippets and schemas; --tutorial: run that page's commands alone, --page: those of another;\n             \
    --write: write what is made from the types, docs/schema and the tables of docs/formats.md; exit 1 at a fault\n  \
    mechanisms measure which mechanisms are mistaken for which; the numbers of docs/mechanisms and its pictures\n  \
    identify   cells drawn from the priors, measured with 1 % noise, identified, held against the truth; writes the table of docs/identify.md;\n             \
    exit 1 if the truth lies in the 90 % intervals of fewer than 8 of 10\n  \
    sabotage   break the cell's crates in a copy, one line at a time, and list the tests that turn red; writes\n             \
    xtask/src/validate/sabotage.md; exit 1 if no test sees one of them\n  \
    crates     each library by itself: what it promises, its own features, its tests, its package; --check: without tests and packages\n  \
    bench      times beside errors into docs/benchmarks.md: the cell, the coil job and the steady sensitivity beside other programs,\n             \
    PATH being a Python with their packages (else FOGCOIL_PEERS_PYTHON; without it they are skipped); reduced and full model; whole diagnoses";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let outcome = match words[..] {
        ["validate"] => validate::run(None, None),
        ["validate", "--json", file] => validate::run(Some(file.as_ref()), None),
        ["validate", "--report", file] => validate::run(None, Some(file.as_ref())),
        ["validate", "--json", json, "--report", html] | ["validate", "--report", html, "--json", json] => {
            validate::run(Some(json.as_ref()), Some(html.as_ref()))
        }
        ["cells"] => cells::run(None),
        ["cells", "--peers-python", python] => cells::run(Some(python.as_ref())),
        ["sabotage"] => sabotage::run(),
        ["crates"] => crates::run(true).map(|()| true),
        ["crates", "--check"] => crates::run(false).map(|()| true),
        ["mechanisms"] => mechanisms::run(),
        ["figures"] => figures::run("docs/pictures".as_ref()),
        ["figures", "--out", folder] => figures::run(folder.as_ref()),
        ["prove", ref rest @ ..] if !matches!(rest, ["--help" | "-h"]) => match prove::Command::parse(rest) {
            Ok(command) => command.run(),
            Err(error) => {
                eprintln!("error: {error}\n\n{USAGE}");
                return ExitCode::from(2);
            }
        },
        ["pages", ref rest @ ..] if !matches!(rest, ["--help" | "-h"]) => match pages::Command::parse(rest) {
            Ok(command) => command.run(),
            Err(error) => {
                eprintln!("error: {error}\n\n{USAGE}");
                return ExitCode::from(2);
            }
        },
        ["docs-check", ref rest @ ..] if !matches!(rest, ["--help" | "-h"]) => match docs::Command::parse(rest) {
            Ok(command) => command.run(),
            Err(error) => {
                eprintln!("error: {error}\n\n{USAGE}");
                return ExitCode::from(2);
            }
        },
        ["identify", ref rest @ ..] if !matches!(rest, ["--help" | "-h"]) => match identify::Command::parse(rest) {
            Ok(command) => command.run(),
            Err(error) => {
                eprintln!("error: {error}\n\n{USAGE}");
                return ExitCode::from(2);
            }
        },
        ["bench", ref rest @ ..] if !matches!(rest, ["--help" | "-h"]) => match bench::Command::parse(rest) {
            Ok(command) => command.run(),
            Err(error) => {
                eprintln!("error: {error}\n\n{USAGE}");
                return ExitCode::from(2);
            }
        },
        ["--help" | "-h" | "help"]
        | [
            "validate" | "prove" | "cells" | "docs-check" | "figures" | "mechanisms" | "pages" | "identify" | "sabotage"
            | "bench",
            "--help" | "-h",
        ] => {
            println!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            let given =
                if words.is_empty() { "no command is given".into() } else { format!("`{}` is not a command", words.join(" ")) };
            eprintln!("error: {given}\n\n{USAGE}");
            return ExitCode::from(2);
        }
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
