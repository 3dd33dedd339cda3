//! The result, for people.

use std::fmt::Write;

use homogenization::identify::{Alternatives, Family, FamilyFit, Fit, Identification, ORDINARY, Posterior, Target, Uncertainty};

use super::{in_words, presentation, title};
use crate::homogenize::constants::presentation as of_constant;
use crate::input::TargetsCase;
use crate::table::{significant, table};

/// Further measurements shown.
const MEASUREMENTS: usize = 5;

/// The whole answer as text.
pub fn text(case: &TargetsCase, result: &Identification) -> String {
    let mut out = format!("{}: constituents from {} effective constants\n", case.name, case.targets.len());
    for (family, outcome) in case.families.iter().zip(&result.outcomes) {
        let _ = write!(out, "\n{}: {}\n\n", family.name, verdict(family, outcome));
        out += &entries(&case.targets, outcome);
    }
    let chosen = &case.families[result.chosen];
    match &result.posterior {
        Some(posterior) => out += &determined(chosen, &result.outcomes[result.chosen].best, posterior),
        None if result.outcomes[result.chosen].explains() => {
            out += "\nThe entries are explained, but by no cell from which the posterior can be sampled: what they determine is not known.\n";
        }
        None => out += "\nNo kind of cell explains the constants with ordinary constituents, so there is nothing to bound.\n",
    }
    match (&result.alternatives, &result.posterior) {
        (Some(alternatives), _) => out += &apart(chosen, alternatives),
        (None, Some(_)) => out += "\nNo two sets that explain the constants alike were found.\n",
        (None, None) => {}
    }
    out
}

fn verdict(family: &Family, outcome: &FamilyFit) -> String {
    let (j, sigma) = outcome.best.farthest();
    let farthest = || {
        let parameter = &family.parameters()[j];
        let (_, _, unit, convert) = presentation(parameter.quantity);
        let value = significant(convert(outcome.best.values[j]), 3);
        format!("{} {value} {unit}, {sigma:.1} sigma from what is ordinary", title(parameter))
    };
    let missed = |fit: &Fit| fit.met.iter().filter(|met| !**met).count();
    match (outcome.best.reproduces(), outcome.explains()) {
        (_, true) => {
            format!("explains every entry with ordinary constituents (all within {:.1} sigma)", outcome.fit().farthest().1)
        }
        (true, false) => format!(
            "no ordinary cell found that explains every entry; it would take e.g. {}; within {ORDINARY} sigma {} entries are missed",
            farthest(),
            missed(outcome.fit())
        ),
        (false, false) => format!(
            "no cell found that explains every entry; {} are missed at best (then {}), {} within {ORDINARY} sigma",
            missed(&outcome.best),
            farthest(),
            missed(outcome.fit())
        ),
    }
}

fn entries(targets: &[Target], outcome: &FamilyFit) -> String {
    let best = if outcome.ordinary.is_some() { "best ordinary cell" } else { "best cell" };
    let mut rows = vec![["entry", "target", "within", best, "unit", ""].map(String::from)];
    let fit = outcome.fit();
    for (target, (value, met)) in targets.iter().zip(fit.entries.iter().zip(&fit.met)) {
        let (unit, convert, _) = of_constant(target.name());
        let width = match target.uncertainty {
            Uncertainty::Rounded(half) => format!("± {}", significant(convert(half), 2)),
            Uncertainty::Normal(sd) => format!("sd {}", significant(convert(sd), 2)),
        };
        let met = if *met { "met" } else { "MISSED" };
        let [aim, value] = [target.value, *value].map(|value| significant(convert(value), 5));
        rows.push([target.name().into(), aim, width, value, unit.into(), met.into()]);
    }
    table(&rows)
}

fn determined(family: &Family, best: &Fit, posterior: &Posterior) -> String {
    let parameters = family.parameters();
    let heads = ["constituent", "prior 90 %", "best fit", "posterior 90 %", "left of prior", "unit"];
    let mut rows = vec![heads.map(String::from)];
    for (j, parameter) in parameters.iter().enumerate() {
        let (_, _, unit, convert) = presentation(parameter.quantity);
        let range = |[low, high]: [f64; 2]| format!("{} .. {}", significant(convert(low), 3), significant(convert(high), 3));
        let prior = range([parameter.prior.low, parameter.prior.high]);
        let found = range(posterior.interval(j, 0.9).map(|u| parameter.prior.value(u)));
        let left = format!("{:.0} %", 100.0 * posterior.deviation(j));
        rows.push([title(parameter), prior, significant(convert(best.values[j]), 4), found, left, unit.into()]);
    }
    let (rank, all) = (posterior.rank(), parameters.len());
    let shares: Vec<String> = posterior.regions.iter().map(|region| format!("{:.1} %", 100.0 * region.weight)).collect();
    let regions = match shares.len() {
        1 => String::new(),
        n => format!("{n} regions that lie apart explain the entries, with {} of the probability.\n", shares.join(" and ")),
    };
    let mut out = format!(
        "\n{}: what the entries determine\n\n{}\n{regions}The entries fix {rank} combinations of {all} constants; {} are as open as before. Fixed, best first (powers of \
         prior widths):\n",
        family.name,
        table(&rows),
        all - rank
    );
    for direction in posterior.directions.iter().take(rank) {
        let _ = writeln!(out, "  to {:>7.2e} of its prior: {}", direction.shrinkage(), in_words(&direction.along, &parameters));
    }
    let _ = writeln!(
        out,
        "{} draws worth {:.0} independent ones, on an emulator whose error moves a draw by {:.1e} prior standard deviations",
        posterior.draws.len(),
        posterior.effective_draws,
        posterior.emulator_error
    );
    out
}

fn apart(family: &Family, alternatives: &Alternatives) -> String {
    let mut rows = vec![["constituent", "set A", "set B", "unit"].map(String::from)];
    let [a, b] = &alternatives.sets;
    for (j, parameter) in family.parameters().iter().enumerate() {
        let (_, _, unit, convert) = presentation(parameter.quantity);
        let value = |fit: &Fit| significant(convert(fit.values[j]), 4);
        rows.push([title(parameter), value(a), value(b), unit.into()]);
    }
    let mut out = format!(
        "\nTwo sets that explain every entry alike (solved anew; all constants within {:.1} sigma)\n\n{}\nWhat to measure next, by the spread of the posterior's predictions over the usual error:\n",
        a.farthest().1.max(b.farthest().1),
        table(&rows)
    );
    for measurement in alternatives.measurements.iter().take(MEASUREMENTS) {
        let [a, b] = measurement.values.map(|value| significant(value, 3));
        let _ = writeln!(
            out,
            "  {}: spread {} (SI), {:.1} times the usual error of {}; {a} in set A, {b} in set B",
            measurement.what,
            significant(measurement.spread, 2),
            measurement.power(),
            significant(measurement.error, 1)
        );
    }
    out
}
