//! The page of a sweep.

use charts::{Axis, Cells, Figure, Panel, Series, Style, grid, nice, sections, significant};
use maud::html;

use super::course::against_keys;
use super::outputs::TOTAL;
use super::picture::figure;
use super::plan::Plan;
use super::row::Row;
use super::statistics::Summary;
use super::text::{of_error, spread};
use crate::report::{provenance, sentence};

/// Most points of a line that is drawn.
const DRAWN: usize = 500;

/// Statistics, the distribution of the sensitivity, and its Sobol' indices where there are some.
pub fn report(plan: &Plan, summary: &Summary, rows: &[Row]) -> String {
    let name = &plan.variants.case.name;
    let lead = html! {
        p {
            (summary.designs) " designs of " (plan.count()) " points, seed " (plan.seed) "."
            @if let Some((count, first)) = &summary.failed { " " (count) " points have no design; of the first: " (nice(first)) "." }
            @if let Some(smallest) = &summary.smallest {
                " The smallest sensitivity is " (significant(smallest.total, 3)) " (°/h)/(°C/min), at " (smallest.words()) "."
            }
            @if let Some((linear, total)) = summary.linear_sd.zip(summary.total()) {
                " The sensitivity has a standard deviation of " (significant(total.sd, 3)) " (°/h)/(°C/min); to first order in the tolerances "
                (significant(linear, 3)) "."
            }
            @if let Some(error) = summary.error { " " (sentence(&of_error(error))) }
        }
        @for note in plan.notes() { p { (note.line()) } }
    };
    let head = ["", "mean", "sd", "least", "5 %", "median", "95 %", "largest", "unit"];
    let files: Vec<_> = ["plan", "coil"].into_iter().chain(std::iter::repeat("input")).zip(&plan.files).collect();
    let spreads: Vec<_> = summary.spreads.iter().map(spread).collect();
    let mut parts = vec![("Numbers", grid("Every number over all designs", Cells::Numbers, &head, &spreads))];
    parts.extend(against_keys(plan, rows).map(|course| ("Sensitivity by key", course.element())));
    parts.extend(distribution(plan, rows).map(|distribution| ("Sensitivity", distribution.element())));
    parts.extend(summary.indices.iter().map(|indices| ("Where its spread comes from", figure(name, indices).element())));
    parts.push(provenance("sweep", &files, &[]));
    charts::page(&format!("{name}: {} designs", summary.designs), &lead, &sections(&parts))
}

/// The share of the designs whose sensitivity is below a number.
fn distribution<'a>(plan: &Plan, rows: &[Row]) -> Option<Figure<'a>> {
    let place = plan.names().iter().position(|name| *name == TOTAL)?;
    let mut all: Vec<f64> = rows.iter().filter_map(|row| row.outputs[place]).collect();
    all.sort_by(f64::total_cmp);
    let last = all.len().checked_sub(1)?;
    let drawn = all.len().min(DRAWN);
    let at = |n: usize| if drawn > 1 { n * last / (drawn - 1) } else { 0 };
    let points = (0..drawn).map(|n| (all[at(n)], (at(n) + 1) as f64 / all.len() as f64)).collect();
    Some(Figure {
        id: "distribution",
        title: "Distribution of the sensitivity".into(),
        description: "Share of the designs whose steady-ramp sensitivity is below a number.".into(),
        caption: format!("Of {} designs.", all.len()),
        columns: 1,
        panels: vec![Panel::lines(
            Axis::round("sensitivity [(°/h)/(°C/min)]", 1e-6),
            Axis::round("share of the designs below", 0.1).covering([0.0, 1.0]),
            14.0,
            vec![Series::new("", Style::First, points)],
        )],
    })
}
