//! `optimise`: its arguments and its work.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::Error;
use fogcoil::optimise::{check, front, json, read_plan, report, search, svg, table, text};
use fogcoil::output::Content;

use crate::cli_tables::Tables;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Optimise {
    /// The varied keys, the numbers to minimise and the limits
    #[arg(value_name = "PLAN.ron")]
    plan: PathBuf,
    /// Write every design that was tried here, or table.csv, table.parquet and report.html into a folder
    #[arg(long, value_name = "FILE.parquet|FILE.csv|DIR")]
    out: Option<PathBuf>,
    /// Write the optimum here, a coil file
    #[arg(long, value_name = "COIL.ron")]
    model_out: Option<PathBuf>,
    /// Draw the front here, where two or more are minimised
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Optimise, progress: &Progress) -> Result<(), Error> {
    let Optimise { plan: file, out, model_out, svg: picture, json: object } = arguments;
    let tables = out.as_deref().map(Tables::at).transpose()?;
    let plan = progress.during(&format!("reading {}", files::shown_path(file)), || read_plan(file))?;
    if picture.is_some() && plan.minimise.len() < 2 {
        return Err(Error::usage("--svg: one number alone is minimised, and there is no front to draw; leave out --svg"));
    }
    let inputs: Vec<PathBuf> = plan.files.iter().map(|read| read.file.clone()).collect();
    tables.iter().try_for_each(Tables::make_folder)?;
    let outputs = tables.iter().flat_map(Tables::files).chain(model_out.as_deref()).chain(picture.as_deref());
    progress.reads(&inputs, &outputs.map(Some).collect::<Vec<_>>())?;
    progress.tell(&plan.variants.case.warnings);
    let found = progress.tasks(|tell| search(&plan, tell))?;
    let best = front(&found.all, &plan.minimise);
    let best = best.first().map(|n| &found.all[*n]);
    let checked = progress.during("checking the optimum", || best.map(|best| check(&plan, best)).transpose())?;
    let mut files: Vec<(&Path, Content)> = Vec::new();
    let model = checked.as_ref().map(|checked| checked.file(&plan, &found.drawn));
    files.extend(model_out.as_deref().zip(model).map(|(path, text)| (path, Content::Text(text))));
    files.extend(picture.as_deref().zip(svg(&plan, &found)).map(|(path, text)| (path, Content::Text(text))));
    match &tables {
        Some(tables) => tables.save(&table(&plan, &found), || report(&plan, &found, checked.as_ref()), files, progress)?,
        None => progress.save(&files)?,
    }
    print(&if *object { line(&json(&plan, &found, checked.as_ref())) } else { text(&plan, &found, checked.as_ref()) })
}
