//! Sizes of paper, and what is measured by them; a page holds each figure for both and shows one.

/// Measures of a size \[px\].
pub(crate) struct Measures {
    pub(crate) class: &'static str,
    pub(crate) width: f64,
    pub(crate) font: f64,
    /// Least distance of ticks along x and y.
    pub(crate) apart: [f64; 2],
    /// Most panels side by side.
    pub(crate) columns: usize,
    /// Whether it comes first on a page.
    pub(crate) first: bool,
    /// Whether it holds what a page's script reads.
    pub(crate) live: bool,
}

/// Screens and paper.
pub(crate) const WIDE: Measures =
    Measures { class: "wide", width: 900.0, font: 14.0, apart: [75.0, 42.0], columns: 3, first: true, live: true };
/// Phones.
pub(crate) const NARROW: Measures =
    Measures { class: "narrow", width: 360.0, font: 12.0, apart: [55.0, 30.0], columns: 1, first: false, live: true };
