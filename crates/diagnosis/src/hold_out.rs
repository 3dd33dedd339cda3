//! A fit's prediction of a record that it has not seen.

use crate::fit::{Fit, Offset, Unseen, checked, designed};
use crate::noise::{MINUTE, Noise};
use crate::{Error, ForwardModel, Observation};
use nalgebra::{Cholesky, DMatrix, DVector};

/// A fit judged on a record that it has not seen.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldOut {
    /// Prediction of every channel, with the offsets of the first record that was fitted.
    pub prediction: Vec<Vec<f64>>,
    /// Root mean square of recorded less predicted, of every channel.
    pub rmse: Vec<f64>,
    /// Standard deviation of the noise in a sample as identified in the fit, of every channel, with no more drift and walk than are usual: where a fit
    /// leaves something unexplained, its noise has swallowed that.
    pub noise_floor: Vec<f64>,
    /// Root mean square of means over a minute, or over a row that is longer, so that the length of a record's rows does not matter, with the numbers that the
    /// record has of its own at their most probable values. A record of less than an hour has sixty means.
    pub of_minutes: Vec<f64>,
    /// The same noise in those means.
    pub quiet: Vec<f64>,
    /// ln of the probability density of the record, but for a constant that fits with the same noise share: offsets, the numbers that every record
    /// has of its own, and the unknowns that the fit leaves open are marginalised.
    pub log_score: f64,
}

/// ln of the likelihood ratio beyond which chance is excluded: if the other prediction were right, e⁵ or more would have a probability
/// of at most e⁻⁵ = 1/148 (Markov's inequality).
const CLEAR: f64 = 5.0;
/// Largest error over the noise identified elsewhere that is still noise. A record of a dozen correlation times of the drift holds some six
/// independent stretches of it, from which its size is known to 1/√(2·6) = 0.29 (1σ).
const NOISE: f64 = 1.3;
/// Least error over the noise that is far more than noise: beyond three times that uncertainty, 1 + 3·0.29, rounded.
const FAR: f64 = 2.0;
/// Least error over the nominal model's that is hardly less than it: a tenth of the variance explained, 1 − 0.95².
pub(crate) const BARELY: f64 = 0.95;
/// Largest drift and walk that are usual, over the medians of their priors: about one standard deviation of the drift's logarithm (0.7) above.
const USUAL: f64 = 2.0;
/// Fewest means that determine an error to a tenth of it.
const FEWEST: usize = 60;
/// Share of the error beyond which one prediction is worse than another, by convention: two digits of it.
const WORSE: f64 = 0.01;

impl HeldOut {
    /// Whether the residual of a channel is no larger than noise.
    pub fn within_noise(&self, channel: usize) -> bool {
        self.of_minutes[channel] <= NOISE * self.quiet[channel]
    }

    /// Residual of a channel over the noise in it.
    pub fn over_noise(&self, channel: usize) -> f64 {
        self.of_minutes[channel] / self.quiet[channel]
    }

    /// Whether the residual of a channel is far more than noise.
    pub fn is_far_from_noise(&self, channel: usize) -> bool {
        self.over_noise(channel) > FAR
    }

    /// Whether this is no proof of the fit: the residual of a channel is far more than noise, and hardly less than that of `nominal`.
    pub fn proves_nothing(&self, nominal: &Self, channel: usize) -> bool {
        self.is_far_from_noise(channel) && self.of_minutes[channel] > BARELY * nominal.of_minutes[channel]
    }

    /// Whether the whole record is clearly likelier than by `other`, a channel is predicted as well to two digits, and another one better.
    pub(crate) fn is_likelier_than(&self, other: &Self, channel: usize) -> bool {
        let better = (0..self.rmse.len()).any(|c| c != channel && self.of_minutes[c] < BARELY * other.of_minutes[c]);
        better && self.rmse[channel] <= (1.0 + WORSE) * other.rmse[channel] && self.log_score > other.log_score + CLEAR
    }

