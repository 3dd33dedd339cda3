//! The repository's files: read whole, written whole, renewed between two marks.

use std::path::{Path, PathBuf};

use fogcoil::output::{self, Content};

use crate::Failure;

/// The repository's root.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).map_or_else(PathBuf::new, Path::to_path_buf)
}

/// The failure at `path`, in words.
pub fn failed(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    move |e| Failure(format!("{}: {e}", path.display()))
}

/// The text of a file. [`Failure`] names the file.
pub fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(failed(path))
}

/// Writes a file, whole or not at all. [`Failure`] names the file.
pub fn write(path: &Path, text: &str) -> Result<(), Failure> {
    Ok(output::write_files(&[(path, Content::Text(text.to_owned()))])?)
}

/// Writes files, all or none, and makes the folders they lie in. [`Failure`] names the file or folder.
pub fn write_all(files: &[(PathBuf, String)]) -> Result<(), Failure> {
    for folder in files.iter().filter_map(|(file, _)| file.parent()) {
        std::fs::create_dir_all(folder).map_err(failed(folder))?;
    }
    let contents = files.iter().map(|(file, text)| (file.as_path(), Content::Text(text.clone())));
    Ok(output::write_files(&contents.collect::<Vec<_>>())?)
}

/// The names in a folder, in order. [`Failure`] names the folder.
pub fn names(folder: &Path) -> Result<Vec<String>, Failure> {
    let name =
        |entry: std::io::Result<std::fs::DirEntry>| Ok(entry.map_err(failed(folder))?.file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = std::fs::read_dir(folder).map_err(failed(folder))?.map(name).collect::<Result<_, Failure>>()?;
    names.sort();
    Ok(names)
}

/// All files below a folder, by their paths from there, in order. [`Failure`] names the folder that cannot be read.
pub fn below(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let (mut files, mut folders) = (Vec::new(), vec![PathBuf::new()]);
    while let Some(inner) = folders.pop() {
        for name in names(&folder.join(&inner))? {
            let path = inner.join(name);
            if folder.join(&path).is_dir() { &mut folders } else { &mut files }.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// Puts `text` between the lines `begin` and `end` of the page at `path`.
/// [`Failure`] if the page cannot be read or written, or lacks a mark.
pub fn renew(path: &Path, [begin, end]: [&str; 2], text: &str) -> Result<(), Failure> {
    let old = read(path)?;
    let missing = || Failure(format!("{} lacks the lines {begin:?} and {end:?}", path.display()));
    let (before, rest) = old.split_once(begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(end).ok_or_else(missing)?;
    write(path, &format!("{before}{begin}{text}{end}{after}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_is_renewed_between_its_marks_alone() {
        let folder = tempfile::tempdir().unwrap();
        let page = folder.path().join("page.md");
        write(&page, "head\n<!-- a -->old<!-- a end -->\ntail").unwrap();
        renew(&page, ["<!-- a -->", "<!-- a end -->"], "\nnew\n").unwrap();
        assert_eq!(read(&page).unwrap(), "head\n<!-- a -->\nnew\n<!-- a end -->\ntail");
        assert!(renew(&page, ["<!-- b -->", "<!-- b end -->"], "").unwrap_err().0.contains("lacks the lines"));
        write_all(&[(folder.path().join("b/c"), "c".into()), (folder.path().join("a"), "a".into())]).unwrap();
        assert_eq!(names(folder.path()).unwrap(), ["a", "b", "page.md"]);
        assert_eq!(below(folder.path()).unwrap(), ["a", "b/c", "page.md"].map(PathBuf::from));
        assert!(read(&folder.path().join("none")).unwrap_err().0.contains("none: "));
    }
}
