//! A design as the coil's case file, so that it reads back as it was.

use std::fmt::Write;

use bias::StrainConvention;
use bias::units::DEG_PER_H_PER_RAD_PER_S;
use coil::{Contact, Design, Drifts, HeatPaths, Mechanics, Side, Spool};
use winding::{ClimbSide, Spec, TurnLength};

use crate::units::{from_gpa, from_mm, from_mpa, to_gpa, to_mm, to_mpa};

/// The content of a coil file for `design`, with `comments` above it, a line each.
///
/// Every number reads back to the same double; one that no decimal in the file's unit gives, to a neighbour of it.
pub fn coil_file(name: &str, design: &Design, comments: &[String]) -> String {
    let mut out = String::new();
    comments.iter().flat_map(|comment| comment.lines()).for_each(|line| {
        let _ = writeln!(out, "// {line}");
    });
    let name = ron::to_string(name).unwrap_or_else(|_| "\"\"".into());
    let _ = writeln!(out, "(\n    name: {name},");
    out.push_str(&winding(&design.winding));
    out.push_str(&body(design));
    out.push_str(&spool(design.spool.as_ref()));
    let medium = &design.surroundings;
    let _ = writeln!(
        out,
        "    surroundings: (\n        medium: (conductivity_w_per_mk: {:?}, density_kg_per_m3: {:?}, specific_heat_j_per_kgk: {:?}),\n        \
         margin_mm: {},\n    ),",
        medium.conductivity,
        medium.density,
        medium.specific_heat,
        mm(medium.margin)
    );
    out.push_str(&mechanics(&design.mechanics));
    out.push_str(&heat(&design.heat));
    let sensor = &design.sensor;
    let lag = if sensor.lag == 0.0 { String::new() } else { format!(", lag_s: {:?}", sensor.lag) };
    let _ = writeln!(out, "    sensor: (radius_mm: {}, y_mm: {}{lag}),", mm(sensor.radius), mm(sensor.y));
    out.push_str(&optics(design));
    out
}

/// The shortest number in a file's unit that `from` turns into `value`; if there is none, the nearest.
fn number(value: f64, to: impl Fn(f64) -> f64, from: impl Fn(f64) -> f64) -> String {
    let near = to(value);
    let shorter = (0..17).map(|digits| format!("{near:.digits$e}")).filter_map(|text| text.parse::<f64>().ok());
    let found = shorter.chain([near.next_up(), near.next_down()]).find(|number| from(*number) == value);
    format!("{:?}", found.unwrap_or(near))
}

fn mm(metres: f64) -> String {
    number(metres, to_mm, from_mm)
}

fn mpa(pascals: f64) -> String {
    number(pascals, to_mpa, from_mpa)
}

fn gpa(pascals: f64) -> String {
    number(pascals, to_gpa, from_gpa)
}

fn side(side: Side) -> &'static str {
    match side {
        Side::Left => "Left",
        Side::Right => "Right",
    }
}

fn winding(spec: &Spec) -> String {
    let Spec { pattern, layers, turns_odd_layers, turns_even_layers, tails, .. } = spec;
    let climbs = if spec.cw_climbs == ClimbSide::Left { "Left" } else { "Right" };
    let length = if spec.turn_length == TurnLength::Equal { "Equal" } else { "True" };
    let defect =
        spec.defect.map_or(String::new(), |d| format!("        defect: Some((layer: {}, turns: {})),\n", d.layer, d.turns));
    format!(
        "    winding: (\n        pattern: {pattern:?},\n        layers: {layers},\n        turns_odd_layers: {turns_odd_layers},\n        \
         turns_even_layers: {turns_even_layers},\n        inner_radius_mm: {},\n        pitch_mm: {},\n        cw_climbs: {climbs},\n        \
         turn_length: {length},\n        tails_m: (cw: {:?}, ccw: {:?}),\n{defect}    ),\n",
        mm(spec.inner_radius),
        mm(spec.pitch),
        tails.cw,
        tails.ccw
    )
}

fn body(design: &Design) -> String {
    let (body, e) = (&design.body, &design.body.elastic);
    format!(
        "    coil: (\n        outer_radius_mm: {},\n        height_mm: {},\n        density_kg_per_m3: {:?},\n        \
         specific_heat_j_per_kgk: {:?},\n        material: Constants((\n            e_z_gpa: {}, e_r_mpa: {}, g_zr_mpa: {}, nu_zr: {:?}, \
         nu_r: {:?},\n            alpha_z_per_k: {:?}, alpha_r_per_k: {:?}, k_z_w_per_mk: {:?}, k_r_w_per_mk: {:?},\n        )),\n    ),\n",
        mm(body.outer_radius),
        mm(body.height),
        body.density,
        body.specific_heat,
        gpa(e.e_z),
        mpa(e.e_r),
        mpa(e.g_zr),
        e.nu_zr,
        e.nu_r,
        e.alpha_z,
        e.alpha_r,
        body.conductivity_z,
        body.conductivity_r
    )
}

