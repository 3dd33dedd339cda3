//! A library's responses to the chamber of one recording.

use crate::bond::Bond;
use crate::chamber::Chamber;
use crate::constants::tails;
use crate::course::{Clock, Course, Delay, Parts, Series, Undelayed, minus, product, undelayed};
use crate::curvature::Curvature;
use crate::design::heatable_flanges;
use crate::heater::{HeaterSlopes, Heating};
use crate::library::Library;
use crate::passed::{Passed, passed};
use coil::{Error, Parameter, Profile, Reduced};
use diagnosis::State;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// Change of the first chamber temperature for the effect of an unsettled start \[K\].
const OFF_REST: f64 = 1.0;

/// A recording's instants and chamber, and what every model of a library does under it.
#[derive(Debug, Clone)]
pub struct Prepared {
    pub(crate) time: Vec<f64>,
    recorded: Chamber,
    pub(crate) delay: Delay,
    /// as it was, not as its thermometer said \[°C\]
    pub(crate) chamber: Vec<f64>,
    pub(crate) averaging: f64,
    /// noise of the chamber's thermometer in the other channels
    pub(crate) passed: Passed,
    pub(crate) course: Course,
    pub(crate) nominal: Series,
    /// sums of its parts' squares
    pub(crate) squares: [f64; 3],
    /// what the tolerances make of these
    pub(crate) spread: [f64; 3],
    /// mean temperature of the coil \[°C\]
    pub(crate) coil: Vec<f64>,
    /// its derivatives by every constant, SI
    pub(crate) coil_slopes: Vec<Vec<f64>>,
    /// its change per second by which the chamber's readings are later \[K/s\]
    pub(crate) coil_later: Vec<f64>,
    pub(crate) state: State,
    /// change per kelvin that the start was off the first chamber temperature
    pub(crate) off_rest: Series,
    /// rate of change of everything \[1/s\], and the rate of that \[1/s²\]
    pub(crate) rates: [Series; 2],
    /// change per second by which the chamber's readings are later
    pub(crate) later: Series,
    /// change per second² of the squared lag of the chamber's thermometer where the delay is kept
    pub(crate) slower: Series,
    /// phase of a ∂n/∂T that is curved about the usual reference, differenced \[deg/h per 1/K²\]
    pub(crate) curved: Vec<f64>,
    /// change per metre of the CW tail
    pub(crate) tail: Parts,
    /// derivatives by every constant, SI
    pub(crate) slopes: Vec<Series>,
    /// of the constant that a path of heat follows, the change that does to the thermometer what one unit of each constant does, SI
    pub(crate) alike: Vec<f64>,
    /// place and value of the spool's expansion among the constants
    expansion: Option<(usize, f64)>,
    /// parts at each node of the transverse modulus, with the nominal α_r and per unit of its factor
    pub(crate) modulus: Vec<(f64, Parts, Parts)>,
    pub(crate) paths: Vec<Along>,
    /// of each flange whose bond can open: open minus closed
    pub(crate) bonds: Vec<Bond<Parts>>,
    /// of each flange that may be heated
    pub(crate) heaters: Vec<Heating>,
    heater_slopes: Arc<[OnceLock<HeaterSlopes>]>,
    /// further columns by their names
    pub(crate) columns: BTreeMap<String, Vec<f64>>,
    /// what of Earth's rate the gyroscope turned with \[deg/h\], if it was told
    pub(crate) earth: Option<f64>,
}

/// Changes along a path of heat.
#[derive(Debug, Clone)]
pub(crate) struct Along {
    pub(crate) id: String,
    pub(crate) place: usize,
    /// coordinate of the library's own design
    pub(crate) own: f64,
    pub(crate) nodes: Vec<f64>,
    /// at every node, less that of this design
    pub(crate) changes: Vec<Series>,
}

impl Prepared {
    /// Derivatives of the response to a watt in a flange, of those that may be heated: worked out once, wherever the constants go from there.
    ///
    /// # Errors
    /// [`Error`] names the dimension or property at fault.
    pub(crate) fn heater_slopes(&self, library: &Library, place: usize) -> Result<&HeaterSlopes, Error> {
        let known = &self.heater_slopes[place];
        if let Some(slopes) = known.get() {
            return Ok(slopes);
        }
        let (side, model) = (heatable_flanges(library.design())[place], &library.heaters[place]);
        let clock = Clock::new(&self.time, &self.chamber, self.averaging);
        let slopes = HeaterSlopes::new(library, side, model, &clock, &self.heaters[place])?;
        Ok(known.get_or_init(|| slopes))
    }

    /// Instants \[s\].
    pub fn time(&self) -> &[f64] {
        &self.time
    }

    /// Temperature of the chamber in every row, freed of its sensor's noise \[°C\].
    pub fn chamber(&self) -> &[f64] {
        &self.chamber
    }

