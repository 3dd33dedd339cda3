//! Random coils in a steady ramp.

use bias::Sensitivity;
use coil::{Design, Error, MeshFineness, STEADY, sensitivity_on, steady_sensitivity};

use super::draw;
use super::tally::{Compared, Drawn};
use crate::Failure;
use crate::generator::Random;

/// The mesh behind the true error: three orders and two layers finer, or the finest that rounding lets through.
const TRUE: [MeshFineness; 3] = [finer(3, 2), finer(2, 1), finer(1, 1)];

const fn finer(orders: usize, layers: usize) -> MeshFineness {
    MeshFineness { order: STEADY.order + orders, layers: STEADY.layers + layers, ..STEADY }
}

pub(super) fn reference() -> Result<Design, Failure> {
    Ok(fogcoil::input::read_coil(&crate::files::root().join("fixtures/coil-reference.ron"))?.design)
}

/// A design that the program would refuse, or its error.
pub(super) fn refused(error: &Error) -> bool {
    matches!(error, Error::Design { .. } | Error::Solve { .. })
}

pub(super) fn compare(random: &mut Random) -> Result<Drawn, Failure> {
    let design = draw::coil(random, &reference()?);
    let found = match steady_sensitivity(&design) {
        Err(error) if refused(&error) => return Ok(Drawn::Refused),
        found => found?,
    };
    let Sensitivity { eo_axial, eo_radial, .. } = found.sensitivity;
    let finest = TRUE.iter().find_map(|mesh| sensitivity_on(&design, mesh).ok());
    let truth = finest.ok_or_else(|| Failure("no mesh finer than the program's can be solved".into()))?;
    let row = |quantity, stated, ours: f64, other: f64| Compared { quantity, stated, error: (ours - other).abs() };
    let rows = vec![
        row("sensitivity", found.error_estimate, found.sensitivity.total(), truth.total()),
        row("axial part", found.part_errors.eo_axial, eo_axial, truth.eo_axial),
        row("radial part", found.part_errors.eo_radial, eo_radial, truth.eo_radial),
    ];
    Ok(Drawn::Compared { what: format!("{design:?}"), rows })
}
