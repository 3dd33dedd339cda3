//! The tables of docs/formats.md: of fields, made from the schemas, and of the usual tolerances.

use std::fmt::Write as _;

use fogcoil::input;
use serde_json::Value;

/// Between these lines, NAME being a schema's, or [`TOLERANCES`], the page holds what is made here.
const BEGIN: &str = "<!-- fields of ";
const TOLERANCES: &str = "tolerances";
const END: &str = "<!-- fields end -->";

/// `page` with every table made anew from `schemas`, by name.
pub(super) fn renewed(page: &str, schemas: &[(&str, Value)]) -> String {
    let (mut text, mut inside) = (String::new(), false);
    for line in page.lines() {
        inside &= line != END;
        if !inside {
            text.extend([line, "\n"]);
        }
        let name = line.strip_prefix(BEGIN).and_then(|rest| rest.split_once(':')).map(|(name, _)| name);
        if let Some((_, schema)) = schemas.iter().find(|(of, _)| Some(*of) == name) {
            inside = true;
            let _ = write!(text, "\n{}\n", tables(schema)); // a String takes anything
        } else if name == Some(TOLERANCES) {
            inside = true;
            let _ = write!(text, "\n{}\n", usual());
        }
    }
    text
}

fn tables(schema: &Value) -> String {
    let mut text = group(schema["title"].as_str().unwrap_or_default(), schema);
    for (name, of) in schema["$defs"].as_object().into_iter().flatten() {
        text += &group(name, of);
    }
    text
}

/// The usual tolerances, by the keys.
fn usual() -> String {
    let mut text = "| key | usual tolerance, one standard deviation |\n|---|---|\n".to_owned();
    for (key, tolerance) in input::usual_tolerances() {
        let _ = writeln!(text, "| `{key}` | {tolerance} |");
    }
    text
}

fn group(name: &str, schema: &Value) -> String {
    let about = schema["description"].as_str().unwrap_or_default();
    let mut text = format!("**{}.** {about}\n\n", words(name));
    if let Some(fields) = schema["properties"].as_object() {
        text += "| field | what | kind | unit | accepted | if left out |\n|---|---|---|---|---|---|\n";
        let required = |name: &str| schema["required"].as_array().is_some_and(|all| all.iter().any(|one| one == name));
        // the page says of all files in JSON that they may have the address of their schema
        for (name, of) in fields.iter().filter(|(name, _)| *name != "$schema") {
            let what = of["description"].as_str().unwrap_or_default().replace('|', "\\|");
            let unit = of["x-unit"].as_str().unwrap_or_default();
            let absent = match (required(name), of.get("default")) {
                (true, _) => "required".into(),
                (false, None | Some(Value::Null)) => "–".into(),
                (false, Some(Value::Object(_))) => "its own defaults".into(),
                (false, Some(default)) => format!("`{default}`"),
            };
            let _ = writeln!(text, "| `{name}` | {what} | {} | {unit} | {} | {absent} |", kind(of), range(of));
        }
    }
    let choices: Vec<String> =
        schema["oneOf"].as_array().or(schema["enum"].as_array()).into_iter().flatten().map(choice).collect();
    if !choices.is_empty() {
        let _ = writeln!(text, "One of {}.", choices.join(", "));
    }
    text + "\n"
}

/// `SpoolFile` as "Spool", a type's name as words.
fn words(name: &str) -> String {
    let mut text = String::new();
    for c in name.trim_end_matches("File").chars() {
        if c.is_uppercase() && !text.is_empty() {
            text.push(' ');
            text.extend(c.to_lowercase());
        } else {
            text.push(c);
        }
    }
    text
}

fn choice(of: &Value) -> String {
    let constant = of.as_str().or(of["const"].as_str());
    match (constant, of["properties"].as_object().and_then(|inside| inside.iter().next())) {
        (Some(name), _) => format!("`{name}`"),
        (_, Some((name, inside))) => format!("`{name}(…)` of {}", kind(inside)),
        _ => of["enum"].as_array().map_or_else(String::new, |all| all.iter().map(choice).collect::<Vec<_>>().join(", ")),
    }
}

