//! Errors of a diagnosis.

/// Errors of this crate; `E` is the forward model's own.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error<E> {
    /// The forward model gave no response.
    #[error("the forward model failed: {0}")]
    Model(E),
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
