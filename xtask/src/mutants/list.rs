//! The mutants of a crate, as cargo-mutants lists them.

use std::collections::BTreeMap;
use std::path::Path;

use proof::Failure;
use proof::files::read;
use proof::program::hex;
use serde::Deserialize;
use sha2::{Digest as _, Sha256};

/// Digits of the hash of a function's text that stand in a key.
const DIGITS: usize = 8;

/// Kind of a change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub(super) enum Genre {
    FnValue,
    BinaryOperator,
    UnaryOperator,
    MatchArm,
    MatchArmGuard,
    StructField,
}

/// A change of the source.
#[derive(Debug, Clone)]
pub(super) struct Mutant {
    /// As cargo-mutants names it, with its line.
    pub(super) name: String,
    /// By which its outcome is kept: file, change, its place among equal changes of one function, and a hash of the function's text.
    ///
    /// An edit elsewhere leaves it alone; one of the function makes it another mutant.
    pub(super) key: String,
    /// Path from the workspace's root.
    pub(super) file: String,
    pub(super) function: String,
    /// Type that the function returns, as written.
    pub(super) returns: String,
    pub(super) genre: Genre,
    pub(super) replacement: String,
    /// Line and column, from 1.
    pub(super) start: [usize; 2],
}

/// A key without the hash: the name by which a mutant is argued away and told.
pub(super) fn told(key: &str) -> &str {
    key.rsplit_once(" [").map_or(key, |(told, _)| told)
}

/// Mutants of the runner's list in JSON, of files below a folder.
pub(super) fn of_json(text: &str, below: &Path) -> Result<Vec<Mutant>, Failure> {
    #[derive(Deserialize)]
    struct Position {
        line: usize,
        column: usize,
    }
    #[derive(Deserialize)]
    struct Span {
        start: Position,
        end: Position,
    }
    impl Span {
        /// The first and the last line, from 1.
        fn lines(&self) -> [usize; 2] {
            [self.start.line.max(1), self.end.line]
        }
    }
    #[derive(Deserialize)]
    struct Function {
        function_name: String,
        return_type: String,
        span: Span,
    }
    #[derive(Deserialize)]
    struct Listed {
        name: String,
        file: String,
        function: Option<Function>,
        genre: Genre,
        replacement: String,
        span: Span,
    }
    let listed: Vec<Listed> = serde_json::from_str(text)?;
    let (mut texts, mut equal) = (BTreeMap::<String, String>::new(), BTreeMap::<String, usize>::new());
    let mut mutants = Vec::with_capacity(listed.len());
    for Listed { name, file, function, genre, replacement, span } in listed {
        if !texts.contains_key(&file) {
            texts.insert(file.clone(), read(&below.join(&file))?);
        }
        let [first, last] = function.as_ref().map_or(&span, |of| &of.span).lines();
        let mut hash = Sha256::new();
        texts[&file].lines().take(last).skip(first - 1).for_each(|line| hash.update(line));
        let change = name.splitn(4, ':').last().unwrap_or_default();
        let stem = format!("{file}:{change}");
        let hash = &hex(hash)[..DIGITS];
        let n = equal.entry(format!("{stem} [{hash}]")).or_default();
        *n += 1;
        let key = if *n == 1 { format!("{stem} [{hash}]") } else { format!("{stem} #{n} [{hash}]") };
        let (function, returns) = function.map(|of| (of.function_name, of.return_type)).unwrap_or_default();
        mutants.push(Mutant {
            name,
            key,
            file,
            function,
            returns,
            genre,
            replacement,
            start: [span.start.line, span.start.column],
        });
    }
    Ok(mutants)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys of the three mutants of a file with two functions.
    fn keys(source: &str) -> Vec<String> {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("a.rs"), source).unwrap();
        let line = |of: &str| source.lines().position(|line| line.starts_with(of)).unwrap() + 1;
        let mutant = |function: &str, column: usize| {
            let (first, at) = (line(&format!("fn {function}")), line(&format!("fn {function}")) + 1);
            let span = |[a, b]: [usize; 2]| {
                format!(r#"{{"start": {{"line": {a}, "column": {column}}}, "end": {{"line": {b}, "column": 9}}}}"#)
            };
            format!(
                r#"{{"name": "a.rs:{at}:{column}: replace + with - in {function}", "file": "a.rs", "genre": "BinaryOperator", "replacement": "-",
                "function": {{"function_name": "{function}", "return_type": "", "span": {}}}, "span": {}}}"#,
                span([first, at + 1]),
                span([at, at])
            )
        };
        let listed = format!("[{}]", [mutant("f", 7), mutant("f", 11), mutant("g", 7)].join(", "));
        of_json(&listed, folder.path()).unwrap().into_iter().map(|mutant| mutant.key).collect()
    }

    #[test]
    fn a_mutant_keeps_its_key_until_its_function_changes() {
        let source = "fn f() {\n    1 + 2 + 3\n}\nfn g() {\n    4 + 5\n}\n";
        let old = keys(source);
        let names: Vec<&str> = old.iter().map(|key| told(key)).collect();
        assert_eq!(names, ["a.rs: replace + with - in f", "a.rs: replace + with - in f #2", "a.rs: replace + with - in g"]);
        assert_eq!(keys(&format!("// a line more\n\n{source}")), old);
        let new = keys(&source.replace("4 + 5", "4 + 6"));
        assert_eq!(new[..2], old[..2]);
        assert!(new[2] != old[2] && told(&new[2]) == names[2], "{new:?}");
    }
}
