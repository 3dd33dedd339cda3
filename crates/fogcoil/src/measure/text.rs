//! The figures for people.

use std::fmt::Write;
use std::path::PathBuf;

use files::{Note, Remark};
use recording::Seconds;

use super::{Figure, Measurement, Prediction, Told, Untold};
use crate::Error;
use crate::table::{significant, table};

/// A table of the figures, the design's prediction among them, how they are meant, and the notes.
pub fn text(measured: &Measurement, prediction: Option<&Prediction>) -> String {
    let others = measured.notes.iter().filter(|note| note.remark != Remark::NotMeasured);
    let notes: String = others.map(Note::line).chain(missing(measured)).map(|line| line + "\n").collect();
    figures(measured, prediction) + &notes
}

/// The same with its warnings, without its notes.
pub fn text_without_notes(measured: &Measurement, prediction: Option<&Prediction>) -> String {
    let warnings = measured.notes.iter().filter(|note| note.is_warning());
    figures(measured, prediction) + &warnings.map(|note| note.line() + "\n").collect::<String>()
}

/// Several recordings, a line each: figures with half of their intervals, or the ends where the figure is not in the middle, ids of warnings; below, the design's prediction, and recordings that cannot be used.
pub fn several(measured: &[Result<Measurement, (PathBuf, Error)>], prediction: Option<&Prediction>) -> String {
    const SHOWN: [(&str, &str); 7] = [
        ("sensitivity", "sensitivity"),
        ("asymmetry", "heating less cooling"),
        ("hysteresis", "hysteresis"),
        ("bias_span", "bias over temperature"),
        ("peak", "largest bias"),
        ("arw", "angle random walk"),
        ("bias_instability", "bias instability"),
    ];
    let mut rows =
        vec![["recording"].into_iter().chain(SHOWN.map(|(_, name)| name)).chain(["warnings"]).map(str::to_owned).collect()];
    for one in measured.iter().flatten() {
        let figures = one.figures();
        let shown = |(key, _, told): &(&str, &str, &Told)| brief(key, told, one.is_bound(key));
        let of = |key: &str| figures.iter().find(|(known, ..)| *known == key).map_or_else(|| "-".into(), shown);
        let mut warnings: Vec<&str> = one.notes.iter().filter(|note| note.is_warning()).map(|note| note.remark.id()).collect();
        warnings.dedup();
        let row = [files::shown_path(&one.fingerprint.file)]
            .into_iter()
            .chain(SHOWN.map(|(key, _)| of(key)))
            .chain([warnings.join(", ")]);
        rows.push(row.collect::<Vec<_>>());
    }
    let mut out = table(&rows);
    out.push_str("\nFitted; ± is half of the 90 % interval, whose ends stand where the value is not in its middle. Sensitivity and heating less cooling are in (deg/h)/(degC/min), the random walk is in deg/sqrt(h), the\nothers are in deg/h. Behind < stands an upper bound: of a bias instability, as the temperature changed,\nand of a bias over temperature that may be 0. One recording alone gives the ends of intervals, and the reason for each -; --json gives both for all.\n");
    if let Some(prediction) = prediction {
        let _ = writeln!(out, "The sensitivity of {} is {}.", prediction.design, short(&Ok(prediction.sensitivity)));
    }
    let is_alone = |one: &Measurement| one.notes.iter().any(|note| note.remark == Remark::OneTemperature);
    if measured.iter().flatten().any(is_alone) {
        out.push_str(
            "A record with one temperature does not tell how slowly the unit settles (`fogcoil explain one-temperature`).\n",
        );
    }
    for (_, error) in measured.iter().filter_map(|one| one.as_ref().err()) {
        let _ = writeln!(out, "{error}");
    }
    out
}

/// A number of a key in a line: what is an upper bound, or a span that may be 0, by its upper end.
fn brief(key: &str, told: &Told, is_bound: bool) -> String {
    match told {
        Ok(figure) if is_bound || (key == "bias_span" && figure.ci90[0] <= 0.0) => at_most(figure, "<"),
        Err(Untold { value: Some(value), .. }) if is_bound => format!("< {}", significant(*value, 2)),
        told => short(told),
    }
}

/// The upper end of a number that is an upper bound itself.
fn at_most(figure: &Figure, word: &str) -> String {
    format!("{word} {}", significant(figure.ci90[1], 2))
}

/// A number with half of its interval, or the ends of one that does not lie about it evenly.
fn short(told: &Told) -> String {
    match told {
        Ok(Figure { value, ci90: [low, high] }) => {
            let half = (high - low) / 2.0;
            // two digits of the half, and as many decimals of the number
            let decimals = (1.0 - half.log10().floor()).clamp(0.0, 9.0) as usize;
            if (f64::midpoint(*low, *high) - value).abs() > EVEN * half {
                return format!("{low:.decimals$} to {high:.decimals$}");
            }
            format!("{value:.decimals$} ± {half:.decimals$}")
        }
        Err(Untold { value: Some(value), .. }) => significant(*value, 3),
        Err(_) => "-".into(),
    }
}

