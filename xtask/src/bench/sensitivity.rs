//! `cargo xtask bench sensitivity`: from design to steady sensitivity, beside NGSolve.

use super::publish::{Progress, publish, reference_coil};
use ::coil::{COARSE, Design, Layout, MeshFineness, Model, Region, steady_sensitivity};
use bias::units::DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K;
use fem_core::material::ThermoElastic;
use proof::peers::Stopwatch;
use proof::statistics::middle as median;
use proof::{Failure, peers};
use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::Path;

const CONVERGED: MeshFineness = MeshFineness { order: 11, layers: 6, ratio: 0.2 };
/// Orders and sizes that the peer is run with: order, element at the coil's corners, largest element \[mm\], grading.
const PEER: [[&str; 4]; 3] = [["4", "0.05", "4", "0.4"], ["4", "0.01", "6", "0.7"], ["4", "0.003", "6", "0.3"]];

/// The problem as numbers: solids, turns with the factors of their strains in (deg/h)/(degC/min), dehomogenisation, direct part.
fn problem(design: &Design, model: &Model) -> Result<serde_json::Value, Failure> {
    let layout = Layout::new(design)?;
    let spool = design.spool.as_ref().map(|s| s.material.elastic.law()).transpose()?;
    let coil = design.body.elastic.law()?;
    let solid = |s: &::coil::Rectangle| {
        let law: &ThermoElastic = if s.region == Region::Coil { &coil } else { spool.as_ref().unwrap_or(&coil) };
        let voigt = [0, 1, 2, 5];
        let stiffness = voigt.map(|i| voigt.map(|j| law.stiffness[(i, j)]));
        serde_json::json!({ "r": s.r, "y": s.y, "stiffness": stiffness, "thermal_stress": voigt.map(|i| law.thermal_stress[i]) })
    };
    let (winding, m) = (model.winding(), design.dehomogenization);
    let c = design.optics.coefficients(winding.length())?;
    let unit = DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K;
    let weights = winding.weights();
    let turn = |(t, w): (&winding::Turn, &f64)| [t.r, t.y, w * c.axial * unit, w * c.radial * unit];
    let direct: f64 = weights.iter().map(|w| w * (c.shupe + c.axial_per_temperature_rate + c.radial_per_temperature_rate)).sum();
    Ok(serde_json::json!({
        "solids": layout.solids.iter().map(solid).collect::<Vec<_>>(),
        "turns": winding.turns().iter().zip(&weights).map(turn).collect::<Vec<_>>(),
        "row": [m.m_rx, m.m_ry, m.m_rz, m.m_rt],
        "direct": direct * unit,
    }))
}

pub(crate) fn run(python: Option<&Path>, repetitions: u64) -> Result<(), Failure> {
    let progress = Progress::new();
    let design = reference_coil()?;
    progress.say("converged value");
    let model = Model::new(&design, &CONVERGED)?;
    let converged = model.sensitivity()?.total();
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("problem.json");
    std::fs::write(&file, problem(&design, &model)?.to_string())?;
    let python = python.filter(|python| {
        let found = peers::has(python, "ngsolve, numpy");
        if !found {
            progress.say("NGSolve skipped: this Python lacks ngsolve or numpy (benches/peers/README.md)");
        }
        found
    });
    if python.is_none() {
        progress.say("NGSolve skipped: give --peers-python PATH or set FOGCOIL_PEERS_PYTHON");
    }
    let (mut whole, mut coarse, mut last) = (Vec::new(), Vec::new(), None);
    let mut peer_runs = PEER.map(|_| Vec::new());
    for repetition in 0..repetitions {
        progress.say(&format!("run {} of {}", repetition + 1, repetitions));
        let mut watch = Stopwatch::start();
        let model = Model::new(&design, &COARSE)?;
        let alone = (model.sensitivity()?.total(), model.unknowns());
        coarse.push(watch.lap());
        let steady = steady_sensitivity(&design)?;
        whole.push(watch.lap());
        last = Some((alone, steady));
        for (setting, runs) in PEER.iter().zip(&mut peer_runs).filter(|_| python.is_some()) {
            let words = ["sensitivity_ngsolve.py".into(), file.clone().into_os_string()];
            let arguments: Vec<OsString> = words.into_iter().chain(setting.iter().map(OsString::from)).collect();
            runs.extend(python.map(|python| peers::run(python, &arguments)).transpose()?);
        }
    }
    let (alone, steady) = last.ok_or_else(|| Failure("no repetition was run".into()))?;
    let (coarse, whole) = (median(coarse), median(whole));
    let mut out = String::from(
        "| program | unknowns | compute, CPU s | S, (deg/h)/(degC/min) | error | compute ÷ the first |\n|---|---|---|---|---|---|\n",
    );
    let mut row = |name: &str, unknowns: String, seconds: f64, s: f64, note: &str| {
        let error = (s - converged).abs();
        let _ = writeln!(out, "| {name} | {unknowns} | {seconds:.3} | {s:.5} | {error:.1e}{note} | {:.1} |", seconds / coarse);
    };
    row("fogcoil, mesh of fields and profiles", alone.1.to_string(), coarse, alone.0, "");
    let both = format!("{} and {}", steady.unknowns, steady.unknowns_of_estimate);
    let estimate = format!(" (estimated {:.1e})", steady.error_estimate);
    row("fogcoil, with its error estimate", both, whole, steady.sensitivity.total(), &estimate);
    for ([order, corner, largest, _], runs) in PEER.iter().zip(&peer_runs).filter(|(_, runs)| !runs.is_empty()) {
        let name = format!("NGSolve, order {order}, free mesh, {corner} mm at the coil's corners, at most {largest} mm");
        let seconds = median(runs.iter().map(|r| r.printed.compute()).collect());
        let s = runs[0].printed.out.get("total").copied().unwrap_or(f64::NAN);
        row(&name, runs[0].printed.dof.to_string(), seconds, s, "");
    }
    let _ = writeln!(
        out,
        "\nFrom the design to the number, mesh included (imports and start of an interpreter are not): medians of {} interleaved runs. \
         Converged value, order {} and {} layers: {converged:.6}.",
        repetitions, CONVERGED.order, CONVERGED.layers
    );
    publish("sensitivity", &out)
}
