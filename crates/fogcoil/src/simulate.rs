//! `fogcoil simulate`: a profile in, thermometer and bias out.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Write};

use bias::Bias;
use bias::units::{DEG_PER_H_PER_RAD_PER_S, K_PER_MIN_PER_K_PER_S};
use coil::{
    CHECKS, COARSER, Drive, Dynamics, MODEL_SAFETY, ParametricModel, Profile, ReductionError, Response, STANDARD, STEADY,
    SteadySensitivity, ThermalState, TurnFields, chamber_from_sensor,
};
use files::{Note, Remark};
use progress::Step;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;
use crate::cache::{Cache, Source};
use crate::input::{Between, CoilCase, Inference, InputError, ProfileCase, SpoolCase};

/// A column's name, and what it holds of a row.
pub type Column = (&'static str, fn(&SimulatedRow) -> f64);

/// Columns of the result.
pub const COLUMNS: [Column; 7] = [
    ("time_s", |row| row.time),
    ("chamber_c", |row| row.chamber),
    ("spool_c", |row| row.spool),
    ("shupe_deg_per_h", |row| row.shupe),
    ("eo_axial_deg_per_h", |row| row.eo_axial),
    ("eo_radial_deg_per_h", |row| row.eo_radial),
    ("rate_deg_per_h", |row| row.rate),
];

/// Span over which the thermometer is differenced for its rate \[s\]: the interval of the paper's record.
pub const WINDOW_S: f64 = 30.0;
/// How much shorter a window may be, in windows: what clocks of recorders jitter.
const JITTER: f64 = 0.1;

/// A coil modelled for the drives of a profile.
#[derive(Debug, Clone)]
pub struct Model {
    dynamics: Dynamics,
    /// The same coil on a coarser mesh.
    coarser: Dynamics,
    steady: SteadySensitivity,
    source: Source,
}

/// What a coil does under a profile.
#[derive(Debug, Clone)]
pub struct Simulation<'a> {
    /// The coil.
    pub case: &'a CoilCase,
    /// The profile.
    pub profile: &'a ProfileCase,
    /// Its steady-ramp sensitivity.
    pub steady: SteadySensitivity,
    /// What the model leaves out.
    pub reduction: ReductionError,
    /// Modes of the model.
    pub modes: usize,
    /// Whether the model was built or found in the cache.
    pub source: Source,
    responses: Vec<Response>,
    /// On a coarser mesh.
    coarser: Vec<Response>,
    /// States at instants evenly spaced over the course; none if it has no duration.
    pub(crate) samples: Vec<Sample>,
    /// what mechanisms add to thermometer \[K\] and rate \[deg/h\] in every row; none without mechanisms
    pub(crate) added: Vec<[f64; 2]>,
}

/// Instants between the first and the last at which fields can be drawn: the middles of as many equal intervals.
const SAMPLES: usize = 150;

/// The model's state at an instant.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Sample {
    /// Instant \[s\].
    pub(crate) time: f64,
    pub(crate) state: ThermalState,
}

/// One row of the result, in the units of its [`COLUMNS`]; rates are means since the previous row, 0 in the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulatedRow {
    /// Instant \[s\].
    pub time: f64,
    /// Chamber \[°C\].
    pub chamber: f64,
    /// Thermometer \[°C\].
    pub spool: f64,
    /// Thermal phase \[deg/h\].
    pub shupe: f64,
    /// Axial strain \[deg/h\].
    pub eo_axial: f64,
    /// Radial strain \[deg/h\].
    pub eo_radial: f64,
    /// The read-out's own drift with temperature \[deg/h\]; not a column of the result.
    pub read_out: f64,
    /// What mechanisms of a user's own add \[deg/h\]; a column of the result where there are any.
    pub mechanisms: f64,
    /// The sum of the five \[deg/h\].
    pub rate: f64,
}

impl SimulatedRow {
    fn of(profile: &ProfileCase, n: usize, response: Response) -> Self {
        let Response { sensor, bias, .. } = response;
        let bias = bias * DEG_PER_H_PER_RAD_PER_S;
        Self {
            time: profile.profile.time[n],
            chamber: profile.chamber()[n],
            spool: sensor,
            shupe: bias.shupe,
            eo_axial: bias.eo_axial,
            eo_radial: bias.eo_radial,
            read_out: response.read_out * DEG_PER_H_PER_RAD_PER_S,
            mechanisms: 0.0,
            rate: response.rate() * DEG_PER_H_PER_RAD_PER_S,
        }
    }
}

