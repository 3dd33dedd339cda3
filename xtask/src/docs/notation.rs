//! RON as JSON, as the schemas of docs/schema speak of it.

use serde_json::{Map, Value};

/// The RON file `text` as JSON; else the line and the problem.
pub(super) fn json(text: &str) -> Result<Value, (usize, String)> {
    let mut parser = Parser { rest: text };
    let value = parser.value().and_then(|value| match parser.next() {
        None => Ok(value),
        Some(c) => Err(format!("`{c}` follows the end")),
    });
    value.map_err(|problem| (1 + text[..text.len() - parser.rest.len()].matches('\n').count(), problem))
}

struct Parser<'a> {
    rest: &'a str,
}

impl Parser<'_> {
    /// The next character, blanks and comments left out.
    fn next(&mut self) -> Option<char> {
        loop {
            self.rest = self.rest.trim_start();
            let end = match self.rest.get(..2) {
                Some("//") => self.rest.find('\n').unwrap_or(self.rest.len()),
                Some("/*") => self.rest.find("*/").map_or(self.rest.len(), |end| end + 2),
                _ => return self.rest.chars().next(),
            };
            self.rest = &self.rest[end..];
        }
    }

    fn take(&mut self, wanted: char) -> bool {
        let found = self.next() == Some(wanted);
        if found {
            self.rest = &self.rest[wanted.len_utf8()..];
        }
        found
    }

    fn word(&mut self) -> String {
        self.next();
        let end =
            self.rest.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '.' | '+' | '-'))).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest;
        word.to_owned()
    }

    fn value(&mut self) -> Result<Value, String> {
        match self.next() {
            Some('(') => self.group(),
            Some('[') => self.list('[', ']').map(Value::Array),
            Some('{') => self.object('{', '}', |parser| {
                parser.next();
                parser.text()
            }),
            Some('"') => self.text().map(Value::String),
            Some(c) if c.is_alphabetic() => self.name(),
            Some(_) => {
                let word = self.word();
                let number = word.parse::<i64>().map(Value::from).or_else(|_| word.parse::<f64>().map(Value::from));
                number.map_err(|_| format!("`{word}` is no value"))
            }
            None => Err("a value is missing at the end".into()),
        }
    }

    fn name(&mut self) -> Result<Value, String> {
        let name = self.word();
        if self.next() != Some('(') {
            return Ok(match name.as_str() {
                "true" => true.into(),
                "false" => false.into(),
                "None" => Value::Null,
                _ => name.into(),
            });
        }
        let inside = match self.group()? {
            Value::Array(mut one) if one.len() == 1 => one.remove(0),
            inside => inside,
        };
        Ok(if name == "Some" { inside } else { Value::Object(Map::from_iter([(name, inside)])) })
    }

    /// Content of parentheses: keys with values, or values.
    fn group(&mut self) -> Result<Value, String> {
        let start = self.rest;
        self.take('(');
        let key = self.word();
        let keyed = !key.is_empty() && self.take(':');
        self.rest = start;
        if !keyed {
            return self.list('(', ')').map(Value::Array);
        }
        self.object('(', ')', |parser| Ok(parser.word()))
    }

    /// Values by keys.
    fn object(&mut self, open: char, close: char, key: fn(&mut Self) -> Result<String, String>) -> Result<Value, String> {
        self.take(open);
        let mut object = Map::new();
        while !self.take(close) {
            let key = key(self)?;
            if !self.take(':') {
                return Err(format!("`{key}` wants a colon and a value"));
            }
            object.insert(key, self.value()?);
            if !self.take(',') && self.next() != Some(close) {
                return Err(format!("a comma or `{close}` is missing"));
            }
        }
        Ok(Value::Object(object))
    }

    fn list(&mut self, open: char, close: char) -> Result<Vec<Value>, String> {
        self.take(open);
        let mut values = Vec::new();
        while !self.take(close) {
            values.push(self.value()?);
            if !self.take(',') && self.next() != Some(close) {
                return Err(format!("a comma or `{close}` is missing"));
            }
        }
        Ok(values)
    }

    fn text(&mut self) -> Result<String, String> {
        self.take('"');
        let end = self.rest.find('"').ok_or("a text is not closed")?;
        let text = self.rest[..end].to_owned();
        self.rest = &self.rest[end + 1..];
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::json;

    #[test]
    fn ron_becomes_the_json_that_schemas_speak_of() {
        let ron = "// a file\n(a: 1, b: -2.5e-3, c: [(1, 2.0)], /* x */ d: Some((e: True)), f: None, g: Matrix((h: \"i\",)), j: Measured(1.5, 2))\n";
        let value = serde_json::json!({ "a": 1, "b": -2.5e-3, "c": [[1, 2.0]], "d": { "e": "True" }, "f": null,
            "g": { "Matrix": { "h": "i" } }, "j": { "Measured": [1.5, 2] } });
        assert_eq!(json(ron), Ok(value));
        for (bad, line) in [("(a: 1\n b: 2)", 2), ("(a: 1", 1), ("\n(a: $)", 2), ("(a: 1))", 1), ("[1, 2", 1), ("(a: 1, b)", 1)] {
            assert_eq!(json(bad).map_err(|(line, _)| line), Err(line), "{bad}");
        }
    }
}
