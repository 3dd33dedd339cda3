//! How far two sets of constants are apart.

use homogenization::irregular::Directional;
use homogenization::{Constants, NEGLIGIBLE};

/// What differences from each constant are relative to.
pub(super) fn scales(constants: &Constants) -> [f64; 16] {
    let expansion = NEGLIGIBLE * constants.alpha_r.abs().max(constants.alpha_z.abs());
    let least = |name: &str| match name {
        "alpha_z" | "alpha_r" | "m_rt" => expansion,
        _ => NEGLIGIBLE,
    };
    constants.named().map(|(name, value)| value.abs().max(least(name)))
}

/// Largest relative distance of a constant.
pub(super) fn distance(a: &Constants, b: &Constants) -> f64 {
    let pairs = a.named().into_iter().zip(b.named()).zip(scales(b));
    pairs.map(|(((_, a), (_, b)), scale)| (a - b).abs() / scale).fold(0.0, f64::max)
}

/// Largest relative distance of the general route's constants along x (and z) from `exact`, which are read along the same axes.
pub(super) fn along_axes(found: &Directional, exact: &Constants) -> f64 {
    let Directional { e, g, nu, alpha, k, k_plane_strain, m } = *found;
    let along_x = Constants {
        e_z: e[2],
        e_r: e[0],
        g_zr: g[1],
        g_r: g[2],
        k_plane_strain,
        nu_zr: nu[0],
        nu_r: nu[2],
        nu_rz: nu[0] * e[0] / e[2],
        alpha_z: alpha[2],
        alpha_r: alpha[0],
        k_z: k[2],
        k_r: k[0],
        m_rx: m[0],
        m_ry: m[1],
        m_rz: m[2],
        m_rt: m[4],
    };
    let along_y =
        Constants { e_r: e[1], g_zr: g[0], nu_zr: nu[1], nu_rz: nu[1] * e[1] / e[2], alpha_r: alpha[1], k_r: k[1], ..along_x };
    distance(&along_x, exact).max(distance(&along_y, exact))
}
