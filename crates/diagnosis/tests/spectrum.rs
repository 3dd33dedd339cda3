//! Coherence of a residual with the state, of series whose coherence is known.

use crate::common::lines::Lines;
use crate::common::normal;
use diagnosis::{Hypothesis, Observation, Spectrum, State, fitted};

const ROWS: usize = 2000;

/// A white series.
fn white(seed: u64) -> Vec<f64> {
    let mut normal = normal(seed);
    (0..ROWS).map(|_| normal()).collect()
}

/// Instants at even steps, or where every third step is twice as long.
fn instants(even: bool) -> Vec<f64> {
    (0..ROWS).map(|n| 30.0 * (n + if even { 0 } else { n / 3 }) as f64).collect()
}

/// Coherence of `y` with the state.
fn spectra(state: &State, y: &[f64], time: Vec<f64>) -> Vec<Spectrum> {
    let lines = Lines::new(ROWS).in_state(state.clone());
    let observed = Observation { time, channels: vec![y.to_vec()] };
    let fit = fitted(&lines, &[0], std::slice::from_ref(&observed), &[Hypothesis::NOMINAL]).expect("a fit");
    fit.in_frequency(&lines, (0, 0), 0, &observed)
}

/// Values of one of the three coherences.
fn of(spectra: &[Spectrum], k: usize) -> Vec<f64> {
    spectra.iter().map(|s| s.coherence[k]).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn a_late_copy_is_coherent_and_other_noise_is_not() {
    let state = State { level: white(1), rate: white(2) };
    let late: Vec<f64> = (0..ROWS).map(|k| 3.0 * state.level[k.saturating_sub(2)]).collect();
    let later = spectra(&state, &late, instants(true).iter().map(|t| t + 1e6).collect());
    let spectra = spectra(&state, &late, instants(true));
    // from two cycles in a segment of 400 rows to half of what its rows resolve
    let span = 399.0 * 30.0;
    let ends = [spectra.first().expect("a spectrum").frequency, spectra.last().expect("a spectrum").frequency];
    assert!((ends[0] * span - 2.0).abs() < 1e-9 && (ends[1] * span - 100.0).abs() < 1e-9, "{ends:?}");
    // wherever the clock starts
    for (s, later) in spectra.iter().zip(&later) {
        assert!((later.frequency / s.frequency - 1.0).abs() < 1e-9 && (later.coherence[0] - s.coherence[0]).abs() < 1e-6);
    }
    assert!(of(&spectra, 0).iter().all(|c| (0.95..=1.0 + 1e-12).contains(c)), "{spectra:?}");
    // noise of nine segments, half overlapping: a ninth and little more, and above the threshold once in twenty
    for k in [1, 2] {
        let others = of(&spectra, k);
        assert!((0.06..0.2).contains(&mean(&others)), "{others:?}");
    }
}

#[test]
fn a_residual_like_the_change_of_the_rate_is_coherent_with_that() {
    let state = State { level: white(3), rate: white(4) };
    let time = instants(false);
    let by_time = |(pair, t): (&[f64], &[f64])| (pair[1] - pair[0]) / (t[1] - t[0]);
    let changes: Vec<f64> = std::iter::once(0.0).chain(state.rate.windows(2).zip(time.windows(2)).map(by_time)).collect();
    let spectra = spectra(&state, &changes, time);
    assert!(of(&spectra, 2).iter().all(|c| (0.99..=1.0 + 1e-12).contains(c)), "{spectra:?}");
    assert!(mean(&of(&spectra, 0)) < 0.2, "{spectra:?}");
}

#[test]
fn what_stands_still_is_coherent_with_nothing() {
    let state = State { level: vec![25.0; ROWS], rate: white(6) };
    let spectra = spectra(&state, &white(7), instants(true));
    assert!(of(&spectra, 0).iter().all(|c| *c == 0.0) && of(&spectra, 1).iter().all(|c| *c > 0.0), "{spectra:?}");
}

#[test]
fn noise_exceeds_the_threshold_once_in_twenty() {
    let mut above = Vec::new();
    for seed in 0..24 {
        let state = State { level: white(100 + 3 * seed), rate: white(101 + 3 * seed) };
        for s in spectra(&state, &white(102 + 3 * seed), instants(true)) {
            above.extend([s.coherence[0], s.coherence[1]].map(|c| f64::from(u8::from(c > s.threshold))));
        }
    }
    let share = mean(&above);
    assert!((0.03..0.08).contains(&share), "{share} of {}", above.len());
}

#[test]
fn a_short_record_has_no_spectrum() {
    // a segment is a fifth of a record, and has 64 rows or more
    for (rows, frequencies) in [(300, 0), (319, 0), (320, diagnosis::FREQUENCIES)] {
        let lines = Lines::new(rows);
        let observed = lines.observed(&white(5)[..rows]);
        let fit = fitted(&lines, &[0], std::slice::from_ref(&observed), &[Hypothesis::NOMINAL]).expect("a fit");
        assert_eq!(fit.in_frequency(&lines, (0, 0), 0, &observed).len(), frequencies, "{rows}");
    }
}
