//! A known sensitivity is found again beside coloured noise, with intervals that cover it; what must not change it does not.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "helpers of tests")]

use crate::common::{Random, even, simulate};
use recording::lag::lagging;
use recording::noise::NoiseModel;
use recording::ramp::{Absent, Direction, Estimate, Input, Response, Short, respond};

/// Instants of a programme's corners \[s\] and its temperatures \[degC\].
type Programme = [(f64, f64)];

/// An hour at rest, 100 K up at 1 K/min, an hour at rest, down again, an hour at rest.
const UP_AND_DOWN: &Programme =
    &[(0.0, -40.0), (3600.0, -40.0), (9600.0, 60.0), (13_200.0, 60.0), (19_200.0, -40.0), (22_800.0, -40.0)];

fn temperature(programme: &Programme, t: f64) -> f64 {
    let (last, first) = (programme[programme.len() - 1], programme[0]);
    let within =
        |w: &[(f64, f64)]| (w[0].0..w[1].0).contains(&t).then(|| w[0].1 + (w[1].1 - w[0].1) * (t - w[0].0) / (w[1].0 - w[0].0));
    programme.windows(2).find_map(within).unwrap_or(if t < first.0 { first.1 } else { last.1 })
}

/// Response of a unit: two time constants \[s\], none of the estimator's, with their sensitivities \[u/(K/s)\], heating and cooling.
#[derive(Clone, Copy)]
struct Unit {
    lags: [f64; 2],
    heating: [f64; 2],
    cooling: [f64; 2],
    /// bias at rest over warmth x from −1 to 1: a x + b x² \[u\]
    rest: [f64; 2],
    /// reached from below, less from above, once the way there is longer than 16 K \[u\]
    hysteresis: f64,
}

/// Sensitivity −2.7 u/(K/min).
const UNIT: Unit =
    Unit { lags: [370.0, 1530.0], heating: [-240.0, 78.0], cooling: [-240.0, 78.0], rest: [0.0; 2], hysteresis: 0.0 };

impl Unit {
    /// By steps of a second, each row the mean of its own.
    fn bias(&self, programme: &Programme, time: &[f64]) -> Vec<f64> {
        let (mut states, mut side, mut second) = ([[0.0_f64; 2]; 2], 0.0, time[0] - (time[1] - time[0]));
        let middle = programme.iter().map(|(_, t)| *t).fold(f64::NEG_INFINITY, f64::max);
        let least = programme.iter().map(|(_, t)| *t).fold(f64::INFINITY, f64::min);
        let row = |end: &f64| {
            let (mut sum, mut count) = (0.0, 0.0);
            while second < end - 0.5 {
                let rate = temperature(programme, second + 1.0) - temperature(programme, second);
                second += 1.0;
                for (k, lag) in self.lags.iter().enumerate() {
                    states[0][k] += (rate.max(0.0) - states[0][k]) / lag;
                    states[1][k] += (rate.min(0.0) - states[1][k]) / lag;
                }
                side = (side + rate / 16.0_f64).clamp(-0.5, 0.5);
                let x = 2.0 * (temperature(programme, second) - least) / (middle - least) - 1.0;
                sum += (0..2).map(|k| self.heating[k] * states[0][k] + self.cooling[k] * states[1][k]).sum::<f64>();
                sum += self.rest[0] * x + self.rest[1] * x * x + self.hysteresis * side;
                count += 1.0;
            }
            sum / count
        };
        time.iter().map(row).collect()
    }
}

impl Unit {
    /// Of time constants of 100 to 400 s and 500 to 2000 s, heating and cooling to −3.5 to −0.5 u/(K/min), and a bias at rest.
    fn drawn(seed: u64) -> Self {
        let mut random = Random::new(seed + 77_000);
        let lags = [100.0, 500.0].map(|least| least * 4.0_f64.powf(random.uniform()));
        let fast = [-240.0 + 60.0 * random.uniform(), -240.0 + 60.0 * random.uniform()];
        let slow = [30.0 + 90.0 * random.uniform(), 30.0 + 90.0 * random.uniform()];
        let rest = [0.2 + 0.3 * random.uniform(), 0.1];
        Self { lags, heating: [fast[0], slow[0]], cooling: [fast[1], slow[1]], rest, hysteresis: 0.0 }
    }

