//! A measured course without its sensor's noise.

use crate::Error;
use crate::condition::span;
use crate::corners::corners;
use crate::series::{check_length, check_series, median_interval};
use nalgebra::{Matrix3, Vector3};

/// Degrees of freedom of the steps' Student distribution, here Cauchy's: a programme turns seldom, but then sharply.
const FREEDOM: f64 = 1.0;
/// Dimensions of a step: how large, when within its interval, and over how long. With two a step at an end of the interval is followed as if by a slower chamber.
const RANK: f64 = 3.0;
/// Time constants that are tried, in usual intervals: from next to none on, each twice the one before.
const LAGS: [f64; 9] = [0.35, 0.7, 1.4, 2.8, 5.6, 11.0, 22.0, 45.0, 90.0];
/// ln of the ratio of two of them, and steps of a search between them: to a fiftieth.
const TWICE: f64 = std::f64::consts::LN_2;
const CLOSER: usize = 8;
/// Time constants below which it is searched between them.
const QUICK: f64 = 2.0;
/// Rounds of reweighting at each of them, at those between, and then at the likeliest: with far fewer a corner in noise stays wide, as behind a slow chamber.
const TRIED: usize = 25;
const BETWEEN: usize = 12;
const ROUNDS: usize = 60;
/// ln of a step's variance over the noise's that is searched, at first and about a known one, and how closely it is found.
const RATIOS: (f64, f64) = (-25.0, 20.0);
const NEAR: f64 = 1.5;
const CLOSE: f64 = 0.1;
/// Variance of an unknown start over the noise's.
const UNKNOWN: f64 = 1e6;
/// Share of the range below which a step is what rounding leaves of one value: no course is smoothed as if it were better.
const ROUNDING: f64 = 1e-7;
/// Weight of a step with a corner, from which a search begins: little enough that any turn is made there; reweighing finds the likely one.
const CORNER: f64 = 1e-4;
/// Weight of a step that does not turn at all.
const STRAIGHT: f64 = (FREEDOM + RANK) / FREEDOM;
/// Between these a product goes on, far from what no number holds.
const LEAST: f64 = 1e-200;
const MOST: f64 = 1e200;
/// Fewest rows that can be smoothed.
pub const FEWEST_ROWS: usize = 8;

type Vector = Vector3<f64>;
type Matrix = Matrix3<f64>;

/// A course freed of white noise.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// The course at the instants given.
    pub values: Vec<f64>,
    /// Standard deviation of the noise that was taken off \[unit of the values\].
    pub noise: f64,
    /// Standard deviation of what is left of it, root mean square over all values, as the smoothing knows it: at corners more than in between.
    pub left: f64,
    /// Number of values of which a smoothed one is the mean, the median over all.
    pub of: f64,
}

/// The last digit of a display: the least step between two values that differ, if most moves by it stand alone. Moves that go on are those of a
/// ramp that is even, and say nothing of a display: 0, as of a constant, and of no value. Values must be finite.
pub fn resolution(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    if sorted.is_empty() {
        return 0.0;
    }
    let range = sorted[sorted.len() - 1] - sorted[0];
    let rounding = ROUNDING * range;
    let steps = sorted.windows(2).map(|w| w[1] - w[0]).filter(|step| *step > rounding);
    let least = steps.fold(f64::INFINITY, f64::min);
    let moves: Vec<f64> = values.windows(2).map(|w| w[1] - w[0]).collect();
    let by_least = || (0..moves.len()).filter(|&n| (moves[n].abs() - least).abs() <= rounding);
    let going_on = by_least().filter(|&n| moves.get(n + 1).is_some_and(|next| (next - moves[n]).abs() <= rounding));
    if 2 * going_on.count() < by_least().count() { least } else { 0.0 }
}

