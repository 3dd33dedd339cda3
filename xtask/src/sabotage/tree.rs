//! A copy of the crates, broken, built and tested.

use super::list::{CRATES, Sabotage};
use proof::Failure;
use proof::files::{below, failed};
use proof::program::hex;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Number of tests that ran, and the names (crate, binary, test) of those that failed.
#[derive(Clone, serde::Serialize, serde::Deserialize)]
pub(super) struct TestRun {
    pub(super) count: usize,
    pub(super) red: Vec<String>,
}

/// A workspace of its own with a target directory of its own; both are kept, so that a next run builds only what changed.
pub(super) struct Tree {
    root: PathBuf,
    target: PathBuf,
    /// of all sources
    hash: String,
}

/// Writes a file that does not hold `content` yet; one that does keeps its time stamp.
fn update(path: &Path, content: &[u8]) -> Result<(), Failure> {
    if fs::read(path).is_ok_and(|old| old == content) {
        return Ok(());
    }
    fs::write(path, content).map_err(failed(path))
}

impl Tree {
    /// The crates of the workspace at `root` and what they need of it, in target/sabotage.
    pub(super) fn copy(root: &Path) -> Result<Self, Failure> {
        let folder = root.join("target/sabotage");
        let mut tree = Self { root: folder.join("tree"), target: folder.join("target"), hash: String::new() };
        let mut hash = Sha256::new();
        let mut copied = |name: &Path, content: &[u8]| {
            hash.update(format!("{}\0{}\0", name.display(), content.len()));
            hash.update(content);
            let copy = tree.root.join(name);
            let folder = copy.parent().unwrap_or(&tree.root);
            fs::create_dir_all(folder).map_err(failed(folder))?;
            update(&copy, content)
        };
        for name in CRATES.map(|name| Path::new("crates").join(name)) {
            let sources = below(&root.join(&name))?;
            for source in &sources {
                let path = root.join(&name).join(source);
                copied(&name.join(source), &fs::read(&path).map_err(failed(&path))?)?;
            }
            let copies = tree.root.join(&name);
            for old in below(&copies)?.iter().filter(|old| !sources.contains(old)) {
                fs::remove_file(copies.join(old)).map_err(failed(old))?;
            }
        }
        let manifest = fs::read_to_string(root.join("Cargo.toml")).map_err(failed(root))?;
        let members =
            |line: &str| if line.starts_with("members =") { "members = [\"crates/*\"]".into() } else { line.to_owned() };
        let manifest: Vec<String> = manifest.lines().map(members).collect();
        copied(Path::new("Cargo.toml"), (manifest.join("\n") + "\n").as_bytes())?;
        fs::copy(root.join("Cargo.lock"), tree.root.join("Cargo.lock")).map_err(failed(root))?;
        tree.hash = hex(hash);
        Ok(tree)
    }

    /// Key of the outcome under `sabotage`: sources and change.
    pub(super) fn key(&self, sabotage: Option<&Sabotage>) -> String {
        let mut hash = Sha256::new();
        hash.update(&self.hash);
        for text in sabotage.iter().flat_map(|s| [s.file, s.find, s.replace]) {
            hash.update(format!("{text}\0"));
        }
        hex(hash)
    }

    /// The tests of what `sabotage` reaches while its file holds `text`.
    pub(super) fn sabotaged(&self, sabotage: &Sabotage, text: &str) -> Result<TestRun, Failure> {
        let path = self.root.join(sabotage.file);
        let sound = fs::read(&path).map_err(failed(&path))?;
        update(&path, text.as_bytes())?;
        let outcome =
            self.test(sabotage.reach()).map_err(|failure| Failure(format!("sabotage \"{}\": {failure}", sabotage.name)));
        update(&path, &sound)?;
        outcome
    }

    pub(super) fn test(&self, crates: &[&str]) -> Result<TestRun, Failure> {
        let mut outcome = TestRun { count: 0, red: Vec::new() };
        for (name, program) in self.build(crates)? {
            // nothing depends on chance: what random cases find must be found again
            let output = Command::new(&program)
                .current_dir(&self.root)
                .env("PROPTEST_RNG_SEED", "1")
                .env("PROPTEST_DISABLE_FAILURE_PERSISTENCE", "true")
                .stderr(Stdio::null())
                .output()
                .map_err(failed(&program))?;
            let before = outcome.red.len();
            let said = String::from_utf8_lossy(&output.stdout);
            for (test, verdict) in said.lines().filter_map(|line| line.strip_prefix("test ")?.rsplit_once(" ... ")) {
                outcome.count += 1;
                if verdict == "FAILED" {
                    outcome.red.push(format!("{name}::{test}"));
                }
            }
            if output.status.success() != (outcome.red.len() == before) {
                return Err(Failure(format!("{name} ended with {} unlike its tests:\n{said}", output.status)));
            }
        }
        Ok(outcome)
    }

    fn build(&self, crates: &[&str]) -> Result<Vec<(String, PathBuf)>, Failure> {
        let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let packages = CRATES.iter().flat_map(|name| ["--package", name]);
        let output = Command::new(cargo)
            .args(["test", "--no-run", "--lib", "--tests", "--message-format=json"])
            .args(packages)
            .current_dir(&self.root)
            .env("CARGO_TARGET_DIR", &self.target)
            .env("CARGO_PROFILE_DEV_DEBUG", "0")
            .output()
            .map_err(failed(&self.root))?;
        if !output.status.success() {
            return Err(Failure(format!("does not compile:\n{}", String::from_utf8_lossy(&output.stderr))));
        }
        let said = String::from_utf8_lossy(&output.stdout);
        let messages = said.lines().filter_map(|line| serde_json::from_str::<Value>(line).ok());
        let program = |message: Value| {
            let program = PathBuf::from(message["executable"].as_str()?);
            let folder = Path::new(message["manifest_path"].as_str()?).parent()?.file_name()?.to_str()?.to_owned();
            let binary = message["target"]["name"].as_str()?.to_owned();
            let of_library = binary.replace('_', "-") == folder;
            let name = if of_library { folder.clone() } else { format!("{folder}::{binary}") };
            crates.contains(&folder.as_str()).then_some((name, program))
        };
        let mut programs: Vec<_> = messages.filter_map(program).collect();
        programs.sort();
        Ok(programs)
    }
}
