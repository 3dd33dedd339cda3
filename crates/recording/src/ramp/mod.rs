//! Response of a channel to a temperature's rate of change: the steady-ramp sensitivity, by heating and cooling, beside a bias over temperature.
//!
//! A linear system that conducts heat answers a temperature T with Σ cₖ rₖ, where rₖ is the rate of T as a first-order system of time constant τₖ
//! follows it. In a steady ramp every rₖ settles at the ramp's rate: the **sensitivity** is Σ cₖ \[u per K/s\], and no ramp of the record has to settle fully
//! for it to be told, if the record shows how it settles. The time constants go down by halves from a third of the longest ramp or rest, and, in a second
//! set, from that over √2: what the two sets differ by counts as an error, and so do two parts in a hundred of the sensitivity, by which both may miss what
//! lies between. All lags in one set miss no more than one in a thousand; where a record tells the sensitivity by these with half the error, the amounts
//! being taken to differ by no more than a few sensitivities, it is told by these. What a time constant twice as long as the longest changes beyond what noise
//! explains is an error, too; where that is more than a tenth of the sensitivity, none is told: the unit settles more slowly than the record lets it. Noise hides
//! such a change, and a bias over temperature takes its place. Where the seat is another temperature than the one that drives, its own course tells how slowly
//! the body settles, whatever the channel's noise: the time constants then begin no lower than that; of a body that settles within the ramps and rests, what
//! longer ones change counts as an error however large. Rates upwards and
//! downwards have amounts of their own where the record has both: **heating** and **cooling**, the sensitivity being their mean. Beside them
//! stand an offset, a parabola in the temperature (**span**: what it changes by over the record's range), and what settles from the state in which the
//! record begins.
//!
//! A **hysteresis** is sought beside all lags up to a third of the longest rest, in one set: a response that hardly begins in a short ramp is seen at the rest
//! behind it, where what is left of it depends on the side from which the rest was reached. What longer ones change of it counts as an error; if that is more than noise
//! explains, none is told. It begins where what drives turns, or where the seat does: both are fitted, and weighed by their likelihoods.
//!
//! What a set misses of the response, a bias over temperature takes up: as much of the largest effect is an error of the **span**, which the one set of all lags
//! tells where that leaves less.
//!
//! The temperature is freed of its thermometer's noise first ([`crate::smooth`]). Beside noisy readings the amounts of short time constants come out too
//! small, and those of long ones make up for them; beside the course that the readings make likely no amount does (regression calibration: Carroll et
//! al. 2006).
//!
//! Noise is identified beside these columns by restricted likelihood, and amounts and errors are those of generalised least squares under every
//! noise model that the likelihood does not exclude, weighed by it: coloured noise widens the intervals. Offsets, the origin of time and the unit of
//! the channel change nothing.

mod absent;
mod branches;
mod design;
mod estimate;
mod hysteresis;
mod input;
mod lags;
mod model;
mod settling;

pub use absent::{Absent, Direction, Short, Watch};
pub use estimate::Estimate;
pub use input::Input;

use crate::Error;
use crate::noise::NoiseEstimate;
use crate::series::check_length;
use crate::smooth::{resolution, smoothed};
use branches::Course;
use design::{Design, Weights};
use model::{Model, Observed, over};
use settling::Slowest;

/// A sum of amounts that a design has.
type Sum<'a> = &'a dyn Fn(&Design) -> Result<Weights, Absent>;

/// Response of a channel.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// Settled response to a steady ramp, for each K/s: the mean of heating and cooling \[u/(K/s)\].
    pub sensitivity: Result<Estimate, Absent>,
    /// The same while the temperature rises.
    pub heating: Result<Estimate, Absent>,
    /// The same while it falls.
    pub cooling: Result<Estimate, Absent>,
    /// Heating minus cooling.
    pub asymmetry: Result<Estimate, Absent>,
    /// Value at rest at one temperature, reached from below, less that reached from above \[u\].
    pub hysteresis: Result<Estimate, Absent>,
    /// Largest less least at rest over the range of temperatures \[u\].
    pub span: Result<Estimate, Absent>,
    /// Largest effect of the temperature beside the first row \[u\], and its instant \[s\].
    pub peak: Result<(Estimate, f64), Absent>,
    /// Time constants \[s\].
    pub lags: Vec<f64>,
    /// The noise beside it.
    pub noise: NoiseEstimate,
}

