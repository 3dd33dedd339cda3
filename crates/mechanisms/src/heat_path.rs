//! Paths of heat that a library tabulates.

use coil::Design;

/// A path of heat whose strength is a mechanism's parameter: the library tabulates the coil along it.
#[derive(Debug, Clone)]
pub struct HeatPath {
    /// Number of places at which a design has it, the values of the mechanism's choice; 0 for none.
    pub places: fn(&Design) -> usize,
    /// Values of the path's coordinate that are tabulated, increasing, among them 0, the design as it is; the response is smooth in it.
    pub nodes: Vec<f64>,
    /// The design at a coordinate, of the path at a place, counted from 0.
    pub design: fn(&Design, usize, f64) -> Design,
    /// Coordinate of a small change by which a mismatch is sought in the heat flow; `None` where it is sought elsewhere.
    pub nudge: Option<f64>,
    /// The constant of the design on which the mechanism's only parameter is a factor, the coordinate its logarithm; `None` of any other path.
    pub factor_on: Option<coil::Parameter>,
}
