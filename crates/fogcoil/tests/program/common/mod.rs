//! The reference files, a folder to spoil them in, and the built program.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output};

pub(crate) const CELL: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/cell-reference.ron"));
/// The reference coil as the units in fixtures/concealed are built to it: right to a fifth of a per cent.
pub(crate) const CLEAN_COIL: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/coil.ron"));
pub(crate) const COIL: &str = include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/coil-reference.ron"));

pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        fs::write(self.path(name), content).unwrap();
        self.path(name)
    }

    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(self.0.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs the program in the folder; models are kept from run to run, see [`Folder::run_with_cache`].
    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        self.run_with_cache(arguments, concat!(env!("CARGO_TARGET_TMPDIR"), "/cache"))
    }

    /// Runs the program in the folder with its models in `cache`.
    pub(crate) fn run_with_cache(&self, arguments: &[&str], cache: &str) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_fogcoil"));
        command.args(arguments).env("FOGCOIL_CACHE", cache).current_dir(self.0.path()).output().unwrap()
    }
}

/// `text` with the one occurrence of `old` replaced.
pub(crate) fn change(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "`{old}` must occur once");
    text.replacen(old, new, 1)
}

/// Line of the one occurrence of `word`, from 1.
pub(crate) fn line_of(text: &str, word: &str) -> usize {
    assert_eq!(text.matches(word).count(), 1, "`{word}` must occur once");
    1 + text[..text.find(word).unwrap()].matches('\n').count()
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

/// A schema of docs/schema.
pub(crate) fn schema(name: &str) -> serde_json::Value {
    let path = format!("{}/../../docs/schema/{name}.schema.json", env!("CARGO_MANIFEST_DIR"));
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}