    /// Heating, cooling and their mean \[u/(K/s)\].
    fn sensitivities(&self) -> [f64; 3] {
        let [heating, cooling] = [self.heating, self.cooling].map(|parts| parts[0] + parts[1]);
        [heating, cooling, (heating + cooling) / 2.0]
    }
}

struct Record {
    time: Vec<f64>,
    values: Vec<f64>,
    temperature: Vec<f64>,
    interval: f64,
    reading: f64,
}

impl Record {
    fn of(unit: &Unit, programme: &Programme, noise: &NoiseModel, reading: f64, seed: u64) -> Self {
        let interval = noise.averaging;
        let mut random = Random::new(seed);
        let time = even((programme[programme.len() - 1].0 / interval) as usize, interval);
        let noise = simulate(noise, time.len(), &mut random);
        let values = unit.bias(programme, &time).iter().zip(noise).map(|(bias, noise)| 5.0 + bias + noise).collect();
        let temperature = time.iter().map(|t| temperature(programme, *t) + reading * random.normal()).collect();
        Self { time, values, temperature, interval, reading }
    }

    fn respond(&self) -> Result<Response, Absent> {
        self.respond_over(&self.temperature)
    }

    /// With a thermometer of its own at the seat.
    fn respond_over(&self, seat: &[f64]) -> Result<Response, Absent> {
        respond(&Input {
            time: &self.time,
            values: &self.values,
            mask: &vec![true; self.time.len()],
            drive: &self.temperature,
            reading: [self.reading, 0.0],
            seat,
            interval: self.interval,
            averaging: self.interval,
        })
    }
}

/// White noise of a minute, and a walk of 0.1 over the record.
fn noise() -> NoiseModel {
    NoiseModel { walk: 7e-4, ..NoiseModel::white(0.05, 60.0) }
}

const TO_MIN: f64 = 1.0 / 60.0;

/// Records of which intervals are counted.
const DRAWS: u64 = 40;

/// Intervals that hold the truth, intervals, and the squares of the errors in standard deviations.
#[derive(Default)]
struct Coverage(usize, usize, f64);

impl Coverage {
    fn add(&mut self, estimate: Estimate, truth: f64) {
        let [low, high] = estimate.ci90();
        self.0 += usize::from(low <= truth && truth <= high);
        self.1 += 1;
        self.2 += ((estimate.value - truth) / estimate.sd).powi(2);
    }

    /// Nine tenths hold it, give or take two standard deviations of forty draws, and they are no wider than twice what the errors ask for.
    fn holds(&self, what: &str) {
        let count = self.1 as f64;
        let (share, rms) = (self.0 as f64 / count, (self.2 / count).sqrt());
        println!("{what}: {} of {} intervals hold the truth; errors are {rms:.2} standard deviations rms", self.0, self.1);
        assert!(share >= 0.80 && rms > 0.5, "{what}: {share}, {rms}");
    }
}

/// Units of which each has its own time constants: what the estimator's lack of them is an error as random as the noise.
fn coverage(noise: &NoiseModel) {
    let [mut mean, mut heating, mut cooling, mut span] = <[Coverage; 4]>::default();
    let mut refused = 0;
    for seed in 0..DRAWS {
        let unit = Unit::drawn(seed);
        let found = Record::of(&unit, UP_AND_DOWN, noise, 0.01, seed).respond().unwrap();
        let truth = unit.sensitivities();
        if matches!(found.sensitivity, Err(Absent::Unsettled(_))) {
            refused += 1;
            continue;
        }
        heating.add(found.heating.unwrap(), truth[0]);
        cooling.add(found.cooling.unwrap(), truth[1]);
        mean.add(found.sensitivity.unwrap(), truth[2]);
        // from a + b at the warm end to b − a at the cold end
        span.add(found.span.unwrap(), 2.0 * unit.rest[0]);
    }
    println!("{refused} of {DRAWS} records are not told");
    assert!(10 * refused <= DRAWS, "{refused}");
    for (coverage, what) in [(mean, "sensitivity"), (heating, "heating"), (cooling, "cooling"), (span, "span")] {
        coverage.holds(what);
    }
}

#[test]
fn intervals_hold_the_truth_beside_white_noise_and_walk() {
    coverage(&noise());
}

#[test]
fn intervals_hold_the_truth_beside_white_noise_alone() {
    coverage(&NoiseModel::white(0.05, 60.0));
}

