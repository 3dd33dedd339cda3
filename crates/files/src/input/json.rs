//! A case file in JSON as its RON, line for line, so that all else is the same for both: faults with their lines, and edits of fields.
//!
//! In JSON a choice and a text are both strings; the schema of the file tells them apart.

use std::sync::LazyLock;

use serde_json::Value;

use super::map_file::in_quotes;
use super::schema::schemas;

static SCHEMAS: LazyLock<[(&str, Value); 6]> = LazyLock::new(schemas);

/// The RON of a JSON text, by the schema that knows most of its keys.
///
/// # Errors
/// Line and problem of a text that is not JSON.
pub(super) fn ron(text: &str) -> Result<String, (usize, String)> {
    let value: Value = serde_json::from_str(text).map_err(|error| {
        let message = error.to_string();
        let said = message.split(" at line ").next().unwrap_or_default();
        // what a line lacks at its end is found at the begin of the next
        let (line, place) = match (error.line(), error.column()) {
            (line @ 2.., 0) => (line - 1, "at its end".to_owned()),
            (line, column) => (line, format!("at column {column}")),
        };
        (line, format!("is not JSON: {said}, {place}"))
    })?;
    let known = |schema: &Value| {
        value.as_object().map_or(0, |keys| keys.keys().filter(|key| !schema["properties"][key].is_null()).count())
    };
    let root = SCHEMAS.iter().map(|(_, schema)| schema).max_by_key(|schema| known(schema)).unwrap_or(&Value::Null);
    let mut translation = Translation { text, at: 0, root, out: String::with_capacity(text.len()) };
    translation.value(root);
    Ok(translation.out + &text[translation.at..])
}

/// A JSON text, valid, on its way to RON.
struct Translation<'a> {
    text: &'a str,
    at: usize,
    root: &'a Value,
    out: String,
}

impl<'a> Translation<'a> {
    /// The next byte behind blanks, which are copied; 0 at the end.
    fn next(&mut self) -> u8 {
        let rest = &self.text[self.at..];
        let blanks = rest.len() - rest.trim_start().len();
        self.out.push_str(&rest[..blanks]);
        self.at += blanks;
        self.text.as_bytes().get(self.at).copied().unwrap_or(0)
    }

