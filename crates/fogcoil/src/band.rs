//! Effect of the tolerances of a design on a simulation: the response to each number a standard deviation away, to first order.

mod largest;

use std::io::{self, Write};

use coil::{Drive, Mechanics, Number, propagated};
use diagnosis::{ForwardModel, expected};
use mechanisms::{Gyro, RATE, SPOOL, number_of};
use nalgebra::DMatrix;
use progress::Step;
use serde_json::{Value, json};

use crate::Error;
use crate::beside;
use crate::cache::Cache;
use crate::input::keyed;
use crate::prepare::library;
use crate::simulate::{SimulatedRow, Simulation, number, windowed};
use crate::summary::{Regression, Summary, over_time};
use crate::sweep::Spread;
use crate::table::{significant, table};

/// A simulation's band: one standard deviation of each of its results.
pub struct CourseBand {
    /// Instant \[s\], rate \[deg/h\] and its standard deviation, thermometer \[°C\] and its own, of every row.
    rows: Vec<[f64; 5]>,
    /// Standard deviation of the rate in the row in which the drawing's |rate| is largest \[deg/h\].
    pub peak: f64,
    /// Spread over units of the largest |rate| of each, in whichever row that is \[deg/h\].
    pub largest: Option<Spread>,
    /// Standard deviation of the root mean square \[deg/h\].
    pub rms: f64,
    /// Standard deviation of the slope on the thermometer's rate \[(deg/h)/(degC/min)\]; `None` if there is none.
    pub slope: Option<f64>,
    /// Shares of the variance of the rate in the row of `peak`, by the keys of the numbers, the largest first.
    pub shares: Vec<(&'static str, f64)>,
}

/// Number of shares that are printed.
const TOLD: usize = 6;

/// Effect of one standard deviation of a number on every row: thermometer and rate.
struct Change {
    number: Number,
    rows: [Vec<f64>; 2],
}

/// The band of a simulation by the tolerances of its design.
///
/// # Errors
/// [`Error`] where tolerances are not known of what drives the profile or of the design's mechanics, or the design cannot be modelled.
pub fn band(simulation: &Simulation, cache: &Cache, progress: &(dyn Fn(Step) + Sync)) -> Result<CourseBand, Error> {
    let (case, profile) = (simulation.case, simulation.profile);
    if profile.drives != [Drive::Chamber] {
        return Err(Error::usage(
            "--band: tolerances are taken of profiles with chamber_c alone; leave out the other columns, or --band",
        ));
    }
    if case.design.mechanics != Mechanics::Elastic {
        return Err(Error::usage("--band: tolerances are taken of a design whose mechanics is Elastic; leave out --band"));
    }
    let at = Error::of_coil(&case.file);
    let library = library(case, cache, progress)?;
    let gyro = beside::under(library, &[], profile).map_err(at)?;
    let changes = changes(&gyro).map_err(at)?;
    let numbers: Vec<Number> = changes.iter().map(|change| change.number).collect();
    Ok(CourseBand::of(simulation, &changes, &case.tolerances.correlation(&numbers)))
}

fn changes(gyro: &Gyro) -> Result<Vec<Change>, coil::Error> {
    let mut all = Vec::new();
    for (at, nuisance) in gyro.nuisances().iter().enumerate() {
        let Some(number) = number_of(&nuisance.parameter.name) else { continue };
        let respond = |u: f64| {
            let mut values = expected(gyro.nuisances());
            values[at] = nuisance.parameter.prior.value(u);
            gyro.respond(0, &values, &[])
        };
        let [up, down] = [beside::at_rows(&respond(1.0)?), beside::at_rows(&respond(-1.0)?)];
        let half = |channel: usize| up[channel].iter().zip(&down[channel]).map(|(a, b)| (a - b) / 2.0).collect();
        all.push(Change { number, rows: [half(SPOOL), half(RATE)] });
    }
    Ok(all)
}

impl CourseBand {
    fn of(simulation: &Simulation, changes: &[Change], correlation: &DMatrix<f64>) -> Self {
        let summary = Summary::of(simulation);
        // the summary of the simulation with one number a standard deviation away
        let changed = |change: &Change, sign: f64| {
            let row = |(n, row): (usize, SimulatedRow)| SimulatedRow {
                spool: row.spool + sign * change.rows[0][n],
                rate: row.rate + sign * change.rows[1][n],
                ..row
            };
            let rows: Vec<SimulatedRow> = simulation.rows().enumerate().map(row).collect();
            let rms = over_time(rows.iter().map(|row| (row.time, row.rate)));
            let slope = Regression::of(windowed(rows[0], rows.iter().skip(1).copied())).slope();
            (rms, slope.unwrap_or(0.0))
        };
        let half = |change: &Change| {
            let [up, down] = [changed(change, 1.0), changed(change, -1.0)];
            ((up.0 - down.0) / 2.0, (up.1 - down.1) / 2.0)
        };
        let (rms, slope): (Vec<f64>, Vec<f64>) = changes.iter().map(half).unzip();
        let at = |channel: usize, n: usize| changes.iter().map(|c| c.rows[channel][n]).collect::<Vec<f64>>();
        let sd = |changes: &[f64]| propagated(changes, correlation).0;
        let of_row = |(n, row): (usize, SimulatedRow)| [row.time, row.rate, sd(&at(1, n)), row.spool, sd(&at(0, n))];
        let peak = simulation.rows().position(|row| row.time == summary.peak.time).unwrap_or(0);
        let rates: Vec<f64> = simulation.rows().map(|row| row.rate).collect();
        let by_rate: Vec<&[f64]> = changes.iter().map(|change| change.rows[1].as_slice()).collect();
        let (at_peak, of_numbers) = propagated(&at(1, peak), correlation);
        let key = |number: Number| keyed(number, &simulation.case.design).map(|(key, _)| key);
        let mut shares: Vec<(&'static str, f64)> =
            changes.iter().zip(of_numbers).filter_map(|(change, share)| Some((key(change.number)?, share))).collect();
        shares.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        Self {
            rows: simulation.rows().enumerate().map(of_row).collect(),
            peak: at_peak,
            largest: largest::largest(&rates, &by_rate, correlation),
            rms: sd(&rms),
            slope: summary.slope.map(|_| sd(&slope)),
            shares,
        }
    }

    /// The rate of a row and its standard deviation \[deg/h\].
    ///
    /// # Panics
    /// If the simulation has no such row.
    pub fn rate(&self, row: usize) -> [f64; 2] {
        [self.rows[row][1], self.rows[row][2]]
    }

    /// The thermometer of a row and its standard deviation \[°C\].
    ///
    /// # Panics
    /// If the simulation has no such row.
    pub fn spool(&self, row: usize) -> [f64; 2] {
        [self.rows[row][3], self.rows[row][4]]
    }

    /// The band as one JSON object: one standard deviation each, and the spread of the largest |rate|.
    pub fn json(&self) -> Value {
        let shares = self.shares.iter().map(|(key, share)| json!({"key": key, "share": share}));
        let largest = self.largest.as_ref().map(|Spread { mean, sd, quantiles: [_, p05, p50, p95, _], .. }| {
            json!({"mean": mean, "sd": sd, "p05": p05, "p50": p50, "p95": p95})
        });
        json!({
            "peak_deg_per_h": self.peak,
            "largest_deg_per_h": largest,
            "rms_deg_per_h": self.rms,
            "slope": self.slope,
            "shares_at_peak": shares.collect::<Vec<_>>(),
        })
    }

    /// The band as text.
    pub fn text(&self) -> String {
        let line = |name: &str, value: String, unit: &str| vec![name.to_owned(), value, unit.to_owned()];
        let mut rows = vec![
            line("by the design's tolerances (1 sigma, linear)", String::new(), ""),
            line("  rate in the row of the drawing's largest |rate|", format!("± {}", significant(self.peak, 2)), "deg/h"),
            line("  root mean square of the rate", format!("± {}", significant(self.rms, 2)), "deg/h"),
        ];
        rows.extend(self.slope.map(|slope| line("  slope", format!("± {}", significant(slope, 2)), "(deg/h)/(degC/min)")));
        let share = |(key, share): &(&str, f64)| {
            line(&format!("    {key}"), format!("{:.0} %", 100.0 * share), "of the variance of the rate in that row")
        };
        rows.splice(2..2, self.shares.iter().take(TOLD).map(share));
        if let Some(Spread { mean, sd, quantiles: [_, p05, _, p95, _], .. }) = &self.largest {
            let [mean, p05, p95] = [mean, p05, p95].map(|value| significant(*value, 3));
            rows.push(line("largest |rate| of a unit, mean over units", format!("{mean} ± {}", significant(*sd, 2)), "deg/h"));
            rows.push(line("  of nine units in ten", format!("{p05} to {p95}"), "deg/h"));
        }
        table(&rows)
    }

    /// Writes `time_s,rate_deg_per_h,rate_sd_deg_per_h,spool_c,spool_sd_c`.
    ///
    /// # Errors
    /// The error of `out`.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "time_s,rate_deg_per_h,rate_sd_deg_per_h,spool_c,spool_sd_c")?;
        self.rows.iter().try_for_each(|row| writeln!(out, "{}", row.map(number).join(",")))
    }
}