/// Fewest rows of a course: less is none.
const FEWEST: usize = 2;
/// No course is taken to be known better than this share of its range.
const LEAST_NOISE: f64 = 1e-6;

/// Response of a channel to a temperature.
///
/// Ramps with rests between them tell best: where a ramp turns at once into the next, a channel that follows at once differs from the smoothed temperature at each corner,
/// which looks like a response that has not settled.
///
/// Three thousand rows take some seconds; average longer records first ([`crate::condition`]).
///
/// # Errors
/// [`Absent`] where the temperature stands still, the interval is no time, the series are not of one length, or nothing can be told.
pub fn respond(input: &Input) -> Result<Response, Absent> {
    let lengths =
        [("values", input.values.len()), ("mask", input.mask.len()), ("drive", input.drive.len()), ("seat", input.seat.len())];
    lengths.iter().try_for_each(|(name, found)| check_length(name, *found, input.time.len()))?;
    if !(input.interval.is_finite() && input.interval > 0.0) {
        return Err(Error::Parameter { name: "interval", value: input.interval, range: "finite and above 0 s" }.into());
    }
    if input.time.len() < FEWEST {
        return Err(Error::TooFew { found: input.time.len(), needed: FEWEST }.into());
    }
    let range = range(input.drive);
    let step = input.reading[1];
    let noise = input.reading[0].max(step / 12.0_f64.sqrt()).max(LEAST_NOISE * range);
    let threshold = branches::threshold(range, noise, step);
    let seated = input.seat != input.drive;
    // rounding to a last digit makes noise: of a course with less, even steps are no digit
    let least = if input.reading[0] > 0.0 { input.reading[0] } else { noise };
    let digit = resolution(input.drive).min(12.0_f64.sqrt() * least);
    let free = smoothed(input.time, input.drive, Some(digit))?.values;
    let input = &Input { drive: &free, seat: if seated { input.seat } else { &free }, ..*input };
    let course = Course::new(input.time, input.drive, threshold);
    let [heats, cools] = [Direction::Heating, Direction::Cooling].map(|direction| course.ramps(direction, threshold));
    let Some(watch) = course.watched().filter(|_| heats || cools) else {
        return Err(Absent::Still { range, needed: branches::RAMP * threshold });
    };
    let observed = Observed { time: input.time, values: input.values, mask: input.mask, averaging: input.averaging };
    let design = |lags: &[f64]| Design::new(input, &course, lags, heats, cools);
    let sets_of = |settling: f64| lags::sets(settling, input.interval);
    let sets = sets_of(watch.settling)?;
    // a seat that is not the drive tells how slowly the body settles
    let slowest = if seated { settling::slowest(input, sets[0][0], watch.rest)? } else { Slowest::Of(0.0) };
    let (ramps, watch) = (watch, watch.beside(slowest));
    let sets = if watch.short == Short::Seat { sets_of(watch.settling)? } else { sets };
    let models: Vec<Model> = sets.iter().map(|lags| Model::new(design(lags), observed)).collect::<Result<_, _>>()?;
    let slower = match slowest {
        Slowest::Of(_) => Some(Model::new(design(&lags::slower(&sets[0])), observed)?),
        Slowest::Beyond => None,
    };
    let slow = slower.as_ref().map_or(Slow::Unsettled, |slower| slow(&models, slower));
    // what longer lags change of a unit that is seen to settle is an error of the sets
    let settles = seated && watch.short != Short::Seat;
    let changed = |of: &dyn Fn(&[Model]) -> Result<Estimate, Absent>| {
        let found = of(&models)?;
        let slower = slower.as_ref().filter(|_| settles).ok_or(Absent::Unsettled(watch))?;
        Ok::<_, Absent>(Estimate { sd: found.sd.hypot(of(std::slice::from_ref(slower))?.value - found.value), ..found })
    };
    let found = |models: &[Model], of: Sum| over(models, |model| model.told(&of(&model.design)?, noise));
    let coarse = |of: Sum| {
        let found = match slow {
            Slow::By(change) => found(&models, of).map(|found| Estimate { sd: found.sd.hypot(change), ..found })?,
            Slow::Unsettled => changed(&|models| found(models, of))?,
        };
        Ok::<_, Absent>(Estimate { sd: found.sd.hypot(BETWEEN * found.value), ..found })
    };
    let finer = finer(
        &models,
        |lags, size| {
            let design = design(lags);
            let known = design.apart(size);
            Model::within(design, observed, &known)
        },
        &lags::finer(&sets),
    );
    let fine = |of: Sum| {
        let Finer { model, change, .. } = finer.as_ref().ok_or(Absent::Indistinct)?;
        let found = model.told(&of(&model.design)?, noise)?;
        Ok::<_, Absent>(Estimate { sd: found.sd.hypot(*change), ..found })
    };
    let figures: [Sum; 3] = [&|design| Ok(design.sensitivity()), &|design| design.towards(Direction::Heating), &|design| {
        design.towards(Direction::Cooling)
    }];
    // so many amounts may follow what is no lag, as a hysteresis: they then contradict the sets
    let both = |of: Sum| Some((fine(of).ok()?, coarse(of).ok()?));
    let agrees = |of: &Sum| both(*of).is_none_or(|(fine, coarse)| (fine.value - coarse.value).abs() < AGREES * coarse.sd);
    let is_borne_out = matches!(slow, Slow::By(_)) && figures.iter().all(agrees);
    let is_finer = is_borne_out && both(figures[0]).is_some_and(|(fine, coarse)| fine.sd < WORTH * coarse.sd);
    let told = |of: Sum| {
        let coarse = coarse(of)?;
        Ok(if is_finer { fine(of).unwrap_or(coarse) } else { coarse })
    };
    // the change is that of the sensitivity, and no error of a difference, or of a bias at rest: those have changes of their own
    let settled =
        |of: &dyn Fn(&[Model]) -> Result<Estimate, Absent>| if matches!(slow, Slow::By(0.0)) { of(&models) } else { changed(of) };
    let hysteresis = || {
        models.iter().try_for_each(|model| hysteresis::rests(&model.design, &course, observed, input.drive, input.interval))?;
        // a response that hardly begins in a ramp is still seen at the rest behind it
        let watch = if matches!(slowest, Slowest::Beyond) { ramps } else { watch }.at_rest();
        let sets = sets_of(watch.settling)?;
        let by = |side: &[f64]| -> Result<(Estimate, f64), Absent> {
            let within = |lags: &[f64], size: Option<f64>| {
                let design = hysteresis::beside(&design(lags), side);
                let known = size.map_or(Vec::new(), |size| design.apart(size));
                Model::within(design, observed, &known)
            };
            let models: Vec<Model> = sets.iter().map(|lags| within(lags, None)).collect::<Result<_, _>>()?;
            let size = size(&models).ok_or(Absent::Indistinct)?;
            let lags = lags::finer(&sets);
            let model = within(&lags, Some(size))?;
            let found = hysteresis::hysteresis(&model)?;
            let other = hysteresis::hysteresis(&within(&lags::slower(&lags), Some(size))?)?;
            // what has not settled at a rest depends on the side from which it was reached
            if found.differs(other) {
                return Err(Absent::Unsettled(watch));
            }
            Ok((Estimate { sd: found.sd.hypot(other.value - found.value), ..found }, model.noise.log_likelihood))
        };
        // where the body turns, or where what drives it does: as the record has it
        let of_seat = seated.then(|| Course::new(input.time, input.seat, threshold).side);
        let all = std::iter::once(&course.side).chain(&of_seat).map(|side| by(side)).collect::<Result<Vec<_>, _>>()?;
        let most = all.iter().map(|(_, ln)| *ln).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = all.iter().map(|(_, ln)| (ln - most).exp()).sum();
        let each: Vec<_> = all.iter().map(|(found, ln)| ((ln - most).exp() / sum, found.value, found.sd)).collect();
        Ok(Estimate::mixed(&each))
    };
    // what a set misses of the response, a bias over temperature takes up
    let missed = |models: &[Model], share: f64| peak(models, input).map_or(0.0, |(peak, _)| share * peak.value);
    let at_rest = || {
        let with = |found: Estimate, error: f64| Estimate { sd: found.sd.hypot(error), ..found };
        let coarse = settled(&span).map(|found| with(found, missed(&models, BETWEEN)));
        let fine = finer.as_ref().filter(|_| is_borne_out).and_then(|Finer { model, slower, .. }| {
            let [models, slower] = [model, slower].map(std::slice::from_ref);
            let found = span(models).ok()?;
            let change = if slow == Slow::By(0.0) { 0.0 } else { span(slower).ok()?.value - found.value };
            Some(with(with(found, change), missed(models, WITHIN)))
        });
        coarse.map(|coarse| fine.filter(|fine| fine.sd < coarse.sd).unwrap_or(coarse))
    };
    let largest = || {
        if matches!(slowest, Slowest::Beyond) {
            // nor is the state known in which the record begins
            return Err(Absent::Unsettled(watch));
        }
        let (found, row) = peak(&models, input)?;
        // where the unit hardly settles, longer lags tell another one
        let slower =
            slower.as_ref().filter(|_| slow != Slow::By(0.0)).and_then(|model| model.sum(&model.design.thermal(row)).ok());
        let change = slower.map_or(0.0, |slower| slower.value - found.value);
        Ok((Estimate { sd: found.sd.hypot(change), ..found }, input.time[row]))
    };
    let sensitivity = told(figures[0]);
    // a mean that is not told has no part that is
    let part = |of: Sum| told(of).and_then(|found| sensitivity.clone().map(|_| found));
    // of terms that cannot be told apart no sum over temperatures is known either
    let apart = if sensitivity == Err(Absent::Indistinct) { Err(Absent::Indistinct) } else { Ok(()) };
    Ok(Response {
        heating: part(figures[1]),
        cooling: part(figures[2]),
        asymmetry: if is_finer { fine(&Design::asymmetry) } else { settled(&|models| found(models, &Design::asymmetry)) },
        hysteresis: hysteresis(),
        span: apart.clone().and_then(|()| at_rest()),
        // what a slow response and a bias over temperature make together is known where they are not told apart
        peak: if watch.short == Short::Seat { Ok(()) } else { apart }.and_then(|()| largest()),
        sensitivity,
        lags: sets.concat(),
        noise: models[0].noise.clone(),
    })
}