    /// A string, number or word.
    fn token(&mut self) -> &'a str {
        let rest = &self.text[self.at..];
        let mut escaped = false;
        let closes = |(_, c): &(usize, char)| {
            let closes = *c == '"' && !escaped;
            escaped = *c == '\\' && !escaped;
            closes
        };
        let length = if rest.starts_with('"') {
            rest.char_indices().skip(1).find(closes).map_or(rest.len(), |(at, _)| at + 1)
        } else {
            rest.find(|c: char| c.is_whitespace() || ",:]}".contains(c)).unwrap_or(rest.len())
        };
        self.at += length;
        &rest[..length]
    }

    /// The schema that a reference names.
    fn resolved(&self, schema: &'a Value) -> &'a Value {
        let of = schema["$ref"].as_str().and_then(|of| self.root.pointer(of.trim_start_matches('#')));
        of.map_or(schema, |of| self.resolved(of))
    }

    fn value(&mut self, schema: &'a Value) {
        let mut schema = self.resolved(schema);
        let first = self.next();
        let inner = schema["anyOf"].as_array().and_then(|any| any.iter().find(|one| one["type"] != "null"));
        let is_option = inner.is_some() || schema["type"].as_array().is_some_and(|types| types.iter().any(|one| one == "null"));
        schema = inner.map_or(schema, |inner| self.resolved(inner));
        let wraps = is_option && !self.text[self.at..].starts_with("null");
        self.out.push_str(if wraps { "Some(" } else { "" });
        match first {
            b'{' if schema["oneOf"].is_array() => self.choice(schema),
            b'{' => self.object(schema),
            b'[' => self.array(schema, if schema["prefixItems"].is_array() { ["(", ")"] } else { ["[", "]"] }),
            b'"' => {
                let text = self.string();
                let is_choice = schema["oneOf"].is_array() || schema["enum"].is_array();
                self.out += &if is_choice && is_name(&text) { text } else { in_quotes(&text) };
            }
            _ => {
                let word = self.token();
                self.out += &match word {
                    "null" => "None".to_owned(),
                    _ if schema["type"] == "integer" => whole(word).unwrap_or_else(|| word.to_owned()),
                    _ => word.to_owned(),
                };
            }
        }
        self.out.push_str(if wraps { ")" } else { "" });
    }

    fn string(&mut self) -> String {
        let token = self.token();
        serde_json::from_str(token).unwrap_or_else(|_| token.to_owned())
    }

    /// `{"Name": x}` as `Name(x)`; a choice with fields or with several values has no brackets of its own.
    fn choice(&mut self, schema: &'a Value) {
        self.list(["", ""], |this, n| {
            let name = this.key(false);
            let all = schema["oneOf"].as_array().into_iter().flatten();
            let of = all.map(|one| &one["properties"][&name]).find(|one| !one.is_null()).unwrap_or(&Value::Null);
            match this.next() {
                b'{' if of["properties"].is_object() => this.object(of),
                b'[' if of["prefixItems"].is_array() => this.array(of, ["(", ")"]),
                // no choice has a second key: the reader of RON says so
                _ if n > 0 => this.value(&Value::Null),
                _ => {
                    this.out.push('(');
                    this.value(of);
                    this.out.push(')');
                }
            }
        });
    }

    fn object(&mut self, schema: &'a Value) {
        let of_all = &schema["additionalProperties"];
        let is_map = of_all.is_object();
        let is_whole = self.out.trim_start().is_empty();
        self.list(if is_map { ["{", "}"] } else { ["(", ")"] }, |this, _| {
            if is_whole && this.skips_address() {
                return;
            }
            let key = this.key(is_map);
            this.out.push(':');
            this.value(if is_map { of_all } else { &schema["properties"][&key] });
        });
    }

    /// Leaves `"$schema": "..."` out, which is there for editors, with the comma behind it; false if the next key is another, or no text is its value.
    fn skips_address(&mut self) -> bool {
        let (at, length) = (self.at, self.out.len());
        let skips = self.string() == "$schema" && {
            self.next();
            self.at += 1;
            self.next() == b'"'
        };
        if !skips {
            self.at = at;
            self.out.truncate(length);
            return false;
        }
        self.token();
        if self.next() == b',' {
            self.at += 1;
        }
        true
    }

    /// A key, in quotes if it `is_text` or cannot be a name, with the colon behind it left out.
    fn key(&mut self, is_text: bool) -> String {
        let key = self.string();
        self.out += &if is_text || !is_name(&key) { in_quotes(&key) } else { key.clone() };
        self.next();
        self.at += 1;
        key
    }

    fn array(&mut self, schema: &'a Value, brackets: [&str; 2]) {
        self.list(brackets, |this, n| {
            let own = &schema["prefixItems"][n];
            this.value(if own.is_null() { &schema["items"] } else { own });
        });
    }

    fn list(&mut self, [open, close]: [&str; 2], mut entry: impl FnMut(&mut Self, usize)) {
        self.at += 1;
        self.out.push_str(open);
        for n in 0.. {
            if matches!(self.next(), b']' | b'}' | 0) {
                break;
            }
            entry(self, n);
            if self.next() == b',' {
                self.at += 1;
                self.out.push(',');
            }
        }
        self.at += 1;
        self.out.push_str(close);
    }
}

/// A whole number that is written with a point or an exponent, as RON has it.
fn whole(word: &str) -> Option<String> {
    let number: f64 = word.parse().ok().filter(|number: &f64| number.fract() == 0.0 && number.abs() < EXACT)?;
    word.contains(['.', 'e', 'E']).then(|| format!("{number}"))
}

/// Whole numbers below are numbers of their own.
const EXACT: f64 = 9e15;

