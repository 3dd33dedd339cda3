//! The mutants of a crate, as cargo-mutants lists them.

use proof::Failure;
use serde::Deserialize;

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
    pub(super) name: String,
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

/// Mutants of the runner's list in JSON.
pub(super) fn of_json(text: &str) -> Result<Vec<Mutant>, Failure> {
    #[derive(Deserialize)]
    struct Position {
        line: usize,
        column: usize,
    }
    #[derive(Deserialize)]
    struct Span {
        start: Position,
    }
    #[derive(Deserialize)]
    struct Function {
        function_name: String,
        return_type: String,
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
    let of = |listed: Listed| {
        let (function, returns) = listed.function.map(|f| (f.function_name, f.return_type)).unwrap_or_default();
        let Listed { name, file, genre, replacement, span: Span { start }, .. } = listed;
        Mutant { name, file, function, returns, genre, replacement, start: [start.line, start.column] }
    };
    Ok(listed.into_iter().map(of).collect())
}
