//! `fogcoil calibrate`: the constants of a lot, with the deviations of further units, from records of its good units.
//!
//! A lot is made of the same batches: its units share part of their deviation from the drawing. The information of each unit's records on its constants
//! is weighed together ([`diagnosis::Lot`]). The resulting design file has the lot's values, the tolerances by which units differ, and the correlations
//! of constants that the records determine only together.

mod left;
mod text;

use std::ffi::OsStr;
use std::path::Path;

use bias::units::S_PER_MIN;
use coil::{Design, Number, Tolerance, Tolerances};
use diagnosis::{Active, Believed, ForwardModel, Lot, Observation, Prior, Said};
use files::{Note, Remark};
use mechanisms::{CATALOGUE, Gyro, Library, number_of, with_constant};
use progress::Step;

use crate::Error;
use crate::cache::Cache;
use crate::input::{CoilCase, Fingerprint, InputError, RecordCase};
use crate::prepare::{Record, gyro, library, other_design, ready, refuse_copies};
use left::LeftOfUnit;

/// The last digit to which correlations are written.
const LEAST_CORRELATION: f64 = 1e-3;
/// Gain of ln evidence by a mechanism from which a unit is doubted: a likelihood ratio of e⁵ = 148.
const DOUBTED: f64 = 5.0;
/// Units of which two can outvote one.
const FEW: usize = 3;

/// Duration of the fit of a record of half a day on one core \[s\].
const EACH: f64 = 6.0;
/// The task that is counted.
const TASK: &str = "fitting units";

/// What is ahead, in words.
fn ahead(units: usize, records: usize) -> String {
    let minutes = (EACH * records as f64 / S_PER_MIN).round().max(1.0);
    format!("{units} unit{}, about {minutes} min on one core", if units == 1 { "" } else { "s" })
}

/// A lot, calibrated.
pub struct Outcome {
    case: CoilCase,
    constants: Vec<Constant>,
    lot: Lot,
    units: Vec<Told>,
    /// standard deviations by which an effect stands out of a unit's records, known from the drawing and from the lot
    effects: Vec<(String, [f64; 2])>,
    notes: Vec<Note>,
}

/// A constant that the units of a lot have partly in common.
struct Constant {
    /// number among the forward model's nuisances
    at: usize,
    name: String,
    number: Number,
    prior: Prior,
}

/// A unit as it was fitted.
struct Unit {
    gyro: Gyro<'static>,
    fit: diagnosis::Fit,
    records: usize,
    left: LeftOfUnit,
}

/// The statement about a unit beside its constants.
struct Told {
    name: String,
    files: Vec<Fingerprint>,
    left: LeftOfUnit,
    /// nothing speaks against it
    good: bool,
}

/// Calibrates the lot of the design `case` from its good `units`, each with its records.
///
/// # Errors
/// [`files::Error::Input`] names the record that cannot be used and why; [`files::Error::Coil`] if the design cannot be modelled.
pub fn calibrate(
    case: &CoilCase,
    units: &[Vec<RecordCase>],
    cache: &Cache,
    progress: &(dyn Fn(Step) + Sync),
) -> Result<Outcome, Error> {
    refuse_copies(units.iter().flatten())?;
    if case.is_calibrated() {
        let (file, problem) = (case.file.clone(), "is calibrated already".to_owned());
        let remedy = "give the drawing, and all units of the lot together".to_owned();
        return Err(InputError { file, line: None, field: Some("correlations".into()), problem, remedy }.into());
    }
    let mut notes: Vec<Note> = units.iter().flatten().filter_map(|record| other_design(case, record)).collect();
    if units.len() < FEW {
        let message = format!(
            "a lot of {} cannot tell a fault of one unit from what the lot has in common; give {FEW} units or more",
            units.len()
        );
        notes.push(Remark::FewUnits.warning(message).at(&case.file));
    }
    let prepared = |records: &Vec<RecordCase>| records.iter().map(|record| ready(record, &mut notes)).collect();
    // a record that cannot be used is refused before anything is modelled
    let all = units.iter().map(prepared).collect::<Result<Vec<Vec<Record>>, Error>>()?;
    progress(Step::begins(&ahead(units.len(), all.iter().map(Vec::len).sum())));
    let library = library(case, cache, progress)?;
    let (mut fitted, mut told) = (Vec::new(), Vec::new());
    for ((records, name), read) in units.iter().zip(names(units)).zip(all) {
        let done = fitted.len();
        let (unit, doubts) = fit(case, &library, &read, &|_| progress(Step::counted(TASK, done, units.len())))?;
        let files: Vec<Fingerprint> = records.iter().map(|record| record.fingerprint.clone()).collect();
        let other = records.iter().any(|record| other_design(case, record).is_some());
        told.push(Told { name, left: unit.left, good: doubts.is_empty() && !other, files });
        notes.extend(doubts.into_iter().map(|note| note.at(&records[0].fingerprint.file)));
        fitted.push(unit);
    }
    let Some(first) = fitted.first() else { return Err(Error::usage("give at least one --unit")) };
    let constants = constants(&first.gyro);
    let numbers: Vec<usize> = constants.iter().map(|c| c.at).collect();
    let failed = Error::of_diagnosis(&case.file);
    let said = |unit: &Unit| -> Result<Said, Error> {
        let believed = unit.fit.believed(&unit.gyro, &numbers).map_err(failed)?;
        Said::of(&believed).ok_or_else(not_finite)
    };
    let said = fitted.iter().map(said).collect::<Result<Vec<_>, _>>()?;
    let shared: Vec<f64> = constants.iter().map(|c| c.number.shared()).collect();
    let lot = Lot::of(&said, &shared).ok_or_else(not_finite)?;
    let effects = effects(first, &numbers, &lot.further).map_err(failed)?;
    Ok(Outcome { case: case.clone(), constants, lot, units: told, effects, notes })
}

