//! The profile behind a thermometer's record.

use std::collections::BTreeMap;

use coil::{Drive, Profile, chamber_from_sensor};
use files::Remark;

use super::model::Model;
use super::run::is_possible;
use crate::Error;
use crate::input::{Between, Inference, InputError, ProfileCase, SpoolCase};

/// A thermometer that the model follows no better than this, in noises, is noted.
const UNEXPLAINED: f64 = 2.0;

/// The profile that a thermometer's record came from; `noise` \[K\] is the standard deviation of its readings.
///
/// # Errors
/// [`files::Error::Coil`] if nothing can be inferred from the record.
pub fn infer(record: SpoolCase, noise: f64, model: &Model) -> Result<ProfileCase, Error> {
    let SpoolCase { drives, time, spool, mut notes, fingerprint } = record;
    let file = || fingerprint.file.clone();
    let inferred = chamber_from_sensor(&model.dynamics, &time, &spool, noise).map_err(Error::of_coil(&fingerprint.file))?;
    let residual = inferred.sensor_residual_rms;
    if let Some(t) = inferred.chamber.iter().find(|t| !is_possible(**t)) {
        let problem = format!(
            "spool_c would need a chamber at {t:.0} degC; the record jumps, is rounded coarsely (--spool-noise), or does not start at rest"
        );
        return Err(InputError { file: file(), line: None, field: Some("spool_c".into()), problem, remedy: String::new() }.into());
    }
    if residual > UNEXPLAINED * noise {
        let problem = format!(
            "the model follows spool_c to {residual:.4} K only, with a noise of {noise} K; the record may not start at rest, the \
             thermometer be noisier (--spool-noise), or the coil another"
        );
        notes.push(Remark::PoorInference.note(problem).at(file()));
    }
    let mut sd = inferred.chamber_sd;
    sd.sort_by(f64::total_cmp);
    let inference = Inference {
        noise,
        roughness: inferred.roughness,
        sensor_residual_rms: residual,
        chamber_sd: [sd[sd.len() / 2], sd[sd.len() - 1]],
    };
    let course = |drive: &Drive| if *drive == Drive::Heaters { vec![1.0; time.len()] } else { inferred.chamber.clone() };
    let courses = drives.iter().map(course).collect();
    Ok(ProfileCase {
        drives,
        profile: Profile { time, drives: courses },
        further: BTreeMap::new(),
        inferred: Some(inference),
        recorded: None,
        notes,
        fingerprint,
        between: Between::Linear,
        step: None,
    })
}
