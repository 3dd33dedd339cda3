//! Arguments of the chamber under which a coil's bias is shown, for commands that can do without.

use std::path::{Path, PathBuf};

use clap::Args;
use fogcoil::Error;
use fogcoil::input::{self, CoilCase, InputError, ProfileCase, RecordOptions};

#[derive(Args)]
pub(crate) struct Under {
    /// Profile under which to show the bias, e.g. fixtures/profiles/paper.csv
    #[arg(long, value_name = "P.csv")]
    profile: Option<PathBuf>,
    /// In place of a profile: a recording, whose chamber drives the coil; read as `fogcoil check` reads it, with RECORD.map.ron beside it if it is there
    #[arg(long, value_name = "RECORD.csv", conflicts_with_all = ["profile", "step"])]
    record: Option<PathBuf>,
    /// A file that says how that recording is read, in place of one beside it, or how the profile is read
    #[arg(long, value_name = "FILE.ron")]
    map: Option<PathBuf>,
    /// Add a row every S seconds from the first row, on the straight lines between the profile's own
    #[arg(long, value_name = "S", value_parser = step, requires = "profile")]
    step: Option<f64>,
}

impl Under {
    /// Files that are read.
    pub(crate) fn files(&self) -> Vec<PathBuf> {
        let recorded = self.record.iter().flat_map(|path| self.reading().files(path));
        let mapped = self.map.iter().filter(|_| self.profile.is_some());
        self.profile.iter().chain(mapped).cloned().chain(recorded).collect()
    }

    /// Options for reading the recording.
    fn reading(&self) -> RecordOptions {
        RecordOptions { map: self.map.clone(), ..RecordOptions::default() }
    }

    /// The chamber's course, for a coil, where one is given.
    pub(crate) fn read(&self, case: &CoilCase) -> Result<Option<ProfileCase>, Error> {
        match (&self.profile, &self.record) {
            (Some(path), _) => {
                let mut profile = profile(path, self.map.as_deref(), case, &[])?;
                divide(&mut profile, self.step)?;
                Ok(Some(profile))
            }
            (None, Some(path)) => Ok(Some(input::read_recorded(path, &self.reading(), &case.design)?)),
            (None, None) if self.map.is_some() => {
                Err(Error::usage("--map says how a table is read: give --profile or --record, too"))
            }
            (None, None) => Ok(None),
        }
    }
}

/// The profile of a coil, through a map file if one is given.
pub(crate) fn profile(path: &Path, map: Option<&Path>, case: &CoilCase, further: &[String]) -> Result<ProfileCase, InputError> {
    match map {
        Some(map) => input::read_mapped_profile(path, map, &case.design, further),
        None => input::read_profile(path, &case.design, further),
    }
}

/// Steps \[s\] that a profile can be divided into.
const STEPS_S: std::ops::RangeInclusive<f64> = 1.0..=1e6;

/// The argument of `--step`.
pub(crate) fn step(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|step| STEPS_S.contains(step));
    number.ok_or_else(|| format!("give seconds from {} to {}", STEPS_S.start(), STEPS_S.end()))
}

/// A profile with the rows that `--step` adds, and a note where rows are long all the same.
pub(crate) fn divide(profile: &mut ProfileCase, step: Option<f64>) -> Result<(), Error> {
    step.map_or(Ok(()), |step| profile.divide(step))?;
    profile.note_long_rows("give --step 30");
    Ok(())
}
