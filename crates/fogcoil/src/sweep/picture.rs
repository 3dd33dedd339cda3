//! A sweep as a picture.

use charts::{Axis, Figure, Panel, Series, Style};

use super::course::against_keys;
use super::indices::{Index, Indices, WithInterval};
use super::plan::Plan;
use super::row::Row;
use super::statistics::Summary;

/// A kind of index: its name, the style of its lines, its number.
type Shown = (&'static str, u8, fn(&Index) -> WithInterval);

/// The picture of a sweep, a document of its own: every group's Sobol' indices with their intervals; of a plan without indices the sensitivity against its
/// keys. `None` where there is neither.
pub fn svg(plan: &Plan, summary: &Summary, rows: &[Row]) -> Option<String> {
    match &summary.indices {
        Some(indices) => Some(figure(&plan.variants.case.name, indices).document()),
        None => against_keys(plan, rows).map(|course| course.document()),
    }
}

pub(super) fn figure<'a>(name: &str, indices: &Indices) -> Figure<'a> {
    let names: Vec<String> = indices.all.iter().rev().map(|index| index.group.name().to_owned()).collect();
    let place = |n: usize, kind: usize| (indices.all.len() - 1 - n) as f64 + [0.12, -0.12][kind];
    let kinds: [Shown; 2] =
        [("alone (first order)", 2, |index| index.first), ("with all others (total)", 0, |index| index.total)];
    let mut series = Vec::new();
    for (kind, (_, line, of)) in kinds.iter().enumerate() {
        for (n, index) in indices.all.iter().enumerate() {
            let ends = of(index).1.map(|end| (end, place(n, kind)));
            series.push(Series::new("", Style::Fine(*line), ends.to_vec()));
        }
    }
    for (kind, (legend, _, of)) in kinds.iter().enumerate() {
        let points = indices.all.iter().enumerate().map(|(n, index)| (of(index).0, place(n, kind))).collect();
        series.push(Series::new(*legend, Style::Points(kind as u8), points));
    }
    let high = 3.0 * indices.all.len() as f64;
    Figure {
        id: "sobol-indices",
        title: format!("Where the spread of |S| of {name} comes from"),
        description:
            "First-order and total Sobol' index of |S| for every part of the design, each a mark with its 90 % interval.".into(),
        caption: format!(
            "Shares of the variance of |S|, from {} pairs of points; lines: 90 % intervals by bootstrap.",
            indices.pairs
        ),
        columns: 1,
        panels: vec![Panel::lines(
            Axis::round("share of the variance of |S|", 0.1).covering([0.0, 1.0]),
            Axis::named("part of the design", names),
            high,
            series,
        )],
    }
}
