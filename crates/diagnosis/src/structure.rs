//! Families of functions of the state, for effects that no mechanism of the library explains.

use crate::State;
use recording::condition::slopes;

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
    /// An effect that accumulates with time or with the changes of the level.
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
}

pub(crate) fn range<'a>(x: impl Iterator<Item = &'a f64>) -> [f64; 2] {
    x.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, h], v| [l.min(*v), h.max(*v)])
}

/// Ranges that all records together cover.
pub(crate) struct Reach {
    pub(crate) level: [f64; 2],
    pub(crate) rate: [f64; 2],
    /// Duration of the longest \[s\], and of all together.
    pub(crate) longest: f64,
    pub(crate) together: f64,
}

/// An instant \[s\] at which a step is tried in a record, none where the step is in another record, and its share of the probability.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Jump {
    pub(crate) at: Option<f64>,
    pub(crate) share: f64,
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
pub(crate) struct Basis {
    pub(crate) at: Option<f64>,
    /// Share of the structure's probability.
    pub(crate) share: f64,
    pub(crate) functions: Vec<Vec<f64>>,
}

fn one(functions: Vec<Vec<f64>>) -> Vec<Basis> {
    vec![Basis { at: None, share: 1.0, functions }]
}

/// 0 before an instant, 1 from it on.
fn step_at(time: &[f64], at: f64) -> Vec<f64> {
    time.iter().map(|t| if *t >= at { 1.0 } else { 0.0 }).collect()
}

/// Alternatives of a structure; its evidence is their mean by their shares. Steps are tried at the `jumps`.
pub(crate) fn bases(structure: Structure, time: &[f64], state: &State, reach: &Reach, jumps: &[Jump]) -> Vec<Basis> {
    let (level, rate) = (&state.level, &state.rate);
    let range = reach.level[1] - reach.level[0];
    match structure {
        Structure::PeriodicInLevel => {
            if range.is_nan() || range <= 0.0 {
                return Vec::new();
            }
            // a record resolves cycles over its range evenly; beforehand a period may be anything in its logarithm
            let cycles = || (0..=CYCLES_STEPS).map(|k| FEWEST_CYCLES + k as f64 / STEPS_A_CYCLE);
            let all: f64 = cycles().map(f64::recip).sum();
            cycles()
                .map(|cycles| {
                    let period = range / cycles;
                    let wave = |shift: f64| -> Vec<f64> {
                        level.iter().map(|l| (std::f64::consts::TAU * l / period + shift).sin()).collect()
                    };
                    let functions = vec![wave(0.0), wave(std::f64::consts::FRAC_PI_2)];
                    Basis { at: Some(period), share: 1.0 / cycles / all, functions }
                })
                .collect()
        }
        Structure::Level => one(hats(level, reach.level, 9)),
        Structure::RateByLevel => one(hats(level, reach.level, 7).iter().map(|h| times(h, rate)).collect()),
        Structure::Rate => one(hats(rate, reach.rate, 7)),
        Structure::History => one(lags(reach.longest).iter().map(|tau| follow(time, rate, *tau)).collect()),
        Structure::Acceleration => one(vec![slopes(time, rate)]),
        Structure::Direction => {
            let most = reach.rate[0].abs().max(reach.rate[1].abs());
            let direction: Vec<f64> = rate.iter().map(|r| (r / (0.02 * most).max(f64::MIN_POSITIVE)).tanh()).collect();
            one(hats(level, reach.level, 4).iter().map(|h| times(h, &direction)).collect())
        }
        Structure::Step => {
            let step = |Jump { at, share }: &Jump| Basis {
                at: *at,
                share: *share,
                functions: vec![step_at(time, at.unwrap_or(f64::INFINITY))],
            };
            jumps.iter().map(step).collect()
        }
        Structure::Accumulation => {
            let mut wandered = 0.0;
            let wander = (0..time.len())
                .map(|n| {
                    wandered += if n > 0 { (level[n] - level[n - 1]).abs() } else { 0.0 };
                    wandered
                })
                .collect();
            let settling = |tau: f64| time.iter().map(|t| (-(t - time[0]) / (tau * reach.longest)).exp()).collect();
            one(vec![wander, time.iter().map(|t| t - time[0]).collect(), settling(0.1), settling(0.3)])
        }
    }
}

