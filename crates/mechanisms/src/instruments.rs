//! Channels with their noise, and the errors of instruments and of the model itself.

use crate::constants::{KNOWN, constants, others};
use crate::course::{RATE, SPOOL};
use crate::passed::Passed;
use coil::{Design, Tolerances};
use diagnosis::{Channel, NoisePrior, Nuisance, Prior, Role};

// order of the nuisances; the design's constants follow
pub(crate) const GAIN: usize = 0;
pub(crate) const SHUPE: usize = 1;
pub(crate) const REST: usize = 2;
pub(crate) const CHAMBER_GAIN: usize = 3;
pub(crate) const CHAMBER_DELAY: usize = 4;
pub(crate) const CHAMBER_LAG_SQUARED: usize = 5;
pub(crate) const SPOOL_GAIN: usize = 6;
pub(crate) const THERMO_OPTIC: usize = 7;
pub(crate) const TAIL: usize = 8;
pub(crate) const LAG: usize = 9;
pub(crate) const RATE_FILTER: usize = 10;
pub(crate) const RATE_DELAY: usize = 11;
pub(crate) const CONSTANTS: usize = 12;

/// White noise of thermometer \[K\] and rate \[deg/h\] in a sample where no record tells: of a thermistor, and of a tactical gyroscope.
pub const USUAL_NOISE: [f64; 2] = [0.012, 0.008];

/// Coloured noise beside white noise, each as in a sample of a minute: data sheets of gyroscopes have a bias instability of about a third of that,
/// and a random walk in a day of a sixth, over a decade from type to type.
const DRIFT: (f64, f64) = (0.3, 1.2);
const DRIFT_TIME: (f64, f64) = (5000.0, 0.8);
const WALK_IN_A_DAY: (f64, f64) = (0.18, 1.5);
const WHITE_SPREAD: f64 = 0.5;
pub(crate) const MINUTE: f64 = 60.0;
const DAY: f64 = 86_400.0;

/// Uncertainty of the size of what is passed through the coil: smoothing says how much noise is left in a quiet stretch, not at every turn of a programme.
const PASSED_SPREAD: f64 = 0.5;

/// Uncertainties of an instrument, standard deviations; a wide one stands where nothing is known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Instrument {
    /// Standard deviation of its offset \[unit of the channel\].
    pub offset_sd: Option<f64>,
    /// Standard deviation of its gain, relative.
    pub gain_sd: Option<f64>,
    /// Its time constant \[s\].
    pub lag: Option<f64>,
    /// Standard deviation of its clock \[s\].
    pub clock_sd: Option<f64>,
}

/// Uncertainties of the instruments of a record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instruments {
    /// White noise of thermometer \[K\] and rate \[deg/h\] in a sample.
    pub white: [f64; 2],
    /// The chamber's thermometer.
    pub chamber: Instrument,
    /// The spool's.
    pub spool: Instrument,
    /// The gyroscope; its gain is its scale factor.
    pub rate: Instrument,
    /// Earth's rate in the record \[deg/h\].
    pub earth: Option<f64>,
    /// Interval of rows of which nothing says whether a rate is their mean, and of which time, or when in a row a slower logger's reading was taken \[s\];
    /// 0 where it is said.
    pub unsaid: f64,
}

impl Default for Instruments {
    fn default() -> Self {
        let unknown = Instrument::default();
        Self { white: USUAL_NOISE, chamber: unknown, spool: unknown, rate: unknown, earth: None, unsaid: 0.0 }
    }
}

impl Instruments {
    /// Mean and standard deviation of the offsets of the spool's thermometer against the chamber's, and of the rate. A thermometer's offset and
    /// Earth's rate say nothing of the coil: unless both are known, anything.
    fn offsets(&self) -> [(f64, f64); 2] {
        const ANYTHING: (f64, f64) = (0.0, f64::INFINITY);
        let spool = self.spool.offset_sd.zip(self.chamber.offset_sd).map_or(ANYTHING, |(a, b)| (0.0, a.hypot(b).max(KNOWN)));
        [
            spool,
            self.earth.zip(self.rate.offset_sd).map_or(ANYTHING, |(earth, sd)| {
                let of_scale = earth * self.rate.gain_sd.unwrap_or(0.0);
                (earth, sd.hypot(of_scale).max(KNOWN))
            }),
        ]
    }

