//! Line plots as inline SVG: axes with round ticks, labelled units, lines that colour-blind readers tell apart by colour and dash.
//!
//! Colours come from the page's style sheet by class, so that a plot follows the page into the dark. A series of any length is
//! thinned to at most [`MOST_POINTS`] points without losing an extreme.

mod figure;
mod scale;
mod series;

pub(crate) use figure::{Figure, Size};
pub(crate) use scale::Axis;
pub(crate) use series::{Series, Style, Thinning};

/// Most points of a drawn line.
pub(crate) const MOST_POINTS: usize = 2000;
