//! Summary of a simulation: peak, root mean square, and the slope on the thermometer's rate beside the steady sensitivity.

use coil::{Mechanics, SAFETY};
use recording::Seconds;
use serde_json::{Value, json};

use crate::cache::Source;
use crate::input::Inference;
use crate::simulate::{SimulatedRow, Simulation, WINDOW_S, Window};
use crate::table::{significant, table};
use crate::units::DurationUnit;

/// The numbers of a simulation that matter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Number of rows.
    pub rows: usize,
    /// Duration from the first to the last instant \[s\].
    pub duration: f64,
    /// Lowest and highest temperature of the chamber \[°C\].
    pub chamber: [f64; 2],
    /// Lowest and highest temperature of the thermometer \[°C\].
    pub spool: [f64; 2],
    /// The row with the largest |rate|.
    pub peak: SimulatedRow,
    /// Root of the mean over time of the squared rate \[deg/h\].
    pub rms: f64,
    /// Slope of the regression of the rate on the thermometer's rate over windows of [`WINDOW_S`], with intercept
    /// \[(deg/h)/(degC/min)\]; `None` if the thermometer's rate does not vary.
    pub slope: Option<f64>,
    /// Numerical errors of the above.
    pub errors: Errors,
    /// Recorded less simulated thermometer \[K\] and rate \[deg/h\], where the profile is a recording with these.
    pub left: [Option<Left>; 2],
}

/// Recorded less simulated values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Left {
    /// Their mean: an offset, Earth's rate.
    pub mean: f64,
    /// Root mean square about it.
    pub rms: f64,
}

impl Left {
    /// Of the values that are numbers; `None` if there is none.
    fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let rms = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt();
        (count > 0.0).then_some(Self { mean, rms })
    }

    fn json(self) -> Value {
        json!({ "mean": self.mean, "rms_about_mean": self.rms })
    }
}

/// Least error of the thermometer that is stated, relative to the range of the chamber or its own: rounding and fast modes, of which two meshes and two numbers of
/// modes say nothing. In `cargo xtask survey` up to 1e-7.
const LEAST: f64 = 3e-7;

/// Estimated numerical errors of a simulation at its given chamber: [`SAFETY`] times the distance to the same run on a coarser mesh, of the sum that
/// of its parts together; the error of the steady ramp at the thermometer's rate, which sees the elements' grading, too; and the error of the reduced
/// model. They do not include errors of the model itself.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Errors {
    /// Error of the thermometer in any row \[K\].
    pub spool: f64,
    /// Errors of the bias in any row: thermal phase, axial strain, radial strain, read-out, their sum \[deg/h\].
    pub parts: [f64; 5],
    /// Error of the root mean square \[deg/h\].
    pub rms: f64,
    /// Error of the slope \[(deg/h)/(degC/min)\]; `None` if there is none.
    pub slope: Option<f64>,
}