/// Frees a series of white noise: it follows a programme whose slope wanders, mostly little, at times much, through a lag.
///
/// The noise has at least the size of the last `digit`, beside its rounding: no thermometer is better than its display. Where it is not given, the
/// values tell.
/// The programme's slope is a random walk whose steps follow Student's distribution with one degree of freedom, so that ramps and soaks are smoothed
/// while the corners between them stay; a first-order follower, the chamber behind its controller, rounds them. The sizes of noise and steps and the
/// time constant are the most likely ones. Kalman's filter and the smoother of Rauch, Tung and Striebel (1965), reweighted as Lange, Little and Taylor
/// (1989) do. From a series without noise next to nothing is taken.
///
/// NaN is a value that is missing: there the course goes as its programme's most likely steps say, which put a corner where the lines before and behind
/// it meet.
///
/// # Errors
/// [`Error`] if instants do not increase, a value is infinite, or there are fewer than [`FEWEST_ROWS`].
pub fn smoothed(time: &[f64], values: &[f64], digit: Option<f64>) -> Result<Smoothed, Error> {
    check_length("values", values.len(), time.len())?;
    let is_there: Vec<bool> = values.iter().map(|value| !value.is_nan()).collect();
    let found = check_series(time, &is_there, &[("values", values)])?;
    if found < FEWEST_ROWS {
        return Err(Error::TooFew { found, needed: FEWEST_ROWS });
    }
    // intervals in units of the usual one
    let unit = median_interval(time).unwrap_or(1.0);
    let steps: Vec<f64> = time.windows(2).map(|t| (t[1] - t[0]) / unit).collect();
    let step = digit.unwrap_or_else(|| resolution(&values.iter().copied().filter(|value| !value.is_nan()).collect::<Vec<_>>()));
    let step = step.max(ROUNDING * span(values));
    let least = step * step * (1.0 + 1.0 / 12.0);
    let behind = |lag: f64| Readings { values, moves: moves(&steps, lag), least };
    let time: Vec<f64> = time.iter().map(|t| (t - time[0]) / unit).collect();
    // weights have many optima: from even ones, and from those of the time constant before
    let search = |anew: &dyn Fn(&Readings, f64) -> Option<Found>| {
        let mut likeliest: Option<(f64, f64, Found)> = None;
        let mut found = None;
        for lag in LAGS {
            let series = behind(lag);
            let starts = [found, anew(&series, lag)].into_iter().flatten();
            let ends = starts.map(|mut start| {
                (0..TRIED).for_each(|_| series.reweigh(&mut start));
                (series.deviance(&start), start)
            });
            // a NaN is no likelihood
            let best = ends.filter(|(deviance, _)| !deviance.is_nan()).min_by(|a, b| a.0.total_cmp(&b.0));
            found = best.as_ref().map(|(_, found)| found.clone());
            if let Some((deviance, found)) = best
                && likeliest.as_ref().is_none_or(|(least, ..)| deviance < *least)
            {
                likeliest = Some((deviance, lag, found));
            }
        }
        likeliest
    };
    // and from one corner in each run of missing values
    let searched =
        [search(&|series, _| Some(series.even())), search(&|series, lag| Some(series.with(cornered(&time, values, lag)?)))];
    let likeliest = searched.into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
    let likeliest = likeliest.unwrap_or_else(|| (f64::NAN, LAGS[0], behind(LAGS[0]).even()));
    let (_, lag, mut found) = if likeliest.1 < QUICK { closer(&behind, likeliest) } else { likeliest };
    let series = behind(lag);
    (0..ROUNDS).for_each(|_| series.reweigh(&mut found));
    let filter = series.filter(&found);
    let variance = filter.said.variance().max(least);
    let (values, _, variances) = filter.smooth(variance);
    let noise = variance.sqrt();
    let left = noise * (variances.iter().sum::<f64>() / variances.len() as f64).max(0.0).sqrt();
    let usual = crate::statistics::median(variances).unwrap_or(1.0).clamp(f64::MIN_POSITIVE, 1.0);
    Ok(Smoothed { values, noise, left, of: 1.0 / usual })
}

