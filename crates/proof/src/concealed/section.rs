//! The section of docs/proof.md on the generated units.

use std::fmt::Write as _;

use fogcoil::cache::Cache;

use super::report;
use super::score::Scored;
use super::summary::{Table, summary};
use super::synthetic::{Case, Plan};
use crate::files::root;
use crate::statistics::{Measured, rate};
use crate::truth::Kind;
use crate::{Failure, program};

/// Makes, answers and scores the units of a plan; writes the section of docs/proof.md. Whether all scores are as asked.
///
/// # Errors
/// [`Failure`] says what went wrong; what is finished is kept and not done again.
pub(super) fn run(plan: &Plan) -> Result<bool, Failure> {
    let folder = root().join("target/prove/synthetic").join(plan.seed.to_string());
    let program = program::hash(&root())?;
    let cases = plan.cases(&folder, &Cache::of_user())?;
    let scored: Vec<Scored> = cases.iter().map(|case| case.scored.clone()).collect();
    let table = summary(&scored);
    report::publish("synthetic", &program, &section(plan, &cases, &table))?;
    println!("{}", report::lines(&table));
    table.failures().for_each(|row| eprintln!("FAILS: {}: {}", row.group, row.quantity));
    Ok(table.failures().next().is_none())
}

fn share(cases: &[&Case]) -> String {
    let raised = cases.iter().filter(|case| case.scored.detected).count();
    match rate(raised, cases.len()) {
        Some(Measured { value, interval: [low, high], cases }) => {
            format!("{raised} of {cases}: {:.1} % [{:.1} to {:.1}]", 100.0 * value, 100.0 * low, 100.0 * high)
        }
        None => "no unit".into(),
    }
}

/// Kind of an unseen noise: what its label says before its numbers.
fn kind(label: &str) -> &str {
    label.split(" of ").next().unwrap_or(label)
}

/// The scores, and the nulls by the noise they have.
fn section(plan: &Plan, cases: &[Case], table: &Table) -> String {
    let nulls: Vec<&Case> = cases.iter().filter(|case| case.scored.kind == Kind::Null).collect();
    let mut out = format!(
        "Seed {}: {} units with nothing concealed, {} with something. Names that an answer gives count as inseparable from the truth where the \
         diagnosis' own forward model, fitted to the noise-free response of the truth, comes within three standard deviations of the noise.\n\n{}",
        plan.seed,
        plan.nulls,
        plan.concealed,
        report::markdown(table)
    );
    let _ = write!(
        out,
        "\n### Falsely detected, by the noise of the unit\n\n| noise beside white noise, drift and walk | falsely detected [90 %] |\n|---|---|\n"
    );
    let without: Vec<&Case> = nulls.iter().copied().filter(|case| case.unseen.is_none()).collect();
    let _ = writeln!(out, "| none | {} |", share(&without));
    let mut kinds: Vec<&str> = nulls.iter().filter_map(|case| case.unseen.as_deref()).map(kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    for name in kinds {
        let of: Vec<&Case> = nulls.iter().copied().filter(|case| case.unseen.as_deref().map(kind) == Some(name)).collect();
        let _ = writeln!(out, "| {name} | {} |", share(&of));
    }
    out
}