/// Cycles over the range of the levels that are tried, from the fewest on: a third of a cycle apart a sine between two of them keeps nine tenths of its
/// power, sinc²(1/6).
const FEWEST_CYCLES: f64 = 2.0;
const STEPS_A_CYCLE: f64 = 3.0;
const CYCLES_STEPS: usize = 84;
/// Even stretches of a record between which a step is tried.
const STEPS: usize = 48;
/// Number of a residual's jumps at which a step is tried besides.
const JUMPS: usize = 6;
/// Stretch that is compared before and after a jump \[s\], and the fewest rows of it.
const BESIDE_JUMP: f64 = 300.0;
const FEWEST_BESIDE: usize = 3;
/// Stretch of time for which a jump stands \[s\], if a row is not longer: a step may be anywhere.
const JUMP: f64 = 60.0;

/// Instants at which a step may be, of every record: half of the probability evenly in time, half on all instants, of which those are tried at which the
/// residuals jump most. A step is one record's own: for each of them, all alternatives.
pub(crate) fn steps(times: &[&[f64]], residuals: &[&[f64]], reach: &Reach) -> Vec<Vec<Jump>> {
    let mut own: Vec<(usize, f64, f64)> = Vec::new();
    for (record, (time, residual)) in times.iter().zip(residuals).enumerate() {
        let (Some(first), Some(last)) = (time.first(), time.last()) else { continue };
        let even = 0.5 * (last - first) / reach.together / (STEPS - 1) as f64;
        own.extend((1..STEPS).map(|k| (record, first + (last - first) * k as f64 / STEPS as f64, even)));
        let stretch = recording::median_interval(time).map_or(JUMP, |row| row.max(JUMP));
        own.extend(jumps(time, residual).into_iter().map(|at| (record, at, 0.5 * stretch / reach.together)));
    }
    let of = |record: usize| own.iter().map(move |&(r, at, share)| Jump { at: (r == record).then_some(at), share }).collect();
    (0..times.len()).map(of).collect()
}

/// Instants at which a series changes most between the rows before and the rows after, apart from each other by as many; NaN is left out.
fn jumps(time: &[f64], series: &[f64]) -> Vec<f64> {
    let beside = recording::median_interval(time).map_or(FEWEST_BESIDE, |rows| (BESIDE_JUMP / rows).round() as usize);
    let beside = beside.max(FEWEST_BESIDE);
    let used: Vec<usize> = (0..series.len()).filter(|n| series[*n].is_finite()).collect();
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(used.iter().scan(0.0, |sum, n| {
            *sum += series[*n];
            Some(*sum)
        }))
        .collect();
    let mut found: Vec<(usize, f64)> = (beside..used.len().saturating_sub(beside))
        .map(|k| (k, (sums[k + beside] - 2.0 * sums[k] + sums[k - beside]).abs()))
        .collect();
    found.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut chosen: Vec<usize> = Vec::new();
    for (k, _) in found {
        if chosen.len() < JUMPS && chosen.iter().all(|c| c.abs_diff(k) >= beside) {
            chosen.push(k);
        }
    }
    chosen.iter().map(|k| time[used[*k]]).collect()
}

/// Number of time constants of the history, the shortest and the longest as shares of the longest record.
const LAGS: usize = 5;
const SHORTEST: f64 = 0.0025;
const LONGEST: f64 = 0.3;

