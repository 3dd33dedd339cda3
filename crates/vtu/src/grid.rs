//! An unstructured grid of quadrilaterals.

use std::io::{self, ErrorKind, Write};

use crate::Array;
use crate::array::written;

/// VTK's number of a quadrilateral.
const QUADRILATERAL: u8 = 9;

/// Points, the quadrilaterals between them, and values at both.
///
/// Where a field jumps between two elements, each has points of its own.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grid {
    /// Positions.
    pub points: Vec<[f64; 3]>,
    /// Numbers of four points, in order around the cell.
    pub quadrilaterals: Vec<[usize; 4]>,
    /// Values at the points.
    pub of_points: Vec<Array>,
    /// Values in the cells.
    pub of_cells: Vec<Array>,
}

impl Grid {
    /// Writes the grid as a `.vtu` file.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidInput`] names the array that does not fit the grid, or the cell that names no point; else what the writer says.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.check()?;
        let (points, cells) = (self.points.len(), self.quadrilaterals.len());
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(out, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>")?;
        writeln!(out, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">\n<Points>")?;
        Array::components("position", &["x", "y", "z"], self.points.iter().flatten().copied().collect()).write(out)?;
        writeln!(out, "</Points>\n<PointData>")?;
        self.of_points.iter().try_for_each(|array| array.write(out))?;
        writeln!(out, "</PointData>\n<CellData>")?;
        self.of_cells.iter().try_for_each(|array| array.write(out))?;
        writeln!(out, "</CellData>\n<Cells>")?;
        written(out, "Int64", "Name=\"connectivity\"", self.quadrilaterals.iter().map(<[usize; 4]>::as_slice), usize::to_string)?;
        let offsets: Vec<usize> = (1..=cells).map(|k| 4 * k).collect();
        written(out, "Int64", "Name=\"offsets\"", offsets.chunks(1), usize::to_string)?;
        written(out, "UInt8", "Name=\"types\"", vec![QUADRILATERAL; cells].chunks(1), u8::to_string)?;
        writeln!(out, "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
    }

    fn check(&self) -> io::Result<()> {
        let wrong = |text: String| Err(io::Error::new(ErrorKind::InvalidInput, text));
        let (points, cells) = (self.points.len(), self.quadrilaterals.len());
        for (arrays, places, what) in [(&self.of_points, points, "points"), (&self.of_cells, cells, "cells")] {
            if let Some(array) = arrays.iter().find(|array| array.places() != Some(places)) {
                return wrong(format!("{} does not have its values at each of {places} {what}", array.name));
            }
        }
        match self.quadrilaterals.iter().position(|cell| cell.iter().any(|&point| point >= points)) {
            Some(cell) => wrong(format!("cell {cell} names a point beyond the {points} that there are")),
            None => Ok(()),
        }
    }
}
