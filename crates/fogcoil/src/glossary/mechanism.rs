//! The library's mechanisms: their descriptions, with the numbers that `cargo xtask mechanisms` measured.

use std::fmt::Write;

use mechanisms::{CATALOGUE, Naming, ON_REQUEST};
use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};
use serde_json::{Value, json};

use crate::table::table;

/// Parameters and rivals of the mechanisms with a name, for the reference coil: Markdown, each below a heading that is its id.
const MEASURED: &str = include_str!("measured.md");
/// Words before the measured table of rivals.
const RIVALS: &str = "fitted in its place";

/// A mechanism, or another entry among the mechanisms in tables, in words; Markdown.
#[derive(Debug, Clone, Copy)]
pub struct Subject {
    /// Its id.
    pub id: &'static str,
    /// Its name.
    pub title: &'static str,
    stage: Option<&'static str>,
    equation: &'static str,
    place: &'static str,
    signature: &'static str,
    source: &'static str,
}

/// Entries that stand among the mechanisms in tables.
const BESIDE: [Subject; 2] = [
    Subject {
        id: "recalibrate",
        title: "The design as it is, its constants re-estimated",
        stage: None,
        equation: "The constants of the design times factors that are fitted, each within its tolerance; `fogcoil sensitivity COIL.ron --all` lists them with\n\
                   their tolerances.",
        place: "None of its own: nothing is added to the design, its numbers were off.",
        signature: "A gain on parts of the bias, and another time scale of the heat flow: the same at all temperatures and in every run.",
        source: "Tolerances of the coil file; the usual ones where it names none.",
    },
    Subject {
        id: "nominal",
        title: "The design as it is",
        stage: None,
        equation: "Eqs. (1) and (2) of Osunluk, Ogut and Ozbay with the coil file's numbers; offsets of gyro and thermometer are fitted.",
        place: "None: nothing is left out.",
        signature: "What is recorded less what is predicted is noise. As a rival it tells whether a mechanism is seen at all.",
        source: "B. Osunluk, S. Ogut and E. Ozbay, *Thermally Induced Bias Errors for a Fiber Coil with Practical Quadrupole Winding*.",
    },
];

/// All mechanisms, in the order of the library; then those without a name, those that are weighed on request, and the other entries of tables.
pub fn all() -> impl Iterator<Item = Subject> {
    let of = |mechanism: &&'static dyn mechanisms::Mechanism| {
        let facts = mechanism.facts();
        Subject {
            id: facts.id,
            title: facts.title,
            stage: matches!(facts.naming, Naming::Named { .. }).then(|| facts.stage.name()),
            equation: facts.equation,
            place: facts.place,
            signature: facts.signature,
            source: facts.source,
        }
    };
    CATALOGUE.iter().chain(ON_REQUEST).map(of).chain(BESIDE)
}

/// Numbers of mechanisms with a name, without one, and weighed on request, and of the entries of tables alone.
pub(super) fn counts() -> [usize; 4] {
    let named = all().filter(|m| m.stage.is_some()).count() - ON_REQUEST.len();
    [named, CATALOGUE.len() - named, ON_REQUEST.len(), BESIDE.len()]
}

/// Option that asks for a mechanism that is weighed on request; empty for any other.
fn request(id: &str) -> String {
    let Some(mechanism) = ON_REQUEST.iter().find(|mechanism| mechanism.facts().id == id) else { return String::new() };
    let columns = mechanism.columns();
    let needs =
        if columns.is_empty() { String::new() } else { format!(", with the column {} in every record", columns.join(", ")) };
    format!("It is weighed on request: `fogcoil diagnose ... --mechanism {id}`{needs}.")
}

/// A check of the unit itself that decides about a mechanism.
fn inspection(id: &str) -> Option<&'static str> {
    mechanisms::find(id)?.facts().inspection()
}

