//! A page of Markdown: its fences, links and anchors.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use proof::{Failure, files};
use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

pub(super) struct Page {
    /// Its file, from the repository's root.
    pub(super) path: PathBuf,
    pub(super) fences: Vec<Fence>,
    pub(super) links: Vec<Link>,
    pub(super) anchors: BTreeSet<String>,
}

pub(super) struct Fence {
    /// Line of its first line of text, from 1.
    pub(super) line: usize,
    /// Words of its info string, which commas separate.
    pub(super) words: Vec<String>,
    pub(super) text: String,
    /// Whether nothing but blank lines is between it and the fence before.
    pub(super) follows: bool,
}

pub(super) struct Link {
    /// Its line, from 1.
    pub(super) line: usize,
    pub(super) target: String,
}

impl Fence {
    pub(super) fn language(&self) -> &str {
        self.words.first().map_or("", String::as_str)
    }

    /// The text behind `prefix` in a word of the info string.
    pub(super) fn word(&self, prefix: &str) -> Option<&str> {
        self.words.iter().skip(1).find_map(|word| word.strip_prefix(prefix))
    }
}

impl Page {
    pub(super) fn read(root: &Path, path: &Path) -> Result<Self, Failure> {
        Self::parse(path, &files::read(&root.join(path))?)
            .map_err(|(line, problem)| Failure(format!("{}:{line}: {problem}", path.display())))
    }

    fn parse(path: &Path, text: &str) -> Result<Self, (usize, String)> {
        let mut page = Self { path: path.to_owned(), fences: Vec::new(), links: Vec::new(), anchors: BTreeSet::new() };
        let line = |at: usize| 1 + text[..at].matches('\n').count();
        let (mut open, mut heading, mut last_end) = (None::<Fence>, None::<String>, None);
        for (event, range) in Parser::new_ext(text, Options::ENABLE_TABLES).into_offset_iter() {
            match event {
                Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(info))) => {
                    if text[range.clone()].trim_end().lines().skip(1).last().is_none_or(|last| last.trim() != "```") {
                        return Err((line(range.start), "the fence is not closed".into()));
                    }
                    let words = info.split(',').map(|word| word.trim().to_owned()).collect();
                    let follows = last_end.replace(range.end).is_some_and(|end: usize| text[end..range.start].trim().is_empty());
                    open = Some(Fence { line: line(range.start) + 1, words, text: String::new(), follows });
                }
                Event::End(TagEnd::CodeBlock) => page.fences.extend(open.take()),
                Event::Start(Tag::Heading { .. }) => heading = Some(String::new()),
                Event::End(TagEnd::Heading(_)) => page.anchor(&slug(&heading.take().unwrap_or_default())),
                Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }) => {
                    page.links.push(Link { line: line(range.start), target: dest_url.into_string() });
                }
                Event::Text(words) | Event::Code(words) => match (&mut open, &mut heading) {
                    (Some(Fence { text, .. }), _) | (None, Some(text)) => text.push_str(&words),
                    (None, None) => {}
                },
                _ => {}
            }
        }
        Ok(page)
    }

    fn anchor(&mut self, slug: &str) {
        let numbered = (1..).map(|number| format!("{slug}-{number}"));
        let free = std::iter::once(slug.to_owned()).chain(numbered).find(|name| !self.anchors.contains(name));
        self.anchors.extend(free);
    }
}

/// A heading's anchor, as code hosts and mdBook make it.
fn slug(heading: &str) -> String {
    let kept = |c: char| match c {
        ' ' => Some('-'),
        '-' | '_' => Some(c),
        _ => c.is_alphanumeric().then_some(c),
    };
    heading.chars().filter_map(kept).flat_map(char::to_lowercase).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fences_links_and_anchors_are_found() {
        let text = "# A `b`, c\n[x](y.md#z) `[no](no)` ![p](q.svg)\n```sh,ignore-it\nls\n```\n\n```text\nfile\n```\n# A b c\nword\n```sh\n```\n";
        let page = Page::parse(Path::new("p.md"), text).unwrap();
        let found: Vec<_> = page.fences.iter().map(|f| (f.line, f.language(), f.word("ignore-"), f.follows)).collect();
        assert_eq!(found, [(4, "sh", Some("it"), false), (8, "text", None, true), (13, "sh", None, false)]);
        assert_eq!(page.fences[0].text, "ls\n");
        assert_eq!(page.links.iter().map(|l| l.target.as_str()).collect::<Vec<_>>(), ["y.md#z", "q.svg"]);
        assert_eq!(page.anchors.iter().map(String::as_str).collect::<Vec<_>>(), ["a-b-c", "a-b-c-1"]);
        assert!(Page::parse(Path::new("p.md"), "```sh\n").is_err());
    }
}
