//! Errors of a diagnosis.

/// A forward model's own error, whatever it is.
pub type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Errors of this crate.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The forward model gave no response.
    #[error("the forward model failed: {0}")]
    Model(Failure),
    /// The noise of a record cannot be modelled.
    #[error(transparent)]
    Noise(#[from] recording::Error),
    /// A fit gave no finite number.
    #[error("a fit gave a number that is not finite; the forward model may give one, with its numbers away from those expected")]
    NotFinite,
    /// A mechanism has no start.
    #[error("a mechanism has no start for its fit")]
    NoStart,
    /// The model contradicts itself: a response or a state of another shape than the record's, a prior that is no distribution, a start without a
    /// value for each parameter, a weight that is no weight.
    #[error("{0}")]
    Definition(String),
    /// Records, observations or another argument do not fit the model, or there is nothing to compare.
    #[error("{0}")]
    Data(String),
}
