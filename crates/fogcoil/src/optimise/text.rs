//! An optimisation for people.

use std::fmt::Write;

use super::check::{Change, Checked};
use super::front::front;
use super::measure::{Measure, Measures};
use super::plan::Plan;
use super::search::Found;
use crate::sensitivity::Share;
use crate::table::{significant, table};
use crate::variants::{Factor, Kind, Value, Varied};

/// Share of its range within which a number counts as being at an end.
const AT_END: f64 = 1e-3;
/// Most designs of a front that are shown.
const SHOWN: usize = 12;

/// The drawing, the front, and the optimum with its check.
pub fn text(plan: &Plan, found: &Found, checked: Option<&Checked>) -> String {
    let best = front(&found.all, &plan.minimise);
    let sound = found.all.iter().filter(|tried| tried.violation == 0.0).count();
    let mut out = format!(
        "{}: {} designs tried, {sound} keep the limits, {}\n\n",
        plan.variants.case.name,
        found.all.len(),
        on_the_front(best.len())
    );
    out.push_str(&with_end(designs(plan, found, &best)));
    if let Some((count, first)) = &found.failed {
        let _ = writeln!(out, "\n{count} points of the plan have no design; of the first: {first}");
    }
    match checked {
        None => {
            let _ = writeln!(out, "\n{NOTHING}");
        }
        Some(checked) => {
            let [first, second] = of_optimum(plan, found, checked);
            let steps = with_end(steps(found, checked));
            let _ = write!(out, "\n{first}\n{second}\n\n{steps}\n");
            for remark in remarks(plan, found, &best, checked) {
                let _ = writeln!(out, "{remark}");
            }
        }
    }
    out
}

/// Message where no design keeps the limits.
pub(super) const NOTHING: &str = "no design that was tried keeps the limits; widen them, vary more, or give more trials";

/// The rows as text; an empty last cell keeps every number to the right.
fn with_end(rows: Vec<Vec<String>>) -> String {
    table(&rows.into_iter().map(|row| [row, vec![String::new()]].concat()).collect::<Vec<_>>())
}

/// The drawing and designs of the front, the optimum first, below a head.
pub(super) fn designs(plan: &Plan, found: &Found, best: &[usize]) -> Vec<Vec<String>> {
    let known: Vec<Measure> =
        Measure::ALL.into_iter().filter(|m| plan.asks(Measure::needs_tolerances) || !m.needs_tolerances()).collect();
    let numbers = |measures: &Measures| known.iter().map(|m| significant(m.of(measures), 3)).collect::<Vec<_>>();
    let keys: Vec<&str> = plan.variants.factors.iter().map(|factor| factor.key.as_str()).collect();
    let head = [vec![String::new()], known.iter().map(|m| m.name().to_owned()).collect(), within_groups(&keys)].concat();
    let mut rows = vec![head, [vec!["drawing".to_owned()], numbers(&found.drawn)].concat()];
    for n in shown(best.len()) {
        let tried = &found.all[best[n]];
        let values = tried.values.iter().map(|value| value.as_ref().map_or("-".into(), short)).collect();
        let name = if n == 0 { "optimum".to_owned() } else { String::new() };
        rows.push([vec![name], numbers(&tried.measures), values].concat());
    }
    rows
}

/// Keys without the group that they begin with, but where two would be the same.
fn within_groups(keys: &[&str]) -> Vec<String> {
    let within = |key: &str| key.split_once('.').map_or(key, |(_, rest)| rest).to_owned();
    let alone = |key: &str| keys.iter().filter(|other| within(other) == within(key)).count() == 1;
    keys.iter().map(|key| if alone(key) { within(key) } else { (*key).to_owned() }).collect()
}

/// The designs of a front of so many that are shown: evenly over it, both ends among them.
fn shown(count: usize) -> impl Iterator<Item = usize> {
    let every = count.saturating_sub(1).div_ceil(SHOWN - 1).max(1);
    (0..count).filter(move |n| n.is_multiple_of(every) || n + 1 == count)
}

/// How many designs are on the front, and how many of them are shown.
pub(super) fn on_the_front(count: usize) -> String {
    let shown = shown(count).count();
    if shown < count { format!("{count} on the front, {shown} of them in the table") } else { format!("{count} on the front") }
}

fn short(value: &Value) -> String {
    match value {
        Value::Number(value) => significant(*value, 4),
        other => other.shown(),
    }
}

