//! The page of a comparison.

use charts::{Axis, Cells, Figure, Panel, Series, Style, grid, row, sections, signed, significant};
use maud::{Markup, html};

use super::text::{HOW, bias_rows, differing_rows, part_rows};
use super::{Comparison, PARTS};
use crate::figures;
use crate::report::provenance;

/// Smallest spans that are drawn: less is rounding.
const LEAST_S: f64 = 1e-3;
const LEAST_DEG_PER_H: f64 = 1e-4;

/// The page, with both coils side by side.
pub fn report(c: &Comparison) -> String {
    let [a, b] = c.cases.map(|case| case.name.as_str());
    let head = ["", "A", "B", "B \u{2212} A, row by row"];
    let under_profile = c.bias().map(|bias| {
        html! {
            (grid("Bias under the profile, with numerical errors", Cells::Numbers, &head, &bias_rows(&bias)))
            @for note in c.long_rows() { p { (note) } }
            (course(c).element())
        }
    });
    let mut parts = Vec::from_iter(under_profile.map(|part| ("Bias under the profile", part)));
    parts.extend([("Sensitivity", sensitivity(c)), ("Differences", html! { (designs(c)) (differing(c)) })]);
    parts.extend([("Both coils", figures::side_by_side(c.cases).element()), sources(c)]);
    charts::page(&format!("{a} and {b}"), &lead(c), &sections(&parts))
}

/// The result in a sentence or two.
fn lead(c: &Comparison) -> Markup {
    let total = c.parts[3];
    let [a, b, difference] = total.value;
    let with = |value: f64, sd: f64| format!("{} ± {}", signed(value, 4), significant(sd, 2));
    html! {
        p {
            "In a steady ramp A has a sensitivity of " (with(a, total.sd[0])) " (°/h)/(°C/min), B one of " (with(b, total.sd[1]))
            "; B less A is " (with(difference, total.sd[2])) "; ± is one standard deviation by the designs' tolerances."
        }
    }
}

fn designs(c: &Comparison) -> Markup {
    let of = |k: usize, letter: &str| row(letter, format!("{}, fibre {:.4} m", c.cases[k].name, c.length[k]));
    charts::facts("The designs", &[of(0, "A"), of(1, "B")])
}

fn differing(c: &Comparison) -> Markup {
    let tolerances: Vec<Vec<String>> =
        differing_rows(&c.tolerances).into_iter().map(|mut row| row.drain(..3).collect()).collect();
    html! {
        @if c.differing.is_empty() {
            p { "No key of the designs differs." }
        } @else {
            (grid("Keys whose values differ", Cells::Words, &["key", "A", "B", "unit"], &differing_rows(&c.differing)))
        }
        @if !tolerances.is_empty() {
            (grid("Keys whose tolerances differ, one standard deviation", Cells::Words, &["key", "A", "B"], &tolerances))
        }
    }
}

fn sensitivity(c: &Comparison) -> Markup {
    let head = ["", "A", "error", "sd", "B", "error", "sd", "B \u{2212} A", "error", "sd", "sd apart"];
    let changes: Vec<Vec<String>> = c
        .changes
        .iter()
        .map(|changed| {
            let [a, b] = changed.change.map(|change| signed(change, 4));
            vec![changed.key.to_owned(), a, b, if changed.shared { "yes" } else { "no" }.to_owned()]
        })
        .collect();
    let told = "What one standard deviation of each number changes in the sensitivity, (°/h)/(°C/min)";
    html! {
        (parts(c).element())
        (grid("Steady-ramp sensitivity by part, (°/h)/(°C/min)", Cells::Numbers, &head, &part_rows(&c.parts)))
        p { (HOW.join(" ")) }
        (grid(told, Cells::Words, &["key", "A", "B", "shared"], &changes))
    }
}

/// Every part as a mark with a line of one standard deviation to either side; A above B.
fn parts<'a>(c: &Comparison) -> Figure<'a> {
    let names: Vec<String> =
        ["Shupe", "elasto-optic, axial", "elasto-optic, radial", "total"].iter().rev().map(|&n| n.to_owned()).collect();
    let place = |part: usize, k: usize| (PARTS.len() - 1 - part) as f64 + [0.12, -0.12][k];
    let mut series = vec![];
    for k in 0..2 {
        for (n, part) in c.parts.iter().enumerate() {
            let ends = [-1.0, 1.0].map(|sign| (part.value[k] + sign * part.sd[k], place(n, k)));
            series.push(Series::new("", Style::Fine(if k == 0 { 2 } else { 0 }), ends.to_vec()));
        }
    }
    for (k, letter) in ["A", "B"].into_iter().enumerate() {
        let points = c.parts.iter().enumerate().map(|(n, part)| (part.value[k], place(n, k))).collect();
        series.push(Series::new(letter, Style::Points(k as u8), points));
    }
    Figure {
        id: "parts",
        title: "The sensitivity by part".into(),
        description: "Every part of the steady-ramp sensitivity as a mark, for A and for B, with a line of one standard deviation to either side."
            .into(),
        caption: "Shupe: thermal phase, eq. (1); elasto-optic: the two terms of eq. (2). Lines: one standard deviation by the design's tolerances \
                  to either side; numerical errors are smaller and stand in the table."
            .into(),
        columns: 1,
        panels: vec![Panel::lines(
            Axis::round("steady-ramp sensitivity [(°/h)/(°C/min)]", LEAST_S).covering([0.0, 0.0]),
            Axis::named("part", names),
            12.0,
            series,
        )],
    }
}

/// The bias of both, and below it B less A.
fn course<'a>(c: &'a Comparison) -> Figure<'a> {
    let mut panels = Vec::new();
    if let Some([a, b]) = &c.simulations {
        let (x, time) = figures::time_axis(a);
        let ends = [a.row(0).time, a.row(a.count() - 1).time].map(time);
        let line = |name: &str, style, simulation: &'a crate::simulate::Simulation| {
            Series::computed(name, style, simulation.count(), move |n| (time(simulation.row(n).time), simulation.row(n).rate))
        };
        let bias = vec![line("A", Style::First, a), line("B", Style::Second, b)];
        let difference = c.rate_difference().into_iter().map(|(at, rate)| (time(at), rate)).collect();
        let unlabelled = Axis::tight("", x.least_span).covering(ends);
        panels.push(Panel::lines(unlabelled, Axis::round("bias [°/h]", LEAST_DEG_PER_H), 16.0, bias));
        let axis = Axis::round("B \u{2212} A [°/h]", LEAST_DEG_PER_H);
        panels.push(Panel::lines(x.covering(ends), axis, 9.0, vec![Series::new("", Style::Total, difference)]));
    }
    Figure {
        id: "bias",
        title: "The bias of both".into(),
        description:
            "Rotation rate that the gyroscope reports at rest over time, for A and for B, and below it their difference.".into(),
        caption: "Means since the previous row, as a gyroscope reports them; 0 in the first row.".into(),
        columns: 1,
        panels,
    }
}

fn sources(c: &Comparison) -> (&'static str, Markup) {
    let mut files: Vec<_> = Vec::new();
    for (case, roles) in c.cases.iter().zip([["A", "cell of A"], ["B", "cell of B"]]) {
        files.extend(case.fingerprints.iter().enumerate().map(|(n, file)| (roles[usize::from(n > 0)], file)));
    }
    files.extend(c.simulations.iter().map(|[simulation, _]| ("profile", &simulation.profile.fingerprint)));
    provenance("compare", &files, &[])
}