/// A response that sets in late, as that of a coil that is warmed through its spool: two time constants near each other, with amounts that nearly cancel. Of a
/// quiet gyroscope what the estimator's own time constants miss of it is the largest error.
/// Neither the state in which the record begins nor the effect of its temperatures is known of a unit that settles for longer than the record rests.
#[test]
fn a_unit_that_settles_more_slowly_than_the_record_rests_has_no_largest_bias() {
    const SLOW: f64 = 20_000.0;
    let cycles: Vec<(f64, f64)> = (0..4)
        .flat_map(|k| [(0.0, 20.0), (1800.0, 50.0), (3600.0, 50.0), (5400.0, 20.0)].map(|(t, c)| (7200.0 * f64::from(k) + t, c)))
        .collect();
    let amounts = [-30.0, -20.0];
    let unit = Unit { lags: [4000.0, SLOW], heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
    let record = Record::of(&unit, &cycles, &NoiseModel::white(1e-4, 60.0), 0.0, 1);
    let behind = lagging(&record.time, &record.temperature, SLOW);
    let seat: Vec<f64> = record.temperature.iter().zip(behind).map(|(t, behind)| t - behind).collect();
    let found = record.respond_over(&seat).unwrap();
    println!("{:?} {:?}", found.sensitivity, found.peak);
    assert!(
        matches!(found.sensitivity, Err(Absent::Unsettled(_))) && matches!(found.peak, Err(Absent::Unsettled(_))),
        "{:?}",
        found.peak
    );
}

#[test]
#[ignore = "a minute"]
fn intervals_hold_the_truth_of_a_response_that_sets_in_late() {
    for (white, interval, least) in [(0.01, 30.0, 30), (0.05, 60.0, 15)] {
        let mut coverage = Coverage::default();
        let mut narrow = 0;
        for seed in 0..DRAWS {
            let mut random = Random::new(seed + 88_000);
            let first = 200.0 * 6.0_f64.powf(random.uniform());
            let lags = [first, first * (1.1 + 0.3 * random.uniform())];
            // a cascade of both
            let amounts = [-162.0 * lags[0] / (lags[0] - lags[1]), 162.0 * lags[1] / (lags[0] - lags[1])];
            let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
            let noise = NoiseModel { walk: 5e-5, ..NoiseModel::white(white, interval) };
            let found = Record::of(&unit, UP_AND_DOWN, &noise, 0.01, seed).respond().unwrap();
            let Ok(sensitivity) = found.sensitivity else { continue };
            narrow += usize::from(sensitivity.sd < 0.05 * 162.0);
            coverage.add(sensitivity, -162.0);
        }
        println!("{narrow} of {} within a twentieth", coverage.1);
        coverage.holds("sensitivity of a late response");
        // with the sets of halves alone errors are twice what they are said to be
        assert!(coverage.2 < 1.3 * 1.3 * coverage.1 as f64 && narrow >= least, "{} {narrow}", coverage.2);
    }
}

/// A programme as a chamber follows it that lags by so much \[s\].
fn followed(programme: &Programme, lag: f64) -> Vec<(f64, f64)> {
    let time: Vec<f64> = (0..=(programme[programme.len() - 1].0 / 30.0) as usize).map(|n| 30.0 * n as f64).collect();
    let exact: Vec<f64> = time.iter().map(|t| temperature(programme, *t)).collect();
    let behind = lagging(&time, &exact, lag);
    time.iter().zip(exact.iter().zip(behind)).map(|(t, (exact, behind))| (*t, exact - behind)).collect()
}

/// A unit that follows its chamber fast answers a corner with several times what it settles at. Noise of the chamber's thermometer must neither take the fast
/// part off nor put a slow one in its place, and hardly widens the intervals.
#[test]
fn noise_of_the_thermometer_is_no_sensitivity() {
    let (programme, truth) = (followed(UP_AND_DOWN, 80.0), 14.0);
    for reading in [0.012, 0.1] {
        for seed in 0..4 {
            let mut random = Random::new(seed + 55_000);
            let lags = [30.0, 100.0].map(|least| least * 2.0_f64.powf(random.uniform()));
            let fast = truth * (6.0 + 6.0 * random.uniform());
            let amounts = [fast, truth - fast];
            let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
            let found = Record::of(&unit, &programme, &NoiseModel::white(0.02, 30.0), reading, seed).respond().unwrap();
            let sensitivity = found.sensitivity.unwrap_or_else(|absent| panic!("{reading}: {absent}"));
            println!("{reading} K: {sensitivity:?}");
            assert!((sensitivity.value - truth).abs() < 2.576 * sensitivity.sd, "{reading}: {sensitivity:?}");
            assert!(sensitivity.sd < 0.12 * truth, "{reading}: {sensitivity:?}");
        }
    }
}

/// Time constants longer than the estimator's: nothing is told, or the interval holds what it does not see settle.
#[test]
fn intervals_hold_the_truth_of_a_slow_part() {
    let (mut coverage, mut refused) = (Coverage::default(), 0);
    for seed in 0..DRAWS {
        let mut random = Random::new(seed + 99_000);
        let lags = [400.0, 2500.0 * 2.4_f64.powf(random.uniform())];
        let slow = 5.0 + 10.0 * random.uniform();
        let amounts = [-162.0 - slow, slow];
        let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
        let found = Record::of(&unit, UP_AND_DOWN, &NoiseModel::white(0.01, 30.0), 0.01, seed).respond().unwrap();
        match found.sensitivity {
            Ok(sensitivity) => coverage.add(sensitivity, -162.0),
            Err(_) => refused += 1,
        }
    }
    println!(
        "{refused} refused, {} of {} hold the truth, {:.2}",
        coverage.0,
        coverage.1,
        (coverage.2 / coverage.1 as f64).sqrt()
    );
    assert!(coverage.1 + refused == DRAWS as usize && coverage.0 * 10 >= coverage.1 * 8, "{} of {}", coverage.0, coverage.1);
}

/// Stretches of a programme from 20 degC: minutes, and the temperature behind them.
fn stretches(of: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut t = 0.0;
    let ends = of.iter().map(|(minutes, to)| {
        t += 60.0 * minutes;
        (t, *to)
    });
    [(0.0, 20.0)].into_iter().chain(ends).collect()
}

/// A coil and its spool settle with a time constant that is longer than a third of the ramps, and noise hides that of the rate: the thermometer at the spool
/// still tells it. A sensitivity that is told holds the truth however large the noise, and slow ramps still tell it.
#[test]
fn a_thermometer_at_the_seat_tells_how_slowly_a_body_settles() {
    let cycle = [(20.0, 50.0), (20.0, 50.0), (40.0, -10.0), (20.0, -10.0), (20.0, 20.0)];
    let cycles = stretches(&[&[(20.0, 20.0)], &cycle[..], &cycle[..], &cycle[..]].concat());
    let soaks = stretches(&[(20.0, 20.0), (13.0, 45.0), (85.0, 45.0), (18.0, 10.0), (80.0, 10.0), (14.0, -15.0), (85.0, -15.0)]);
    let ramps = stretches(&[(20.0, 20.0), (67.0, 60.0), (75.0, 60.0), (100.0, -20.0), (75.0, -20.0), (80.0, 20.0), (60.0, 20.0)]);
    let lags = [900.0, 1346.0];
    // a cascade of both, −2.5 u/(K/min)
    let amounts = [-150.0 * lags[0] / (lags[0] - lags[1]), 150.0 * lags[1] / (lags[0] - lags[1])];
    let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
    for (name, programme, has_to_tell) in [("cycles", &cycles, false), ("soaks", &soaks, false), ("ramps", &ramps, true)] {
        for (seed, white) in [0.03, 0.1, 0.3].into_iter().enumerate() {
            let record = Record::of(&unit, programme, &NoiseModel::white(white, 60.0), 0.01, seed as u64);
            let exact: Vec<f64> = record.time.iter().map(|t| temperature(programme, *t)).collect();
            let mut random = Random::new(seed as u64 + 500);
            let behind = lagging(&record.time, &exact, 1346.0);
            let seat: Vec<f64> = exact.iter().zip(behind).map(|(t, behind)| t - 0.98 * behind + 0.01 * random.normal()).collect();
            let found = record.respond_over(&seat).unwrap();
            println!("{name}, {white}: {:?}", found.sensitivity);
            assert!(!has_to_tell || found.sensitivity.is_ok(), "{name}, {white}: {:?}", found.sensitivity);
            for (told, truth) in
                [(&found.sensitivity, -150.0), (&found.heating, -150.0), (&found.cooling, -150.0), (&found.asymmetry, 0.0)]
            {
                let off = told.as_ref().map_or(0.0, |told| (told.value - truth).abs() / told.sd);
                assert!(off < 2.576, "{name}, {white}: {off} {told:?}");
            }
        }
    }
}

/// What a quiet channel shows beside the time constants of the sets is an error of these where the thermometer at the seat shows that the unit settles.
#[test]
fn a_unit_that_is_seen_to_settle_is_told() {
    let (lags, amounts) = ([45.0, 160.0], [224.0, -210.0]);
    let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
    let record = Record::of(&unit, UP_AND_DOWN, &NoiseModel::white(0.0003, 30.0), 0.0, 0);
    let mut random = Random::new(500);
    let behind = lagging(&record.time, &record.temperature, 160.0);
    let seat: Vec<f64> = record.temperature.iter().zip(behind).map(|(t, behind)| t - behind + 0.01 * random.normal()).collect();
    let found = record.respond_over(&seat).unwrap();
    for (told, truth) in [(found.sensitivity, 14.0), (found.heating, 14.0), (found.cooling, 14.0), (found.asymmetry, 0.0)] {
        let told = told.unwrap_or_else(|absent| panic!("{absent}"));
        assert!((told.value - truth).abs() < 2.576 * told.sd, "{told:?}");
    }
    let span = found.span.unwrap();
    assert!(span.value < 2.576 * span.sd, "{span:?}");
}

/// A slow part of a thirtieth beside a bias of 20 over the seat's temperatures: what longer time constants change of that is little, and it is told far better
/// than by the sets of halves, to a fiftieth.
#[test]
fn a_bias_at_rest_is_told_beside_a_slow_part() {
    let (lags, amounts) = ([400.0, 3000.0], [-167.0, 5.0]);
    let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis: 0.0 };
    let mut record = Record::of(&unit, UP_AND_DOWN, &NoiseModel::white(0.0005, 60.0), 0.0, 1);
    let behind = lagging(&record.time, &record.temperature, 400.0);
    let seat: Vec<f64> = record.temperature.iter().zip(behind).map(|(t, behind)| t - behind).collect();
    record.values.iter_mut().zip(&seat).for_each(|(value, seat)| *value += 0.2 * seat);
    let span = record.respond_over(&seat).unwrap().span.unwrap();
    assert!((span.value - 20.0).abs() < 2.576 * span.sd && span.sd < 0.1, "{span:?}");
}

