//! The figures of a coil and of a simulation, after Osunluk et al., Figs. 2 and 4 to 7, and two that the paper does not have: the origin of the
//! bias in the cross-section, and the convergence of the sensitivity.
//!
//! Each figure is drawn once and stands either in a page ([`crate::report`]) or alone as an SVG document ([`documents`]).

mod blocks;
mod contributions;
mod convergence;
mod course;
mod document;
mod fields;
mod instants;
mod model;
mod section;
mod section_maps;
mod signatures;
mod spools;

use charts::Figure;
use maud::{Markup, html};

use crate::band::CourseBand;
use crate::input::CoilCase;
use crate::simulate::{Fields, Simulation};

pub use crate::turn_bias::Contributions;
pub use contributions::contributions_in_ramp;
pub use convergence::{Convergence, convergence};
pub use course::Measured;
pub(crate) use course::time_axis;
pub use document::{Document, MOST_TURNS};
pub(crate) use model::side_by_side;
pub use signatures::signatures;
pub use spools::{OnSpool, spools, spools_element};

/// All figures; those of the fields only with `fields`.
fn all<'a>(
    simulation: &'a Simulation,
    fields: Option<&Fields>,
    measured: &[Measured],
    band: Option<&'a CourseBand>,
) -> Vec<Figure<'a>> {
    let mut figures: Vec<Figure> = fields.into_iter().flat_map(|fields| section::all(simulation, fields)).collect();
    figures.push(model::figure(simulation.case));
    figures.extend(course::all(simulation, measured, band));
    if let Some(fields) = fields {
        figures.extend(fields::all(simulation, &fields.turns));
        figures.extend(contributions::figure(simulation, &fields.turns));
    }
    figures
}

/// A coil on its spool in section, an SVG document.
pub fn section(case: &CoilCase) -> String {
    model::figure(case).document()
}

/// All figures of a simulation as files of their own; those of temperature and strain along the fibre and of the turns' contributions
/// only with `fields`. Sensitivities that were `measured` stand beside the computed one.
pub fn documents(simulation: &Simulation, fields: Option<&Fields>, measured: &[Measured]) -> Vec<Document> {
    all(simulation, fields, measured, None).iter().map(|figure| (figure.id, figure.document())).collect()
}

/// All figures as elements of a page, in wide and narrow, each with its data: the bias in time, and the others. Rate and thermometer stand within their
/// `band`, if there is one.
pub fn elements(
    simulation: &Simulation,
    fields: Option<&Fields>,
    convergence: Option<&Convergence>,
    band: Option<&CourseBand>,
) -> [Markup; 2] {
    let last = convergence.map(|measured| convergence::figure(simulation.case, measured));
    let all = all(simulation, fields, &[], band);
    let (bias, others): (Vec<&Figure>, Vec<&Figure>) = all.iter().chain(&last).partition(|figure| figure.id == course::BIAS);
    [bias, others].map(|figures| html! { @for figure in figures { (figure.element()) } })
}
