//! The result as one object.

use bias::units::S_PER_H;
use files::Remark;
use recording::check::{Finding, Repair};
use recording::noise::Parameter;
use serde_json::{Value, json};

use super::text::severity;
use super::{Analysis, GyroNoise, RateLine};
use crate::input::Lines;

/// The result; units in the keys, `null` where a number is not known.
pub fn json(analysis: &Analysis) -> Value {
    let case = analysis.case;
    let (report, lines) = (&case.report, case.lines_by_instant());
    let instants = report.instants.as_ref();
    let gap = |gap: &recording::check::Gap| json!({"from_s": gap.from, "to_s": gap.to, "missing_rows": gap.missing});
    json!({
        "file": case.fingerprint.file.display().to_string(),
        "fnv1a": case.fingerprint.to_string(),
        "usable": report.usable(),
        "rows": case.recording.time().len(),
        "rows_kept": report.rows.len(),
        "span_s": instants.map(|i| i.span),
        "interval_s": instants.map(|i| i.interval),
        "jitter_rms_s": instants.map(|i| i.jitter),
        "averaging_s": case.averaging,
        "gaps": instants.map_or_else(Vec::new, |i| i.gaps.iter().map(gap).collect::<Vec<_>>()),
        "channels": report.channels.iter().map(channel).collect::<Vec<_>>(),
        "notes": analysis.notes,
        "note_ids": analysis.notes.iter().map(|note| note.remark.id()).collect::<Vec<_>>(),
        "findings": report.findings.iter().map(|found| finding(&lines, found)).collect::<Vec<_>>(),
        "noise": analysis.noise.as_ref().map(noise),
    })
}

fn channel(channel: &recording::check::ChannelSummary) -> Value {
    json!({
        "name": channel.name,
        "unit": channel.unit,
        "present": channel.present,
        "used": channel.used,
        "least": channel.least,
        "median": channel.median,
        "largest": channel.largest,
        "noise": channel.noise,
        "step": channel.step,
    })
}

fn finding(lines: &Lines<'_>, finding: &Finding) -> Value {
    json!({
        "kind": Remark::of_finding(&finding.kind).id(),
        "severity": severity(finding.severity),
        "channel": finding.channel,
        "from_s": finding.span.map(|[from, _]| from),
        "to_s": finding.span.map(|[_, to]| to),
        "rows": finding.rows,
        "lines": lines.of(finding).map(|lines| [*lines.start(), *lines.end()]),
        "repair": match finding.repair {
            Repair::None => "none",
            Repair::Dropped => "dropped",
            Repair::Masked => "masked",
        },
        "text": finding.to_string(),
    })
}

/// Errors are relative standard errors. A degree per hour times a second is an arc second.
fn noise(noise: &GyroNoise) -> Value {
    let (model, errors) = (&noise.estimate.model, noise.estimate.standard_errors);
    let present = |parameter: Parameter, size: f64, value: f64| (size > 0.0 && noise.is_told(parameter)).then_some(value);
    let point = |point: &recording::allan::AllanPoint| {
        json!({
            "tau_s": point.tau,
            "deviation_deg_per_h": point.deviation,
            "ci90_deg_per_h": [point.low, point.high],
            "degrees_of_freedom": point.freedom,
            "slope": point.slope,
            "model_deg_per_h": model.allan_deviation(point.tau, noise.interval),
        })
    };
    let line = |RateLine { line, of, is_steady }: &RateLine| {
        let amplitude = line.amplitude();
        json!({"period_s": line.period, "amplitude_deg_per_h": amplitude, "of_temperature": of, "steady": is_steady})
    };
    json!({
        "white_deg_per_h": model.white,
        "angle_random_walk_deg_per_sqrt_h": noise.angle_random_walk(),
        "drift_deg_per_h": present(Parameter::Drift, model.drift, model.drift),
        "drift_time_s": present(Parameter::DriftTime, model.drift, model.drift_time),
        "bias_instability_deg_per_h": present(Parameter::Drift, model.drift, model.bias_instability()),
        "rate_random_walk_deg_per_h_per_sqrt_h": present(Parameter::Walk, model.walk, model.walk * S_PER_H.sqrt()),
        "quantisation_arcsec": present(Parameter::Quantisation, model.quantisation, model.quantisation),
        "relative_errors": {
            "white": noise.white_error(),
            "drift": errors.drift,
            "drift_time": errors.drift_time,
            "rate_random_walk": errors.walk,
            "quantisation": errors.quantisation,
        },
        "taken_off": {"temperature": noise.driver, "lags_s": noise.lags},
        "lines": noise.lines.iter().map(line).collect::<Vec<_>>(),
        "rows": noise.estimate.rows,
        "rows_left_out": noise.left_out,
        "log_likelihood": noise.estimate.log_likelihood,
        "allan": noise.allan.iter().map(point).collect::<Vec<_>>(),
    })
}
