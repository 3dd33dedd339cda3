//! Results on their way out: a design as the case file that reads back as it was, files whole or not at all.

mod entries;
mod vtu;

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use coil::{Design, Tolerances};
use ron::ser::{PrettyConfig, to_string_pretty};
use tempfile::NamedTempFile;

use crate::Error;
use crate::input::CoilFile;
use crate::shown_path;

pub use entries::design_entries;
pub use vtu::vtu;

/// Groups nested deeper than this stand on one line.
const LINES: usize = 2;

/// The content of a coil file for `design` that a unit is `known` to keep, with `comments` above it, a line each.
///
/// Every number reads back to the same double; one that no decimal in the file's unit gives, to a neighbour of it.
pub fn coil_file(name: &str, design: &Design, known: &Tolerances, comments: &[String]) -> String {
    let layout = PrettyConfig::new().depth_limit(LINES).new_line("\n");
    // the types of a coil file have nothing that RON cannot say
    let text = to_string_pretty(&CoilFile::new(name, design, known), layout).unwrap_or_default();
    let comments = comments.iter().flat_map(|comment| comment.lines()).map(|line| format!("// {line}\n"));
    comments.chain([text, "\n".to_owned()]).collect()
}

/// Content of a file.
pub enum Content<'a> {
    /// A text.
    Text(String),
    /// The bytes that this writes; it may be called more than once.
    Written(&'a dyn Fn(&mut dyn Write) -> io::Result<()>),
}

impl Content<'_> {
    fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut out = BufWriter::with_capacity(BUFFER, out);
        match self {
            Self::Text(text) => out.write_all(text.as_bytes())?,
            Self::Written(write) => write(&mut out)?,
        }
        out.flush()
    }
}

/// Bytes that go to a file at once.
const BUFFER: usize = 1 << 18;

/// A file that is given up when `stop` is set.
struct Stoppable<'a> {
    file: &'a mut fs::File,
    stop: &'a AtomicBool,
}

impl Write for Stoppable<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.stop.load(Ordering::Relaxed) {
            return Err(io::Error::other("given up"));
        }
        self.file.write(&bytes[..bytes.len().min(BUFFER)])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Writes all files: each under another name in its folder first, and renamed when all are complete.
///
/// # Errors
/// [`Error::Usage`] if a path leads to no plain file, [`Error::Output`] if the file cannot be written.
pub fn write_files(files: &[(&Path, Content)]) -> Result<(), Error> {
    write_files_unless(&AtomicBool::new(false), files)
}

/// [`write_files`], given up when `stop` is set before all are complete: then none is left.
///
/// # Errors
/// As [`write_files`].
pub fn write_files_unless(stop: &AtomicBool, files: &[(&Path, Content)]) -> Result<(), Error> {
    let stage = |(path, content): &(&Path, Content)| {
        let target = place(path)?;
        let staged = temporary(&target).and_then(|mut file| {
            content.write_to(&mut Stoppable { file: file.as_file_mut(), stop })?;
            file.as_file().sync_all().map(|()| file)
        });
        staged.map(|file| (file, target)).map_err(|source| Error::Output { file: path.to_path_buf(), source })
    };
    let staged: Vec<(NamedTempFile, PathBuf)> = files.iter().map(stage).collect::<Result<_, _>>()?;
    for ((file, target), (path, _)) in staged.into_iter().zip(files) {
        file.persist(target).map_err(|error| Error::Output { file: path.to_path_buf(), source: error.error })?;
    }
    Ok(())
}

/// Writes a new file, whole or not at all; one that exists stays as it is.
///
/// # Errors
/// [`Error::Usage`] if the file exists or can be none, [`Error::Output`] if it cannot be written.
pub fn write_new(path: &Path, text: &str) -> Result<(), Error> {
    let target = place(path)?;
    let written = temporary(&target).and_then(|mut file| {
        file.as_file_mut().write_all(text.as_bytes())?;
        file.as_file().sync_all()?;
        file.persist_noclobber(target).map(drop).map_err(|error| error.error)
    });
    written.map_err(|source| match source.kind() {
        ErrorKind::AlreadyExists => {
            let remedy = "give another name, or move it away first";
            Error::Usage(format!("{}: exists and is left as it is; {remedy}", shown_path(path)))
        }
        _ => Error::Output { file: path.to_owned(), source },
    })
}

