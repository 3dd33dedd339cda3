//! `cargo xtask pages`: the reports as readers have them, in a browser: on a phone, a tablet and a screen, in light and dark, on paper.

mod axe;
mod hand;
mod look;
mod make;

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use crate::browser::{self, Browser};
use look::{Finding, Look, THEMES, WIDTHS};
use proof::Failure;

const FOLDER: &str = "target/pages";
const DOCUMENT: &str = "docs/pages.md";

/// Make the reports from the fixtures and judge them in headless Chromium with axe-core
///
/// Chromium is found by name, or by $CHROMIUM. Writes docs/pages.md and, into target/pages, screenshots and prints. Exit status 1 if a
/// page is turned down.
#[derive(Debug, Args)]
pub(crate) struct Pages {
    /// axe.min.js or the folder that holds it; without it, npm fetches it into target/pages
    #[arg(long, value_name = "PATH")]
    axe: Option<PathBuf>,
    /// Judge the pages that are there from the last run
    #[arg(long)]
    kept: bool,
}

impl Pages {
    /// Makes the pages, looks at each, writes docs/pages.md; whether there is nothing to complain of.
    pub(crate) fn run(self) -> Result<bool, Failure> {
        let chromium = browser::find()?;
        let folder = Path::new(FOLDER);
        fs::create_dir_all(folder)?;
        let folder = &folder.canonicalize()?;
        let axe = axe::source(self.axe.as_deref(), &folder.join("axe"))?;
        let files = if self.kept { kept(folder)? } else { make::all(folder)? };
        let mut browser = Browser::launch(&chromium, &folder.join("browser"))?;
        let mut looks: Vec<Look> = Vec::new();
        for file in &files {
            let faults = charts::faults(&fs::read_to_string(file)?);
            if !faults.is_empty() {
                return Err(Failure(format!("{}: {}", file.display(), faults.join("; "))));
            }
            for width in WIDTHS {
                for theme in THEMES {
                    let look = look::look(&mut browser, &axe, file, width, theme, folder)?;
                    let faults = look.faults();
                    println!("{} {width} px {}: {}", look.page, theme, if faults.is_empty() { "nothing" } else { "" });
                    faults.iter().for_each(|fault| println!("    {fault}"));
                    looks.push(look);
                }
            }
            look::print(&mut browser, file, folder)?;
        }
        let mut wrong = Vec::new();
        for file in files.iter().filter(|file| file.ends_with("simulate.html")) {
            wrong.extend(hand::faults(&mut browser, file)?);
        }
        wrong.iter().for_each(|fault| println!("{fault}"));
        let holds = looks.iter().all(Look::holds) && wrong.is_empty();
        if !self.kept {
            proof::files::write(DOCUMENT.as_ref(), &markdown(&looks, &sizes(&files)?, &browser.version))?;
        }
        println!("screenshots and prints are in {FOLDER}");
        Ok(holds)
    }
}

/// The pages that are there from the last run.
fn kept(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let names = proof::files::names(folder)?;
    Ok(names.iter().filter(|name| name.ends_with(".html")).map(|name| folder.join(name)).collect())
}

/// Pages by name, each with its size, kB.
fn sizes(files: &[PathBuf]) -> Result<String, Failure> {
    let size = |file: &PathBuf| {
        let name = file.file_stem().unwrap_or_default().display();
        Ok(format!("{name} {} kB", fs::metadata(file)?.len().div_ceil(1000)))
    };
    Ok(files.iter().map(size).collect::<Result<Vec<_>, Failure>>()?.join(", "))
}

/// The findings, as docs/pages.md.
fn markdown(looks: &[Look], sizes: &str, chromium: &str) -> String {
    let version = looks.first().map_or(axe::VERSION, |look| look.axe.as_str());
    let mut out = format!(
        "# Pages\n\n\
         Written by `cargo xtask pages`; do not edit. The reports of `fogcoil simulate`, of `fogcoil diagnose` (a unit that is explained, one \
         that nothing in the library explains, one that needs no explanation) and of `cargo xtask validate`, made from the fixtures, opened in \
         {chromium} as on a phone, a tablet and a screen, in light and dark, folded tables opened, and judged by axe-core {version}. The \
         command exits with 1 on a serious or critical finding, on an element wider than the page, on a figure's label that leaves the \
         figure, covers another or is smaller than 9 px, on an error or a warning of the console, on any request besides the page itself, and on \
         a figure that does not answer to a hand: values under the pointer beside those of its table, a part of it, other units, a line taken away. \
         Screenshots and prints on A4 are left in target/pages.\n\n\
         Each page is one file that holds its figures, tables and script: {sizes}.\n\n\
         | page | width [px] | colours | axe: serious, critical | axe: others | wider than the page | labels | console | requests |\n\
         |---|---|---|---|---|---|---|---|---|\n"
    );
    for look in looks {
        let (grave, others): (Vec<&Finding>, Vec<&Finding>) = look.findings.iter().partition(|f| f.grave());
        let listed = |all: &[&Finding]| match all {
            [] => "0".to_owned(),
            all => all.iter().map(|f| format!("{} ({})", f.id, f.nodes)).collect::<Vec<_>>().join(", "),
        };
        let counts = [&look.overflow, &look.labels, &look.console, &look.requests].map(|all| all.len().to_string()).join(" | ");
        let (page, width, theme, grave, others) = (&look.page, look.width, look.theme, listed(&grave), listed(&others));
        let _ = writeln!(out, "| {page} | {width} | {theme} | {grave} | {others} | {counts} |");
    }
    out
}
