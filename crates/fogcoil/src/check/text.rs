//! The result for people.

use std::fmt::Write;
use std::path::Path;

use bias::units::S_PER_H;
use files::{Note, Remark};
use recording::Seconds;
use recording::check::{Finding, FindingKind, Gap, Severity};
use recording::noise::{Parameter, StandardErrors, Term};

use super::{Analysis, GyroNoise, NO_MAXIMUM};
use crate::input::RecordCase;
use crate::table::{significant, table};
use crate::units::DurationUnit;

/// Most findings of one kind in one channel that are written out.
const MOST_ALIKE: usize = 8;
/// Judgement on a recording that nothing can be done with.
const UNUSABLE: &str = "cannot be used";

/// All findings but the first error, which [`RecordCase::require_usable`] reports.
fn listed(case: &RecordCase) -> Vec<&Finding> {
    let findings = &case.report.findings;
    let said = findings.iter().position(|finding| finding.severity == Severity::Error);
    findings.iter().enumerate().filter(|(n, _)| Some(*n) != said).map(|(_, finding)| finding).collect()
}

/// The result as text with tables.
pub fn text(analysis: &Analysis) -> String {
    written(analysis, Severity::Note)
}

/// The same with its warnings, without its notes.
pub fn text_without_notes(analysis: &Analysis) -> String {
    written(analysis, Severity::Warning)
}

/// The result with its remarks of a severity and above.
fn written(analysis: &Analysis, least: Severity) -> String {
    let case = analysis.case;
    let verdict = if case.report.usable() { "usable" } else { "cannot be used (the message at the end says why)" };
    let mut out = format!("{}: {verdict}\n\n", files::shown_path(&case.fingerprint.file));
    out.push_str(&table(&overview(analysis)));
    out.push('\n');
    out.push_str(&channels(analysis));
    for note in analysis.notes.iter().filter(|note| least == Severity::Note || note.is_warning()) {
        let _ = writeln!(out, "{}", note.line());
    }
    let shown = |finding: &&Finding| least == Severity::Note || finding.severity != Severity::Note;
    let found: Vec<&Finding> = listed(case).into_iter().filter(shown).collect();
    if case.report.findings.is_empty() && !analysis.notes.iter().any(Note::is_warning) {
        out.push_str("nothing suspicious found\n");
    }
    findings(&mut out, case, &found);
    match &analysis.noise {
        Some(noise) => gyro(&mut out, analysis, noise),
        None if case.report.usable() => out.push_str("\nThe rate's noise cannot be identified: too few rows, or no noise.\n"),
        None => {}
    }
    out
}

fn overview(analysis: &Analysis) -> Vec<Vec<String>> {
    let report = &analysis.case.report;
    let row = |name: &str, value: String, unit: &str| vec![name.to_owned(), value, unit.to_owned()];
    let mut rows = vec![row("rows kept", report.rows.len().to_string(), &format!("of {}", analysis.case.recording.time().len()))];
    if let Some(instants) = &report.instants {
        let unit = DurationUnit::of(instants.span);
        rows.push(row("span", significant(unit.of_seconds(instants.span), 4), unit.name));
        rows.push(row("interval", significant(instants.interval, 4), "s"));
        rows.push(row("jitter, rms", significant(instants.jitter, 2), "s"));
        let missing: usize = instants.gaps.iter().map(|gap| gap.missing).sum();
        rows.push(row(
            "gaps",
            instants.gaps.len().to_string(),
            &format!("({missing} {} missing)", if missing == 1 { "row" } else { "rows" }),
        ));
    }
    rows
}

fn channels(analysis: &Analysis) -> String {
    let header = ["channel", "used", "least", "median", "largest", "noise", "step", "unit"];
    let mut rows = vec![header.map(str::to_owned).to_vec()];
    for channel in &analysis.case.report.channels {
        let number = |value: Option<f64>| value.filter(|v| v.is_finite()).map_or("-".to_owned(), |v| significant(v, 4));
        let numbers = [Some(channel.least), Some(channel.median), Some(channel.largest), channel.noise, channel.step].map(number);
        rows.push(
            [&[channel.name.clone(), channel.used.to_string()], &numbers[..], std::slice::from_ref(&channel.unit)].concat(),
        );
    }
    table(&rows)
        + "(noise: white, of a value, from neighbours' differences, 1 sd; step: resolution, where the values show one)\n\n"
}

/// A line for each, up to a number of one kind.
fn findings(out: &mut String, case: &RecordCase, findings: &[&Finding]) {
    let lines = case.lines_by_instant();
    let alike = |n: usize| {
        let (kind, channel) = (std::mem::discriminant(&findings[n].kind), &findings[n].channel);
        move |m: &usize| std::mem::discriminant(&findings[*m].kind) == kind && findings[*m].channel == *channel
    };
    for (n, finding) in findings.iter().enumerate() {
        let before = (0..n).filter(alike(n)).count();
        if before < MOST_ALIKE {
            let place = lines.of(finding).map_or(String::new(), |lines| match (lines.start(), lines.end()) {
                (first, last) if first == last => format!("line {first}: "),
                (first, last) => format!("lines {first} to {last}: "),
            });
            let _ =
                writeln!(out, "{}: {place}{finding} [{}]", severity(finding.severity), Remark::of_finding(&finding.kind).id());
        } else if before == MOST_ALIKE {
            let more = (n..findings.len()).filter(alike(n)).count();
            let _ = writeln!(out, "{}: ... and {more} more of this kind (all with --json)", severity(finding.severity));
        }
    }
}

