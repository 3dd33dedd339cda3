//! The commands of a page, run in a folder that looks like a fresh clone.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use tempfile::TempDir;

use super::compare::{TOLERANCE, compare};
use super::page::{Fence, Page};
use proof::Failure;

/// Parts of the repository that the commands may see.
const SEEN: [&str; 6] = ["README.md", "ARCHITECTURE.md", "crates", "docs", "fixtures", "python"];
/// `cargo` in place of the real one: runs the program and refuses the rest.
const CARGO: &str = "#!/bin/sh
if [ \"$1\" = run ]; then
  while [ $# -gt 0 ]; do
    case \"$1\" in --) shift; exec fogcoil \"$@\";; esac
    shift
  done
fi
echo \"only \\`cargo run -p fogcoil -- ...\\` is run here; mark the block as sh,ignore-REASON\" >&2
exit 97
";

pub(super) struct Shell {
    root: PathBuf,
    bin: TempDir,
    cache: PathBuf,
}

/// Number of blocks that were run, and places and reasons of those that were not.
#[derive(Default)]
pub(super) struct Tally {
    pub(super) run: usize,
    pub(super) ignored: Vec<String>,
    pub(super) faults: Vec<String>,
}

impl Shell {
    /// Of the repository at `root`, with the program at `program`, which keeps its models in `cache`.
    pub(super) fn new(root: &Path, program: &Path, cache: PathBuf) -> Result<Self, Failure> {
        let bin = tempfile::tempdir()?;
        symlink(program, bin.path().join("fogcoil"))?;
        let cargo = bin.path().join("cargo");
        fs::write(&cargo, CARGO)?;
        fs::set_permissions(&cargo, fs::Permissions::from_mode(0o755))?;
        Ok(Self { root: root.canonicalize()?, bin, cache })
    }

    /// Runs the page's blocks in their order; stops at the first that fails, as the others may build on it.
    pub(super) fn run(&self, page: &Page, tally: &mut Tally) -> Result<(), Failure> {
        let folder = tempfile::tempdir()?;
        for name in SEEN {
            symlink(self.root.join(name), folder.path().join(name))?;
        }
        let place = |line: usize| format!("{}:{line}", page.path.display());
        for (k, fence) in page.fences.iter().enumerate() {
            if !matches!(fence.language(), "sh" | "python") {
                continue;
            }
            if let Some(reason) = fence.word("ignore-") {
                tally.ignored.push(format!("{} ({reason})", place(fence.line)));
                continue;
            }
            let shown = page.fences.get(k + 1).filter(|next| next.language() == "text" && next.follows);
            if let Err((line, problem)) = self.block(folder.path(), fence, shown)? {
                tally.faults.push(format!("{}: {problem}", place(line)));
                return Ok(());
            }
            tally.run += 1;
        }
        Ok(())
    }

    /// Runs a block and compares what it prints; else the line and what is wrong there.
    fn block(&self, folder: &Path, fence: &Fence, shown: Option<&Fence>) -> Result<Result<(), (usize, String)>, Failure> {
        let status: i32 = fence
            .word("exit-")
            .map_or(Ok(0), str::parse)
            .map_err(|_| Failure(format!("line {}: `exit-` in an info string wants the status, e.g. sh,exit-2", fence.line)))?;
        let (script, failed) = (self.bin.path().join("block"), self.bin.path().join("failed"));
        fs::write(&failed, "")?;
        let (interpreter, head) = match fence.language() {
            "python" => ("python3", "\n".to_owned()),
            _ => {
                let merged = if status == 0 { "" } else { "exec 2>&1; " };
                let trap = format!("trap 'printf \"%s %s\" $LINENO \"$BASH_COMMAND\" > {}' ERR", failed.display());
                ("bash", format!("{merged}set -eEuo pipefail; {trap}\n"))
            }
        };
        fs::write(&script, head + &fence.text)?;
        let path = std::env::var("PATH").unwrap_or_default();
        let output = Command::new(interpreter)
            .arg(&script)
            .current_dir(folder)
            .env("PATH", format!("{}:{path}", self.bin.path().display()))
            .env("FOGCOIL_CACHE", &self.cache)
            .stdin(Stdio::null())
            .output()
            .map_err(|e| Failure(format!("{interpreter}: {e}")))?;
        let (stdout, stderr) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
        if output.status.code() != Some(status) {
            let note = fs::read_to_string(&failed)?;
            let (line, command) = note.split_once(' ').unwrap_or(("2", fence.text.lines().next().unwrap_or_default()));
            let line = fence.line + line.parse::<usize>().unwrap_or(2).saturating_sub(2);
            let said = if stderr.is_empty() { stdout } else { stderr };
            return Ok(Err((line, format!("`{command}`: {}, not {status}:\n{said}", output.status))));
        }
        let Some(shown) = shown else { return Ok(Ok(())) };
        let tolerance = shown.word("tolerance=").map_or(Ok(TOLERANCE), str::parse);
        let tolerance = tolerance.map_err(|_| Failure(format!("line {}: `tolerance=` wants a number", shown.line)))?;
        Ok(compare(&shown.text, &stdout, tolerance).map_err(|(line, stood)| {
            let wanted = shown.text.lines().nth(line).map_or("the end of the output".into(), |l| format!("`{}`", l.trim()));
            (shown.line + line, format!("shown is {wanted}, printed is {stood}; by the block at line {}", fence.line))
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faults and number of blocks run of a page with this text, `true` being the program.
    fn run(text: &str) -> (Vec<String>, usize, usize) {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("p.md"), text).unwrap();
        let page = Page::read(folder.path(), Path::new("p.md")).unwrap();
        let shell = Shell::new(folder.path(), Path::new("/bin/echo"), folder.path().into()).unwrap();
        let mut tally = Tally::default();
        shell.run(&page, &mut tally).unwrap();
        (tally.faults, tally.run, tally.ignored.len())
    }

    #[test]
    fn a_page_that_lies_is_found_with_line_and_command() {
        let good = "```sh\ncargo run --release -p fogcoil -- a 1.0001 > f\ncat f\n```\n\n```text\na 1.0\n```\n```sh,ignore-slow\nfalse\n```\n";
        assert_eq!(run(good), (vec![], 1, 1));
        let (faults, ..) = run(&good.replace("a 1.0\n", "a 1.1\n"));
        assert_eq!(faults, ["p.md:7: shown is `a 1.1`, printed is `a 1.0001`; by the block at line 2"]);
        let (faults, ..) = run("\n```sh\ntrue\nls nothing\n```\n");
        assert!(faults[0].starts_with("p.md:4: `ls nothing`: exit status: 2, not 0:\nls: "), "{faults:?}");
        assert_eq!(run("```sh,exit-2\nls nothing\n```\n```text\nls: ...\n```\n"), (vec![], 1, 0));
        assert!(run("```sh\ncargo test\n```\n").0[0].contains("ignore-REASON"));
        assert_eq!(run("```python\nprint(1 / 3)\n```\n\n```text\n0.3333\n```\n"), (vec![], 1, 0));
    }
}
