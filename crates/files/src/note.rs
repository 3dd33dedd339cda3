//! Warnings and notes as they are told.

use std::fmt;
use std::path::PathBuf;

use serde::{Serialize, Serializer};

use crate::{Remark, shown_path};

/// Importance of a note.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// It may make the whole answer void.
    Warning,
    /// It is good to know.
    Note,
}

/// Something that a user should know although nothing is wrong.
///
/// The printed form, and the value in JSON, is `FILE: text [id]`, of a warning `warning: FILE: text [id]`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// Its kind.
    pub remark: Remark,
    /// Its importance.
    pub severity: Severity,
    /// The file that it is about, where the text alone does not say it.
    pub place: Option<PathBuf>,
    /// The text, in words.
    pub text: String,
}

impl Remark {
    /// A note of this kind.
    pub fn note(self, text: impl Into<String>) -> Note {
        Note { remark: self, severity: Severity::Note, place: None, text: text.into() }
    }

    /// A warning of this kind.
    pub fn warning(self, text: impl Into<String>) -> Note {
        Note { severity: Severity::Warning, ..self.note(text) }
    }
}

impl Note {
    /// The same, about a file.
    #[must_use]
    pub fn at(self, file: impl Into<PathBuf>) -> Self {
        Self { place: Some(file.into()), ..self }
    }

    /// Whether it may make the whole answer void.
    pub fn is_warning(&self) -> bool {
        self.severity == Severity::Warning
    }

    /// The form among others of its kind: `FILE: text [id]`.
    pub fn message(&self) -> String {
        let place = self.place.as_ref().map_or(String::new(), |file| format!("{}: ", shown_path(file)));
        format!("{place}{} [{}]", self.text, self.remark.id())
    }

    /// The form among other lines: `warning: FILE: text [id]` or `note: FILE: text [id]`.
    pub fn line(&self) -> String {
        let kind = if self.is_warning() { "" } else { "note: " };
        format!("{kind}{self}")
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let kind = if self.is_warning() { "warning: " } else { "" };
        write!(f, "{kind}{}", self.message())
    }
}

impl Serialize for Note {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_printed_carries_place_and_id() {
        let note = Remark::LongTail.note("a tail");
        assert_eq!((note.to_string(), note.line()), ("a tail [long-tail]".into(), "note: a tail [long-tail]".into()));
        let warning = Remark::Gap.warning("a gap").at("r.csv");
        let said = "warning: r.csv: a gap [gap]".to_owned();
        assert_eq!((warning.to_string(), warning.line(), warning.message()), (said.clone(), said, "r.csv: a gap [gap]".into()));
    }
}
