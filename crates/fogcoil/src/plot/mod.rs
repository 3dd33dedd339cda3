//! Figures as SVG: panels of lines, heat maps or drawings with axes, labelled units, and colours that colour-blind readers tell apart.
//!
//! Colours come by class from a style sheet, so that a figure in a page follows it into the dark; alone it is black on white. A series
//! of any length is thinned to at most [`MOST_POINTS`] points without losing an extreme; a heat map is drawn in steps of colour, each
//! one path.

mod drawing;
mod figure;
mod map;
mod scale;
mod series;
mod style;

pub(crate) use drawing::{Area, Arrow, Drawing};
pub(crate) use figure::{Content, Figure, Height, Panel, Size};
pub(crate) use map::{Colours, HeatMap};
pub(crate) use scale::Axis;
pub(crate) use series::{Series, Style, Thinning};
pub(crate) use style::page_style;

/// Most points of a drawn line.
pub(crate) const MOST_POINTS: usize = 2000;
