//! A page of Markdown, taken apart.

use pulldown_cmark::{Event, HeadingLevel, Options, Parser, Tag, TagEnd};

/// What stands below the heading `## name`, up to the next; empty if there is none.
pub(super) fn section<'a>(page: &'a str, name: &str) -> &'a str {
    let is_heading = |event: &Event| matches!(event, Event::Start(Tag::Heading { level: HeadingLevel::H2, .. }));
    let mut headings = Parser::new(page).into_offset_iter().filter(|(event, _)| is_heading(event)).map(|(_, place)| place);
    let Some(heading) = headings.find(|place| page[place.clone()].trim_matches(['#', ' ', '\n']) == name) else { return "" };
    page[heading.end..headings.next().map_or(page.len(), |next| next.start)].trim()
}

/// The heading of the page.
pub(super) fn title(page: &str) -> &str {
    page.lines().next().unwrap_or("").trim_start_matches("# ")
}

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