/// Names of the units: of the folders in which their records lie; where two share a folder, of their first records; of both where two share these, too, or
/// there is but one unit in a folder.
fn names(units: &[Vec<RecordCase>]) -> Vec<String> {
    let files: Vec<&Path> = units.iter().filter_map(|records| Some(records.first()?.fingerprint.file.as_path())).collect();
    names_of(&files)
}

fn names_of(files: &[&Path]) -> Vec<String> {
    let of = |name: Option<&OsStr>| files::shown(&name.unwrap_or_default().to_string_lossy());
    let apart = |names: &[String]| (0..names.len()).all(|n| !names[n].is_empty() && !names[..n].contains(&names[n]));
    let folders: Vec<String> = files.iter().map(|file| of(file.parent().and_then(Path::file_name))).collect();
    let records: Vec<String> = files.iter().map(|file| of(file.file_stem())).collect();
    let of_both =
        |(folder, record): (&String, &String)| if folder.is_empty() { record.clone() } else { format!("{folder}/{record}") };
    match files.len() {
        1 => folders.iter().zip(&records).map(of_both).collect(),
        _ if apart(&folders) => folders,
        _ if apart(&records) => records,
        _ => folders.iter().zip(&records).map(of_both).collect(),
    }
}

fn not_finite() -> Error {
    Error::Diagnosis("what the units say of the lot is not finite".into())
}

/// The constants of a unit, nothing else at work; and what speaks against it.
fn fit(
    case: &CoilCase,
    library: &Library,
    read: &[Record],
    progress: &(dyn Fn(Step) + Sync),
) -> Result<(Unit, Vec<Note>), Error> {
    let drawn = gyro(library, CATALOGUE, read, read.len()).map_err(Error::of_coil(&case.file))?;
    let observations: Vec<Observation> = read.iter().map(|r| r.observed.clone()).collect();
    let numbers: Vec<usize> = (0..read.len()).collect();
    let settled = diagnosis::settled(&drawn, &numbers, &observations, progress).map_err(Error::of_diagnosis(&case.file))?;
    let recalibrated = settled.recalibrated.clone();
    let doubt = settled.suspect.filter(|(_, gain)| *gain > DOUBTED).map(|(mechanism, gain)| {
        let id = &drawn.mechanisms()[mechanism].id;
        format!("{id} explains this unit better than its constants do (ln odds {gain:.0} before its prior): is it a good one? See fogcoil diagnose")
    });
    let gyro = settled.into_alone().unwrap_or(drawn);
    let left = LeftOfUnit::of(&gyro, &recalibrated, &observations);
    let doubts = doubt.map(|text| Remark::DoubtedUnit.warning(text));
    let doubts = doubts.into_iter().chain(left.misfit().map(|text| Remark::UnitMisfit.warning(text))).collect();
    Ok((Unit { gyro, fit: recalibrated, records: read.len(), left }, doubts))
}