/// What follows the body, half an hour behind the chamber, turns when the body does.
#[test]
fn hysteresis_of_a_slow_body_is_told() {
    let corners = [-20.0, 20.0, 60.0, 20.0, -20.0, 20.0];
    let at = |(n, t): (usize, &f64)| [(10_800.0 * n as f64, *t), (10_800.0 * n as f64 + 8400.0, *t)];
    let programme: Vec<(f64, f64)> = corners.iter().enumerate().flat_map(at).collect();
    let mut record = Record::of(&UNIT, &programme, &NoiseModel::white(0.003, 60.0), 0.01, 1);
    let behind = lagging(&record.time, &record.temperature, 1800.0);
    let seat: Vec<f64> = record.temperature.iter().zip(behind).map(|(t, behind)| t - behind).collect();
    let mut side = 0.0;
    let mut before = seat[0];
    for (value, seat) in record.values.iter_mut().zip(&seat) {
        side = (side + (seat - before) / 16.0_f64).clamp(-0.5, 0.5);
        before = *seat;
        *value += 0.1 * side;
    }
    let found = record.respond_over(&seat).unwrap().hysteresis.unwrap();
    assert!((found.value - 0.1).abs() < 2.576 * found.sd && found.sd < 0.01, "{found:?}");
}

#[test]
#[ignore = "a minute"]
fn hysteresis_needs_rests_at_one_temperature() {
    // 20 degC from below, 60 degC, 20 degC from above, −20 degC, 20 degC from below
    let corners = [-20.0, 20.0, 60.0, 20.0, -20.0, 20.0];
    let at = |(n, t): (usize, &f64)| [(7200.0 * n as f64, *t), (7200.0 * n as f64 + 4800.0, *t)];
    let programme: Vec<(f64, f64)> = corners.iter().enumerate().flat_map(at).collect();
    let unit = Unit { hysteresis: 0.4, ..UNIT };
    let mut coverage = Coverage::default();
    for seed in 0..DRAWS {
        let found = Record::of(&unit, &programme, &noise(), 0.01, seed).respond().unwrap();
        coverage.add(found.hysteresis.clone().unwrap_or_else(|e| panic!("{e} {found:?}")), 0.4);
    }
    coverage.holds("hysteresis");
    let once = Record::of(&unit, UP_AND_DOWN, &noise(), 0.01, 7).respond().unwrap();
    assert_eq!(once.hysteresis, Err(Absent::NoRest));
}

