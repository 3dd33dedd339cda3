//! Sizes of paper, and what is measured by them.

/// For which paper a figure is drawn; a page holds both and shows one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    /// Screens and paper.
    Wide,
    /// Phones.
    Narrow,
}

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
}

impl Size {
    pub(crate) fn measures(self) -> Measures {
        match self {
            Self::Wide => Measures { class: "wide", width: 900.0, font: 14.0, apart: [75.0, 42.0], columns: 2, first: true },
            Self::Narrow => Measures { class: "narrow", width: 360.0, font: 12.0, apart: [55.0, 30.0], columns: 1, first: false },
        }
    }
}
