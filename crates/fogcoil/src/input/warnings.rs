//! What a coil file may say but rarely means.

use coil::Design;
use winding::{Half, Winding};

use crate::units::to_mm;

/// Room between winding and rectangle that a drawing leaves, in pitches.
const ROOM: f64 = 1.0;

/// A line for each thing that is allowed but looks like a mistake.
pub(crate) fn warnings(design: &Design, winding: &Winding) -> Vec<String> {
    let mut lines = Vec::new();
    let (body, pitch) = (&design.body, design.winding.pitch);
    let mut unfilled = |what: &str, field: &str, body: f64, winding: f64| {
        if body > winding + ROOM * pitch {
            let (body, winding) = (to_mm(body), to_mm(winding));
            lines.push(format!("{field}: the coil {what} {body:.4} mm, but its turns end at {winding:.4} mm; is this meant?"));
        }
    };
    unfilled("reaches to", "coil.outer_radius_mm", body.outer_radius, winding.outer_radius());
    unfilled("is as high as", "coil.height_mm", body.height, winding.height());
    let (inner, outer) = (2.0 * design.winding.inner_radius, 2.0 * body.outer_radius);
    let sagnac = design.optics.sagnac_diameter;
    if !(inner..=outer).contains(&sagnac) {
        let (sagnac, inner, outer) = (to_mm(sagnac), to_mm(inner), to_mm(outer));
        lines.push(format!(
            "optics.sagnac_diameter_mm: {sagnac} mm lies outside the coil, {inner:.3} to {outer:.3} mm; is this meant?"
        ));
    }
    let tails = design.winding.tails;
    if tails.cw.max(tails.ccw) > winding.wound_length() / 2.0 {
        let half = winding.turns().iter().filter(|t| t.half == Half::Cw).map(|t| t.length()).sum::<f64>();
        lines.push(format!("winding.tails_m: a tail longer than half the winding ({half:.1} m); is this meant?"));
    }
    let elastic = design.body.elastic;
    if elastic.e_r < 1e-4 * elastic.e_z {
        lines.push(format!(
            "coil.material: e_r is {:.1e} of e_z; is e_r_mpa in MPa and e_z_gpa in GPa?",
            elastic.e_r / elastic.e_z
        ));
    }
    lines
}
