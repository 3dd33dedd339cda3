//! A simulation as one page: HTML that needs nothing but itself, on paper, phone and screen, in light and dark.

mod facts;

use std::fmt::Write;

use coil::TurnFields;

use crate::figures;
use crate::picture::escape;
use crate::plot::page_style;
use crate::simulate::{Row, Simulation};
use crate::summary::{Summary, entries};

pub(crate) use facts::{row, table};

const STYLE: &str = include_str!("style.css");
/// Most rows of the table of the plotted data, the peak's not counted.
const MOST_ROWS: usize = 60;

/// The page; temperature, strain and contributions of the turns only with `fields`.
pub fn html(simulation: &Simulation, fields: Option<&TurnFields>, convergence: Option<&figures::Convergence>) -> String {
    let profile = simulation.profile.fingerprint.file.file_name().unwrap_or_default().to_string_lossy();
    let title = format!("{} under {profile}", simulation.case.name);
    let mut out = String::new();
    summary(&mut out, simulation);
    out.push_str("<h2>Figures</h2>\n");
    out.push_str(&figures::elements(simulation, fields, convergence));
    data(&mut out, simulation);
    facts::coil(&mut out, simulation);
    facts::computation(&mut out, simulation);
    page(&title, &lead(simulation), &out)
}

/// A page that needs nothing but itself: `lead` in its header, `body` below, both HTML; the title is text.
pub(crate) fn page(title: &str, lead: &str, body: &str) -> String {
    let title = escape(title);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{title}</title>\n\
         <style>\n{}{STYLE}</style>\n</head>\n<body>\n<header>\n<h1>{title}</h1>\n{lead}</header>\n<main>\n{body}</main>\n</body>\n</html>\n",
        page_style(),
    )
}

/// The result in two sentences.
fn lead(simulation: &Simulation) -> String {
    let summary = Summary::of(simulation);
    let peak = summary.peak;
    let slope = summary.slope.map_or(String::new(), |slope| {
        format!(
            " Regressed on the spool's temperature rate, the bias has a slope of {} (°/h)/(°C/min); in a steady ramp it would be {}.",
            signed(slope, 3),
            signed(simulation.steady.sensitivity.total(), 3)
        )
    });
    format!(
        "<p>Computed thermal bias of a fibre-optic gyroscope's coil at rest. It is largest at {} s, {} °/h.{slope}</p>\n",
        peak.time,
        signed(peak.rate, 4)
    )
}

fn summary(out: &mut String, simulation: &Simulation) {
    out.push_str("<h2>Summary</h2>\n<table class=\"facts\">\n<tbody>\n");
    for [name, value, unit] in entries(simulation) {
        let class = if name.starts_with(' ') { " class=\"part\"" } else { "" };
        let value = format!("{value} {}", unit.replace("deg/h", "°/h").replace("degC", "°C"));
        let value = value.trim_end().replace('-', "\u{2212}");
        let _ = writeln!(out, "<tr{class}><th scope=\"row\">{}</th><td>{}</td></tr>", escape(name.trim()), escape(&value));
    }
    out.push_str("</tbody>\n</table>\n");
}

/// The plotted data, thinned.
fn data(out: &mut String, simulation: &Simulation) {
    let every = simulation.count().div_ceil(MOST_ROWS).max(1);
    let peak = Summary::of(simulation).peak;
    let chosen = |(n, row): &(usize, Row)| n % every == 0 || n + 1 == simulation.count() || row.time == peak.time;
    let which =
        if every == 1 { "every row".into() } else { format!("one row in {every}, the last and the one of the largest rate") };
    let _ = write!(
        out,
        "<details>\n<summary>The plotted data as a table ({which})</summary>\n<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"table\">\n<table class=\"data\">\n<thead>\n<tr>"
    );
    for heading in ["time [s]", "chamber [°C]", "spool [°C]", "Shupe [°/h]", "EO axial [°/h]", "EO radial [°/h]", "rate [°/h]"]
    {
        let _ = write!(out, "<th scope=\"col\">{heading}</th>");
    }
    out.push_str("</tr>\n</thead>\n<tbody>\n");
    for (_, row) in simulation.rows().enumerate().filter(chosen) {
        let Row { time, chamber, spool, shupe, eo_axial, eo_radial, rate, .. } = row;
        let _ = write!(out, "<tr><td>{time}</td><td>{}</td><td>{}</td>", signed(chamber, 3), signed(spool, 3));
        for part in [shupe, eo_axial, eo_radial, rate] {
            let _ = write!(out, "<td>{}</td>", signed(part, 5));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody>\n</table>\n</div>\n</details>\n");
}

/// A number with a true minus sign, and none before a zero.
pub(crate) fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| "-0.".contains(c));
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "\u{2212}") }
}
