//! Kinds of case files, told from one another and from tables.

use super::fields::FieldMap;
use super::scanner::{Scanner, Token};

/// A kind of case file that `fogcoil new` writes.
pub(super) struct Kind {
    name: &'static str,
    /// A field that each has at its top, and no other kind.
    mark: &'static str,
    /// What writes one.
    command: &'static str,
}

pub(super) static COIL: Kind = Kind { name: "a coil file", mark: "winding", command: "fogcoil new FILE" };
pub(super) static CELL: Kind = Kind { name: "a cell file", mark: "adhesive", command: "fogcoil new --kind cell FILE" };
pub(super) static TARGETS: Kind = Kind { name: "a file of targets", mark: "targets", command: "fogcoil new --kind targets FILE" };

/// Problem and remedy if `text` is not of the kind that is wanted but of another, a table, or nothing.
pub(super) fn mistaken(text: &str, wanted: Option<&Kind>) -> Option<(String, String)> {
    let mut tokens = Scanner::new(text).map(|(_, token)| token);
    let start = [tokens.next(), tokens.next()];
    let opens = start.iter().any(|token| matches!(token, Some(Token::Open(_))));
    let problem = if start[0].is_none() {
        "is empty".to_owned()
    } else if !opens && text.trim_start().lines().next().is_some_and(|line| line.contains([',', ';', '\t'])) {
        "looks like a table, not a RON file".to_owned()
    } else {
        let (map, wanted) = (FieldMap::new(text), wanted?);
        let is = |kind: &Kind| matches!(map.find(kind.mark), (Some(_), ""));
        let found = [&COIL, &CELL, &TARGETS].into_iter().find(|kind| is(kind)).filter(|_| !is(wanted))?;
        format!("is {}, but {} is read here", found.name, wanted.name)
    };
    let remedy = wanted.map_or("write fields in parentheses, (name: value, ...)".to_owned(), |kind| {
        format!("`{}` writes one to start from", kind.command)
    });
    Some((problem, remedy))
}
