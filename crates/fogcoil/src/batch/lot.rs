//! Mean and spread of the units of a batch, and the units that stand out.

use std::collections::BTreeMap;

use recording::statistics::{median, normal_quantile, robust_sd, student_quantile};

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
/// The number that is in standard deviations already: units do not spread less than by one.
const IN_SIGMAS: &str = "sigmas_from_predicted";
/// Chance that a number of a sound batch stands out, all numbers of all units together, about and at most.
pub(super) const BY_CHANCE: f64 = 0.05;
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

/// The numbers in which a unit may stand out.
fn looked_at() -> impl Iterator<Item = &'static str> {
    NUMBERS.into_iter().filter(|number| !number.ends_with("probability"))
}

/// Distance from which one of `all` values of a number stands out of its `peers`, such that any value of any number does with the chance [`BY_CHANCE`].
///
/// The farthest of n normal values, in 1.4826 median absolute deviations, is distributed about like that of n values of Student's t with 0.4 n degrees of freedom, n
/// rounded up to an odd number: a median absolute deviation is as uncertain as the standard deviation of 0.37 n values (P. J. Huber, *Robust Statistics*, 1981). A
/// test counts how often it is beyond.
fn far(peers: usize, all: usize) -> f64 {
    let chance = BY_CHANCE / (looked_at().count() * all) as f64;
    student_quantile(1.0 - chance / 2.0, 0.4 * (peers | 1) as f64)
}

/// Numbers that stand out, the farthest first.
pub(super) fn outliers(batch: &Batch) -> Vec<Outlier<'_>> {
    let mut all = Vec::new();
    // half of a 90 % interval of a normal number in its standard deviations
    let half = normal_quantile(0.95);
    for number in looked_at() {
        let least = if number == IN_SIGMAS { 1.0 } else { 0.0 };
        let size = |value: f64| if number == SIGNLESS { value.abs() } else { value };
        let known: Vec<(&Row, f64)> = batch.rows.iter().filter_map(|(row, _)| Some((row, size(row.number(number)?)))).collect();
        for (row, value) in &known {
            let peers: Vec<f64> =
                known.iter().filter(|(other, _)| row.compares(number, other)).map(|(_, value)| *value).collect();
            if peers.len() < FEWEST {
                continue;
            }
            let far = far(peers.len(), known.len());
            let Some(middle) = median(peers.clone()) else { continue };
            let Some(scale) = robust_sd(peers.into_iter(), middle) else { continue };
            // what is poorly known is not far because of that
            let own = row.interval(number).map_or(0.0, |[low, high]| (high - low) / (2.0 * half));
            let scale = scale.max(least);
            let distance = (value - middle) / scale.hypot(own);
            // to leave less than the others is nothing that stands out
            let is_good = number.starts_with("residual") && distance < 0.0;
            if scale > 0.0 && distance.abs() > far && !is_good {
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

    /// Standard normal numbers, by Marsaglia's polar method of the numbers of Vigna's splitmix64.
    fn normal() -> impl Iterator<Item = f64> {
        let mut state = 1_u64;
        let mut uniform = move || {
            state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            ((mixed ^ (mixed >> 31)) >> 11) as f64 * 2.0_f64.powi(-52) - 1.0
        };
        std::iter::from_fn(move || {
            let pair = std::iter::repeat_with(|| [uniform(), uniform()]).find(|[x, y]| (1e-300..1.0).contains(&x.hypot(*y)))?;
            let square = pair[0].powi(2) + pair[1].powi(2);
            Some(pair[0] * (-2.0 * square.ln() / square).sqrt())
        })
    }

    #[test]
    fn a_sound_batch_of_any_size_has_an_outlier_by_chance_as_often_as_said() {
        const BATCHES: usize = 40_000;
        let mut numbers = normal();
        for units in [5, 6, 7, 8, 12, 20, 51, 100] {
            let far = far(units, units);
            let mut stands_out = || {
                let values: Vec<f64> = numbers.by_ref().take(units).collect();
                let middle = median(values.clone()).unwrap();
                let scale = robust_sd(values.iter().copied(), middle).unwrap();
                values.iter().any(|value| (value - middle).abs() > far * scale)
            };
            let count = (0..BATCHES).filter(|_| stands_out()).count();
            let chance = (looked_at().count() * count) as f64 / BATCHES as f64;
            // one standard deviation of the count is 8 %
            assert!(chance < 1.2 * BY_CHANCE && chance > 0.4 * BY_CHANCE, "{units} units: {chance}, {far}");
        }
    }

    #[test]
    fn a_number_in_standard_deviations_spreads_by_one_at_least() {
        let of = |values: &[f64]| {
            let row = |(n, value): (usize, &f64)| {
                let measured = json!({"prediction": {"value": -0.48, "sigmas": value}});
                (Row::of(&json!({"unit": format!("U{n}"), "measured": measured})), Judged::Unjudged)
            };
            let batch = Batch { rows: values.iter().enumerate().map(row).collect() };
            outliers(&batch).iter().map(|outlier| (outlier.unit.to_owned(), outlier.distance)).collect::<Vec<_>>()
        };
        // a lot made closer than its tolerances, and units well within them
        let sound = [-0.66, -0.67, -0.65, -0.66, -0.67, -0.65, -1.55, 1.3];
        assert_eq!(of(&sound), []);
        let wrong = [&sound[..7], &[20.0]].concat();
        let found = of(&wrong);
        assert!(found.len() == 1 && found[0].0 == "U7" && (found[0].1 - 20.66).abs() < 0.01, "{found:?}");
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
