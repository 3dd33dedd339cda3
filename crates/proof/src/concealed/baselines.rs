//! Common practice with the same records: regressions on the nominal model's output, and selection by BIC in white noise.

use diagnosis::{Active, ForwardModel, Omission};
use mechanisms::{RATE, SPOOL};
use nalgebra::{DMatrix, DVector};
use recording::condition::slopes;

use super::answer::{Answer, Place, Probable};
use super::chain::{FIT, HOLDOUT, Series, Unit, mean, rms};
use crate::Failure;
use crate::truth::stage;

/// The regressions, each on top of the nominal model and an offset.
pub(crate) const REGRESSIONS: [&str; 4] =
    ["nominal + offset", "+ cubic in T", "+ cubic in T and dT/dt", "+ sparse in T, dT/dt, d2T/dt2 and products"];

/// Highest total degree of the sparse regression's products.
const DEGREE: i32 = 3;
/// Reference temperature \[degC\], and units that keep the numbers near one \[K, K/s, K/s2\].
const REFERENCE: f64 = 20.0;
const UNITS: [f64; 3] = [40.0, 1.0 / 60.0, 1e-5];

/// T, dT/dt, d2T/dt2 of the nominal model's spool in every row of a record.
fn states(unit: &Unit, record: usize) -> Vec<[f64; 3]> {
    let (state, time) = (unit.gyro.state(record), &unit.time[record]);
    let change = slopes(time, &state.rate);
    let at = |n: usize| [(state.level[n] - REFERENCE) / UNITS[0], state.rate[n] / UNITS[1], change[n] / UNITS[2]];
    (0..time.len()).map(at).collect()
}

/// Powers of T, dT/dt and d2T/dt2 in a term.
type Powers = [i32; 3];

fn term(powers: &Powers, state: &[f64; 3]) -> f64 {
    state.iter().zip(powers).map(|(s, p)| s.powi(*p)).product()
}

/// Least squares of `y` on terms, where `y` is not NaN: amplitudes and the sum of squares left. `None` if the terms are dependent.
fn least_squares(terms: &[Powers], states: &[[f64; 3]], y: &[f64]) -> Option<(DVector<f64>, f64)> {
    let rows: Vec<usize> = (0..y.len()).filter(|n| !y[*n].is_nan()).collect();
    let a = DMatrix::from_fn(rows.len(), terms.len(), |i, k| term(&terms[k], &states[rows[i]]));
    let b = DVector::from_iterator(rows.len(), rows.iter().map(|n| y[*n]));
    let x = a.tr_mul(&a).cholesky()?.solve(&a.tr_mul(&b));
    let left = (b - a * &x).norm_squared();
    Some((x, left))
}

/// Terms chosen one by one, each the one that leaves least, as long as BIC falls.
fn sparse(states: &[[f64; 3]], y: &[f64]) -> Vec<Powers> {
    let powers = (0..=DEGREE).flat_map(|a| (0..=DEGREE - a).flat_map(move |b| (0..=DEGREE - a - b).map(move |c| [a, b, c])));
    let mut candidates: Vec<Powers> = powers.filter(|p| *p != [0; 3]).collect();
    let n = y.iter().filter(|v| !v.is_nan()).count() as f64;
    let bic = |left: f64, count: usize| n * (left / n).ln() + count as f64 * n.ln();
    let mut chosen = vec![[0; 3]];
    let mut best = least_squares(&chosen, states, y).map_or(f64::INFINITY, |(_, left)| bic(left, 1));
    while !candidates.is_empty() {
        let with = |p: &Powers| {
            let terms = [chosen.as_slice(), &[*p]].concat();
            least_squares(&terms, states, y).map_or(f64::INFINITY, |(_, left)| left)
        };
        let left: Vec<f64> = candidates.iter().map(with).collect();
        let at = (0..left.len()).min_by(|&a, &b| left[a].total_cmp(&left[b])).unwrap_or(0);
        let new = bic(left[at], chosen.len() + 1);
        if new >= best {
            break;
        }
        best = new;
        chosen.push(candidates.swap_remove(at));
    }
    chosen
}

