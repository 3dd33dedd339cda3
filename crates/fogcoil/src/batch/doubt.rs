//! Units whose verdict is not sure, judged beside the others of the batch.

use diagnosis::SURE;
use recording::statistics::{median, robust_sd};

use super::lot::FEWEST;
use super::row::Row;
use super::run::Batch;

/// Robust standard deviations below the others from which doubt marks one of many (B. Iglewicz and D. C. Hoaglin, *How to Detect and Handle Outliers*, 1993).
const FAR: f64 = 3.5;

/// The units whose verdict has a probability below [`SURE`].
pub(super) struct Doubt {
    /// Probability below which a unit is marked.
    below: f64,
    doubtful: usize,
    judged: usize,
    /// Median of all, where most are doubtful: then doubt singles nobody out.
    usual: Option<f64>,
}

impl Doubt {
    pub(super) fn of(batch: &Batch) -> Self {
        let all: Vec<f64> = batch.units().into_iter().filter_map(probability).collect();
        let doubtful = all.iter().filter(|p| **p < SURE).count();
        let usual = median(all.clone()).filter(|_| all.len() >= FEWEST && 2 * doubtful > all.len());
        let far = |usual: f64| robust_sd(all.iter().copied(), usual).map_or(0.0, |scale| usual - FAR * scale);
        Self { below: usual.map_or(SURE, |usual| far(usual).min(SURE)), doubtful, judged: all.len(), usual }
    }

    /// The verdict of a unit, with a question mark where it is not sure; where most are not, only far below the others, or below another verdict.
    pub(super) fn shown(&self, row: &Row) -> Option<String> {
        // the others' small faults, which tolerances hide, say nothing of what nothing explains
        let below = if row.verdict.as_deref() == Some("unknown") { SURE } else { self.below };
        let mark = if row.rival.is_some() || row.is_pressed() || probability(row).is_some_and(|p| p < below) { "?" } else { "" };
        row.verdict.as_ref().map(|verdict| format!("{verdict}{mark}"))
    }

    /// In a sentence, if there is any.
    pub(super) fn said(&self) -> Option<String> {
        let Self { doubtful, judged, .. } = self;
        match self.usual {
            _ if *doubtful == 0 => None,
            Some(usual) => Some(format!(
                "the verdict's probability is below {SURE} in {doubtful} of {judged} units, {usual:.2} in the middle: a fault as small as the tolerances may hide in \
                 any of them; ? marks those far below the others, less likely than another verdict, or less than twice as likely as a mechanism (column verdict_probability)"
            )),
            None => Some(format!(
                "a verdict with a ? has a probability below {SURE} ({doubtful} of {judged} units): a small fault may hide there (column verdict_probability)"
            )),
        }
    }
}

fn probability(row: &Row) -> Option<f64> {
    row.number("verdict_probability").filter(|_| row.verdict.is_some())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::batch::limits::Judged;
    use serde_json::json;

    fn batch(probabilities: &[f64]) -> Batch {
        let row = |(n, p): (usize, &f64)| {
            let verdicts = json!({"none": 0.0, "recalibrate": p, "explained": 1.0 - p, "unknown": 0.0});
            (
                Row::of(&json!({"unit": format!("U{n}"), "diagnosis": {"verdict": "recalibrate", "verdicts": verdicts}})),
                Judged::Passes,
            )
        };
        Batch { rows: probabilities.iter().enumerate().map(row).collect() }
    }

    fn marked(batch: &Batch) -> Vec<&str> {
        let doubt = Doubt::of(batch);
        let doubtful = batch.units().into_iter().filter(|row| doubt.shown(row).is_some_and(|shown| shown.ends_with('?')));
        doubtful.map(|row| row.unit.as_str()).collect()
    }

    /// Where most are doubtful, one that nothing explains is marked all the same.
    #[test]
    fn an_unknown_that_is_not_sure_is_marked_beside_others_that_are_not() {
        let mut batch = batch(&[0.52, 0.6, 0.58, 0.55, 0.56, 0.57]);
        assert!(marked(&batch).is_empty());
        batch.rows[5].0.verdict = Some("unknown".into());
        assert_eq!(marked(&batch), ["U5"]);
    }

    #[test]
    fn the_one_that_is_not_sure_is_marked() {
        let batch = batch(&[0.9, 0.95, 0.7, 0.99, 0.92, 0.91]);
        assert_eq!(marked(&batch), ["U2"]);
        assert!(
            Doubt::of(&batch).said().unwrap().contains("below 0.8 (1 of 6 units): a small fault"),
            "{:?}",
            Doubt::of(&batch).said()
        );
    }

    #[test]
    fn doubt_of_all_singles_nobody_out_but_those_far_below() {
        let all = [0.55, 0.6, 0.62, 0.58, 0.64, 0.5, 0.57, 0.61];
        assert!(marked(&batch(&all)).is_empty());
        let said = Doubt::of(&batch(&all)).said().unwrap();
        assert!(said.contains("below 0.8 in 8 of 8 units, 0.59 in the middle"), "{said}");
        let one = [&all[..], &[0.2]].concat();
        assert_eq!(marked(&batch(&one)), ["U8"]);
        // one of which the opposite is likelier
        let one = [&all[..], &[0.49]].concat();
        assert_eq!(marked(&batch(&one)), ["U8"]);
        // of few units nothing is usual
        assert_eq!(marked(&batch(&all[..3])), ["U0", "U1", "U2"]);
        assert_eq!(Doubt::of(&batch(&[0.9; 6])).said(), None);
    }
}
