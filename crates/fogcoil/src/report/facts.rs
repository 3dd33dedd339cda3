//! What was simulated and how: the coil, the inputs, the options, the mesh.

use std::fmt::Write;

use coil::{CHECKS, Drive, STEADY, Side};

use crate::picture::escape;
use crate::sensitivity::origin;
use crate::simulate::Simulation;
use crate::units::{to_mm, to_ppm};

/// Names and values.
pub(crate) fn table(out: &mut String, rows: &[(String, String)]) {
    out.push_str("<table class=\"facts\">\n<tbody>\n");
    for (name, value) in rows {
        let _ = writeln!(out, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escape(name), escape(value));
    }
    out.push_str("</tbody>\n</table>\n");
}

/// A row of [`table`].
pub(crate) fn row(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

/// The coil in short.
pub(super) fn coil(out: &mut String, simulation: &Simulation) {
    let (case, design) = (simulation.case, &simulation.case.design);
    let (spec, sensor) = (case.winding.spec(), design.sensor);
    let mut rows = vec![
        row("winding", format!("{:?}, {} layers, {} turns", spec.pattern, spec.layers, case.winding.turns().len())),
        row(
            "fibre",
            format!("{:.2} m, tails of {} m (CW) and {} m (CCW) included", case.winding.length(), spec.tails.cw, spec.tails.ccw),
        ),
        row(
            "coil",
            format!(
                "radius {:.3} to {:.3} mm, height {:.3} mm",
                to_mm(spec.inner_radius),
                to_mm(design.body.outer_radius),
                to_mm(design.body.height)
            ),
        ),
        row("spool", spool(simulation)),
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
        rows.push(row(&format!("mount, {} flange", side(mount.side)), format!("{} W/(m² K)", mount.conductance)));
    }
    for heater in &heat.heaters {
        rows.push(row(&format!("heater, {} flange", side(heater.side)), format!("{} W, on from the first row", heater.power)));
    }
    if let Some(film) = heat.film {
        rows.push(row("film in place of the medium", format!("{film} W/(m² K)")));
    }
    out.push_str("<h2>Coil</h2>\n");
    table(out, &rows);
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

/// Program, inputs, options, mesh.
pub(super) fn computation(out: &mut String, simulation: &Simulation) {
    let mesh = |r: coil::Resolution| format!("elements of order {}, {} layers towards each edge of the coil", r.order, r.layers);
    let mut rows = vec![row("program", format!("fogcoil {}", env!("CARGO_PKG_VERSION")))];
    for file in simulation.case.fingerprints.iter().chain([&simulation.profile.fingerprint]) {
        rows.push(row("input", format!("{}, {} bytes, FNV-1a {file}", file.file.display(), file.bytes)));
    }
    rows.extend([
        row("driven by", simulation.profile.drives.iter().map(|drive| name(*drive)).collect::<Vec<_>>().join(", ")),
        row("start", "uniform at the first chamber temperature and free of stress; heaters off before the first row"),
        row("mesh", mesh(coil::STANDARD.resolution)),
        row("modes", format!("{} in all; the drives are linear between rows, the modes exact", simulation.modes)),
        row(
            "left out by the modes",
            format!(
                "less than {:.1e} of the largest bias, less than {:.1e} s of the thermometer's lag",
                simulation.reduction.bias, simulation.reduction.sensor
            ),
        ),
        row(
            "steady-ramp sensitivity",
            format!("mesh: {}; its error from orders {} and {} on it", mesh(STEADY), CHECKS[0].order, CHECKS[1].order),
        ),
    ]);
    if let Some(inference) = simulation.profile.inferred {
        let [median, largest] = inference.chamber_sd;
        let course = format!(
            "inferred from the spool's thermometer (spool_c), whose noise is taken as {} K: standard deviation {median:.3} K (median), \
             {largest:.3} K (largest), if the model is exact; the thermometer is reproduced to {:.4} K rms",
            inference.noise, inference.sensor_residual_rms
        );
        rows.push(row("chamber", course));
    }
    rows.extend(simulation.profile.notes.iter().map(|note| row("note", note.as_str())));
    out.push_str("<h2>Computation</h2>\n");
    table(out, &rows);
    out.push_str(
        "<p>FNV-1a (64 bits) tells contents apart that differ by accident; it is no protection against intent. The numbers follow from \
         the file's spool, bonding and materials; where one of them was chosen to match a measurement, so were these.</p>\n",
    );
}

fn name(drive: Drive) -> &'static str {
    match drive {
        Drive::Chamber => "chamber wall (chamber_c)",
        Drive::EndWall(Side::Left) => "left end wall (left_c)",
        Drive::EndWall(Side::Right) => "right end wall (right_c)",
        Drive::Mount(Side::Left) => "mount of the left flange (mount_left_c)",
        Drive::Mount(Side::Right) => "mount of the right flange (mount_right_c)",
        Drive::Heaters => "heaters",
    }
}
