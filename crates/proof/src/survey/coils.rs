//! Random coils in a steady ramp.

use bias::Sensitivity;
use coil::{Design, Error, MeshFineness, STEADY, sensitivity_on, steady_sensitivity};

use super::draw;
use super::tally::{Compared, Drawn};
use crate::Failure;
use crate::generator::Random;
use crate::statistics::middle;

/// The meshes behind the true error: up to three orders and two layers finer. Their middle value is taken as true, since rounding may spoil one in coils of a
/// layer.
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
    let finer: Vec<Sensitivity> = TRUE.iter().filter_map(|mesh| sensitivity_on(&design, mesh).ok()).collect();
    let totals = || finer.iter().map(Sensitivity::total);
    let scatter = totals().fold(f64::NEG_INFINITY, f64::max) - totals().fold(f64::INFINITY, f64::min);
    if finer.len() < 2 || scatter > found.error_estimate {
        return Ok(Drawn::Undecided);
    }
    let row = |quantity, stated, of: &dyn Fn(&Sensitivity) -> f64| Compared {
        quantity,
        stated,
        error: (of(&found.sensitivity) - middle(finer.iter().map(of).collect())).abs(),
    };
    let rows = vec![
        row("sensitivity", found.error_estimate, &Sensitivity::total),
        row("axial part", found.part_errors.eo_axial, &|s| s.eo_axial),
        row("radial part", found.part_errors.eo_radial, &|s| s.eo_radial),
    ];
    Ok(Drawn::Compared { what: format!("{design:?}"), rows })
}
