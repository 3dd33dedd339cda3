//! Pages for people: HTML that needs nothing but itself, on paper, phone and screen, in light and dark. Here the page of a simulation;
//! [`page`] and the tables serve others as well.

mod data;
mod facts;
mod provenance;
mod tables;
mod whole;

use coil::TurnFields;

use crate::figures;
use crate::picture::escape;
use crate::plot::page_style;
use crate::simulate::Simulation;
use crate::summary::{Summary, entries};
use crate::table::significant;

pub(crate) use data::with_data;
pub use provenance::provenance;
pub use tables::{Cells, facts, grid, nice, row};
pub use whole::faults;

/// Parts of the bias, in words.
const PARTS: [(&str, &str); 3] =
    [("shupe", "Shupe"), ("eo_axial", "elasto-optic, axial strain"), ("eo_radial", "elasto-optic, radial strain")];
const STYLE: &str = include_str!("style.css");

/// The page; temperature, strain and contributions of the turns only with `fields`.
pub fn html(simulation: &Simulation, fields: Option<&TurnFields>, convergence: Option<&figures::Convergence>) -> String {
    let profile = simulation.profile.fingerprint.file.file_name().unwrap_or_default().to_string_lossy();
    let title = format!("{} under {profile}", simulation.case.name);
    let mut out = String::new();
    summary(&mut out, simulation);
    out.push_str("<h2>Figures</h2>\n");
    out.push_str(&figures::elements(simulation, fields, convergence));
    facts::coil(&mut out, simulation);
    facts::computation(&mut out, simulation);
    facts::sources(&mut out, simulation);
    page(&title, &lead(simulation), &out)
}

/// A page that needs nothing but itself: `lead` in its header, `body` below, both HTML; the title is text.
pub fn page(title: &str, lead: &str, body: &str) -> String {
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
            " Regressed on the spool's temperature rate, the bias has a slope of {} ± {} (°/h)/(°C/min); in a steady ramp it would be {} ± {}.",
            signed(slope, 3),
            significant(summary.errors.slope.unwrap_or_default(), 2),
            signed(simulation.steady.sensitivity.total(), 4),
            significant(simulation.steady.error_estimate, 2),
        )
    });
    format!(
        "<p>Computed thermal bias of a fibre-optic gyroscope's coil at rest. It is largest at {} s, {} ± {} °/h.{slope} The \
         errors are those of the computation.</p>\n",
        peak.time,
        signed(peak.rate, 4),
        significant(summary.errors.parts[4], 2),
    )
}

fn summary(out: &mut String, simulation: &Simulation) {
    let rows: Vec<(String, String)> = entries(simulation)
        .into_iter()
        .map(|[name, value, unit]| {
            let named = PARTS.iter().find(|(key, _)| *key == name.trim());
            let part = if name.starts_with(' ') { "– " } else { "" };
            (format!("{part}{}", named.map_or(name.trim(), |(_, words)| *words)), nice(format!("{value} {unit}").trim_end()))
        })
        .collect();
    out.push_str("<h2>Summary</h2>\n");
    facts(out, "Summary", &rows);
}

/// A number with a true minus sign, and none before a zero.
pub(crate) fn signed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.chars().all(|c| "-0.".contains(c));
    if zero { text.trim_start_matches('-').to_owned() } else { text.replace('-', "\u{2212}") }
}
