//! Component of a strain that is asked for.

use nalgebra::Vector6;

/// Whether a phase's free expansion counts as strain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Convention {
    /// Free expansion included, as in the row M and in measured displacements.
    Total,
    /// Less the free expansion α ΔT of the phase: the strain that stresses it.
    Mechanical,
}

/// A component of a strain: those in Voigt order, then those about the fibre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Component {
    /// Along x.
    Xx,
    /// Along y.
    Yy,
    /// Along the fibre.
    Zz,
    /// Engineering shear of the plane yz.
    Yz,
    /// Engineering shear of the plane xz.
    Xz,
    /// Engineering shear of the plane xy.
    Xy,
    /// (xx + yy)/2, the radial strain of the paper's Table II.
    MeanRadial,
    /// Away from the axis of the inclusion; none in the matrix.
    Radial,
    /// Around the axis of the inclusion; none in the matrix.
    Hoop,
}

impl Component {
    /// All of them.
    pub const ALL: [Self; 9] =
        [Self::Xx, Self::Yy, Self::Zz, Self::Yz, Self::Xz, Self::Xy, Self::MeanRadial, Self::Radial, Self::Hoop];

    /// Its name.
    pub fn name(self) -> &'static str {
        ["xx", "yy", "zz", "yz", "xz", "xy", "mean_radial", "radial", "hoop"][self as usize]
    }

    /// Its value of a strain in Voigt order, `axis` the unit vector away from the axis of the inclusion.
    pub fn of(self, strain: &Vector6<f64>, axis: Option<[f64; 2]>) -> Option<f64> {
        let along = |[c, s]: [f64; 2]| c * c * strain[0] + s * s * strain[1] + s * c * strain[5];
        Some(match self {
            Self::MeanRadial => (strain[0] + strain[1]) / 2.0,
            Self::Radial => along(axis?),
            Self::Hoop => axis.map(|[c, s]| along([-s, c]))?,
            voigt => strain[voigt as usize],
        })
    }
}