pub(super) fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    }
}

fn gyro(out: &mut String, analysis: &Analysis, noise: &GyroNoise) {
    let estimate = &noise.estimate;
    let _ = writeln!(
        out,
        "\nNoise of the rate beside {} (fitted, white noise with drift; slow terms: upper bounds):\n",
        noise.taken_off()
    );
    let model = &estimate.model;
    let StandardErrors { drift, drift_time, walk, quantisation, .. } = estimate.standard_errors;
    let told =
        |name: &str, value: f64, error: String, unit: &str| vec![name.to_owned(), significant(value, 3), error, unit.to_owned()];
    let row = |name: &str, value: f64, error: Option<f64>, unit: &str| told(name, value, percent(error), unit);
    // what stands at an end of the search is no value
    let found = |parameter: Parameter, name: &str, value: f64, error: Option<f64>, unit: &str| {
        if noise.is_told(parameter) {
            return row(name, value, error, unit);
        }
        [name, "-", "not told by this record", unit].map(str::to_owned).to_vec()
    };
    let mut rows = vec![["", "value", "± 1 sd", "unit"].map(str::to_owned).to_vec()];
    match noise.white() {
        Some(sd) => rows.push(told("white noise of a sample", sd, white(noise), "deg/h")),
        None => rows.push(vec!["white noise of a sample".into(), "-".into(), "hidden by slower noise".into(), "deg/h".into()]),
    }
    if let Some(walk) = noise.angle_random_walk() {
        rows.push(told("angle random walk", walk, white(noise), "deg/sqrt(h)"));
    }
    if let Some(bench) = analysis.case.meta.as_ref().and_then(|meta| meta.nominal_arw_deg_per_sqrt_h) {
        rows.push(vec!["  the meta file's".into(), significant(bench, 3), String::new(), "deg/sqrt(h)".into()]);
    }
    if estimate.terms.contains(&Term::Drift) {
        rows.push(found(Parameter::Drift, "drift", model.drift, drift, "deg/h"));
        rows.push(found(Parameter::DriftTime, "  correlation time", model.drift_time / S_PER_H, drift_time, "h"));
        rows.push(found(Parameter::Drift, "  floor of the drift alone", model.bias_instability(), drift, "deg/h"));
    }
    if estimate.terms.contains(&Term::Walk) {
        rows.push(found(Parameter::Walk, "rate random walk", model.walk * S_PER_H.sqrt(), walk, "deg/h/sqrt(h)"));
    }
    if estimate.terms.contains(&Term::Quantisation) {
        rows.push(found(Parameter::Quantisation, "quantisation of the angle", model.quantisation, quantisation, "arcsec"));
    }
    match noise.floor() {
        Some((tau, floor)) => {
            let error = estimate.relative_error(|model| model.allan_deviation(tau, noise.interval));
            let at = format!("deg/h, at {} s", Seconds(tau.round()));
            let mut line = row("bias instability, the Allan floor", floor, error, &at);
            if noise.is_bound {
                line[1] = format!("at most {}", line[1]);
            }
            rows.push(line);
        }
        None => rows.push(vec![
            "bias instability, the Allan floor".into(),
            "-".into(),
            String::new(),
            "(still falls: record longer)".into(),
        ]),
    }
    let not_known = rows.iter().any(|row| row[2] == "not known");
    out.push_str(&table(&rows));
    if not_known {
        let _ = writeln!(out, "(interval not known: {NO_MAXIMUM})");
    }
    if noise.is_contradicted() {
        out.push_str("(white noise: the fit is contradicted by its own Allan deviation, or by differences of neighbours; the ends hold these, too)\n");
    }
    if noise.left_out > 0 {
        let _ = writeln!(out, "{} rows that this model does not expect (fast transients) were left out", noise.left_out);
    }
    if estimate.terms.is_empty() {
        out.push_str("no drift and no rate random walk is significant\n");
    }
    out.push_str("\nOverlapping Allan deviation [deg/h], with 90 % intervals:\n\n");
    let mut rows = vec![["tau [s]", "deviation", "low", "high", "slope", "model"].map(str::to_owned).to_vec()];
    for point in &noise.allan {
        let modelled = significant(model.allan_deviation(point.tau, noise.interval), 3);
        let [deviation, low, high] = [point.deviation, point.low, point.high].map(|value| significant(value, 3));
        rows.push(vec![significant(point.tau, 4), deviation, low, high, format!("{:.2}", point.slope), modelled]);
    }
    out.push_str(&table(&rows));
}

/// A relative error.
fn percent(error: Option<f64>) -> String {
    error.map_or("not known".to_owned(), |error| format!("± {:.0} %", 100.0 * error))
}

