//! A recording as a profile: its chamber drives the coil, its other channels stand beside the result.

use std::path::Path;

use coil::{Design, Drive, Profile};

use super::InputError;
use super::profile::{Between, ProfileCase, Recorded};
use super::record::read_record;
use super::record_options::{CHAMBER, RATE, RecordOptions, SPOOL};
use crate::Error;

/// Reads and checks a recording as the profile of a design: rows of which the chamber's temperature is to be used. The design's heaters, if it has any,
/// are on throughout.
///
/// # Errors
/// As [`read_record`]; [`Error::Input`] for a recording that cannot be used, or has no chamber.
pub fn read_recorded(path: &Path, options: &RecordOptions, design: &Design) -> Result<ProfileCase, Error> {
    let record = read_record(path, options)?;
    record.require_usable()?;
    let used = record.report.used(&record.recording);
    let chamber = used.channel(CHAMBER).map_or(&[][..], |channel| &channel.values);
    let rows: Vec<usize> = (0..chamber.len()).filter(|n| chamber[*n].is_finite()).collect();
    if rows.is_empty() {
        let remedy = "give a record with a column of the chamber's temperature, or infer the chamber from the spool's thermometer with --spool";
        return Err(InputError::whole(path, "has no temperature of the chamber that can be used", remedy).into());
    }
    let of_rows = |values: &[f64]| -> Vec<f64> { rows.iter().map(|n| values[*n]).collect() };
    let channel = |name: &str| used.channel(name).map_or_else(|| vec![f64::NAN; rows.len()], |channel| of_rows(&channel.values));
    let (mut drives, mut courses) = (vec![Drive::Chamber], vec![of_rows(chamber)]);
    if !design.heat.heaters.is_empty() {
        drives.push(Drive::Heaters);
        courses.push(vec![1.0; rows.len()]);
    }
    Ok(ProfileCase {
        drives,
        profile: Profile { time: of_rows(used.time()), drives: courses },
        further: options.further.iter().map(|name| (name.clone(), channel(name))).collect(),
        inferred: None,
        recorded: Some(Recorded { spool: channel(SPOOL), rate: channel(RATE) }),
        notes: record.notes,
        fingerprint: record.fingerprint,
        between: Between::Linear,
        step: None,
    })
}
