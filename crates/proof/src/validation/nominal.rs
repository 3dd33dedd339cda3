//! Five profiles in time, against the response that an independent finite-element code computes for the same coil.

use super::fixtures::Fixtures;
use super::row::{Agreement, ComparisonRow, Section, timed};
use crate::{Failure, files};
use bias::units::{DEG_PER_H_PER_RAD_PER_S, K_PER_MIN_PER_K_PER_S};
use coil::{Drive, Dynamics, FINE, Fidelity, Profile, SAFETY, STANDARD};

const PROFILES: [&str; 5] = ["P1", "P2", "P3", "P4", "P5"];
/// Largest difference that the two discretisations explain, % of the channel's peak.
const TOLERANCE: f64 = 0.3;
/// Parts of a row for the cubic.
const PARTS: usize = 6;
/// Columns that are compared: thermometer, three parts of the bias, their sum.
const CHANNELS: [&str; 5] = ["spool_c", "shupe_deg_per_h", "eo_axial_deg_per_h", "eo_radial_deg_per_h", "rate_deg_per_h"];
const SPOOL: usize = 0;
const RATE: usize = 4;

type Channels = [Vec<f64>; CHANNELS.len()];

struct Record {
    profile: Profile,
    channels: Channels,
}

fn read(name: &str) -> Result<Record, Failure> {
    let file = format!("fixtures/nominal/{name}.csv");
    let bad = |problem: String| Failure(format!("{file}: {problem}"));
    let text = files::read(&files::root().join(&file))?;
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
    let rows: Vec<Vec<f64>> = lines
        .map(|line| line.split(',').map(str::parse).collect::<Result<_, _>>().map_err(|e| bad(format!("{line}: {e}"))))
        .collect::<Result<_, _>>()?;
    let column = |name: &str| -> Result<Vec<f64>, Failure> {
        let k = header.iter().position(|h| *h == name).ok_or_else(|| bad(format!("there is no column {name}")))?;
        rows.iter().map(|row| row.get(k).copied().ok_or_else(|| bad(format!("a row has no {name}")))).collect()
    };
    let mut channels = Channels::default();
    for (values, name) in channels.iter_mut().zip(CHANNELS) {
        *values = column(name)?;
    }
    Ok(Record { profile: Profile { time: column("time_s")?, drives: vec![column("chamber_c")?] }, channels })
}

/// The channels at the record's rows, from `parts` steps each.
fn run(dynamics: &Dynamics, profile: &Profile, parts: usize) -> Result<Channels, Failure> {
    let responses = dynamics.simulate(&profile.smoothed(parts))?;
    let first = responses.first().map_or(0.0, |r| r.sensor);
    let mut channels: Channels = [vec![first], vec![0.0], vec![0.0], vec![0.0], vec![0.0]];
    for row in responses.get(1..).unwrap_or_default().chunks(parts) {
        let sum = row.iter().fold(bias::Bias::ZERO, |sum, r| sum + r.bias);
        let mean = sum * (DEG_PER_H_PER_RAD_PER_S / row.len() as f64);
        let sensor = row[row.len() - 1].sensor;
        for (channel, value) in channels.iter_mut().zip([sensor, mean.shupe, mean.eo_axial, mean.eo_radial, mean.total()]) {
            channel.push(value);
        }
    }
    Ok(channels)
}

/// A difference in % of the channel's peak excursion.
struct Difference {
    largest: f64,
    rms: f64,
    at: usize,
    peak: f64,
}

fn difference(ours: &[f64], theirs: &[f64]) -> Difference {
    let peak = theirs.iter().map(|v| (v - theirs[0]).abs()).fold(0.0, f64::max);
    let off: Vec<f64> = ours.iter().zip(theirs).map(|(a, b)| 100.0 * (a - b).abs() / peak).collect();
    let at = (0..off.len()).max_by(|&a, &b| off[a].total_cmp(&off[b])).unwrap_or(0);
    Difference { largest: off[at], rms: (off.iter().map(|e| e * e).sum::<f64>() / off.len() as f64).sqrt(), at, peak }
}

/// The factor on each part of `ours` that fits `theirs` best, and what the sum then differs by.
fn fitted(ours: &Channels, theirs: &Channels) -> ([f64; 3], Difference) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let gains = [1, 2, 3].map(|k| dot(&ours[k], &theirs[k]) / dot(&ours[k], &ours[k]));
    let scaled = |n: usize| (0..3).map(|k| gains[k] * ours[k + 1][n]).sum::<f64>();
    let sum: Vec<f64> = (0..ours[RATE].len()).map(scaled).collect();
    (gains, difference(&sum, &theirs[RATE]))
}

