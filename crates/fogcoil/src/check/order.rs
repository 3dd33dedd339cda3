//! Which of two thermometers moves first: the spool follows the chamber.

use files::{Note, Remark};
use recording::condition::{bridged, span};
use recording::lag::lagging;

use super::lags::lags;
use crate::input::{CHAMBER, RecordCase, SPOOL};

/// Share of their difference that a follower with one time constant leaves where one thermometer follows the other, and that which no time constant
/// takes away the other way round.
const FOLLOWS: f64 = 0.5;
const NEVER: f64 = 0.95;
/// Noises of a reading that the difference has to exceed.
const SEEN: f64 = 5.0;

/// A warning where the chamber's readings follow the spool's.
pub(super) fn spool_first(case: &RecordCase) -> Option<Note> {
    let used = case.report.used(&case.recording);
    let time = used.time();
    let values = |name| bridged(time, &used.channel(name)?.values);
    let (chamber, spool) = (values(CHAMBER)?, values(SPOOL)?);
    let noise = [CHAMBER, SPOOL].iter().filter_map(|name| case.report.channels[case.number(name)?].noise).fold(0.0, f64::max);
    let interval = case.report.instants.as_ref()?.interval;
    let apart = off(&spool, &chamber);
    if apart <= SEEN * noise || span(&chamber) == 0.0 {
        return None;
    }
    let follows = |follower: &[f64], leader: &[f64]| {
        let behind = |lag: f64| {
            let ahead = lagging(time, leader, lag);
            off(follower, &leader.iter().zip(ahead).map(|(x, by)| x - by).collect::<Vec<_>>())
        };
        let duration = time.last().zip(time.first()).map_or(0.0, |(last, first)| last - first);
        lags(interval, duration, time.len()).into_iter().map(behind).fold(f64::INFINITY, f64::min) / apart
    };
    (follows(&chamber, &spool) < FOLLOWS && follows(&spool, &chamber) > NEVER).then(|| {
        Remark::SpoolFirst.warning(format!(
            "{CHAMBER} follows {SPOOL}, which a chamber does not do: are the two exchanged, or is the chamber's thermometer the slower one?"
        ))
    })
}

/// Root mean square of the difference of two courses, but for a constant.
fn off(a: &[f64], b: &[f64]) -> f64 {
    let differences: Vec<f64> = a.iter().zip(b).map(|(a, b)| a - b).collect();
    let mean = differences.iter().sum::<f64>() / differences.len().max(1) as f64;
    (differences.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / differences.len().max(1) as f64).sqrt()
}
