//! Two designs compared, in words and as JSON.

use std::fmt::Write;

use coil::Mechanics;
use files::shown_path;
use recording::Seconds;
use serde_json::{Value, json};

use super::{Comparison, CourseNumbers, Differing, PARTS, Part};
use crate::summary::rounded;
use crate::table::{beside, plus_minus, significant, table};

/// Origin of the band of the difference.
pub(super) const HOW: [&str; 4] = [
    "Standard deviations by tolerances are to first order. In the difference a number that both designs share, with its value, its tolerance and its",
    "correlations, is one and the same: its deviation counts by the difference of what it changes in either. All others deviate independently.",
    "Two units that are built apart have no deviation in common: their difference spreads by the root of the sum of both squares (sd apart).",
    "Numerical errors add up.",
];

/// One object; sensitivities in (deg/h)/(degC/min), bias in deg/h. See docs/schema/compare.schema.json.
pub fn json(c: &Comparison) -> Value {
    let design = |k: usize| {
        let case = c.cases[k];
        json!({"file": case.file.display().to_string(), "name": case.name, "length_m": c.length[k]})
    };
    let differing = |d: &Differing| json!({"key": d.key, "unit": d.unit, "a": d.values[0], "b": d.values[1]});
    let tolerance = |d: &Differing| json!({"key": d.key, "a": d.values[0], "b": d.values[1]});
    let of = |part: &Part, k: usize| json!({"value": part.value[k], "error_estimate": part.error[k], "tolerance_sd": part.sd[k]});
    let part = |part: &Part| {
        let mut difference = of(part, 2);
        difference["tolerance_sd_apart"] = part.sd_apart.into();
        json!({"a": of(part, 0), "b": of(part, 1), "difference": difference})
    };
    let sensitivity: serde_json::Map<String, Value> =
        PARTS.iter().zip(&c.parts).map(|(name, p)| ((*name).to_owned(), part(p))).collect();
    let changes = c.changes.iter().map(|changed| {
        let [a, b] = changed.change;
        json!({"key": changed.key, "a": a, "b": b, "shared": changed.shared})
    });
    let numbers = |n: &CourseNumbers| {
        json!({
            "peak_deg_per_h": n.peak.0,
            "peak_time_s": n.peak.1,
            "rms_deg_per_h": n.rms,
            "end_deg_per_h": n.end,
            "error_estimate": {"peak_deg_per_h": n.errors[0], "rms_deg_per_h": n.errors[1], "end_deg_per_h": n.errors[2]},
        })
    };
    let bias = c.bias().map(|[a, b, difference]| json!({"a": numbers(&a), "b": numbers(&b), "difference": numbers(&difference)}));
    json!({
        "a": design(0),
        "b": design(1),
        "differing": c.differing.iter().map(differing).collect::<Vec<_>>(),
        "tolerances": c.tolerances.iter().map(tolerance).collect::<Vec<_>>(),
        "sensitivity": sensitivity,
        "tolerance_changes": changes.collect::<Vec<_>>(),
        "bias": bias,
    })
}

/// Digits of a number that a cell's solution gave all of its own.
const DIGITS: usize = 6;

/// Key, A, B and unit of each differing number.
pub(super) fn differing_rows(all: &[Differing]) -> Vec<Vec<String>> {
    let row = |d: &Differing| {
        let short = d.values.each_ref().map(|value| value.as_deref().map(short));
        // where they differ in later digits all are told
        let number = |value: &Option<String>| value.as_deref().and_then(|text| text.parse::<f64>().ok());
        let alike = number(&short[0]).is_some_and(|a| number(&short[1]) == Some(a));
        let told = if alike { d.values.clone() } else { short };
        let [a, b] = told.map(|value| value.unwrap_or_else(|| "-".into()));
        vec![d.key.clone(), a, b, d.unit.clone().unwrap_or_default()]
    };
    all.iter().map(row).collect()
}

/// A value as a file writes it, of a number no more than so many digits.
fn short(value: &str) -> String {
    let rounded = value.parse::<f64>().ok().map(|number| significant(number, DIGITS));
    rounded.filter(|rounded| rounded.len() < value.len()).unwrap_or_else(|| value.to_owned())
}