/// Ramps of 80 minutes between 20, 60, 20 and -20 degC, each held for so many minutes.
fn held(minutes: f64) -> Vec<(f64, f64)> {
    let corners = [20.0, 60.0, 20.0, -20.0, 20.0, 60.0];
    let every = 4800.0 + 60.0 * minutes;
    let at = |(n, t): (usize, &f64)| [(every * n as f64, *t), (every * n as f64 + 60.0 * minutes, *t)];
    corners.iter().enumerate().flat_map(at).collect()
}

/// A temperature that is held, but not until slow responses have settled, is said to be held; held as long as is said it tells.
#[test]
fn a_short_rest_is_a_rest_that_was_short() {
    let of = |minutes: f64| Record::of(&UNIT, &held(minutes), &noise(), 0.01, 3).respond().unwrap().hysteresis;
    let Err(short) = of(30.0) else { panic!("30 minutes are enough") };
    let Absent::ShortRest { lag, needed } = short else { panic!("{short}") };
    assert!((1400.0..1900.0).contains(&lag) && (2.3..2.8).contains(&(needed / lag)), "{short}");
    assert!(
        short.to_string().starts_with("a temperature is held after heating and after cooling too, but left before "),
        "{short}"
    );
    let long = of((needed / 60.0).ceil() + 1.0);
    assert!(!matches!(long, Err(Absent::ShortRest { .. } | Absent::NoRest)), "{long:?}");
}