    /// Whether `other` predicts a channel clearly better: by its error, and by the probability of the whole record, for a fault of one channel may be
    /// what the other one shows.
    pub fn clearly_worse_than(&self, other: &Self, channel: usize) -> bool {
        self.of_minutes[channel] > (1.0 + WORSE) * other.of_minutes[channel] && self.log_score < other.log_score - CLEAR
    }
}

impl Fit {
    /// Predicts `record` of the model and compares with its observations; `judge` gives the noise under which it is scored.
    ///
    /// # Errors
    /// [`Error::Data`] if the observation does not fit the model or has no value; [`Error`] if the model fails.
    pub fn hold_out(
        &self,
        model: &dyn ForwardModel,
        record: usize,
        observed: &Observation,
        judge: &Self,
    ) -> Result<HeldOut, Error> {
        checked::observed(model, record, observed)?;
        judged(model, self.unseen(model, (record, observed.time.len()))?, &self.offsets[0], observed, judge)
    }
}

/// The same for the model as it is designed: nothing fitted but the offsets, which are the means of its residuals in `fitted`.
///
/// # Errors
/// [`Error::Data`] if an observation does not fit the model or has no value; [`Error`] if the model fails.
pub fn as_designed(
    model: &dyn ForwardModel,
    fitted: (usize, &Observation),
    held: (usize, &Observation),
    judge: &Fit,
) -> Result<HeldOut, Error> {
    for (record, observed) in [fitted, held] {
        checked::observed(model, record, observed)?;
    }
    let (_, offsets) = left_by_design(model, fitted)?;
    judged(model, designed(model, (held.0, held.1.time.len()))?, &offsets, held.1, judge)
}

/// Residuals `[channel][row]` of a record by the model as it is designed, nothing fitted but the offsets, which are their means.
///
/// # Errors
/// [`Error::Data`] if the observation does not fit the model or has no value; [`Error`] if the model fails.
pub fn designed_residuals(model: &dyn ForwardModel, (record, observed): (usize, &Observation)) -> Result<Vec<Vec<f64>>, Error> {
    checked::observed(model, record, observed)?;
    let (mut left, offsets) = left_by_design(model, (record, observed))?;
    for (left, offset) in left.iter_mut().zip(offsets) {
        left.iter_mut().for_each(|r| *r -= offset);
    }
    Ok(left)
}

/// Recorded less predicted by the model as it is designed, of every channel, and its means.
fn left_by_design(
    model: &dyn ForwardModel,
    (record, observed): (usize, &Observation),
) -> Result<(Vec<Vec<f64>>, Vec<f64>), Error> {
    let response = designed(model, (record, observed.time.len()))?.response;
    let channels = observed.channels.iter().zip(&response);
    let left: Vec<Vec<f64>> =
        channels.map(|(recorded, predicted)| recorded.iter().zip(predicted).map(|(y, p)| y - p).collect()).collect();
    let mean = |left: &Vec<f64>| {
        let known: Vec<f64> = left.iter().copied().filter(|r| r.is_finite()).collect();
        known.iter().sum::<f64>() / known.len().max(1) as f64
    };
    let offsets = left.iter().map(mean).collect();
    Ok((left, offsets))
}