/// Constants of a model that a lot has partly in common.
fn constants(gyro: &Gyro) -> Vec<Constant> {
    let of = |(at, nuisance): (usize, &diagnosis::Nuisance)| {
        let name = nuisance.parameter.name.clone();
        let number = number_of(&name).filter(|number| number.shared() > 0.0)?;
        Some(Constant { at, name, number, prior: nuisance.parameter.prior })
    };
    gyro.nuisances().iter().enumerate().filter_map(of).collect()
}

/// Standard deviations by which each named mechanism, at the size from which its fit starts, stands out of a unit's records: with the constants known
/// from the drawing, and from the lot.
fn effects(unit: &Unit, numbers: &[usize], further: &Believed) -> Result<Vec<(String, [f64; 2])>, diagnosis::Error> {
    let records: Vec<usize> = (0..unit.records).collect();
    let mut all = Vec::new();
    for (mechanism, omission) in unit.gyro.mechanisms().iter().enumerate().filter(|(_, m)| m.named) {
        let Some(values) = omission.starts.iter().max_by_key(|values| values.iter().filter(|v| **v != 0.0).count()) else {
            continue;
        };
        // a fit that starts at none of it: as much as it may well be
        let size =
            |(value, parameter): (&f64, &diagnosis::Parameter)| if *value == 0.0 { parameter.prior.value(1.0) } else { *value };
        let values = values.iter().zip(&omission.parameters).map(size).collect();
        let choice = omission.choice.as_ref().and_then(|(_, choices)| choices.get(choices.len() / 2).copied());
        let effect = Active { mechanism, values, choice };
        let by = |known| unit.fit.stands_out(&unit.gyro, &records, &effect, known);
        all.push((omission.id.clone(), [by(None)?, by(Some((numbers, &further.covariance)))?]));
    }
    Ok(all)
}

impl Outcome {
    /// Further remarks for the user.
    pub fn notes(&self) -> &[Note] {
        &self.notes
    }

    /// The constants in their units where they are at `mean`.
    fn told<'a>(&'a self, mean: &'a Believed) -> impl Iterator<Item = (&'a str, f64)> + Clone {
        self.constants.iter().zip(mean.mean.iter()).map(|(c, u)| (c.name.as_str(), c.prior.value(*u)))
    }

    /// The lot's design: its values, the tolerances by which units differ, correlations of constants that were determined only together.
    fn design(&self) -> (Design, Tolerances) {
        let Lot { further, .. } = &self.lot;
        let put = |design: Design, (name, told): (&str, f64)| with_constant(&design, name, told).unwrap_or(design);
        let design = self.told(further).fold(self.case.design.clone(), put);
        let mut tolerances = self.case.tolerances.clone();
        let sd = further.sd();
        for (k, constant) in self.constants.iter().enumerate() {
            let share = constant.prior.sd() * sd[k] / constant.prior.value(further.mean[k]);
            tolerances.given.retain(|(number, _)| *number != constant.number);
            tolerances.given.push((constant.number, Tolerance::Relative(rounded(share.abs()))));
        }
        for i in 0..self.constants.len() {
            for j in 0..i {
                let r = further.covariance[(i, j)] / (sd[i] * sd[j]);
                let r = (r / LEAST_CORRELATION).round() / (1.0 / LEAST_CORRELATION);
                if r != 0.0 {
                    tolerances.correlations.push((self.constants[j].number, self.constants[i].number, r));
                }
            }
        }
        (design, tolerances)
    }
}

/// A tolerance to four digits.
fn rounded(share: f64) -> f64 {
    format!("{share:.3e}").parse().unwrap_or(share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_ahead_is_told() {
        assert_eq!(ahead(22, 22), "22 units, about 2 min on one core");
        assert_eq!(ahead(1, 2), "1 unit, about 1 min on one core");
    }

    #[test]
    fn units_have_the_names_of_their_folders_or_files() {
        let of = |files: &[&str]| names_of(&files.iter().map(Path::new).collect::<Vec<_>>());
        assert_eq!(of(&["lot/U1/run1.csv", "lot/U2/run1.csv"]), ["U1", "U2"]);
        assert_eq!(of(&["lot/a1.csv", "lot/b1.csv"]), ["a1", "b1"]);
        assert_eq!(of(&["a1.csv", "b1.csv"]), ["a1", "b1"]);
        assert_eq!(of(&["lot/U1/run1.csv", "lot/U1/run2.csv", "lot/U2/run1.csv"]), ["U1/run1", "U1/run2", "U2/run1"]);
        assert_eq!((of(&["lot/U1/run1.csv"]), of(&["a1.csv"])), (vec!["U1/run1".to_owned()], vec!["a1".to_owned()]));
    }
}
