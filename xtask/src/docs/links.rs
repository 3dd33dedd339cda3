//! Links and anchors, and whether every page can be reached.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use super::page::Page;

/// The book's table of contents.
pub(super) const SUMMARY: &str = "docs/SUMMARY.md";

/// Faults of the links of `pages`, which are by path.
pub(super) fn faults(root: &Path, pages: &BTreeMap<PathBuf, Page>) -> Vec<String> {
    let mut faults = Vec::new();
    for page in pages.values() {
        for link in &page.links {
            if let Err(problem) = check(root, pages, &page.path, &link.target) {
                faults.push(format!("{}:{}: `{}`: {problem}", page.path.display(), link.line, link.target));
            }
        }
    }
    let summary = pages.get(Path::new(SUMMARY)).map(|page| &page.links[..]).unwrap_or_default();
    let listed: Vec<PathBuf> = summary.iter().map(|link| resolve(Path::new(SUMMARY), &link.target)).collect();
    let lost = pages.keys().filter(|path| path.starts_with("docs") && *path != Path::new(SUMMARY) && !listed.contains(path));
    faults.extend(lost.map(|path| format!("{}: is not in {SUMMARY}; list it there", path.display())));
    faults
}

fn check(root: &Path, pages: &BTreeMap<PathBuf, Page>, from: &Path, target: &str) -> Result<(), String> {
    if target.contains("://") || target.starts_with("mailto:") {
        return Ok(());
    }
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let file = if path.is_empty() { from.to_owned() } else { resolve(from, path) };
    if !root.join(&file).exists() {
        return Err("there is no such file".into());
    }
    let is_page = file.extension().is_some_and(|e| e == "md");
    if is_page && from.starts_with("docs") && !file.starts_with("docs") {
        return Err("the book holds docs/ alone and makes this a link to HTML; link the folder, or name the file".into());
    }
    match pages.get(&file) {
        Some(page) if !anchor.is_empty() && !page.anchors.contains(anchor) => {
            Err(format!("{} has no heading for `#{anchor}`", file.display()))
        }
        _ => Ok(()),
    }
}

/// The file that `target` means on the page `from`, both from the root.
fn resolve(from: &Path, target: &str) -> PathBuf {
    let mut path = from.parent().unwrap_or(Path::new("")).to_owned();
    for part in Path::new(target).components() {
        match part {
            Component::ParentDir => {
                path.pop();
            }
            Component::Normal(name) => path.push(name),
            _ => {}
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn dead_links_and_lost_pages_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        fs::create_dir_all(root.join("docs/deep")).unwrap();
        for (path, text) in [
            ("README.md", "[docs](docs/a.md#one)"),
            (SUMMARY, "- [a](a.md)\n- [b](deep/b.md)"),
            ("docs/a.md", "# One\n[b](deep/b.md) [gone](gone.md) [up](#two)\n[readme](../README.md)"),
            ("docs/deep/b.md", "[a](../a.md#one) [docs](..)"),
            ("docs/lost.md", ""),
        ] {
            fs::write(root.join(path), text).unwrap();
        }
        let paths = ["README.md", SUMMARY, "docs/a.md", "docs/deep/b.md", "docs/lost.md"].map(PathBuf::from);
        let pages = paths.into_iter().map(|path| (path.clone(), Page::read(root, &path).unwrap())).collect();
        let faults = faults(root, &pages);
        let starts = ["docs/a.md:2: `gone.md`", "docs/a.md:2: `#two`", "docs/a.md:3: `../README.md`", "docs/lost.md: is not in"];
        assert_eq!(faults.len(), starts.len(), "{faults:?}");
        assert!(faults.iter().zip(starts).all(|(fault, start)| fault.starts_with(start)), "{faults:?}");
    }
}
