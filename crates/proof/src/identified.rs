//! `cargo xtask identify`: cells drawn from the priors, measured with noise, identified, and held against the truth.

use std::fmt::Write as _;
use std::time::Instant;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use fogcoil::input;
use fogcoil::input::TargetsCase;
use homogenization::identify::{Direction, Family, FamilyFit, Fit, Random, Target, Uncertainty, identify, starts};
use homogenization::{FibreCell, homogenize};

use crate::peers::own as processor;
use crate::{Failure, files};

const TARGETS: &str = "fixtures/identify/table-one.ron";
const PAGE: &str = "docs/identify.md";
/// Between these lines the page holds what this command writes.
const MARKS: [&str; 2] = ["<!-- measured: written by `cargo xtask identify` -->", "<!-- measured end -->"];
/// Relative standard deviation of each measured constant.
const NOISE: f64 = 0.01;
/// Of the truths and the noise; the identification has its own, so that no start is a truth.
const TRUTHS: u64 = 2026;
const SEED: u64 = 7;
/// A start closer to the truth than this, in prior standard deviations, would be no search.
const TOO_CLOSE: f64 = 1.0;
/// Probability that the intervals are to hold.
const PROBABILITY: f64 = 0.9;
/// Cells asked for, and how many of them at least must lie inside.
const CELLS: usize = 10;
const LEAST_INSIDE: f64 = 0.8;

struct JudgedCell {
    family: String,
    unknowns: usize,
    /// Whether the truth lies in all simultaneous intervals.
    inside: bool,
    /// Parameters whose own interval holds the truth.
    covered: usize,
    rank: usize,
    /// Of the `rank` combinations that the entries fix, those whose own interval holds the truth's.
    fixed_covered: usize,
    /// Median over parameters of what is left of the prior.
    left: f64,
    /// Distance of the truth from the nearest start, in prior standard deviations.
    nearest: f64,
    seconds: f64,
}

/// Identify cells drawn from the priors and measured with 1 % noise, and hold them against the truth
///
/// Writes the table of docs/identify.md. Exit status 1 if fewer truths than 8 of 10 lie in the 90 % intervals.
#[derive(Debug, Args)]
pub struct Identify {
    /// How many; the page is written for the usual number only
    #[arg(long, value_name = "N", default_value_t = CELLS, value_parser = RangedU64ValueParser::<usize>::new().range(1..=1000))]
    cells: usize,
}

impl Identify {
    /// Judges the cells; writes the page's table if they are as many as it shows. `false` if too few truths lie inside.
    pub fn run(&self) -> Result<bool, Failure> {
        let case = input::read_targets(TARGETS.as_ref())?;
        let (paper, holds) = paper(&case)?;
        eprintln!("{paper}");
        let mut random = Random::new(TRUTHS);
        let mut rows = Vec::new();
        while rows.len() < self.cells {
            let family = &case.families[(rows.len() + 1) % case.families.len()];
            let (truth, cell) = draw(family, &mut random);
            let row = judge(family, &case.targets, &truth, &cell, &mut random)?;
            eprintln!(
                "{}: inside {}, {} of {} parameters, {} of {} fixed combinations covered, {:.0} s",
                row.family, row.inside, row.covered, row.unknowns, row.fixed_covered, row.rank, row.seconds
            );
            rows.push(row);
        }
        let text = format!("{paper}\n\n{}", table(&rows));
        println!("{text}");
        if self.cells == CELLS {
            files::renew(PAGE.as_ref(), MARKS, &format!("\n\n{}\n", text.trim_end()))?;
        }
        Ok(holds && rows.iter().filter(|row| row.inside).count() as f64 >= LEAST_INSIDE * rows.len() as f64)
    }
}

/// Table I identified: what must be shown of it, and whether it holds.
fn paper(case: &TargetsCase) -> Result<(String, bool), Failure> {
    let (start, before) = (Instant::now(), processor());
    let found = fogcoil::identify::identify(case, &|_| {})?;
    let wall = start.elapsed().as_secs_f64();
    let cpu = processor().zip(before).map_or("unknown".into(), |(after, before)| format!("{:.0} s", after - before));
    let explains: Vec<bool> = found.outcomes.iter().map(FamilyFit::explains).collect();
    let again = |set: &Fit| -> Result<bool, Failure> {
        // as `fogcoil homogenize` solves it
        let constants = homogenize(&set.cell).map_err(|error| Failure(error.to_string()))?.constants.named();
        Ok(case.targets.iter().all(|t| constants.iter().any(|(name, value)| *name == t.name() && t.is_met(*value))))
    };
    let sets = found.alternatives.as_ref().map(|a| Ok::<_, Failure>(again(&a.sets[0])? && again(&a.sets[1])?)).transpose()?;
    let dual = &found.outcomes[found.chosen];
    let holds = explains == [false, true] && again(&dual.best)? && sets == Some(true);
    let regions: Vec<String> = found.posterior.iter().flat_map(|p| &p.regions).map(|r| format!("{:.3}", r.weight)).collect();
    let text = format!(
        "Table I in {cpu} of CPU ({wall:.0} s by the clock, machine shared): single coating explains it: {}; dual coating: {}, all constants within {:.1} prior sigma; regions of the posterior by \
         probability: {}; two sets that give every entry again when solved anew: {}.",
        explains[0],
        explains[1],
        dual.fit().farthest().1,
        regions.join(", "),
        sets == Some(true)
    );
    Ok((text, holds))
}

