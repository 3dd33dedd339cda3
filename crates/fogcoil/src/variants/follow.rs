//! A body that follows its winding, as a designer draws it anew when the number of turns changes.

use serde::Deserialize;

use crate::input::{CoilCase, mean_diameter};
use crate::units::to_mm;

/// Whether the dimensions that the winding decides follow it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
pub enum Dimensions {
    /// All dimensions are those of the drawing.
    #[default]
    AsDrawn,
    /// Turns that the drawing spreads evenly up to an end keep their spacing over the pitch, so that this end moves. The coil's outer radius and height keep
    /// their distance from the ends of the winding, the thermometer its distance from the bore and from mid height, D
    /// its distance from the mean diameter; odd and even layers differ by as many turns. A key that the plan varies does not follow.
    FollowWinding,
}

const OUTER_RADIUS: &str = "coil.outer_radius_mm";
const HEIGHT: &str = "coil.height_mm";
const ODD: &str = "winding.turns_odd_layers";
const EVEN: &str = "winding.turns_even_layers";
const LAYERS: &str = "winding.layers";
const PITCH: &str = "winding.pitch_mm";
const START: &str = "winding.start_mm";
const END: &str = "winding.end_mm";
const SAGNAC: &str = "optics.sagnac_diameter_mm";
const INNER: &str = "winding.inner_radius_mm";
const HUB: &str = "spool.hub_thickness_mm";
const SENSOR: [&str; 2] = ["sensor.radius_mm", "sensor.y_mm"];

fn is_varied(edits: &[(String, String)], key: &str) -> bool {
    edits.iter().any(|(edited, _)| edited == key)
}

impl Dimensions {
    /// Further edits that make room for the winding of the given edits.
    pub(super) fn room(self, case: &CoilCase, edits: &[(String, String)]) -> Vec<(String, String)> {
        if self == Self::AsDrawn {
            return Vec::new();
        }
        let spec = case.winding.spec();
        let number = |key: &str, drawn: f64| {
            edits.iter().find(|(edited, _)| edited == key).and_then(|(_, text)| text.parse().ok()).unwrap_or(drawn)
        };
        let pitch = number(PITCH, to_mm(spec.pitch));
        let odd = number(ODD, spec.turns_odd_layers as f64);
        let inner = number(INNER, to_mm(spec.inner_radius));
        let layers = number(LAYERS, spec.layers as f64);
        let mut room = Vec::new();
        let mut even = number(EVEN, spec.turns_even_layers as f64);
        if is_varied(edits, ODD) && !is_varied(edits, EVEN) {
            even = odd - (spec.turns_odd_layers as f64 - spec.turns_even_layers as f64);
            room.push((EVEN.to_owned(), format!("{even}")));
        }
        // a layer is no higher than a pitch, a row of turns no longer than one turn more
        let mut height = (odd + 2.0) * pitch;
        if spec.end.is_some()
            && !is_varied(edits, END)
            && [LAYERS, PITCH, ODD, EVEN, START].iter().any(|key| is_varied(edits, key))
        {
            let [turns_odd_layers, turns_even_layers, layers] = [odd, even, layers].map(|count| count as usize);
            let touching = winding::Spec { turns_odd_layers, turns_even_layers, layers, pitch, start: 0.0, end: None, ..*spec };
            let end = number(START, to_mm(spec.start)) + touching.edges()[1] * spec.spacing() / spec.pitch;
            room.push((END.to_owned(), format!("{end}")));
            height = height.max(end + pitch);
        }
        let bounds = [(OUTER_RADIUS, inner + (layers + 1.0) * pitch), (HEIGHT, height)];
        let design = &case.design;
        if let Some(hub) = design.spool.as_ref().map(|spool| to_mm(spool.hub_thickness))
            && SENSOR.iter().all(|key| !is_varied(edits, key))
        {
            // from the bore, where a thermometer would else be left in the air
            let moved = inner - to_mm(spec.inner_radius) - (number(HUB, hub) - hub);
            room.push((SENSOR[0].to_owned(), format!("{}", to_mm(design.sensor.radius) + moved)));
        }
        let free = bounds.into_iter().filter(|(key, _)| !is_varied(edits, key));
        room.extend(free.map(|(key, bound)| (key.to_owned(), format!("{bound}"))));
        room
    }

    /// Lets the dimensions of `case` follow its winding as `drawn` has them, but for those that the `edits` give.
    pub(super) fn follow(self, drawn: &CoilCase, edits: &[(String, String)], case: &mut CoilCase) {
        if self == Self::AsDrawn {
            return;
        }
        let (design, before) = (&mut case.design, &drawn.design);
        let varied = |key: &str| is_varied(edits, key);
        let reach = [case.winding.outer_radius() - drawn.winding.outer_radius(), case.winding.height() - drawn.winding.height()];
        if !varied(OUTER_RADIUS) {
            design.body.outer_radius = before.body.outer_radius + reach[0];
        }
        if !varied(HEIGHT) {
            design.body.height = before.body.height + reach[1];
        }
        if SENSOR.iter().all(|key| !varied(key)) {
            let hub =
                |design: &coil::Design| design.winding.inner_radius - design.spool.as_ref().map_or(0.0, |s| s.hub_thickness);
            design.sensor.radius = before.sensor.radius + hub(design) - hub(before);
            design.sensor.y = before.sensor.y + (design.body.height - before.body.height) / 2.0;
        }
        if !varied(SAGNAC) {
            let [now, then] = [mean_diameter(&design.body, &case.winding), mean_diameter(&before.body, &drawn.winding)];
            design.optics.sagnac_diameter = before.optics.sagnac_diameter + now - then;
        }
    }
}
