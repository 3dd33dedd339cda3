//! cargo-mutants, which lists mutants and tries those that have to be tried alone.

use std::path::Path;
use std::process::Command;

use proof::Failure;
use proof::files::root;

use crate::tools::{tool, tool_with};

const RUNNER: [&str; 2] = ["cargo-mutants", "27.1.0"];
/// Runs tests one by one, so that the first that fails ends a mutant's trial.
const TESTER: [&str; 2] = ["cargo-nextest", "0.9.151"];
/// Without the part that fetches new versions of itself.
const TESTER_FLAGS: [&str; 3] = ["--no-default-features", "--features", "default-no-update"];
/// The runner, with the tester in its reach.
pub(super) fn runner() -> Result<Command, Failure> {
    let tester = tool_with(TESTER, &TESTER_FLAGS)?;
    let folder = Path::new(tester.get_program()).parent().map(Path::to_owned).unwrap_or_default();
    let others = std::env::var_os("PATH").unwrap_or_default();
    let reach = std::env::join_paths(std::iter::once(folder).chain(std::env::split_paths(&others)))?;
    let mut runner = tool(RUNNER)?;
    runner.arg("mutants").env("PATH", reach).current_dir(root());
    Ok(runner)
}
