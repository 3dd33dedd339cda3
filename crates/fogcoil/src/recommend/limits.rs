//! What the chamber can do.

use crate::Error;

/// What the chamber can do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Lowest temperature \[°C\].
    pub coldest: f64,
    /// Highest temperature \[°C\].
    pub hottest: f64,
    /// Fastest change [K/min].
    pub fastest: f64,
    /// Length of a test \[h\].
    pub hours: f64,
}

/// Shortest and longest test \[h\].
const HOURS: [f64; 2] = [2.0, 240.0];

impl Limits {
    /// Those of a usual chamber and a day, where nothing else is said.
    pub const USUAL: Self = Self { coldest: -40.0, hottest: 60.0, fastest: 2.0, hours: 24.0 };

    /// Limits that leave something to vary.
    ///
    /// # Errors
    /// [`files::Error::Usage`] names the flag at fault.
    pub fn check(&self) -> Result<(), Error> {
        let Self { coldest, hottest, fastest, hours } = *self;
        let wrong = |text: String| Err(Error::usage(text));
        if ![coldest, hottest].iter().all(|t| (-100.0..=200.0).contains(t)) {
            return wrong(format!("--coldest {coldest} --hottest {hottest}: give degrees Celsius from -100 to 200"));
        }
        if hottest - coldest < 1.0 {
            return wrong(format!("--coldest {coldest} --hottest {hottest}: leave at least one kelvin between them"));
        }
        if !(0.01..=100.0).contains(&fastest) {
            return wrong(format!("--fastest {fastest}: give K/min from 0.01 to 100"));
        }
        if !(HOURS[0]..=HOURS[1]).contains(&hours) {
            return wrong(format!("--hours {hours}: give {} to {}", HOURS[0], HOURS[1]));
        }
        Ok(())
    }

    /// Between its ends \[K\].
    pub(super) fn range(&self) -> f64 {
        self.hottest - self.coldest
    }
}
