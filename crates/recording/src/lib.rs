//! Recordings: named columns of numbers over time, what is wrong with them, and what noise they carry.
//!
//! - [`check::check`] judges a [`Recording`]: gaps, jitter, repeats, clock steps, missing values, outliers, stuck and saturated
//!   stretches, resolution, suspect units. It alters nothing: it says which rows to keep and which values to use, and lists why.
//! - [`allan::allan`] is the overlapping Allan deviation with confidence intervals; gaps are allowed.
//! - [`noise::NoiseModel`] is white noise + exponentially correlated drift + rate random walk + quantisation.
//!   [`noise::identify`] finds it in a series by exact maximum likelihood, with standard errors and the terms that are significant;
//!   [`noise::Whitener`] turns series with that noise into white ones, gaps and uneven instants included.
//! - [`lag::lagging`] makes columns that stand for a slow response to a temperature.
//!
//! Conventions: instants in s; a channel has any unit u, and sizes of noise are in u, u √s (angle random walk N), u/√s (rate random
//! walk K), u s (quantisation Q). A mask is `true` where a value is used. A sample is a mean over the interval that ends at its
//! instant, or momentary. The crate touches no file.
//!
//! References: IEEE Std 952-1997, annex C (terms and Allan variance); W. J. Riley, *Handbook of Frequency Stability Analysis*, NIST SP
//! 1065 (confidence); A. C. Harvey, *Forecasting, Structural Time Series Models and the Kalman Filter* (1989) (likelihood by innovations).
//!
//! ```
//! use recording::noise::{Bounds, NoiseModel, Series, Whitener, identify};
//!
//! // 1000 samples of 30 s that alternate about 5: white noise of standard deviation 1
//! let time: Vec<f64> = (1..=1000).map(|i| 30.0 * f64::from(i)).collect();
//! let values: Vec<f64> = (0..1000).map(|i| 5.0 + f64::from(1 - 2 * ((i * i / 7) % 2))).collect();
//! let (mask, offset) = (vec![true; 1000], vec![1.0; 1000]);
//! let series = Series { time: &time, values: &values, mask: &mask, columns: &[&offset] };
//! let noise = identify(&series, &Bounds::new(30.0, &time))?;
//! assert!((noise.model.white - 1.0).abs() < 0.05);
//!
//! let whitener = Whitener::new(&noise.model, &time, &mask)?;
//! assert_eq!(whitener.apply(&values).len(), 1000);
//! # Ok::<(), recording::Error>(())
//! ```

pub mod allan;
pub mod check;
pub mod condition;
mod error;
pub mod lag;
pub mod minimise;
pub mod noise;
mod record;
mod series;
pub mod smooth;
pub mod statistics;

pub use error::Error;
pub use record::{Channel, Recording, Sampling};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
