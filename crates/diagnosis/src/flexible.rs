//! The flexible rival: linear families of functions of the state, for what no mechanism of the library explains.

use crate::fit::Fit;
use crate::{ForwardModel, State};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// A family of functions in which a residual is sought.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// Periodic in the level.
    PeriodicInLevel,
    /// A smooth function of the level.
    Level,
    /// The rate times a smooth function of the level.
    RateByLevel,
    /// A nonlinear function of the rate.
    Rate,
    /// The rate's past, on several time scales.
    History,
    /// The rate's own rate of change.
    Acceleration,
    /// The direction of change, by level.
    Direction,
    /// A step at an instant.
    Step,
    /// What accumulates with time or with the level's wandering.
    Accumulation,
}

impl Structure {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::PeriodicInLevel,
        Self::Level,
        Self::RateByLevel,
        Self::Rate,
        Self::History,
        Self::Acceleration,
        Self::Direction,
        Self::Step,
        Self::Accumulation,
    ];

    /// In words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::PeriodicInLevel => "periodic in the level",
            Self::Level => "a function of the level",
            Self::RateByLevel => "proportional to the rate, with a factor that depends on the level",
            Self::Rate => "a nonlinear function of the rate",
            Self::History => "a function of the history (lagged rate)",
            Self::Acceleration => "proportional to the change of the rate",
            Self::Direction => "dependent on the direction of change",
            Self::Step => "a step in time",
            Self::Accumulation => "accumulating with time or with cycling",
        }
    }
}

/// A structure found in a residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Rival {
    /// Which.
    pub structure: Structure,
    /// In which channel.
    pub channel: usize,
    /// Period in the level, or instant of a step \[s\], where the structure has one.
    pub at: Option<f64>,
    /// Gain of ln evidence over the fit it is added to.
    pub gain: f64,
}

/// Smallest and largest value.
fn range<'a>(x: impl Iterator<Item = &'a f64>) -> [f64; 2] {
    x.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)])
}

/// What all records together reach.
struct Reach {
    level: [f64; 2],
    rate: [f64; 2],
}

/// Smooth bumps: a partition of unity of `count` hats over a range of x.
fn hats(x: &[f64], [low, high]: [f64; 2], count: usize) -> Vec<Vec<f64>> {
    let step = (high - low) / (count - 1) as f64;
    if step.is_nan() || step <= 0.0 {
        return Vec::new();
    }
    let hat = |k: usize| x.iter().map(|v| (1.0 - ((v - low) / step - k as f64).abs()).max(0.0)).collect();
    (0..count).map(hat).collect()
}

/// First-order follower of a series.
fn follow(time: &[f64], series: &[f64], tau: f64) -> Vec<f64> {
    let mut x = 0.0;
    (0..series.len())
        .map(|n| {
            let dt = if n > 0 { time[n] - time[n - 1] } else { 0.0 };
            x += (series[n] - x) * -(-dt / tau).exp_m1();
            x
        })
        .collect()
}

fn times(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a * b).collect()
}

/// A set of functions, with the period or instant that it stands for.
struct Basis {
    at: Option<f64>,
    /// Share of the structure's probability.
    share: f64,
    functions: Vec<Vec<f64>>,
}

fn one(functions: Vec<Vec<f64>>) -> Vec<Basis> {
    vec![Basis { at: None, share: 1.0, functions }]
}

/// 0 before an instant, 1 from it on.
fn step_at(time: &[f64], at: f64) -> Vec<f64> {
    time.iter().map(|t| if *t >= at { 1.0 } else { 0.0 }).collect()
}

