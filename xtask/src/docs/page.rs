//! A page of Markdown: its fences, links and anchors.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::validate::Failure;

/// A page.
pub(super) struct Page {
    /// Its file, from the repository's root.
    pub(super) path: PathBuf,
    pub(super) fences: Vec<Fence>,
    pub(super) links: Vec<Link>,
    pub(super) anchors: BTreeSet<String>,
}

/// A fenced block.
pub(super) struct Fence {
    /// Line of its first line of text, from 1.
    pub(super) line: usize,
    /// Words of its info string, which commas separate.
    pub(super) words: Vec<String>,
    pub(super) text: String,
    /// Whether nothing but blank lines is between it and the fence before.
    pub(super) follows: bool,
}

/// A link or an image.
pub(super) struct Link {
    /// Its line, from 1.
    pub(super) line: usize,
    pub(super) target: String,
}

impl Fence {
    pub(super) fn language(&self) -> &str {
        self.words.first().map_or("", String::as_str)
    }

    /// What stands behind `prefix` in a word of the info string.
    pub(super) fn word(&self, prefix: &str) -> Option<&str> {
        self.words.iter().skip(1).find_map(|word| word.strip_prefix(prefix))
    }
}

impl Page {
    /// Reads the page at `path`, from `root`.
    pub(super) fn read(root: &Path, path: &Path) -> Result<Self, Failure> {
        let text = fs::read_to_string(root.join(path)).map_err(|e| Failure(format!("{}: {e}", path.display())))?;
        Self::parse(path, &text).map_err(|(line, problem)| Failure(format!("{}:{line}: {problem}", path.display())))
    }

    fn parse(path: &Path, text: &str) -> Result<Self, (usize, String)> {
        let mut page = Self { path: path.to_owned(), fences: Vec::new(), links: Vec::new(), anchors: BTreeSet::new() };
        let (mut open, mut between) = (None::<Fence>, true);
        for (line, content) in (1..).zip(text.lines()) {
            let info = content.strip_prefix("```");
            match (&mut open, info) {
                (Some(_), Some("")) => {
                    page.fences.extend(open.take());
                    between = true;
                }
                (Some(fence), _) => fence.text.extend([content, "\n"]),
                (None, Some(info)) => {
                    let words = info.split(',').map(|word| word.trim().to_owned()).collect();
                    open =
                        Some(Fence { line: line + 1, words, text: String::new(), follows: between && !page.fences.is_empty() });
                }
                (None, None) => {
                    between &= content.trim().is_empty();
                    page.prose(line, content);
                }
            }
        }
        open.map_or(Ok(page), |fence| Err((fence.line - 1, "the fence is not closed".into())))
    }

    fn prose(&mut self, line: usize, content: &str) {
        if let Some(heading) = content.strip_prefix('#') {
            let (slug, mut number) = (slug(heading.trim_start_matches('#')), 0);
            let mut name = slug.clone();
            while !self.anchors.insert(name.clone()) {
                number += 1;
                name = format!("{slug}-{number}");
            }
        }
        let links = without_code(content);
        for (at, _) in links.match_indices("](") {
            if let Some(end) = links[at..].find(')') {
                self.links.push(Link { line, target: links[at + 2..at + end].to_owned() });
            }
        }
    }
}

/// The line without what is between backticks.
fn without_code(line: &str) -> String {
    line.split('`').step_by(2).collect()
}

/// A heading's anchor, as code hosts and mdBook make it.
fn slug(heading: &str) -> String {
    let mut text = String::new();
    let mut rest = heading.trim();
    while let Some((before, after)) = rest.split_once("](") {
        text += before;
        rest = after.split_once(')').map_or("", |(_, after)| after);
    }
    text += rest;
    let kept = |c: char| match c {
        ' ' => Some('-'),
        '-' | '_' => Some(c),
        _ => c.is_alphanumeric().then_some(c),
    };
    text.chars().filter_map(kept).flat_map(char::to_lowercase).collect()
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