impl Errors {
    /// Errors of a simulation in this range of temperatures \[K\], with these rates \[deg/h\] and this regression.
    fn of(simulation: &Simulation, range: f64, rms: f64, peak: f64, regression: &Regression) -> Self {
        let mut errors = Self::default();
        for row in simulation.differences() {
            errors.spool = errors.spool.max(SAFETY * row.spool.abs());
            for (most, part) in errors.parts.iter_mut().zip(row.parts().into_iter().chain([apart(&row)])) {
                *most = most.max(SAFETY * part.abs());
            }
        }
        let rates =
            simulation.rows().zip(simulation.rows().skip(1)).map(|(a, b)| ((b.chamber - a.chamber) / (b.time - a.time)).abs());
        errors.spool += simulation.reduction.sensor * rates.fold(0.0, f64::max) + LEAST * range;
        // what the modes leave out of the bias is stated of the sum's peak
        let reduced = simulation.reduction.bias;
        for (n, most) in errors.parts.iter_mut().enumerate() {
            *most += if n == READ_OUT { 0.0 } else { reduced * peak };
        }
        let steady = &simulation.steady.part_errors;
        let fastest = simulation.windows().fold(0.0, |most: f64, window| most.max(window.spool_rate.abs()));
        let in_ramp = [steady.shupe, steady.eo_axial, steady.eo_radial, 0.0, simulation.steady.error_estimate];
        for (most, error) in errors.parts.iter_mut().zip(in_ramp) {
            *most += error * fastest;
        }
        let ramps = over_time(simulation.windows().map(|window| (window.time, window.spool_rate)));
        errors.rms = SAFETY * over_time(simulation.differences().map(|row| (row.time, apart(&row))))
            + simulation.steady.error_estimate * ramps
            + reduced * rms;
        let coarser = Regression::of(simulation.coarser_windows());
        errors.slope = regression.slope().zip(coarser.slope()).map(|(slope, other)| {
            // the modes' errors, however they lie, turn the line by no more than their rms over that of its abscissa
            SAFETY * (slope - other).abs()
                + simulation.steady.error_estimate
                + reduced * rms / (regression.xx / regression.count).sqrt()
        });
        errors
    }
}

/// Distance of two meshes, part by part: the parts' errors may cancel in the sum on one mesh and not on another.
fn apart(difference: &SimulatedRow) -> f64 {
    difference.parts().iter().map(|part| part.abs()).sum()
}

/// Root of the mean over time of a squared course, each value the mean since the one before; 0 without a duration.
pub(crate) fn over_time(course: impl Iterator<Item = (f64, f64)>) -> f64 {
    let (mut first, mut last, mut squares) = (None, 0.0, 0.0);
    for (time, value) in course {
        squares += value * value * if first.is_some() { time - last } else { 0.0 };
        first.get_or_insert(time);
        last = time;
    }
    let duration = last - first.unwrap_or(last);
    if duration > 0.0 { (squares / duration).sqrt() } else { 0.0 }
}

/// Index of the read-out in [`Errors::parts`]; it follows the thermometer, no strain.
const READ_OUT: usize = 3;

/// Least-squares line through points that come one by one (Welford's update).
#[derive(Default)]
pub(crate) struct Regression {
    count: f64,
    mean: [f64; 2],
    xx: f64,
    xy: f64,
}

/// Rates of the thermometer that spread less than this \[degC/min\] are rounding, not a course.
const STILL: f64 = 1e-9;

impl Regression {
    /// Regression of the rate on the thermometer's rate.
    pub(crate) fn of(windows: impl Iterator<Item = Window>) -> Self {
        let mut regression = Self::default();
        windows.for_each(|window| regression.add(window.spool_rate, window.rate));
        regression
    }

    /// Adds a pair to it.
    pub(crate) fn add(&mut self, x: f64, y: f64) {
        self.count += 1.0;
        let (dx, dy) = (x - self.mean[0], y - self.mean[1]);
        self.mean[0] += dx / self.count;
        self.mean[1] += dy / self.count;
        self.xx += dx * (x - self.mean[0]);
        self.xy += dx * (y - self.mean[1]);
    }

    pub(crate) fn slope(&self) -> Option<f64> {
        (self.xx > self.count * STILL * STILL).then(|| self.xy / self.xx)
    }

    /// y where x vanishes, the mean of y where x stands still; `None` without a pair.
    pub(crate) fn intercept(&self) -> Option<f64> {
        (self.count > 0.0).then(|| self.mean[1] - self.slope().unwrap_or(0.0) * self.mean[0])
    }
}

