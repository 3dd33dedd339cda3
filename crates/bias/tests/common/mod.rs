//! Fibres that the tests share.

use bias::{Optics, Slice, StrainConvention};
use proptest::prelude::*;

pub(crate) const SILICA: Optics = Optics {
    refractive_index: 1.45,
    thermo_optic: 1.0e-5,
    thermal_expansion: 0.55e-6,
    p11: 0.121,
    p12: 0.270,
    sagnac_diameter: 92.325e-3,
    strain: StrainConvention::Total,
};

/// A slice in which nothing changes.
pub(crate) fn still(z_start: f64, z_end: f64) -> Slice {
    Slice { z_start, z_end, temperature_rate: 0.0, axial_strain_rate: 0.0, radial_strain_rate: 0.0 }
}

/// Positions that cut [0, length] into 1 to 4000 slices, ends included.
pub(crate) fn any_partition(length: f64) -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(0.0..length, 0..4000).prop_map(move |mut cuts| {
        cuts.extend([0.0, length]);
        cuts.sort_by(f64::total_cmp);
        cuts
    })
}