/// Held-out root mean square of every regression \[deg/h\], in the order of [`REGRESSIONS`].
pub(crate) fn regressions(unit: &Unit) -> Result<[f64; REGRESSIONS.len()], Failure> {
    let [seen, unseen] = [FIT, HOLDOUT].map(|record| states(unit, record));
    let y = unit.residual(FIT, RATE, &[])?;
    let cubic = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]];
    let ramp = [cubic.as_slice(), &[[0, 1, 0]]].concat();
    let held_out = unit.residual(HOLDOUT, RATE, &[])?;
    let of = |terms: &[Powers]| -> Result<f64, Failure> {
        let (x, _) = least_squares(terms, &seen, &y).ok_or_else(|| Failure("a regression's terms are dependent".into()))?;
        let predicted = unseen.iter().map(|s| terms.iter().zip(x.iter()).map(|(t, x)| x * term(t, s)).sum::<f64>());
        Ok(rms(held_out.iter().zip(predicted).map(|(y, p)| y - p)))
    };
    Ok([of(&cubic[..1])?, of(&cubic)?, of(&ramp)?, of(&sparse(&seen, &y))?])
}

/// Values at which a mechanism's response stands for its shape: where its fits start, or one standard deviation from no effect.
fn typical(entry: &Omission) -> Vec<Vec<f64>> {
    let nothing = |values: &Vec<f64>| values.iter().zip(&entry.parameters).all(|(v, p)| p.prior.standard(*v) == 0.0);
    let away = || entry.parameters.iter().map(|p| p.prior.value(1.0)).collect();
    entry.starts.iter().map(|v| if nothing(v) { away() } else { v.clone() }).collect()
}

/// Selection by BIC: every mechanism's response at typical parameters is one regressor on both channels with a free amplitude and offsets, in
/// white noise of the size of the rows' differences; the best shape stands for a mechanism, which pays for all its parameters.
pub(crate) fn selection(unit: &Unit) -> Result<Answer, Failure> {
    let y = [unit.residual(FIT, SPOOL, &[])?, unit.residual(FIT, RATE, &[])?];
    let white = y.each_ref().map(|y| rms(y.windows(2).map(|w| w[1] - w[0])) / std::f64::consts::SQRT_2);
    let centred = |channel: usize, series: Series| -> Series {
        let known: Series = series.iter().zip(&y[channel]).map(|(s, y)| if y.is_nan() { f64::NAN } else { *s }).collect();
        let mean = mean(known.iter().copied());
        known.iter().map(|v| (v - mean) / white[channel]).filter(|v| !v.is_nan()).collect()
    };
    let joined = |series: [Series; 2]| -> DVector<f64> {
        let [spool, rate] = series;
        DVector::from_vec([centred(SPOOL, spool), centred(RATE, rate)].concat())
    };
    let seen = joined(y.clone());
    let size = (seen.len() as f64).ln();
    let nominal = unit.respond(FIT, &[])?;
    let mut gains: Vec<(String, f64)> = Vec::new();
    for (mechanism, entry) in unit.gyro.mechanisms().iter().enumerate().filter(|(_, m)| m.named) {
        let choices: Vec<Option<f64>> = entry.choice.as_ref().map_or(vec![None], |(_, v)| v.iter().copied().map(Some).collect());
        let mut most = 0.0_f64;
        for values in typical(entry) {
            for &choice in &choices {
                let with = unit.respond(FIT, &[Active { mechanism, values: values.clone(), choice }])?;
                let change = |c: usize| with[c].iter().zip(&nominal[c]).map(|(a, b)| a - b).collect();
                let shape = joined([change(SPOOL), change(RATE)]);
                let norm = shape.norm_squared();
                if norm > 0.0 {
                    most = most.max(shape.dot(&seen).powi(2) / norm);
                }
            }
        }
        let count = entry.parameters.len() + usize::from(entry.choice.is_some());
        gains.push((entry.id.clone(), (most - count as f64 * size) / 2.0));
    }
    gains.sort_by(|a, b| b.1.total_cmp(&a.1));
    let most = gains.first().map_or(0.0, |g| g.1.max(0.0));
    let sum: f64 = (-most).exp() + gains.iter().map(|g| (g.1 - most).exp()).sum::<f64>();
    let probable = |(id, gain): &(String, f64)| Probable { id: id.clone(), probability: (gain - most).exp() / sum };
    let mechanisms: Vec<Probable> = gains.iter().map(probable).collect();
    let explained = most > 0.0;
    let lead = mechanisms.first().map_or(0.0, |m| m.probability);
    let set = mechanisms.iter().filter(|m| explained && m.probability >= EXCLUDED * lead).map(|m| m.id.clone()).collect();
    let place = mechanisms.first().filter(|_| explained).and_then(|m| stage(&m.id)).map(str::to_owned);
    let verdict = if explained { "explained" } else { "none" }.to_owned();
    Ok(Answer { verdict, mechanisms, set, located: Place { stage: place }, ..Answer::default() })
}

/// Smallest probability, relative to the best, at which a mechanism is not excluded: as in the diagnosis.
const EXCLUDED: f64 = 0.03;
