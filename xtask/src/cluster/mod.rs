//! `cargo xtask cluster`: a sweep on schedulers of clusters, on this machine alone.

mod hyperqueue;
mod place;
mod slurm;

use proof::Failure;

use place::Place;

/// Try a sweep on HyperQueue and on Slurm, each with two workers on this machine of which one is killed half way
///
/// Exit status 1 if a table is not, to the byte, that of one run. HyperQueue is installed from the Python package index into target/tools. Without Slurm
/// (slurmctld, slurmd, munged) the tasks of its array are run by hand, one after the other.
#[derive(Debug, clap::Args)]
pub(crate) struct Cluster {
    /// Leave HyperQueue out
    #[arg(long, conflicts_with = "no_slurm")]
    no_hyperqueue: bool,
    /// Leave Slurm out
    #[arg(long)]
    no_slurm: bool,
}

impl Cluster {
    pub(crate) fn run(&self) -> Result<bool, Failure> {
        let place = Place::new()?;
        place.alone()?;
        let expected = place.told("one run", "one.parquet")?;
        let mut tables = Vec::new();
        if !self.no_hyperqueue {
            tables.push((hyperqueue::sweep(&place)?, "hyperqueue.parquet"));
        }
        if !self.no_slurm {
            tables.push((slurm::sweep(&place)?, "slurm.parquet"));
        }
        let mut sound = true;
        for (how, table) in tables {
            sound &= place.told(&how, table)? == expected;
        }
        println!("{}", if sound { "the tables are the same to the byte" } else { "the tables DIFFER" });
        Ok(sound)
    }
}