/// The model of all lags in one set, that of longer ones, and the change of the sensitivity between them.
struct Finer {
    model: Model,
    slower: Model,
    change: f64,
}

/// Change of the sensitivity by lags twice as long.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Slow {
    /// By a share of it that is no error any more: the record does not let the unit settle, unless it is seen to.
    Unsettled,
    /// By so much, beyond what noise explains, which counts as an error; 0 of less.
    By(f64),
}

/// Size of an amount in a set of all lags; `None` where the sensitivity is not told.
fn size(models: &[Model]) -> Option<f64> {
    let mean = over(models, |model| model.sum(&model.design.sensitivity())).ok()?;
    Some(AMOUNT * mean.value.abs().max(mean.sd)).filter(|size| *size > 0.0)
}

/// The model of all `lags` in one set; `None` where the sensitivity is not told, or changes by more than an error. Amounts
/// beside each other nearly cancel, so each is taken to be off their mean by a few times the sensitivity: `of` makes the model with that size.
fn finer(models: &[Model], of: impl Fn(&[f64], f64) -> Result<Model, Absent>, lags: &[f64]) -> Option<Finer> {
    let size = size(models)?;
    let (model, slower) = (of(lags, size).ok()?, of(&lags::slower(lags), size).ok()?);
    match slow(std::slice::from_ref(&model), &slower) {
        Slow::By(change) => Some(Finer { model, slower, change }),
        Slow::Unsettled => None,
    }
}