/// Steps of five minutes between temperatures, with rests of so many seconds: 40 and 20 degC, reached from either side, and 0.
fn steps(rest: f64) -> Vec<(f64, f64)> {
    let levels = [20.0, 40.0, 60.0, 40.0, 20.0, 0.0, -20.0, 0.0, 20.0];
    let at = |(n, level): (usize, &f64)| {
        let start = (rest + 300.0) * n as f64;
        [(start, *level), (start + rest, *level)]
    };
    levels.iter().enumerate().flat_map(at).collect()
}

/// A unit that settles far more slowly than steps last, beside noise far below what they make: what of a step is left at the rest behind it is no hysteresis.
/// Rests that are shorter than it settles tell little, or nothing.
#[test]
fn what_has_not_settled_is_no_hysteresis() {
    for (rest, hysteresis) in [(10_800.0, 0.0), (5400.0, 0.1), (1200.0, 0.0)] {
        let mut coverage = Coverage::default();
        for seed in 0..4 {
            let mut random = Random::new(seed + 66_000);
            let first = 600.0 + 600.0 * random.uniform();
            let lags = [first, first * (1.1 + 0.9 * random.uniform())];
            // a cascade of both
            let amounts = [-162.0 * lags[0] / (lags[0] - lags[1]), 162.0 * lags[1] / (lags[0] - lags[1])];
            let unit = Unit { lags, heating: amounts, cooling: amounts, rest: [0.0; 2], hysteresis };
            let found = Record::of(&unit, &steps(rest), &NoiseModel::white(0.011, 60.0), 0.01, seed).respond().unwrap();
            match found.hysteresis {
                Ok(found) => {
                    assert!((found.value - hysteresis).abs() < 3.0 * found.sd, "{rest}: {found:?}");
                    assert!(found.sd < 0.01 || rest < 3000.0, "{rest}: {found:?}");
                    coverage.add(found, hysteresis);
                }
                Err(Absent::Unsettled(watch)) => assert!(watch.short == Short::Rests && watch.rest < 3000.0, "{watch:?}"),
                Err(other) => panic!("{other}"),
            }
        }
        let [held, told] = [coverage.0, coverage.1];
        println!("rests of {rest} s: {held} of {told} intervals hold the truth");
        assert!((told == 4 || rest < 3000.0) && held + 1 >= told, "{rest}: {held} of {told}");
    }
}

