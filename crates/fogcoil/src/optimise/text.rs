//! An optimisation for people.

use std::fmt::Write;

use super::check::Checked;
use super::front::front;
use super::measure::{Measure, Measures};
use super::plan::Plan;
use super::search::Found;
use crate::sensitivity::Share;
use crate::table::{significant, table};

/// Most designs of a front that are shown.
const SHOWN: usize = 12;

/// The drawing, the front, and the optimum with its check.
pub fn text(plan: &Plan, found: &Found, checked: Option<&Checked>) -> String {
    let best = front(&found.all, &plan.minimise);
    let sound = found.all.iter().filter(|tried| tried.violation == 0.0).count();
    let mut out = format!(
        "{}: {} designs tried, {sound} keep the limits, {} on the front\n\n",
        plan.variants.case.name,
        found.all.len(),
        best.len()
    );
    let known: Vec<Measure> =
        Measure::ALL.into_iter().filter(|m| plan.asks(Measure::needs_tolerances) || !m.needs_tolerances()).collect();
    let numbers = |measures: &Measures| known.iter().map(|m| significant(m.of(measures), 3)).collect::<Vec<_>>();
    let keys = plan.variants.factors.iter().map(|factor| factor.key.rsplit('.').next().unwrap_or_default().to_owned());
    let head = [vec![String::new()], known.iter().map(|m| m.name().to_owned()).collect(), keys.collect()].concat();
    let mut rows = vec![head, [vec!["drawing".to_owned()], numbers(&found.drawn)].concat()];
    // evenly over the front, both ends among them
    let every = best.len().saturating_sub(1).div_ceil(SHOWN - 1).max(1);
    let chosen = (0..best.len()).filter(|n| n % every == 0 || n + 1 == best.len());
    for n in chosen {
        let tried = &found.all[best[n]];
        let values = tried.values.iter().map(|value| value.as_ref().map_or("-".into(), short)).collect();
        let name = if n == 0 { "optimum".to_owned() } else { String::new() };
        rows.push([vec![name], numbers(&tried.measures), values].concat());
    }
    out.push_str(&table(&rows.into_iter().map(|row| [row, vec![String::new()]].concat()).collect::<Vec<_>>()));
    match checked {
        None => out.push_str("\nno design that was tried keeps the limits; widen them, vary more, or give more trials\n"),
        Some(checked) => {
            let _ = write!(out, "\n{}", of_optimum(plan, found, checked));
        }
    }
    out
}

fn short(value: &crate::variants::Value) -> String {
    match value {
        crate::variants::Value::Number(value) => significant(*value, 4),
        other => other.shown(),
    }
}

fn of_optimum(plan: &Plan, found: &Found, checked: &Checked) -> String {
    let total = checked.steady.sensitivity.total();
    let [most, largest] = checked.quantiles();
    let ratio = found.drawn.sensitivity.abs() / total.abs();
    let mut out = format!(
        "the optimum (least {}) by the full model: S = {} ± {} (deg/h)/(degC/min), |S| {} times below the drawing's\n\
         by its tolerances {} (1 sigma, linear); of {} units within them |S| is below {} in 95 %, {} at most; below 0.5 in {:.1} %\n\n",
        plan.minimise[0].name(),
        significant(total, 3),
        significant(checked.steady.error_estimate, 2),
        significant(ratio, 2),
        significant(checked.band.sd, 2),
        checked.within.len(),
        significant(most, 3),
        significant(largest, 3),
        100.0 * checked.share_below(0.5),
    );
    let head = ["what leads there, change by change", "", "S then", ""].map(str::to_owned).to_vec();
    let start = vec!["the drawing".to_owned(), String::new(), significant(found.drawn.sensitivity, 4), String::new()];
    let step = |(key, value, total): &(String, String, Option<f64>)| {
        let value = value.parse().map_or_else(|_| value.clone(), |number: f64| significant(number, 5));
        vec![key.clone(), value, total.map_or("no design".into(), |total| significant(total, 4)), String::new()]
    };
    let rows: Vec<Vec<String>> = [head, start].into_iter().chain(checked.path.iter().map(step)).collect();
    let shares =
        Share::of(&checked.case, &checked.band).into_iter().take(4).map(|s| format!("{} ({:.0} %)", s.key, 100.0 * s.share));
    let _ = write!(out, "{}\nwhat is left of its spread comes from {}\n", table(&rows), shares.collect::<Vec<_>>().join(", "));
    out
}