/// Rates over the shortest run of whole rows that spans [`WINDOW_S`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    /// Its end \[s\].
    pub time: f64,
    /// Difference of the thermometer over its span \[°C/min\].
    pub spool_rate: f64,
    /// Mean bias \[deg/h\].
    pub rate: f64,
}

/// Models a coil for the drives of a profile, or finds its model in `cache`.
///
/// # Errors
/// [`files::Error::Coil`] if the coil cannot be solved.
pub fn model(case: &CoilCase, drives: &[Drive], cache: &Cache) -> Result<Model, Error> {
    let (dynamics, source) = load_or_build(case, drives, cache, "dynamics", || Dynamics::new(&case.design, drives, &STANDARD))?;
    assembled(case, drives, cache, dynamics, source)
}

/// Temperatures between which a chamber is believed \[°C\].
const ABSOLUTE_ZERO_C: f64 = -273.15;
const HOTTEST_C: f64 = 1000.0;

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
    let impossible = |t: &&f64| !(ABSOLUTE_ZERO_C..=HOTTEST_C).contains(*t);
    if let Some(t) = inferred.chamber.iter().find(impossible) {
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
        notes,
        fingerprint,
        between: Between::Linear,
        step: None,
    })
}

/// As [`model`], with temperature and strain of every turn for [`crate::figures`]; those take 1 kB a turn and drive.
///
/// # Errors
/// As [`model`].
pub fn model_with_fields(case: &CoilCase, drives: &[Drive], cache: &Cache) -> Result<(Model, TurnFields), Error> {
    let build = || Dynamics::with_fields(&case.design, drives, &STANDARD);
    let ((dynamics, fields), source) = load_or_build(case, drives, cache, "dynamics and fields", build)?;
    Ok((assembled(case, drives, cache, dynamics, source)?, fields))
}

fn load_or_build<T: Serialize + DeserializeOwned>(
    case: &CoilCase,
    drives: &[Drive],
    cache: &Cache,
    purpose: &str,
    build: impl FnOnce() -> Result<T, coil::Error>,
) -> Result<(T, Source), Error> {
    let at = Error::of_coil(&case.file);
    cache.load_or_build(purpose, &(&case.design, drives, STANDARD, COARSER), || build().map_err(at))
}

fn assembled(case: &CoilCase, drives: &[Drive], cache: &Cache, dynamics: Dynamics, source: Source) -> Result<Model, Error> {
    let (coarser, _) = load_or_build(case, drives, cache, "coarser dynamics", || Dynamics::new(&case.design, drives, &COARSER))?;
    let key = (&case.design, STEADY, CHECKS);
    let (steady, of_steady) = cache.load_or_build("steady sensitivity", &key, || case.steady_sensitivity())?;
    Ok(Model { dynamics, coarser, steady, source: if of_steady == source { source } else { Source::Built } })
}

/// A design's model for all designs that differ from it within a box of their constants and dimensions.
#[derive(Debug, Clone)]
pub struct DesignBox {
    model: ParametricModel,
}

/// What a design of a [`DesignBox`] does under a profile.
#[derive(Debug, Clone)]
pub struct Varied {
    /// Rows of the result.
    pub rows: Vec<SimulatedRow>,
    /// Estimates, not bounds, of how far thermometer \[K\] and rate \[deg/h\] are anywhere from those of [`simulate`], which has the same mesh.
    pub errors: [f64; 2],
}

impl DesignBox {
    /// Three standard deviations of the tolerances of `case` to either side, and mounts, contacts and heaters as far as mechanisms go; from the
    /// cache if it is there. `progress` is told how far it is.
    ///
    /// # Errors
    /// [`files::Error::Coil`] if the design cannot be modelled.
    pub fn about(case: &CoilCase, cache: &Cache, progress: &(dyn Fn(Step) + Sync)) -> Result<Self, Error> {
        let all = Self { model: crate::prepare::models(case, cache, progress)?.parametric().clone() };
        // a heater of its own is no part of what a diagnosis needs
        if all.model.outside(&case.design).is_some() { all.including(case) } else { Ok(all) }
    }

    /// The box made anew, so wide that it holds `case`, too.
    ///
    /// # Errors
    /// As [`Self::about`].
    pub fn including(&self, case: &CoilCase) -> Result<Self, Error> {
        Ok(Self { model: self.model.including(&case.design, &|| ()).map_err(Error::of_coil(&case.file))? })
    }