impl Summary {
    /// Summary of a simulation.
    pub fn of(simulation: &Simulation) -> Self {
        let first = simulation.row(0);
        let (mut chamber, mut spool) = ([first.chamber; 2], [first.spool; 2]);
        let mut peak = first;
        let widen = |range: &mut [f64; 2], value: f64| *range = [range[0].min(value), range[1].max(value)];
        for row in simulation.rows() {
            widen(&mut chamber, row.chamber);
            widen(&mut spool, row.spool);
            if row.rate.abs() > peak.rate.abs() {
                peak = row;
            }
        }
        let regression = Regression::of(simulation.windows());
        let duration = simulation.duration();
        let rms = over_time(simulation.rows().map(|row| (row.time, row.rate)));
        let slope = regression.slope();
        let range = [chamber, spool].map(|[low, high]| high - low).into_iter().fold(0.0, f64::max);
        let errors = Errors::of(simulation, range, rms, peak.rate.abs(), &regression);
        // the first row has no rate of its own
        let left = [
            Left::of(simulation.rows().map(|row| row.recorded[0] - row.spool)),
            Left::of(simulation.rows().skip(1).map(|row| row.recorded[1] - row.rate)),
        ];
        Self { rows: simulation.count(), duration, chamber, spool, peak, rms, slope, errors, left }
    }
}

/// The summary as one object, units in the keys; `slope` and sensitivities in (deg/h)/(degC/min).
pub fn json(simulation: &Simulation) -> Value {
    let Summary { rows, duration, chamber, spool, peak, rms, slope, errors, left } = Summary::of(simulation);
    let [shupe, eo_axial, eo_radial, read_out, rate] = errors.parts;
    let [left_spool, left_rate] = left.map(|left| left.map(Left::json));
    let steady = simulation.steady;
    let mut object = json!({
        "rows": rows,
        "duration_s": duration,
        "chamber_c": chamber,
        "spool_c": spool,
        "peak": {
            "time_s": peak.time,
            "shupe_deg_per_h": peak.shupe,
            "eo_axial_deg_per_h": peak.eo_axial,
            "eo_radial_deg_per_h": peak.eo_radial,
            "read_out_deg_per_h": peak.read_out + 0.0,
            "mechanisms_deg_per_h": peak.mechanisms,
            "rate_deg_per_h": peak.rate,
        },
        "rms_deg_per_h": rms,
        "slope": slope,
        "slope_window_s": WINDOW_S,
        "steady_sensitivity": steady.sensitivity.total(),
        "steady_sensitivity_error_estimate": steady.error_estimate,
        "numerical_error": {
            "spool_k": errors.spool,
            "shupe_deg_per_h": shupe,
            "eo_axial_deg_per_h": eo_axial,
            "eo_radial_deg_per_h": eo_radial,
            "read_out_deg_per_h": read_out,
            "rate_deg_per_h": rate,
            "rms_deg_per_h": errors.rms,
            "slope": errors.slope,
        },
        "reduction_error": simulation.reduction.bias,
        "inferred": simulation.profile.inferred.map(inferred),
        "cached": simulation.source == Source::Cached,
    });
    if simulation.profile.recorded.is_some() {
        object["recorded_less_simulated"] = json!({ "spool_k": left_spool, "rate_deg_per_h": left_rate });
    }
    object
}

fn inferred(inference: Inference) -> Value {
    let Inference { noise, roughness, sensor_residual_rms, chamber_sd: [median, largest] } = inference;
    json!({
        "from": "spool_c",
        "noise_k": noise,
        "roughness_k_per_s1_5": roughness,
        "sensor_residual_rms_k": sensor_residual_rms,
        "chamber_sd_median_k": median,
        "chamber_sd_largest_k": largest,
    })
}

/// The summary as a table with units.
pub fn text(simulation: &Simulation) -> String {
    let mut rows = entries(simulation);
    if simulation.source == Source::Cached {
        rows.push(["model", "from the cache", ""].map(str::to_owned));
    }
    format!("{} under {}\n\n{}", simulation.case.name, files::shown_path(&simulation.profile.fingerprint.file), table(&rows))
}

/// Four decimals, zero without a sign.
pub(crate) fn rounded(value: f64) -> String {
    format!("{:.4}", (value * 1e4).round() / 1e4 + 0.0)
}