    /// Standard deviation of the delay of the rate's readings behind the spool's thermometer \[s\].
    fn rate_delay_sd(&self) -> f64 {
        let [of_spool, of_rate] = [self.spool.clock_sd, self.rate.clock_sd];
        of_spool.unwrap_or(RATE_DELAY_S).hypot(of_rate.unwrap_or(0.0)).hypot(self.unsaid / 2.0).max(KNOWN)
    }

    /// Mean and standard deviation of the delay \[s\] and of the squared lag \[s²\] of the chamber's readings.
    fn delay(&self) -> [(f64, f64); 2] {
        let Instrument { lag, clock_sd, .. } = self.chamber;
        // the spool's readings are late against the model's time, too
        let clock = clock_sd.unwrap_or(CLOCK_S).hypot(self.spool.clock_sd.unwrap_or(RATE_DELAY_S));
        let by_lag = lag.map_or(LAG_S, |lag| LAG_SHARE * lag);
        let squared = lag.map_or((0.0, LAG_SQUARED_S2), |lag| (lag * lag, (2.0 * LAG_SHARE * lag * lag).max(KNOWN)));
        [(lag.unwrap_or(0.0), clock.hypot(by_lag).max(KNOWN)), squared]
    }
}

/// Thermometer and rate in samples of `interval` \[s\].
pub(crate) fn channels(averaging: f64, instruments: &Instruments, interval: f64, passed: Passed) -> Vec<Channel> {
    let noise = |channel: usize| {
        let white = instruments.white[channel];
        let in_a_minute = white * (interval / MINUTE).sqrt();
        NoisePrior {
            white: (white, WHITE_SPREAD),
            drift: (in_a_minute * DRIFT.0, DRIFT.1),
            drift_time: DRIFT_TIME,
            walk: (in_a_minute * WALK_IN_A_DAY.0 / DAY.sqrt(), WALK_IN_A_DAY.1),
            passed: (passed.sd[channel], PASSED_SPREAD),
            passed_time: passed.time[channel].max(interval),
        }
    };
    let offsets = instruments.offsets();
    let channel = |name: &str, unit: &str, averaging: f64, number: usize| Channel {
        name: name.into(),
        unit: unit.into(),
        offset: offsets[number],
        averaging,
        noise: noise(number),
    };
    vec![channel("spool_c", "degC", 0.0, SPOOL), channel("rate_deg_per_h", "deg/h", averaging, RATE)]
}

/// Error of the forward model's gain: discretisation, and a start that was not quite at rest.
const GAIN_ERROR: f64 = 0.003;
/// Error of the Shupe part, which is a small difference of temperatures within the coil and the first to feel a coarse mesh or a coarse record.
const SHUPE_ERROR: f64 = 0.006;
const REST_ERROR_K: f64 = 0.005;

/// Gain of a thermometer about its span's middle: class B of IEC 60751 is 0.3 K + 0.5 % of the temperature.
const THERMOMETER_GAIN: f64 = 0.004;
/// Possible delay of the chamber's readings behind the gyroscope's \[s\]: a thermometer's time constant in moving air (sheathed resistors of 3 to 6 mm
/// have 20 to 90 s in an air of 1 to 3 m/s), and a clock that is read by the minute.
const LAG_S: f64 = 60.0;
const CLOCK_S: f64 = 30.0;
/// Uncertainty of a given time constant, relative: moving air is never quite the same.
const LAG_SHARE: f64 = 0.2;
/// Square of the time constant of the chamber's thermometer \[s²\]: a minute's, either way. Of a thermometer with the time constant τ on a
/// log that is late by c, the delay τ + c is the first cumulant and τ² the second: in them the response is linear, which it is not in τ and c.
const LAG_SQUARED_S2: f64 = 3600.0;

