//! Whether a page is whole: what a browser, a printer or a screen reader would stumble over, without a browser.

use std::collections::HashSet;

/// Texts that would make a page load something else, act by itself, or show no number.
#[rustfmt::skip]
const BANNED: [&str; 13] = [
    "http://", "https://", "<script ", "<link", "<img", "url(", "@import", "javascript:", "onclick", "NaN", ">inf", "inf ", "\"inf",
];
/// Elements without an end.
const VOID: [&str; 3] = ["meta", "br", "input"];
const ENTITIES: [&str; 4] = ["amp;", "lt;", "gt;", "quot;"];

/// Everything that is wrong with a page; nothing if it is whole.
///
/// A page is well-formed, needs nothing but itself and says so to the browser, has a title, headings without gaps, no id twice, a name and a description for each
/// picture, a caption for each table, a scope for each head of a row or column, and a table for each figure.
///
/// A script is known to the browser by its hash, and no markup.
pub fn faults(page: &str) -> Vec<String> {
    let mut faults: Vec<String> =
        BANNED.iter().filter(|word| page.contains(**word)).map(|word| format!("holds {word:?}")).collect();
    let page = &unscripted(page);
    faults.extend(unbalanced(page));
    let ids: Vec<&str> = values(page, "id").collect();
    let known: HashSet<&str> = ids.iter().copied().collect();
    if known.len() < ids.len() {
        faults.push("an id stands twice".into());
    }
    let named = values(page, "aria-labelledby").flat_map(|ids| ids.split(' '));
    faults.extend(named.filter(|id| !known.contains(id)).map(|id| format!("the name {id} is not there")));
    let places = values(page, "href").filter_map(|place| place.strip_prefix('#'));
    faults.extend(places.filter(|id| !known.contains(id)).map(|id| format!("the place {id} is not there")));
    let count = |tag: &str| page.matches(tag).count();
    let mut equal = |what: &str, a: usize, b: usize| {
        if a != b {
            faults.push(format!("{what}: {a} and {b}"));
        }
    };
    equal("pictures and their titles", count("role=\"img\""), count("<title id="));
    equal("pictures and their descriptions", count("role=\"img\""), count("<desc id="));
    equal("tables and their captions", count("<table"), count("<caption"));
    equal("heads of rows and columns and their scopes", count("<th"), count("<th scope=") + count("<thead"));
    equal("policies and titles of the page", count(" http-equiv=\"Content-Security-Policy\""), count("<title>"));
    equal("scripts and their hashes", count("<script>"), count("'sha256-"));
    equal("languages and titles of the page", count("<html lang="), count("<title>"));
    if count("<figure") > count("<details>") {
        faults.push("a figure has no table of its data".into());
    }
    let levels: Vec<u32> = page.split("<h").skip(1).filter_map(|rest| rest.chars().next()?.to_digit(10)).collect();
    if levels.first() != Some(&1) || levels.windows(2).any(|pair| pair[1] > pair[0] + 1 || pair[1] == 1) {
        faults.push(format!("levels of the headings: {levels:?}"));
    }
    faults
}

/// The page with nothing in its scripts.
fn unscripted(page: &str) -> String {
    let mut pieces = page.split("<script>");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |before, piece| {
        let end = piece.find("</script>").unwrap_or(0);
        before + "<script>" + &piece[end..]
    })
}

fn values<'a>(page: &'a str, attribute: &str) -> impl Iterator<Item = &'a str> {
    let opened = format!(" {attribute}=\"");
    let starts: Vec<usize> = page.match_indices(&opened).map(|(at, found)| at + found.len()).collect();
    starts.into_iter().map(|start| page[start..].split('"').next().unwrap_or_default())
}

/// The first element that is not closed in its turn, attribute that is not quoted, or bare ampersand.
fn unbalanced(page: &str) -> Option<String> {
    let page = page.strip_prefix("<!DOCTYPE html>").unwrap_or(page);
    let mut open: Vec<&str> = Vec::new();
    for piece in page.split('<').skip(1) {
        let Some((tag, text)) = piece.split_once('>') else { return Some(format!("the tag {piece:?} has no end")) };
        if tag.matches('"').count() % 2 > 0 {
            return Some(format!("quotes of <{tag}>"));
        }
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Some(format!("</{name}> closes nothing"));
            }
        } else if let name = tag.split_whitespace().next().unwrap_or_default()
            && !tag.ends_with('/')
            && !VOID.contains(&name)
        {
            open.push(name);
        }
        let bare = text.contains('>') && open.last() != Some(&"style");
        if bare || text.split('&').skip(1).any(|rest| !ENTITIES.iter().any(|entity| rest.starts_with(entity))) {
            return Some(format!("bare > or & in {text:?}"));
        }
    }
    open.last().map(|name| format!("<{name}> is not closed"))
}

#[cfg(test)]
mod tests {
    use maud::{PreEscaped, html};

    use super::*;

    #[test]
    fn each_fault_is_seen() {
        let page = |body: &str| crate::page("A & B", &html! { p { "lead" } }, &PreEscaped(body.to_owned()));
        assert_eq!(faults(&page("<h2>x</h2>\n<p>1 &lt; 2</p>\n")), [""; 0]);
        for (body, fault) in [
            ("<h2>x</h2><p>", "closes nothing"),
            ("<p class=\"x>y</p>", "quotes"),
            ("<p>a & b</p>", "bare"),
            ("<p>NaN</p>", "NaN"),
            ("<img src=\"x\"/>", "<img"),
            ("<p id=\"a\">x</p><p id=\"a\">x</p>", "twice"),
            ("<p aria-labelledby=\"a\">x</p>", "the name a"),
            ("<svg role=\"img\"></svg>", "descriptions"),
            ("<table></table>", "captions"),
            ("<th>x</th>", "scopes"),
            ("<figure></figure>", "table of its data"),
            ("<h3>x</h3>", "headings"),
            ("<script>a < b && c</script>", "scripts and their hashes: 1 and 0"),
            ("<script src=\"x\"></script>", "<script "),
            ("<script>", "closes nothing"),
        ] {
            let found = faults(&page(body));
            assert!(found.iter().any(|one| one.contains(fault)), "{body}: {found:?}");
        }
        let open = page("").replace(" http-equiv=\"Content-Security-Policy\"", "");
        assert!(faults(&open).iter().any(|one| one.contains("policies")), "{:?}", faults(&open));
    }
}