    /// Mean temperature of the coil as designed in every row \[°C\].
    pub fn coil(&self) -> &[f64] {
        &self.coil
    }

    /// Temperature of the spool's thermometer as designed in every row \[°C\].
    pub fn spool(&self) -> &[f64] {
        &self.nominal.sensor
    }

    /// Bias parts as designed in every row \[deg/h\].
    pub fn parts(&self) -> &Parts {
        &self.nominal.parts
    }

    /// Runs every model of `library` under a chamber temperature \[°C\] that was read at the rows, first freed of its sensor's noise. Readings of the
    /// rate are means over `averaging` seconds, or since the row before where that is nearer.
    ///
    /// # Errors
    /// [`Error::Profile`] names the instant that is out of order or not finite.
    pub fn new(library: &Library, time: &[f64], chamber: &[f64], averaging: f64) -> Result<Self, Error> {
        Profile { time: time.to_vec(), drives: vec![chamber.to_vec()] }.check(1)?;
        Self::run(library, time, Chamber::recorded(time, chamber, None), averaging, Delay::default())
    }

    /// The same under a chamber that was read at instants of its own, often more of them than rows.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn under(library: &Library, time: &[f64], chamber: &Chamber, averaging: f64) -> Result<Self, Error> {
        let chamber = chamber.at(time);
        Profile { time: time.to_vec(), drives: vec![chamber.values.clone()] }.check(1)?;
        Self::run(library, time, chamber, averaging, Delay::default())
    }

    /// The same recording under the models of another library, its chamber's readings late by `delay`.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn again(&self, library: &Library, delay: Delay) -> Result<Self, Error> {
        let again = Self::run(library, &self.time, self.recorded.clone(), self.averaging, delay)?;
        let heater_slopes = Arc::clone(&self.heater_slopes);
        Ok(Self { columns: self.columns.clone(), earth: self.earth, heater_slopes, ..again })
    }

    /// The same with further columns of the recording, a value for each row, that laws name.
    #[must_use]
    pub fn with_columns(self, columns: BTreeMap<String, Vec<f64>>) -> Self {
        Self { columns, ..self }
    }

    pub(crate) fn turning_with(self, earth: Option<f64>) -> Self {
        Self { earth, ..self }
    }

    /// Response of a model to a course of one of its drives, by its number, all others at 0: from rest.
    pub(crate) fn driven(&self, model: &Reduced, drive: usize, clock: &Clock) -> Series {
        let mut drives = vec![vec![0.0; clock.time.len()]; drive];
        drives.push(clock.chamber.clone());
        let rest: Vec<f64> = drives.iter().map(|drive| drive[0]).collect();
        Course::new(model, clock, &drives, &rest).series(model)
    }

    /// Parts per relative change of the spool's expansion; `None` without a spool.
    pub(crate) fn of_spool_expansion(&self) -> Option<Parts> {
        let (place, value) = self.expansion?;
        Some(self.slopes[place].parts.each_ref().map(|part| part.iter().map(|x| x * value).collect()))
    }

    /// A further column, a value for each row; `None` if the record has none of this name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns.get(name).map(Vec::as_slice)
    }

    /// Standard deviation of the noise of the chamber's thermometer \[K\].
    pub fn noise(&self) -> f64 {
        self.recorded.noise
    }

    fn run(library: &Library, time: &[f64], recorded: Chamber, averaging: f64, delay: Delay) -> Result<Self, Error> {
        let mut clock = Clock::new(time, &recorded.values, averaging);
        let Undelayed { chamber, later, slower } = undelayed(&clock.time, &clock.chamber, delay);
        clock.chamber = chamber;
        let first = clock.chamber[0];
        let run = |model: &Reduced| Course::new(model, &clock, std::slice::from_ref(&clock.chamber), &[first]);
        let course = run(&library.base);
        let base = course.series(&library.base);
        let mut nominal = library.with_curvature(&course, &base, time, averaging)?;
        // as in a simulation they are on from the first row, where all is at rest
        for (power, model) in &library.drawn_heaters {
            nominal.change(&Heating::new(model, &clock, averaging).at(model, 0.0), *power);
        }
        let off = Course::new(&library.base, &clock, std::slice::from_ref(&clock.chamber), &[first + OFF_REST]);
        // everything is linear in what drives it
        let [later, slower] = [later, slower].map(|change| {
            let first = change[0];
            Course::new(&library.base, &clock, &[change], &[first])
        });
        let coil_later = later.output(library.base.coil_mean());
        let [later, slower] = [later, slower].map(|course| course.series(&library.base));
        let paths = library.paths.iter().map(|path| {
            let change = |model: &Option<Reduced>| {
                minus(model.as_ref().map(|model| run(model).series(model)).as_ref().unwrap_or(&base), &base)
            };
            let changes = path.models.iter().map(change).collect();
            Along { id: path.id.clone(), place: path.place, own: path.own, nodes: path.nodes.clone(), changes }
        });
        let heaters = library.heaters.iter().map(|model| Heating::new(model, &clock, averaging)).collect();
        let bonds = library.bonds().iter().map(|bond| bond.map(|functionals| course.parts(functionals))).collect();
        let coil = course.output(library.base.coil_mean());
        let level = nominal.sensor.clone();
        let slopes_of = |series: &[f64]| recording::condition::slopes(time, series);
        let rate = slopes_of(&level);
        let changing =
            |of: &Series| Series { sensor: slopes_of(&of.sensor), parts: of.parts.each_ref().map(|part| slopes_of(part)) };
        let first_rates = changing(&base);
        let second_rates = changing(&first_rates);
        let [longer, sound] = [library.rewound(1.0, None)?, library.rewound(0.0, None)?];
        let tail = course.parts(&[0, 1, 2].map(|p: usize| &longer[p] - &sound[p]));
        let (slopes, coil_slopes) = clock.slopes(&library.slopes).into_iter().unzip();
        let slopes: Vec<Series> = slopes;
        let tolerances = library.constants.iter().map(|c| c.tolerance).zip(slopes.iter().map(|slope| &slope.parts));
        let all: Vec<(f64, &Parts)> = tolerances.chain([(tails(library.design(), library.tolerances()), &tail)]).collect();
        let spread = [0, 1, 2].map(|p: usize| all.iter().map(|(sd, by)| sd * sd * product(&by[p], &by[p])).sum());
        Ok(Self {
            time: time.to_vec(),
            chamber: clock.rows.iter().map(|&n| clock.chamber[n]).collect(),
            passed: passed(&library.base, recorded.left, averaging).with_model_error(&base),
            recorded,
            delay,
            averaging,
            off_rest: minus(&off.series(&library.base), &base),
            spread,
            alike: alike(&slopes, library.factored().first().map(|(place, _)| *place)),
            slopes,
            curved: Curvature::new(library, crate::REFERENCE_C)?.rates(&course, time, averaging),
            expansion: library
                .constants
                .iter()
                .position(|c| c.parameter == Parameter::SpoolExpansion)
                .map(|k| (k, library.values()[k])),
            modulus: library.of_modulus().map(|(x, n, f)| (x, course.parts(&n), course.parts(&f))).collect(),
            bonds,
            paths: paths.collect(),
            heater_slopes: library.heaters.iter().map(|_| OnceLock::new()).collect(),
            heaters,
            columns: BTreeMap::new(),
            earth: None,
            course,
            squares: nominal.parts.each_ref().map(|part| product(part, part)),
            nominal,
            later,
            slower,
            rates: [first_rates, second_rates],
            tail,
            coil,
            coil_slopes,
            coil_later,
            state: State { level, rate },
        })
    }
}

