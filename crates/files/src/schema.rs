//! Whether JSON keeps a schema, as those of `docs/schema`.

use serde_json::Value;

/// Keywords that say something of the reader, not of the value.
const NOTES: [&str; 9] = ["$schema", "$defs", "$comment", "title", "description", "default", "format", "x-unit", "examples"];

/// The first part of `value` that does not keep `schema`, with its place; `None` if all does. A property that an object's schema does not name
/// is a fault, too.
///
/// It knows the keywords that the project's schemas use; another one is a fault of the schema.
pub fn misfit(value: &Value, schema: &Value) -> Option<String> {
    keep(value, schema, schema, "$").err()
}

fn keep(value: &Value, schema: &Value, root: &Value, at: &str) -> Result<(), String> {
    let Some(keywords) = schema.as_object() else {
        return if schema == &Value::Bool(true) { Ok(()) } else { Err(format!("{at}: is not in the schema")) };
    };
    for (keyword, of) in keywords {
        keyword_kept(value, keyword, of, root, at)?;
    }
    if schema.get("properties").is_some() || schema.get("additionalProperties").is_some() {
        for (name, value) in value.as_object().into_iter().flatten() {
            let of = schema["properties"].get(name).or(schema.get("additionalProperties")).unwrap_or(&Value::Bool(false));
            keep(value, of, root, &format!("{at}.{name}"))?;
        }
    }
    let first = schema["prefixItems"].as_array().map_or(&[][..], |items| items);
    for (k, item) in value.as_array().into_iter().flatten().enumerate() {
        if let Some(of) = first.get(k).or(schema.get("items")) {
            keep(item, of, root, &format!("{at}[{k}]"))?;
        }
    }
    Ok(())
}

fn keyword_kept(value: &Value, keyword: &str, of: &Value, root: &Value, at: &str) -> Result<(), String> {
    let fault = |must: String| Err(format!("{at}: {value} {must}"));
    let number = |holds: fn(f64, f64) -> bool| value.as_f64().zip(of.as_f64()).is_none_or(|(a, b)| holds(a, b));
    let length = |holds: fn(u64, u64) -> bool| value.as_array().zip(of.as_u64()).is_none_or(|(a, n)| holds(a.len() as u64, n));
    let choices = || of.as_array().into_iter().flatten();
    match keyword {
        "$ref" => {
            let name = of.as_str().and_then(|name| name.strip_prefix('#')).unwrap_or_default();
            root.pointer(name).map_or_else(|| fault(format!("has no schema {of}")), |schema| keep(value, schema, root, at))
        }
        "type" if !(is(value, of) || choices().any(|kind| is(value, kind))) => fault(format!("is no {of}")),
        "enum" if !choices().any(|choice| choice == value) => fault(format!("is none of {of}")),
        "const" if of != value => fault(format!("is not {of}")),
        "minimum" if !number(|a, least| a >= least) => fault(format!("is less than {of}")),
        "maximum" if !number(|a, most| a <= most) => fault(format!("is more than {of}")),
        "exclusiveMinimum" if !number(|a, bound| a > bound) => fault(format!("is not more than {of}")),
        "exclusiveMaximum" if !number(|a, bound| a < bound) => fault(format!("is not less than {of}")),
        "minItems" if !length(|a, least| a >= least) => fault(format!("has fewer than {of} items")),
        "maxItems" if !length(|a, most| a <= most) => fault(format!("has more than {of} items")),
        "required" => match choices().filter_map(Value::as_str).find(|name| value.is_object() && value.get(name).is_none()) {
            Some(name) => Err(format!("{at}: lacks {name}")),
            None => Ok(()),
        },
        "anyOf" | "oneOf" => {
            let faults: Vec<String> = choices().filter_map(|schema| keep(value, schema, root, at).err()).collect();
            let kept = choices().count() - faults.len();
            if kept == 1 || kept > 1 && keyword == "anyOf" {
                Ok(())
            } else {
                Err(format!("{at}: {kept} of {keyword}: {}", faults.join("; ")))
            }
        }
        "type" | "enum" | "const" | "minimum" | "maximum" | "exclusiveMinimum" | "exclusiveMaximum" => Ok(()),
        "minItems" | "maxItems" => Ok(()),
        "properties" | "additionalProperties" | "items" | "prefixItems" => Ok(()),
        _ if NOTES.contains(&keyword) => Ok(()),
        _ => Err(format!("{at}: the schema's keyword {keyword} is not known")),
    }
}

fn is(value: &Value, kind: &Value) -> bool {
    match kind.as_str() {
        Some("object") => value.is_object(),
        Some("array") => value.is_array(),
        Some("string") => value.is_string(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_i64() || value.is_u64(),
        Some("boolean") => value.is_boolean(),
        Some("null") => value.is_null(),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::misfit;
    use serde_json::json;

    #[test]
    fn what_does_not_keep_a_schema_is_found_with_its_place() {
        let schema = json!({
            "type": "object", "required": ["a"], "$defs": { "sides": { "enum": ["left", "right"] } },
            "properties": {
                "a": { "type": "number", "minimum": 0, "maximum": 2 },
                "e": { "type": "number", "exclusiveMinimum": -1, "exclusiveMaximum": 0.5 },
                "b": { "type": "array", "items": { "$ref": "#/$defs/sides" }, "maxItems": 2 },
                "c": { "anyOf": [{ "type": "null" }, { "type": "integer" }] },
            },
        });
        assert_eq!(misfit(&json!({ "a": 1.5, "b": ["left"], "c": null }), &schema), None);
        for (value, says) in [
            (json!(1), "$: 1 is no"),
            (json!({}), "$: lacks a"),
            (json!({ "a": "1" }), "$.a: \"1\" is no"),
            (json!({ "a": -1 }), "$.a: -1 is less than 0"),
            (json!({ "a": 3 }), "$.a: 3 is more than 2"),
            (json!({ "a": 1, "e": -1 }), "$.e: -1 is not more than -1"),
            (json!({ "a": 1, "e": 0.5 }), "$.e: 0.5 is not less than 0.5"),
            (json!({ "a": 1, "b": ["left", "up"] }), "$.b[1]: \"up\" is none of"),
            (json!({ "a": 1, "b": ["left", "left", "left"] }), "more than 2 items"),
            (json!({ "a": 1, "c": 1.5 }), "$.c: 0 of anyOf"),
            (json!({ "a": 1, "d": 1 }), "$.d: is not in the schema"),
        ] {
            let misfit = misfit(&value, &schema).unwrap();
            assert!(misfit.contains(says), "{misfit}");
        }
        assert!(misfit(&json!(1), &json!({ "pattern": "x" })).unwrap().contains("not known"));
    }
}
