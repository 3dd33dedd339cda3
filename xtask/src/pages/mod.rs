//! `cargo xtask pages`: the reports as readers have them, in a browser: on a phone, a tablet and a screen, in light and dark, on paper.

mod axe;
mod browser;
mod look;
mod make;
mod table;

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;

use browser::Browser;
use look::{Look, Theme, WIDTHS};
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
                for theme in [Theme::Light, Theme::Dark] {
                    let look = look::look(&mut browser, &axe, file, width, theme, folder)?;
                    let faults = look.faults();
                    println!("{} {width} px {}: {}", look.page, theme.name(), if faults.is_empty() { "nothing" } else { "" });
                    faults.iter().for_each(|fault| println!("    {fault}"));
                    looks.push(look);
                }
            }
            look::print(&mut browser, file, folder)?;
        }
        let holds = looks.iter().all(Look::holds);
        if !self.kept {
            proof::files::write(DOCUMENT.as_ref(), &table::markdown(&looks, &browser.version))?;
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
