//! `sweep`: its arguments, and what it does with them.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::output::Content;
use fogcoil::sweep::{Parts, Plan, Row, Share, Summary, clear, json, merged, read_plan, report, svg, table, text};
use fogcoil::{Error, sweep};

use crate::cli_tables::Tables;
use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Sweep {
    /// The varied keys, the choice of points and the outputs
    #[arg(value_name = "PLAN.ron")]
    plan: PathBuf,
    /// Write the table here, or table.csv, table.parquet and report.html into a folder; rows are kept in FILE.parts beside it (DIR/table.parts) until all
    /// are there, and an interrupted run goes on from them
    #[arg(long, value_name = "FILE.parquet|FILE.csv|DIR")]
    out: PathBuf,
    /// Compute the K-th of N shares of the rows alone and keep them in FILE.parts: for several machines that share a folder; --merge then makes the table
    #[arg(long, value_name = "K/N", value_parser = share)]
    share: Option<Share>,
    /// Make the table of the shares that are in FILE.parts, and compute nothing; exit status 2 if one is missing
    #[arg(long, conflicts_with = "share")]
    merge: bool,
    /// Draw the Sobol' indices of a plan with sampling: Indices(N) here; of any other plan the sensitivity against the keys that it varies
    #[arg(long, value_name = "FILE", conflicts_with = "share")]
    svg: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long, conflicts_with = "share")]
    json: bool,
}

fn share(text: &str) -> Result<Share, String> {
    let pair = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
    let share = pair.map(|(number, of)| Share { number, of }).filter(|share| (1..=share.of).contains(&share.number));
    share.ok_or_else(|| "give K/N, e.g. 3/16: the third of sixteen shares".to_owned())
}

pub(crate) fn run(arguments: &Sweep, progress: &Progress) -> Result<(), Error> {
    let Sweep { plan: file, out, share, merge, svg: picture, json: object } = arguments;
    let tables = Tables::at(out)?;
    let plan = progress.during(&format!("reading {}", files::shown_path(file)), || read_plan(file))?;
    let inputs: Vec<PathBuf> = plan.files.iter().map(|read| read.file.clone()).collect();
    tables.make_folder()?;
    progress.reads(&inputs, &tables.files().chain(picture.as_deref()).map(Some).collect::<Vec<_>>())?;
    progress.tell(&plan.variants.case.warnings);
    progress.tell(&plan.notes().cloned().collect::<Vec<_>>());
    if let (Some(path), false) = (picture, plan.can_be_drawn()) {
        return Err(nothing_to_draw(path));
    }
    let parts = Parts::beside(&tables.stem(), plan.hash());
    let rows = match merge {
        true => progress.during("merging the shares", || merged(&plan, &parts))?,
        false => progress.tasks(|tell| sweep::run(&plan, share.unwrap_or(Share::WHOLE), Some(&parts), tell))?,
    };
    if share.is_some() {
        progress.note(&format!("{} rows are in {}", rows.len(), files::shown_path(parts.folder())));
        return Ok(());
    }
    let summary = progress.during("summing up", || Summary::of(&plan, &rows))?;
    let picture = picture.as_deref().map(|path| drawn(&plan, &summary, &rows, path)).transpose()?;
    tables.save(&table(&plan, &rows), || report(&plan, &summary, &rows), picture.into_iter().collect(), progress)?;
    clear(&plan, &parts);
    print(&if *object { line(&json(&plan, &summary)) } else { text(&plan, &summary) })
}

/// The picture, and its file.
fn drawn<'a>(plan: &Plan, summary: &Summary, rows: &[Row], path: &'a Path) -> Result<(&'a Path, Content<'a>), Error> {
    let picture = svg(plan, summary, rows).ok_or_else(|| nothing_to_draw(path))?;
    Ok((path, Content::Text(picture)))
}

fn nothing_to_draw(path: &Path) -> Error {
    let remedy = "give a plan that varies a number of its own, with Sensitivity among its outputs, or one with sampling: Indices(N) whose |S| varies";
    Error::usage(format!("{}: there is nothing to draw; {remedy}", files::shown_path(path)))
}
