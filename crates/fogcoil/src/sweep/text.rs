//! A sweep as text.

use std::fmt::Write;

use super::indices::Indices;
use super::plan::Plan;
use super::statistics::{Spread, Summary};
use crate::table::{beside, significant, table};
use crate::units::parameter_unit;

/// The computed designs, the spread of their outputs and its origins.
pub fn text(plan: &Plan, summary: &Summary) -> String {
    let mut out =
        format!("{}: {} designs of {} points, seed {}\n", plan.variants.case.name, summary.designs, plan.count(), plan.seed);
    if let Some((count, first)) = &summary.failed {
        let _ = writeln!(out, "{count} points have no design; of the first: {first}");
    }
    let head = ["", "mean", "sd", "least", "5 %", "median", "95 %", "largest", ""].map(str::to_owned).to_vec();
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(summary.spreads.iter().map(spread)).collect();
    let _ = write!(out, "\n{}", table(&rows));
    if let Some(error) = summary.error {
        let _ = writeln!(out, "\n{}", of_error(error));
    }
    if let Some(smallest) = &summary.smallest {
        let _ =
            writeln!(out, "\nsmallest |total|: {} (deg/h)/(degC/min) at {}", significant(smallest.total, 3), smallest.words());
    }
    if let Some((linear, total)) = summary.linear_sd.zip(summary.total()) {
        let off = 100.0 * (total.sd / linear - 1.0);
        let _ = writeln!(
            out,
            "\nstandard deviation of the total: {} of these designs, {} by `fogcoil sensitivity` to first order ({off:+.1} %)",
            significant(total.sd, 3),
            significant(linear, 3)
        );
    }
    if let Some(indices) = &summary.indices {
        let _ = write!(out, "\n{}", of_groups(indices));
    }
    out
}

/// The numerical error of the sensitivities, in words.
pub(super) fn of_error(error: f64) -> String {
    format!("numerical error of a sensitivity: about {} (deg/h)/(degC/min), estimated of the drawing", significant(error, 2))
}

/// Name, mean, standard deviation, quantiles and unit; rounding is nothing.
pub(super) fn spread(s: &Spread) -> Vec<String> {
    let most = s.quantiles.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let numbers = [s.mean, s.sd].into_iter().chain(s.quantiles).map(|value| significant(beside(value, most), 4));
    std::iter::once(s.name.to_owned()).chain(numbers).chain([unit(s.name)]).collect()
}

fn unit(name: &str) -> String {
    match name {
        "turns" => String::new(),
        "mass_kg" => "kg".into(),
        _ => match parameter_unit(name) {
            unit if unit == "1" => "(deg/h)/(degC/min)".into(),
            unit => unit.into_owned(),
        },
    }
}

fn of_groups(indices: &Indices) -> String {
    let with = |(value, [low, high]): (f64, [f64; 2])| [format!("{value:.3}"), format!("{low:.3} to {high:.3}")];
    let head = ["part of the design", "alone", "90 %", "in all", "90 %", ""].map(str::to_owned).to_vec();
    let rows = indices.all.iter().map(|index| {
        let ([first, of_first], [total, of_total]) = (with(index.first), with(index.total));
        vec![index.group.name().to_owned(), first, of_first, total, of_total, String::new()]
    });
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    let left_out = if indices.left_out > 0 { format!(", {} left out", indices.left_out) } else { String::new() };
    format!("Sobol' indices of |total| from {} pairs{left_out}: shares of its variance\n\n{}", indices.pairs, table(&rows))
}
