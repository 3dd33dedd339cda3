//! The frame of a page.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::style::page_style;

const STYLE: &str = include_str!("page.css");

/// Permissions of a page in a browser: nothing but be drawn, with the styles in it. No page has a script, a picture or a font of its own.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'";

/// A page that needs nothing but itself, on paper, phone and screen, in light and dark: `lead` in its header, `body` below. Control
/// characters, which no page may hold, are dropped.
///
/// ```
/// use charts::{page, faults};
/// use maud::html;
///
/// let page = page("a < b", &html! { p { "Two numbers." } }, &html! { h2 { "Result" } p { (1.5) " & " (2.5) } });
/// assert!(page.contains("<h1>a &lt; b</h1>") && page.contains("<p>1.5 &amp; 2.5</p>"));
/// assert!(faults(&page).is_empty());
/// ```
pub fn page(title: &str, lead: &Markup, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(page_style())) (PreEscaped(STYLE)) }
            }
            body {
                header { h1 { (title) } (lead) }
                main { (body) }
            }
        }
    };
    let printable = |c: &char| !c.is_control() || *c == '\n';
    page.into_string().chars().filter(printable).chain(['\n']).collect()
}
