//! Response of a cell: nine independent numbers, from which the constants follow.

use crate::bounds::cylinders;
use crate::{Constants, FibreCell, homogenize};
use std::thread;

/// Independent responses: ln k, ln g_r, ln g_zr, ln e_z, nu_zr, alpha_z and alpha_r in 1e-4/K, ln k_z, ln k_r.
pub(crate) const RESPONSES: usize = 9;
pub(crate) type Response = [f64; RESPONSES];
/// The constants that the responses determine, in the order of [`Constants::named`].
pub(crate) const KNOWN: [&str; 12] =
    ["e_z", "e_r", "g_zr", "g_r", "k_plane_strain", "nu_zr", "nu_r", "nu_rz", "alpha_z", "alpha_r", "k_z", "k_r"];
/// Their values, SI.
pub type Known = [f64; KNOWN.len()];
/// Unit of the expansions among the responses \[1/K\].
const EXPANSION: f64 = 1e-4;

pub(crate) fn response(c: &Constants) -> Option<Response> {
    let all = [
        c.k_plane_strain.ln(),
        c.g_r.ln(),
        c.g_zr.ln(),
        c.e_z.ln(),
        c.nu_zr,
        c.alpha_z / EXPANSION,
        c.alpha_r / EXPANSION,
        c.k_z.ln(),
        c.k_r.ln(),
    ];
    all.iter().all(|x| x.is_finite()).then_some(all)
}

pub(crate) fn known(y: &Response) -> Known {
    let [k, g_r, g_zr, e_z, nu_zr, alpha_z, alpha_r, k_z, k_r] = *y;
    let [k, g_r, g_zr, e_z, k_z, k_r] = [k, g_r, g_zr, e_z, k_z, k_r].map(f64::exp);
    let e_r = 4.0 / (1.0 / g_r + 1.0 / k + 4.0 * nu_zr * nu_zr / e_z);
    let nu_r = e_r / (2.0 * g_r) - 1.0;
    [e_z, e_r, g_zr, g_r, k, nu_zr, nu_r, nu_zr * e_r / e_z, alpha_z * EXPANSION, alpha_r * EXPANSION, k_z, k_r]
}

/// Response by composite cylinders, in microseconds.
pub(crate) fn estimated(cell: &FibreCell) -> Option<Response> {
    response(&cylinders(cell).ok()?.constants()?)
}

/// Response by multipoles, to 1e-6; `None` where they do not reach it.
pub(crate) fn solved(cell: &FibreCell) -> Option<Response> {
    response(&homogenize(cell).ok()?.constants)
}

/// [`solved`] for many cells, on every core; the order does not depend on their number.
pub(crate) fn solved_all(cells: &[Option<FibreCell>]) -> Vec<Option<Response>> {
    let workers = thread::available_parallelism().map_or(1, |n| n.get());
    let chunk = cells.len().div_ceil(workers).max(1);
    thread::scope(|scope| {
        let run = |part: &[Option<FibreCell>]| part.iter().map(|cell| cell.as_ref().and_then(solved)).collect::<Vec<_>>();
        let handles: Vec<_> = cells.chunks(chunk).map(|part| scope.spawn(move || run(part))).collect();
        // a worker that panicked has nothing to give; its cells count as failed
        let parts = handles.into_iter().zip(cells.chunks(chunk));
        parts.flat_map(|(handle, part)| handle.join().unwrap_or_else(|_| vec![None; part.len()])).collect()
    })
}
