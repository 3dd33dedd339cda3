//! `cargo xtask cells`: cells of many kinds to 1e-6, each held against a much finer solution and against finite elements; writes
//! docs/cells.md.

mod ngsolve;

use crate::{Failure, files};
use fem_core::material::Isotropic;
use homogenization::irregular::{Arrangement, Cell, Directional};
use homogenization::{
    Constants, Constituent, Discretization, Extent, FibreCell, HIGHEST_ORDER, Packing, Resolution, Ring, Role, TOLERANCE,
    effective, homogenize, multipoles,
};
use std::fmt::Write as _;
use std::path::Path;

const PAGE: &str = "docs/cells.md";
/// Order and mesh of the finite elements that the multipoles are compared with.
const ORDER: usize = 12;
const SECTORS: usize = 4;
const GRADING: f64 = 1.6;

/// Largest distance of those finite elements; the thinnest films and layers take most of it.
const ELEMENTS: f64 = 1e-7;

const INTRODUCTION: &str = "\
# Cells of many kinds

Written by `cargo xtask cells`. Each cell is homogenised as a user would, to a relative error of 1e-6 in every constant, and held against

- *much finer*: the same method with multipoles up to order 401;
- *finite elements*: order 12, four sectors graded towards the narrow part of the film, quarter cell. They share no line with the
  multipoles but the constituents' laws. Where the film is thinnest it is they that are not converged;
- *general route*: the cell as one of no symmetry, on an unstructured periodic mesh, as any irregular cell is solved, to the same 1e-6.

Every number is the largest over all sixteen constants; of constants that nearly vanish, relative to 1e-6 of their natural scale.

| cell | own estimate | error by much finer | distance to finite elements | unknowns | general route: own estimate | error by much finer | unknowns |
|---|---|---|---|---|---|---|---|
";

fn solid(youngs_modulus: f64, poisson_ratio: f64, thermal_expansion: f64, conductivity: f64) -> Constituent {
    Constituent::new(Isotropic { youngs_modulus, poisson_ratio, thermal_expansion }, conductivity)
}

fn glass() -> Constituent {
    solid(70.2e9, 0.17, 0.55e-6, 1.38)
}

/// A cell of glass and coatings by outer diameters \[µm\].
fn cell(pitch: f64, glass: &[(f64, Constituent)], coatings: &[(f64, Constituent)], adhesive: Constituent) -> FibreCell {
    let ring = |role: Role| {
        move |&(diameter, constituent): &(f64, Constituent)| Ring { outer_radius: diameter * 0.5e-6, constituent, role }
    };
    let rings = glass.iter().map(ring(Role::Glass)).chain(coatings.iter().map(ring(Role::Coating))).collect();
    FibreCell::hexagonal(pitch * 1e-6, rings, adhesive)
}

fn cells() -> Result<Vec<(&'static str, FibreCell)>, Failure> {
    let reference = fogcoil::input::read_cell("fixtures/cell-reference.ron".as_ref())?.cell;
    let (primary, secondary) = (solid(2e6, 0.4998, 250e-6, 0.15), solid(870e6, 0.4118, 102.75e-6, 0.30));
    let (epoxy, rubber) = (solid(3e9, 0.38, 60e-6, 0.2), solid(5.593e6, 0.49999, 250e-6, 0.45));
    let soft = solid(2e6, 0.49999, 250e-6, 0.15);
    let metal = solid(117e9, 0.35, 16.6e-6, 390.0);
    let core = solid(67e9, 0.18, 1.0e-6, 1.3);
    let film = |pitch: f64| FibreCell { pitch, ..reference.clone() };
    let square = |cell: FibreCell| FibreCell { packing: Packing::Square, ..cell };
    let coated = [(80.0, glass())];
    Ok(vec![
        ("reference", reference.clone()),
        ("two phases, glass in epoxy", cell(140.0, &[(125.0, glass())], &[], epoxy)),
        ("two phases, soft in stiff", cell(140.0, &[(125.0, primary)], &[], metal)),
        ("125/245 µm fibre, two coatings", cell(255.0, &[(125.0, glass())], &[(190.0, primary), (245.0, secondary)], rubber)),
        ("film of 1 µm", film(166e-6)),
        ("film of 0.2 µm", film(165.2e-6)),
        ("four nines: ν 0.49999 in primary and adhesive", cell(170.0, &coated, &[(112.0, soft), (165.0, secondary)], rubber)),
        ("the same, film of 1 µm", cell(166.0, &coated, &[(112.0, soft), (165.0, secondary)], rubber)),
        (
            "core not of the cladding's glass",
            cell(170.0, &[(8.0, core), (80.0, glass())], &[(112.0, primary), (165.0, secondary)], reference.adhesive),
        ),
        (
            "hermetic layer of 0.05 µm",
            cell(170.0, &[(80.0, glass())], &[(80.1, solid(300e9, 0.2, 3e-6, 10.0)), (165.0, secondary)], reference.adhesive),
        ),
        ("copper-coated, in rubber", cell(170.0, &[(125.0, glass())], &[(165.0, metal)], rubber)),
        ("square packing, reference rings", square(reference.clone())),
        ("square packing, glass in epoxy", square(cell(140.0, &[(125.0, glass())], &[], epoxy))),
        ("square packing, film of 1 µm", square(film(166e-6))),
    ])
}

