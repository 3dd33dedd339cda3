//! Thermo-elastic laws as a 6×6 stiffness and a thermal stress vector.
//!
//! Voigt order xx, yy, zz, yz, xz, xy with engineering shear strains; stresses in Pa, strains dimensionless.
//! The stress is `C ε − β ΔT` with the thermal stress vector `β = C α` \[Pa/K\].

use crate::Error;
use nalgebra::{DMatrix, Matrix3, Matrix6, Vector3, Vector6};

/// A linear thermo-elastic law: stiffness \[Pa\] and thermal stress vector \[Pa/K\] in Voigt order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermoElastic {
    /// Stiffness `C` \[Pa\], symmetric positive definite.
    pub stiffness: Matrix6<f64>,
    /// Thermal stress vector `β = C α` \[Pa/K\].
    pub thermal_stress: Vector6<f64>,
}

/// An isotropic solid.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Isotropic {
    /// Young's modulus \[Pa\], > 0.
    pub youngs_modulus: f64,
    /// Poisson's ratio, in (−1, 0.5).
    pub poisson_ratio: f64,
    /// Coefficient of linear thermal expansion \[1/K\].
    pub thermal_expansion: f64,
}

/// A solid that is isotropic in the plane across its fibre direction z.
///
/// `ν_rz = ν_zr E_r / E_z` and `G_r = E_r / 2(1 + ν_r)` follow from the others.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TransverselyIsotropic {
    /// Young's modulus along the fibre \[Pa\], > 0.
    pub e_z: f64,
    /// Young's modulus across the fibre \[Pa\], > 0.
    pub e_r: f64,
    /// Shear modulus in planes that hold the fibre \[Pa\], > 0.
    pub g_zr: f64,
    /// Transverse contraction per axial extension under axial stress.
    pub nu_zr: f64,
    /// Poisson's ratio within the plane across the fibre.
    pub nu_r: f64,
    /// Thermal expansion along the fibre \[1/K\].
    pub alpha_z: f64,
    /// Thermal expansion across the fibre \[1/K\].
    pub alpha_r: f64,
}

fn require(holds: bool, field: &'static str, value: f64, range: impl Into<String>) -> Result<(), Error> {
    if holds { Ok(()) } else { Err(Error::Material { field, value, range: range.into() }) }
}

fn positive(field: &'static str, value: f64) -> Result<(), Error> {
    require(value.is_finite() && value > 0.0, field, value, "finite and greater than 0")
}

fn finite(field: &'static str, value: f64) -> Result<(), Error> {
    require(value.is_finite(), field, value, "finite")
}

impl Isotropic {
    /// First Lamé constant λ \[Pa\].
    pub fn lame_lambda(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.youngs_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus μ \[Pa\].
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// The law.
    ///
    /// # Errors
    /// [`Error::Material`] names the constant that is outside its range.
    pub fn law(&self) -> Result<ThermoElastic, Error> {
        positive("youngs_modulus", self.youngs_modulus)?;
        finite("thermal_expansion", self.thermal_expansion)?;
        let nu = self.poisson_ratio;
        let range = "greater than -1 and less than 0.5 (at 0.5 the solid is incompressible and its stiffness infinite)";
        require(nu > -1.0 && nu < 0.5, "poisson_ratio", nu, range)?;
        let (lambda, mu) = (self.lame_lambda(), self.shear_modulus());
        let mut stiffness = Matrix6::zeros();
        for i in 0..3 {
            for j in 0..3 {
                stiffness[(i, j)] = lambda;
            }
            stiffness[(i, i)] += 2.0 * mu;
            stiffness[(i + 3, i + 3)] = mu;
        }
        let beta = self.thermal_expansion * (3.0 * lambda + 2.0 * mu);
        Ok(ThermoElastic { stiffness, thermal_stress: Vector6::new(beta, beta, beta, 0.0, 0.0, 0.0) })
    }
}

impl TransverselyIsotropic {
    /// Transverse contraction seen along the fibre when stressed across it, `ν_rz = ν_zr E_r / E_z`.
    pub fn nu_rz(&self) -> f64 {
        self.nu_zr * self.e_r / self.e_z
    }

