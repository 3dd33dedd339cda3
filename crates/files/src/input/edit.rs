//! One value in a case file's text: read, or replaced where it stands; comments and everything else stay as they are.

use std::ops::Range;
use std::path::Path;

use super::InputError;
use super::fields::FieldMap;
use super::scanner::{Scanner, Token};
use super::source::Source;

/// The text of a field's value, e.g. `4.0` for `spool.hub_thickness_mm`; `Some(...)` and the names of enums belong to it, but are no
/// part of a path.
///
/// # Errors
/// A field that is not there; messages call the text `path`.
pub fn field_text<'t>(path: &Path, text: &'t str, field: &str) -> Result<&'t str, InputError> {
    let map = FieldMap::new(text);
    match map.find(field) {
        (Some(found), "") if map.path(Some(found)) == field => Ok(&text[value(&map, text, found)]),
        (found, _) => Err(absent(path, text, field, &map.path(found))),
    }
}

/// A case file's text with other values, each RON, in some of its fields; a field that may be left out, and is, is added to its group.
///
/// The text is not checked here: [`check_coil`](super::check_coil) and [`check_any_cell`](super::check_any_cell) do.
///
/// # Errors
/// A field that has no place in the text; messages call the text `path`.
pub fn with_fields(path: &Path, text: &str, values: &[(String, String)]) -> Result<String, InputError> {
    values.iter().try_fold(text.to_owned(), |text, (field, value)| with_field(path, text, field, value))
}

fn with_field(path: &Path, mut text: String, field: &str, new: &str) -> Result<String, InputError> {
    let map = FieldMap::new(&text);
    let (found, rest) = map.find(field);
    let here = map.path(found);
    if let Some(found) = found.filter(|_| rest.is_empty() && here == field) {
        let range = value(&map, &text, found);
        text.replace_range(range, new);
        return Ok(text);
    }
    let is_key = !rest.is_empty() && rest.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    let inside = map.first_inside(found).filter(|first| !map.is_element(*first));
    match inside.map(|first| map.span(first).start) {
        Some(start) if is_key => {
            text.insert_str(start, &format!("{rest}: {new}, "));
            Ok(text)
        }
        _ => Err(absent(path, &text, field, &here)),
    }
}

/// Place of a field's value, without blanks and comments around it.
fn value(map: &FieldMap, text: &str, field: usize) -> Range<usize> {
    let Range { start, end: behind } = map.span(field);
    let mut tokens = Scanner::new(&text[start..behind]);
    let mut first = None;
    let mut keyed = map.is_element(field);
    let mut end = 0;
    while let Some((at, token)) = tokens.next() {
        if keyed {
            first.get_or_insert(at);
        }
        keyed |= token == Token::Colon;
        end = tokens.position();
    }
    start + first.unwrap_or(end)..start + end
}

fn absent(path: &Path, text: &str, field: &str, nearest: &str) -> InputError {
    let problem = format!("{field:?} is no field here");
    let remedy = match nearest {
        "" => "write the path of one of its keys with its unit, e.g. spool.hub_thickness_mm of a coil or rings[1].outer_diameter_um of a cell; a coil takes \
               what a cell's keys say by FromCell of another cell, in a plan under the key \"coil.material and dehomogenization\""
            .to_owned(),
        _ => format!("there is {nearest}; write keys with their units, and replace a value that has no fields as a whole"),
    };
    let fault = Source::of(path, text.to_owned()).fault(nearest, problem, remedy);
    InputError { field: fault.field.filter(|field| !field.is_empty()), ..fault }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// spool: 1\n(\n  name: \"a, (\",\n  spool: Some((hub_mm: 4.0 /* Al */, // wall\n    flanges: [(side: Right), (side: Left) ],\n  )),\n  \
                        none: None, material: FromCell(\"c.ron\"), x: -1e-3\n)\n";

    fn get(field: &str) -> Result<&'static str, String> {
        field_text("c.ron".as_ref(), TEXT, field).map_err(|error| error.to_string())
    }

    fn set(field: &str, value: &str) -> Result<String, String> {
        with_fields("c.ron".as_ref(), TEXT, &[(field.into(), value.into())]).map_err(|error| error.to_string())
    }

    #[test]
    fn a_value_is_read_without_what_is_around_it() {
        let cases = [
            ("name", "\"a, (\""),
            ("spool.hub_mm", "4.0"),
            ("spool.flanges[1]", "(side: Left)"),
            ("spool.flanges[0].side", "Right"),
            ("material", "FromCell(\"c.ron\")"),
            ("x", "-1e-3"),
        ];
        for (field, value) in cases {
            assert_eq!(get(field), Ok(value), "{field}");
            let same = set(field, value);
            assert_eq!(same.as_deref(), Ok(TEXT), "{field}");
        }
    }

    #[test]
    fn a_value_is_replaced_or_a_field_added_and_nothing_else_changes() {
        assert_eq!(set("spool.hub_mm", "5.5"), Ok(TEXT.replace("4.0 /*", "5.5 /*")));
        assert_eq!(set("spool.flanges[1].side", "Right"), Ok(TEXT.replace("Left", "Right")));
        assert_eq!(set("none", "Some(1)"), Ok(TEXT.replace("None", "Some(1)")));
        assert_eq!(set("heat", "(film: None)"), Ok(TEXT.replace("name:", "heat: (film: None), name:")));
        assert_eq!(set("spool.bonded", "true"), Ok(TEXT.replace("hub_mm", "bonded: true, hub_mm")));
    }

    #[test]
    fn what_has_no_place_is_refused_with_the_nearest_field() {
        for (field, said) in [
            ("spool.hub", "c.ron:4: spool.hub_mm: \"spool.hub\" is no field here; there is spool.hub_mm"),
            ("spool.flanges[2]", "c.ron:5: spool.flanges: "),
            ("none.x", "c.ron:7: none: "),
            ("", "is no field here"),
            ("a b", "is no field here"),
        ] {
            let error = get(field).unwrap_err();
            assert!(error.contains(said), "{error}");
            assert_eq!(set(field, "1").unwrap_err(), error);
        }
    }
}