/// Square of the time constant of the gyroscope's output filter beyond its averaging \[s²\], some twenty seconds', either way.
const FILTER_SQUARED_S2: f64 = 500.0;
/// Possible delay of the rate's readings behind the spool's thermometer \[s\]: another logger, and the filter.
const RATE_DELAY_S: f64 = 5.0;
/// Its standard deviation with as much that nobody said.
const LATE_S: f64 = std::f64::consts::SQRT_2 * RATE_DELAY_S;

/// Number of the distances from a fitted delay at which a better one is sought, and the first of them in standard deviations of what it may be.
const LATE_AROUND: (u32, f64) = (15, 0.1);

/// Numbers of the instruments: name, and the column that it is of with what it is there.
const READINGS: [(&str, &str); 6] = [
    ("gain of the chamber's thermometer", "chamber_c.gain"),
    ("delay of the chamber's readings [s]", "chamber_c.delay_s"),
    ("squared lag of the chamber's thermometer [s2]", "chamber_c.lag_squared_s2"),
    ("gain of the spool's thermometer", "spool_c.gain"),
    ("squared time constant of the rate's filter [s2]", "rate_deg_per_h.filter_squared_s2"),
    ("delay of the rate's readings [s]", "rate_deg_per_h.delay_s"),
];

/// The column of a record that an instrument's number of this name is of, and what it is there, as scripts read it: `chamber_c.gain`; `None` for a name
/// of something else.
pub fn reading_of(name: &str) -> Option<&'static str> {
    READINGS.iter().find(|(known, _)| *known == name).map(|(_, key)| *key)
}

/// Everything about a unit and its `instruments` that is known to a tolerance only; `noise` is that of the chamber's thermometer \[K\], from which the
/// start is known.
pub(crate) fn nuisances(design: &Design, tolerances: &Tolerances, instruments: &Instruments, noise: f64) -> Vec<Nuisance> {
    let gain = |of: &Instrument| of.gain_sd.unwrap_or(THERMOMETER_GAIN).max(KNOWN);
    let [(delay, delay_sd), (squared, squared_sd)] = instruments.delay();
    let sensor = |reading: usize, mean: f64, sd: f64| Nuisance::normal(READINGS[reading].0, mean, sd, Role::Sensor);
    let mut all = vec![
        Nuisance::normal("gain of the rate", 1.0, GAIN_ERROR.hypot(instruments.rate.gain_sd.unwrap_or(0.0)), Role::ModelError),
        Nuisance::normal("gain of the Shupe part (model)", 1.0, SHUPE_ERROR, Role::ModelError),
        Nuisance { local: true, ..Nuisance::normal("start off rest [K]", 0.0, REST_ERROR_K.hypot(noise), Role::ModelError) },
        sensor(0, 1.0, gain(&instruments.chamber)),
        sensor(1, delay, delay_sd),
        sensor(2, squared, squared_sd),
        sensor(3, 1.0, gain(&instruments.spool)),
    ];
    all.extend(others(design, tolerances));
    if let Some(lag) = instruments.spool.lag.filter(|_| design.sensor.lag > 0.0) {
        let of_drawn = lag / design.sensor.lag;
        all[LAG].parameter.prior = Prior::Normal { mean: of_drawn, sd: (LAG_SHARE * of_drawn).max(KNOWN) };
    }
    // a mean over the row that begins at its instant is a row early, a momentary value half a row, which no averaging has smoothed
    let unsaid = instruments.unsaid;
    all.push(sensor(4, 0.0, FILTER_SQUARED_S2.hypot(unsaid * unsaid / 12.0)));
    let late_sd = instruments.rate_delay_sd();
    let mut late = sensor(5, 0.0, late_sd);
    // beside a switch within a row a delay of some seconds may look like another instant of the switch
    if late_sd > LATE_S {
        let around: Vec<f64> = (1..=LATE_AROUND.0).map(|n| f64::from(n) * LATE_AROUND.1 * late_sd).collect();
        late.parameter = late.parameter.with_search(&around);
    }
    all.push(late);
    all.extend(constants(design, tolerances).iter().map(|constant| constant.nuisance()));
    all
}