fn is_name(text: &str) -> bool {
    let is_word = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    text.bytes().all(is_word) && text.bytes().next().is_some_and(|first| !first.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use serde::Serialize;
    use serde::de::DeserializeOwned;

    use super::*;
    use crate::input::coil_file::CoilFile;
    use crate::input::mechanism_file::MechanismFile;
    use crate::input::targets_file::TargetsFile;

    fn comes_back<T: DeserializeOwned + Serialize>(text: &str) {
        let json = serde_json::to_string_pretty(&::ron::from_str::<T>(text).unwrap()).unwrap();
        let ron = ron(&json).unwrap();
        let back = serde_json::to_string_pretty(&::ron::from_str::<T>(&ron).unwrap_or_else(|e| panic!("{e}: {ron}"))).unwrap();
        assert_eq!(back, json);
        assert_eq!(ron.lines().count(), json.lines().count());
    }

    #[test]
    fn files_say_the_same_in_json() {
        comes_back::<CoilFile>(include_str!("../../../../fixtures/coil-reference.ron"));
        comes_back::<TargetsFile>(include_str!("../../../../fixtures/identify/table-one.ron"));
        comes_back::<MechanismFile>(MECHANISM);
    }

    const MECHANISM: &str = r#"(
        id: "own", title: "A \"title\" µ", stage: Optics,
        parameters: [(name: "a", unit: "deg/h", prior: LogNormal(1.0, 0.5), value: Some(2.0)), (name: "b", unit: "1", prior: Size(3.0))],
        states: [(name: "x", unit: "K", goes: Play(of: "spool_c", width: "b")), (name: "y", unit: "K", goes: Highest("spool_c"))],
        laws: [Rate("a * x")],
    )"#;

    #[test]
    fn what_is_not_json_is_refused_with_its_line() {
        let fault = |text: &str| ron(text).unwrap_err();
        assert_eq!(fault("{\n \"name\": \"a\"\n \"b\": 1\n}"), (3, "is not JSON: expected `,` or `}`, at column 2".into()));
        assert_eq!(fault("(name: \"a\")").0, 1);
        assert_eq!(fault("{\n \"a\": tru\n}"), (2, "is not JSON: expected ident, at its end".into()));
        assert_eq!(fault(&"[".repeat(100_000)).0, 1);
    }

    #[test]
    fn texts_and_unknown_keys_stay_what_they_are() {
        let cases = [
            (
                r#"{"name": "Left", "adhesive": null, "rings": [{"role": "Glass"}]}"#,
                r#"(name: "Left", adhesive: None, rings: [(role: "Glass")])"#,
            ),
            (r#"{"winding": {"cw_climbs": "Left"}, "x y": {}}"#, r#"(winding: (cw_climbs: Left), "x y": ())"#),
            (
                r#"{"winding": {"cw_climbs": "Nowhere", "defect": {"layer": 3}}}"#,
                r#"(winding: (cw_climbs: Nowhere, defect: Some((layer: 3))))"#,
            ),
            (
                r#"{"winding": {}, "tolerances": {"a.b": {"Relative": 0.1, "é": 2}}}"#,
                r#"(winding: (), tolerances: {"a.b": Relative (0.1), "é" 2})"#,
            ),
            (
                r#"{"winding": 1, "mechanics": {"Relaxing": {"fraction": 0.2}}, "spool": {}}"#,
                r#"(winding: 1, mechanics: Relaxing ((fraction: 0.2)), spool: Some(()))"#,
            ),
            // the address of the schema is for editors
            ("{\"$schema\": \"a\",\n \"winding\": {\"layers\": 36.0}}", "( \n winding: (layers: 36))"),
            (r#"{"winding": {"layers": 3.6e1, "pitch_mm": 1.0}, "$schema": "a"}"#, "(winding: (layers: 36, pitch_mm: 1.0),  )"),
            (
                r#"{"winding": {"layers": 36.5, "$schema": "a"}, "$schema": 1}"#,
                r#"(winding: (layers: 36.5, "$schema": "a"), "$schema": 1)"#,
            ),
            ("[]", "[]"),
            ("\"a\\nb\"", "\"a\\nb\""),
        ];
        for (json, expected) in cases {
            assert_eq!(ron(json).unwrap(), expected, "{json}");
        }
    }
}
