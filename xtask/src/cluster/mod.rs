//! `cargo xtask cluster`: a sweep on schedulers of clusters, on this machine alone.

mod cost;
mod hyperqueue;
mod place;
mod processes;
mod slurm;

use std::fmt::Write;

use proof::Failure;
use proof::files::{renew, root};

use cost::Cost;
use place::{DESIGNS, Place, SHARES, Trial};

/// Try a sweep on HyperQueue and on Slurm, each with two workers on this machine of which one is killed half way
///
/// Writes the result into docs/howto.md, with the cost of many designs. Exit status 1 if a table is not, to the byte, that of one run. HyperQueue is
/// installed from the Python package index into target/tools; Slurm has to be there (Debian: slurmctld, slurmd, slurm-client, munge).
#[derive(Debug, clap::Args)]
pub(crate) struct Cluster {
    /// Leave HyperQueue out, and the page as it is
    #[arg(long, conflicts_with = "no_slurm")]
    no_hyperqueue: bool,
    /// Leave Slurm out, and the page as it is
    #[arg(long)]
    no_slurm: bool,
}

impl Cluster {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let place = Place::new()?;
        let cost = Cost::of(&place)?;
        let alone = Trial { scheduler: "none".into(), course: "one run".into(), table: place::ALONE };
        let mut trials = vec![alone];
        if !self.no_hyperqueue {
            trials.push(hyperqueue::sweep(&place)?);
        }
        if !self.no_slurm {
            trials.push(slurm::sweep(&place)?);
        }
        let mut section = format!(
            "{DESIGNS} designs of the reference coil within its tolerances, as an array of {SHARES} shares, two workers of one core each:\n\n\
             | scheduler | course | SHA-256 of the table begins with |\n|---|---|---|\n"
        );
        let mut hashes = Vec::new();
        for Trial { scheduler, course, table } in &trials {
            let hash = place.hash(table)?;
            let _ = writeln!(section, "| {scheduler} | {course} | `{}` |", &hash[..16]);
            hashes.push(hash);
        }
        let sound = hashes.iter().all(|hash| *hash == hashes[0]);
        let _ = write!(section, "\n{}", cost.text());
        println!("{section}\n{}", if sound { "the tables are the same to the byte" } else { "the tables DIFFER" });
        if sound && !self.no_hyperqueue && !self.no_slurm {
            let marks = ["<!-- cluster: written by `cargo xtask cluster` -->", "<!-- cluster end -->"];
            renew(&root().join("docs/howto.md"), marks, &format!("\n\n{section}\n"))?;
        }
        Ok(sound)
    }
}
