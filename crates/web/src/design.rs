//! Designs: files to start from, other values in them, and what is seen at once.

use std::path::Path;

use fogcoil::input::{self, AnyCell, CoilCase};
use fogcoil::{Error, picture, wind};
use homogenization::TOLERANCE;
use serde_json::{Map, Value, json};

use crate::question::Changes;

/// Names of the texts in messages.
const COIL: &str = "coil.ron";
const CELL: &str = "cell.ron";
/// Keys that a page has fields for; their values come with every design.
const KEYS: [&str; 9] = [
    "winding.pattern",
    "winding.cw_climbs",
    "winding.inner_radius_mm",
    "winding.tails_m.cw",
    "winding.tails_m.ccw",
    "spool.material",
    "spool.hub_thickness_mm",
    "spool.hub_bonded",
    "sensor.radius_mm",
];
/// The same of a cell.
const ADHESIVE: [&str; 3] = ["adhesive.youngs_modulus_mpa", "adhesive.poisson_ratio", "adhesive.thermal_expansion_per_k"];

/// The files that `fogcoil new` writes, and the numbers of the cell's adhesive.
pub(crate) fn start() -> Value {
    let cell = include_str!("../../fogcoil/templates/cell.ron");
    let value = |key: &str| Some((key.to_owned(), input::field_text(CELL.as_ref(), cell, key).ok()?.into()));
    json!({
        "adhesive": ADHESIVE.into_iter().filter_map(value).collect::<Map<_, Value>>(),
        "coil": include_str!("../../fogcoil/templates/coil.ron"),
        "cell": cell,
        "profile": include_str!("../../fogcoil/templates/profile.csv"),
    })
}

/// The coil of a text.
pub(crate) fn case(coil: &str) -> Result<CoilCase, Error> {
    Ok(input::check_coil(COIL.as_ref(), coil)?)
}

/// The changed design: its text, its winding, and what looks like a mistake in it.
pub(crate) fn changed(changes: &Changes) -> Result<Value, Error> {
    let path = Path::new(COIL);
    let mut coil = input::with_fields(path, &changes.coil, &changes.values)?;
    if let Some(cell) = &changes.cell {
        let text = input::with_fields(CELL.as_ref(), cell, &changes.of_cell)?;
        let AnyCell::Regular(cell, _) = input::check_any_cell(CELL.as_ref(), &text)? else {
            return Err(Error::usage(format!("{CELL}: is not a cell of concentric rings; write its constants into {COIL}")));
        };
        coil = input::with_constants(path, &coil, &cell.homogenize_to(TOLERANCE)?.constants)?;
    }
    let case = case(&coil)?;
    // a part that a file leaves out has no value
    let value = |key: &str| Some((key.to_owned(), input::field_text(path, &coil, key).ok()?.into()));
    Ok(json!({
        "values": KEYS.into_iter().filter_map(value).collect::<Map<_, Value>>(),
        "winding": wind::json(&case),
        "text": wind::text(&case),
        "picture": picture::svg(&case.name, &case.winding),
        "warnings": case.warnings.iter().map(|note| note.message()).collect::<Vec<_>>(),
        "coil": coil,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[(&str, &str)], cell: bool, of_cell: &[(&str, &str)]) -> Result<Value, Error> {
        let (start, owned) =
            (start(), |all: &[(&str, &str)]| all.iter().map(|(key, value)| ((*key).into(), (*value).into())).collect());
        let text = |name: &str| start[name].as_str().unwrap().to_owned();
        changed(&Changes { coil: text("coil"), values: owned(values), cell: cell.then(|| text("cell")), of_cell: owned(of_cell) })
    }

    #[test]
    fn every_field_of_the_page_is_there_and_can_be_changed() {
        let design = of(&[], false, &[]).unwrap();
        assert_eq!(design["values"].as_object().unwrap().len(), KEYS.len());
        assert_eq!(start()["adhesive"].as_object().unwrap().len(), ADHESIVE.len());
        // without a spool there is nothing of it that could have a tolerance
        let free = of(&[("spool", "None"), ("tolerances", "{}")], false, &[]).unwrap();
        assert!(free["values"].get("spool.hub_thickness_mm").is_none());
        let changed = of(&[("winding.pattern", "Octupole"), ("winding.tails_m.cw", "0.5")], false, &[]).unwrap();
        assert_eq!([&changed["winding"]["pattern"], &changed["values"]["winding.tails_m.cw"]], ["Octupole", "0.5"]);
        let fibre = |design: &Value| design["winding"]["fibre_m"].as_f64().unwrap();
        assert!((fibre(&changed) - fibre(&design) - 0.5).abs() < 1e-9);
        assert!(of(&[("winding.pattern", "Best")], false, &[]).unwrap_err().to_string().contains("winding.pattern"));
    }

    #[test]
    fn an_adhesive_changes_the_constants() {
        let material = |design: &Value| {
            let text = design["coil"].as_str().unwrap();
            input::field_text(COIL.as_ref(), text, "coil.material").unwrap().to_owned()
        };
        let soft = of(&[], true, &[("adhesive.youngs_modulus_mpa", "2.0")]).unwrap();
        assert!(material(&soft).starts_with("Constants(") && material(&soft) != material(&of(&[], true, &[]).unwrap()));
        let wrong = of(&[], true, &[("adhesive.poisson_ratio", "0.6")]).unwrap_err().to_string();
        assert!(wrong.contains("cell.ron") && wrong.contains("poisson_ratio"), "{wrong}");
    }
}
