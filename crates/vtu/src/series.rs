//! Grids in time.

use std::io::{self, Write};

use crate::array::escaped;

/// Files with their instants; several files at one instant are its parts.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Series {
    /// Instants and files, in order of time.
    pub entries: Vec<Entry>,
}

/// A file of a [`Series`].
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// Instant, in the unit of the caller; a series has one.
    pub time: f64,
    /// Number of the part; the same at every instant.
    pub part: usize,
    /// Path from the folder of the series.
    pub file: String,
}

impl Series {
    /// Writes the series as a `.pvd` file; instants read back to the same double.
    ///
    /// # Errors
    /// The error of the writer.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(out, "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>")?;
        for Entry { time, part, file } in &self.entries {
            writeln!(out, "<DataSet timestep=\"{time}\" group=\"\" part=\"{part}\" file=\"{}\"/>", escaped(file))?;
        }
        writeln!(out, "</Collection>\n</VTKFile>")
    }
}
