//! A batch as text.

use std::fmt::Write;

use super::lot::{common, outliers};
use super::run::Batch;
use crate::table::{significant, table};

/// A line for each unit, and the units that stand out.
pub fn text(batch: &Batch) -> String {
    let head = ["unit", "sensitivity", "90 %", "residual/noise", "verdict", "judged", "what"].map(str::to_owned).to_vec();
    let rows = batch.rows.iter().map(|(row, judged)| {
        let shown = |value: Option<f64>, digits| value.map_or("-".to_owned(), |value| significant(value, digits));
        let interval =
            row.interval("sensitivity").map(|[low, high]| format!("{} to {}", significant(low, 3), significant(high, 3)));
        let reasons = judged.reasons().or_else(|| row.problem.clone());
        vec![
            row.unit.clone(),
            shown(row.number("sensitivity"), 4),
            interval.unwrap_or_default(),
            shown(row.number("residual_over_noise"), 3),
            row.verdict.clone().unwrap_or_else(|| "-".into()),
            judged.word().to_owned(),
            [Some(row.set.join(", ")).filter(|set| !set.is_empty()), reasons]
                .into_iter()
                .flatten()
                .collect::<Vec<_>>()
                .join("; "),
        ]
    });
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    let mut out = table(&rows);
    for outlier in outliers(batch) {
        let _ = writeln!(
            out,
            "{}: {} is {}, far from the median {} ({:+.1} robust standard deviations)",
            outlier.unit,
            outlier.number,
            significant(outlier.value, 4),
            significant(outlier.median, 4),
            outlier.distance
        );
    }
    for shared in common(batch) {
        let _ = writeln!(
            out,
            "in common: {} is {:+.2} standard deviations of its tolerance from the design, in {} units that differ by {:.2}",
            shared.name, shared.mean, shared.units, shared.sd
        );
    }
    out
}
