//! The page of a simulation; its last section, [`provenance`], serves other pages as well.

mod facts;
mod provenance;

pub use provenance::provenance;

use charts::{heading, nice, row, sections, signed, significant};
use maud::{Markup, html};
use recording::Seconds;

use crate::band::CourseBand;
use crate::figures;
use crate::simulate::{Fields, Simulation};
use crate::summary::{Summary, entries};
use crate::sweep::Spread;

const PARTS: [(&str, &str); 3] =
    [("shupe", "Shupe"), ("eo_axial", "elasto-optic, axial strain"), ("eo_radial", "elasto-optic, radial strain")];

/// The page; temperature, strain and contributions of the turns only with `fields`, the design's tolerances only with `band`.
pub fn html(
    simulation: &Simulation,
    fields: Option<&Fields>,
    convergence: Option<&figures::Convergence>,
    band: Option<&CourseBand>,
) -> String {
    let profile = simulation.profile.fingerprint.file.file_name().unwrap_or_default().to_string_lossy();
    let title = format!("{} under {profile}", simulation.case.name);
    let [bias, others] = figures::elements(simulation, fields, convergence, band);
    let body = html! {
        (heading("Bias"))
        (bias)
        (sections(&[
            ("Summary", summary(simulation)),
            ("Figures", others),
            ("Coil", facts::coil(simulation)),
            ("Computation", computation(simulation)),
            facts::sources(simulation),
        ]))
    };
    charts::page(&title, &lead(simulation, band), &body)
}

/// The result in two sentences.
fn lead(simulation: &Simulation, band: Option<&CourseBand>) -> Markup {
    let Summary { peak, slope, errors, .. } = Summary::of(simulation);
    html! {
        p {
            "Computed thermal bias of a fibre-optic gyroscope's coil at rest. It is largest at " (Seconds(peak.time).to_string()) " s, " (signed(peak.rate, 4))
            " ± " (significant(errors.parts[4], 2)) " °/h."
            @if let Some(slope) = slope {
                " Regressed on the spool's temperature rate, the bias has a slope of " (signed(slope, 3)) " ± "
                (significant(errors.slope.unwrap_or_default(), 2)) " (°/h)/(°C/min); in a steady ramp it would be "
                (signed(simulation.steady.sensitivity.total(), 4)) " ± " (significant(simulation.steady.error_estimate, 2)) "."
            }
            " The errors are those of the computation."
            @if let Some(band) = band {
                @if let Some(Spread { mean, sd, quantiles: [_, p05, _, p95, _], .. }) = &band.largest {
                    " By the design's tolerances the largest |bias| of a unit, at whichever instant it comes, is " (significant(*mean, 3))
                    " ± " (significant(*sd, 2)) " °/h (mean and standard deviation over units), of nine units in ten "
                    (significant(*p05, 3)) " to " (significant(*p95, 3)) " °/h."
                }
                " At " (Seconds(peak.time).to_string()) " s the bias of a unit has a standard deviation of " (significant(band.peak, 2)) " °/h"
                @if let Some((key, share)) = band.shares.first() {
                    "; " (format!("{:.0}", 100.0 * share)) " % of that variance are due to " code { (key) }
                }
                "."
            }
        }
    }
}

fn computation(simulation: &Simulation) -> Markup {
    html! {
        (facts::computation(simulation))
        p {
            "The numbers follow from the file's spool, bonding and materials; where one of them was chosen to match a measurement, so were \
             these."
        }
    }
}

fn summary(simulation: &Simulation) -> Markup {
    let words = |[name, value, unit]: [String; 3]| {
        let named = PARTS.iter().find(|(key, _)| *key == name.trim());
        let part = if name.starts_with(' ') { "– " } else { "" };
        row(&format!("{part}{}", named.map_or(name.trim(), |(_, words)| *words)), nice(format!("{value} {unit}").trim_end()))
    };
    charts::facts("Summary", &entries(simulation).into_iter().map(words).collect::<Vec<_>>())
}

/// The text with a capital and a full stop.
pub(crate) fn sentence(text: &str) -> String {
    let mut rest = text.chars();
    let first: String = rest.next().into_iter().flat_map(char::to_uppercase).collect();
    charts::nice(&format!("{first}{}.", rest.as_str()))
}