/// A likelier time constant near one of those that are tried, with deviance and estimates: golden section between its neighbours. A corner is followed within
/// a few values, which tell the time constant far better than those lie apart. Behind a slower chamber many values say the shape of a corner themselves, and
/// that of one time constant would be held too strictly: a controller and a thermometer have one each.
fn closer<'a>(behind: &impl Fn(f64) -> Readings<'a>, best: (f64, f64, Found)) -> (f64, f64, Found) {
    let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
    let at = |from: &Found, ln_lag: f64| {
        let (series, mut found) = (behind(ln_lag.exp()), from.clone());
        (0..BETWEEN).for_each(|_| series.reweigh(&mut found));
        (series.deviance(&found), ln_lag.exp(), found)
    };
    let middle = best.1.ln();
    let (mut low, mut high) = (middle - TWICE, middle + TWICE);
    let mut ends = [high - golden * (high - low), low + golden * (high - low)].map(|ln_lag| at(&best.2, ln_lag));
    let mut least = best;
    for _ in 0..CLOSER {
        for end in &ends {
            if end.0 < least.0 {
                least = end.clone();
            }
        }
        let [left, right] = ends;
        ends = if left.0 < right.0 {
            high = right.1.ln();
            let next = at(&left.2, high - golden * (high - low));
            [next, left]
        } else {
            low = left.1.ln();
            let next = at(&right.2, low + golden * (high - low));
            [right, next]
        };
    }
    least
}

/// A series to be smoothed behind a follower: its values, how the state goes on between them, and the least variance of their noise.
struct Readings<'a> {
    values: &'a [f64],
    moves: Vec<Move>,
    least: f64,
}

/// Over a step: how the state goes on, and what wandering adds.
type Move = (Matrix, Matrix);

/// Over every step, behind a follower of this time constant.
fn moves(steps: &[f64], lag: f64) -> Vec<Move> {
    let mut moves: Vec<Move> = Vec::with_capacity(steps.len());
    for (n, step) in steps.iter().enumerate() {
        let same = n > 0 && *step == steps[n - 1];
        moves.push(if same { moves[n - 1] } else { (forward(*step, lag), wander(*step, lag)) });
    }
    moves
}

/// Weights of the steps where every run of missing values has one corner of the programme, which its values follow with a lag, and no other turn; `None` if
/// there is none. Weights that make two corners of one, at the ends of the run, are an optimum, too, which no reweighing leaves.
fn cornered(time: &[f64], values: &[f64], lag: f64) -> Option<Vec<f64>> {
    let mut weights: Option<Vec<f64>> = None;
    for (hidden, meet) in corners(time, values) {
        let corner = meet - lag;
        if corner >= time[hidden.start] && corner <= time[hidden.end] {
            let weights = weights.get_or_insert_with(|| vec![1.0; time.len() - 1]);
            for step in hidden {
                weights[step] = if (time[step]..=time[step + 1]).contains(&corner) { CORNER } else { STRAIGHT };
            }
        }
    }
    weights
}

/// Estimates for a series: ln of a step's variance over the noise's, and every step's weight.
#[derive(Clone)]
struct Found {
    ln_ratio: f64,
    weights: Vec<f64>,
}