/// How much of the derivative by the constant at `place` is in that by each, by what they do to the thermometer; nothing in that of one that leaves it
/// alone.
fn alike(slopes: &[Series], place: Option<usize>) -> Vec<f64> {
    let followed = place.map(|place| &slopes[place].sensor).map(|sensor| (sensor, product(sensor, sensor)));
    let share = |slope: &Series| match followed {
        Some((sensor, square)) if square > 0.0 => product(&slope.sensor, sensor) / square,
        _ => 0.0,
    };
    slopes.iter().map(share).collect()
}

/// The spool's thermometer as designed under a chamber's readings, over gaps of which it goes on straight lines \[°C\].
///
/// # Errors
/// As [`Prepared::new`].
pub fn thermometer_under(library: &Library, time: &[f64], chamber: &[f64]) -> Result<Vec<f64>, Error> {
    let bridged = recording::condition::bridged(time, chamber);
    let chamber = bridged.as_deref().unwrap_or(chamber);
    Profile { time: time.to_vec(), drives: vec![chamber.to_vec()] }.check(1)?;
    let clock = Clock::new(time, chamber, 0.0);
    let course = Course::new(&library.base, &clock, std::slice::from_ref(&clock.chamber), &[clock.chamber[0]]);
    Ok(course.output(library.base.thermometer()))
}

impl Library {
    /// A course's thermometer and parts with the design's own curvature, which no reduced model has.
    fn with_curvature(&self, course: &Course, base: &Series, time: &[f64], averaging: f64) -> Result<Series, Error> {
        let drifts = self.design().drifts;
        let mut series = base.clone();
        if drifts.thermo_optic_curvature != 0.0 {
            let form = Curvature::new(self, drifts.reference)?;
            let curved = form.rates(course, time, averaging);
            series.parts[0].iter_mut().zip(curved).for_each(|(part, by)| *part += drifts.thermo_optic_curvature * by);
        }
        Ok(series)
    }
}
