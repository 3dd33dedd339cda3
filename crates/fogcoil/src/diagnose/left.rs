//! Residual of the rate under the best explanation.

use mechanisms::RATE as RATE_CHANNEL;
use recording::check::white_noise;

use super::Outcome;

impl Outcome<'_> {
    /// Root mean square of what the best explanation leaves of the rate in all records that were fitted, and the noise of a row: what rows of it differ by
    /// from their neighbours \[deg/h\]; `None` where a record has no noise to tell.
    pub fn left_of_rate(&self) -> Option<[f64; 2]> {
        let (mut squares, mut noise, mut count) = (0.0, 0.0, 0.0);
        for (record, channels) in self.fits.iter().zip(&self.leading().residuals) {
            let residual = &channels[RATE_CHANNEL];
            let used: Vec<bool> = residual.iter().map(|r| r.is_finite()).collect();
            let rows = used.iter().filter(|used| **used).count() as f64;
            squares += residual.iter().filter(|r| r.is_finite()).map(|r| r * r).sum::<f64>();
            noise += rows * white_noise(&record.observed.time, residual, &used)?.powi(2);
            count += rows;
        }
        (count > 0.0).then(|| [squares, noise].map(|sum: f64| (sum / count).sqrt()))
    }
}
