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
    #[error("a fit gave a number that is not finite; a response of the forward model may not be")]
    NotFinite,
    /// A mechanism has no start.
    #[error("a mechanism has no start for its fit")]
    NoStart,
    /// There is nothing to compare.
    #[error("{0}")]
    Data(String),
}