impl Readings<'_> {
    /// With even weights.
    fn even(&self) -> Found {
        self.with(vec![1.0; self.moves.len()])
    }

    /// With these weights and the likeliest size of steps for them.
    fn with(&self, weights: Vec<f64>) -> Found {
        Found { ln_ratio: self.most_likely(&weights, RATIOS), weights }
    }

    fn filter<'a>(&'a self, found: &'a Found) -> Filter<'a> {
        let mut states = Vec::with_capacity(self.values.len());
        let (ratio, weights) = (found.ln_ratio.exp(), &found.weights);
        let said = self.follow(ratio, weights, |predicted| states.push(predicted));
        Filter { ratio, weights, moves: &self.moves, states, said }
    }

    /// Kalman's filter over all values; `met` is told each as it comes.
    fn follow(&self, ratio: f64, weights: &[f64], mut met: impl FnMut(Predicted)) -> Said {
        let first = self.values.iter().copied().find(|value| !value.is_nan()).unwrap_or_default();
        let (mut x, mut p) = (Vector::new(first, 0.0, 0.0), UNKNOWN * Matrix::identity());
        let mut there = 0;
        let mut said = Said { squares: 0.0, log_det: 0.0, count: 0 };
        let mut product = 1.0;
        for (n, value) in self.values.iter().enumerate() {
            if n > 0 {
                let (f, q) = &self.moves[n - 1];
                x = f * x;
                p = f * p * f.transpose() + ratio / weights[n - 1] * q;
            }
            // a value that is missing says nothing
            let is_there = !value.is_nan();
            there += usize::from(is_there);
            let (surprise, spread) = if is_there { (value - x[0], p[(0, 0)] + 1.0) } else { (0.0, f64::INFINITY) };
            // the first three say where it starts
            if is_there && there > 3 {
                said.squares += surprise * surprise / spread;
                // a logarithm of many at once
                product *= spread;
                if !(LEAST..MOST).contains(&product) {
                    said.log_det += product.ln();
                    product = 1.0;
                }
                said.count += 1;
            }
            met(Predicted { mean: x, covariance: p, surprise, spread });
            let gain: Vector = p.column(0) / spread;
            x += gain * surprise;
            // Joseph's form keeps it positive
            let kept = without_course(&gain);
            p = kept * p * kept.transpose() + gain * gain.transpose();
        }
        said.log_det += product.ln();
        said
    }

    /// One round: weights by how unlikely steps are, then the likeliest size of steps.
    fn reweigh(&self, found: &mut Found) {
        let filter = self.filter(found);
        let variance = filter.said.variance().max(self.least).max(f64::MIN_POSITIVE);
        let (_, squares, _) = filter.smooth(variance);
        for (w, square) in found.weights.iter_mut().zip(&squares) {
            *w = (FREEDOM + RANK) / (FREEDOM + square / variance);
        }
        found.ln_ratio = self.most_likely(&found.weights, (found.ln_ratio - NEAR, found.ln_ratio + NEAR));
    }

    /// −2 ln of the likelihood, but for a constant: of the weights the variational bound (Tipping and Lawrence 2005).
    fn deviance(&self, found: &Found) -> f64 {
        let of_weights: f64 = found.weights.iter().map(|w| w.ln() - w).sum();
        self.follow(found.ln_ratio.exp(), &found.weights, |_| ()).deviance(self.least) - FREEDOM * of_weights
    }

    /// ln of the most likely variance of a step over that of the noise: golden section.
    fn most_likely(&self, weights: &[f64], (mut a, mut b): (f64, f64)) -> f64 {
        let of = |x: f64| self.follow(x.exp(), weights, |_| ()).deviance(self.least);
        let golden = (5.0_f64.sqrt() - 1.0) / 2.0;
        let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
        let (mut at_x, mut at_y) = (of(x), of(y));
        while b - a > CLOSE {
            if at_x < at_y {
                (b, y, at_y) = (y, x, at_x);
                x = b - golden * (b - a);
                at_x = of(x);
            } else {
                (a, x, at_x) = (x, y, at_y);
                y = a + golden * (b - a);
                at_y = of(y);
            }
        }
        ((a + b) / 2.0).clamp(RATIOS.0, RATIOS.1)
    }
}

/// The state: the course, the programme's slope v, and how far the course is behind its programme, e, which follows e' = v − e/lag.
fn forward(dt: f64, lag: f64) -> Matrix {
    let forget = (-dt / lag).exp();
    let behind = lag * (1.0 - forget);
    Matrix::new(1.0, dt - behind, 1.0 - forget, 0.0, 1.0, 0.0, 0.0, behind, forget)
}