/// Whether the rate may be later than usual against the thermometer: what nobody said, of which interval it is the mean or how well its clock is set, counts
/// for more than the usual delay does.
pub(crate) fn may_be_late(nuisances: &[Nuisance]) -> bool {
    nuisances[RATE_DELAY].parameter.prior.sd() > LATE_S
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_data_sheet_narrows_what_instruments_may_be_off() {
        let usual = Instruments::default();
        assert_eq!(usual.offsets(), [(0.0, f64::INFINITY); 2]);
        let [delay, squared] = usual.delay();
        assert!(delay.0 == 0.0 && (delay.1 - 67.3).abs() < 0.1 && squared == (0.0, LAG_SQUARED_S2));
        let known = |offset_sd: f64, lag: f64, clock_sd: f64| Instrument {
            offset_sd: Some(offset_sd),
            gain_sd: Some(1e-4),
            lag: Some(lag),
            clock_sd: Some(clock_sd),
        };
        let chamber = known(0.03, 20.0, 3.0);
        let sheet = Instruments { chamber, spool: known(0.04, 5.0, 0.0), ..usual };
        let [delay, squared] = sheet.delay();
        assert!(delay == (20.0, 5.0) && squared == (400.0, 160.0), "{delay:?} {squared:?}");
        let [spool, rate] = sheet.offsets();
        assert!((spool.1 - 0.05).abs() < 1e-12 && rate.1.is_infinite());
        // one thermometer's offset alone, or a bias beside an unknown rate of Earth, says nothing
        assert!(Instruments { chamber, ..usual }.offsets()[0].1.is_infinite());
        let gyroscope = Instruments { rate: known(0.02, 0.0, 0.0), ..usual };
        assert!(gyroscope.offsets()[1].1.is_infinite());
        let (earth, sd) = Instruments { earth: Some(9.7), ..gyroscope }.offsets()[1];
        assert!(earth == 9.7 && (sd - 0.02_f64.hypot(9.7e-4)).abs() < 1e-12);
    }

    #[test]
    fn a_rate_may_be_late_where_nobody_said_when_it_was_read() {
        let late = |rate_clock_sd: f64, unsaid: f64| {
            let rate = Instrument { clock_sd: Some(rate_clock_sd), ..Instrument::default() };
            let instruments = Instruments { rate, unsaid, ..Instruments::default() };
            instruments.rate_delay_sd() > LATE_S
        };
        // a clock that is known well makes nothing later
        assert!(!late(0.0, 0.0) && !late(0.5, 0.0) && !late(0.0, 1.0));
        assert!(late(0.0, 30.0) && late(20.0, 0.0));
    }

    #[test]
    fn exact_noise_of_a_coarser_record_is_the_same_in_a_minute() {
        let white = |interval: f64| {
            let instruments =
                Instruments { white: [MINUTE / interval, 4.0 * MINUTE / interval].map(f64::sqrt), ..Instruments::default() };
            channels(0.0, &instruments, interval, Passed { sd: [0.0; 2], time: [0.0; 2] })
                .into_iter()
                .map(|channel| channel.noise)
        };
        for (fine, coarse) in white(MINUTE).zip(white(4.0 * MINUTE)) {
            assert!((fine.white.0 - 2.0 * coarse.white.0).abs() < 1e-12);
            assert!((fine.drift.0 - coarse.drift.0).abs() < 1e-12 && (fine.walk.0 - coarse.walk.0).abs() < 1e-12);
        }
    }
}
