//! Disks that are full or cannot be written: a small file system in memory, in a name space of its own, where the system allows that.

use std::path::Path;
use std::process::{Command, Output, Stdio};

use proof::Failure;
use tempfile::TempDir;

use super::row::{Row, reference};
use super::work::Work;

/// Sizes of a full disk beside what the outputs and inputs need, as shares.
const SHARES: [f64; 6] = [0.0, 0.1, 0.3, 0.6, 0.9, 0.99];

/// Runs a shell script in a name space of its own for mounts; `None` where the system does not allow that.
fn apart(script: &str, arguments: &[&Path]) -> Option<Output> {
    let mut command = Command::new("unshare");
    command.args(["--mount", "sh", "-euc", script, "sh"]).args(arguments);
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped()).output().ok()
}

pub(super) fn rows(work: &Work, program: &Path) -> Result<Vec<Row>, Failure> {
    let probe = TempDir::new()?;
    let allowed = apart("mount -t tmpfs -o size=64k none \"$1\"", &[probe.path()]).is_some_and(|run| run.status.success());
    if !allowed {
        let mut row = Row::new(format!("`{}`, a full and a read-only disk", work.name));
        row.faults.push("not tried: this system does not let a user mount a file system".into());
        return Ok(vec![row]);
    }
    Ok(vec![outputs(work, program)?, models(work, program)?])
}

/// Outputs on a disk that is full, and on one that cannot be written.
fn outputs(work: &Work, program: &Path) -> Result<Row, Failure> {
    let (cache, right, _) = reference(work, program)?;
    let mut row = Row::new(format!("`{}`, outputs on a full disk, and on one that is read-only", work.name));
    let bytes: usize = right.values().map(Vec::len).sum();
    let given = work.place()?;
    let inputs = work.bytes(given.folder.path())?;
    // pages of 4 KiB, one more for each file
    let pages = |bytes: usize| bytes.div_ceil(4096);
    let room = |share: f64| 4096 * (pages(inputs) + 8 + (share * pages(bytes) as f64) as usize);
    let arguments = work.words();
    for size in SHARES.iter().map(|share| Some(room(*share))).chain([None]) {
        let (mounted, kept) = (TempDir::new()?, TempDir::new()?);
        let then = if size.is_none() { "mount -o remount,ro \"$2\"" } else { ":" };
        // what is left is copied to a sound disk, where it can be seen from outside
        let script = format!(
            "mount -t tmpfs -o size={} none \"$2\"; cp -r \"$4\"/. \"$2\"; {then}; cd \"$2\"; set +e; FOGCOIL_CACHE=\"$5\" \"$1\" {arguments}; code=$?; \
             cp -r \"$2\"/. \"$3\"; exit $code",
            size.unwrap_or(1 << 26)
        );
        let run = apart(&script, &[program, mounted.path(), kept.path(), given.folder.path(), cache.path()]);
        let run = run.ok_or_else(|| Failure("unshare cannot be run".into()))?;
        row.ended(work, &run, kept.path(), &[&right], false)?;
    }
    Ok(row)
}

/// Kept models on such disks: the program answers without them.
fn models(work: &Work, program: &Path) -> Result<Row, Failure> {
    let (_, right, _) = reference(work, program)?;
    let mut row = Row::new(format!("`{}`, kept models on a full disk, and on one that is read-only", work.name));
    let arguments = work.words();
    for (size, then) in [(16 << 10, ":"), (256 << 10, ":"), (1 << 26, "mount -o remount,ro \"$2\"")] {
        let (mounted, place) = (TempDir::new()?, work.place()?);
        let script =
            format!("mount -t tmpfs -o size={size} none \"$2\"; {then}; cd \"$3\"; FOGCOIL_CACHE=\"$2\" \"$1\" {arguments}");
        let run = apart(&script, &[program, mounted.path(), place.folder.path()]);
        let run = run.ok_or_else(|| Failure("unshare cannot be run".into()))?;
        row.ended(work, &run, place.folder.path(), &[&right], true)?;
    }
    Ok(row)
}
