//! The library's mechanisms: their pages, as `docs/mechanisms` has them.

use std::fmt::Write;

use serde_json::{Value, json};

use super::page::{rows, section, title};
use crate::recommend::inspection;
use crate::table::table;

/// A mechanism.
#[derive(Debug)]
pub struct Mechanism {
    /// Its id.
    pub id: &'static str,
    /// Its page: Markdown with the sections Equation, Place in the chain, What it looks like, Source and, of a named one, Measured.
    pub page: &'static str,
}

macro_rules! mechanisms {
    ($($id:literal $file:literal)*) => {
        &[$(Mechanism { id: $id, page: include_str!(concat!("mechanisms/", $file, ".md")) },)*]
    };
}

/// All of them, in the order of the library; then those without a name, and what stands among them in tables.
pub const MECHANISMS: &[Mechanism] = mechanisms! {
    "tail-asymmetry" "tail-asymmetry"
    "winding-defect" "winding-defect"
    "adhesive-content" "adhesive-content"
    "glass-transition" "glass-transition"
    "viscoelastic-relaxation" "viscoelastic-relaxation"
    "debond" "debond"
    "interface-resistance" "interface-resistance"
    "air-path" "air-path"
    "axial-heat-path" "axial-heat-path"
    "self-heating" "self-heating"
    "sensor-lag" "sensor-lag"
    "thermo-optic-curvature" "thermo-optic-curvature"
    "rate-temperature-coefficient" "rate-temperature-coefficient"
    "unknown:polarisation-ripple" "unknown-polarisation-ripple"
    "unknown:moisture" "unknown-moisture"
    "unknown:ratcheting" "unknown-ratcheting"
    "unknown:spool-expansion" "unknown-spool-expansion"
    "unknown:racket" "unknown-racket"
    "unknown:magnetic" "unknown-magnetic"
    "recalibrate" "recalibrate"
    "nominal" "nominal"
};

/// How many have a name, how many have none, and how many stand among them in tables alone.
pub(super) fn counts() -> [usize; 3] {
    let [named, unnamed] = [|m: &Mechanism| m.stage().is_some(), |m: &Mechanism| m.id.starts_with("unknown:")]
        .map(|of| MECHANISMS.iter().filter(|m| of(m)).count());
    [named, unnamed, MECHANISMS.len() - named - unnamed]
}

/// Words before the pages' table of rivals.
const RIVALS: &str = "fitted in its place";

impl Mechanism {
    /// What it is called.
    pub fn title(&self) -> &'static str {
        title(self.page)
    }

    fn stage(&self) -> Option<&'static str> {
        let line = self.page.lines().find_map(|line| line.strip_prefix("Stage: "))?;
        Some(line.trim_end_matches('.'))
    }

    pub(super) fn text(&self) -> String {
        let mut out = format!("{}: {}\n", self.id, self.title());
        let mut say = |name: &str, text: &str| {
            if !text.is_empty() {
                let _ = write!(out, "\n{name}\n{}\n", indented(text));
            }
        };
        say("Equation", section(self.page, "Equation"));
        say("Place in the chain", section(self.page, "Place in the chain"));
        say("Parameters (prior and typical size as for the reference coil)", &table(&rows(self.page, "parameter")));
        say("What it looks like", section(self.page, "What it looks like"));
        say(
            "What it is confused with: expected ln odds for it over what is fitted in its place, by test; above 3.5 they are told apart",
            &table(&rows(self.page, RIVALS)),
        );
        if let Some(inspection) = inspection(self.id) {
            let chamber = "In the chamber: the best test above; `fogcoil recommend` finds it for your design.";
            say("How to test it", &format!("{chamber}\nOn the unit: {inspection}."));
        }
        say("Source", section(self.page, "Source"));
        out
    }

    pub(super) fn json(&self) -> Value {
        let objects = |first: &str| -> Vec<Value> {
            let rows = rows(self.page, first);
            let Some((header, rows)) = rows.split_first() else { return Vec::new() };
            rows.iter().map(|row| header.iter().cloned().zip(row.iter().cloned().map(Value::String)).collect()).collect()
        };
        json!({
            "id": self.id,
            "kind": "mechanism",
            "title": self.title(),
            "stage": self.stage(),
            "equation": section(self.page, "Equation"),
            "place": section(self.page, "Place in the chain"),
            "parameters": objects("parameter"),
            "signature": section(self.page, "What it looks like"),
            "confused_with": objects(RIVALS),
            "inspection": inspection(self.id),
            "source": section(self.page, "Source"),
        })
    }
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}").trim_end().to_owned()).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn page_in_docs(mechanism: &Mechanism) -> String {
        format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/mechanisms/{}.md"), mechanism.id)
    }

    #[test]
    fn every_page_has_its_parts() {
        for mechanism in MECHANISMS {
            for name in ["Equation", "Place in the chain", "What it looks like", "Source"] {
                assert!(!section(mechanism.page, name).is_empty(), "{}: {name}", mechanism.id);
            }
            assert!(mechanism.page.contains(&format!("\n`{}`\n", mechanism.id)), "{}", mechanism.id);
            let named = fs::exists(page_in_docs(mechanism)).unwrap();
            assert_eq!(named, mechanism.stage().is_some() && inspection(mechanism.id).is_some(), "{}", mechanism.id);
            assert_eq!(named, rows(mechanism.page, "parameter").len() > 1 && rows(mechanism.page, RIVALS).len() > 1);
        }
    }

    /// A crate is packaged alone, so it has copies; `cp docs/mechanisms/ID.md crates/fogcoil/src/glossary/mechanisms/` renews one.
    #[test]
    fn the_pages_are_those_of_the_documentation() {
        for mechanism in MECHANISMS.iter().filter(|m| m.stage().is_some()) {
            let page = fs::read_to_string(page_in_docs(mechanism)).unwrap();
            assert!(page == mechanism.page, "{}: copy the page from docs/mechanisms", mechanism.id);
        }
    }
}
