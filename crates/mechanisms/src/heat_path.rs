//! Paths of heat that a library tabulates.

use coil::Design;

/// A path of heat whose strength is a mechanism's first parameter: the library tabulates the coil along it.
#[derive(Debug, Clone)]
pub struct HeatPath {
    /// Number of places at which a design has it, the values of the mechanism's choice; 0 for none.
    pub places: fn(&Design) -> usize,
    /// Values of the path's coordinate that are tabulated, increasing, among them 0, the design as it is drawn; the response is smooth in it.
    pub nodes: Vec<f64>,
    /// The design at a coordinate, of the path at a place, counted from 0.
    pub design: fn(&Design, usize, f64) -> Design,
    /// Coordinate of the parameter's value, where the path leaves the constants of the design as they are: where it leads, the model is made about it.
    /// `None` of a path that moves constants.
    pub coordinate: Option<fn(f64) -> f64>,
    /// Value of the parameter at which the coordinate is 0: where the path leads nowhere.
    pub nowhere: f64,
    /// Change of the coordinate by which a mismatch is sought in the heat flow; `None` where it is sought elsewhere.
    pub nudge: Option<f64>,
    /// The constant of the design on which the mechanism's only parameter is a factor, the coordinate its logarithm; `None` of any other path.
    pub factor_on: Option<coil::Parameter>,
    /// A path of another form that does nearly the same at a value of the parameter, in words, with the key of a coil file that draws it: what is left of
    /// it beside this one is put on constants and instruments.
    pub imitates: Option<fn(&Design, f64) -> String>,
}

/// A path of heat that a model's design has: how far along it the design is.
#[derive(Debug, Clone, PartialEq)]
pub struct AtWork {
    /// Id of the mechanism whose path it is.
    pub id: String,
    /// Number of the place, of those at which the design has it, counted from 0.
    pub place: usize,
    /// Its coordinate.
    pub coordinate: f64,
}

impl AtWork {
    /// Whether another is the same path, in any design.
    pub(crate) fn is(&self, id: &str, place: usize) -> bool {
        self.id == id && self.place == place
    }
}
