//! Tables of a page: facts, and columns of numbers; each with a caption.

use maud::{Markup, html};

use crate::number::nice;

/// Names and values, under a caption that only a screen reader says.
pub fn facts(caption: &str, rows: &[(String, String)]) -> Markup {
    html! {
        table.facts {
            caption.unseen { (caption) }
            tbody {
                @for (name, value) in rows {
                    tr { th scope="row" { (name) } td { (value) } } "\n"
                }
            }
        } "\n"
    }
}

/// A row of [`facts`].
pub fn row(name: &str, value: impl Into<String>) -> (String, String) {
    (name.to_owned(), value.into())
}

/// Kind of the cells of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// Short, never broken, to the right.
    Numbers,
    /// Words, broken where need be.
    Words,
}

/// A table with a caption and a head, in a box that scrolls where it is too wide; the first cell of a row names it.
pub fn grid(caption: &str, cells: Cells, head: &[impl AsRef<str>], rows: &[Vec<String>]) -> Markup {
    let caption = nice(caption);
    let class = match cells {
        Cells::Words if head.len() > 5 => "words many",
        Cells::Words => "words",
        Cells::Numbers => "data",
    };
    html! {
        div.scroll role="group" tabindex="0" aria-label=(caption) {
            table class=(class) {
                caption { (caption) }
                thead { tr { @for cell in head { th scope="col" { (nice(cell.as_ref())) } } } }
                tbody {
                    @for row in rows {
                        tr {
                            @if let Some((name, cells)) = row.split_first() {
                                th scope="row" { (nice(name)) }
                                @for cell in cells { td { (nice(cell)) } }
                            }
                        } "\n"
                    }
                }
            }
        } "\n"
    }
}