    /// Shear modulus across the fibre, `G_r = E_r / 2(1 + ν_r)` \[Pa\].
    pub fn g_r(&self) -> f64 {
        self.e_r / (2.0 * (1.0 + self.nu_r))
    }

    /// The factor on `e_r` at which the stiffness turns indefinite, `(1 − ν_r) E_z / (2 ν_zr² E_r)`.
    pub fn indefinite_at_e_r_factor(&self) -> f64 {
        (1.0 - self.nu_r) * self.e_z / (2.0 * self.nu_zr * self.nu_zr * self.e_r)
    }

    fn check(&self) -> Result<(), Error> {
        positive("e_z", self.e_z)?;
        positive("e_r", self.e_r)?;
        positive("g_zr", self.g_zr)?;
        finite("nu_zr", self.nu_zr)?;
        finite("alpha_z", self.alpha_z)?;
        finite("alpha_r", self.alpha_r)?;
        require(self.nu_r > -1.0 && self.nu_r < 1.0, "nu_r", self.nu_r, "greater than -1 and less than 1")?;
        let limit = 1.0 - 2.0 * self.nu_zr * self.nu_rz();
        let range = format!("less than 1 - 2 nu_zr^2 e_r/e_z = {limit:.6} (else the stiffness is not positive definite)");
        require(self.indefinite_at_e_r_factor() > 1.0, "nu_r", self.nu_r, range)
    }

    /// The law with z = fibre.
    ///
    /// # Errors
    /// [`Error::Material`] names the constant that is outside its range; the stiffness must be positive definite:
    /// `|ν_r| < 1` and `1 − ν_r > 2 ν_zr² E_r / E_z`.
    pub fn law(&self) -> Result<ThermoElastic, Error> {
        self.check()?;
        // the normal part of the compliance inverted in closed form: sums and differences of the two transverse directions
        let bulk = self.e_r / (2.0 * (1.0 - self.nu_r - 2.0 * self.nu_zr * self.nu_rz())); // plane-strain bulk modulus
        let g_r = self.g_r();
        let (c11, c12) = (bulk + g_r, bulk - g_r);
        let c13 = 2.0 * self.nu_zr * bulk;
        let c33 = self.e_z + 4.0 * self.nu_zr * self.nu_zr * bulk;
        #[rustfmt::skip]
        let stiffness = Matrix6::new(
            c11, c12, c13, 0.0, 0.0, 0.0,
            c12, c11, c13, 0.0, 0.0, 0.0,
            c13, c13, c33, 0.0, 0.0, 0.0,
            0.0, 0.0, 0.0, self.g_zr, 0.0, 0.0,
            0.0, 0.0, 0.0, 0.0, self.g_zr, 0.0,
            0.0, 0.0, 0.0, 0.0, 0.0, g_r,
        );
        let alpha = Vector6::new(self.alpha_r, self.alpha_r, self.alpha_z, 0.0, 0.0, 0.0);
        Ok(ThermoElastic { stiffness, thermal_stress: stiffness * alpha })
    }
}

/// A solid with three planes of symmetry, its axes along x, y, z.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Orthotropic {
    /// Young's modulus along x \[Pa\], > 0.
    pub e_x: f64,
    /// Young's modulus along y \[Pa\], > 0.
    pub e_y: f64,
    /// Young's modulus along z \[Pa\], > 0.
    pub e_z: f64,
    /// Shear modulus of the plane yz \[Pa\], > 0.
    pub g_yz: f64,
    /// Shear modulus of the plane xz \[Pa\], > 0.
    pub g_xz: f64,
    /// Shear modulus of the plane xy \[Pa\], > 0.
    pub g_xy: f64,
    /// Contraction along z per extension along y under stress along y, −ε_z/ε_y.
    pub nu_yz: f64,
    /// Contraction along z per extension along x under stress along x.
    pub nu_xz: f64,
    /// Contraction along y per extension along x under stress along x.
    pub nu_xy: f64,
    /// Thermal expansion along x \[1/K\].
    pub alpha_x: f64,
    /// Thermal expansion along y \[1/K\].
    pub alpha_y: f64,
    /// Thermal expansion along z \[1/K\].
    pub alpha_z: f64,
}