/// Time constants of the history \[s\], evenly spaced in their logarithms.
fn lags(longest: f64) -> Vec<f64> {
    let of = |k: usize| SHORTEST * longest * (LONGEST / SHORTEST).powf(k as f64 / (LAGS - 1) as f64);
    (0..LAGS).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_hats_add_up_to_one_and_peak_in_turn() {
        let x: Vec<f64> = (0..=60).map(|n| -2.0 + 5.0 * f64::from(n) / 60.0).collect();
        let hats = hats(&x, [-2.0, 3.0], 6);
        assert_eq!(hats.len(), 6);
        (0..x.len()).for_each(|n| assert!((hats.iter().map(|hat| hat[n]).sum::<f64>() - 1.0).abs() < 1e-12));
        (0..6).for_each(|k| assert!((hats[k][12 * k] - 1.0).abs() < 1e-12));
        // of a level that never moves there are none
        assert!(super::hats(&x, [1.0, 1.0], 6).is_empty());
    }

    #[test]
    fn exact_jumps_are_where_a_series_changes_the_largest_first() {
        let time: Vec<f64> = (0..400).map(|n| 100.0 + 30.0 * f64::from(n)).collect();
        let mut series: Vec<f64> =
            (0..400).map(|n| 5.0 + if n >= 120 { 1.0 } else { 0.0 } - if n >= 300 { 3.0 } else { 0.0 }).collect();
        series[50] = f64::NAN;
        let found = jumps(&time, &series);
        assert_eq!(found[..2], [time[300], time[120]], "{found:?}");
    }

    #[test]
    fn exact_what_accumulates_grows_and_what_settles_falls() {
        let time: Vec<f64> = (0..101).map(|n| 500.0 + 10.0 * f64::from(n)).collect();
        let level: Vec<f64> = (0..101).map(|n| (f64::from(n) / 8.0).sin()).collect();
        let state = State { rate: vec![0.0; level.len()], level };
        let reach = Reach { level: [-1.0, 1.0], rate: [0.0; 2], longest: 1000.0, together: 1000.0 };
        let all = bases(Structure::Accumulation, &time, &state, &reach, &[]);
        let [Basis { at: None, share: 1.0, functions }] = &all[..] else { panic!("one set of functions") };
        let [wandered, elapsed, fast, slow] = &functions[..] else { panic!("four functions") };
        let way: f64 = state.level.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
        assert!((wandered[100] - way).abs() < 1e-12 && wandered[0] == 0.0 && wandered.is_sorted(), "{wandered:?}");
        assert_eq!((elapsed[0], elapsed[100]), (0.0, 1000.0));
        for (settling, after) in [(fast, 100.0), (slow, 300.0)] {
            let at = |t: f64| settling[(t / 10.0) as usize];
            assert!((at(0.0) - 1.0).abs() < 1e-12 && (at(after) - (-1.0_f64).exp()).abs() < 1e-12, "{settling:?}");
            assert!((at(2.0 * after) - (-2.0_f64).exp()).abs() < 1e-12);
        }
    }

    #[test]
    fn exact_steps_are_tried_evenly_in_every_record_wherever_its_clock_begins() {
        let clock = |begins: f64, rows: u32| (0..rows).map(|n| begins + 10.0 * f64::from(n)).collect::<Vec<_>>();
        // 4800 s and 9600 s; of a residual of a single row there are no jumps
        let times = [clock(1000.0, 481), clock(-700.0, 961)];
        let reach = Reach { level: [0.0; 2], rate: [0.0; 2], longest: 9600.0, together: 14_400.0 };
        let found = steps(&[&times[0], &times[1]], &[&[0.0], &[0.0]], &reach);
        assert!(found.len() == 2 && found.iter().all(|of_record| of_record.len() == 2 * 47));
        for k in 0..47 {
            let after = f64::from(k as u32 + 1);
            let [first, second] = [found[0][k], found[1][47 + k]];
            assert_eq!((first.at, second.at), (Some(1000.0 + 100.0 * after), Some(-700.0 + 200.0 * after)));
            // it is in one of them
            assert_eq!((found[1][k].at, found[0][47 + k].at), (None, None));
            assert!((second.share / first.share - 2.0).abs() < 1e-12);
        }
        let together: f64 = found[0].iter().map(|jump| jump.share).sum();
        assert!((together - 0.5).abs() < 1e-12, "{together}");
    }

    #[test]
    fn nothing_is_periodic_in_a_level_that_never_moves() {
        let time = [0.0, 10.0, 20.0];
        let state = State { level: vec![20.0; 3], rate: vec![0.0; 3] };
        let of = |level: [f64; 2]| {
            let reach = Reach { level, rate: [0.0; 2], longest: 20.0, together: 20.0 };
            bases(Structure::PeriodicInLevel, &time, &state, &reach, &[]).len()
        };
        assert_eq!((of([20.0, 20.0]), of([f64::NAN, 20.0]), of([15.0, 20.0])), (0, 0, CYCLES_STEPS + 1));
    }
}