fn slow(models: &[Model], slower: &Model) -> Slow {
    let mean = over(models, |model| model.sum(&model.design.sensitivity()));
    let other = slower.sum(&slower.design.sensitivity());
    let Ok((mean, other)) = mean.and_then(|mean| Ok((mean, other?))) else { return Slow::By(0.0) };
    let change = (other.value - mean.value).abs();
    if !mean.differs(other) {
        Slow::By(0.0)
    } else if change <= MOST_SLOW * mean.value.abs() {
        Slow::By(change)
    } else {
        Slow::Unsettled
    }
}

/// Errors of the sets by which the finer one may differ from them.
const AGREES: f64 = 2.576;
/// Error of a set whose time constants are halves of each other, as a share of the sensitivity (1σ): of coils it misses 0.2 to 1.8 % by what lies between, of
/// two lags in a row 1 to 6 %.
const BETWEEN: f64 = 0.02;
/// The same of all lags in one set.
const WITHIN: f64 = 0.001;
/// Largest error of that set beside the coarse ones' at which it is taken.
const WORTH: f64 = 0.5;
/// Amount of a lag less the mean of all in that set (1σ), in sensitivities.
const AMOUNT: f64 = 3.0;
/// Largest change by longer lags, as a share of the sensitivity, that counts as an error: a specification is read to a tenth.
const MOST_SLOW: f64 = 0.1;

