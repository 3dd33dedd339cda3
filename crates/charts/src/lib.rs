//! Figures as SVG and pages as HTML, for people: they need nothing but themselves, on paper, phone and screen, in light and dark.
//!
//! - A [`Figure`] holds [`Panel`]s of [`Series`], a [`HeatMap`] or a [`Drawing`] over two [`Axis`]; it stands alone
//!   ([`Figure::document`]) or in a page, with tables of its data ([`Figure::element`]).
//! - A [`page()`] frames [`facts`], [`grid`]s and figures, one that is [`scripted`] acts by itself; [`faults`] says what a browser, a printer or a screen reader would stumble over.
//! - [`Svg`] is for pictures of another kind, in a [`Frame`]; text that enters it is escaped, as maud's templates do in pages.
//! - [`significant`], [`signed`] and [`nice`] put numbers into words.
//!
//! Colours come by class from a style sheet, so that a figure in a page follows it into the dark; alone it is black on white.
//! Colour-blind readers tell them apart. A series of any length is thinned to at most [`MOST_POINTS`] points without losing an
//! extreme; a heat map is drawn in steps of colour, each one path. The same input gives the same bytes.
//!
//! Conventions: labels carry their units, e.g. "time \[h\]"; measures are in px, y of a picture downwards, of a panel upwards. What is
//! not a number is left out. The crate touches no file.
//!
//! ```
//! use charts::{Axis, Figure, Panel, Series, Style, faults, page};
//! use maud::html;
//!
//! let decay = |n: usize| (n as f64, (-0.05 * n as f64).exp());
//! let panel = Panel::lines(
//!     Axis::tight("time [min]", 1.0),
//!     Axis::round("temperature [K]", 0.1),
//!     20.0,
//!     vec![Series::computed("above ambient", Style::First, 100, decay)],
//! );
//! let figure = Figure {
//!     id: "decay",
//!     title: "A body cools".into(),
//!     description: "Temperature over time.".into(),
//!     caption: "One exponential.".into(),
//!     columns: 1,
//!     panels: vec![panel],
//! };
//! assert!(figure.document().contains(">time [min]</text>"));
//! let page = page("Cooling", &html! { p { "In a draught & alone." } }, &html! { h2 { "Course" } (figure.element()) });
//! assert_eq!(faults(&page), [""; 0]);
//! ```

mod data;
mod drawing;
mod faults;
mod figure;
mod map;
mod number;
mod page;
mod panel;
mod scale;
mod series;
mod size;
mod style;
mod svg;
mod tables;

pub use drawing::{Area, Arrow, Drawing, Fill};
pub use faults::faults;
pub use figure::Figure;
pub use map::{Colours, HeatMap};
pub use number::{nice, signed, significant};
pub use page::{HAND, Script, heading, page, scripted, sections};
pub use panel::{Content, Height, Panel};
pub use scale::{Axis, Ends};
pub use series::{MOST_POINTS, Series, Style, Thinning};
pub use svg::{Attributes, Frame, Svg};
pub use tables::{Cells, facts, grid, row};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