/// Share of half an interval by which its middle may be off the value that it is written about.
const EVEN: f64 = 0.1;

/// A line for each reason, with the figures that are not told because of it.
fn missing(measured: &Measurement) -> Vec<String> {
    let mut all: Vec<(Vec<&str>, &str)> = Vec::new();
    for (key, _, told) in measured.figures() {
        let Err(Untold { why, .. }) = told else { continue };
        match all.iter_mut().find(|(_, known)| known == why) {
            Some((keys, _)) => keys.push(key),
            None => all.push((vec![key], why)),
        }
    }
    all.iter().map(|(keys, why)| Remark::NotMeasured.note(format!("{}: {why}", keys.join(", "))).line()).collect()
}

/// Why a number has no interval, but is an upper bound.
const BOUND: &str = "upper bound: the temperature changed";

fn figures(measured: &Measurement, prediction: Option<&Prediction>) -> String {
    let mut out = format!("{}\n\n", files::shown_path(&measured.fingerprint.file));
    let mut rows = vec![["", "value", "90 % interval", "unit"].map(str::to_owned).to_vec()];
    for (key, unit, told) in measured.figures() {
        rows.push(match told {
            Ok(figure) if measured.is_bound(key) => {
                vec![name(key).into(), at_most(figure, "at most"), BOUND.into(), unit.into()]
            }
            Ok(figure) => row(name(key), figure, unit),
            Err(Untold { value: Some(value), .. }) => {
                let (at_most, why) = if measured.is_bound(key) { ("at most ", BOUND) } else { ("", "not known") };
                vec![name(key).into(), format!("{at_most}{}", significant(*value, 3)), why.into(), unit.into()]
            }
            Err(_) => vec![name(key).into(), "-".into(), String::new(), String::new()],
        });
        if let (Some(prediction), "asymmetry") = (prediction, key) {
            rows.push(row("  the design's sensitivity", &prediction.sensitivity, unit));
        }
    }
    out.push_str(&table(&rows));
    if let Some([driver, seat]) = measured.temperatures {
        let _ = writeln!(out, "\nFitted. Rates are those of {driver}; the bias over temperature is over {seat}, at rest.");
    }
    if let Some(time) = measured.peak_time {
        let _ =
            writeln!(out, "The peak is at {} s on the record's clock, and relative to the bias in the first row.", Seconds(time));
    }
    if let Some(tau) = measured.floor_time {
        let _ = writeln!(
            out,
            "The Allan deviation's floor is at {} s; B of IEEE Std 952 is the floor over 0.664.",
            Seconds(tau.round())
        );
    }
    if let Some((prediction, sigmas)) = prediction.and_then(|p| Some((p, p.sigmas(measured)?))) {
        let _ = writeln!(
            out,
            "Measured less predicted by {}: {} standard deviations of both together.",
            prediction.design,
            significant(sigmas, 2)
        );
    }
    out
}

fn name(key: &str) -> &str {
    match key {
        "sensitivity" => "sensitivity to the rate of temperature",
        "heating" => "  heating",
        "cooling" => "  cooling",
        "asymmetry" => "  heating less cooling",
        "hysteresis" => "hysteresis at rest",
        "bias_span" => "bias over temperature",
        "peak" => "largest bias by temperature",
        "arw" => "angle random walk (fitted with drift)",
        _ => "bias instability",
    }
}

fn row(name: &str, figure: &Figure, unit: &str) -> Vec<String> {
    let Figure { value, ci90: [low, high] } = *figure;
    let digits = digits(value, high - low);
    let number = |value: f64| significant(value, digits);
    vec![name.to_owned(), number(value), format!("{} to {}", number(low), number(high)), unit.to_owned()]
}

/// Digits that show an interval's width to two.
fn digits(value: f64, width: f64) -> usize {
    let more = (value.abs() / width).log10().ceil();
    if more.is_finite() { (1.0 + more).clamp(2.0, 6.0) as usize } else { 3 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_that_may_be_nothing_is_told_by_its_upper_end() {
        let of = |key: &str, low: f64| brief(key, &Ok(Figure { value: 0.037, ci90: [low, 0.072] }), false);
        assert_eq!(
            [of("bias_span", 0.0), of("bias_span", 0.002), of("peak", 0.0)],
            ["< 0.072", "0.037 ± 0.035", "0.037 ± 0.036"]
        );
        let untold = Err(Untold { why: String::new(), value: Some(0.0162) });
        assert_eq!([brief("bias_instability", &untold, true), brief("arw", &untold, false)], ["< 0.016", "0.0162"]);
    }

    #[test]
    fn an_interval_that_is_not_even_is_told_by_its_ends() {
        let of = |low: f64, high: f64| short(&Ok(Figure { value: 0.00112, ci90: [low, high] }));
        assert_eq!([of(0.0010, 0.0016), of(0.00109, 0.00115)], ["0.00100 to 0.00160", "0.001120 ± 0.000030"]);
        assert_eq!(of(0.0005, 0.0012), "0.00050 to 0.00120");
    }
}
