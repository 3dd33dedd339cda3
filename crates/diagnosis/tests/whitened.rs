//! Whitened residuals, in white noise: numbers of the noise's own size, and stretches of them.

use crate::common::lines::{Lines, WHITE};
use crate::common::normal;
use diagnosis::{Fit, Hypothesis, Observation, fitted};

/// A record of noise with the fit of nothing to it.
fn noise(rows: usize) -> (Observation, Fit) {
    let lines = Lines::new(rows);
    let mut normal = normal(7);
    let observed = lines.observed(&(0..rows).map(|_| WHITE * normal()).collect::<Vec<_>>());
    let fit = fitted(&lines, &[0], std::slice::from_ref(&observed), &[Hypothesis::NOMINAL]).expect("a fit");
    (observed, fit)
}

#[test]
fn a_residual_in_white_noise_is_whitened_to_its_size_in_noise_where_there_is_one() {
    let (mut observed, fit) = noise(50);
    let residual: Vec<f64> = (0..50).map(|n| 0.1 * f64::from(n) - 2.0).collect();
    observed.channels[0][17] = f64::NAN;
    let whitened = fit.whiten(0, &observed, &residual);
    let known: Vec<f64> = residual.iter().enumerate().filter(|(row, _)| *row != 17).map(|(_, r)| r / WHITE).collect();
    assert_eq!(whitened.len(), known.len());
    assert!(whitened.iter().zip(&known).all(|(w, k)| (w - k).abs() < 1e-3), "{whitened:?}");
    // instants that go back are no series
    observed.time.reverse();
    assert!(fit.whiten(0, &observed, &residual).is_empty());
}

#[test]
fn a_record_has_a_stretch_for_every_twenty_rows_and_two_dozen_at_most() {
    for (rows, stretches) in [(10, 1), (100, 5), (470, 23), (1000, 24)] {
        let (observed, fit) = noise(rows);
        let blocks = fit.in_time(0, 0, &observed, &fit);
        assert_eq!(blocks.len(), stretches, "{rows}");
        // one after another from the first instant to the last
        let ends = [blocks[0].time[0], blocks[stretches - 1].time[1]];
        assert!(ends[0] == observed.time[0] && (ends[1] - observed.time[rows - 1]).abs() < 1e-9, "{ends:?}");
        assert!(blocks.windows(2).all(|pair| pair[0].time[1] == pair[1].time[0]));
    }
}
