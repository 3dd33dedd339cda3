//! The frame of a page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use sha2::{Digest, Sha256};

use crate::style::page_style;

const STYLE: &str = include_str!("page.css");

/// Lets the figures of a page answer to a hand; a script that adds figures later calls `hand` with the element that holds them.
pub const HAND: &str = include_str!("hand.js");

/// Permissions of a page in a browser: nothing but be drawn, with the styles in it.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'";

/// Work that a page does by itself.
#[derive(Debug, Clone, Copy, Default)]
pub struct Script<'a> {
    /// JavaScript; none if empty. The browser runs no other.
    pub text: &'a str,
    /// Rules beside the page's own style.
    pub style: &'a str,
    /// Further permissions, as `Content-Security-Policy` writes them after the sources of scripts.
    pub permissions: &'a str,
}

/// A page that needs nothing but itself, on paper, phone and screen, in light and dark: `lead` in its header, `body` below. Its figures
/// answer to a hand. Control characters, which no page may hold, are dropped.
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
    // what has no axes has nothing to read
    let text = if body.0.contains(" data-x=\"") { HAND } else { "" };
    scripted(title, lead, body, Script { text, ..Script::default() })
}

/// A heading of the second level.
pub fn heading(name: &str) -> Markup {
    html! { h2 id=(anchor(name)) { (name) } "\n" }
}

/// Sections of a page, each under its heading, after a list of the headings that leads to them.
///
/// ```
/// use charts::{faults, page, sections};
/// use maud::html;
///
/// let body = sections(&[("Coil", html! { p { "Wound." } }), ("Bias", html! { p { "Computed." } })]);
/// assert!(body.0.contains("<a href=\"#to-bias\">Bias</a>") && body.0.contains("<h2 id=\"to-bias\">Bias</h2>"));
/// assert!(faults(&page("Two sections", &html! { p { "A coil and its bias." } }, &body)).is_empty());
/// ```
pub fn sections(sections: &[(&str, Markup)]) -> Markup {
    html! {
        nav aria-label="Contents" {
            ul.contents {
                @for (name, _) in sections { li { a href=(format!("#{}", anchor(name))) { (name) } } }
            }
        }
        "\n"
        @for (name, section) in sections { (heading(name)) (section) }
    }
}

/// Name of a heading in addresses; figures have names of their own.
fn anchor(name: &str) -> String {
    let letters = name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' });
    format!("to-{}", letters.collect::<String>().trim_matches('-'))
}

/// A page, as [`page`] makes it, that acts: its script alone is run, told by its SHA-256.
///
/// ```
/// use charts::{Script, faults, scripted};
/// use maud::html;
///
/// let script = Script { text: "document.title = 1 < 2 && 'acts';", ..Script::default() };
/// let page = scripted("Waits", &html! { p { "For a script." } }, &html! { h2 { "Result" } }, script);
/// assert!(page.contains("script-src 'sha256-") && page.contains("1 < 2 && 'acts'"));
/// assert_eq!(faults(&page), [""; 0]);
/// ```
pub fn scripted(title: &str, lead: &Markup, body: &Markup, Script { text, style, permissions }: Script) -> String {
    let policy = match text {
        "" => POLICY.to_owned(),
        _ => format!("{POLICY}; script-src 'sha256-{}'{permissions}", STANDARD.encode(Sha256::digest(text))),
    };
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(policy);
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(page_style())) (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body {
                header { h1 { (title) } (lead) }
                main { (body) }
                @if !text.is_empty() { script { (PreEscaped(text)) } }
            }
        }
    };
    let printable = |c: &char| !c.is_control() || *c == '\n';
    page.into_string().chars().filter(printable).chain(['\n']).collect()
}
