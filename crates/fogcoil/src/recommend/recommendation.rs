//! Recommendations.

use super::bench::Odds;
use super::course::Course;
use super::programme::{Limits, Programme};

/// A programme and its separation.
#[derive(Debug, Clone)]
pub struct Ranked {
    /// The programme.
    pub programme: Programme,
    /// The information that it gives.
    pub odds: Odds,
}

/// A sensor added to a test.
#[derive(Debug, Clone)]
pub struct WithSensor {
    /// The sensor.
    pub sensor: String,
    /// The test.
    pub programme: String,
    /// The information that both give.
    pub odds: Odds,
}

/// A size at which mechanisms are compared.
#[derive(Debug, Clone)]
pub struct Size {
    /// Mechanism.
    pub id: String,
    /// Names and values of its parameters, its choice first.
    pub values: Vec<(String, f64)>,
}

/// The next steps.
#[derive(Debug, Clone)]
pub struct Recommendation {
    /// Ids to be told apart.
    pub between: Vec<String>,
    /// A check of the unit itself that decides, for each one that is a mechanism.
    pub inspections: Vec<(String, String)>,
    /// Limits of the programmes.
    pub limits: Limits,
    /// Sizes of the mechanisms.
    pub sizes: Vec<Size>,
    /// Whether the sizes and the noise were fitted to a record; else they are typical.
    pub fitted: bool,
    /// The test that is repeated for comparison, and its separation in the same time.
    pub repeat: (String, Odds),
    /// Programmes, best first.
    pub profiles: Vec<Ranked>,
    /// Sensors, with the test that is repeated and with the best programme.
    pub sensors: Vec<WithSensor>,
    /// Expected course of the best programme.
    pub course: Course,
}

impl Recommendation {
    /// Whether the best programme, or the repeated test, is expected to tell apart what it should.
    pub(crate) fn separates(&self) -> bool {
        self.profiles[0].odds.decides() || self.repeat.1.decides()
    }
}
