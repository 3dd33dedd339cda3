//! Drawings that differ from a design in one word, which a drawing, or a unit, may have otherwise.

use coil::{Contact, Design, Flange, Layout, Region, Side, Solid};
use fem_core::material::Isotropic;
use winding::ClimbSide;

/// A design with one word changed.
pub(crate) struct OtherDrawing {
    /// The key of the coil file and its other value.
    pub(crate) words: String,
    /// The design that has it.
    pub(crate) design: Design,
}

/// Materials that spools are made of: name, Young's modulus \[GPa\], Poisson's ratio, expansion \[1e-6/K\], conductivity \[W/(m K)\], density \[kg/m³\] and
/// specific heat \[J/(kg K)\]. Handbook values, those of `fixtures/spool-materials.ron`.
const MATERIALS: [(&str, [f64; 6]); 5] = [
    ("Al 6061", [68.9, 0.33, 23.6, 167.0, 2700.0, 896.0]),
    ("Ti-6Al-4V", [113.8, 0.342, 8.6, 6.7, 4430.0, 526.0]),
    ("steel 304", [193.0, 0.29, 17.3, 16.2, 8000.0, 500.0]),
    ("Invar", [141.0, 0.29, 1.3, 10.5, 8050.0, 515.0]),
    ("quasi-isotropic CFRP", [60.0, 0.30, 2.0, 5.0, 1600.0, 900.0]),
];
/// Further alloys that a store or a workshop may take instead, each another in expansion or stiffness by more than [`ALIKE`] from all the others: values
/// at room temperature as data sheets give them.
const INSTEAD: [(&str, [f64; 6]); 5] = [
    ("steel 430", [200.0, 0.28, 10.4, 26.0, 7740.0, 460.0]),
    ("Al 4032", [78.6, 0.33, 19.4, 155.0, 2680.0, 864.0]),
    ("brass C360", [97.0, 0.34, 20.5, 115.0, 8500.0, 380.0]),
    ("copper C101", [117.0, 0.34, 16.9, 390.0, 8940.0, 385.0]),
    ("magnesium AZ31B", [45.0, 0.35, 26.0, 96.0, 1770.0, 1000.0]),
];
/// Relative difference of modulus and expansion up to which a material is the drawing's own: alloys of one kind.
const ALIKE: f64 = 0.1;

/// Every bond of coil and spool that is not, or is, the side to which the winding climbs, and other materials of the spool.
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
    if let Some(spool) = &design.spool {
        for (name, values) in MATERIALS.into_iter().chain(INSTEAD) {
            let material = solid(values);
            let [drawn, other] = [&spool.material.elastic, &material.elastic];
            let alike = |a: f64, b: f64| (a - b).abs() <= ALIKE * b;
            let same =
                alike(drawn.youngs_modulus, other.youngs_modulus) && alike(drawn.thermal_expansion, other.thermal_expansion);
            if !same {
                let words = format!("spool.material: that of {name}");
                all.push(changed(words, &|d| d.spool.iter_mut().for_each(|spool| spool.material = material)));
            }
        }
    }
    all
}

fn solid([modulus, poisson_ratio, expansion, conductivity, density, specific_heat]: [f64; 6]) -> Solid {
    let elastic = Isotropic { youngs_modulus: 1e9 * modulus, poisson_ratio, thermal_expansion: 1e-6 * expansion };
    Solid { elastic, conductivity, density, specific_heat }
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
            [
                "spool.hub_bonded: false",
                "spool.flanges[0].bonded: false (the right one)",
                "winding.cw_climbs: Left",
                "spool.material: that of Ti-6Al-4V",
                "spool.material: that of steel 304",
                "spool.material: that of Invar",
                "spool.material: that of quasi-isotropic CFRP",
                "spool.material: that of steel 430",
                "spool.material: that of Al 4032",
                "spool.material: that of brass C360",
                "spool.material: that of copper C101",
                "spool.material: that of magnesium AZ31B"
            ]
        );
        for other in &others {
            assert!(other.design != design);
            // changed twice it is the design again
            let back = |back: &OtherDrawing| {
                let sensor =
                    (back.design.sensor.radius - design.sensor.radius).abs() + (back.design.sensor.y - design.sensor.y).abs();
                sensor < 1e-12 && Design { sensor: design.sensor, ..back.design.clone() } == design
            };
            let is_material = other.words.starts_with("spool.material");
            assert!(is_material || other_drawings(&other.design).iter().any(back), "{}", other.words);
            // its thermometer, at the bore, is never left in the air
            let layout = Layout::new(&other.design).unwrap();
            assert!(layout.region(other.design.sensor.radius + 1e-9, other.design.sensor.y) == Region::Hub, "{}", other.words);
        }
    }

    /// A spool of a listed material is not tried as one of that material; the list is that of the fixture.
    #[test]
    fn the_materials_are_those_of_the_fixture() {
        let text = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/spool-materials.ron"));
        for (name, values) in MATERIALS {
            let [modulus, poisson, expansion, conductivity, density, specific_heat] = values;
            let listed = format!(
                "(name: \"{name}\", youngs_modulus_gpa: {modulus:.1}, poisson_ratio: {poisson:?}, thermal_expansion_per_k: {expansion:?}e-6, \
                 conductivity_w_per_mk: {conductivity:?}, density_kg_per_m3: {density:?}, specific_heat_j_per_kgk: {specific_heat:?})"
            );
            let plain = |text: &str| text.split_whitespace().collect::<String>().replace("0.30,", "0.3,");
            assert!(plain(text).contains(&plain(&listed)), "{listed}");
            let coil = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron"));
            let mut design = crate::input::check_coil(Path::new("coil.ron"), coil).unwrap().design;
            design.spool.as_mut().unwrap().material = solid(values);
            let tried: Vec<String> = other_drawings(&design).into_iter().map(|other| other.words).collect();
            assert!(tried.iter().all(|words| !words.ends_with(name)), "{tried:?}");
        }
    }
}