/// A record that is too short for its unit says how long its ramps and rests are, which time constants are sought, and what has to be longer.
#[test]
fn what_has_not_settled_says_what_has_to_last_longer() {
    let unit =
        Unit { lags: [1500.0, 2400.0], heating: [270.0, -432.0], cooling: [270.0, -432.0], rest: [0.0; 2], hysteresis: 0.0 };
    let of = |programme: &Programme| {
        let found = Record::of(&unit, programme, &NoiseModel::white(0.01, 60.0), 0.01, 1).respond().unwrap();
        let Err(Absent::Unsettled(watch)) = found.sensitivity else { panic!("{:?}", found.sensitivity) };
        (watch, found.sensitivity.unwrap_err().to_string())
    };
    let (watch, words) = of(&steps(5400.0));
    assert!((watch.ramp - 300.0).abs() < 60.0 && (watch.rest - 5400.0).abs() < 180.0 && watch.short == Short::Ramps, "{watch:?}");
    let lag = (watch.settling / 3.0).round();
    assert!(
        (watch.settling - 2.0 * watch.ramp).abs() < 1e-9 && words.starts_with(&format!("responses slower than {lag} s ")),
        "{words}"
    );
    assert!(words.ends_with("; record ramps that last longer"), "{words}");
    // rests of half an hour between ramps of 20 minutes: the rests end what is seen
    let corners = [20.0, 60.0, 20.0, -20.0, 20.0, 60.0, 20.0];
    let at = |(n, t): (usize, &f64)| [(3000.0 * n as f64, *t), (3000.0 * n as f64 + 1800.0, *t)];
    let (watch, words) = of(&corners.iter().enumerate().flat_map(at).collect::<Vec<_>>());
    assert!(watch.short == Short::Rests && (watch.settling - watch.rest).abs() < 1e-9, "{watch:?}");
    assert!(words.ends_with("; record rests that last longer"), "{words}");
}

/// Value and standard deviation are the same but for a factor.
fn same(a: &Result<Estimate, Absent>, b: &Result<Estimate, Absent>, factor: f64) {
    let (a, b) = (a.clone().unwrap().times(factor), b.clone().unwrap());
    assert!((a.value - b.value).abs() < 0.02 * b.sd && (a.sd / b.sd - 1.0).abs() < 0.02, "{a:?} {b:?}");
}

#[test]
fn offset_origin_and_unit_change_nothing() {
    let record = Record::of(&UNIT, UP_AND_DOWN, &noise(), 0.01, 3);
    let before = record.respond().unwrap();
    for (offset, origin, unit, kelvin) in
        [(100.0, 0.0, 1.0, 0.0), (0.0, -1e6, 1.0, 0.0), (0.0, 0.0, 1.0 / 3600.0, 273.15), (0.0, 4e5, -1e3, 0.0)]
    {
        let moved = Record {
            time: record.time.iter().map(|t| t + origin).collect(),
            values: record.values.iter().map(|v| unit * (v + offset)).collect(),
            temperature: record.temperature.iter().map(|t| t + kelvin).collect(),
            ..record
        };
        let after = moved.respond().unwrap();
        for (a, b) in
            [(&before.sensitivity, &after.sensitivity), (&before.heating, &after.heating), (&before.cooling, &after.cooling)]
        {
            same(a, b, unit);
        }
        let [a, b] = [&before, &after].map(|response| response.peak.clone().unwrap());
        assert!((a.0.value * unit - b.0.value).abs() < 0.02 * b.0.sd && (a.1 + origin - b.1).abs() < 1e-6);
    }
}

#[test]
fn a_record_at_half_the_rows_says_the_same() {
    let fine = Record::of(&UNIT, UP_AND_DOWN, &NoiseModel { averaging: 30.0, white: 0.07, ..noise() }, 0.01, 5);
    let pairs = |series: &[f64]| series.chunks_exact(2).map(|pair| (pair[0] + pair[1]) / 2.0).collect();
    let ends = |series: &[f64]| series.chunks_exact(2).map(|pair| pair[1]).collect();
    let coarse = Record {
        time: ends(&fine.time),
        values: pairs(&fine.values),
        temperature: ends(&fine.temperature),
        interval: 60.0,
        ..fine
    };
    let [a, b] = [fine.respond(), coarse.respond()].map(|r| r.unwrap().sensitivity.unwrap());
    assert!((a.value - b.value).abs() < 0.5 * a.sd && (a.sd / b.sd - 1.0).abs() < 0.3, "{a:?} {b:?}");
}

