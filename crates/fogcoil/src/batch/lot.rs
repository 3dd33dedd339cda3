//! Mean and spread of the units of a batch, and the units that stand out.

use std::collections::BTreeMap;

use recording::statistics::{median, normal_quantile, robust_sd};

use super::row::{NUMBERS, Row};
use super::run::Batch;

/// A constant of the design over all units whose difference from it is explained by constants.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Common {
    /// Its name.
    pub(super) name: String,
    /// Mean distance from the design, in standard deviations of its tolerance.
    pub(super) mean: f64,
    /// Standard deviation of units about that mean.
    pub(super) sd: f64,
    /// Number of units.
    pub(super) units: usize,
}

/// A number of a unit that is far from those of the others.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Outlier<'a> {
    pub(super) unit: &'a str,
    pub(super) number: &'static str,
    pub(super) value: f64,
    pub(super) median: f64,
    /// Distance from the median in 1.4826 median absolute deviations, a standard deviation where all is normal, with the number's own uncertainty.
    pub(super) distance: f64,
}

impl Outlier<'_> {
    /// Words behind a median that is one of sizes.
    pub(super) fn of_sizes(&self) -> &'static str {
        if self.number == SIGNLESS { " of sizes" } else { "" }
    }
}

/// The number of which the sign says nothing: which way a peak points, the noise may decide.
const SIGNLESS: &str = "peak";
/// Distance from which a number stands out (B. Iglewicz and D. C. Hoaglin, *How to Detect and Handle Outliers*, 1993).
pub(super) const FAR: f64 = 3.5;
/// Distance from the design, in standard deviations of its tolerance, from which a constant is worth a line.
const WORTH: f64 = 0.5;
/// Fewest units that show a common deviation, and the usual range.
pub(super) const FEWEST: usize = 5;

impl Common {
    /// The constant in words.
    pub(super) fn said(&self) -> String {
        let Self { name, mean, sd, units } = self;
        let side = if *mean < 0.0 { "below" } else { "above" };
        format!(
            "{name} lies {:.2} tolerances (1 sd) {side} the design on average over {units} units; spread between units {sd:.2}",
            mean.abs()
        )
    }
}

/// The units lot by lot, each under its name; all together, under none, where they are of one.
pub(super) fn lots(batch: &Batch) -> Vec<(Option<&str>, Vec<&Row>)> {
    let mut lots: BTreeMap<Option<&str>, Vec<&Row>> = BTreeMap::new();
    for row in batch.units() {
        lots.entry(row.lot.as_deref()).or_default().push(row);
    }
    if lots.len() < 2 {
        vec![(None, batch.units())]
    } else {
        lots.into_iter().map(|(lot, rows)| (lot.or(Some("none")), rows)).collect()
    }
}

/// Units whose records the design suffices for.
pub(super) fn within_tolerances<'b>(units: &[&'b Row]) -> Vec<&'b Row> {
    units.iter().copied().filter(|row| matches!(row.verdict.as_deref(), Some("none" | "recalibrate"))).collect()
}

/// Constants whose mean is farther from the design than is worth a line, and than twice its own uncertainty, the farthest first.
pub(super) fn common(units: &[&Row]) -> Vec<Common> {
    let ordinary = within_tolerances(units);
    let Some(first) = ordinary.first().filter(|_| ordinary.len() >= FEWEST) else { return Vec::new() };
    let of = |name: &str| {
        let all: Vec<f64> =
            ordinary.iter().filter_map(|row| row.constants.iter().find(|c| c.name == name).map(|c| c.sigmas)).collect();
        let count = all.len() as f64;
        let mean = all.iter().sum::<f64>() / count;
        let sd = (all.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (count - 1.0)).sqrt();
        (mean.abs() > WORTH.max(2.0 * sd / count.sqrt())).then(|| Common { name: name.to_owned(), mean, sd, units: all.len() })
    };
    let mut all: Vec<Common> = first.constants.iter().filter_map(|constant| of(&constant.name)).collect();
    all.sort_by(|a, b| b.mean.abs().total_cmp(&a.mean.abs()));
    all
}