fn spool(spool: Option<&Spool>) -> String {
    let Some(spool) = spool else { return "    spool: None,\n".into() };
    let (solid, e) = (&spool.material, &spool.material.elastic);
    let bonded = |contact: Contact| contact == Contact::Bonded;
    let flange = |f: &coil::Flange| {
        let (thickness, overhang) = (mm(f.thickness), mm(f.overhang));
        format!("(side: {}, thickness_mm: {thickness}, overhang_mm: {overhang}, bonded: {})", side(f.side), bonded(f.contact))
    };
    format!(
        "    spool: Some((\n        material: (youngs_modulus_gpa: {}, poisson_ratio: {:?}, thermal_expansion_per_k: {:?},\n                   \
         conductivity_w_per_mk: {:?}, density_kg_per_m3: {:?}, specific_heat_j_per_kgk: {:?}),\n        hub_thickness_mm: {},\n        \
         hub_bonded: {},\n        flanges: [{}],\n    )),\n",
        gpa(e.youngs_modulus),
        e.poisson_ratio,
        e.thermal_expansion,
        solid.conductivity,
        solid.density,
        solid.specific_heat,
        mm(spool.hub_thickness),
        bonded(spool.hub_contact),
        list(spool.flanges.iter().map(flange))
    )
}

fn list(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<_>>().join(", ")
}

fn mechanics(mechanics: &Mechanics) -> String {
    let law = match mechanics {
        Mechanics::Elastic => return String::new(),
        Mechanics::TemperatureTable(rows) => {
            let rows = rows.iter().fold(String::new(), |mut text, row| {
                let _ = writeln!(
                    text,
                    "        (temperature_c: {:?}, transverse_modulus_factor: {:?}, transverse_expansion_factor: {:?}),",
                    row.temperature, row.transverse_modulus, row.transverse_expansion
                );
                text
            });
            format!("TemperatureTable([\n{rows}    ])")
        }
        Mechanics::Relaxing { fraction, time } => format!("Relaxing((fraction: {fraction:?}, time_s: {time:?}))"),
        Mechanics::Opening(o) => {
            let (below, hysteresis, fraction) = (o.below, o.hysteresis, o.fraction);
            format!("Opening((side: {}, below_c: {below:?}, hysteresis_k: {hysteresis:?}, fraction: {fraction:?}))", side(o.side))
        }
    };
    format!("    mechanics: {law},\n")
}

fn heat(heat: &HeatPaths) -> String {
    if *heat == HeatPaths::default() {
        return String::new();
    }
    let mount = |m: &coil::Mount| format!("(side: {}, conductance_w_per_m2k: {:?})", side(m.side), m.conductance);
    let heater = |h: &coil::Heater| format!("(side: {}, power_w: {:?})", side(h.side), h.power);
    format!(
        "    heat: (\n        hub_resistance_m2k_per_w: {:?},\n        mounts: [{}],\n        heaters: [{}],\n        film_w_per_m2k: {},\n    ),\n",
        heat.hub_resistance,
        list(heat.mounts.iter().map(mount)),
        list(heat.heaters.iter().map(heater)),
        heat.film.map_or("None".into(), |film| format!("Some({film:?})"))
    )
}

/// Optics, drifts, dehomogenisation row, and the closing bracket.
fn optics(design: &Design) -> String {
    let (o, m) = (&design.optics, &design.dehomogenization);
    let strain = if o.strain == StrainConvention::Mechanical { "Mechanical" } else { "Total" };
    let drifts = if design.drifts == Drifts::default() {
        String::new()
    } else {
        let Drifts { reference, thermo_optic_curvature, read_out } = design.drifts;
        let read_out = number(read_out, |v| v * DEG_PER_H_PER_RAD_PER_S, |v| v / DEG_PER_H_PER_RAD_PER_S);
        format!(
            "    drifts: (reference_c: {reference:?}, thermo_optic_curvature_per_k2: {thermo_optic_curvature:?}, \
             read_out_deg_per_h_per_k: {read_out}),\n"
        )
    };
    format!(
        "    optics: (\n        refractive_index: {:?}, thermo_optic_per_k: {:?}, thermal_expansion_per_k: {:?}, p11: {:?}, p12: {:?},\n        \
         sagnac_diameter_mm: {},\n        strain: {strain},\n    ),\n{drifts}    \
         dehomogenization: Matrix((m_rx: {:?}, m_ry: {:?}, m_rz: {:?}, m_rt_per_k: {:?})),\n)\n",
        o.refractive_index,
        o.thermo_optic,
        o.thermal_expansion,
        o.p11,
        o.p12,
        mm(o.sagnac_diameter),
        m.m_rx,
        m.m_ry,
        m.m_rz,
        m.m_rt
    )
}
