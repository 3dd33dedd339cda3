//! Drawings that differ from a design in one word, which a drawing, or a unit, may have otherwise.

use coil::{Contact, Design, Flange, Layout, Region, Side};
use winding::ClimbSide;

/// A design with one word changed.
pub(crate) struct OtherDrawing {
    /// The key of the coil file and its other value.
    pub(crate) words: String,
    /// The design that has it.
    pub(crate) design: Design,
}

/// Every bond of coil and spool that is not, or is, and the side to which the winding climbs.
pub(crate) fn other_drawings(design: &Design) -> Vec<OtherDrawing> {
    let changed = |words: String, change: &dyn Fn(&mut Design)| {
        let (drawn, mut design) = (design, design.clone());
        change(&mut design);
        follow(drawn, &mut design);
        OtherDrawing { words, design }
    };
    let mut all = Vec::new();
    if let Some(spool) = &design.spool {
        let (is, other) = exchanged(spool.hub_contact);
        all.push(changed(format!("spool.hub_bonded: {is}"), &|d| d.spool.iter_mut().for_each(|spool| spool.hub_contact = other)));
        for (n, Flange { side, contact, .. }) in spool.flanges.iter().enumerate() {
            let (is, other) = exchanged(*contact);
            let side = if *side == Side::Left { "left" } else { "right" };
            let words = format!("spool.flanges[{n}].bonded: {is} (the {side} one)");
            all.push(changed(words, &|d| d.spool.iter_mut().for_each(|spool| spool.flanges[n].contact = other)));
        }
    }
    let (is, other) = match design.winding.cw_climbs {
        ClimbSide::Left => ("Right", ClimbSide::Right),
        ClimbSide::Right => ("Left", ClimbSide::Left),
    };
    all.push(changed(format!("winding.cw_climbs: {is}"), &|d| d.winding.cw_climbs = other));
    all
}

/// A part that comes nearer to the coil, or stands back from it, takes the thermometer with it that sits on it.
fn follow(drawn: &Design, changed: &mut Design) {
    let (Some(before), Some(after)) = (&drawn.spool, &changed.spool) else { return };
    let Ok(layout) = Layout::new(drawn) else { return };
    let sensor = &mut changed.sensor;
    match layout.region(drawn.sensor.radius, drawn.sensor.y) {
        Region::Coil | Region::Medium => {}
        region => {
            sensor.radius -= after.hub_contact.gap() - before.hub_contact.gap();
            for (was, is) in before.flanges.iter().zip(&after.flanges).filter(|(was, _)| Region::flange(was.side) == region) {
                let back = is.contact.gap() - was.contact.gap();
                sensor.y += if was.side == Side::Left { -back } else { back };
            }
        }
    }
}

fn exchanged(contact: Contact) -> (bool, Contact) {
    match contact {
        Contact::Bonded => (false, Contact::Gap),
        Contact::Gap => (true, Contact::Bonded),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    #[test]
    fn each_word_of_the_reference_coil_is_changed_alone() {
        let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron"));
        let design = crate::input::check_coil(Path::new("coil.ron"), text).unwrap().design;
        let others = other_drawings(&design);
        let words: Vec<&str> = others.iter().map(|other| other.words.as_str()).collect();
        assert_eq!(
            words,
            ["spool.hub_bonded: false", "spool.flanges[0].bonded: false (the right one)", "winding.cw_climbs: Left"]
        );
        for other in &others {
            assert!(other.design != design);
            // changed twice it is the design again
            let back = |back: &OtherDrawing| {
                let sensor =
                    (back.design.sensor.radius - design.sensor.radius).abs() + (back.design.sensor.y - design.sensor.y).abs();
                sensor < 1e-12 && Design { sensor: design.sensor, ..back.design.clone() } == design
            };
            assert!(other_drawings(&other.design).iter().any(back), "{}", other.words);
            // its thermometer, at the bore, is never left in the air
            let layout = Layout::new(&other.design).unwrap();
            assert!(layout.region(other.design.sensor.radius + 1e-9, other.design.sensor.y) == Region::Hub, "{}", other.words);
        }
    }
}
