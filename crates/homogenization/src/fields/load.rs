//! What acts on the cell.

use crate::irregular::{LOADS, TEMPERATURE};
use nalgebra::{SMatrix, Vector6};

/// A macroscopic total strain and a temperature change.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Load {
    /// Strain xx, yy, zz, yz, xz, xy with engineering shear; z = fibre.
    pub strain: Vector6<f64>,
    /// Temperature change \[K\].
    pub temperature: f64,
}

impl Load {
    /// The strains, then the temperature change.
    pub(super) fn column(&self) -> SMatrix<f64, LOADS, 1> {
        let mut column = SMatrix::<f64, LOADS, 1>::zeros();
        column.fixed_view_mut::<6, 1>(0, 0).copy_from(&self.strain);
        column[TEMPERATURE] = self.temperature;
        column
    }
}