/// Change of the chamber's rate over the row before `n` and the row after it \[K/min\].
fn turn(profile: &Profile, n: usize) -> f64 {
    let rate = |n: usize| (profile.drives[0][n] - profile.drives[0][n - 1]) / (profile.time[n] - profile.time[n - 1]);
    let last = profile.time.len() - 1;
    ((rate((n + 1).min(last)) - rate(n.saturating_sub(1).max(1))) * K_PER_MIN_PER_K_PER_S).abs()
}

fn row(id: String, quantity: String, value: f64, numerical_error: f64) -> ComparisonRow {
    let unit = format!("% of the peak (limit {TOLERANCE})");
    ComparisonRow::shown([&id, &quantity, &unit], value, numerical_error, Agreement::Verified)
}

pub(crate) fn nominal(fixtures: &Fixtures) -> Result<Section, Failure> {
    let mut section = Section::new("Against an independent code");
    section.note(format!(
        "The reference coil under five chamber profiles (fixtures/nominal), computed by an independent finite-element code with quadratic \
         elements: synthesised, not measured. Differences are relative to the channel's peak excursion in the profile. Agreement to {TOLERANCE} % \
         is enough: that code's discretisation alone shifts its sensitivity by about 0.15 %. The chamber is read as linear between rows, as \
         `simulate` does, or as the cubic of `Profile::smoothed`, {PARTS} parts a row: at a turn the true course is smooth and the straight lines \
         are not. Must hold: the thermometer at its worst and the rate in the root mean square; the rate's largest difference, which a \
         single row at a turn of the chamber decides, holds or differs. The numerical error is {SAFETY} times the change on the mesh that \
         measures errors: where it is as large as what exceeds the limit, this program's own mesh is part of the reason. Gains are fitted, \
         one a part, for diagnosis only."
    ));
    let model = |resolution| Dynamics::new(&fixtures.coil, &[Drive::Chamber], &Fidelity { resolution, ..STANDARD });
    let (standard, fine) = (model(STANDARD.resolution)?, model(FINE)?);
    let ((), seconds) = timed(|| -> Result<(), Failure> {
        for name in PROFILES {
            compare(name, &standard, &fine, &mut section)?;
        }
        Ok(())
    })?;
    section.timings.push(format!("{} profiles, both courses, both meshes: {seconds:.1} s", PROFILES.len()));
    Ok(section)
}

fn compare(name: &str, standard: &Dynamics, fine: &Dynamics, section: &mut Section) -> Result<(), Failure> {
    let record = read(name)?;
    let (profile, theirs) = (&record.profile, &record.channels);
    for (course, parts) in [("linear", 1), ("cubic", PARTS)] {
        let (ours, finer) = (run(standard, profile, parts)?, run(fine, profile, parts)?);
        let of = |channel: usize| {
            let numerical = difference(&ours[channel], &finer[channel]);
            (difference(&ours[channel], &theirs[channel]), [numerical.largest, numerical.rms].map(|e| SAFETY * e))
        };
        if parts == 1 {
            let (spool, errors) = of(SPOOL);
            let quantity = format!("{name}: thermometer, largest difference");
            let reason = format!("rms {:.3} %; peak {:.1} K; the course between rows has no part in it", spool.rms, spool.peak);
            let row = row(format!("N.{name}.spool"), quantity, spool.largest, errors[0]);
            section.rows.push(row.required(spool.largest <= TOLERANCE).because(reason));
        }
        let (rate, errors) = of(RATE);
        if parts == 1 {
            let quantity = format!("{name}: rate, rms difference, {course}");
            let row = row(format!("N.{name}.rate.rms"), quantity, rate.rms, errors[1]);
            section.rows.push(row.required(rate.rms <= TOLERANCE).because(format!("peak {:.3} deg/h", rate.peak)));
        }
        let ([shupe, axial, radial], rest) = fitted(&ours, theirs);
        let (at, turn, Difference { largest, rms, .. }) = (profile.time[rate.at], turn(profile, rate.at), rest);
        let reason = format!(
            "rms {:.3} %; at {at} s, where the chamber's rate turns by {turn:.2} K/min; fitted gains {shupe:.4} (Shupe), {axial:.4} (EO axial), \
             {radial:.4} (EO radial) leave {largest:.3} % (rms {rms:.3} %)",
            rate.rms
        );
        let quantity = format!("{name}: rate, largest difference, {course}");
        let row = row(format!("N.{name}.rate.{course}"), quantity, rate.largest, errors[0]);
        let row = if parts == 1 {
            row.compared(rate.largest <= TOLERANCE, reason)
        } else {
            row.required(rate.largest <= TOLERANCE).because(reason)
        };
        section.rows.push(row);
    }
    Ok(())
}