/// Largest relative distance of a constant.
fn distance(a: &Constants, b: &Constants) -> f64 {
    let relative = a.combine(b, |a, b| (a - b).abs()).combine(&b.size(), |difference, size| difference / size);
    relative.named().into_iter().fold(0.0, |most, (_, one)| most.max(one))
}

/// Largest relative distance of the general route's constants along x (and z) from `exact`, which are read along the same axes.
fn along_axes(found: &Directional, exact: &Constants) -> f64 {
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

/// Columns of the general route; `false` if its error is above its own estimate or what was asked for.
fn general(cell: &FibreCell, exact: &Constants) -> Result<(String, bool), Failure> {
    let arrangement = match cell.packing {
        Packing::Hexagonal => Arrangement::hexagonal(cell.pitch, 1, 1),
        Packing::Square => Arrangement::square(cell.pitch, 1, 1),
    };
    let general = Cell::of_fibres(cell, &arrangement.map_err(homogenization::Error::from)?)?;
    let found = match general.homogenize_to(TOLERANCE) {
        Err(homogenization::Error::Accuracy { reached, .. }) => return Ok((format!("{reached:.1e}, refused | - | -"), true)),
        found => found?,
    };
    let estimate = found.relative_error.iter().fold(0.0_f64, |m, (_, e)| m.max(*e));
    let error = along_axes(&found.constants, exact);
    let columns = format!("{estimate:.1e} | {error:.1e} | {}", found.response.unknowns);
    Ok((columns, error <= estimate.max(TOLERANCE)))
}

/// Prints a row for each cell and writes the page; `false` if an error is above the tolerance or its own estimate, or NGSolve, run anew if
/// its Python is given, does not agree. [`Failure`] if a cell cannot be solved, or NGSolve cannot be run.
pub fn run(python: Option<&Path>) -> Result<bool, Failure> {
    let singular = || Failure("the effective stiffness is singular".into());
    let mut page = String::from(INTRODUCTION);
    let mut good = true;
    let mut solved = Vec::new();
    for (name, cell) in cells()? {
        let result = homogenize(&cell)?;
        let finer = multipoles(&cell, HIGHEST_ORDER)?.constants().ok_or_else(singular)?;
        let resolution = Resolution { sectors: SECTORS, grading: GRADING, across: vec![1; cell.rings.len() + 1] };
        let elements = effective(&cell, &Discretization { order: ORDER, resolution, extent: Extent::Quarter })?;
        let elements = elements.constants().ok_or_else(singular)?;
        let estimate = result.relative_error.named().into_iter().fold(0.0_f64, |m, (_, e)| m.max(e));
        let error = distance(&result.constants, &finer);
        good &= error <= estimate && estimate <= TOLERANCE;
        let (general, agrees) = general(&cell, &finer)?;
        good &= agrees;
        let apart = distance(&finer, &elements);
        good &= apart <= ELEMENTS;
        let row = format!("| {name} | {estimate:.1e} | {error:.1e} | {apart:.1e} | {} | {general} |", result.unknowns);
        println!("{row}");
        let _ = writeln!(page, "{row}");
        solved.push(ngsolve::Solved { name, cell, constants: result.constants });
    }
    let (section, agrees) = ngsolve::section(&solved, python)?;
    page += &section;
    good &= agrees;
    files::write(PAGE.as_ref(), &page)?;
    Ok(good)
}
