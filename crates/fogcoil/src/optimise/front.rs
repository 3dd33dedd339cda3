//! The Pareto front: designs of which none is better in everything.

use super::evaluate::Tried;
use super::measure::Measure;

/// Whether `a` is nowhere worse than `b`, and somewhere better.
fn dominates(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| a <= b) && a.iter().zip(b).any(|(a, b)| a < b)
}

/// Places of the designs that keep the limits and that no other one dominates, the least of the first measure first; of equal ones the first.
pub fn front(all: &[Tried], minimise: &[Measure]) -> Vec<usize> {
    let values = |tried: &Tried| minimise.iter().map(|measure| measure.of(&tried.measures)).collect::<Vec<f64>>();
    let mut sound: Vec<(usize, Vec<f64>)> =
        all.iter().enumerate().filter(|(_, tried)| tried.violation == 0.0).map(|(n, tried)| (n, values(tried))).collect();
    sound.sort_by(|(n, a), (m, b)| a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne()).unwrap_or(n.cmp(m)));
    // in this order a design is dominated by one before it, or by none
    let mut best: Vec<(usize, Vec<f64>)> = Vec::new();
    for (n, own) in sound {
        if !best.iter().any(|(_, other)| dominates(other, &own) || *other == own) {
            best.push((n, own));
        }
    }
    best.into_iter().map(|(n, _)| n).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optimise::measure::Measures;

    fn tried(sensitivity: f64, spread: f64, violation: f64) -> Tried {
        let measures = Measures { sensitivity, spread, mass: 1.0, length: 1.0 };
        Tried { point: Vec::new(), values: Vec::new(), measures, violation }
    }

    #[test]
    fn only_what_nothing_beats_is_on_the_front() {
        let all = [
            tried(-1.0, 0.2, 0.0),
            tried(0.5, 0.5, 0.0),
            tried(0.6, 0.5, 0.0), // worse than the second
            tried(0.1, 0.1, 0.3), // not sound
            tried(2.0, 0.1, 0.0),
            tried(1.0, 0.2, 0.0), // the first again
        ];
        let both = [Measure::Sensitivity, Measure::Spread];
        assert_eq!(front(&all, &both), [1, 0, 4]);
        assert_eq!(front(&all, &[Measure::Spread]), [4]);
        assert_eq!(front(&all[3..4], &both), [0; 0]);
    }
}