/// Numbers that stand out, the farthest first.
pub(super) fn outliers(batch: &Batch) -> Vec<Outlier<'_>> {
    let mut all = Vec::new();
    // half of a 90 % interval of a normal number in its standard deviations
    let half = normal_quantile(0.95);
    for number in NUMBERS.iter().filter(|number| !number.ends_with("probability")) {
        let size = |value: f64| if *number == SIGNLESS { value.abs() } else { value };
        let known: Vec<(&Row, f64)> = batch.rows.iter().filter_map(|(row, _)| Some((row, size(row.number(number)?)))).collect();
        for (row, value) in &known {
            let peers: Vec<f64> =
                known.iter().filter(|(other, _)| row.compares(number, other)).map(|(_, value)| *value).collect();
            if peers.len() < FEWEST {
                continue;
            }
            let Some(middle) = median(peers.clone()) else { continue };
            let Some(scale) = robust_sd(peers.into_iter(), middle) else { continue };
            // what is poorly known is not far because of that
            let own = row.interval(number).map_or(0.0, |[low, high]| (high - low) / (2.0 * half));
            let distance = (value - middle) / scale.hypot(own);
            // to leave less than the others is nothing that stands out
            let is_good = number.starts_with("residual") && distance < 0.0;
            if scale > 0.0 && distance.abs() > FAR && !is_good {
                all.push(Outlier {
                    unit: &row.unit,
                    number,
                    value: row.number(number).unwrap_or(*value),
                    median: middle,
                    distance,
                });
            }
        }
    }
    all.sort_by(|a, b| b.distance.abs().total_cmp(&a.distance.abs()));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::limits::Judged;
    use serde_json::json;

    fn batch(values: &[f64]) -> Batch {
        let row = |(n, value): (usize, &f64)| {
            Row::of(&json!({
                "unit": format!("U{n}"),
                "measured": {"sensitivity": {"value": value, "ci90": [value, value]}},
                "diagnosis": {"verdict": "recalibrate", "unknowns": [
                    {"name": "shared", "kind": "design", "sigmas": 1.0 + 0.1 * (n % 3) as f64},
                    {"name": "own", "kind": "design", "sigmas": if n % 2 == 0 { 1.0 } else { -1.0 }},
                ]},
            }))
        };
        Batch { rows: values.iter().enumerate().map(|n| (row(n), Judged::Unjudged)).collect() }
    }

    #[test]
    fn what_is_shared_is_told_and_what_is_far_stands_out() {
        let batch = batch(&[-2.70, -2.72, -2.71, -2.69, -1.0, -2.70]);
        let found = common(&batch.units());
        assert!(found.len() == 1 && found[0].name == "shared" && (found[0].mean - 1.1).abs() < 1e-12, "{found:?}");
        let far = outliers(&batch);
        assert_eq!((far.len(), far[0].unit, far[0].number, far[0].median), (1, "U4", "sensitivity", -2.70));
        assert!(
            (outliers(&super::tests::batch(&[1.0; 6])).len(), common(&super::tests::batch(&[1.0; 2]).units()).len()) == (0, 0)
        );
    }

    #[test]
    fn a_peak_that_points_the_other_way_is_no_outlier() {
        let peaks = [0.31, 0.33, -0.32, 0.30, 0.31, -0.33, 0.9];
        let row = |(n, value): (usize, &f64)| {
            let measured = json!({"peak": {"value": value, "ci90": [value - 0.01, value + 0.01]}});
            (Row::of(&json!({"unit": format!("U{n}"), "measured": measured})), Judged::Unjudged)
        };
        let batch = Batch { rows: peaks.iter().enumerate().map(row).collect() };
        let far: Vec<&str> = outliers(&batch).iter().map(|outlier| outlier.unit).collect();
        assert_eq!(far, ["U6"]);
    }

    #[test]
    fn peaks_under_another_programme_are_not_compared() {
        let row = |n: usize, value: f64, length: f64, fastest: f64| {
            let under = json!({"length_s": length, "fastest_c_per_min": fastest});
            let measured = json!({"peak": {"value": value, "ci90": [value - 0.01, value + 0.01]}, "peak_under": under});
            (Row::of(&json!({"unit": format!("U{n}"), "measured": measured})), Judged::Unjudged)
        };
        let usual = |n: usize| row(n, 1.35 + 0.01 * (n % 3) as f64, 54_600.0, 1.0 + 0.01 * (n % 2) as f64);
        let of = |last: (Row, Judged)| {
            let batch = Batch { rows: (0..6).map(usual).chain([last]).collect() };
            outliers(&batch).len()
        };
        // twice as fast, or half as long; only under the same programme it stands out
        assert_eq!(
            [of(row(6, -2.36, 54_600.0, 2.0)), of(row(6, -2.36, 27_000.0, 1.0)), of(row(6, -2.36, 54_600.0, 1.0))],
            [0, 0, 1]
        );
    }

    #[test]
    fn lots_are_told_apart() {
        let mut batch = batch(&[-2.7; 12]);
        assert_eq!(lots(&batch).iter().map(|(lot, rows)| (*lot, rows.len())).collect::<Vec<_>>(), [(None, 12)]);
        for (n, (row, _)) in batch.rows.iter_mut().enumerate() {
            row.lot = Some(format!("L{}", n / 6));
            if n >= 6 {
                row.constants.iter_mut().for_each(|constant| constant.sigmas -= 2.0);
            }
        }
        let all = lots(&batch);
        let said: Vec<(Option<&str>, String)> = all.iter().map(|(lot, rows)| (*lot, common(rows)[0].said())).collect();
        assert_eq!(said[0].0, Some("L0"));
        assert!(said[0].1.starts_with("shared lies 1.10 tolerances (1 sd) above the design on average over 6 units"), "{said:?}");
        assert!(said[1].1.contains("below the design on average"), "{said:?}");
    }
}