/// Name, value and unit of each number as text.
pub(crate) fn entries(simulation: &Simulation) -> Vec<[String; 3]> {
    let Summary { rows, duration, chamber, spool, peak, rms, slope, errors, left } = Summary::of(simulation);
    let [shupe, eo_axial, eo_radial, read_out, sum] = errors.parts;
    let entry = |name: &str, value: String, unit: &str| [name.to_owned(), value, unit.to_owned()];
    let range = |[low, high]: [f64; 2]| format!("{:.2} to {:.2}", low + 0.0, high + 0.0);
    let rate = |value: f64, error: f64| format!("{} ± {}", rounded(value), significant(error, 2));
    let unit = DurationUnit::of(duration);
    let after = format!("s, {:.2} {} after the first row", unit.of_seconds(peak.time - simulation.row(0).time), unit.name);
    let slope_name = format!("slope of the bias against the spool's rate, over {WINDOW_S} s or a row");
    let steady = format!("{:.4} ± {}", simulation.steady.sensitivity.total(), significant(simulation.steady.error_estimate, 2));
    let mut all = vec![
        entry("rows", rows.to_string(), ""),
        entry("duration", format!("{:.2}", unit.of_seconds(duration)), unit.name),
        entry("chamber", range(chamber), "degC"),
        entry("spool", format!("{} ± {}", range(spool), significant(errors.spool, 2)), "degC"),
        entry("largest |rate|", rate(peak.rate.abs(), sum), "deg/h"),
        entry("  at", Seconds(peak.time).to_string(), &after),
        entry("  shupe", rate(peak.shupe, shupe), "deg/h"),
        entry("  eo_axial", rate(peak.eo_axial, eo_axial), "deg/h"),
        entry("  eo_radial", rate(peak.eo_radial, eo_radial), "deg/h"),
    ];
    let drifting = simulation.case.design.drifts.read_out != 0.0;
    if drifting {
        all.push(entry("  read-out", rate(peak.read_out, read_out), "deg/h"));
    }
    let beyond = !simulation.added.is_empty();
    if beyond {
        all.push(entry("  mechanisms", significant(peak.mechanisms, 4), "deg/h, by reduced models"));
    }
    let changing = simulation.case.design.mechanics != Mechanics::Elastic;
    let nominal = if changing { "(deg/h)/(degC/min), of the nominal state" } else { "(deg/h)/(degC/min)" };
    let of_all = ["deg/h, the sum of the three", "deg/h, the sum of the four", "deg/h, the sum of the five"];
    let of_all = of_all[usize::from(drifting) + usize::from(beyond)];
    let slope = slope.zip(errors.slope).map_or("none".into(), |(slope, error)| rate(slope, error));
    all.extend([
        entry("  rate", rate(peak.rate, sum), of_all),
        entry("root mean square of the rate", rate(rms, errors.rms), "deg/h, over time"),
        entry(&slope_name, slope, "(deg/h)/(degC/min)"),
        entry("steady-ramp sensitivity", steady, nominal),
    ]);
    for (name, left, unit) in [("thermometer", left[0], "K"), ("rate", left[1], "deg/h")] {
        if let Some(Left { mean, rms }) = left {
            all.push(entry(&format!("recorded less simulated {name}, mean"), significant(mean, 3), unit));
            all.push(entry("  root mean square about it", significant(rms, 3), unit));
        }
    }
    if let Some(Inference { noise, sensor_residual_rms, chamber_sd: [median, largest], .. }) = simulation.profile.inferred {
        let sd = format!("{} (median), {} (largest)", significant(median, 2), significant(largest, 2));
        all.extend([
            entry("chamber inferred from the spool's thermometer", String::new(), ""),
            entry("  standard deviation", sd, "K, if the model is exact"),
            entry("  thermometer's residual", significant(sensor_residual_rms, 2), &format!("K rms, of a noise of {noise} K")),
        ]);
    }
    all
}
