//! Recommendations.

use super::bench::Odds;
use super::course::Course;
use super::programme::{Limits, Programme};

/// A programme and what it tells.
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
    /// Of those that are mechanisms: a check of the unit itself that decides.
    pub inspections: Vec<(String, String)>,
    /// Within these limits.
    pub limits: Limits,
    /// At these sizes.
    pub sizes: Vec<Size>,
    /// Whether the sizes and the noise were fitted to a record; else they are typical.
    pub fitted: bool,
    /// What is repeated for comparison, and what it tells in the same time.
    pub repeat: (String, Odds),
    /// Programmes, best first.
    pub profiles: Vec<Ranked>,
    /// Sensors, with the test that is repeated and with the best programme.
    pub sensors: Vec<WithSensor>,
    /// What the best programme is expected to show.
    pub course: Course,
}
