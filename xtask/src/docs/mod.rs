//! `cargo xtask docs-check`: the documents say what the program does.

mod compare;
mod links;
mod notation;
mod page;
mod schema;
mod shell;
mod table;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::input;
use page::Page;
use shell::{Shell, Tally};

use proof::Failure;
use proof::files::{self, root};

use crate::tools::program;

const TUTORIAL: &str = "docs/tutorial.md";
const FORMATS: &str = "docs/formats.md";

/// Run the commands of every page in a folder like a fresh clone, and compare what they print
///
/// The pages of README.md, docs and the crates; their links, snippets and schemas are checked, too. Exit status 1 at a fault.
#[derive(Debug, Args)]
#[group(multiple = false)]
pub(crate) struct DocsCheck {
    /// Run the commands of the tutorial alone
    #[arg(long)]
    tutorial: bool,
    /// Run the commands of one page alone
    #[arg(long, value_name = "FILE.md")]
    page: Option<PathBuf>,
    /// Write what is made from the types: docs/schema and the tables of docs/formats.md
    #[arg(long)]
    write: bool,
}

impl DocsCheck {
    /// Does it; whether all is as it should be.
    pub(crate) fn run(self) -> Result<bool, Failure> {
        let root = root();
        let root = root.as_ref();
        if self.write {
            schema::write(root)?;
            fs::write(root.join(FORMATS), formats(root)?)?;
            return Ok(true);
        }
        let pages = pages(root)?;
        let mut faults = links::faults(root, &pages);
        faults.extend(pages.values().flat_map(snippets));
        faults.extend(schema::files(root)?);
        if formats(root)? != fs::read_to_string(root.join(FORMATS))? {
            faults.push(format!(
                "{FORMATS}: tables of fields are not what the types give; write them by `cargo xtask docs-check --write`"
            ));
        }
        let only = if self.tutorial { Some(TUTORIAL.into()) } else { self.page };
        if let Some(page) = &only
            && !pages.contains_key(page)
        {
            return Err(Failure(format!("{}: is no page; name it from the repository's root", page.display())));
        }
        let program = program()?;
        // beside the folder of the profile
        let cache = program.ancestors().nth(2).unwrap_or(root).join("tmp/cache");
        let shell = Shell::new(root, &program, cache.clone())?;
        let mut tally = Tally::default();
        for page in pages.values().filter(|page| only.as_ref().is_none_or(|only| page.path == *only)) {
            eprintln!("{}", page.path.display());
            shell.run(page, &mut tally)?;
        }
        faults.append(&mut tally.faults);
        if only.is_none() {
            eprintln!("outputs against their schemas");
            faults.extend(schema::outputs(root, &program, &cache)?);
        }
        faults.iter().for_each(|fault| eprintln!("{fault}"));
        println!("{} pages, {} blocks run, {} faults", pages.len(), tally.run, faults.len());
        tally.ignored.iter().for_each(|place| println!("not run: {place}"));
        Ok(faults.is_empty())
    }
}

/// The pages that are checked, by path from the root.
fn pages(root: &Path) -> Result<BTreeMap<PathBuf, Page>, Failure> {
    let mut paths = vec![PathBuf::from("README.md"), "ARCHITECTURE.md".into()];
    for entry in fs::read_dir(root.join("crates"))? {
        paths.push(Path::new("crates").join(entry?.file_name()).join("README.md"));
    }
    let documents = files::below(&root.join("docs"))?.into_iter().map(|file| Path::new("docs").join(file));
    paths.extend(documents.filter(|path| path.extension().is_some_and(|e| e == "md")));
    let there = paths.into_iter().filter(|path| root.join(path).exists());
    there.map(|path| Ok((path.clone(), Page::read(root, &path)?))).collect()
}

/// RON and JSON of a page that cannot be read.
fn snippets(page: &Page) -> Vec<String> {
    let fault = |line: usize, problem: String| format!("{}:{line}: {problem}", page.path.display());
    let check = |fence: &page::Fence| match fence.language() {
        "ron" => {
            let (value, of) = match (notation::json(&fence.text), fence.word("")) {
                (Err((line, problem)), _) => return Some(fault(fence.line + line - 1, problem)),
                (Ok(value), of) => (value, of),
            };
            let (_, schema) = input::schemas().into_iter().find(|(name, _)| Some(*name) == of)?;
            fogcoil::schema::misfit(&value, &schema).map(|misfit| fault(fence.line, misfit))
        }
        "json" => {
            let read: Result<serde_json::Value, _> = serde_json::from_str(&fence.text);
            read.err().map(|error| fault(fence.line + error.line().saturating_sub(1), error.to_string()))
        }
        "console" => {
            Some(fault(fence.line, "commands stand in a `sh` block, what they print in a `text` block behind it".into()))
        }
        _ => None,
    };
    page.fences.iter().filter_map(check).collect()
}

fn formats(root: &Path) -> Result<String, Failure> {
    Ok(table::renewed(&files::read(&root.join(FORMATS))?, &input::schemas()))
}