#[test]
fn what_a_record_does_not_hold_is_not_told() {
    // at rest, beside a thermometer's noise
    let still = Record::of(&UNIT, &[(0.0, 20.0), (20_000.0, 20.0)], &noise(), 0.05, 1).respond();
    let Err(Absent::Still { range, needed }) = still else { panic!("{still:?}") };
    // two movements of ten standard deviations of a reading
    assert!(range < 0.5 && (needed - 2.0 * 10.0 * 0.05).abs() < 1e-12, "{range} {needed}");
    // nothing at all
    let none = Record {
        time: Vec::new(),
        values: Vec::new(),
        temperature: Vec::new(),
        ..Record::of(&UNIT, UP_AND_DOWN, &noise(), 0.01, 1)
    };
    let told = none.respond().map(|_| ()).unwrap_err().to_string();
    assert!(matches!(none.respond(), Err(Absent::Noise(_))) && !told.contains("inf"), "{told}");
    // a series that is too short is named
    let (one, two) = (vec![20.0; 100], vec![20.0; 99]);
    let input = Input {
        time: &one,
        values: &one,
        mask: &[true; 100],
        drive: &two,
        reading: [0.1, 0.0],
        seat: &one,
        interval: 30.0,
        averaging: 30.0,
    };
    let told = respond(&input).map(|_| ()).unwrap_err().to_string();
    assert!(told.contains("`drive` has 99 values where there are 100 instants"), "{told}");
    // a ramp from the first row to the last is an offset
    for reading in [0.0, 0.02] {
        let ramp = Record::of(&UNIT, &[(0.0, -40.0), (12_000.0, 60.0)], &noise(), reading, 1).respond().unwrap();
        assert_eq!(ramp.sensitivity, Err(Absent::Indistinct), "{reading}");
        assert_eq!(ramp.span, Err(Absent::Indistinct), "{reading}");
        assert!(matches!(ramp.peak, Err(Absent::Indistinct)), "{reading}");
        assert_eq!(ramp.cooling, Err(Absent::OneWay(Direction::Cooling)));
    }
    // between rests it is told, one way only
    let one_way = Record::of(&UNIT, &UP_AND_DOWN[..4], &noise(), 0.01, 1).respond().unwrap();
    let heating = one_way.heating.unwrap();
    assert_eq!(one_way.sensitivity, Ok(heating));
    assert!((heating.times(TO_MIN).value + 2.7).abs() < 4.0 * heating.times(TO_MIN).sd, "{heating:?}");
    assert_eq!(one_way.cooling, Err(Absent::OneWay(Direction::Cooling)));
    // ramps and rests of ten minutes tell nothing of a unit that takes an hour to settle
    let corners: Vec<(f64, f64)> = (0..60).map(|n| (600.0 * f64::from(n), if n % 4 < 2 { 20.0 } else { 60.0 })).collect();
    let slow = Unit { lags: [370.0, 1200.0], ..UNIT };
    let fast = Record::of(&slow, &corners, &noise(), 0.01, 1).respond().unwrap();
    assert!(matches!(fast.sensitivity, Err(Absent::Unsettled(_))), "{:?}", fast.sensitivity);
    // a jump between two rows tells nothing of rates
    let jump = Record::of(&UNIT, &[(0.0, 20.0), (9000.0, 20.0), (9060.0, 50.0), (20_000.0, 50.0)], &noise(), 0.01, 1).respond();
    assert!(matches!(jump, Err(Absent::Fast { .. })), "{jump:?}");
    // a dozen rows are too few
    let short = Record {
        time: even(12, 60.0),
        values: vec![1.0; 12],
        temperature: (0..12).map(|n| f64::from(n * n)).collect(),
        interval: 60.0,
        reading: 0.0,
    };
    assert!(matches!(short.respond(), Err(Absent::Noise(recording::Error::TooFew { .. }))), "{:?}", short.respond());
    for interval in [0.0, -60.0, f64::NAN, f64::INFINITY] {
        let none = Record {
            interval,
            ..Record { time: short.time.clone(), values: short.values.clone(), temperature: short.temperature.clone(), ..short }
        }
        .respond();
        assert!(matches!(&none, Err(Absent::Noise(error)) if error.to_string().contains("finite and above 0 s")), "{none:?}");
    }
}
