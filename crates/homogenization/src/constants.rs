//! The engineering constants of Table I and the dehomogenisation row of Table II.

use crate::Effective;
use fem_core::material::TransverselyIsotropic;

/// Effective constants of a transversely isotropic coil and its dehomogenisation row; z = fibre, r = across it. SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// Young's modulus along the fibre \[Pa\].
    pub e_z: f64,
    /// Young's modulus across the fibre \[Pa\].
    pub e_r: f64,
    /// Shear modulus in planes that hold the fibre \[Pa\].
    pub g_zr: f64,
    /// Shear modulus across the fibre, between x and y \[Pa\].
    pub g_r: f64,
    /// Plane-strain bulk modulus (C11 + C12)/2 \[Pa\].
    pub k_plane_strain: f64,
    /// Transverse contraction per axial extension.
    pub nu_zr: f64,
    /// Poisson's ratio across the fibre.
    pub nu_r: f64,
    /// Axial contraction per transverse extension.
    pub nu_rz: f64,
    /// Thermal expansion along the fibre \[1/K\].
    pub alpha_z: f64,
    /// Thermal expansion across the fibre \[1/K\].
    pub alpha_r: f64,
    /// Conductivity along the fibre \[W/(m K)\].
    pub k_z: f64,
    /// Conductivity across the fibre \[W/(m K)\].
    pub k_r: f64,
    /// Mean radial strain of the glass, (xx + yy)/2, per macroscopic xx.
    pub m_rx: f64,
    /// Mean radial strain of the glass per macroscopic yy.
    pub m_ry: f64,
    /// Mean radial strain of the glass per macroscopic zz at zero macroscopic xx and yy.
    pub m_rz: f64,
    /// Mean radial strain of the glass per K at zero macroscopic strain \[1/K\].
    pub m_rt: f64,
}

impl Constants {
    /// Applies `f` to each constant of two sets.
    pub fn combine(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let (a, b) = (self, other);
        Self {
            e_z: f(a.e_z, b.e_z),
            e_r: f(a.e_r, b.e_r),
            g_zr: f(a.g_zr, b.g_zr),
            g_r: f(a.g_r, b.g_r),
            k_plane_strain: f(a.k_plane_strain, b.k_plane_strain),
            nu_zr: f(a.nu_zr, b.nu_zr),
            nu_r: f(a.nu_r, b.nu_r),
            nu_rz: f(a.nu_rz, b.nu_rz),
            alpha_z: f(a.alpha_z, b.alpha_z),
            alpha_r: f(a.alpha_r, b.alpha_r),
            k_z: f(a.k_z, b.k_z),
            k_r: f(a.k_r, b.k_r),
            m_rx: f(a.m_rx, b.m_rx),
            m_ry: f(a.m_ry, b.m_ry),
            m_rz: f(a.m_rz, b.m_rz),
            m_rt: f(a.m_rt, b.m_rt),
        }
    }

    /// Names (as in the JSON output) and values.
    pub fn named(&self) -> [(&'static str, f64); 16] {
        [
            ("e_z", self.e_z),
            ("e_r", self.e_r),
            ("g_zr", self.g_zr),
            ("g_r", self.g_r),
            ("k_plane_strain", self.k_plane_strain),
            ("nu_zr", self.nu_zr),
            ("nu_r", self.nu_r),
            ("nu_rz", self.nu_rz),
            ("alpha_z", self.alpha_z),
            ("alpha_r", self.alpha_r),
            ("k_z", self.k_z),
            ("k_r", self.k_r),
            ("m_rx", self.m_rx),
            ("m_ry", self.m_ry),
            ("m_rz", self.m_rz),
            ("m_rt", self.m_rt),
        ]
    }

    /// The law of the homogenised coil. It takes the plane across the fibre for isotropic with `e_r` and `nu_r`; of square packing it
    /// therefore has the shear modulus at 45° to the axes instead of `g_r`.
    pub fn elastic(&self) -> TransverselyIsotropic {
        TransverselyIsotropic {
            e_z: self.e_z,
            e_r: self.e_r,
            g_zr: self.g_zr,
            nu_zr: self.nu_zr,
            nu_r: self.nu_r,
            alpha_z: self.alpha_z,
            alpha_r: self.alpha_r,
        }
    }
}

impl Effective {
    /// Shear moduli across the fibre \[Pa\]: C66, between the axes x and y, and (C11 − C12)/2, between the directions at 45° to them. Equal
    /// under hexagonal packing, which is isotropic across the fibre; the greatest and the least, in one order or the other, under square
    /// packing, which is not.
    pub fn shear_moduli_across(&self) -> [f64; 2] {
        [self.stiffness[(5, 5)], (self.stiffness[(0, 0)] - self.stiffness[(0, 1)]) / 2.0]
    }

    /// The constants, read along the axes x and y to the nearest neighbours. Hexagonal packing is isotropic across the fibre; square
    /// packing is not: `e_r`, `nu_r` and `g_r` are then three constants of their own, see [`Self::shear_moduli_across`].
    ///
    /// `None` if the stiffness is singular, which no positive definite set of constituents makes.
    pub fn constants(&self) -> Option<Constants> {
        let compliance = self.stiffness.try_inverse()?;
        let alpha = compliance * self.thermal_stress;
        let radial = |load: usize| (self.glass_strain[(0, load)] + self.glass_strain[(1, load)]) / 2.0;
        Some(Constants {
            e_z: 1.0 / compliance[(2, 2)],
            e_r: 1.0 / compliance[(0, 0)],
            g_zr: self.stiffness[(4, 4)],
            g_r: self.stiffness[(5, 5)],
            k_plane_strain: (self.stiffness[(0, 0)] + self.stiffness[(0, 1)]) / 2.0,
            nu_zr: -compliance[(0, 2)] / compliance[(2, 2)],
            nu_r: -compliance[(0, 1)] / compliance[(0, 0)],
            nu_rz: -compliance[(2, 0)] / compliance[(0, 0)],
            alpha_z: alpha[2],
            alpha_r: alpha[0],
            k_z: self.conductivity_z,
            k_r: self.conductivity[(0, 0)],
            m_rx: radial(0),
            m_ry: radial(1),
            m_rz: radial(2),
            m_rt: radial(4),
        })
    }
}
