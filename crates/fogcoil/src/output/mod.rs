//! Results on their way out: files whole or not at all, standard output without complaint when its reader has left.

mod design;
mod vtu;

use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::Error;

pub use design::coil_file;
pub use vtu::vtu;

/// What a file is to hold.
pub enum Content<'a> {
    /// A text.
    Text(String),
    /// What this writes; it may be called more than once.
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

/// Writes all files: each under another name in its folder first, and renamed when all are complete.
///
/// What is not a regular file (a pipe, `/dev/null`) is written as it is.
///
/// # Errors
/// [`Error::Output`] names the file that cannot be written.
pub fn write_files(files: &[(&Path, Content)]) -> Result<(), Error> {
    let at = |file: &Path| {
        let file = file.to_owned();
        move |source| Error::Output { file, source }
    };
    let staged: Vec<Staged> =
        files.iter().map(|(path, content)| stage(path, content).map_err(at(path))).collect::<Result<_, _>>()?;
    for (staged, (path, content)) in staged.into_iter().zip(files) {
        match staged {
            Staged::Temporary(file, target) => file.persist(target).map(drop).map_err(|error| at(path)(error.error))?,
            Staged::Stream => fs::OpenOptions::new()
                .write(true)
                .open(path)
                .and_then(|mut stream| unless_reader_left(content.write_to(&mut stream)))
                .map_err(at(path))?,
        }
    }
    Ok(())
}

/// Writes a new file, whole or not at all; one that exists stays as it is.
///
/// # Errors
/// [`Error::Usage`] if the file exists, [`Error::Output`] if it cannot be written.
pub fn write_new(path: &Path, text: &str) -> Result<(), Error> {
    let written = temporary(path).and_then(|mut file| {
        file.write_all(text.as_bytes())?;
        file.as_file().sync_all()?;
        file.persist_noclobber(path).map(drop).map_err(|error| error.error)
    });
    written.map_err(|source| match source.kind() {
        ErrorKind::AlreadyExists => {
            let remedy = "give another name, or move it away first";
            Error::Usage(format!("{}: exists and is left as it is; {remedy}", path.display()))
        }
        _ => Error::Output { file: path.to_owned(), source },
    })
}

enum Staged {
    /// Complete under another name, to be renamed to the target.
    Temporary(NamedTempFile, PathBuf),
    /// Cannot be replaced.
    Stream,
}

fn stage(path: &Path, content: &Content) -> io::Result<Staged> {
    let target = match fs::metadata(path) {
        Ok(kind) if kind.is_dir() => return Err(io::Error::new(ErrorKind::IsADirectory, "is a directory")),
        Ok(kind) if !kind.is_file() => return Ok(Staged::Stream),
        Ok(_) => path.canonicalize()?, // replace what a link points to, not the link
        Err(_) => path.to_owned(),
    };
    let mut file = temporary(&target)?;
    content.write_to(&mut file)?;
    file.as_file().sync_all()?;
    Ok(Staged::Temporary(file, target))
}

/// A temporary file beside `target` with the permissions of an ordinary one.
fn temporary(target: &Path) -> io::Result<NamedTempFile> {
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".fogcoil-");
    #[cfg(unix)]
    let permissions: fs::Permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    builder.tempfile_in(folder)
}

/// Writes to standard output; a reader that has left is no error.
///
/// # Errors
/// [`Error::Stdout`] if it cannot be written for another reason.
pub fn print(text: &str) -> Result<(), Error> {
    let mut stdout = io::stdout().lock();
    unless_reader_left(stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush())).map_err(Error::Stdout)
}

fn unless_reader_left(written: io::Result<()>) -> io::Result<()> {
    written.or_else(|error| if error.kind() == ErrorKind::BrokenPipe { Ok(()) } else { Err(error) })
}

/// Checks that no result would overwrite an input or another result.
///
/// # Errors
/// [`Error::Usage`] names the file.
pub fn check_distinct(inputs: &[&Path], outputs: &[Option<&Path>]) -> Result<(), Error> {
    let place = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut taken: Vec<PathBuf> = inputs.iter().map(|input| place(input)).collect();
    for output in outputs.iter().flatten() {
        let (target, regular) = (place(output), fs::metadata(output).map_or(true, |kind| kind.is_file()));
        if regular && taken.contains(&target) {
            let problem = "is given twice, or is an input; give each result a file of its own";
            return Err(Error::Usage(format!("{}: {problem}", output.display())));
        }
        taken.push(target);
    }
    Ok(())
}
