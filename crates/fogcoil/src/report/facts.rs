//! Provenance of a simulation: the coil, the inputs, the options, the mesh.

use charts::{facts, nice, row};
use coil::{CHECKS, Drive, ReductionError, STEADY, Side};
use maud::Markup;

use super::provenance::provenance;
use crate::input::Between;
use crate::sensitivity::origin;
use crate::simulate::Simulation;
use crate::units::{to_mm, to_ppm};

pub(super) fn coil(simulation: &Simulation) -> Markup {
    let (case, design) = (simulation.case, &simulation.case.design);
    let (spec, sensor) = (case.winding.spec(), design.sensor);
    let winding::Tails { cw, ccw } = spec.tails;
    let [inner, outer, height] = [spec.inner_radius, design.body.outer_radius, design.body.height].map(to_mm);
    let mut rows = vec![
        row("winding", format!("{:?}, {} layers, {} turns", spec.pattern, spec.layers, case.winding.turns().len())),
        row("fibre", format!("{:.2} m, tails of {cw} m (CW) and {ccw} m (CCW) included", case.winding.length())),
        row("coil", format!("radius {inner:.3} to {outer:.3} mm, height {height:.3} mm")),
        row("spool", nice(&spool(simulation))),
        row("thermometer", format!("radius {:.3} mm, y = {:.3} mm, lag {} s", to_mm(sensor.radius), to_mm(sensor.y), sensor.lag)),
        row("constants of the coil", origin(&case.provenance.material)),
        row("dehomogenisation row", origin(&case.provenance.dehomogenization)),
        row("strain in eq. (2)", format!("{:?}", design.optics.strain)),
    ];
    let heat = &design.heat;
    if heat.hub_resistance > 0.0 {
        rows.push(row("contact resistance at the hub", format!("{} m² K/W", heat.hub_resistance)));
    }
    for mount in &heat.mounts {
        rows.push(row(&format!("mount, {} end of the spool", side(mount.side)), format!("{} W/(m² K)", mount.conductance)));
    }
    for heater in &heat.heaters {
        rows.push(row(
            &format!("heater, {} end of the spool", side(heater.side)),
            format!("{} W, on from the first row", heater.power),
        ));
    }
    if let Some(film) = heat.film {
        rows.push(row("film in place of the medium", format!("{film} W/(m² K)")));
    }
    facts("The coil", &rows)
}

fn spool(simulation: &Simulation) -> String {
    let Some(spool) = &simulation.case.design.spool else { return "none".into() };
    let elastic = spool.material.elastic;
    let flanges: Vec<&str> = spool.flanges.iter().map(|flange| side(flange.side)).collect();
    format!(
        "hub {:.2} mm thick, flanges: {}; E = {:.1} GPa, α = {:.2} × 10⁻⁶/K",
        to_mm(spool.hub_thickness),
        if flanges.is_empty() { "none".to_owned() } else { flanges.join(", ") },
        crate::units::to_gpa(elastic.youngs_modulus),
        to_ppm(elastic.thermal_expansion)
    )
}

fn side(side: Side) -> &'static str {
    match side {
        Side::Left => "left",
        Side::Right => "right",
    }
}

/// Drives, mesh, modes, and the error of their reduction.
pub(super) fn computation(simulation: &Simulation) -> Markup {
    let mesh =
        |r: coil::MeshFineness| format!("elements of order {}, {} layers towards each edge of the coil", r.order, r.layers);
    let (coarser, ReductionError { bias, sensor }) = (mesh(coil::COARSER.resolution), simulation.reduction);
    let mut rows = vec![
        row("driven by", simulation.profile.drives.iter().map(|drive| name(*drive)).collect::<Vec<_>>().join(", ")),
        row("start", "uniform at the first chamber temperature and free of stress; heaters off before the first row"),
        row("mesh", mesh(coil::STANDARD.resolution)),
        row(
            "numerical errors (±)",
            format!("twice the largest difference in any row to {coarser}, and what the modes leave out"),
        ),
        row("modes", format!("{} in all; the drives are linear between rows, the modes exact", simulation.modes)),
        row(
            "left out by the modes",
            format!("less than {bias:.1e} of the largest bias, less than {sensor:.1e} s of the thermometer's lag"),
        ),
        row(
            "steady-ramp sensitivity",
            format!("mesh: {}; its error from {} meshes of lower orders and other gradings", mesh(STEADY), CHECKS.len()),
        ),
    ];
    if let Some(inference) = simulation.profile.inferred {
        let [median, largest] = inference.chamber_sd;
        let course = format!(
            "inferred from the spool's thermometer (spool_c), whose noise is taken as {} K: standard deviation {median:.3} K (median), \
             {largest:.3} K (largest), if the model is exact; the thermometer is reproduced to {:.4} K rms",
            inference.noise, inference.sensor_residual_rms
        );
        rows.push(row("chamber", course));
    }
    rows.extend(simulation.profile.notes.iter().map(|note| row("note", note.message())));
    facts("The computation", &rows)
}

pub(super) fn sources(simulation: &Simulation) -> (&'static str, Markup) {
    let coils = simulation.case.fingerprints.iter().enumerate().map(|(n, file)| (if n == 0 { "coil" } else { "cell" }, file));
    let inferred = simulation.profile.inferred;
    let driven = if inferred.is_some() { "thermometer's record" } else { "profile" };
    let files: Vec<_> = coils.chain([(driven, &simulation.profile.fingerprint)]).collect();
    let between = match simulation.profile.between {
        Between::Linear => "linear",
        Between::Cubic => "cubic",
    };
    let mut options = vec![row("between rows", between)];
    options.extend(simulation.profile.step.map(|step| row("rows added", format!("every {step} s from the first row"))));
    options.extend(inferred.map(|found| row("noise of the thermometer", format!("{} K", found.noise))));
    provenance("simulate", &files, &options)
}

fn name(drive: Drive) -> &'static str {
    match drive {
        Drive::Chamber => "chamber wall (chamber_c)",
        Drive::EndWall(Side::Left) => "left end wall (left_c)",
        Drive::EndWall(Side::Right) => "right end wall (right_c)",
        Drive::Mount(Side::Left) => "mount at the left (mount_left_c)",
        Drive::Mount(Side::Right) => "mount at the right (mount_right_c)",
        Drive::Heaters => "heaters",
    }
}
