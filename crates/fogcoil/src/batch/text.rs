//! A batch as text.

use std::fmt::Write;

use super::doubt::Doubt;
use super::lot::{common, lots, outliers};
use super::row::unit_of;
use super::run::Batch;
use super::serials::{copied, repeated};
use crate::table::{significant, table};

/// A line for each unit, and the units that stand out.
pub fn text(batch: &Batch) -> String {
    let head = ["unit", "sensitivity", "90 %", "residual/noise", "verdict", "judged", "what"].map(str::to_owned).to_vec();
    let doubt = Doubt::of(batch);
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
            doubt.shown(row).unwrap_or_else(|| "-".into()),
            judged.word().to_owned(),
            [
                row.told_besides(),
                Some(row.open()).filter(|open| !(open.is_empty() || reasons.as_ref().is_some_and(|told| told.contains(open)))),
                reasons.clone(),
            ]
            .into_iter()
            .flatten()
            .collect::<Vec<_>>()
            .join("; "),
        ]
    });
    let rows: Vec<Vec<String>> = std::iter::once(head).chain(rows).collect();
    let mut out = table(&rows);
    out.push_str(LEFT);
    out.push_str(&judged(batch));
    if let Some(said) = doubt.said() {
        let _ = writeln!(out, "{said}");
    }
    for (serial, units) in repeated(&batch.units()) {
        let _ = writeln!(out, "note: {} units have the serial number {serial}: {}", units.len(), units.join(", "));
    }
    for units in copied(&batch.units()) {
        let _ = writeln!(out, "warning: {} have a recording in common, byte for byte: is one of them a copy?", units.join(", "));
    }
    for outlier in outliers(batch) {
        let unit = unit_of(outlier.number);
        let _ = writeln!(
            out,
            "{}: {} is {}{unit}, far from the median {}{unit}{} ({:+.1} robust standard deviations)",
            outlier.unit,
            outlier.number,
            significant(outlier.value, 4),
            significant(outlier.median, 4),
            outlier.of_sizes(),
            outlier.distance
        );
    }
    for (lot, units) in lots(batch) {
        let place = lot.map_or(String::new(), |lot| format!(" in lot {lot}"));
        for shared in common(&units) {
            let _ = writeln!(out, "in common{place}: {}", shared.said());
        }
    }
    out
}

/// Meaning of the residual over the noise.
const LEFT: &str = "(residual/noise: rms that the best explanation leaves of the rate, over the white noise of a row, from neighbours' differences, 1 sd;\n \
     drift of the gyroscope counts as residual)\n";

/// Numbers of units by judgement; empty where there are no limits.
fn judged(batch: &Batch) -> String {
    let count = |word: &str| batch.rows.iter().filter(|(_, judged)| judged.word() == word).count();
    let [passing, failing, not_known] = ["pass", "fail", "not known"].map(count);
    match (passing + failing + not_known, not_known) {
        (0, _) => String::new(),
        (all, 0) => format!("{passing} of {all} units pass, {failing} fail{}\n", named(batch, "fail")),
        (all, _) => format!(
            "{passing} of {all} units pass, {failing} fail{}; of {not_known} it is not known{} ({NOT_PASSED})\n",
            named(batch, "fail"),
            named(batch, "not known")
        ),
    }
}

/// Reasons why a unit that breaks no limit has not passed.
pub(super) const NOT_PASSED: &str = "a figure is missing or too uncertain, a verdict less probable than its limit, or a held-out record not predicted, so they have not passed";

/// The first units that are judged so, in brackets.
pub(super) fn named(batch: &Batch, word: &str) -> String {
    /// Most units that a sentence names.
    const MOST: usize = 8;
    let of = batch.rows.iter().filter(|(_, judged)| judged.word() == word).map(|(row, _)| row.unit.as_str());
    let all: Vec<&str> = of.collect();
    let further = if all.len() > MOST { format!(" and {} more", all.len() - MOST) } else { String::new() };
    if all.is_empty() { String::new() } else { format!(" ({}{further})", all[..all.len().min(MOST)].join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::limits::Judged;
    use crate::batch::row::Row;
    use serde_json::json;

    fn batch(judged: &[Judged]) -> Batch {
        let row = |(n, judged): (usize, &Judged)| {
            let verdicts = json!({"none": 0.0, "recalibrate": 0.6, "explained": 0.4, "unknown": 0.0});
            let sensitivity = if n == 0 { -1.0 } else { -2.7 - 0.01 * n as f64 };
            let mut row = Row::of(&json!({
                "unit": format!("U{n}"), "serial": "7", "sha256": [format!("{}", n / 2), "other"[n..n + 1].to_owned()],
                "measured": {"cooling": {"value": sensitivity, "ci90": [sensitivity, sensitivity]}},
                "diagnosis": {"verdict": "recalibrate", "verdicts": verdicts},
            }));
            row.lot = Some(format!("L{}", n / 4));
            (row, judged.clone())
        };
        Batch { rows: judged.iter().enumerate().map(row).collect() }
    }

    #[test]
    fn doubt_and_what_is_not_known_are_said() {
        let reasons = || vec!["sensitivity is not known".to_owned()];
        let mut batch =
            batch(&[Judged::Passes, Judged::Fails(reasons()), Judged::NotKnown(reasons()), Judged::Passes, Judged::Passes]);
        batch.rows[3].0.warnings.push("gap".to_owned());
        let text = text(&batch);
        assert!(text.lines().any(|line| line.ends_with("pass  warned of gap")), "{text}");
        for part in [
            "the verdict's probability is below 0.8 in 5 of 5 units, 0.60 in the middle",
            "3 of 5 units pass, 1 fail (U1); of 1 it is not known (U2) (a figure is missing",
            "note: 5 units have the serial number 7: U0, U1, U2, U3, U4",
            "warning: U0, U1 have a recording in common, byte for byte: is one of them a copy?\nwarning: U2, U3 have",
            "U0: cooling is -1.000 (deg/h)/(degC/min), far from the median -2.720 (deg/h)/(degC/min)",
        ] {
            assert!(text.contains(part), "{part}: {text}");
        }
        assert_eq!((batch.failing(), batch.not_known()), (1, 1));
    }
}