    /// Runs a profile from rest at its first instant.
    ///
    /// # Errors
    /// As [`simulate`], and [`files::Error::Coil`] if the design lies outside the box or cannot be reached.
    pub fn simulate(&self, case: &CoilCase, profile: &ProfileCase) -> Result<Varied, Error> {
        if let Some(drive) = profile.drives.iter().find(|drive| !matches!(drive, Drive::Chamber | Drive::Heaters)) {
            return Err(Error::usage(format!(
                "a box of designs is driven by its chamber alone; leave out {drive:?} of the profile"
            )));
        }
        let [dynamics, coarser @ ..] = Dynamics::varied(&self.model, &case.design).map_err(Error::of_coil(&case.file))?;
        let rows = run(&dynamics, profile)?.into_iter().enumerate().map(|(n, r)| SimulatedRow::of(profile, n, r)).collect();
        let at = Error::of_coil(&profile.fingerprint.file);
        let [spool, rate] = dynamics.distance(&coarser, &course(profile)).map_err(at)?;
        if !(spool.is_finite() && rate.is_finite()) {
            return Err(Error::NotFinite { file: profile.fingerprint.file.clone(), time: profile.profile.time[0] });
        }
        Ok(Varied { rows, errors: [MODEL_SAFETY * spool, MODEL_SAFETY * DEG_PER_H_PER_RAD_PER_S * rate] })
    }
}

/// A profile's responses at its rows.
fn run(dynamics: &Dynamics, profile: &ProfileCase) -> Result<Vec<Response>, Error> {
    let file = &profile.fingerprint.file;
    let responses = by_row(dynamics.simulate(&course(profile)).map_err(Error::of_coil(file))?, profile.between.parts());
    match responses.iter().position(|r| !(r.sensor.is_finite() && r.rate().is_finite())) {
        Some(row) => Err(Error::NotFinite { file: file.clone(), time: profile.profile.time[row] }),
        None => Ok(responses),
    }
}

/// A profile as it is run: divided where it is a cubic between its rows.
fn course(profile: &ProfileCase) -> Cow<'_, Profile> {
    match profile.between.parts() {
        1 => Cow::Borrowed(&profile.profile),
        parts => Cow::Owned(profile.profile.smoothed(parts)),
    }
}

/// Runs a profile from rest at its first instant.
///
/// # Errors
/// [`files::Error::Coil`] if the profile cannot be run; [`Error::NotFinite`] if the model gives no number.
pub fn simulate<'a>(case: &'a CoilCase, profile: &'a ProfileCase, model: &Model) -> Result<Simulation<'a>, Error> {
    let (responses, coarser) = (run(&model.dynamics, profile)?, run(&model.coarser, profile)?);
    let samples = samples(&model.dynamics, &course(profile)).map_err(Error::of_coil(&profile.fingerprint.file))?;
    let (reduction, modes) = (model.dynamics.reduction_error(), model.dynamics.reduced().rates().len());
    Ok(Simulation {
        case,
        profile,
        steady: model.steady,
        reduction,
        modes,
        source: model.source,
        responses,
        coarser,
        samples,
        added: Vec::new(),
    })
}

/// Responses at the rows of a course that was divided into `parts` between each two: the means of a row are those of its parts.
fn by_row(responses: Vec<Response>, parts: usize) -> Vec<Response> {
    if parts == 1 {
        return responses;
    }
    let mean = |part: &[Response]| {
        let share = 1.0 / part.len() as f64;
        let bias = part.iter().fold(Bias::ZERO, |sum, r| sum + r.bias) * share;
        let read_out = part.iter().map(|r| r.read_out).sum::<f64>() * share;
        Response { bias, read_out, ..part[part.len() - 1] }
    };
    responses[..1].iter().copied().chain(responses[1..].chunks(parts).map(mean)).collect()
}

/// The states at the middles of [`SAMPLES`] equal intervals.
fn samples(dynamics: &Dynamics, course: &Profile) -> Result<Vec<Sample>, coil::Error> {
    let (time, mut samples) = (&course.time, Vec::with_capacity(SAMPLES));
    let instant = |k: usize| time[0] + (time[time.len() - 1] - time[0]) * (k as f64 + 0.5) / SAMPLES as f64;
    for (step, ends) in dynamics.steps(course)?.zip(time.windows(2)) {
        while samples.len() < SAMPLES && instant(samples.len()) < ends[1] {
            let time = instant(samples.len());
            // a sample that rounding puts before its row is taken at the row
            samples.push(Sample { time, state: dynamics.reduced().within(&step, (time - ends[0]).max(0.0)) });
        }
    }
    Ok(samples)
}

