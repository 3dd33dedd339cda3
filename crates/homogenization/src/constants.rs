//! The engineering constants of Table I and the dehomogenisation row of Table II.

use crate::Effective;
use fem_core::material::{ThermoElastic, TransverselyIsotropic};

/// One list of the constants: fields, names, and what is done to all of them.
macro_rules! constants {
    ($($(#[$about:meta])* $name:ident,)*) => {
        /// Effective constants of a transversely isotropic coil and its dehomogenisation row; z = fibre, r = across it. SI.
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub struct Constants { $($(#[$about])* pub $name: f64,)* }

        impl Constants {
            /// Applies `f` to each constant of two sets.
            pub fn combine(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
                Self { $($name: f(self.$name, other.$name),)* }
            }

            /// Names (as in the JSON output) and values.
            pub fn named(&self) -> [(&'static str, f64); 16] {
                [$((stringify!($name), self.$name),)*]
            }

            /// Constants from values in the order of the names.
            pub(crate) fn of([$($name),*]: [f64; 16]) -> Self {
                Self { $($name),* }
            }
        }
    };
}

constants! {
    /// Young's modulus along the fibre \[Pa\].
    e_z,
    /// Young's modulus across the fibre \[Pa\].
    e_r,
    /// Shear modulus in planes that hold the fibre \[Pa\].
    g_zr,
    /// Shear modulus across the fibre, between x and y \[Pa\].
    g_r,
    /// Plane-strain bulk modulus (C11 + C12)/2 \[Pa\].
    k_plane_strain,
    /// Transverse contraction per axial extension.
    nu_zr,
    /// Poisson's ratio across the fibre.
    nu_r,
    /// Axial contraction per transverse extension.
    nu_rz,
    /// Thermal expansion along the fibre \[1/K\].
    alpha_z,
    /// Thermal expansion across the fibre \[1/K\].
    alpha_r,
    /// Conductivity along the fibre \[W/(m K)\].
    k_z,
    /// Conductivity across the fibre \[W/(m K)\].
    k_r,
    /// Mean radial strain of the glass, (xx + yy)/2, per macroscopic xx.
    m_rx,
    /// Mean radial strain of the glass per macroscopic yy.
    m_ry,
    /// Mean radial strain of the glass per macroscopic zz at zero macroscopic xx and yy.
    m_rz,
    /// Mean radial strain of the glass per K at zero macroscopic strain \[1/K\].
    m_rt,
}

impl Constants {
    /// Constants of a law, of the conductivities along and across the fibre, and of the row M; `None` if the stiffness is singular.
    pub(crate) fn read(law: &ThermoElastic, [k_z, k_r]: [f64; 2], [m_rx, m_ry, m_rz, m_rt]: [f64; 4]) -> Option<Self> {
        let stiffness = &law.stiffness;
        let compliance = stiffness.try_inverse()?;
        let alpha = compliance * law.thermal_stress;
        Some(Self {
            e_z: 1.0 / compliance[(2, 2)],
            e_r: 1.0 / compliance[(0, 0)],
            g_zr: stiffness[(4, 4)],
            g_r: stiffness[(5, 5)],
            k_plane_strain: (stiffness[(0, 0)] + stiffness[(0, 1)]) / 2.0,
            nu_zr: -compliance[(0, 2)] / compliance[(2, 2)],
            nu_r: -compliance[(0, 1)] / compliance[(0, 0)],
            nu_rz: -compliance[(2, 0)] / compliance[(0, 0)],
            alpha_z: alpha[2],
            alpha_r: alpha[0],
            k_z,
            k_r,
            m_rx,
            m_ry,
            m_rz,
            m_rt,
        })
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
        let law = ThermoElastic { stiffness: self.stiffness, thermal_stress: self.thermal_stress };
        let radial = |load: usize| (self.glass_strain[(0, load)] + self.glass_strain[(1, load)]) / 2.0;
        Constants::read(&law, [self.conductivity_z, self.conductivity[(0, 0)]], [0, 1, 2, 4].map(radial))
    }
}
