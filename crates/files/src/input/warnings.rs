//! Entries of a coil file that are allowed but rarely meant.

use coil::{Body, Design, Layout, Region, Sensor};
use winding::{Half, Pattern, Winding};

use crate::note::Note;
use crate::remark::Remark;
use crate::units::to_mm;

/// Room between winding and rectangle that a drawing leaves, in pitches.
const ROOM: f64 = 1.0;
/// The same along the axis: the strain is steep at a flange, and a tenth of a pitch of room there changes the sensitivity of the reference coil by 3 %.
const AXIAL_ROOM: f64 = 0.1;

/// Largest relative distance of neighbouring turns' spacing from the pitch that passes without a word: the film of adhesive between two fibres.
const SAME_SPACING: f64 = 0.03;
/// Part of a pitch by which turns may stand out of the coil without a word: twice the largest tolerance of a winding's end, where a fit of a record may put it.
const OUTSIDE: f64 = 0.25;
/// Largest relative distance of the effective diameter from the [`mean_diameter`] that passes without a word.
const SAME_DIAMETER: f64 = 0.02;

/// Distance from a solid at which a thermometer is still on it \[m\]: the rounding of a drawing.
const ON: f64 = 1e-6;

/// Whether the winding fills the body in radius, but for the room that a drawing leaves.
fn is_filled(body: &Body, winding: &Winding) -> bool {
    body.outer_radius <= winding.outer_radius() + ROOM * winding.spec().pitch
}

/// The effective diameter D unless another was measured \[m\]: the coil's mean diameter where the winding fills it, else that of the turns.
pub fn mean_diameter(body: &Body, winding: &Winding) -> f64 {
    if is_filled(body, winding) { winding.spec().inner_radius + body.outer_radius } else { winding.mean_diameter() }
}

/// Whether a thermometer is on no solid.
pub(crate) fn in_medium(layout: &Layout, sensor: Sensor) -> bool {
    let near = [-ON, 0.0, ON];
    near.iter().all(|dr| near.iter().all(|dy| layout.region(sensor.radius + dr, sensor.y + dy) == Region::Medium))
}

/// A warning of each thing that is allowed but looks like a mistake.
pub fn warnings(design: &Design, layout: &Layout, winding: &Winding) -> Vec<Note> {
    let mut found = Vec::new();
    let (body, pitch) = (&design.body, design.winding.pitch);
    let mut unfilled = |what: &str, field: &str, room: f64, body: f64, winding: f64, meaning: &str| {
        if body > winding + room * pitch {
            let (body, winding) = (to_mm(body), to_mm(winding));
            let message = format!("{field}: the coil {what} {body:.4} mm, but its turns end at {winding:.4} mm{meaning}");
            found.push(Remark::UnfilledCoil.warning(message));
        }
    };
    let at_left =
        ": they begin at the left face, and the sensitivity depends on that; give winding.start_mm and end_mm; is this meant?";
    let potted = "; is this meant? A coil that is potted beyond its turns on purpose needs no change: ignore this warning";
    unfilled("reaches to", "coil.outer_radius_mm", ROOM, body.outer_radius, winding.outer_radius(), potted);
    if design.winding.start == 0.0 && design.winding.end.is_none() {
        unfilled("is as high as", "coil.height_mm", AXIAL_ROOM, body.height, winding.height(), at_left);
    }
    let spacing = design.winding.spacing();
    if (spacing / pitch - 1.0).abs() > SAME_SPACING {
        let (spacing, pitch) = (to_mm(spacing), to_mm(pitch));
        let message = format!("winding.end_mm: turns lie {spacing:.4} mm apart, where the pitch is {pitch} mm; is this meant?");
        found.push(Remark::OtherSpacing.warning(message));
    }
    let ([first, last], [lowest, highest]) = (design.winding.edges(), design.winding.reach());
    let outside = (-first).max(spacing / 2.0 - lowest).max(last - body.height).max(highest + spacing / 2.0 - body.height);
    if outside > OUTSIDE * pitch {
        let [outside, height] = [outside, body.height].map(to_mm);
        let message = format!(
            "winding: the outermost turns reach {outside:.3} mm out of the coil's {height:.3} mm, into what is beside it; is this meant?"
        );
        found.push(Remark::TurnOutside.warning(message));
    }
    let (inner, outer) = (2.0 * design.winding.inner_radius, 2.0 * body.outer_radius);
    let sagnac = design.optics.sagnac_diameter;
    if !(inner..=outer).contains(&sagnac) {
        let (sagnac, inner, outer) = (to_mm(sagnac), to_mm(inner), to_mm(outer));
        let message =
            format!("optics.sagnac_diameter_mm: {sagnac} mm lies outside the coil, {inner:.3} to {outer:.3} mm; is this meant?");
        found.push(Remark::SagnacOutside.warning(message));
    } else if (sagnac / mean_diameter(body, winding) - 1.0).abs() > SAME_DIAMETER {
        let (sagnac, mean) = (to_mm(sagnac), to_mm(mean_diameter(body, winding)));
        let of = if is_filled(body, winding) { "coil" } else { "turns" };
        let message =
            format!("optics.sagnac_diameter_mm: {sagnac} mm is not the mean diameter of the {of}, {mean:.3} mm; is this meant?");
        found.push(Remark::SagnacDiffers.warning(message));
    }
    let (pattern, layers) = (design.winding.pattern, design.winding.layers);
    // layers after which it begins anew
    let period = match pattern {
        Pattern::Cylindrical => 1,
        Pattern::Dipole => 2,
        Pattern::Quadrupole | Pattern::PracticalQuadrupole => 4,
        Pattern::Octupole => 8,
    };
    if layers % period != 0 {
        let message = format!(
            "winding.layers: {layers} layers are no whole number of the {period} after which the pattern {pattern:?} begins anew: the halves of \
             the fibre lie differently; is this meant?"
        );
        found.push(Remark::BrokenPattern.warning(message));
    }
    let sensor = design.sensor;
    if in_medium(layout, sensor) {
        let (radius, y) = (to_mm(sensor.radius), to_mm(sensor.y));
        let message =
            format!("sensor: radius {radius:.3} mm, y {y:.3} mm is in the medium, on no part of spool or coil; is this meant?");
        found.push(Remark::SensorInMedium.warning(message));
    }
    let tails = design.winding.tails;
    if tails.cw.max(tails.ccw) > winding.wound_length() / 2.0 {
        let half = winding.turns().iter().filter(|t| t.half == Half::Cw).map(|t| t.length()).sum::<f64>();
        let message = format!("winding.tails_m: a tail longer than half the winding ({half:.1} m); is this meant?");
        found.push(Remark::LongTail.warning(message));
    }
    let elastic = design.body.elastic;
    if elastic.e_r < 1e-4 * elastic.e_z {
        let ratio = elastic.e_r / elastic.e_z;
        let message = format!("coil.material: e_r is {ratio:.1e} of e_z; is e_r_mpa in MPa and e_z_gpa in GPa?");
        found.push(Remark::ModulusRatio.warning(message));
    }
    found
}