/// Alternatives of a structure; its evidence is their mean. A step is tried at the `jumps` too.
fn bases(structure: Structure, time: &[f64], state: &State, reach: &Reach, jumps: &[Option<f64>]) -> Vec<Basis> {
    let (level, rate) = (&state.level, &state.rate);
    let range = reach.level[1] - reach.level[0];
    match structure {
        Structure::PeriodicInLevel => {
            if range.is_nan() || range <= 0.0 {
                return Vec::new();
            }
            (0..PERIODS)
                .map(|k| {
                    let period = range / 30.0 * (15.0_f64).powf(k as f64 / (PERIODS - 1) as f64);
                    let wave = |shift: f64| -> Vec<f64> {
                        level.iter().map(|l| (std::f64::consts::TAU * l / period + shift).sin()).collect()
                    };
                    let functions = vec![wave(0.0), wave(std::f64::consts::FRAC_PI_2)];
                    Basis { at: Some(period), share: 1.0 / PERIODS as f64, functions }
                })
                .collect()
        }
        Structure::Level => one(hats(level, reach.level, 9)),
        Structure::RateByLevel => one(hats(level, reach.level, 7).iter().map(|h| times(h, rate)).collect()),
        Structure::Rate => one(hats(rate, reach.rate, 7)),
        Structure::History => one(lags(time).iter().map(|tau| follow(time, rate, *tau)).collect()),
        Structure::Acceleration => {
            let change = (0..rate.len()).map(|n| {
                let (a, b) = (n.saturating_sub(1), (n + 1).min(rate.len() - 1));
                if b > a { (rate[b] - rate[a]) / (time[b] - time[a]) } else { 0.0 }
            });
            one(vec![change.collect()])
        }
        Structure::Direction => {
            let most = reach.rate[0].abs().max(reach.rate[1].abs());
            let direction: Vec<f64> = rate.iter().map(|r| (r / (0.02 * most).max(f64::MIN_POSITIVE)).tanh()).collect();
            one(hats(level, reach.level, 4).iter().map(|h| times(h, &direction)).collect())
        }
        Structure::Step => {
            let (first, last) = (time[0], time[time.len() - 1]);
            // half of the probability evenly in time, half on all rows, of which those that jump most are tried
            let even = (1..STEPS).map(|k| {
                let at = first + (last - first) * k as f64 / STEPS as f64;
                Basis { at: Some(at), share: 0.5 / (STEPS - 1) as f64, functions: vec![step_at(time, at)] }
            });
            let row = 0.5 / time.len() as f64;
            let at_jump =
                |at: &Option<f64>| Basis { at: *at, share: row, functions: vec![step_at(time, at.unwrap_or(f64::INFINITY))] };
            even.chain(jumps.iter().map(at_jump)).collect()
        }
        Structure::Accumulation => {
            let span = time[time.len() - 1] - time[0];
            let mut wandered = 0.0;
            let wander = (0..time.len())
                .map(|n| {
                    wandered += if n > 0 { (level[n] - level[n - 1]).abs() } else { 0.0 };
                    wandered
                })
                .collect();
            let settling = |tau: f64| time.iter().map(|t| (-(t - time[0]) / (tau * span)).exp()).collect();
            one(vec![wander, time.iter().map(|t| t - time[0]).collect(), settling(0.1), settling(0.3)])
        }
    }
}

const PERIODS: usize = 40;
const STEPS: usize = 48;
/// Jumps of a residual at which a step is tried, and the rows before and after that are compared.
const JUMPS: usize = 6;
const BESIDE_JUMP: usize = 10;

/// Instants at which a series changes most between the rows before and the rows after, apart from each other by as many; NaN is left out.
fn jumps(time: &[f64], series: &[f64]) -> Vec<f64> {
    let used: Vec<usize> = (0..series.len()).filter(|n| series[*n].is_finite()).collect();
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(used.iter().scan(0.0, |sum, n| {
            *sum += series[*n];
            Some(*sum)
        }))
        .collect();
    let mut found: Vec<(usize, f64)> = (BESIDE_JUMP..used.len().saturating_sub(BESIDE_JUMP))
        .map(|k| (k, (sums[k + BESIDE_JUMP] - 2.0 * sums[k] + sums[k - BESIDE_JUMP]).abs()))
        .collect();
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut chosen: Vec<usize> = Vec::new();
    for (k, _) in found {
        if chosen.len() < JUMPS && chosen.iter().all(|c| c.abs_diff(k) >= BESIDE_JUMP) {
            chosen.push(k);
        }
    }
    chosen.iter().map(|k| time[used[*k]]).collect()
}
/// Number of time constants of the history, the shortest in mean intervals, the longest as a share of the record.
const LAGS: usize = 5;
const SHORTEST: f64 = 7.0;
const LONGEST: f64 = 0.3;

/// Time constants of the history \[s\], evenly spaced in their logarithms.
fn lags(time: &[f64]) -> Vec<f64> {
    let span = time[time.len() - 1] - time[0];
    let shortest = SHORTEST * span / (time.len() - 1).max(1) as f64;
    let longest = (LONGEST * span).max(shortest);
    (0..LAGS).map(|k| shortest * (longest / shortest).powf(k as f64 / (LAGS - 1) as f64)).collect()
}

/// Amplitudes that are averaged over, in units of the channel's white noise.
const AMPLITUDES: [f64; 4] = [0.3, 1.0, 3.0, 10.0];

/// ln of the mean of e^x, each with its share.
fn log_mean_exp(values: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let most = values.clone().fold(f64::NEG_INFINITY, |m, v| m.max(v.0));
    if most == f64::NEG_INFINITY {
        return most;
    }
    most + values.map(|(v, share)| share * (v - most).exp()).sum::<f64>().ln()
}

