//! The faults of a layout.

/// Errors of the periodic cell with any inclusions.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LayoutError {
    /// The lattice vectors do not span a cell.
    #[error("the lattice vectors {0:?} m do not span a cell; give two finite vectors, the second to the left of the first")]
    Lattice([[f64; 2]; 2]),
    /// A number is outside its range.
    #[error("{field} = {value}, but it must be {range}")]
    Range {
        /// Name of the argument.
        field: &'static str,
        /// Its value.
        value: f64,
        /// The valid range, in words.
        range: &'static str,
    },
    /// The cell has no inclusion.
    #[error("the cell holds no fibre")]
    Empty,
    /// An outline is not an ellipse.
    #[error("inclusion {inclusion}, ring {ring}: centre, semi-axes and angle must be finite, the semi-axes greater than 0")]
    Outline {
        /// Inclusion number.
        inclusion: usize,
        /// Ring number from the inside.
        ring: usize,
    },
    /// Outlines and phases do not fit each other.
    #[error("inclusion {0}: needs as many phases as outlines, at least one, and only its innermost may be empty")]
    Phases(usize),
    /// A ring leaves the one around it.
    #[error(
        "inclusion {inclusion}: ring {ring} does not lie inside the ring around it (least thickness {thickness:.3e} m); \
         shrink it or its offset"
    )]
    Nesting {
        /// Inclusion number.
        inclusion: usize,
        /// The inner ring's number.
        ring: usize,
        /// Least thickness of the ring around it \[m\], negative where it sticks out.
        thickness: f64,
    },
    /// Two inclusions touch, overlap, or nearly so.
    #[error(
        "inclusions {first} and {second} leave a film of {film:.3e} m between them (negative: they overlap); move them apart"
    )]
    Overlap {
        /// One of the inclusions.
        first: usize,
        /// The other, or the same one's image in the next cell.
        second: usize,
        /// Least distance between them \[m\].
        film: f64,
    },
    /// The mesh's order or fineness is out of range.
    #[error("resolution: {0}")]
    Resolution(String),
    /// The matrix could not be triangulated.
    #[error("the matrix could not be meshed: {0}")]
    Triangulation(String),
}