impl Orthotropic {
    /// The law.
    ///
    /// # Errors
    /// [`Error::Material`] names the constant that is outside its range; the stiffness must be positive definite.
    pub fn law(&self) -> Result<ThermoElastic, Error> {
        let Self { e_x, e_y, e_z, g_yz, g_xz, g_xy, nu_yz, nu_xz, nu_xy, alpha_x, alpha_y, alpha_z } = *self;
        let moduli = [("e_x", e_x), ("e_y", e_y), ("e_z", e_z), ("g_yz", g_yz), ("g_xz", g_xz), ("g_xy", g_xy)];
        moduli.into_iter().try_for_each(|(field, value)| positive(field, value))?;
        let ratios = [("nu_yz", nu_yz), ("nu_xz", nu_xz), ("nu_xy", nu_xy)];
        let expansions = [("alpha_x", alpha_x), ("alpha_y", alpha_y), ("alpha_z", alpha_z)];
        ratios.into_iter().chain(expansions).try_for_each(|(field, value)| finite(field, value))?;
        let (xy, xz, yz) = (-nu_xy / e_x, -nu_xz / e_x, -nu_yz / e_y);
        let compliance = Matrix3::new(1.0 / e_x, xy, xz, xy, 1.0 / e_y, yz, xz, yz, 1.0 / e_z);
        // scaled to a unit diagonal: whether it is positive definite does not depend on units
        let root = Matrix3::from_diagonal(&Vector3::new(e_x.sqrt(), e_y.sqrt(), e_z.sqrt()));
        let scaled = root * compliance * root;
        let minor = 1.0 - scaled[(0, 1)].powi(2);
        let inverse = scaled.try_inverse().filter(|_| minor > 0.0 && scaled.determinant() > 0.0);
        let Some(inverse) = inverse else {
            let field = if minor > 0.0 { "nu_xz" } else { "nu_xy" };
            let range =
                "such that the stiffness is positive definite with the other Poisson's ratios (nu_ij^2 < e_i/e_j is needed)";
            return Err(Error::Material { field, value: if minor > 0.0 { nu_xz } else { nu_xy }, range: range.into() });
        };
        let normal = root * inverse * root;
        let mut stiffness = Matrix6::from_diagonal(&Vector6::new(0.0, 0.0, 0.0, g_yz, g_xz, g_xy));
        stiffness.fixed_view_mut::<3, 3>(0, 0).copy_from(&((normal + normal.transpose()) / 2.0));
        let alpha = Vector6::new(alpha_x, alpha_y, alpha_z, 0.0, 0.0, 0.0);
        Ok(ThermoElastic { stiffness, thermal_stress: stiffness * alpha })
    }
}

/// The matrix that takes a stress (xx, yy, zz, yz, xz, xy) to its components along axes x, y turned by −`angle` \[rad\] about z: the
/// stress of a solid that was turned by `angle`. Its transpose takes strains with engineering shear back.
pub fn stress_rotation(angle: f64) -> Matrix6<f64> {
    let (s, c) = angle.sin_cos();
    #[rustfmt::skip]
    let rotation = Matrix6::new(
        c * c, s * s, 0.0, 0.0, 0.0, -2.0 * s * c,
        s * s, c * c, 0.0, 0.0, 0.0, 2.0 * s * c,
        0.0, 0.0, 1.0, 0.0, 0.0, 0.0,
        0.0, 0.0, 0.0, c, s, 0.0,
        0.0, 0.0, 0.0, -s, c, 0.0,
        s * c, -s * c, 0.0, 0.0, 0.0, c * c - s * s,
    );
    rotation
}

/// Rows of the Voigt order that are rr, yy, hoop and ry of a body of revolution: x is the radius, z the hoop.
const AXISYMMETRIC: [usize; 4] = [0, 1, 2, 5];

