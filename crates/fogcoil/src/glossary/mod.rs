//! `fogcoil explain ID`: meaning of the ids that the program prints, of mechanisms and of its own remarks.

mod mechanism;
mod own;
mod verdict;

pub use files::{Explanation, Note, Remark, Severity};
pub use mechanism::{Subject, all as mechanisms};
pub use own::{own_json, own_text};
pub use verdict::{VERDICTS, Verdict};

use std::fmt::Write;

use serde_json::{Value, json};
use strsim::levenshtein;

use crate::table::table;

/// Something that has an id.
#[derive(Debug, Clone, Copy)]
pub enum Entry {
    /// A mechanism of the library.
    Mechanism(Subject),
    /// A warning or a note.
    Remark(Remark),
    /// A verdict that is no entry of tables.
    Verdict(&'static Verdict),
}

/// Ids offered for one that is not known, at most.
const OFFERED: usize = 3;
/// Inverse of the share of letters in which an id that is meant may differ.
const ALIKE: usize = 3;
/// The same of a word of an explanation: there are many of them.
const ALIKE_WORD: usize = 6;

/// Meaning of an id.
///
/// # Errors
/// The ids that may be meant, best first, where none is this one: those that are much like it, and those whose explanation has the word.
pub fn look_up(id: &str) -> Result<Entry, Vec<&'static str>> {
    let all: Vec<Entry> = entries().collect();
    if let Some(entry) = all.iter().find(|entry| entry.id() == id) {
        return Ok(*entry);
    }
    let asked = id.to_lowercase();
    let far = |known: &str, share: usize| Some(levenshtein(&asked, known)).filter(|far| *far <= known.chars().count() / share);
    let rank = |entry: &Entry| {
        let by_word = || {
            let text = entry.text().to_lowercase();
            text.split(|c: char| !c.is_alphanumeric()).filter_map(|word| far(word, ALIKE_WORD).filter(|_| !word.is_empty())).min()
        };
        far(entry.id(), ALIKE).map(|far| (false, far)).or_else(|| by_word().map(|far| (true, far)))
    };
    let mut near: Vec<_> = all.iter().filter_map(|entry| Some((rank(entry)?, entry.id()))).collect();
    near.sort_by_key(|(rank, _)| *rank);
    Err(near.into_iter().take(OFFERED).map(|(_, id)| id).collect())
}

fn entries() -> impl Iterator<Item = Entry> {
    // as an entry of tables, `recalibrate` stands among the mechanisms
    let verdicts = VERDICTS.iter().filter(|verdict| mechanisms().all(|mechanism| mechanism.id != verdict.id));
    mechanisms().map(Entry::Mechanism).chain(verdicts.map(Entry::Verdict)).chain(Remark::ALL.iter().copied().map(Entry::Remark))
}

impl Entry {
    /// Its id.
    pub fn id(&self) -> &'static str {
        match self {
            Self::Mechanism(mechanism) => mechanism.id,
            Self::Remark(remark) => remark.id(),
            Self::Verdict(verdict) => verdict.id,
        }
    }

    /// The explanation as text.
    pub fn text(&self) -> String {
        match self {
            Self::Mechanism(mechanism) => mechanism.text(),
            Self::Remark(remark) => {
                let Explanation { cause, consequence, remedy } = remark.explanation();
                format!("{}: {cause}\n\nConsequence: {consequence}\nRemedy:      {remedy}\n", remark.id())
            }
            Self::Verdict(Verdict { id, meaning, limits, next }) => {
                format!("{id}, a verdict: {meaning}\n\nLimits: {limits}\nNext:   {next}\n")
            }
        }
    }

    /// The explanation as one object.
    pub fn json(&self) -> Value {
        match self {
            Self::Mechanism(mechanism) => mechanism.json(),
            Self::Remark(remark) => {
                let Explanation { cause, consequence, remedy } = remark.explanation();
                json!({"id": remark.id(), "kind": "remark", "cause": cause, "consequence": consequence, "remedy": remedy})
            }
            Self::Verdict(Verdict { id, meaning, limits, next }) => {
                json!({"id": id, "kind": "verdict", "meaning": meaning, "limits": limits, "next": next})
            }
        }
    }
}

/// All ids in two groups, a line each.
pub fn list() -> String {
    let [named, unnamed, asked, beside] = mechanism::counts();
    let mut out = format!(
        "Mechanisms: {named} with a name; {unnamed} without one, unknown:..., which describe what has none; {asked} that are weighed on request, --mechanism ID; {beside} that stand among them in tables:\n\n"
    );
    out.push_str(&table(&mechanisms().map(|m| vec![m.id.to_owned(), m.title.to_owned()]).collect::<Vec<_>>()));
    out.push_str("\nVerdicts:\n\n");
    out.push_str(&table(
        &VERDICTS.iter().map(|verdict| vec![verdict.id.to_owned(), verdict.meaning.to_owned()]).collect::<Vec<_>>(),
    ));
    out.push_str("\nWarnings and notes:\n\n");
    let row = |remark: &Remark| vec![remark.id().to_owned(), remark.explanation().cause.to_owned()];
    out.push_str(&table(&Remark::ALL.iter().map(row).collect::<Vec<_>>()));
    let _ = writeln!(out, "\n`fogcoil explain ID` says more of each.");
    out
}

/// All ids with their explanations.
pub fn list_json() -> Value {
    let of = |remark: &Remark| Entry::Remark(*remark).json();
    json!({
        "mechanisms": mechanisms().map(|m| m.json()).collect::<Vec<_>>(),
        "verdicts": VERDICTS.iter().map(|verdict| Entry::Verdict(verdict).json()).collect::<Vec<_>>(),
        "remarks": Remark::ALL.iter().map(of).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_kebab_case_and_stand_once_and_are_found() {
        let mut ids: Vec<&str> = entries().map(|entry| entry.id()).collect();
        let kebab = |id: &&str| id.split('-').all(|word| !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase()));
        let named = |id: &&str| kebab(&id.trim_start_matches("unknown:"));
        assert!(ids.iter().all(named), "{ids:?}");
        assert!(ids.iter().all(|id| look_up(id).is_ok_and(|entry| entry.id() == *id)));
        ids.sort_unstable();
        assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "{ids:?}");
    }

    /// The documents say them in words.
    #[test]
    fn the_mechanisms_are_counted() {
        assert_eq!(mechanism::counts(), [16, 6, 10, 2]);
        assert!(list().starts_with("Mechanisms: 16 with a name; 6 without one, unknown:..., "));
    }

    #[test]
    fn verdicts_are_explained() {
        for id in ["none", "recalibrate", "explained", "unknown", "inseparable"] {
            let text = look_up(id).unwrap().text();
            assert!(text.contains("Next:") && !text.contains(".rs"), "{text}");
        }
    }

    #[test]
    fn a_slip_of_the_pen_is_near_what_was_meant() {
        assert_eq!(look_up("debnd").unwrap_err()[0], "debond");
        // a word of the explanation, and that with a slip
        for word in ["Humidity", "humidty"] {
            assert!(look_up(word).unwrap_err().contains(&"moisture"), "{word}");
        }
        assert!(look_up("qwertzuiop").unwrap_err().is_empty());
    }
}
