//! The design: winding, coil body, spool, surroundings, thermometer, optics. All SI.

use bias::Optics;
use fem_core::material::{Isotropic, TransverselyIsotropic};
use winding::Spec;

/// A coil on its spool in a test chamber.
///
/// The coil occupies `winding.inner_radius ≤ r ≤ body.outer_radius` and `0 ≤ y ≤ body.height`.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Design {
    /// The winding of the fibre.
    pub winding: Spec,
    /// The homogenised coil.
    pub body: Body,
    /// The spool, or `None` for a coil that stands free.
    pub spool: Option<Spool>,
    /// Medium in the rest of the chamber.
    pub surroundings: Surroundings,
    /// Dependence of stiffness and bonds on temperature and time.
    pub mechanics: Mechanics,
    /// Heat paths and sources beyond conduction through solids and medium.
    pub heat: HeatPaths,
    /// Place of the thermometer.
    pub sensor: Sensor,
    /// The fibre's optics.
    pub optics: Optics,
    /// Temperature dependence of the optics and the read-out, beyond their constants.
    pub drifts: Drifts,
    /// Map from macroscopic strain to the strain of the fibre's glass.
    pub dehomogenization: Dehomogenization,
}

/// The homogenised coil body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Flange {
    /// The side of the coil it stands at.
    pub side: Side,
    /// Thickness along the axis \[m\].
    pub thickness: f64,
    /// Overhang beyond the coil's outer radius \[m\], ≥ 0.
    pub overhang: f64,
    /// Contact between flange and coil face.
    pub contact: Contact,
}

/// A face of the coil body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Side {
    /// The face y = 0.
    Left,
    /// The face y = height.
    Right,
}

/// Contact of a face of the spool with the coil.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Contact {
    /// Perfectly bonded.
    Bonded,
    /// The spool's part stands back by [`Contact::GAP`]; the medium fills the gap, no force crosses it.
    Gap,
}

impl Contact {
    /// Width of the gap at an unbonded face \[m\].
    pub const GAP: f64 = 0.2e-3;

    /// Distance by which the spool's part stands back from the coil \[m\].
    pub fn gap(self) -> f64 {
        match self {
            Contact::Bonded => 0.0,
            Contact::Gap => Self::GAP,
        }
    }
}

/// The medium around the solids.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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

/// Dependence of the coil's transverse stiffness, or of its bond to a flange, on temperature and time. Temperatures are means over the coil.
///
/// The law is incremental: stress rates follow strain rates and temperature rates with the stiffness of the moment.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Mechanics {
    /// Constant.
    #[default]
    Elastic,
    /// Factors on the coil's transverse constants by temperature, linear between rows, constant beyond; at least one row, increasing.
    TemperatureTable(Vec<FactorsAt>),
    /// The transverse moduli relax: `E(t)/E(0) = 1 − fraction + fraction e^(−t/time)`.
    Relaxing {
        /// Share that relaxes, 0 to 0.8.
        fraction: f64,
        /// Relaxation time \[s\], > 0.
        time: f64,
    },
    /// The outer part of the bond between coil and flange carries no further force below a temperature, and carries again above it plus
    /// the hysteresis. Heat still passes. The law is incremental: what the bond carried when it opened stays, nothing jumps.
    Opening(Opening),
}

/// A row of [`Mechanics::TemperatureTable`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FactorsAt {
    /// Mean temperature of the coil, in the unit of the profile.
    pub temperature: f64,
    /// Factor on E_r, G_zr (and so on G_r), > 0.
    pub transverse_modulus: f64,
    /// Factor on α_r.
    pub transverse_expansion: f64,
}

/// A bond that opens in the cold.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Opening {
    /// The flange, which must be bonded.
    pub side: Side,
    /// Opens below this mean temperature of the coil.
    pub below: f64,
    /// Closes above `below + hysteresis`, ≥ 0.
    pub hysteresis: f64,
    /// Open share of the annulus's width, from the outer edge inwards, in (0, 1).
    pub fraction: f64,
}

/// Heat paths and sources beyond conduction through solids and medium. Empty by default.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct HeatPaths {
    /// Thermal contact resistance between hub and coil bore \[m² K/W\]; 0 is a perfect contact.
    pub hub_resistance: f64,
    /// Thermal contact resistances between flanges and the coil's faces; a face that is not listed has none.
    #[cfg_attr(feature = "serde", serde(default))]
    pub flange_contacts: Vec<FlangeContact>,
    /// Mounts at the outer faces of the spool's ends.
    pub mounts: Vec<Mount>,
    /// Power dissipated in the spool's ends from the first instant of a profile.
    pub heaters: Vec<Heater>,
    /// Film that couples every surface of the solids to the chamber's temperature \[W/(m² K)\], in place of the still medium.
    pub film: Option<f64>,
}

impl HeatPaths {
    /// Thermal contact resistance between the flange on a side and the coil's face \[m² K/W\].
    pub fn flange_resistance(&self, side: Side) -> f64 {
        self.flange_contacts.iter().filter(|c| c.side == side).map(|c| c.resistance).sum()
    }
}

/// A thermal contact resistance between a flange and the coil's face.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FlangeContact {
    /// The flange.
    pub side: Side,
    /// Resistance \[m² K/W\], ≥ 0; 0 is a perfect contact.
    pub resistance: f64,
}

/// A mount that couples the outer face of a flange to the mount's temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mount {
    /// The flange.
    pub side: Side,
    /// Conductance \[W/(m² K)\], > 0.
    pub conductance: f64,
}

/// Power dissipated evenly in a flange.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Heater {
    /// The flange.
    pub side: Side,
    /// Power \[W\].
    pub power: f64,
}

/// The spool's thermometer.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sensor {
    /// Radius \[m\].
    pub radius: f64,
    /// Position along the axis \[m\].
    pub y: f64,
    /// Its own first-order lag \[s\], ≥ 0.
    pub lag: f64,
}

/// Effects that vanish at a reference temperature. None by default.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Drifts {
    /// Temperature at which they vanish, in the unit of the profile.
    pub reference: f64,
    /// b in ∂n/∂T = (∂n/∂T)₀ + b (T − reference), with T the temperature of each turn \[1/K²\].
    pub thermo_optic_curvature: f64,
    /// Bias of the read-out per kelvin of the thermometer's place above the reference \[rad/(s K)\].
    pub read_out: f64,
}

impl Default for Drifts {
    fn default() -> Self {
        Self { reference: 20.0, thermo_optic_curvature: 0.0, read_out: 0.0 }
    }
}

/// The row M_r of the dehomogenisation matrix (Osunluk et al., eqs 4, 5):
/// `ε_r,glass = m_rx ε_rr + m_ry ε_yy + m_rz ε_hoop + m_rt ΔT`, total macroscopic strains.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
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
