//! Tables in Markdown.

use pulldown_cmark::{Event, Options, Parser, Tag, TagEnd};

/// The rows of the table whose first header cell is `first`, its header among them, without marks of code.
pub(super) fn rows(page: &str, first: &str) -> Vec<Vec<String>> {
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
