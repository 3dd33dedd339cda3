//! One coated fibre alone in air: concentric cylinders whose outside is free, solved exactly.

use crate::bounds::cylinder::axisymmetric;
use crate::bounds::phases::phases_of_fibre;
use crate::{Error, Ring};
use nalgebra::{Matrix2, Vector2};

/// Response of a coated fibre whose outside is free of traction, far from its ends. Its rings share one axial strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeFibre {
    /// Young's modulus along the fibre, over its whole cross-section \[Pa\].
    pub youngs_modulus: f64,
    /// Thermal expansion along the fibre \[1/K\], which is the axial strain of the glass per K.
    pub expansion: f64,
    /// Thermal expansion of the outer diameter \[1/K\].
    pub expansion_across: f64,
    /// Mean radial strain of the glass per K \[1/K\], total: its own free expansion included.
    pub glass_radial_strain: f64,
    /// Mean radial strain of the glass per axial strain, where the fibre is pulled.
    pub glass_radial_strain_per_axial: f64,
}

/// The fibre of `rings` from the inside out in air: Lamé's solution in each ring, `u = A r + B/r`, under one axial strain ε (generalised
/// plane strain), without stress on the outside and without an axial force.
///
/// With a total strain ε_z along and ε_r across the glass, and α its own expansion, light of a fibre of refractive index n gains
/// `∂n/∂T + n ε_z − n³/2 [(p11 + p12) (ε_r − α) + p12 (ε_z − α)]` of optical path per length and K.
///
/// ```
/// use fem_core::material::Isotropic;
/// use homogenization::{Constituent, Ring, Role, free_fibre};
///
/// let solid = |youngs_modulus, poisson_ratio, thermal_expansion| {
///     Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, 1.0)
/// };
/// let glass = Ring { outer_radius: 62.5e-6, constituent: solid(72e9, 0.17, 0.55e-6), role: Role::Glass };
/// let coating = Ring { outer_radius: 125e-6, constituent: solid(1.2e9, 0.40, 80e-6), role: Role::Coating };
/// let fibre = free_fibre(&[glass, coating])?;
/// // the coating pulls the glass along
/// assert_eq!(format!("{:.2}e-6 1/K", fibre.expansion * 1e6), "4.74e-6 1/K");
/// # Ok::<(), homogenization::Error>(())
/// ```
///
/// # Errors
/// [`Error`] names the constituent or the radius out of range, or says that no ring is glass.
pub fn free_fibre(rings: &[Ring]) -> Result<FreeFibre, Error> {
    check(rings)?;
    // rows 2σ_rr outside and mean σ_zz, columns the outermost u/r, the axial strain and the temperature
    let (stress, glass) = axisymmetric(&phases_of_fibre(rings)?);
    let held = stress.fixed_columns::<2>(0).into_owned();
    let free = |load: Vector2<f64>| Some(Matrix2::try_inverse(held)? * load);
    let pulled = free(Vector2::new(0.0, 1.0)).ok_or_else(Error::singular)?;
    let warmed = free(-stress.column(2)).ok_or_else(Error::singular)?;
    Ok(FreeFibre {
        youngs_modulus: 1.0 / pulled[1],
        expansion: warmed[1],
        expansion_across: warmed[0],
        glass_radial_strain: glass[0] * warmed[0] + glass[1] * warmed[1] + glass[2],
        glass_radial_strain_per_axial: glass[0] * pulled[0] / pulled[1] + glass[1],
    })
}

/// Radii are lengths that increase from ring to ring.
fn check(rings: &[Ring]) -> Result<(), Error> {
    if rings.is_empty() {
        return Err(rve_mesh::Error::NoRing.into());
    }
    let mut inner = 0.0;
    for (ring, &Ring { outer_radius: radius, .. }) in rings.iter().enumerate() {
        if !(radius.is_finite() && radius > inner) {
            return Err(rve_mesh::Error::RingOrder { ring, radius, inner }.into());
        }
        inner = radius;
    }
    Ok(())
}