/// A prediction with offsets against the observations.
fn judged(
    model: &dyn ForwardModel,
    unseen: Unseen,
    offsets: &[f64],
    observed: &Observation,
    judge: &Fit,
) -> Result<HeldOut, Error> {
    let noise = judge.noise.pooled(observed)?;
    let Unseen { response: mut prediction, moved, loadings } = unseen;
    let (rows, channels) = (recording::median_interval(&observed.time).unwrap_or(MINUTE), model.channels());
    let of_a_minute = ((MINUTE / rows).floor() as usize).min(observed.time.len() / FEWEST).max(1);
    let (mut rmse, mut residuals) = (Vec::new(), Vec::new());
    let (mut left, mut by_offset, mut by_moved) = (Vec::new(), Vec::new(), vec![Vec::new(); moved.len()]);
    for (c, (predicted, recorded)) in prediction.iter_mut().zip(&observed.channels).enumerate() {
        let own = Offset::of(&channels[c], recorded, predicted);
        predicted.iter_mut().for_each(|p| *p += offsets[c]);
        // an offset that may be anything is this record's own
        let by = if channels[c].offset.1.is_finite() { offsets[c] } else { own.mean };
        let residual: Vec<f64> = recorded.iter().zip(predicted.iter()).map(|(y, p)| y - (p - offsets[c] + by)).collect();
        let used: Vec<f64> = residual.iter().copied().filter(|r| !r.is_nan()).collect();
        rmse.push(root_mean_square(&used));
        left.extend(noise.whiten(0, c, &residual));
        let ones = vec![own.sd; residual.len()];
        by_offset.push(noise.whiten(0, c, &ones));
        for (all, moved) in by_moved.iter_mut().zip(&moved) {
            all.extend(noise.whiten(0, c, &moved[c]));
        }
        residuals.push(residual);
    }
    let floor = |rows: usize| (0..channels.len()).map(|c| noise_of(&noise, observed, &channels[c], c, rows)).collect();
    let (noise_floor, quiet) = (floor(1), floor(of_a_minute));
    let columns = stacked(&by_offset, &by_moved, loadings, left.len());
    let left = DVector::from_vec(left);
    // what is no number predicts nothing
    let (log_score, sizes) = scored(&left, &columns).unwrap_or((f64::NEG_INFINITY, DVector::zeros(columns.ncols())));
    // the numbers that the record has of its own, such as its start, are no error of the prediction
    let own = model.nuisances().iter().filter(|nuisance| nuisance.local).count();
    for (size, moved) in sizes.iter().rev().zip(moved.iter().rev()).take(own) {
        for (residual, by) in residuals.iter_mut().flatten().zip(moved.iter().flatten()) {
            *residual -= size * by;
        }
    }
    let in_minutes = |residual: &Vec<f64>| {
        let used: Vec<f64> = residual.iter().copied().filter(|r| !r.is_nan()).collect();
        let whole = used.chunks_exact(of_a_minute).map(|rows| rows.iter().sum::<f64>() / rows.len() as f64);
        root_mean_square(&whole.collect::<Vec<_>>())
    };
    let of_minutes = residuals.iter().map(in_minutes).collect();
    Ok(HeldOut { prediction, rmse, noise_floor, of_minutes, quiet, log_score })
}