/// Covariance of what steps of the slope, of unit intensity, add over an interval: at the three points of Gauss's rule, exact for quintics.
fn wander(dt: f64, lag: f64) -> Matrix {
    let at = |share: f64| {
        let left = dt * share;
        let behind = lag * (1.0 - (-left / lag).exp());
        Vector::new(left - behind, 1.0, behind)
    };
    let off = 0.5 * 0.6_f64.sqrt();
    let points = [(0.5 - off, 5.0), (0.5, 8.0), (0.5 + off, 5.0)];
    points.into_iter().map(|(share, weight)| at(share) * at(share).transpose() * (dt * weight / 18.0)).sum()
}

/// Prediction of the state before a value, and the information in the value.
struct Predicted {
    mean: Vector,
    covariance: Matrix,
    surprise: f64,
    /// variance of the surprise
    spread: f64,
}

/// Information in the values on ratio and weights.
struct Said {
    squares: f64,
    log_det: f64,
    count: usize,
}

impl Said {
    /// Most likely variance of the noise.
    fn variance(&self) -> f64 {
        self.squares / self.count as f64
    }

    /// −2 ln of the likelihood but for a constant, the noise's variance at its most likely value that is no less than `least`.
    fn deviance(&self, least: f64) -> f64 {
        let variance = self.variance().max(least).max(f64::MIN_POSITIVE);
        self.count as f64 * variance.ln() + self.log_det + self.squares / variance
    }
}

/// Kalman's filter with all that it met, variances in units of the noise's.
struct Filter<'a> {
    ratio: f64,
    weights: &'a [f64],
    moves: &'a [Move],
    states: Vec<Predicted>,
    said: Said,
}

impl Filter<'_> {
    /// The smoothed values, and of every step the expected square of its disturbance over its variance at weight 1, times the noise's
    /// variance, which is `variance`; and the variance of every smoothed value over the noise's. By the adjoint recursion (de Jong 1989; Koopman 1993),
    /// which divides by no covariance.
    fn smooth(&self, variance: f64) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
        let count = self.states.len();
        let (mut values, mut squares, mut variances) = (vec![0.0; count], vec![0.0; count - 1], vec![0.0; count]);
        // what the later values say of the next state
        let (mut r, mut known) = (Vector::zeros(), Matrix::zeros());
        for n in (0..count).rev() {
            let Predicted { mean, covariance, surprise, spread } = &self.states[n];
            if n + 1 < count {
                let (f, q) = &self.moves[n];
                let size = self.ratio / self.weights[n];
                // the disturbance has the mean size·q r and the covariance size·q less size·q known size·q
                let square = size * r.dot(&(q * r)) + variance * (RANK - size * (known * q).trace());
                squares[n] = square.max(0.0) / self.weights[n];
                (r, known) = (f.transpose() * r, f.transpose() * known * f);
            }
            let kept = without_course(&(covariance.column(0) / *spread));
            (r, known) = (kept.transpose() * r, kept.transpose() * known * kept);
            r[0] += surprise / spread;
            known[(0, 0)] += 1.0 / spread;
            let across: Vector = covariance.column(0).into();
            values[n] = mean[0] + across.dot(&r);
            variances[n] = covariance[(0, 0)] - across.dot(&(known * across));
        }
        (values, squares, variances)
    }
}

