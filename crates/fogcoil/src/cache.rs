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
mod tests {
    use super::*;
    use crate::input::read_coil;
    use coil::{
        Design, Drive, Dynamics, FactorsAt, Fidelity, Heater, Mechanics, MeshFineness, Mount, Opening, Profile, STANDARD, Side,
    };
    use serde_json::Value;
    use std::convert::Infallible;
    use std::time::Duration;

    const QUICK: Fidelity = Fidelity { resolution: MeshFineness { order: 2, layers: 1, ratio: 0.2 }, modes: 6 };

    fn reference() -> Design {
        read_coil(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron").as_ref()).unwrap().design
    }

    /// A cache in a new folder with one model in it, and the model's file.
    fn with_one(model: &[f64]) -> (tempfile::TempDir, Cache, PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::in_folder(folder.path().join("made/on/demand"));
        assert_eq!(get(&cache, 1, model), (model.to_vec(), Source::Built));
        let file = fs::read_dir(folder.path().join("made/on/demand")).unwrap().next().unwrap().unwrap().path();
        (folder, cache, file)
    }

    fn get(cache: &Cache, key: u32, built: &[f64]) -> (Vec<f64>, Source) {
        cache.load_or_build("test", &key, || Ok::<_, Infallible>(built.to_vec())).unwrap()
    }

    const MODEL: [f64; 4] = [0.1, -0.0, f64::NEG_INFINITY, 5e-324];

    #[test]
    fn what_was_kept_comes_back_bit_for_bit_and_nothing_else_does() {
        let (_folder, cache, _) = with_one(&MODEL);
        let (found, source) = get(&cache, 1, &[]);
        assert_eq!(source, Source::Cached);
        assert!(found.iter().zip(&MODEL).all(|(a, b)| a.to_bits() == b.to_bits()) && found.len() == 4);
        assert_eq!(get(&cache, 2, &[2.0]), (vec![2.0], Source::Built));
        let other = cache.load_or_build("other", &1u32, || Ok::<_, Infallible>(vec![3.0])).unwrap();
        assert_eq!(other, (vec![3.0], Source::Built));
        assert_eq!(get(&Cache::NONE, 1, &[4.0]), (vec![4.0], Source::Built));
        let failed: Result<(Vec<f64>, Source), &str> = cache.load_or_build("test", &9u32, || Err("no"));
        assert_eq!(failed, Err("no"));
        assert_eq!(get(&cache, 9, &[5.0]).1, Source::Built, "a failure is not kept");
    }

    #[test]
    fn a_spoilt_file_is_built_anew() {
        let (folder, cache, file) = with_one(&MODEL);
        let sound = fs::read(&file).unwrap();
        let rebuilt = |bytes: &[u8]| {
            fs::write(&file, bytes).unwrap();
            assert_eq!(get(&cache, 1, &[7.0]), (vec![7.0], Source::Built), "{} bytes", bytes.len());
            assert_eq!(get(&cache, 1, &[]), (vec![7.0], Source::Cached), "and kept again");
        };
        (0..sound.len()).for_each(|length| rebuilt(&sound[..length]));
        for byte in 0..sound.len() {
            let mut spoilt = sound.clone();
            spoilt[byte] ^= 0x10;
            rebuilt(&spoilt);
        }
        rebuilt(&[&sound[..], b"x"].concat());
        // a length that no memory holds, under a checksum that is right
        let digits = file.file_name().unwrap().to_str().unwrap();
        let name: Name = std::array::from_fn(|i| u8::from_str_radix(&digits[2 * i..2 * i + 2], 16).unwrap());
        let hostile = [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01, 0, 0];
        rebuilt(&[&header(&name, &hostile)[..], &hostile].concat());
        // a file of any length takes no more memory than a model may
        File::create(&file).unwrap().set_len(1 << 30).unwrap();
        assert_eq!(get(&cache, 1, &[8.0]), (vec![8.0], Source::Built));
        // a sound file of another model
        assert_eq!(get(&cache, 2, &[2.0]).1, Source::Built);
        let all = || fs::read_dir(folder.path().join("made/on/demand")).unwrap().map(|e| e.unwrap().path());
        let other = all().find(|path| *path != file).unwrap();
        fs::copy(other, &file).unwrap();
        assert_eq!(get(&cache, 1, &[9.0]), (vec![9.0], Source::Built));
        assert_eq!(all().count(), 2, "no temporary file stays");
        fs::remove_file(&file).unwrap();
        fs::create_dir(&file).unwrap();
        assert_eq!(get(&cache, 1, &[6.0]), (vec![6.0], Source::Built), "a folder in its place");
    }

    #[cfg(unix)]
    #[test]
    fn a_file_that_others_can_have_written_is_built_anew() {
        use std::os::unix::fs::{PermissionsExt, chown};
        let (_folder, cache, file) = with_one(&MODEL);
        fs::set_permissions(&file, fs::Permissions::from_mode(0o666)).unwrap();
        assert_eq!(get(&cache, 1, &[7.0]), (vec![7.0], Source::Built));
        assert_eq!(get(&cache, 1, &[]), (vec![7.0], Source::Cached), "and kept again");
        // only the administrator can give a file away
        if chown(&file, Some(65534), None).is_ok() {
            assert_eq!(get(&cache, 1, &[8.0]), (vec![8.0], Source::Built));
            assert_eq!(get(&cache, 1, &[]), (vec![8.0], Source::Cached), "and kept again");
        }
    }

    #[cfg(unix)]
    #[test]
    fn another_build_of_the_same_length_and_instant_is_another() {
        let folder = tempfile::tempdir().unwrap();
        let code = folder.path().join("code");
        let install = |content: &str| {
            let new = folder.path().join("new");
            fs::write(&new, content).unwrap();
            File::options().write(true).open(&new).unwrap().set_modified(UNIX_EPOCH).unwrap();
            fs::rename(&new, &code).unwrap();
        };
        let cache = Cache::in_folder(folder.path().join("cache")).of_code_in(&code);
        install("one");
        assert_eq!(get(&cache, 1, &[1.0]), (vec![1.0], Source::Built));
        assert_eq!(get(&cache, 1, &[]), (vec![1.0], Source::Cached));
        install("two");
        assert_eq!(get(&cache, 1, &[2.0]), (vec![2.0], Source::Built));
    }

    #[test]
    fn where_nothing_can_be_written_models_are_built() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, "not a folder").unwrap();
        for cache in [Cache::in_folder(&file), Cache::in_folder(file.join("below"))] {
            for _ in 0..2 {
                assert_eq!(get(&cache, 1, &MODEL).1, Source::Built);
            }
        }
        assert_eq!(fs::read(&file).unwrap(), b"not a folder");
    }

    #[test]
    fn the_longest_unused_go_first_and_strangers_stay() {
        let (folder, mut cache, first) = with_one(&[0.0; 1000]);
        let stranger = folder.path().join("made/on/demand/notes.txt");
        fs::write(&stranger, [0; 100_000]).unwrap();
        cache.most = 25_000; // three files of 8 kB and their headers
        let touch = |path: &Path, seconds: u64| {
            File::options().write(true).open(path).unwrap().set_modified(UNIX_EPOCH + Duration::from_secs(seconds)).unwrap();
        };
        touch(&first, 1);
        for key in [2, 3] {
            assert_eq!(get(&cache, key, &[0.0; 1000]).1, Source::Built);
        }
        assert_eq!(get(&cache, 1, &[]).1, Source::Cached, "used, so no longer the oldest");
        let key_2 = folder.path().join("made/on/demand").join(hexadecimal(&name(None, "test", &2u32).unwrap()) + SUFFIX);
        touch(&key_2, 2);
        assert_eq!(get(&cache, 4, &[0.0; 1000]).1, Source::Built);
        assert!(stranger.exists() && !key_2.exists() && first.exists());
        assert_eq!(get(&cache, 2, &[0.0; 1000]).1, Source::Built);
        let sizes = fs::read_dir(folder.path().join("made/on/demand")).unwrap().map(|e| e.unwrap().metadata().unwrap().len());
        assert!(sizes.sum::<u64>() <= 25_000 + 100_000);
    }

    #[test]
    fn writers_at_the_same_time_do_not_meet() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::in_folder(folder.path());
        std::thread::scope(|scope| {
            for _ in 0..4 {
                scope.spawn(|| {
                    for key in 0..50 {
                        let model = vec![f64::from(key); 5000];
                        assert_eq!(get(&cache, key, &model).0, model);
                    }
                });
            }
        });
        assert!((0..50).all(|key| get(&cache, key, &[]).1 == Source::Cached));
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 50);
    }

    /// Calls `seen` with a copy of `value` for every number in it, changed by the least that a double allows, or by one.
    fn each_number_changed(value: &Value, whole: &mut dyn FnMut(Value)) {
        match value {
            Value::Number(number) => {
                let changed = match number.as_i64() {
                    Some(integer) => (integer + 1).into(),
                    None => number.as_f64().unwrap().next_up().into(),
                };
                whole(changed);
            }
            Value::Array(items) => (0..items.len()).for_each(|i| {
                each_number_changed(&items[i], &mut |item| {
                    let mut items = items.clone();
                    items[i] = item;
                    whole(Value::Array(items));
                });
            }),
            Value::Object(fields) => fields.iter().for_each(|(key, field)| {
                each_number_changed(field, &mut |field| {
                    let mut fields = fields.clone();
                    fields[key] = field;
                    whole(Value::Object(fields));
                });
            }),
            _ => {}
        }
    }

    #[test]
    fn any_number_of_a_design_changes_the_name() {
        let mut design = reference();
        design.heat.mounts.push(Mount { side: Side::Right, conductance: 50.5 });
        design.heat.heaters.push(Heater { side: Side::Right, power: 0.25 });
        design.heat.film = Some(5.5);
        let opening = Opening { side: Side::Right, below: -20.5, hysteresis: 5.5, fraction: 0.25 };
        let row = FactorsAt { temperature: -20.5, transverse_modulus: 1.5, transverse_expansion: 0.5 };
        let all = [
            Mechanics::Opening(opening),
            Mechanics::TemperatureTable(vec![row, row]),
            Mechanics::Relaxing { fraction: 0.25, time: 900.5 },
        ];
        for mechanics in all {
            let design = Design { mechanics, ..design.clone() };
            let key = |design: &Design| name(None, "dynamics", &(design, [Drive::Chamber], STANDARD)).unwrap();
            let (plain, value) = (key(&design), serde_json::to_value(&design).unwrap());
            let same: Design = serde_json::from_value(value.clone()).unwrap();
            assert_eq!((&same, key(&same)), (&design, plain));
            let (mut names, mut count) = (std::collections::HashSet::from([plain]), 0);
            each_number_changed(&value, &mut |changed| {
                count += 1;
                let changed: Design = serde_json::from_value(changed).unwrap();
                assert!(changed != design && names.insert(key(&changed)), "{changed:?}");
            });
            assert!(count > 50, "{count} numbers");
        }
        let key = |drives: &[Drive], fidelity: &Fidelity| name(None, "dynamics", &(&design, drives, fidelity)).unwrap();
        let plain = key(&[Drive::Chamber], &STANDARD);
        assert_ne!(plain, key(&[Drive::Chamber, Drive::Heaters], &STANDARD));
        assert_ne!(plain, key(&[Drive::Chamber], &Fidelity { modes: 41, ..STANDARD }));
    }

    #[test]
    fn a_model_from_the_cache_is_the_model() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::in_folder(folder.path());
        let opening = Opening { side: Side::Right, below: -20.0, hysteresis: 5.0, fraction: 0.5 };
        for mechanics in [Mechanics::Elastic, Mechanics::Relaxing { fraction: 0.5, time: 900.0 }, Mechanics::Opening(opening)] {
            let design = Design { mechanics, ..reference() };
            let get = || {
                let build = || Dynamics::new(&design, &[Drive::Chamber], &QUICK);
                cache.load_or_build("dynamics", &(&design, [Drive::Chamber], QUICK), build).unwrap()
            };
            let ((built, first), (found, second)) = (get(), get());
            assert_eq!((first, second), (Source::Built, Source::Cached));
            assert_eq!(built, found);
            let time: Vec<f64> = (0..50).map(|k| 30.0 * f64::from(k)).collect();
            let profile = Profile { drives: vec![time.iter().map(|t| -t / 30.0).collect()], time };
            assert_eq!(built.simulate(&profile).unwrap(), found.simulate(&profile).unwrap());
        }
    }
}