/// Largest less least of the parabola over the temperature: between the ends, or an end and its vertex.
fn span(models: &[Model]) -> Result<Estimate, Absent> {
    let amount = |number: usize| over(models, |model| model.sum(&vec![(number, 1.0)])).map_or(0.0, |estimate| estimate.value);
    let [lowest, highest] = extremes(amount(1), amount(2));
    // the ends are where the parabola has its extremes: they move to second order only
    over(models, |model| model.sum(&Design::at_rest(lowest, highest)))
}

/// Places from −1 to 1 at which slope x + curvature x² is least and largest.
fn extremes(slope: f64, curvature: f64) -> [f64; 2] {
    let vertex = (-slope / (2.0 * curvature)).clamp(-1.0, 1.0);
    let height = |x: &f64| slope * x + curvature * x * x;
    let mut places = [-1.0, 1.0, if vertex.is_finite() { vertex } else { 1.0 }];
    places.sort_by(|a, b| height(a).total_cmp(&height(b)));
    [places[0], places[2]]
}

/// The most that the temperature does, and its row.
fn peak(models: &[Model], input: &Input) -> Result<(Estimate, usize), Absent> {
    let (design, amounts) = (&models[0].design, models[0].amounts());
    let bias = |row: usize| design.thermal(row).iter().map(|(number, weight)| weight * amounts[*number]).sum::<f64>().abs();
    let rows = (0..input.time.len()).filter(|&row| input.mask[row]);
    let (row, _) = rows.map(|row| (row, bias(row))).max_by(|a, b| a.1.total_cmp(&b.1)).ok_or(Absent::Indistinct)?;
    Ok((over(models, |model| model.sum(&model.design.thermal(row)))?, row))
}

fn range(values: &[f64]) -> f64 {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    values.iter().copied().fold(f64::NEG_INFINITY, f64::max) - least
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_sizes() {
        assert_eq!(range(&[3.0, -4.0, 1.0]), 7.0);
    }

    #[test]
    fn exact_a_parabola_is_least_or_largest_at_its_vertex_where_that_is_inside() {
        assert_eq!((extremes(3.0, 3.0), extremes(3.0, -3.0)), ([-0.5, 1.0], [-1.0, 0.5]));
        assert_eq!((extremes(-1.0, 0.1), extremes(2.0, 0.0)), ([1.0, -1.0], [-1.0, 1.0]));
    }
}
