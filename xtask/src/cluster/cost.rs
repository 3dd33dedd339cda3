//! Cost of many designs, from the measured cost of some.

use proof::Failure;

use super::place::{DESIGNS, PART, Place};

/// Designs of the plan that is priced, the most that a plan may have.
const MANY: f64 = 1e7;
/// Sizes of the plans whose merges are compared.
const MERGED: [usize; 2] = [2048, 10_240];

/// Profile of this program and of the one that is measured.
const BUILD: &str = if cfg!(debug_assertions) { "dev" } else { "release" };

pub(super) struct Cost {
    /// Processor time of a design \[s\].
    seconds: f64,
    /// Size of the kept rows of a design \[bytes\].
    kept: f64,
    /// Memory of the merge, for each design \[bytes\].
    memory: f64,
}

impl Cost {
    /// Sweeps the plan in one run on one thread, and merges two larger plans.
    pub(super) fn of(place: &Place) -> Result<Self, Failure> {
        let seconds = place.alone()? / DESIGNS as f64;
        let kept = place.kept_bytes()? as f64 / DESIGNS as f64;
        let [few, many] = MERGED.map(|designs| place.peak_of_merge(designs));
        let memory = (many? as f64 - few? as f64) / (MERGED[1] - MERGED[0]) as f64;
        Ok(Self { seconds, kept, memory })
    }

    pub(super) fn text(&self) -> String {
        let Self { seconds, kept, memory } = self;
        let hours = seconds * MANY / 3600.0;
        format!(
            "The cost of 10⁷ designs with the output `Sensitivity`, on paper, from these designs:\n\n\
             | | a design | 10⁷ designs |\n|---|---|---|\n\
             | processor time on a core of this machine, {BUILD} build | {:.0} ms | {hours:.0} core-hours: {:.0} min on 100 cores |\n\
             | rows kept until the merge | {:.2} kB | {:.1} GB in {:.0} files |\n\
             | memory of the merge | {:.1} kB | {:.0} GB |\n",
            1e3 * seconds,
            0.6 * hours,
            kept / 1e3,
            kept * MANY / 1e9,
            MANY / PART as f64,
            memory / 1e3,
            memory * MANY / 1e9,
        )
    }
}
