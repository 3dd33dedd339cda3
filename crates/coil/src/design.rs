//! What is built: winding, coil body, spool, surroundings, thermometer, optics. All SI.

use bias::Optics;
use fem_core::material::{Isotropic, TransverselyIsotropic};
use winding::Spec;

/// A coil on its spool in a test chamber.
///
/// The coil occupies `winding.inner_radius ≤ r ≤ body.outer_radius` and `0 ≤ y ≤ body.height`.
#[derive(Debug, Clone, PartialEq)]
pub struct Design {
    /// How the fibre is wound.
    pub winding: Spec,
    /// The homogenised coil.
    pub body: Body,
    /// The spool, or `None` for a coil that stands free.
    pub spool: Option<Spool>,
    /// What fills the rest of the chamber.
    pub surroundings: Surroundings,
    /// Where the thermometer sits.
    pub sensor: Sensor,
    /// The fibre's optics.
    pub optics: Optics,
    /// From macroscopic strain to the strain of the fibre's glass.
    pub dehomogenization: Dehomogenization,
}

/// The homogenised coil body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Outer radius \[m\].
    pub outer_radius: f64,
    /// Height along the axis \[m\].
    pub height: f64,
    /// Density \[kg/m³\].
    pub density: f64,
    /// Specific heat \[J/(kg K)\].
    pub specific_heat: f64,
    /// Elastic constants and expansion; z is the fibre, so the coil's hoop direction.
    pub elastic: TransverselyIsotropic,
    /// Conductivity along the fibre \[W/(m K)\] (unused in axisymmetry: no gradient points along the hoop).
    pub conductivity_z: f64,
    /// Conductivity across the fibre \[W/(m K)\].
    pub conductivity_r: f64,
}

/// An isotropic solid with its thermal properties.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Elastic constants and expansion.
    pub elastic: Isotropic,
    /// Conductivity \[W/(m K)\].
    pub conductivity: f64,
    /// Density \[kg/m³\].
    pub density: f64,
    /// Specific heat \[J/(kg K)\].
    pub specific_heat: f64,
}

/// Hub and flanges, one material.
#[derive(Debug, Clone, PartialEq)]
pub struct Spool {
    /// Material of hub and flanges.
    pub material: Solid,
    /// Wall thickness of the hub \[m\].
    pub hub_thickness: f64,
    /// Contact between hub and coil bore.
    pub hub_contact: Contact,
    /// Zero, one or two flanges, at most one a side.
    pub flanges: Vec<Flange>,
}

/// A flange of the spool.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flange {
    /// The side of the coil it stands at.
    pub side: Side,
    /// Thickness along the axis \[m\].
    pub thickness: f64,
    /// How far it reaches beyond the coil's outer radius \[m\], ≥ 0.
    pub overhang: f64,
    /// Contact between flange and coil face.
    pub contact: Contact,
}

/// A face of the coil body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The face y = 0.
    Left,
    /// The face y = height.
    Right,
}

/// How a face of the spool meets the coil.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Contact {
    /// Perfectly bonded.
    Bonded,
    /// The spool's part stands back by [`Contact::GAP`]; the medium fills the gap, no force crosses it.
    Gap,
}

impl Contact {
    /// Width of the gap at an unbonded face \[m\].
    pub const GAP: f64 = 0.2e-3;

    /// How far the spool's part stands back from the coil \[m\].
    pub fn gap(self) -> f64 {
        match self {
            Contact::Bonded => 0.0,
            Contact::Gap => Self::GAP,
        }
    }
}

/// The medium around the solids.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surroundings {
    /// Conductivity \[W/(m K)\].
    pub conductivity: f64,
    /// Density \[kg/m³\].
    pub density: f64,
    /// Specific heat \[J/(kg K)\].
    pub specific_heat: f64,
    /// Distance from the solids' bounding box to the chamber wall \[m\].
    pub margin: f64,
}

/// The spool's thermometer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensor {
    /// Radius \[m\].
    pub radius: f64,
    /// Position along the axis \[m\].
    pub y: f64,
}

/// The row M_r of the dehomogenisation matrix (Osunluk et al., eqs 4, 5):
/// `ε_r,glass = m_rx ε_rr + m_ry ε_yy + m_rz ε_hoop + m_rt ΔT`, total macroscopic strains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dehomogenization {
    /// Coefficient of the coil's radial strain.
    pub m_rx: f64,
    /// Coefficient of the coil's axial strain.
    pub m_ry: f64,
    /// Coefficient of the hoop strain.
    pub m_rz: f64,
    /// Coefficient of the temperature difference \[1/K\].
    pub m_rt: f64,
}
