//! A page of Markdown, taken apart.

/// What stands below the heading `## name`, up to the next; empty if there is none.
pub(super) fn section<'a>(page: &'a str, name: &str) -> &'a str {
    let mut parts = page.split("\n## ").skip(1);
    parts.find_map(|part| part.strip_prefix(name)?.strip_prefix('\n')).unwrap_or("").trim()
}

/// The heading of the page.
pub(super) fn title(page: &str) -> &str {
    page.lines().next().unwrap_or("").trim_start_matches("# ")
}

/// The rows of the table whose first header cell is `first`, its header among them, without marks of code.
pub(super) fn rows(page: &str, first: &str) -> Vec<Vec<String>> {
    let cells =
        |line: &str| line.trim().trim_matches('|').split('|').map(|cell| cell.trim().replace('`', "")).collect::<Vec<_>>();
    let table = page.lines().skip_while(|line| !line.starts_with(&format!("| {first} |")));
    table.take_while(|line| line.starts_with('|')).filter(|line| !line.starts_with("|--")).map(cells).collect()
}
