//! Contribution of a user's own mechanisms to a simulation.

use diagnosis::{Active, ForwardModel, expected};
use files::shown_path;
use mechanisms::{Chamber, Gyro, Library, Mechanism, Prepared, RATE, SPOOL};
use progress::Step;
use recording::Seconds;

use crate::Error;
use crate::cache::Cache;
use crate::input::{MechanismCase, ProfileCase};
use crate::prepare::library;
use crate::simulate::Simulation;
use coil::{Drive, Mechanics};

/// Straight lines between rows, divided: a record is taken as smooth between its rows, a profile has corners.
const PARTS: usize = 8;

/// A library under a profile of the chamber, without a sensor's noise.
pub(crate) fn under<'m>(
    library: Library,
    mechanisms: &[&'m dyn Mechanism],
    profile: &ProfileCase,
) -> Result<Gyro<'m>, coil::Error> {
    let [time, chamber] = [&profile.profile.time, profile.chamber()].map(divided);
    let prepared = Prepared::under(&library, &time, &Chamber::given(&time, &chamber), 0.0)?;
    let beside = profile.further.iter().map(|(name, values)| (name.clone(), divided(values))).collect();
    Gyro::new(library, mechanisms, vec![prepared.with_columns(beside)])
}

/// A response of such a library at the profile's rows: thermometer, and rate as a mean since the row before.
pub(crate) fn at_rows(response: &[Vec<f64>]) -> [Vec<f64>; 2] {
    let mean = |part: &[f64]| part.iter().sum::<f64>() / PARTS as f64;
    let (spool, rate) = (&response[SPOOL], &response[RATE]);
    let rate = rate[..1].iter().copied().chain(rate[1..].chunks(PARTS).map(mean)).collect();
    [spool.iter().copied().step_by(PARTS).collect(), rate]
}

fn divided(course: &[f64]) -> Vec<f64> {
    let between = course.windows(2).flat_map(|w| (1..=PARTS).map(|k| w[0] + (w[1] - w[0]) * k as f64 / PARTS as f64));
    course.first().copied().into_iter().chain(between).collect()
}

impl Simulation<'_> {
    /// Adds the effects of mechanisms at the values that their files give, by the reduced models of a diagnosis.
    ///
    /// # Errors
    /// [`files::Error::Usage`] where they cannot act, or a law is no number; [`files::Error::Input`] for a parameter without a value.
    pub fn add(&mut self, own: &[MechanismCase], cache: &Cache, progress: &(dyn Fn(Step) + Sync)) -> Result<(), Error> {
        if own.is_empty() {
            return Ok(());
        }
        let (case, profile) = (self.case, self.profile);
        if profile.drives != [Drive::Chamber] {
            return Err(Error::usage(
                "--mechanism: acts in profiles with chamber_c alone; leave out the other columns, or --mechanism",
            ));
        }
        if case.design.mechanics != Mechanics::Elastic {
            return Err(Error::usage("--mechanism: acts in a design whose mechanics is Elastic; leave out --mechanism"));
        }
        let values = own.iter().map(MechanismCase::at).collect::<Result<Vec<_>, _>>()?;
        for MechanismCase { file, mechanism, .. } in own {
            if let Some(column) = mechanism.columns().into_iter().find(|column| !profile.further.contains_key(*column)) {
                let text = format!(
                    "--mechanism: {}: its law names the column {column}, which the record of a thermometer has not; give a --profile with it",
                    shown_path(file)
                );
                return Err(Error::usage(text));
            }
        }
        let at = Error::of_coil(&case.file);
        let library = library(case, cache, progress)?;
        let kinds: Vec<&dyn Mechanism> = own.iter().map(|own| &own.mechanism as &dyn Mechanism).collect();
        let gyro = under(library.clone(), &kinds, profile).map_err(at)?;
        let place = |(own, values): (&MechanismCase, Vec<f64>)| {
            let id = &own.mechanism.id;
            let none = || Error::usage(format!("--mechanism: {}: the design has no place for `{id}`", shown_path(&own.file)));
            let mechanism = gyro.find(id).ok_or_else(none)?;
            Ok(Active { mechanism, values, choice: None })
        };
        let active = own.iter().zip(values).map(place).collect::<Result<Vec<_>, Error>>()?;
        let middle = expected(gyro.nuisances());
        let respond = |active: &[Active]| gyro.respond(0, &middle, active).map_err(at).map(|response| at_rows(&response));
        let (with, without) = (respond(&active)?, respond(&[])?);
        let rows = 0..profile.profile.time.len();
        self.added = rows.map(|n| [SPOOL, RATE].map(|channel| with[channel][n] - without[channel][n])).collect();
        match first_bad(&self.added) {
            Some(row) => {
                let laws = own
                    .iter()
                    .zip(&active)
                    .flat_map(|(own, active)| (0..own.mechanism.system.laws.len()).map(move |law| (own, active, law)));
                for (own, active, law) in laws {
                    if let Some(row) = self.bad_row(own, law, &active.values, &library)? {
                        return Err(no_number(own, law, profile.profile.time[row]));
                    }
                }
                // each alone is finite, all together are not
                Err(no_number(&own[0], 0, profile.profile.time[row]))
            }
            None => Ok(()),
        }
    }

    /// The first row in which a law of a mechanism, alone, is no finite number.
    fn bad_row(&self, own: &MechanismCase, law: usize, values: &[f64], library: &Library) -> Result<Option<usize>, Error> {
        let mut alone = own.mechanism.clone();
        alone.system.laws = vec![alone.system.laws[law].clone()];
        alone.targets = vec![alone.targets[law]];
        let at = Error::of_coil(&self.case.file);
        let gyro = under(library.clone(), &[&alone as &dyn Mechanism], self.profile).map_err(at)?;
        let Some(mechanism) = gyro.find(&alone.id) else { return Ok(None) };
        let active = Active { mechanism, values: values.to_vec(), choice: None };
        let response = gyro.respond(0, &expected(gyro.nuisances()), &[active]).map_err(at)?;
        let [spool, rate] = at_rows(&response);
        Ok(first_bad(&spool.into_iter().zip(rate).map(|(spool, rate)| [spool, rate]).collect::<Vec<_>>()))
    }
}

/// The first row that is no finite number.
fn first_bad(rows: &[[f64; 2]]) -> Option<usize> {
    rows.iter().position(|row| row.iter().any(|value| !value.is_finite()))
}

/// A law that has no value at an instant \[s\].
fn no_number(own: &MechanismCase, law: usize, time: f64) -> Error {
    let problem = format!("the law of `{}` is no finite number at {} s of the profile", own.mechanism.id, Seconds(time));
    own.law_fault(law, problem, "bound it, e.g. by max(...), or give its parameters other values").into()
}
