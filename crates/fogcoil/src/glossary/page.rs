//! Tables in Markdown.

/// The rows of the table whose first header cell is `first`, its header among them, without marks of code.
pub(super) fn rows(page: &str, first: &str) -> Vec<Vec<String>> {
    let cells =
        |line: &str| line.trim().trim_matches('|').split('|').map(|cell| cell.trim().replace('`', "")).collect::<Vec<_>>();
    let table = page.lines().skip_while(|line| !line.starts_with(&format!("| {first} |")));
    table.take_while(|line| line.starts_with('|')).filter(|line| !line.starts_with("|--")).map(cells).collect()
}