/// I − gain · (1, 0, 0).
fn without_course(gain: &Vector) -> Matrix {
    let mut kept = Matrix::identity();
    kept.column_mut(0).axpy(-1.0, gain, 1.0);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_two_intervals_are_one_twice_as_long() {
        for (a, b, lag) in [(30.0, 30.0, 300.0), (10.0, 25.0, 90.0), (1.0, 2.0, 40.0)] {
            let twice = forward(b, lag) * forward(a, lag);
            assert!((twice - forward(a + b, lag)).abs().max() < 1e-12 * twice.abs().max(), "{a} {b} {lag}");
            let both = forward(b, lag) * wander(a, lag) * forward(b, lag).transpose() + wander(b, lag);
            let whole = wander(a + b, lag);
            assert!((whole[(1, 1)] / (a + b) - 1.0).abs() < 1e-14, "unit intensity");
            // two points of Gauss's rule leave the fifth order
            assert!(both.iter().zip(whole.iter()).all(|(x, y)| (x / y - 1.0).abs() < 0.03), "{both} {whole}");
        }
    }

    /// A gap at one side of which most of it lies: steps at both of its ends are likely, too, one corner is likelier.
    #[test]
    fn a_corner_that_is_missing_is_where_the_lines_meet() {
        let (time, course) = programme(100.0);
        let noise = noise(time.len());
        for (from, to) in [(11_100.0, 12_400.0), (11_700.0, 13_300.0), (19_000.0, 20_500.0), (27_100.0, 28_300.0)] {
            let reading = |n: usize| if (from..to).contains(&time[n]) { f64::NAN } else { course[n] + 0.01 * noise[n] };
            let readings: Vec<f64> = (0..time.len()).map(reading).collect();
            let smooth = smoothed(&time, &readings, None).unwrap();
            let off = smooth.values.iter().zip(&course).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            // by the chord it would be up to 4 K
            assert!(off < 0.3, "{from} {to}: {off}");
        }
    }

    /// Lines that meet behind the missing values, before them and nowhere, and a lag that takes the corner out of them.
    #[test]
    fn exact_a_corner_is_sought_among_missing_values_alone() {
        let time: Vec<f64> = (0..60).map(f64::from).collect();
        let weights = |meet: f64, lag: f64| {
            let behind = |n: f64| if n < 25.0 { 0.0 } else { n - meet };
            let values: Vec<f64> = (0..60).map(|n| if (20..30).contains(&n) { f64::NAN } else { behind(f64::from(n)) }).collect();
            cornered(&time, &values, lag)
        };
        let (within, corner) = (weights(24.5, 0.0).expect("a corner"), |n: usize| if n == 24 { CORNER } else { STRAIGHT });
        assert!((0..59).all(|n| within[n] == if (19..30).contains(&n) { corner(n) } else { 1.0 }), "{within:?}");
        assert_eq!(weights(28.5, 4.0), Some(within));
        assert_eq!([weights(10.5, 0.0), weights(40.5, 0.0), weights(24.5, 9.0)], [None, None, None]);
    }

    #[test]
    fn new_weights_are_never_less_likely() {
        let (_, course) = programme(120.0);
        for (seed, digit) in [(0, 0.0), (1, 0.01), (2, 0.1)] {
            let noise = |n: usize| ((n * 7919 + seed * 31) % 1009) as f64 / 504.5 - 1.0;
            let values: Vec<f64> = course.iter().enumerate().map(|(n, x)| x + 0.02 * noise(n)).take(500).collect();
            let steps = vec![1.0; values.len() - 1];
            let series = Readings { values: &values, moves: moves(&steps, LAGS[3]), least: digit * digit * (1.0 + 1.0 / 12.0) };
            let mut found = series.even();
            let mut before = series.deviance(&found);
            for round in 0..TRIED {
                series.reweigh(&mut found);
                let after = series.deviance(&found);
                assert!(after <= before + 0.1, "round {round}: {before} to {after}");
                before = after;
            }
        }
    }

    /// Ramps of 0.01 K/s and soaks, rounded by a lag of `lag` \[s\].
    fn programme(lag: f64) -> (Vec<f64>, Vec<f64>) {
        let time: Vec<f64> = (0..1200).map(|n| 30.0 * f64::from(n)).collect();
        let target = |t: f64| 0.01 * ((t - 6000.0).clamp(0.0, 6000.0) - (t - 20000.0).clamp(0.0, 8000.0));
        let mut x = target(0.0);
        let course = time
            .iter()
            .map(|t| {
                x += (target(*t) - x) * -(-30.0 / lag).exp_m1();
                20.0 + x
            })
            .collect();
        (time, course)
    }

    fn noise(n: usize) -> Vec<f64> {
        let mut state = 7_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        (0..n).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect()
    }

    fn rms(a: &[f64]) -> f64 {
        (a.iter().map(|x| x * x).sum::<f64>() / a.len() as f64).sqrt()
    }

    #[test]
    fn noise_goes_and_corners_stay() {
        let (time, course) = programme(90.0);
        let noisy: Vec<f64> = course.iter().zip(noise(course.len())).map(|(c, e)| c + 0.01 * e).collect();
        let smooth = smoothed(&time, &noisy, None).unwrap();
        assert!((smooth.noise / 0.01 - 1.0).abs() < 0.1, "{}", smooth.noise);
        let off: Vec<f64> = smooth.values.iter().zip(&course).map(|(a, b)| a - b).collect();
        assert!(rms(&off) < 0.005, "{}", rms(&off));
        // at the four corners, too
        for corner in [200, 400, 667, 933] {
            assert!(off[corner - 8..corner + 12].iter().all(|o| o.abs() < 0.03), "{:?}", &off[corner - 8..corner + 12]);
        }
    }

    /// Wherever a corner lies between two rows, and whatever the time constant of the chamber is: what it leaves is no lag that a coil might have.
    #[test]
    fn corners_between_rows_are_followed_by_a_chamber_of_any_lag() {
        let time: Vec<f64> = (0..800).map(|n| 60.0 * f64::from(n)).collect();
        let corners = [(6000.0, 1.0), (12_000.0, -1.0), (24_015.0, -1.0), (30_045.0, 1.0), (36_030.0, 1.0), (42_000.0, -1.0)];
        for lag in [45.0, 60.0, 85.0, 170.0_f64] {
            // answer of a first-order system to a ramp
            let behind = |t: f64| if t > 0.0 { t - lag * -(-t / lag).exp_m1() } else { 0.0 };
            let course: Vec<f64> =
                time.iter().map(|t| 20.0 + corners.iter().map(|(at, turn)| turn * behind(t - at) / 60.0).sum::<f64>()).collect();
            let read: Vec<f64> = course.iter().map(|c| (100.0 * c).round() / 100.0).collect();
            let smooth = smoothed(&time, &read, None).unwrap();
            let off: Vec<f64> = smooth.values.iter().zip(&course).map(|(a, b)| a - b).collect();
            let most = off.iter().fold(0.0_f64, |most, o| most.max(o.abs()));
            // of a ramp of a kelvin for each row, read to a hundredth
            assert!(most < 0.0125, "{lag}: {most}");
        }
    }

    /// The remaining error is as large as stated, over many noises, and far less than the noise; a lag is found.
    #[test]
    fn what_is_left_of_noise_is_little_and_known() {
        for (lag, most) in [(90.0, 0.25), (20.0, 0.15), (300.0, 0.25)] {
            let (time, course) = programme(lag);
            let all = noise(20 * course.len());
            let (mut left, mut said) = (0.0, 0.0);
            for seed in 0..20 {
                let noisy: Vec<f64> = course.iter().zip(&all[seed * course.len()..]).map(|(c, e)| c + 0.05 * e).collect();
                let smooth = smoothed(&time, &noisy, None).unwrap();
                let off: Vec<f64> = smooth.values.iter().zip(&course).map(|(a, b)| a - b).collect();
                (left, said) = (left + rms(&off).powi(2), said + smooth.left.powi(2));
            }
            assert!((left / 20.0_f64).sqrt() < most * 0.05, "lag {lag} s: {}", (left / 20.0_f64).sqrt());
            assert!((0.8..1.5).contains(&(left / said).sqrt()), "lag {lag} s: {}", (left / said).sqrt());
        }
    }

    #[test]
    fn gaps_are_no_harm() {
        let (time, course) = programme(90.0);
        let noise = noise(course.len());
        // half a day without readings, and every third reading missing
        let late = |n: usize| if n > 500 { 43_200.0 } else { 0.0 };
        let kept: Vec<usize> = (0..course.len()).filter(|n| n % 3 != 0 || *n < 300).collect();
        let time: Vec<f64> = kept.iter().map(|&n| time[n] + late(n)).collect();
        let noisy: Vec<f64> = kept.iter().map(|&n| course[n] + 0.05 * noise[n]).collect();
        let smooth = smoothed(&time, &noisy, None).unwrap();
        let off: Vec<f64> = smooth.values.iter().zip(&kept).map(|(a, &n)| a - course[n]).collect();
        assert!(rms(&off) < 0.02 && off.iter().all(|o| o.abs() < 0.12), "{} {off:?}", rms(&off));
        assert!((smooth.noise / 0.05 - 1.0).abs() < 0.15, "{}", smooth.noise);
    }

    #[test]
    fn a_quiet_series_stays() {
        let (time, course) = programme(200.0);
        let smooth = smoothed(&time, &course, None).unwrap();
        let off = smooth.values.iter().zip(&course).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        assert!(off < 1e-3, "{off}");
    }

    /// A course without noise has no last digit, and stays what it is.
    #[test]
    fn exact_readings_stay() {
        let corners = [(0.0, -40.0), (3600.0, -40.0), (9600.0, 60.0), (13_200.0, 60.0), (19_200.0, -40.0), (22_800.0, -40.0)];
        let at = |t: f64| {
            let pair = corners.windows(2).find(|w| t <= w[1].0).expect("within");
            pair[0].1 + (pair[1].1 - pair[0].1) * (t - pair[0].0) / (pair[1].0 - pair[0].0)
        };
        for interval in [30.0, 60.0] {
            let time: Vec<f64> = (1..(22_800.0 / interval) as usize).map(|n| interval * n as f64).collect();
            let course: Vec<f64> = time.iter().map(|t| at(*t)).collect();
            let smooth = smoothed(&time, &course, None).unwrap();
            assert!(smooth.values.iter().zip(&course).all(|(a, b)| (a - b).abs() < 1e-5), "{interval} s: {}", smooth.noise);
        }
    }

    /// Half a kelvin a row is not the last digit of a display; a digit that a slow course is rounded to is.
    #[test]
    fn a_programme_of_even_steps_stays() {
        let time: Vec<f64> = (0..400).map(|n| 30.0 * f64::from(n)).collect();
        let steps: Vec<f64> = (0..400).map(|n| 20.0 + 0.5 * (f64::from(n) - 100.0).clamp(0.0, 80.0)).collect();
        let smooth = smoothed(&time, &steps, None).unwrap();
        let off = smooth.values.iter().zip(&steps).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
        assert!(off < 1e-3, "{off}");
        let rounded: Vec<f64> = time.iter().map(|t| (20.0 + (t / 1500.0).sin()).mul_add(10.0, 0.0).round() / 10.0).collect();
        assert!((resolution(&rounded) - 0.1).abs() < 1e-9);
        assert!((resolution(&steps)).abs() < 1e-12);
    }

    #[test]
    fn what_cannot_be_smoothed_is_refused() {
        assert!(matches!(smoothed(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], None), Err(Error::TooFew { .. })));
        let time: Vec<f64> = (0..10).map(f64::from).collect();
        assert!(matches!(smoothed(&time, &[f64::INFINITY; 10], None), Err(Error::Value { .. })));
        assert!(matches!(smoothed(&time, &[f64::NAN; 10], None), Err(Error::TooFew { found: 0, .. })));
        // a constant is kept
        assert!(smoothed(&time, &[5.0; 10], None).unwrap().values.iter().all(|v| (v - 5.0).abs() < 1e-9));
    }
}