/// Makes a folder and those above it, if they are not there.
///
/// # Errors
/// [`Error::Output`] if it cannot be made.
pub fn make_folder(folder: &Path) -> Result<(), Error> {
    fs::create_dir_all(folder).map_err(|source| Error::Output { file: folder.to_owned(), source })
}

/// Place where the file at `path` is or will be: in a folder that exists, links resolved.
fn place(path: &Path) -> Result<PathBuf, Error> {
    const STREAM: &str = "is a device or a pipe; name a file (only a summary, with --json, goes to standard output)";
    let refuse = |problem: &str| Error::Usage(format!("{}: {problem}", shown_path(path)));
    if path == Path::new("-") {
        return Err(refuse("is no file; name one (only a summary, with --json, goes to standard output)"));
    }
    let name = path.file_name().ok_or_else(|| refuse("names no file; give a path that does"))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let found = folder.canonicalize().ok().filter(|found| found.is_dir());
    let found = found.ok_or_else(|| refuse(&format!("there is no folder {}; make it, or name another", shown_path(folder))))?;
    // what stands there may lead to a plain file that someone else is writing, a log for instance
    if found == Path::new("/dev") || found.starts_with("/dev/fd") || found.starts_with("/proc") {
        return Err(refuse(STREAM));
    }
    match fs::metadata(path) {
        Ok(about) if about.is_dir() => Err(refuse("is a folder; name a file in it")),
        Ok(about) if !about.is_file() => Err(refuse(STREAM)),
        // what a link points to is replaced, not the link
        Ok(_) => path.canonicalize().map_err(|source| Error::Output { file: path.to_owned(), source }),
        Err(_) => Ok(found.join(name)),
    }
}

/// A temporary file beside `target` with the permissions of an ordinary one.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".fogcoil-");
    #[cfg(unix)]
    let permissions: fs::Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    // the whole error would name the temporary file
    builder.tempfile_in(target.parent().unwrap_or(target)).map_err(|error| error.kind().into())
}

/// Checks before anything is computed that every result can be written, and would overwrite neither an input nor another result.
///
/// # Errors
/// [`Error::Usage`] or [`Error::Output`] names the file.
pub fn check_outputs<P: AsRef<Path>>(inputs: &[P], outputs: &[Option<&Path>]) -> Result<(), Error> {
    let mut taken: Vec<PathBuf> = inputs.iter().filter_map(|input| place(input.as_ref()).ok()).collect();
    for output in outputs.iter().flatten() {
        let target = place(output)?;
        if taken.contains(&target) {
            let problem = "is given twice, or is an input; give each result a file of its own";
            return Err(Error::Usage(format!("{}: {problem}", shown_path(output))));
        }
        // a trial; the file is gone at once
        temporary(&target).map_err(|source| Error::Output { file: output.to_path_buf(), source })?;
        taken.push(target);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_given_up_leave_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let [old, new] = ["old.csv", "new.csv"].map(|name| folder.path().join(name));
        fs::write(&old, "old").unwrap();
        let stop = AtomicBool::new(false);
        let written = |out: &mut dyn Write| {
            stop.store(true, Ordering::Relaxed);
            out.write_all(&vec![b'x'; 3 * BUFFER])
        };
        let files = [(old.as_path(), Content::Text("new".to_owned())), (new.as_path(), Content::Written(&written))];
        let error = write_files_unless(&stop, &files).unwrap_err();
        assert!(error.to_string().contains("new.csv: cannot be written: given up"), "{error}");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        assert_eq!(fs::read_to_string(&old).unwrap(), "old");
        stop.store(false, Ordering::Relaxed);
        write_files_unless(&stop, &files[..1]).unwrap();
        assert_eq!(fs::read_to_string(&old).unwrap(), "new");
    }
}
