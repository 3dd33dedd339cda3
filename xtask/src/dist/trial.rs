//! The packed files, tried as its user would: in an empty folder, without a compiler.

use std::fs;
use std::path::Path;
use std::process::Command;

use fogcoil::input::read_coil;
use proof::Failure;
use proof::files::{below, failed};
use serde_json::Value;

use crate::tools::{environment, printed};

/// Largest relative difference between what the packed program computes and what this one does.
const SAME: f64 = 1e-9;

/// Tries an archive or a wheel; what it holds, unpacked \[bytes\].
pub(super) fn tried(path: &Path, name: &str) -> Result<u64, Failure> {
    let place = tempfile::tempdir()?;
    let place = &place.path().canonicalize()?;
    if path.extension().is_some_and(|end| end == "whl") { wheel(path, place) } else { archive(path, &place.join(name), place) }
}

/// Unpacks the archive in the empty folder `place` and runs the program in `folder`, which the archive makes.
fn archive(path: &Path, folder: &Path, place: &Path) -> Result<u64, Failure> {
    printed(Command::new("tar").arg("-xzf").arg(path).current_dir(place))?;
    let bytes = size(folder)?;
    let program = folder.join(format!("fogcoil{}", std::env::consts::EXE_SUFFIX));
    let run = |words: &str| {
        let mut command = Command::new(&program);
        printed(command.args(words.split(' ')).current_dir(place).env_remove("PATH").env("FOGCOIL_CACHE", place.join("cache")))
    };
    let version = run("--version")?;
    if version.trim() != concat!("fogcoil ", env!("CARGO_PKG_VERSION")) {
        return Err(Failure(format!("the packed program calls itself {version:?}")));
    }
    run("new coil.ron")?;
    run("new --kind profile profile.csv")?;
    let said: Value = serde_json::from_str(&run("simulate coil.ron --profile profile.csv --out bias.csv --json")?)?;
    same(place, said["steady_sensitivity"].as_f64())?;
    let lines =
        |name: &str| fs::read_to_string(place.join(name)).map(|text| text.lines().count()).map_err(failed(&place.join(name)));
    let (given, written) = (lines("profile.csv")?, lines("bias.csv")?);
    match given == written {
        true => Ok(bytes),
        false => Err(Failure(format!("the packed program writes {written} lines of bias where the profile has {given}"))),
    }
}

/// Installs the wheel into a new environment and calls it there; nothing but the environment's programs is found.
fn wheel(path: &Path, place: &Path) -> Result<u64, Failure> {
    let programs = environment(&place.join("python"))?;
    let within = |name: &str| {
        let mut command = Command::new(programs.join(name));
        command.current_dir(place).env("PATH", &programs).env("PIP_DISABLE_PIP_VERSION_CHECK", "1");
        command
    };
    printed(within("pip").args(["install", "--quiet", "--only-binary", ":all:"]).arg(path))?;
    fs::write(place.join("coil.ron"), COIL)?;
    let call = "import fogcoil, os; print(fogcoil.sensitivity('coil.ron')['total'], os.path.dirname(fogcoil.__file__))";
    let answer = printed(within("python").args(["-c", call]))?;
    let (total, folder) = answer.trim().split_once(' ').ok_or_else(|| Failure(format!("Python prints {answer:?}")))?;
    same(place, total.parse().ok())?;
    size(Path::new(folder))
}

/// The coil that `fogcoil new` writes.
const COIL: &str = include_str!("../../../crates/fogcoil/templates/coil.ron");

/// Whether `total` is the steady sensitivity of the coil in `place`.
fn same(place: &Path, total: Option<f64>) -> Result<(), Failure> {
    let right = read_coil(&place.join("coil.ron"))?.steady_sensitivity()?.sensitivity.total();
    match total {
        Some(total) if (total - right).abs() <= SAME * right.abs() => Ok(()),
        _ => Err(Failure(format!("the sensitivity is {right}; what was packed says {total:?}"))),
    }
}

/// All files of a folder \[bytes\].
fn size(folder: &Path) -> Result<u64, Failure> {
    let length = |file| fs::metadata(folder.join(file)).map(|about| about.len()).map_err(failed(folder));
    below(folder)?.into_iter().map(length).sum()
}