impl Subject {
    /// Its parameters, effect and rivals as they were measured, in Markdown; empty of one without a name.
    fn measured(&self) -> &'static str {
        let mut sections = MEASURED.trim_start_matches("# ").split("\n# ");
        sections.find_map(|section| section.strip_prefix(self.id)?.strip_prefix('\n')).unwrap_or("").trim()
    }

    /// Its page of docs/mechanisms, with `measured` numbers between the marks.
    pub fn page(&self, measured: &str) -> String {
        let Self { id, title, equation, place, signature, source, .. } = self;
        let request = request(id);
        let asked = if request.is_empty() { request } else { format!("{request}\n\n") };
        format!(
            "# {title}\n\n`{id}`\n\n{asked}## Equation\n\n{equation}\n\n## Place in the chain\n\n{place}\n\n## Signature\n\n{signature}\n\n\
             ## Source\n\n{source}\n\n## Measured\n\n<!-- measured: written by `cargo xtask mechanisms` -->\n\n{}\n<!-- measured end -->\n",
            measured.trim()
        )
    }

    pub(super) fn text(&self) -> String {
        self.told(self.measured())
    }

    /// The text with what was measured, which may be nothing yet.
    fn told(&self, measured: &str) -> String {
        let mut out = format!("{}: {}\n", self.id, self.title);
        let mut say = |name: &str, text: &str| {
            if !text.is_empty() {
                let _ = write!(out, "\n{name}\n{}\n", indented(text));
            }
        };
        say("Equation", self.equation);
        say("Place in the chain", self.place);
        say("Request", &request(self.id));
        say("Parameters (prior and typical size as for the reference coil)", &table(&rows(measured, "parameter")));
        say("Signature", self.signature);
        say(
            "Rivals: expected ln odds for it over each rival that is fitted in its place, by test; above 3.5 the two are told apart",
            &table(&rows(measured, RIVALS)),
        );
        if let Some(inspection) = inspection(self.id) {
            let above = if measured.is_empty() { "the best test is not measured" } else { "the best test above" };
            say(
                "How to test it",
                &format!("In the chamber: {above}; `fogcoil recommend` finds it for your design.\nOn the unit: {inspection}."),
            );
        }
        if let Some(verdict) = super::verdict::find(self.id) {
            say("As a verdict", &format!("{}\n{}\nNext: {}", verdict.meaning, verdict.limits, verdict.next));
        }
        say("Source", self.source);
        out
    }

    pub(super) fn json(&self) -> Value {
        let measured = self.measured();
        let objects = |first: &str| -> Vec<Value> {
            let rows = rows(measured, first);
            let Some((header, rows)) = rows.split_first() else { return Vec::new() };
            rows.iter().map(|row| header.iter().cloned().zip(row.iter().cloned().map(Value::String)).collect()).collect()
        };
        json!({
            "id": self.id,
            "kind": "mechanism",
            "title": self.title,
            "stage": self.stage,
            "equation": self.equation,
            "place": self.place,
            "parameters": objects("parameter"),
            "signature": self.signature,
            "confused_with": objects(RIVALS),
            "inspection": inspection(self.id),
            "source": self.source,
        })
    }
}

/// The rows of the Markdown table whose first header cell is `first`, its header among them, without marks of code.
fn rows(page: &str, first: &str) -> Vec<Vec<String>> {
    let mut table: Vec<Vec<String>> = Vec::new();
    for (event, place) in Parser::new_ext(page, Options::ENABLE_TABLES).into_offset_iter() {
        match event {
            Event::Start(Tag::Table(_)) => table.clear(),
            Event::Start(Tag::TableHead | Tag::TableRow) => table.push(Vec::new()),
            Event::Start(Tag::TableCell) => {
                let cell = page[place].trim_matches(['|', ' ']).replace('`', "");
                if let Some(row) = table.last_mut() {
                    row.push(cell);
                }
            }
            Event::End(TagEnd::Table) if table.first().is_some_and(|head| head.first().is_some_and(|cell| cell == first)) => {
                return table;
            }
            _ => {}
        }
    }
    Vec::new()
}

pub(super) fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}").trim_end().to_owned()).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn whatever_has_a_name_was_measured() {
        for mechanism in all() {
            let measured = mechanism.measured();
            let whole = rows(measured, "parameter").len() > 1 && rows(measured, RIVALS).len() > 1;
            assert_eq!(whole, mechanism.stage.is_some() && inspection(mechanism.id).is_some(), "{}", mechanism.id);
            if let Some(stage) = mechanism.stage {
                assert!(measured.starts_with(&format!("Stage: {stage}.")), "{}", mechanism.id);
            }
        }
    }

    #[test]
    fn a_test_that_was_not_measured_is_not_told() {
        let debond = all().find(|m| m.id == "debond").unwrap();
        assert!(debond.text().contains("In the chamber: the best test above; `fogcoil recommend` finds it"));
        let new = debond.told("");
        assert!(
            !new.contains("best test above")
                && new.contains("In the chamber: the best test is not measured; `fogcoil recommend` finds it"),
            "{new}"
        );
    }

    /// `cargo xtask mechanisms` renews the pages.
    #[test]
    fn the_pages_of_the_documentation_say_the_same() {
        for mechanism in all().filter(|m| m.stage.is_some()) {
            let page = format!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/mechanisms/{}.md"), mechanism.id);
            let page = fs::read_to_string(page).unwrap();
            assert!(page == mechanism.page(mechanism.measured()), "{}: differs from docs/mechanisms", mechanism.id);
        }
    }
}
