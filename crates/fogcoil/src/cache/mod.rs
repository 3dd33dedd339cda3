//! Models that have been built once, kept on disk by the content of their inputs.
//!
//! A file is named by the SHA-256 of everything the model depends on: the format, the build of the program, the purpose and the key. It
//! holds a magic number, the format, a SHA-256 over name and payload, and the payload (postcard; doubles bit for bit). A file that is
//! truncated, spoilt or of another model fails the check, and its model is built anew. A checksum is no signature: on Unix a file counts only
//! if it belongs to the user, or to the system's administrator, and nobody else may write to it. Nothing here is an error: where no file can be
//! read or written, models are built each time.

use std::env;
use std::fs::{self, File};
use std::io::{Read, Write};
#[cfg(unix)]
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

use serde::Serialize;
use serde::de::DeserializeOwned;
use sha2::{Digest, Sha256};

use crate::input::hexadecimal;

/// First bytes of a file.
const MAGIC: [u8; 8] = *b"fogcoil\0";
/// Changes when the layout of files or names does.
const FORMAT: u32 = 1;
/// Before the payload: magic, format, checksum.
const HEADER: usize = MAGIC.len() + size_of::<u32>() + size_of::<Name>();
/// End of the name of each file of the cache, temporary ones included; no other file is ever removed.
const SUFFIX: &str = ".fogcoil-model";
/// Largest file \[bytes\]; a larger model is not kept.
const LARGEST: u64 = 256 << 20;
/// Limit of all files together \[bytes\]; beyond it, the longest unused are removed.
const MOST: u64 = 1 << 30;

type Name = [u8; 32];

/// Origin of a model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// It was built now.
    Built,
    /// It was found in the cache.
    Cached,
}

/// A folder of models, or none.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Cache {
    folder: Option<PathBuf>,
    most: u64,
    /// The file that holds this code; `None`: the executable.
    code: Option<PathBuf>,
}

impl Cache {
    /// No cache: every model is built.
    pub const NONE: Self = Self { folder: None, most: 0, code: None };

    /// Models in `folder`, which is made when the first is kept.
    pub fn in_folder(folder: impl Into<PathBuf>) -> Self {
        Self { folder: Some(folder.into()), most: MOST, code: None }
    }

    /// The same for code that is not in the executable but in a library that it loads, `file`.
    #[must_use]
    pub fn of_code_in(self, file: impl Into<PathBuf>) -> Self {
        Self { code: Some(file.into()), ..self }
    }

    /// The file that holds this code, if it is not the executable.
    pub(crate) fn code(&self) -> Option<&Path> {
        self.code.as_deref()
    }

    /// The user's cache: `$FOGCOIL_CACHE`, else `fogcoil` in `$XDG_CACHE_HOME`, else `.cache/fogcoil` in the home folder.
    pub fn of_user() -> Self {
        let from = |variable: &str| env::var_os(variable).filter(|value| !value.is_empty()).map(PathBuf::from);
        // the XDG specification has relative paths ignored
        let shared = || from("XDG_CACHE_HOME").filter(|path| path.is_absolute()).map(|path| path.join("fogcoil"));
        let home = || env::home_dir().filter(|path| path.is_absolute()).map(|path| path.join(".cache").join("fogcoil"));
        from("FOGCOIL_CACHE").or_else(shared).or_else(home).map_or(Self::NONE, Self::in_folder)
    }

    /// The model for `purpose` made from `key`: from the folder if it is there, else from `build`, and then kept.
    ///
    /// `key` must hold all that `build` depends on; models of different types need different purposes.
    ///
    /// # Errors
    /// The error of `build`.
    pub fn load_or_build<T: Serialize + DeserializeOwned, E>(
        &self,
        purpose: &str,
        key: &impl Serialize,
        build: impl FnOnce() -> Result<T, E>,
    ) -> Result<(T, Source), E> {
        let place = self.folder.as_ref().and_then(|folder| Some((folder, name(self.code.as_deref(), purpose, key)?)));
        let Some((folder, name)) = place else { return Ok((build()?, Source::Built)) };
        let file = folder.join(hexadecimal(&name) + SUFFIX);
        if let Some(model) = load(&file, &name) {
            return Ok((model, Source::Cached));
        }
        let model = build()?;
        // a model that cannot be kept is as good as one that can
        if keep(folder, &file, &name, &model).is_some() {
            make_room(folder, self.most);
        }
        Ok((model, Source::Built))
    }
}