/// Ends of the white noise.
fn white(noise: &GyroNoise) -> String {
    noise.white_ends(1.0).map_or_else(|| percent(None), sides)
}

/// Ends of an interval over its middle.
fn sides([low, high]: [f64; 2]) -> String {
    let [below, above] = [1.0 - low, high - 1.0].map(|error| format!("{:.0}", 100.0 * error));
    if below == above { format!("± {above} %") } else { format!("-{below} % to +{above} %") }
}

/// Column of [`several`] for the remarks, or the reason of an unusable recording.
const REMARKS: usize = 7;

/// A line for each recording; a reason for which several cannot be used stands below them, once.
pub fn several(lines: &[[String; 8]]) -> String {
    let head = ["recording", "", "rows", "span", "interval [s]", "angle random walk [deg/sqrt(h)]", "± 1 sd", "remarks"]
        .map(str::to_owned);
    let why = |line: &[String; 8]| Some(line[REMARKS].clone()).filter(|_| line[1] == UNUSABLE);
    let mut shared: Vec<String> = Vec::new();
    for reason in lines.iter().filter_map(why) {
        if !shared.contains(&reason) && lines.iter().filter_map(why).filter(|other| *other == reason).count() > 1 {
            shared.push(reason);
        }
    }
    let shown = |line: &[String; 8]| {
        let number = why(line).and_then(|reason| shared.iter().position(|other| *other == reason));
        let remarks = number.map_or_else(|| line[REMARKS].clone(), |n| format!("({})", n + 1));
        [&line[..REMARKS], &[remarks]].concat()
    };
    let mut out = table(&std::iter::once(head.to_vec()).chain(lines.iter().map(shown)).collect::<Vec<_>>());
    for (n, reason) in shared.iter().enumerate() {
        let _ = writeln!(out, "({}) {reason}", n + 1);
    }
    out
}

/// The line of a recording that cannot be read.
pub fn unreadable(file: &Path, why: &str) -> [String; 8] {
    let none = || "-".to_owned();
    // the file is named in the first column
    let place = why.strip_prefix(&format!("{}:", files::shown_path(file))).map(|rest| match rest.split_once(':') {
        Some((line, rest)) if !line.is_empty() && line.bytes().all(|byte| byte.is_ascii_digit()) => format!("line {line}:{rest}"),
        _ => rest.trim_start().to_owned(),
    });
    [files::shown_path(file), UNUSABLE.into(), none(), none(), none(), none(), none(), place.unwrap_or_else(|| why.to_owned())]
}

/// The longest gap, and how many there are, in words; `None` without one.
fn gaps(gaps: &[Gap]) -> Option<String> {
    let longest = gaps.iter().map(|gap| gap.to - gap.from).max_by(f64::total_cmp)?;
    let unit = DurationUnit::of(longest);
    let length = format!("{} {}", significant(unit.of_seconds(longest), 2), unit.name);
    Some(if gaps.len() == 1 { format!("gap {length}") } else { format!("{} gaps up to {length}", gaps.len()) })
}

impl Analysis<'_> {
    /// The recording's line among others: rows, span, interval, angle random walk, the ids of its warnings, and its gaps.
    pub fn line(&self) -> [String; 8] {
        let Self { case, notes, noise } = self;
        let file = &case.fingerprint.file;
        if let Err(error) = case.require_usable() {
            return unreadable(file, &error.problem);
        }
        let number = |value: Option<f64>, digits| value.map_or("-".to_owned(), |value| significant(value, digits));
        let instants = case.report.instants.as_ref();
        let span = instants.map_or("-".to_owned(), |instants| {
            let unit = DurationUnit::of(instants.span);
            format!("{} {}", significant(unit.of_seconds(instants.span), 3), unit.name)
        });
        let walk = noise.as_ref().and_then(|noise| Some((noise.angle_random_walk()?, white(noise))));
        let (walk, ends) = walk.map_or((None, "-".to_owned()), |(walk, ends)| (Some(walk), ends));
        let notes = notes.iter().filter(|note| note.is_warning()).map(|note| note.remark.id());
        // of values that were left out, and of a size that nothing explains, a note is worth a word here, too
        let worth = |finding: &&Finding| {
            finding.severity != Severity::Note
                || matches!(finding.kind, FindingKind::Outliers(_) | FindingKind::Offset { is_explained: false, .. })
        };
        let severe = case.report.findings.iter().filter(worth);
        let mut warnings: Vec<&str> = notes.chain(severe.map(|finding| Remark::of_finding(&finding.kind).id())).collect();
        warnings.dedup();
        let gaps = instants.and_then(|instants| gaps(&instants.gaps));
        let remarks: Vec<&str> = warnings.into_iter().chain(gaps.as_deref()).collect();
        [
            files::shown_path(file),
            "usable".into(),
            case.report.rows.len().to_string(),
            span,
            number(instants.map(|instants| instants.interval), 4),
            number(walk, 3),
            ends,
            remarks.join(", "),
        ]
    }
}
