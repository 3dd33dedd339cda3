//! The cell around one fibre of a lattice: the lattice's Wigner–Seitz hexagon or square.

use crate::Error;
use std::f64::consts::PI;

/// Packing of the fibres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Packing {
    /// Orthocyclic: six nearest neighbours.
    #[default]
    Hexagonal,
    /// Layers right above each other: four nearest neighbours.
    Square,
}

impl Packing {
    /// Angle between the two lattice vectors, each as long as the pitch \[rad\].
    pub fn angle(self) -> f64 {
        match self {
            Self::Hexagonal => PI / 3.0,
            Self::Square => PI / 2.0,
        }
    }

    /// Number of the cell's sides, which is that of the nearest neighbours.
    pub fn sides(self) -> usize {
        match self {
            Self::Hexagonal => 6,
            Self::Square => 4,
        }
    }

    /// Angle from the middle of a side, where the film is narrowest, to the next corner \[°\].
    pub fn wedge(self) -> f64 {
        180.0 / self.sides() as f64
    }

    /// Area of the cell of a lattice of `pitch` \[m²\].
    pub fn area(self, pitch: f64) -> f64 {
        pitch * pitch * self.angle().sin()
    }
}

/// A fibre of concentric rings on a lattice, nearest neighbours along x.
#[derive(Debug, Clone, PartialEq)]
pub struct LatticeCell {
    packing: Packing,
    pitch: f64,
    radii: Vec<f64>,
}

impl LatticeCell {
    /// A cell of the hexagonal lattice: see [`Self::new`].
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn hexagonal(pitch: f64, radii: Vec<f64>) -> Result<Self, Error> {
        Self::new(Packing::Hexagonal, pitch, radii)
    }

    /// A cell of lattice `pitch` \[m\] and rings of outer `radii` \[m\] from the inside out.
    ///
    /// # Errors
    /// [`Error`] names what is out of range: radii must increase from 0 and stay below half the pitch.
    pub fn new(packing: Packing, pitch: f64, radii: Vec<f64>) -> Result<Self, Error> {
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
        Ok(Self { packing, pitch, radii })
    }

    /// Packing of the fibres.
    pub fn packing(&self) -> Packing {
        self.packing
    }

    /// Distance between neighbouring fibre axes \[m\].
    pub fn pitch(&self) -> f64 {
        self.pitch
    }

    /// Outer radii of the rings \[m\], from the inside out.
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Area of the hexagon, `p² √3 / 2`, or square \[m²\].
    pub fn area(&self) -> f64 {
        self.packing.area(self.pitch)
    }

    /// Exact area of each phase \[m²\]: the rings from the inside out, last the adhesive.
    pub fn phase_areas(&self) -> Vec<f64> {
        let mut inner = 0.0;
        let ring = |&r: &f64| {
            let before = std::mem::replace(&mut inner, r);
            PI * (r * r - before * before)
        };
        let mut areas: Vec<f64> = self.radii.iter().map(ring).collect();
        areas.push(self.area() - PI * inner * inner);
        areas
    }
}
