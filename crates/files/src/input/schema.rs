//! JSON Schemas of the files, made from the types that read them.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use super::cell_file::CellFile;
use super::coil_file::CoilFile;
use super::map_file::MapFile;
use super::mechanism_file::MechanismFile;
use super::meta::Meta;
use super::targets_file::TargetsFile;

/// Rules for writing the JSON of a schema as RON.
const RON: &str = "The file is RON: an object is written (key: value, ...), a list [a, b] or, of fixed length, (a, b), an object with one \
    capitalised key, {\"Name\": x}, is Name(x), a capitalised string is written without quotes, null is None. Numbers are in the unit x-unit.";

/// The one field that RON does not have.
const ADDRESS: &str = "Address of this schema, for an editor; in JSON alone, ignored by the program.";

/// JSON Schemas of the files that the program reads, by name: `coil`, `cell`, `targets`, `mechanism`, `meta`, `map`.
pub fn schemas() -> [(&'static str, Value); 6] {
    [
        ("coil", of::<CoilFile>()),
        ("cell", of::<CellFile>()),
        ("targets", of::<TargetsFile>()),
        ("mechanism", of::<MechanismFile>()),
        ("meta", of::<Meta>()),
        ("map", of::<MapFile>()),
    ]
}

fn of<T: JsonSchema>() -> Value {
    let mut schema = SchemaSettings::draft2020_12().into_generator().into_root_schema_for::<T>();
    schema.insert("$comment".into(), json!(RON));
    if let Some(fields) = schema.get_mut("properties").and_then(Value::as_object_mut) {
        fields.insert("$schema".into(), json!({ "description": ADDRESS, "type": "string" }));
    }
    let mut schema = schema.into();
    ordered(&mut schema);
    schema
}

/// Puts unit and range of a number behind the description of its field, and the unit of a list's numbers beside the list.
fn ordered(schema: &mut Value) {
    match schema {
        Value::Array(items) => items.iter_mut().for_each(ordered),
        Value::Object(keywords) => {
            keywords.values_mut().for_each(ordered);
            let unit_of = |item: &mut Value| item.as_object_mut().and_then(|item| item.shift_remove("x-unit"));
            let mut unit = keywords.get_mut("items").and_then(unit_of);
            for item in keywords.get_mut("prefixItems").and_then(Value::as_array_mut).into_iter().flatten() {
                unit = unit_of(item).or(unit);
            }
            keywords.extend(unit.map(|unit| ("x-unit".to_owned(), unit)));
            if keywords.get("type").is_some_and(|of| of == "number" || of.is_array()) {
                for name in ["x-unit", "minimum", "maximum"] {
                    let keyword = keywords.shift_remove(name);
                    keywords.extend(keyword.map(|keyword| (name.to_owned(), keyword)));
                }
            }
        }
        _ => {}
    }
}