/// Identity of the code's file, so that no model outlives the code that made it: its length \[bytes\], its instant of writing, and on Unix its
/// place on the disk and the instant when it was put there, as archives and packages may give every build the same instant of writing.
fn this_build(code: Option<&Path>) -> Option<impl Serialize + use<>> {
    let about = fs::metadata(code.map_or_else(env::current_exe, |file| Ok(file.to_owned())).ok()?).ok()?;
    #[cfg(unix)]
    let place = (about.dev(), about.ino(), about.ctime(), about.ctime_nsec());
    #[cfg(not(unix))]
    let place = ();
    Some((about.len(), about.modified().ok()?.duration_since(UNIX_EPOCH).ok()?, place))
}

/// Whether nobody but the user, or the system's administrator, can have written a file.
#[cfg(unix)]
fn is_ours(about: &fs::Metadata) -> bool {
    /// Write permission of a group or of everybody.
    const OTHERS: u32 = 0o022;
    [rustix::process::geteuid().as_raw(), 0].contains(&about.uid()) && about.mode() & OTHERS == 0
}

/// The same where files have other permissions: those of the user's folder.
#[cfg(not(unix))]
fn is_ours(_: &fs::Metadata) -> bool {
    true
}

fn name(code: Option<&Path>, purpose: &str, key: &impl Serialize) -> Option<Name> {
    let all = postcard::to_stdvec(&(FORMAT, env!("CARGO_PKG_VERSION"), this_build(code)?, purpose, key)).ok()?;
    Some(Sha256::digest(all).into())
}

/// Checksum over payload and name: a sound file under another's name is not taken for it.
fn checksum(name: &Name, payload: &[u8]) -> Name {
    Sha256::new().chain_update(name).chain_update(payload).finalize().into()
}

fn load<T: DeserializeOwned>(path: &Path, name: &Name) -> Option<T> {
    if !fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let file = File::open(path).ok()?;
    if !is_ours(&file.metadata().ok()?) {
        return None;
    }
    let mut bytes = Vec::new();
    // one byte more than allowed: what is too long fails like what is spoilt
    (&file).take(LARGEST + 1).read_to_end(&mut bytes).ok()?;
    let (header, payload) = bytes.split_at_checked(HEADER).filter(|_| bytes.len() as u64 <= LARGEST)?;
    if header != self::header(name, payload) {
        return None;
    }
    let model = postcard::from_bytes(payload).ok()?;
    // the longest unused go first; if the system does not let us, the oldest
    let _ = file.set_modified(SystemTime::now());
    Some(model)
}

fn header(name: &Name, payload: &[u8]) -> Vec<u8> {
    [&MAGIC[..], &FORMAT.to_le_bytes(), &checksum(name, payload)].concat()
}

/// Writes under another name first, so that no reader sees half a file.
fn keep(folder: &Path, path: &Path, name: &Name, model: &impl Serialize) -> Option<()> {
    let payload = postcard::to_stdvec(model).ok().filter(|payload| (payload.len() + HEADER) as u64 <= LARGEST)?;
    fs::create_dir_all(folder).ok()?;
    let mut file = tempfile::Builder::new().suffix(SUFFIX).tempfile_in(folder).ok()?;
    file.write_all(&header(name, &payload)).and_then(|()| file.write_all(&payload)).ok()?;
    file.persist(path).ok().map(drop)
}

/// Removes the longest unused files of the cache until all together have at most `most` bytes.
fn make_room(folder: &Path, most: u64) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let ours = |entry: fs::DirEntry| {
        let about = entry.metadata().ok().filter(fs::Metadata::is_file)?;
        let named = entry.file_name().to_str()?.ends_with(SUFFIX);
        named.then_some((about.modified().ok()?, about.len(), entry.path()))
    };
    let mut files: Vec<(SystemTime, u64, PathBuf)> = entries.flatten().filter_map(ours).collect();
    files.sort();
    let mut total: u64 = files.iter().map(|(_, length, _)| length).sum();
    for (_, length, path) in files {
        if total <= most {
            break;
        }
        // another process may have been quicker
        let _ = fs::remove_file(path);
        total -= length;
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
