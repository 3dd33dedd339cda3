//! `sweep`: its arguments, and what it does with them.

use std::path::PathBuf;

use clap::Args;
use fogcoil::output::Content;
use fogcoil::sweep::{Parts, Plan, Share, Summary, clear, json, read_plan, svg, table, text};
use fogcoil::tabular::{Format, bytes};
use fogcoil::{Error, sweep};

use crate::progress::Progress;
use crate::{line, print};

#[derive(Args)]
pub(crate) struct Sweep {
    /// The varied keys, the choice of points and the outputs
    #[arg(value_name = "PLAN.ron")]
    plan: PathBuf,
    /// Write the table here; rows are kept in FILE.parts beside it until all are there, and an interrupted run goes on from them
    #[arg(long, value_name = "FILE.parquet|FILE.csv")]
    out: PathBuf,
    /// Compute the K-th of N shares of the rows alone and keep them in FILE.parts: for several machines that share a folder; a run without it makes the table
    #[arg(long, value_name = "K/N", value_parser = share)]
    share: Option<Share>,
    /// Draw the Sobol' indices here
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
    let Sweep { plan: file, out, share, svg: picture, json: object } = arguments;
    let format = Format::of(out, &[Format::Parquet, Format::Csv])?;
    let plan = progress.during(&format!("reading {}", files::shown_path(file)), || read_plan(file))?;
    let inputs: Vec<PathBuf> = plan.files.iter().map(|read| read.file.clone()).collect();
    progress.reads(&inputs, &[Some(out), picture.as_deref()])?;
    progress.tell(&plan.variants.case.warnings);
    let parts = Parts::beside(out, plan.hash());
    let rows = progress.tasks(|tell| sweep::run(&plan, share.unwrap_or(Share::WHOLE), Some(&parts), tell))?;
    if share.is_some() {
        progress.note(&format!("{} rows are in {}", rows.len(), files::shown_path(parts.folder())));
        return Ok(());
    }
    let summary = progress.during("summing up", || Summary::of(&plan, &rows))?;
    save(&plan, &summary, (out, bytes(&table(&plan, &rows), format)?), picture.as_ref(), progress)?;
    clear(&plan, &parts);
    print(&if *object { line(&json(&plan, &summary)) } else { text(&plan, &summary) })
}

fn save(
    plan: &Plan,
    summary: &Summary,
    (out, table): (&PathBuf, Vec<u8>),
    picture: Option<&PathBuf>,
    progress: &Progress,
) -> Result<(), Error> {
    let written = |to: &mut dyn std::io::Write| to.write_all(&table);
    let mut files = vec![(out.as_path(), Content::Written(&written))];
    if let Some(path) = picture {
        let indices = summary.indices.as_ref().ok_or_else(|| {
            Error::usage(format!(
                "{}: there are no Sobol' indices to draw; give a plan with sampling: Indices(N) whose |S| varies",
                files::shown_path(path)
            ))
        })?;
        files.push((path.as_path(), Content::Text(svg(&plan.variants.case.name, indices))));
    }
    progress.save(&files)
}