impl Simulation<'_> {
    /// Number of rows; at least one.
    pub fn count(&self) -> usize {
        self.responses.len()
    }

    /// A row.
    ///
    /// # Panics
    /// If `n` is not less than [`Simulation::count`].
    pub fn row(&self, n: usize) -> SimulatedRow {
        self.row_of(n, self.responses[n])
    }

    fn row_of(&self, n: usize, response: Response) -> SimulatedRow {
        let row = SimulatedRow::of(self.profile, n, response);
        match self.added.get(n) {
            Some([spool, rate]) => SimulatedRow { spool: row.spool + spool, mechanisms: *rate, rate: row.rate + rate, ..row },
            None => row,
        }
    }

    /// Differences of the rows from those on a coarser mesh; an estimate of the mesh's error.
    pub fn differences(&self) -> impl Iterator<Item = SimulatedRow> {
        let difference = |(row, other): (SimulatedRow, SimulatedRow)| SimulatedRow {
            spool: row.spool - other.spool,
            shupe: row.shupe - other.shupe,
            eo_axial: row.eo_axial - other.eo_axial,
            eo_radial: row.eo_radial - other.eo_radial,
            read_out: row.read_out - other.read_out,
            rate: row.rate - other.rate,
            ..row
        };
        self.rows().zip(self.coarser_rows()).map(difference)
    }

    fn coarser_rows(&self) -> impl Iterator<Item = SimulatedRow> {
        self.coarser.iter().enumerate().map(|(n, response)| self.row_of(n, *response))
    }

    /// All rows.
    pub fn rows(&self) -> impl Iterator<Item = SimulatedRow> {
        (0..self.count()).map(|n| self.row(n))
    }

    /// From the first to the last instant \[s\].
    pub fn duration(&self) -> f64 {
        self.row(self.count() - 1).time - self.row(0).time
    }

    /// A warning of a thermometer outside what profiles may hold.
    pub fn warning(&self) -> Option<Note> {
        let impossible = |row: &SimulatedRow| !(ABSOLUTE_ZERO_C..=HOTTEST_C).contains(&row.spool);
        let row = self.rows().find(impossible)?;
        let text = format!(
            "spool_c is {:.0} degC at {:.0} s, outside {ABSOLUTE_ZERO_C} to {HOTTEST_C} degC; check heat.heaters and the profile",
            row.spool, row.time
        );
        Some(Remark::ImpossibleResult.warning(text).at(&self.case.file))
    }

    /// The rows in windows.
    pub fn windows(&self) -> impl Iterator<Item = Window> {
        Self::windowed(self.row(0), self.rows().skip(1))
    }

    /// The rows on a coarser mesh in windows.
    pub fn coarser_windows(&self) -> impl Iterator<Item = Window> {
        Self::windowed(self.row(0), self.coarser_rows().skip(1))
    }

    pub(crate) fn windowed(first: SimulatedRow, rows: impl Iterator<Item = SimulatedRow>) -> impl Iterator<Item = Window> {
        let (mut start, mut last, mut turned) = (first, first, 0.0);
        rows.filter_map(move |row| {
            turned += row.rate * (row.time - last.time);
            last = row;
            let span = row.time - start.time;
            if span < (1.0 - JITTER) * WINDOW_S {
                return None;
            }
            let spool_rate = (row.spool - start.spool) / span * K_PER_MIN_PER_K_PER_S;
            let window = Window { time: row.time, spool_rate, rate: turned / span };
            (start, turned) = (row, 0.0);
            Some(window)
        })
    }

    /// Writes the result; every number reads back to the same double.
    ///
    /// # Errors
    /// What `out` says.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        const OWN: Column = ("mechanisms_deg_per_h", |row| row.mechanisms);
        let columns: Vec<Column> = COLUMNS.into_iter().chain((!self.added.is_empty()).then_some(OWN)).collect();
        let line = |of: &dyn Fn(&Column) -> String| columns.iter().map(of).collect::<Vec<_>>().join(",");
        writeln!(out, "{}", line(&|(name, _)| (*name).to_owned()))?;
        self.rows().try_for_each(|row| writeln!(out, "{}", line(&|(_, of)| number(of(&row)))))
    }
}

/// The shortest text that reads back to the same double; plain between a millionth and a quadrillion.
pub(crate) fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        1e-6..1e15 => value.to_string(),
        _ => format!("{value:e}"),
    }
}
