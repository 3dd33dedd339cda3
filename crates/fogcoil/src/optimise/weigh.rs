//! Several numbers as one: the weighted Chebyshev distance from nothing, with a share of the sum so that nothing is given away.

use super::evaluate::Tried;
use super::measure::Measure;

/// Share of the weighted sum (R. E. Steuer and E.-U. Choo, *Math. Program.* 26, 326 (1983)).
const SHARE: f64 = 0.05;
/// Least weight: of nothing that is minimised any amount is as good.
const LEAST: f64 = 0.02;
/// Beyond what any sound design has, in scales of the drawing.
const BEYOND: f64 = 100.0;
/// Steps of the weights where two are weighed, and where more are.
const STEPS: [usize; 2] = [8, 3];

/// Weights that are tried, each with a number for each of `count` measures.
pub(super) fn weighings(count: usize) -> Vec<Vec<f64>> {
    let steps = if count == 2 { STEPS[0] } else { STEPS[1] };
    let mut all = vec![(Vec::new(), steps)];
    for place in 0..count {
        let last = place + 1 == count;
        all = all
            .into_iter()
            .flat_map(|(own, left)| {
                let next = if last { left..=left } else { 0..=left };
                next.map(move |part| ([own.clone(), vec![part]].concat(), left - part))
            })
            .collect();
    }
    let weights = |parts: Vec<usize>| parts.into_iter().map(|part| (part as f64 / steps as f64).max(LEAST)).collect();
    if count == 1 { vec![vec![1.0]] } else { all.into_iter().map(|(parts, _)| weights(parts)).collect() }
}

/// Weighted objective of a design; any design that leaves the limits is worse than any that keeps them.
pub(super) fn weighed(tried: &Tried, minimise: &[Measure], scales: &[f64], weights: &[f64]) -> f64 {
    if tried.violation > 0.0 {
        return BEYOND * (1.0 + tried.violation);
    }
    let parts = || minimise.iter().zip(scales).zip(weights).map(|((m, scale), weight)| weight * m.of(&tried.measures) / scale);
    (parts().fold(0.0, f64::max) + SHARE * parts().sum::<f64>()).min(BEYOND)
}

/// Objective of a point for which there is no design.
pub(super) const NONE: f64 = 10.0 * BEYOND;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::optimise::measure::Measures;

    #[test]
    fn weights_are_of_all_measures_and_the_limits_come_first() {
        assert_eq!((weighings(1).len(), weighings(2).len(), weighings(3).len()), (1, 9, 10));
        assert!(weighings(3).iter().all(|weights| weights.len() == 3 && weights.iter().sum::<f64>() < 1.1));
        let tried = |sensitivity: f64, violation: f64| Tried {
            point: Vec::new(),
            values: Vec::new(),
            measures: Measures { sensitivity, spread: 0.1, mass: 0.1, length: 1.0 },
            violation,
        };
        let of = |tried: &Tried| weighed(tried, &[Measure::Sensitivity, Measure::Spread], &[2.0, 0.2], &[0.5, 0.5]);
        assert!((of(&tried(-1.0, 0.0)) - (0.25 + 0.05 * 0.5)).abs() < 1e-12);
        assert!(
            of(&tried(50.0, 0.0)) < of(&tried(0.0, 1e-9))
                && of(&tried(0.0, 0.5)) < of(&tried(0.0, 0.6))
                && of(&tried(0.0, 5.0)) < NONE
        );
    }
}