fn kind(of: &Value) -> String {
    if let Some(name) = of["$ref"].as_str() {
        return words(name.rsplit('/').next().unwrap_or_default()).to_lowercase();
    }
    if let Some(any) = of["anyOf"].as_array() {
        let one = |one: &Value| if one["type"] == "null" { "`None`".into() } else { format!("`Some` {}", kind(one)) };
        return any.iter().map(one).collect::<Vec<_>>().join(" or ");
    }
    let list = |items: &[Value]| items.iter().map(kind).collect::<Vec<_>>().join(", ");
    match (&of["type"], of["prefixItems"].as_array()) {
        (_, Some(items)) => format!("({})", list(items)),
        (Value::String(name), _) if name == "array" => format!("list of {}", kind(&of["items"])),
        (Value::String(name), _) => match name.as_str() {
            "string" => "text".into(),
            "boolean" => "`true` or `false`".into(),
            "integer" => "whole number".into(),
            other => other.into(),
        },
        (Value::Array(kinds), _) => {
            let some: Vec<&str> = kinds.iter().filter_map(Value::as_str).filter(|kind| *kind != "null").collect();
            format!("`None` or `Some` {}", some.join(" or "))
        }
        _ => "–".into(),
    }
}

fn range(of: &Value) -> String {
    let items = || of["prefixItems"].as_array().and_then(|items| items.first()).or(of.get("items"));
    if let (Some(below), Some(above)) = (of["exclusiveMinimum"].as_f64(), of["exclusiveMaximum"].as_f64()) {
        return format!("between {below:?} and {above:?}");
    }
    match (of["minimum"].as_f64(), of["maximum"].as_f64()) {
        (Some(least), Some(most)) if of["type"] == "integer" => format!("{least} to {most}"),
        (Some(least), Some(most)) => format!("{least:?} to {most:?}"),
        (Some(least), None) if of["type"] != "integer" => format!("from {least:?}"),
        _ => items().map_or_else(String::new, range),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_table_is_made_between_its_marks() {
        let schema = json!({ "title": "CoilFile", "description": "A coil.", "required": ["a"], "properties": {
            "a": { "description": "Height.", "type": "number", "x-unit": "mm", "minimum": 0.0, "maximum": 2.0 },
            "b": { "$ref": "#/$defs/SideFile", "default": "Left" },
            "c": { "description": "Ratio.", "type": "number", "exclusiveMinimum": -1.0, "exclusiveMaximum": 0.5 },
            "d": { "description": "Layers.", "type": "integer", "minimum": 1, "maximum": 100 },
            "$schema": { "description": "Address.", "type": "string" } },
            "$defs": { "SideFile": { "enum": ["Left", "Right"], "description": "A side." } } });
        let page = "before\n<!-- fields of x: made by `y` -->\nold\n<!-- fields end -->\nafter\n";
        let text = renewed(page, &[("x", schema.clone())]);
        assert!(text.contains("| `a` | Height. | number | mm | 0.0 to 2.0 | required |\n"), "{text}");
        assert!(text.contains("| `c` | Ratio. | number |  | between -1.0 and 0.5 | – |\n"), "{text}");
        assert!(text.contains("| `d` | Layers. | whole number |  | 1 to 100 | – |\n") && !text.contains("$schema"), "{text}");
        assert!(
            text.contains("| `b` |  | side |  |  | `\"Left\"` |\n")
                && text.contains("**Side.** A side.\n\nOne of `Left`, `Right`."),
            "{text}"
        );
        assert!(
            text.starts_with("before\n") && text.ends_with("<!-- fields end -->\nafter\n") && !text.contains("old"),
            "{text}"
        );
        assert_eq!(renewed(&text, &[("x", schema)]), text);
        let page = "<!-- fields of tolerances: made by `y` -->\n<!-- fields end -->\n";
        let text = renewed(page, &[]);
        for row in ["| `coil.material.nu_r` | 0.3 % |", "| `winding.start_mm` | 0.035 mm |", "| `winding.tails_m` | 0.02 m |"] {
            assert!(text.contains(row), "{text}");
        }
        assert_eq!(renewed(&text, &[]), text);
    }
}