/// The optimum by the full model, and its spread by tolerances.
pub(super) fn of_optimum(plan: &Plan, found: &Found, checked: &Checked) -> [String; 2] {
    let total = checked.steady.sensitivity.total();
    let [most, largest] = checked.quantiles();
    let share = 100.0 * total.abs() / found.drawn.sensitivity.abs();
    let model = format!(
        "the optimum (least {}) by the full model: S = {} ± {} (deg/h)/(degC/min), |S| is {} % of the drawing's",
        plan.minimise[0].name(),
        significant(total, 3),
        significant(checked.steady.error_estimate, 2),
        significant(share, 2),
    );
    let units = format!(
        "by its tolerances {} (1 sigma, linear); of {} units within them |S| is below {} in 95 %, {} at most",
        significant(checked.band.sd, 2),
        checked.within.len(),
        significant(most, 3),
        significant(largest, 3),
    );
    [model, units]
}

/// The changes that lead to the optimum, below a head.
pub(super) fn steps(found: &Found, checked: &Checked) -> Vec<Vec<String>> {
    let head = ["what leads there, change by change", "", "S then"].map(str::to_owned).to_vec();
    let start = vec!["the drawing".to_owned(), String::new(), significant(found.drawn.sensitivity, 4)];
    let step = |(key, value, total): &Change| {
        let value = value.parse().map_or_else(|_| value.clone(), |number: f64| significant(number, 5));
        vec![key.clone(), value, total.map_or("no design".into(), |total| significant(total, 4))]
    };
    [head, start].into_iter().chain(changes(found, checked).map(|(change, _)| step(change))).collect()
}

/// The changes on the way, each with its effect on the sensitivity if it is known. What leaves the sensitivity as it is leads nowhere, as a key that has the
/// drawing's value.
fn changes<'a>(found: &Found, checked: &'a Checked) -> impl Iterator<Item = (&'a Change, Option<f64>)> {
    let mut before = Some(found.drawn.sensitivity);
    checked.path.iter().filter_map(move |change| {
        let last = std::mem::replace(&mut before, change.2);
        (last != change.2).then(|| (change, last.zip(change.2).map(|(last, now)| now - last)))
    })
}

/// Remarks on the optimum.
pub(super) fn remarks(plan: &Plan, found: &Found, best: &[usize], checked: &Checked) -> Vec<String> {
    let warnings = checked.case.warnings.iter().map(|warning| format!("warning about the optimum: {}", warning.message()));
    let remarks = [within_error(found, checked), Some(of_spread(checked)), at_ends(plan, found, best)];
    warnings.chain(remarks.into_iter().flatten()).collect()
}

/// The changes whose effect is no larger than the sensitivity's numerical error, if there are such.
fn within_error(found: &Found, checked: &Checked) -> Option<String> {
    let small = |effect: Option<f64>| effect.is_some_and(|effect| effect.abs() <= checked.steady.error_estimate);
    let keys: Vec<&str> =
        changes(found, checked).filter(|(_, effect)| small(*effect)).map(|(change, _)| change.0.as_str()).collect();
    (!keys.is_empty()).then(|| format!("changes within the numerical error: {}", keys.join(", ")))
}

/// The tolerances that the optimum's spread comes from.
fn of_spread(checked: &Checked) -> String {
    let shares =
        Share::of(&checked.case, &checked.band).into_iter().take(4).map(|s| format!("{} ({:.0} %)", s.key, 100.0 * s.share));
    format!("what is left of its spread comes from {}", shares.collect::<Vec<_>>().join(", "))
}

/// The keys of which the optimum stands at an end of what the plan lets them be, if there are such.
fn at_ends(plan: &Plan, found: &Found, best: &[usize]) -> Option<String> {
    let optimum = &found.all[*best.first()?];
    let ends = |varied: &Varied| match varied {
        Varied::Uniform(low, high) | Varied::LogUniform(low, high) | Varied::Steps(low, high, _) => Some([*low, *high]),
        Varied::Whole(low, high, by) => Some([*low as f64, (low + (high - low) / by * by) as f64]),
        _ => None,
    };
    let at = |(factor, value): (&Factor, &Option<Value>)| {
        let (Kind::Key(varied), Some(Value::Number(value))) = (&factor.kind, value) else { return None };
        let [low, high] = ends(varied)?;
        let near = |end: f64| (value - end).abs() <= AT_END * (high - low);
        (near(low) || near(high)).then(|| format!("{} = {}", factor.key, short(&Value::Number(*value)).trim_end_matches(".00")))
    };
    let all: Vec<String> = plan.variants.factors.iter().zip(&optimum.values).filter_map(at).collect();
    (!all.is_empty())
        .then(|| format!("at an end of its range in the plan: {}; a wider range may give a better design", all.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_names_the_part_that_it_is_of() {
        let keys = ["spool.hub_thickness_mm", "spool.flanges[0].thickness_mm", "winding.tails_m.ccw", "dehomogenization"];
        assert_eq!(within_groups(&keys), ["hub_thickness_mm", "flanges[0].thickness_mm", "tails_m.ccw", "dehomogenization"]);
        let materials = ["spool.material", "coil.material", "winding.layers"];
        assert_eq!(within_groups(&materials), ["spool.material", "coil.material", "layers"]);
    }
}
