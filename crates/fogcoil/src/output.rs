//! Results on their way out: files whole or not at all, standard output without complaint when its reader has left.

use std::fs;
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::Error;

/// Writes all files: each under another name in its folder first, and renamed when all are complete.
///
/// What is not a regular file (a pipe, `/dev/null`) is written as it is.
///
/// # Errors
/// [`Error::Output`] names the file that cannot be written.
pub fn write_files(files: &[(&Path, String)]) -> Result<(), Error> {
    let at = |file: &Path| {
        let file = file.to_owned();
        move |source| Error::Output { file, source }
    };
    let staged: Vec<Staged> = files.iter().map(|(path, text)| stage(path, text).map_err(at(path))).collect::<Result<_, _>>()?;
    for (staged, (path, text)) in staged.into_iter().zip(files) {
        match staged {
            Staged::Temporary(file, target) => file.persist(target).map(drop).map_err(|error| at(path)(error.error))?,
            Staged::Stream => fs::OpenOptions::new()
                .write(true)
                .open(path)
                .and_then(|mut stream| unless_reader_left(stream.write_all(text.as_bytes())))
                .map_err(at(path))?,
        }
    }
    Ok(())
}

enum Staged {
    /// Complete under another name, to be renamed to the target.
    Temporary(NamedTempFile, PathBuf),
    /// Cannot be replaced.
    Stream,
}

fn stage(path: &Path, text: &str) -> io::Result<Staged> {
    let target = match fs::metadata(path) {
        Ok(kind) if kind.is_dir() => return Err(io::Error::new(ErrorKind::IsADirectory, "is a directory")),
        Ok(kind) if !kind.is_file() => return Ok(Staged::Stream),
        Ok(_) => path.canonicalize()?, // replace what a link points to, not the link
        Err(_) => path.to_owned(),
    };
    let folder = target.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = temporary(folder)?;
    file.write_all(text.as_bytes())?;
    file.as_file().sync_all()?;
    Ok(Staged::Temporary(file, target))
}

/// A temporary file with the permissions of an ordinary one.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
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

/// Checks that no result would overwrite the case file or another result.
///
/// # Errors
/// [`Error::Usage`] names the file.
pub fn check_distinct(input: &Path, outputs: &[Option<&Path>]) -> Result<(), Error> {
    let place = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let mut taken = vec![place(input)];
    for output in outputs.iter().flatten() {
        let (target, regular) = (place(output), fs::metadata(output).map_or(true, |kind| kind.is_file()));
        if regular && taken.contains(&target) {
            let problem = "is given twice, or is the case file itself; give each result a file of its own";
            return Err(Error::Usage(format!("{}: {problem}", output.display())));
        }
        taken.push(target);
    }
    Ok(())
}