impl Fit {
    /// Gain of ln evidence by adding functions with independent normal amplitudes of standard deviation `scale`, for each scale.
    pub(crate) fn gain(&self, columns: &DMatrix<f64>, scales: &[f64]) -> Vec<f64> {
        // the fit's own unknowns are marginalised: they have the covariance (JᵀJ + I)⁻¹
        let shared = self.jacobian.tr_mul(columns);
        let free = columns.tr_mul(columns) - shared.tr_mul(&(&self.covariance * &shared));
        let SymmetricEigen { eigenvalues, eigenvectors } = ((&free + free.transpose()) / 2.0).symmetric_eigen();
        // what is left of the fit's own gradient, where it has not quite settled, is not the functions' merit
        let unsettled = self.jacobian.tr_mul(&self.whitened) - &self.u;
        let along = eigenvectors.tr_mul(&(columns.tr_mul(&self.whitened) - shared.tr_mul(&(&self.covariance * unsettled))));
        let of = |scale: &f64| {
            eigenvalues
                .iter()
                .zip(along.iter())
                .map(|(e, g)| {
                    let m = 1.0 + scale * scale * e.max(0.0);
                    (scale * g).powi(2) / m / 2.0 - m.ln() / 2.0
                })
                .sum()
        };
        scales.iter().map(of).collect()
    }

    /// How much each structure in each channel would add to the fit, best first.
    pub(crate) fn rivals<M: ForwardModel>(&self, model: &M, records: &[usize], times_of: &[&[f64]]) -> Vec<Rival> {
        let states = || records.iter().map(|r| model.state(*r));
        let reach = Reach { level: range(states().flat_map(|s| &s.level)), rate: range(states().flat_map(|s| &s.rate)) };
        let mut rivals = Vec::new();
        for channel in 0..model.channels().len() {
            // a jump is one record's own: the others have no step then
            let found: Vec<Vec<f64>> =
                times_of.iter().zip(&self.residuals).map(|(time, residual)| jumps(time, &residual[channel])).collect();
            let jumps_of = |record: usize| -> Vec<Option<f64>> {
                let own = |(r, at): (usize, &Vec<f64>)| at.iter().map(move |at| (r == record).then_some(*at)).collect::<Vec<_>>();
                found.iter().enumerate().flat_map(own).collect()
            };
            for structure in Structure::ALL {
                let alternatives: Vec<Vec<Basis>> = records
                    .iter()
                    .enumerate()
                    .map(|(r, record)| bases(structure, times_of[r], model.state(*record), &reach, &jumps_of(r)))
                    .collect();
                let count = alternatives.iter().map(Vec::len).min().unwrap_or(0);
                let mut gains = Vec::new();
                for k in 0..count {
                    if let Some(columns) = self.columns(&alternatives, k, channel, times_of) {
                        let white = (0..records.len()).map(|r| self.noise.model(r, channel).white).fold(0.0, f64::max);
                        let scales: Vec<f64> = AMPLITUDES.iter().map(|a| a * white).collect();
                        let even = 1.0 / scales.len() as f64;
                        let gain = log_mean_exp(self.gain(&columns, &scales).into_iter().map(|g| (g, even)));
                        let at = alternatives.iter().find_map(|of_record| of_record[k].at);
                        gains.push((gain, at, alternatives[0][k].share));
                    }
                }
                let best = gains.iter().max_by(|a, b| a.0.total_cmp(&b.0));
                if let Some(&(_, at, _)) = best {
                    let gain = log_mean_exp(gains.iter().map(|g| (g.0, g.2)));
                    rivals.push(Rival { structure, channel, at, gain });
                }
            }
        }
        rivals.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        rivals
    }

    /// Whitened functions of alternative `k`, of every record one below another, in the rows of the fit's residual.
    fn columns(&self, alternatives: &[Vec<Basis>], k: usize, channel: usize, times_of: &[&[f64]]) -> Option<DMatrix<f64>> {
        let mut columns: Vec<DVector<f64>> = Vec::new();
        for f in 0..alternatives[0][k].functions.len() {
            // largest absolute value 1 over all records
            let most = alternatives.iter().filter_map(|b| b[k].functions.get(f)).flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
            if most.is_nan() || most <= 0.0 || most.is_infinite() {
                return None;
            }
            let mut column = Vec::with_capacity(self.whitened.len());
            for (record, bases) in alternatives.iter().enumerate() {
                for c in 0..self.residuals[record].len() {
                    if c == channel {
                        let series: Vec<f64> = bases[k].functions.get(f)?.iter().map(|v| v / most).collect();
                        column.extend(self.noise.whiten(record, c, &series));
                    } else {
                        column.extend(std::iter::repeat_n(0.0, self.noise.rows(record, c).len()));
                    }
                }
                debug_assert_eq!(times_of[record].len(), self.residuals[record][channel].len());
            }
            columns.push(DVector::from_vec(column));
        }
        (!columns.is_empty()).then(|| DMatrix::from_columns(&columns))
    }
}
