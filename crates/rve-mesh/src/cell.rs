//! The hexagonal (orthocyclic) cell around one fibre: the lattice's Wigner–Seitz hexagon.

use crate::Error;
use std::f64::consts::PI;

/// A fibre of concentric rings on a hexagonal lattice, nearest neighbours along x.
#[derive(Debug, Clone, PartialEq)]
pub struct HexagonalCell {
    pitch: f64,
    radii: Vec<f64>,
}

impl HexagonalCell {
    /// A cell of lattice `pitch` \[m\] and rings of outer `radii` \[m\] from the inside out.
    ///
    /// # Errors
    /// [`Error`] names what is out of range: radii must increase from 0 and stay below half the pitch.
    pub fn new(pitch: f64, radii: Vec<f64>) -> Result<Self, Error> {
        if !(pitch.is_finite() && pitch > 0.0) {
            return Err(Error::Pitch(pitch));
        }
        let outermost = *radii.last().ok_or(Error::NoRing)?;
        let mut inner = 0.0;
        for (ring, &radius) in radii.iter().enumerate() {
            if !(radius.is_finite() && radius > inner) {
                return Err(Error::RingOrder { ring, radius, inner });
            }
            inner = radius;
        }
        if outermost >= pitch / 2.0 {
            return Err(Error::Overlap { radius: outermost, pitch });
        }
        Ok(Self { pitch, radii })
    }

    /// Distance between neighbouring fibre axes \[m\].
    pub fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Outer radii of the rings \[m\], from the inside out.
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Area of the hexagon, `p² √3 / 2` \[m²\].
    pub fn area(&self) -> f64 {
        self.pitch * self.pitch * 3f64.sqrt() / 2.0
    }

    /// Exact area of each phase \[m²\]: the rings from the inside out, last the adhesive.
    pub fn phase_areas(&self) -> Vec<f64> {
        let mut inner = 0.0;
        let mut areas: Vec<f64> = self
            .radii
            .iter()
            .map(|&r| {
                let area = PI * (r * r - inner * inner);
                inner = r;
                area
            })
            .collect();
        areas.push(self.area() - PI * inner * inner);
        areas
    }
}
