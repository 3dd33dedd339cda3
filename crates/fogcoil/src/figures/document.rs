//! Figures as files, and how many turns they are drawn of.

/// Most turns of which fields are drawn: twice a 5 km coil of 6 cm diameter; more would take gigabytes.
pub const MOST_TURNS: usize = 50_000;

/// A figure as a file: name without extension, and SVG document.
pub type Document = (&'static str, String);
