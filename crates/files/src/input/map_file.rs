//! `RECORD.map.ron`: the form of a logger's file.

use std::fmt::Write;

use ron::ser::to_string;
use schemars::JsonSchema;
use serde::Deserialize;

use super::record_options::{Key, RecordOptions};

/// Form of a logger's file, `RECORD.map.ron`; a key that is left out is standard.
#[derive(Deserialize, JsonSchema, Default)]
#[serde(deny_unknown_fields, default)]
pub(super) struct MapFile {
    /// Encoding of its text: utf-8, utf-16le, utf-16be or windows-1252; empty: utf-8.
    pub(super) encoding: String,
    /// Lines above the names of the columns that are not read; those that begin with # need not be counted.
    pub(super) preamble_lines: u32,
    /// Lines below the names of the columns that are not read: their units.
    pub(super) lines_below_names: u32,
    /// Separator of the fields: a character, or `tab`; empty: a comma.
    pub(super) separator: String,
    /// Whether numbers are written like 20,5.
    pub(super) decimal_comma: bool,
    /// Seconds between rows, for a file without instants; 0: it has them.
    pub(super) interval_s: f64,
    /// The instants: s, ms, us, ns, min, h, d; dates need no unit.
    pub(super) time: ColumnFile,
    /// The column of the time of day, where that of the instants holds the date alone; empty: there is none.
    pub(super) time_of_day: String,
    /// The chamber's temperature: degC, K or degF.
    pub(super) chamber: ColumnFile,
    /// The spool's thermometer: degC, K or degF.
    pub(super) spool: ColumnFile,
    /// The rate: deg/h, deg/s, mdeg/s, rad/s, mrad/s and others.
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

    /// Puts in the user's options, which win.
    pub(super) fn declare(&mut self, options: &RecordOptions) {
        if let Some(separator) = &options.separator {
            self.separator.clone_from(separator);
        }
        self.decimal_comma |= options.decimal_comma;
        self.interval_s = options.interval.unwrap_or(self.interval_s);
        if let Some(name) = &options.time_of_day {
            self.time_of_day.clone_from(name);
        }
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

    /// The file's content; `doubts` are said beside the columns that they are about, `asides` below them.
    pub(super) fn text(&self, heading: &str, doubts: &[(Key, String)], asides: &[String]) -> String {
        let mut out = heading.lines().fold(String::new(), |out, line| out + "// " + line + "\n") + "(\n";
        for (key, value) in self.dialect() {
            let _ = writeln!(out, "    {key}: {value},");
        }
        for key in Key::ALL {
            let ColumnFile { column, unit, scale } = self.column(key);
            let texts = [("column", column), ("unit", unit)].into_iter().filter(|(_, text)| !text.is_empty());
            let mut parts: Vec<String> = texts.map(|(name, text)| format!("{name}: {}", in_quotes(text))).collect();
            if *scale != 0.0 {
                parts.push(format!("scale: {scale:?}"));
            }
            let of_key = doubts.iter().filter(|(about, _)| *about == key);
            let doubt: String = of_key.map(|(_, doubt)| format!(" // {}", doubt.replace(char::is_control, " "))).collect();
            if !parts.is_empty() || !doubt.is_empty() {
                let _ = writeln!(out, "    {}: ({}),{doubt}", key.name(), parts.join(", "));
            }
            if key == Key::Time && !self.time_of_day.is_empty() {
                let _ = writeln!(out, "    time_of_day: {},", in_quotes(&self.time_of_day));
            }
        }
        for aside in asides {
            let _ = writeln!(out, "    // {}", aside.replace(char::is_control, " "));
        }
        out + ")\n"
    }

    /// The fields that say how the table is written, but for those that are standard.
    fn dialect(&self) -> Vec<(&'static str, String)> {
        let fields = [
            ("encoding", in_quotes(&self.encoding), !self.encoding.is_empty()),
            ("preamble_lines", self.preamble_lines.to_string(), self.preamble_lines > 0),
            ("lines_below_names", self.lines_below_names.to_string(), self.lines_below_names > 0),
            ("separator", in_quotes(&self.separator), !self.separator.is_empty()),
            ("decimal_comma", "true".into(), self.decimal_comma),
            ("interval_s", format!("{:?}", self.interval_s), self.interval_s > 0.0),
        ];
        fields.into_iter().filter(|(.., said)| *said).map(|(key, value, _)| (key, value)).collect()
    }
}

/// A text as RON writes it.
pub(super) fn in_quotes(text: &str) -> String {
    // text has nothing that RON cannot say
    to_string(text).unwrap_or_default()
}
