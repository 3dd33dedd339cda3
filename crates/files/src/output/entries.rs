//! A design key by key, as its coil file writes it.

use coil::{Design, Tolerances};
use serde_json::Value;

use crate::input::CoilFile;

/// Every key of a design with its value, in the order of a coil file and in the units of the keys, as [`super::coil_file`] writes them, but
/// for the name and the tolerances. Keys are those by which a value is replaced: `spool.flanges[0].side`. A choice stands at its own key, its
/// fields below. A key that a file may leave out, and does, is missing; an empty list gives nothing.
pub fn design_entries(design: &Design) -> Vec<(String, String)> {
    let file = CoilFile::new("", design, &Tolerances::default());
    let mut all = Vec::new();
    // the types of a coil file have nothing that JSON cannot say
    if let Ok(Value::Object(fields)) = serde_json::to_value(file) {
        for (key, value) in fields.into_iter().filter(|(key, _)| key != "name") {
            collect(key, value, &mut all);
        }
    }
    all
}

/// Whether a key of an object is the name of a choice and no field.
fn is_choice(key: &str) -> bool {
    key.starts_with(|c: char| c.is_ascii_uppercase())
}

fn collect(key: String, value: Value, all: &mut Vec<(String, String)>) {
    match value {
        Value::Null => all.push((key, "None".into())),
        Value::String(text) => all.push((key, text)),
        Value::Array(items) => {
            for (n, item) in items.into_iter().enumerate() {
                collect(format!("{key}[{n}]"), item, all);
            }
        }
        Value::Object(fields) => match fields.keys().next().cloned() {
            Some(choice) if fields.len() == 1 && is_choice(&choice) => {
                all.push((key.clone(), choice));
                fields.into_iter().for_each(|(_, inner)| collect(key.clone(), inner, all));
            }
            _ => fields.into_iter().for_each(|(field, inner)| collect(format!("{key}.{field}"), inner, all)),
        },
        Value::Number(number) => all.push((
            key,
            match number.as_f64() {
                Some(value) if number.is_f64() => format!("{value:?}"),
                _ => number.to_string(),
            },
        )),
        Value::Bool(value) => all.push((key, value.to_string())),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::input::{check_coil, field_text};

    const TEMPLATE: &str = include_str!("../../../fogcoil/templates/coil.ron");

    #[test]
    fn every_key_of_the_template_is_found_with_its_value() {
        let file = Path::new("coil.ron");
        let case = check_coil(file, TEMPLATE).expect("the template");
        let entries = design_entries(&case.design);
        let of = |wanted: &str| entries.iter().find(|(key, _)| key == wanted).map(|(_, value)| value.as_str());
        assert_eq!((of("winding.cw_climbs"), of("coil.material")), (Some("Right"), Some("Constants")));
        assert_eq!((of("name"), entries.iter().any(|(key, _)| key.starts_with("tolerances"))), (None, false));
        // numbers are those of the file under the same keys
        let numbers: Vec<(&str, f64)> =
            entries.iter().filter_map(|(key, value)| Some((key.as_str(), value.parse().ok()?))).collect();
        assert!(numbers.len() > 30, "{entries:?}");
        let mut held = 0;
        for (key, value) in numbers {
            let Ok(text) = field_text(file, TEMPLATE, key) else { continue };
            let written: f64 = text.trim_start_matches("Some(").trim_end_matches(')').parse().expect(key);
            assert!((value - written).abs() <= 1e-14 * written.abs(), "{key}: {value} {written}");
            held += 1;
        }
        assert!(held > 30, "{held}");
    }

    #[test]
    fn choices_lists_and_nothing_have_keys() {
        let value = serde_json::json!({"a": {"Relaxing": {"x": 1.5}}, "b": [{"side": "Left"}], "c": null, "d": [], "e": {"x": {"y": true}}});
        let mut all = Vec::new();
        let Value::Object(fields) = value else { panic!() };
        fields.into_iter().for_each(|(key, value)| collect(key, value, &mut all));
        let told: Vec<String> = all.iter().map(|(key, value)| format!("{key} {value}")).collect();
        assert_eq!(told, ["a Relaxing", "a.x 1.5", "b[0].side Left", "c None", "e.x.y true"]);
    }
}
