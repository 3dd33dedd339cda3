//! Reasons why a number cannot be determined.

use super::settling::Slowest;
use crate::{Error, Seconds};

/// A response three time constants into a ramp is 95 % of what it settles at: the longest is a third of that.
pub(super) const SETTLED: f64 = 3.0;

/// Reason why a record does not determine a number.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Absent {
    /// The temperature stands still.
    #[error(
        "there is no ramp: the temperature ranges over {range:.2} K, and only a course of {needed:.2} K stands out of its noise; record one with ramps"
    )]
    Still {
        /// Range of the temperature \[K\].
        range: f64,
        /// Range from which it is a course \[K\].
        needed: f64,
    },
    /// No ramp goes this way.
    #[error("no ramp of the record {0}s")]
    OneWay(Direction),
    /// The longest ramp is shorter than a few rows.
    #[error("the longest ramp takes {} s, fewer than {rows} rows; record at shorter intervals, or slower ramps", Seconds(*duration))]
    Fast {
        /// Its duration \[s\].
        duration: f64,
        /// Rows that it needs.
        rows: f64,
    },
    /// Its effect looks like an offset, a bias over temperature or a settling in this record.
    #[error(
        "its effect cannot be told from an offset or a bias over temperature; record a rest before and after the ramp, or ramps of several rates"
    )]
    Indistinct,
    /// The response settles more slowly than the ramps and rests last.
    #[error("responses slower than {lag} s change it, or the sensitivity beside it, by more than its errors: the unit may not have settled; {watch}", lag = Seconds(.0.lag()), watch = .0)]
    Unsettled(Watch),
    /// No temperature is held after heating and after cooling.
    #[error(
        "no temperature is held after heating and after cooling too; record rests at one temperature, reached from either side"
    )]
    NoRest,
    /// A temperature is held after heating and after cooling, and left before slow responses have settled.
    #[error(
        "a temperature is held after heating and after cooling too, but left before a response of {} s has settled, the slowest that is sought; hold it for {} s or longer each time", Seconds(lag.round()), Seconds(needed.ceil())
    )]
    ShortRest {
        /// Longest time constant that is sought \[s\].
        lag: f64,
        /// Time after which its rate counts as rest \[s\].
        needed: f64,
    },
    /// The noise cannot be identified.
    #[error("{0}")]
    Noise(#[from] Error),
}

/// How long responses are seen to settle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Watch {
    /// Longest ramp \[s\].
    pub ramp: f64,
    /// Longest rest \[s\]; 0 without one.
    pub rest: f64,
    /// So long is a response taken to be seen \[s\].
    pub settling: f64,
    /// What would have to last longer.
    pub short: Short,
}

/// What ends the time over which responses are seen to settle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Short {
    /// The ramp, which no rest exceeds.
    Both,
    /// The rest.
    Rests,
    /// The ramp: the rest is longer than it can tell of.
    Ramps,
    /// Neither: the seat settles more slowly, and tells how slowly.
    Seat,
}

impl Watch {
    /// Longest time constant that is sought, in whole seconds.
    fn lag(&self) -> f64 {
        (self.settling / SETTLED).round()
    }

    /// The same beside a seat that settles so slowly: the longest of its time constants lies between the longest that are sought.
    pub(super) fn beside(self, slowest: Slowest) -> Self {
        match slowest {
            Slowest::Of(lag) if SETTLED * lag > self.settling => {
                Self { settling: SETTLED * std::f64::consts::SQRT_2 * lag, short: Short::Seat, ..self }
            }
            _ => self,
        }
    }

    /// The same where a bias at rest is sought: a rest tells of it however short the ramp.
    pub(super) fn at_rest(self) -> Self {
        if self.rest > self.settling { Self { settling: self.rest, short: Short::Rests, ..self } } else { self }
    }
}

impl std::fmt::Display for Watch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (why, remedy) = match self.short {
            Short::Both => ("a third of the longest ramp", "ramps or rests"),
            Short::Rests => ("a third of the longest rest", "rests"),
            Short::Seat => ("that with which the thermometer over which a bias is sought settles", "ramps or rests"),
            Short::Ramps => ("two thirds of its ramp, in which a slower response hardly begins", "ramps"),
        };
        write!(f, "time constants are sought up to {why}: the longest ramp lasts about {} s", Seconds(self.ramp.round()))?;
        if self.rest > 0.0 {
            write!(f, ", the longest rest {} s", Seconds(self.rest.round()))?;
        }
        write!(f, "; record {remedy} that last longer")
    }
}

/// Direction of a temperature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// Upwards.
    Heating,
    /// Downwards.
    Cooling,
}

impl std::fmt::Display for Direction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Heating => "heat",
            Self::Cooling => "cool",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_ramp_is_named_by_its_direction() {
        assert_eq!(Absent::OneWay(Direction::Heating).to_string(), "no ramp of the record heats");
        assert_eq!(Absent::OneWay(Direction::Cooling).to_string(), "no ramp of the record cools");
    }

    const WATCH: Watch = Watch { ramp: 600.0, rest: 0.0, settling: 600.0, short: Short::Both };

    #[test]
    fn a_rest_is_told_where_there_is_one() {
        assert_eq!(
            WATCH.to_string(),
            "time constants are sought up to a third of the longest ramp: the longest ramp lasts about 600 s; record ramps or rests that last longer"
        );
        assert_eq!(
            Watch { rest: 0.6, ..WATCH }.to_string(),
            "time constants are sought up to a third of the longest ramp: the longest ramp lasts about 600 s, the longest rest 1 s; record ramps or rests that last longer"
        );
    }

    /// Longest time constants that are sought by halves: that of a slower seat lies in the middle between two.
    #[test]
    fn exact_beside_a_slower_seat_time_constants_are_sought_about_its_own() {
        let beside = WATCH.beside(Slowest::Of(250.0));
        assert!((beside.settling / (250.0 * 3.0 * 2.0_f64.sqrt()) - 1.0).abs() < 1e-15, "{beside:?}");
        assert_eq!(beside.short, Short::Seat);
        assert_eq!([Slowest::Of(200.0), Slowest::Beyond].map(|slowest| WATCH.beside(slowest)), [WATCH; 2]);
    }
}