impl ThermoElastic {
    /// Stiffness (4 × 4) \[Pa\] and thermal stress (4 × 1) \[Pa/K\] in the order rr, yy, hoop, ry of [`crate::Form::AXISYMMETRIC_ELASTICITY`]: x of
    /// the law is the radius, y the axis of revolution, z the hoop.
    pub fn axisymmetric(&self) -> (DMatrix<f64>, DMatrix<f64>) {
        let stiffness = DMatrix::from_fn(4, 4, |i, j| self.stiffness[(AXISYMMETRIC[i], AXISYMMETRIC[j])]);
        (stiffness, DMatrix::from_fn(4, 1, |i, _| self.thermal_stress[AXISYMMETRIC[i]]))
    }

    /// The same solid turned by `angle` \[rad\] about z.
    pub fn turned(&self, angle: f64) -> Self {
        let rotation = stress_rotation(angle);
        Self { stiffness: rotation * self.stiffness * rotation.transpose(), thermal_stress: rotation * self.thermal_stress }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn coil() -> TransverselyIsotropic {
        TransverselyIsotropic {
            e_z: 14.5e9,
            e_r: 95.2e6,
            g_zr: 24.1e6,
            nu_zr: 0.392,
            nu_r: 0.979,
            alpha_z: 3.36e-6,
            alpha_r: 193e-6,
        }
    }

    #[test]
    fn exact_compliance_of_the_transversely_isotropic_law_returns_its_constants() {
        let c = coil();
        let s = c.law().unwrap().stiffness.try_inverse().unwrap();
        assert_relative_eq!(1.0 / s[(0, 0)], c.e_r, max_relative = 1e-12);
        assert_relative_eq!(1.0 / s[(2, 2)], c.e_z, max_relative = 1e-12);
        assert_relative_eq!(-s[(0, 1)] / s[(0, 0)], c.nu_r, max_relative = 1e-12);
        assert_relative_eq!(-s[(0, 2)] / s[(2, 2)], c.nu_zr, max_relative = 1e-12);
        assert_relative_eq!(-s[(2, 0)] / s[(0, 0)], c.nu_rz(), max_relative = 1e-12);
    }

    #[test]
    fn exact_isotropic_solid_is_the_isotropic_case_of_the_transverse_law() {
        let i = Isotropic { youngs_modulus: 70e9, poisson_ratio: 0.17, thermal_expansion: 0.55e-6 };
        let (e, nu, a) = (i.youngs_modulus, i.poisson_ratio, i.thermal_expansion);
        let t = TransverselyIsotropic { e_z: e, e_r: e, g_zr: i.shear_modulus(), nu_zr: nu, nu_r: nu, alpha_z: a, alpha_r: a };
        let (i, t) = (i.law().unwrap(), t.law().unwrap());
        assert_relative_eq!(i.stiffness, t.stiffness, max_relative = 1e-12);
        assert_relative_eq!(i.thermal_stress, t.thermal_stress, max_relative = 1e-12);
    }

    #[test]
    fn bounds_an_indefinite_law_is_refused_exactly_from_the_limit_on() {
        let limit = coil().indefinite_at_e_r_factor();
        let scaled = |f: f64| TransverselyIsotropic { e_r: 95.2e6 * f, ..coil() };
        assert!(scaled(limit * 0.999).law().unwrap().stiffness.cholesky().is_some());
        assert!(scaled(limit * 1.001).law().is_err());
        assert!(Isotropic { youngs_modulus: 1.0, poisson_ratio: 0.5, thermal_expansion: 0.0 }.law().is_err());
        assert!(Isotropic { youngs_modulus: f64::NAN, poisson_ratio: 0.3, thermal_expansion: 0.0 }.law().is_err());
    }

    fn wood() -> Orthotropic {
        let (nu_yz, nu_xz, nu_xy) = (0.021, 0.027, 0.55);
        let (g_yz, g_xz, g_xy) = (0.8e9, 0.9e9, 0.1e9);
        let (alpha_x, alpha_y, alpha_z) = (40e-6, 30e-6, 4e-6);
        Orthotropic { e_x: 1.1e9, e_y: 0.7e9, e_z: 12e9, g_yz, g_xz, g_xy, nu_yz, nu_xz, nu_xy, alpha_x, alpha_y, alpha_z }
    }

    #[test]
    fn exact_orthotropic_law_returns_its_constants_and_holds_the_isotropic_one() {
        let (o, law) = (wood(), wood().law().unwrap());
        let s = law.stiffness.try_inverse().unwrap();
        let found = [1.0 / s[(0, 0)], 1.0 / s[(1, 1)], 1.0 / s[(2, 2)], -s[(1, 2)] / s[(1, 1)], -s[(0, 2)] / s[(0, 0)]];
        for (found, given) in found.into_iter().zip([o.e_x, o.e_y, o.e_z, o.nu_yz, o.nu_xz]) {
            assert_relative_eq!(found, given, max_relative = 1e-12);
        }
        assert_relative_eq!(s * law.thermal_stress, Vector6::new(40e-6, 30e-6, 4e-6, 0.0, 0.0, 0.0), max_relative = 1e-12);
        let ([e_x, e_y, e_z], [nu_yz, nu_xz, nu_xy], [alpha_x, alpha_y, alpha_z]) = ([70e9; 3], [0.17; 3], [0.55e-6; 3]);
        let i = Isotropic { youngs_modulus: e_x, poisson_ratio: nu_xy, thermal_expansion: alpha_x };
        let [g_yz, g_xz, g_xy] = [i.shear_modulus(); 3];
        let same = Orthotropic { e_x, e_y, e_z, g_yz, g_xz, g_xy, nu_yz, nu_xz, nu_xy, alpha_x, alpha_y, alpha_z };
        assert_relative_eq!(same.law().unwrap().stiffness, i.law().unwrap().stiffness, max_relative = 1e-12);
        let refused = [Orthotropic { nu_xy: 1.3, ..o }, Orthotropic { nu_xz: 1.3, ..o }, Orthotropic { g_xy: 0.0, ..o }];
        let fields = refused.map(|o| match o.law() {
            Err(Error::Material { field, .. }) => field,
            other => panic!("{other:?}"),
        });
        assert_eq!(fields, ["nu_xy", "nu_xz", "g_xy"]);
    }

    #[test]
    fn exact_the_hoop_of_a_body_of_revolution_is_the_fibre() {
        let law = coil().law().unwrap();
        let (stiffness, stress) = law.axisymmetric();
        let c = &law.stiffness;
        assert_eq!([stiffness[(2, 2)], stiffness[(0, 2)], stiffness[(3, 3)]], [c[(2, 2)], c[(0, 2)], c[(5, 5)]]);
        assert_eq!((stiffness[(0, 3)], stress.as_slice()), (0.0, &[stress[0], stress[0], law.thermal_stress[2], 0.0][..]));
        assert!(stress[0] != stress[2]);
    }

    /// A quarter turn exchanges x and y; any turn and back is none; energy does not know of a turn of both solid and strain.
    #[test]
    fn exact_turns_about_z() {
        let law = wood().law().unwrap();
        let quarter = law.turned(std::f64::consts::FRAC_PI_2).stiffness;
        for (a, b) in [((0, 0), (1, 1)), ((0, 2), (1, 2)), ((3, 3), (4, 4)), ((5, 5), (5, 5)), ((0, 1), (1, 0))] {
            assert_relative_eq!(quarter[a], law.stiffness[b], max_relative = 1e-12);
        }
        let there = law.turned(0.7);
        assert!(there.stiffness[(0, 5)].abs() > 1e-3 * law.stiffness[(0, 0)]);
        assert_relative_eq!(there.turned(-0.7).stiffness, law.stiffness, max_relative = 1e-12, epsilon = 1e-3);
        // a uniaxial stress along the turned x axis stretches it by 1/e_x
        let stress = stress_rotation(0.7) * Vector6::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let strain = there.stiffness.try_inverse().unwrap() * stress;
        assert_relative_eq!(stress.dot(&strain), 1.0 / wood().e_x, max_relative = 1e-12);
    }
}