fn root_mean_square(values: &[f64]) -> f64 {
    (values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// Noise of a channel in means of so many rows about the mean of a record, with no more drift and walk than are usual.
fn noise_of(noise: &Noise, observed: &Observation, channel: &crate::Channel, c: usize, rows: usize) -> f64 {
    let model = noise.model(0, c);
    let span = observed.time.last().zip(observed.time.first()).map_or(0.0, |(last, first)| last - first);
    // a random walk about its own mean
    let walk = model.walk.min(USUAL * channel.noise.walk.0) * (span / 6.0).sqrt();
    let drift = model.drift.min(USUAL * channel.noise.drift.0);
    (model.white / (rows as f64).sqrt()).hypot(drift).hypot(walk).hypot(model.passed)
}

/// Whitened columns of the open unknowns: an offset in each channel, and the loadings of all else that moves the prediction.
fn stacked(by_offset: &[Vec<f64>], by_moved: &[Vec<f64>], loadings: DMatrix<f64>, rows: usize) -> DMatrix<f64> {
    let mut columns = DMatrix::zeros(rows, by_offset.len() + by_moved.len());
    let mut from = 0;
    for (c, offset) in by_offset.iter().enumerate() {
        columns.view_mut((from, c), (offset.len(), 1)).copy_from_slice(offset);
        from += offset.len();
    }
    if !by_moved.is_empty() {
        let moved = DMatrix::from_iterator(rows, by_moved.len(), by_moved.iter().flatten().copied());
        columns.columns_mut(by_offset.len(), by_moved.len()).copy_from(&(moved * loadings));
    }
    columns
}

/// ln of the density of whitened values that independent standard normal variables move by these columns, without the constant of the normal density, and the most
/// probable sizes of these; `None` if they are no numbers.
fn scored(left: &DVector<f64>, columns: &DMatrix<f64>) -> Option<(f64, DVector<f64>)> {
    let precision = columns.tr_mul(columns) + DMatrix::identity(columns.ncols(), columns.ncols());
    let factor = Cholesky::new(precision)?;
    let along = columns.tr_mul(left);
    let log_det: f64 = 2.0 * factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>();
    let sizes = factor.solve(&along);
    let score = -(left.norm_squared() - along.dot(&sizes) + log_det) / 2.0;
    score.is_finite().then_some((score, sizes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Channel, NoisePrior, Nuisance, Omission, State};

    /// A reading of nothing at rows of some seconds.
    struct Still {
        channels: Vec<Channel>,
        nuisances: Vec<Nuisance>,
        rows: usize,
        state: State,
    }

    impl ForwardModel for Still {
        fn channels(&self) -> &[Channel] {
            &self.channels
        }

        fn nuisances(&self) -> &[Nuisance] {
            &self.nuisances
        }

        fn mechanisms(&self) -> &[Omission] {
            &[]
        }

        fn respond(&self, _: usize, start: &[f64], _: &[crate::Active]) -> Result<Vec<Vec<f64>>, crate::Failure> {
            let start = start.first().copied().unwrap_or(0.0);
            Ok(vec![(0..self.rows).map(|n| start * (-(n as f64) / 40.0).exp()).collect()])
        }

        fn state(&self, _: usize) -> &State {
            &self.state
        }
    }

    /// Error of minutes over the noise in them, of two hours of a wave of ten minutes in white noise, in rows of so many seconds.
    fn over_noise(seconds: usize, span: usize) -> f64 {
        let rows = span / seconds;
        // noise of a second's rows, averaged
        let mut state = 1_u64;
        let mut noise = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1_u32 << 24) - 0.5
        };
        let mean = |n: usize, noise: &mut dyn FnMut() -> f64| {
            let wave = 0.1 * (std::f64::consts::TAU * ((n * seconds) as f64) / 600.0).sin();
            wave + (0..seconds).map(|_| noise()).sum::<f64>() / seconds as f64
        };
        let values: Vec<f64> = (0..rows).map(|n| mean(n, &mut noise)).collect();
        let time: Vec<f64> = (0..rows).map(|n| (n * seconds) as f64).collect();
        let white = 1.0 / 12.0_f64.sqrt() / (seconds as f64).sqrt();
        let noise = NoisePrior::new((white, 1e-3), (1e-9, 1e-3), (1500.0, 1e-3), (1e-12, 1e-3));
        let channel =
            Channel { name: "y".into(), unit: "1".into(), offset: (0.0, f64::INFINITY), averaging: seconds as f64, noise };
        let state = State { level: vec![0.0; rows], rate: vec![0.0; rows] };
        let model = Still { channels: vec![channel], nuisances: Vec::new(), rows, state };
        let observed = Observation { time, channels: vec![values] };
        let fitter = crate::fit::Fitter::new(&model, &[0], std::slice::from_ref(&observed)).unwrap();
        let typical = Noise::typical(&model.channels, std::slice::from_ref(&observed)).unwrap();
        let fit = fitter.fit(&crate::Hypothesis::NOMINAL, &typical, None).unwrap();
        fit.hold_out(&model, 0, &observed, &fit).unwrap().over_noise(0)
    }

    #[test]
    fn a_record_says_the_same_in_rows_of_a_second_and_of_a_minute() {
        let of = [1, 10, 60].map(|seconds| over_noise(seconds, 14_400));
        assert!(of[0] > 1.8 && of.iter().all(|ratio| (ratio / of[0] - 1.0).abs() < 0.1), "{of:?}");
        // a record of a minute has an error, too
        assert!(over_noise(1, 60) > 0.5);
    }

    /// A record that starts off rest by two standard deviations, in white noise of a tenth of that.
    #[test]
    fn a_start_of_a_record_s_own_is_no_error_of_a_prediction() {
        let held = |local: bool| {
            const ROWS: usize = 400;
            let mut state = 5_u64;
            let mut white = || {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                0.1 * 12.0_f64.sqrt() * ((state >> 40) as f64 / f64::from(1_u32 << 24) - 0.5)
            };
            let mut record = |start: f64| Observation {
                time: (0..ROWS).map(|n| 60.0 * n as f64).collect(),
                channels: vec![(0..ROWS).map(|n| start * (-(n as f64) / 40.0).exp() + white()).collect()],
            };
            let noise = NoisePrior::new((0.1, 1e-3), (1e-9, 1e-3), (1500.0, 1e-3), (1e-12, 1e-3));
            let channel = Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1e-6), averaging: 60.0, noise };
            let start = Nuisance { local, ..Nuisance::normal("start", 0.0, 0.5, crate::Role::Sensor) };
            let state = State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] };
            let model = Still { channels: vec![channel], nuisances: vec![start], rows: ROWS, state };
            let (fitted, other) = (record(0.0), record(1.0));
            let fitter = crate::fit::Fitter::new(&model, &[0], std::slice::from_ref(&fitted)).unwrap();
            let typical = Noise::typical(&model.channels, std::slice::from_ref(&fitted)).unwrap();
            let fit = fitter.fit(&crate::Hypothesis::NOMINAL, &typical, None).unwrap();
            fit.hold_out(&model, 1, &other, &fit).unwrap()
        };
        let [own, shared] = [true, false].map(held);
        assert!(own.within_noise(0) && own.rmse[0] > 2.0 * own.quiet[0], "{own:?}");
        assert!(!shared.within_noise(0), "{shared:?}");
    }

    #[test]
    fn a_likelier_prediction_is_better_in_another_channel_and_as_good_in_its_own() {
        // errors of two channels, and how likely the record is
        let of = |errors: [f64; 2], log_score: f64| HeldOut {
            prediction: Vec::new(),
            rmse: errors.to_vec(),
            noise_floor: vec![1.0; 2],
            of_minutes: errors.to_vec(),
            quiet: vec![1.0; 2],
            log_score,
        };
        // the units of the channels do not matter
        for unit in [0.1, 1.0, 10.0] {
            let other = of([2.0 * unit, 2.0 * unit], -100.0);
            let likelier = |own: f64, another: f64, by: f64| {
                of([2.0 * unit * own, 2.0 * unit * another], -100.0 + by).is_likelier_than(&other, 0)
            };
            assert!(likelier(1.0, 0.9, 6.0) && likelier(1.005, 0.9, 6.0));
            assert!(!likelier(1.02, 0.9, 6.0), "its own channel is worse");
            assert!(!likelier(1.0, 0.97, 6.0) && !likelier(0.5, 1.0, 6.0), "no other channel is better");
            assert!(!likelier(1.0, 0.9, 4.0), "chance is not excluded");
        }
    }

    #[test]
    fn the_density_is_that_of_the_covariance_with_what_is_open() {
        let columns = DMatrix::from_row_slice(3, 2, &[1.0_f64, 0.2, -0.5, 2.0, 0.3, 0.1]);
        let left = DVector::from_vec(vec![0.4_f64, -1.0, 2.0]);
        let covariance = DMatrix::<f64>::identity(3, 3) + &columns * columns.transpose();
        let direct = -(left.dot(&(covariance.clone().try_inverse().unwrap() * &left)) + covariance.determinant().ln()) / 2.0;
        let (score, sizes) = scored(&left, &columns).unwrap();
        assert!((score - direct).abs() < 1e-12);
        // the sizes are those of the regression
        let rest = columns.transpose() * (&left - &columns * &sizes) - &sizes;
        assert!(rest.norm() < 1e-12);
        assert!(scored(&DVector::from_vec(vec![f64::NAN, 0.0, 0.0]), &columns).is_none());
    }
}
