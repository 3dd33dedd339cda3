//! `RECORD.map.ron`: how a logger's file is read.

use std::fmt::Write;

use ron::ser::to_string;
use schemars::JsonSchema;
use serde::Deserialize;

use super::record_options::{Key, RecordOptions};

/// How a logger's file is read, `RECORD.map.ron`; what is left out is standard.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct MapFile {
    /// How its text is encoded: utf-8, utf-16le, utf-16be or windows-1252; empty: utf-8.
    pub(super) encoding: String,
    /// Lines above the names of the columns that are not read; those that begin with # need not be counted.
    pub(super) preamble_lines: u32,
    /// Between the fields: a character, or `tab`; empty: a comma.
    pub(super) separator: String,
    /// Whether numbers are written like 20,5.
    pub(super) decimal_comma: bool,
    /// Seconds between rows, for a file without instants; 0: it has them.
    pub(super) interval_s: f64,
    /// The instants: s, ms, us, ns, min, h; dates need no unit.
    pub(super) time: ColumnFile,
    /// The chamber's temperature: degC, K or degF.
    pub(super) chamber: ColumnFile,
    /// The spool's thermometer: degC, K or degF.
    pub(super) spool: ColumnFile,
    /// The rate: deg/h, deg/s, rad/s or mrad/s.
    pub(super) rate: ColumnFile,
}

/// A column of a logger's file.
#[derive(Deserialize, JsonSchema, Default, Clone)]
#[serde(deny_unknown_fields, default)]
pub(super) struct ColumnFile {
    /// Its name in the file; empty: the standard one.
    pub(super) column: String,
    /// Its unit; empty: the standard one.
    pub(super) unit: String,
    /// Units in a count; 0: it holds no counts.
    pub(super) scale: f64,
}

impl MapFile {
    pub(super) fn column(&self, key: Key) -> &ColumnFile {
        match key {
            Key::Time => &self.time,
            Key::Chamber => &self.chamber,
            Key::Spool => &self.spool,
            Key::Rate => &self.rate,
        }
    }

    pub(super) fn column_mut(&mut self, key: Key) -> &mut ColumnFile {
        match key {
            Key::Time => &mut self.time,
            Key::Chamber => &mut self.chamber,
            Key::Spool => &mut self.spool,
            Key::Rate => &mut self.rate,
        }
    }

    /// Puts in what the user says, which wins.
    pub(super) fn declare(&mut self, options: &RecordOptions) {
        if let Some(separator) = &options.separator {
            self.separator.clone_from(separator);
        }
        self.decimal_comma |= options.decimal_comma;
        self.interval_s = options.interval.unwrap_or(self.interval_s);
        for (key, name) in &options.columns {
            self.column_mut(*key).column.clone_from(name);
        }
        for (key, unit) in &options.units {
            self.column_mut(*key).unit.clone_from(unit);
        }
        for (key, scale) in &options.scales {
            self.column_mut(*key).scale = *scale;
        }
    }

    /// The file's content; `doubts` are said beside the columns that they are about.
    pub(super) fn text(&self, heading: &str, doubts: &[(Key, String)]) -> String {
        // text and numbers have nothing that RON cannot say
        let quoted = |text: &str| to_string(text).unwrap_or_default();
        let mut out = heading.lines().fold(String::new(), |out, line| out + "// " + line + "\n") + "(\n";
        let mut line = |key: &str, value: String| out += &format!("    {key}: {value},\n");
        if !self.encoding.is_empty() {
            line("encoding", quoted(&self.encoding));
        }
        if self.preamble_lines > 0 {
            line("preamble_lines", self.preamble_lines.to_string());
        }
        if !self.separator.is_empty() {
            line("separator", quoted(&self.separator));
        }
        if self.decimal_comma {
            line("decimal_comma", "true".into());
        }
        if self.interval_s > 0.0 {
            line("interval_s", format!("{:?}", self.interval_s));
        }
        for key in Key::ALL {
            let ColumnFile { column, unit, scale } = self.column(key);
            let texts = [("column", column), ("unit", unit)].into_iter().filter(|(_, text)| !text.is_empty());
            let mut parts: Vec<String> = texts.map(|(name, text)| format!("{name}: {}", quoted(text))).collect();
            if *scale != 0.0 {
                parts.push(format!("scale: {scale:?}"));
            }
            let of_key = doubts.iter().filter(|(about, _)| *about == key);
            let doubt: String = of_key.map(|(_, doubt)| format!(" // {}", doubt.replace(char::is_control, " "))).collect();
            if !parts.is_empty() || !doubt.is_empty() {
                let _ = writeln!(out, "    {}: ({}),{doubt}", key.name(), parts.join(", "));
            }
        }
        out + ")\n"
    }
}