fn draw(family: &Family, random: &mut Random) -> (Vec<f64>, FibreCell) {
    loop {
        let u = random.normals(family.parameters().len());
        if let Some(cell) = family.cell(&u) {
            return (u, cell);
        }
    }
}

/// The constants of `like`, of a cell that is known, with noise; identified, and compared.
fn judge(family: &Family, like: &[Target], truth: &[f64], cell: &FibreCell, random: &mut Random) -> Result<JudgedCell, Failure> {
    let exact = homogenize(cell).map_err(|error| Failure(error.to_string()))?.constants.named();
    let measured = like.iter().filter_map(|target| {
        let value = exact.iter().find(|(name, _)| *name == target.name())?.1;
        let sd = NOISE * value.abs();
        Target::new(target.name(), value + sd * random.normal(), Uncertainty::Normal(sd))
    });
    let targets: Vec<Target> = measured.collect();
    let distance = |start: &Vec<f64>| start.iter().zip(truth).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let nearest = starts(truth.len(), SEED).iter().map(distance).fold(f64::INFINITY, f64::min);
    if nearest < TOO_CLOSE {
        let problem = format!("a start lies {nearest:.2} prior standard deviations from the truth: change TRUTHS or SEED");
        return Err(Failure(problem));
    }
    let before = processor();
    let found = identify(std::slice::from_ref(family), &targets, SEED, &|_| {});
    let seconds = processor().zip(before).map_or(f64::NAN, |(after, before)| after - before);
    let (unknowns, family) = (truth.len(), family.name.clone());
    let mut row =
        JudgedCell { family, unknowns, inside: false, covered: 0, rank: 0, fixed_covered: 0, left: f64::NAN, nearest, seconds };
    // a cell that is not explained counts as missed
    if let Some(posterior) = found.and_then(|found| found.posterior) {
        let within = |interval: [f64; 2], truth: f64| interval[0] <= truth && truth <= interval[1];
        row.inside = posterior.simultaneous(PROBABILITY).into_iter().zip(truth).all(|(interval, u)| within(interval, *u));
        row.covered = (0..unknowns).filter(|&j| within(posterior.interval(j, PROBABILITY), truth[j])).count();
        row.rank = posterior.rank();
        let along = |d: &&Direction| {
            let truth = truth.iter().zip(&d.along).map(|(u, a)| u * a).sum();
            within(posterior.interval_along(&d.along, PROBABILITY), truth)
        };
        row.fixed_covered = posterior.directions.iter().take(row.rank).filter(along).count();
        let mut left: Vec<f64> = (0..unknowns).map(|j| posterior.deviation(j)).collect();
        left.sort_by(f64::total_cmp);
        row.left = left[unknowns / 2];
    }
    Ok(row)
}

fn table(rows: &[JudgedCell]) -> String {
    let mut out = String::from(
        "| cell | unknowns | nearest start, prior sigma | median left of prior | truth in all simultaneous 90 % intervals | 90 % intervals of single constants that \
         hold it | 90 % intervals of fixed combinations that hold it | CPU s |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (i, row) in rows.iter().enumerate() {
        let JudgedCell { family, unknowns, inside, covered, rank, fixed_covered, left, nearest, seconds } = row;
        let inside = if *inside { "yes" } else { "no" };
        let _ = writeln!(
            out,
            "| {}, {family} | {unknowns} | {nearest:.1} | {:.0} % | {inside} | {covered} of {unknowns} | {fixed_covered} of {rank} | {seconds:.0} |",
            i + 1,
            100.0 * left
        );
    }
    let inside = rows.iter().filter(|row| row.inside).count();
    let sum = |of: fn(&JudgedCell) -> usize| rows.iter().map(of).sum::<usize>();
    let (covered, all, fixed, fixed_all) = (sum(|r| r.covered), sum(|r| r.unknowns), sum(|r| r.fixed_covered), sum(|r| r.rank));
    let share = |part: usize, all: usize| 100.0 * part as f64 / all as f64;
    let _ = writeln!(
        out,
        "\nTruth in all simultaneous 90 % intervals in {inside} of {} cells; 90 % intervals of single constants hold it in {covered} of {all} \
         cases ({:.0} %), those of the combinations that the entries fix in {fixed} of {fixed_all} ({:.0} %).",
        rows.len(),
        share(covered, all),
        share(fixed, fixed_all)
    );
    out
}