/// Name of a part, and value, error and standard deviation of A, of B, and of B less A.
pub(super) fn part_rows(parts: &[Part; 4]) -> Vec<Vec<String>> {
    let most = parts.iter().flat_map(|part| part.value).fold(0.0, |most: f64, value| most.max(value.abs()));
    let sd = |sd: f64| significant(beside(sd, most), 2);
    let of = |(name, part): (&&str, &Part)| {
        let each = |k: usize| {
            [format!("{:.5}", (part.value[k] * 1e5).round() / 1e5 + 0.0), plus_minus(beside(part.error[k], most)), sd(part.sd[k])]
        };
        let name = std::iter::once((*name).to_owned());
        name.chain([0, 1, 2].into_iter().flat_map(each)).chain([sd(part.sd_apart)]).collect()
    };
    PARTS.iter().zip(parts).map(of).collect()
}

/// The three numbers of a course, and the instant of the first.
pub(super) fn bias_rows(bias: &[CourseNumbers; 3]) -> Vec<Vec<String>> {
    let row = |name: &str, of: &dyn Fn(&CourseNumbers) -> String| {
        let cells = bias.iter().map(of).collect::<Vec<_>>();
        std::iter::once(name.to_owned()).chain(cells).collect()
    };
    let with_error = |value: f64, error: f64| format!("{} ± {}", rounded(value), significant(error, 2));
    vec![
        row("largest |rate| [deg/h]", &|n| with_error(n.peak.0, n.errors[0])),
        row("  at [s]", &|n| Seconds(n.peak.1).to_string()),
        row("root mean square [deg/h]", &|n| with_error(n.rms, n.errors[1])),
        row("at the end [deg/h]", &|n| with_error(n.end, n.errors[2])),
    ]
}

/// A head and rows, every line closed by an empty cell: all but the first column are right-aligned.
fn aligned(head: &[&str], rows: Vec<Vec<String>>) -> String {
    let head = head.iter().map(|cell| (*cell).to_owned()).collect();
    let all: Vec<Vec<String>> =
        std::iter::once(head).chain(rows).map(|row: Vec<String>| [row, vec![String::new()]].concat()).collect();
    table(&all)
}

/// The comparison as text.
pub fn text(c: &Comparison) -> String {
    let mut text = String::new();
    for (letter, (case, length)) in ["A", "B"].iter().zip(c.cases.iter().zip(c.length)) {
        let _ = writeln!(text, "{letter}: {}, {}; fibre {length:.4} m", case.name, shown_path(&case.file));
    }
    if c.differing.is_empty() {
        text += "\nno key of the designs differs\n";
    } else {
        let rows = differing_rows(&c.differing);
        let head = ["what differs", "A", "B", ""].map(str::to_owned).to_vec();
        let _ = write!(text, "\n{}", table(&std::iter::once(head).chain(rows).collect::<Vec<_>>()));
    }
    if !c.tolerances.is_empty() {
        let rows: Vec<Vec<String>> = differing_rows(&c.tolerances).into_iter().map(|mut row| row.drain(..3).collect()).collect();
        let _ = write!(text, "\n{}", aligned(&["tolerances that differ (1 sigma)", "A", "B"], rows));
    }
    let head = ["", "A", "", "sd", "B", "", "sd", "B - A", "", "sd", "sd apart"];
    let _ = write!(
        text,
        "\nsteady-ramp sensitivity in (deg/h)/(degC/min), ± numerical error, sd by tolerances\n\n{}\n{}\n",
        aligned(&head, part_rows(&c.parts)),
        HOW.join("\n"),
    );
    if c.cases.iter().any(|case| case.design.mechanics != Mechanics::Elastic) {
        text += "Mechanics that change with temperature or time are taken in their nominal state.\n";
    }
    if let Some((bias, [simulation, _])) = c.bias().zip(c.simulations.as_ref()) {
        let file = shown_path(&simulation.profile.fingerprint.file);
        let head = ["", "A", "B", "B - A, row by row"];
        let _ = write!(text, "\nbias under {file}, ± numerical error\n\n{}", aligned(&head, bias_rows(&bias)));
        c.long_rows().for_each(|note| text += &format!("\n{note}\n"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_told_with_the_digits_in_which_they_differ() {
        let row = |a: &str, b: &str| {
            let values = [Some(a.to_owned()), Some(b.to_owned())];
            let rows = differing_rows(&[Differing { key: "k".into(), unit: None, values }]);
            [rows[0][1].clone(), rows[0][2].clone()]
        };
        assert_eq!(row("102.33147462212466", "312.4952197942044"), ["102.331", "312.495"]);
        assert_eq!(row("102.33147462212466", "102.33148"), ["102.33147462212466", "102.33148"]);
        assert_eq!(row("43.5", "43.500000001"), ["43.5", "43.500000001"]);
        assert_eq!(row("36", "4"), ["36", "4"]);
        assert_eq!(row("Right", "Left"), ["Right", "Left"]);
    }
}
