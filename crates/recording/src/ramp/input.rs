//! A channel as it was read \[u\], beside temperatures \[K\].

/// A channel and the temperature that drives it.
#[derive(Debug, Clone, Copy)]
pub struct Input<'a> {
    /// Instants, increasing \[s\].
    pub time: &'a [f64],
    /// The channel: means over the interval that ends at the instant \[u\].
    pub values: &'a [f64],
    /// Rows that are used; of others no value is read.
    pub mask: &'a [bool],
    /// The temperature that drives it, at every instant \[K\].
    pub drive: &'a [f64],
    /// Standard deviation of a reading of it \[K\], and the step between readings, 0 where they have none.
    pub reading: [f64; 2],
    /// The temperature over which a bias is sought at rest, at every instant \[K\].
    pub seat: &'a [f64],
    /// Usual interval between the rows \[s\].
    pub interval: f64,
    /// Span of a mean \[s\].
    pub averaging: f64,
}
