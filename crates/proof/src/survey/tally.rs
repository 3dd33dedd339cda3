//! Stated errors against true ones, counted.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::statistics::{middle, rate};

/// Share of errors that must be covered.
const COVERED: f64 = 0.99;

/// A quantity's stated error and its true one, in one unit.
#[derive(Debug, Clone, Copy)]
pub(super) struct Compared {
    pub(super) quantity: &'static str,
    pub(super) stated: f64,
    pub(super) error: f64,
}

impl Compared {
    /// Stated over true; above 1 where the error is covered.
    pub(super) fn ratio(&self) -> f64 {
        if self.error == 0.0 && self.stated >= 0.0 { f64::INFINITY } else { self.stated / self.error }
    }
}

/// Outcome of a draw.
#[derive(Debug)]
pub(super) enum Drawn {
    /// The program refuses it: its own check of the error, or a bound that is crossed.
    Refused,
    /// It answers; finer solutions scatter more than the error that it states.
    Undecided,
    /// It answers.
    Compared {
        /// The draw in a few words.
        what: String,
        rows: Vec<Compared>,
    },
}

/// A table of all subjects; whether each quantity is covered in 99 of 100 draws.
pub(super) fn table(subjects: &[(&'static str, Vec<Drawn>)]) -> (String, bool) {
    let mut text = String::from(
        "\n| random | drawn, of them refused, undecided | quantity | errors covered [90 % interval] | least ratio, stated over true | median ratio |\n\
         |---|---|---|---|---|---|\n",
    );
    let mut covered = true;
    for (subject, drawn) in subjects {
        let refused = drawn.iter().filter(|drawn| matches!(drawn, Drawn::Refused)).count();
        let undecided = drawn.iter().filter(|drawn| matches!(drawn, Drawn::Undecided)).count();
        let mut ratios: BTreeMap<&str, Vec<f64>> = BTreeMap::new();
        for drawn in drawn {
            let Drawn::Compared { rows, .. } = drawn else { continue };
            rows.iter().for_each(|row| ratios.entry(row.quantity).or_default().push(row.ratio()));
        }
        for (quantity, ratios) in ratios {
            let within = ratios.iter().filter(|ratio| **ratio >= 1.0).count();
            let Some(share) = rate(within, ratios.len()) else { continue };
            covered &= share.value >= COVERED;
            let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
            let [low, high] = share.interval.map(|end| 100.0 * end);
            let _ = writeln!(
                text,
                "| {subject} | {}, {refused}, {undecided} | {quantity} | {within} of {} [{low:.1} to {high:.1} %] | {least:.2} | {:.1} |",
                drawn.len(),
                ratios.len(),
                middle(ratios.clone()),
            );
        }
    }
    (text, covered)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(stated: f64, error: f64) -> Drawn {
        Drawn::Compared { what: String::new(), rows: vec![Compared { quantity: "x", stated, error }] }
    }

    #[test]
    fn an_error_above_what_is_stated_is_counted_and_fails() {
        let (text, covered) = table(&[("thing", vec![of(2.0, 1.0), of(0.5, 1.0), Drawn::Refused, Drawn::Undecided])]);
        assert!(!covered);
        assert!(text.contains("| thing | 4, 1, 1 | x | 1 of 2 ["), "{text}");
        assert!(text.contains("| 0.50 |"), "{text}");
        assert!(table(&[("thing", vec![of(2.0, 1.0), of(0.0, 0.0)])]).1);
        assert!(!table(&[("thing", vec![of(f64::NAN, 1.0)])]).1);
    }
}
