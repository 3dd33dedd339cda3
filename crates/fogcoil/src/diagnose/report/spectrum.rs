//! Whether what is left is noise: periodograms of the whitened residuals, and their whiteness.

use charts::{Axis, Cells, Figure, Panel, Series, Style, grid, significant};
use diagnosis::whiteness;
use maud::{Markup, html};
use recording::median_interval;

use super::{Quantity, Shown};
use crate::diagnose::Outcome;

/// Rows of which one periodogram is made.
const SEGMENT: usize = 4096;
/// Fewest ordinates in a mean, and how much wider each mean's band is than the one before.
const FEWEST: usize = 3;
const WIDER: f64 = 1.25;
/// Probability below which a residual is called coloured.
pub(super) const WHITE: f64 = 0.01;

impl Outcome<'_> {
    pub(super) fn spectra(&self) -> Markup {
        let of = |shown: Vec<Shown>| self.quantities().map(|q| self.spectrum(&shown, q)).collect::<Vec<_>>();
        let figure = Figure {
            id: "spectrum",
            title: "Spectrum of the whitened residuals".into(),
            description: "Mean periodogram of the whitened residual of rate and spool thermometer against frequency, which is 1 for noise."
                .into(),
            caption: "Whitened by the noise identified in the best fit; 1 is what that noise would leave. Dotted: what noise stays within \
                      at 95 % of the frequencies. An excess at low frequencies is what a model leaves out."
                .into(),
            columns: 2,
            panels: self.each().flat_map(of).collect(),
        };
        let mut rows = Vec::new();
        for fit in self.each().flatten() {
            for q in self.quantities() {
                let w = fit.whitened(q.channel);
                let p = whiteness(&w);
                let excess = w.iter().map(|w| w * w).sum::<f64>() / (w.len() as f64).max(1.0);
                rows.push(vec![self.headed(&format!("{}, {}", fit.name, q.name), fit.record), significant(excess, 3), judged(p)]);
            }
        }
        let head = ["residual", "mean square (noise: 1)", "Ljung–Box, 30 lags"];
        html! {
            (figure.element())
            (grid("Whiteness of the residuals", Cells::Words, &head, &rows))
        }
    }

    fn spectrum(&self, shown: &[Shown], q: Quantity) -> Panel<'static> {
        let mut series = Vec::new();
        for (n, fit) in shown.iter().enumerate() {
            let time = &fit.record.observed.time;
            let interval = median_interval(time).unwrap_or(1.0);
            let bands = bands(&fit.whitened(q.channel), interval);
            if n == 0 {
                let edge = |z: f64| bands.iter().map(|b| (b.frequency, chi_square(2.0 * b.count, z) / (2.0 * b.count))).collect();
                series.push(Series::new("95 % band of noise", Style::Third, edge(-Z975)));
                series.push(Series::new("", Style::Third, edge(Z975)));
            }
            let style = if n + 1 == shown.len() { Style::First } else { Style::Second };
            series.push(Series::new(fit.name, style, bands.iter().map(|b| (b.frequency, b.power)).collect()));
        }
        let (frequency, power) = (Axis::logarithmic("frequency [Hz]"), Axis::logarithmic("power over that of noise"));
        let heading = shown.first().map_or(String::new(), |fit| self.headed(q.name, fit.record));
        Panel::lines(frequency, power, 16.0, series).headed(heading)
    }
}

/// A p-value in words.
pub(super) fn judged(p: f64) -> String {
    if p.is_nan() {
        "too few rows".into()
    } else {
        let p_text = if p < 1e-3 { "p < 0.001".to_owned() } else { format!("p = {p:.3}") };
        format!("{p_text}: {}", if p < WHITE { "not white" } else { "white" })
    }
}

/// A mean over neighbouring frequencies.
struct Band {
    frequency: f64,
    power: f64,
    /// Ordinates in it.
    count: f64,
}

/// Mean periodogram of values that are white in noise, in bands that widen with the frequency; rows are taken as even.
fn bands(values: &[f64], interval: f64) -> Vec<Band> {
    let length = values.len().min(SEGMENT);
    if length < 2 * FEWEST + 2 {
        return Vec::new();
    }
    let segments: Vec<&[f64]> = values.chunks_exact(length).collect();
    let power: Vec<f64> =
        (1..=(length - 1) / 2).map(|k| segments.iter().map(|s| ordinate(s, k)).sum::<f64>() / segments.len() as f64).collect();
    let (mut bands, mut first, mut wide) = (Vec::new(), 0, FEWEST as f64);
    while first < power.len() {
        let last = (first + wide as usize).min(power.len());
        // what is left over belongs to the last whole band
        let last = if power.len() - last < wide as usize { power.len() } else { last };
        let count = (last - first) as f64;
        let middle = (first + 1 + last) as f64 / 2.0;
        bands.push(Band {
            frequency: middle / (length as f64 * interval),
            power: power[first..last].iter().sum::<f64>() / count,
            count: count * segments.len() as f64,
        });
        (first, wide) = (last, wide * WIDER);
    }
    bands
}

/// Squared modulus of the k-th Fourier sum over the number of values (Goertzel 1958).
fn ordinate(values: &[f64], k: usize) -> f64 {
    let turn = std::f64::consts::TAU * k as f64 / values.len() as f64;
    let (two_cos, mut s1, mut s2) = (2.0 * turn.cos(), 0.0, 0.0);
    for v in values {
        (s1, s2) = (v + two_cos * s1 - s2, s1);
    }
    (s1 * s1 + s2 * s2 - two_cos * s1 * s2) / values.len() as f64
}

/// 97.5th percentile of the standard normal distribution.
const Z975: f64 = 1.959_963_984_540_054;

/// Quantile of χ² with `freedom` at that of the standard normal distribution, `z` (Wilson and Hilferty 1931).
fn chi_square(freedom: f64, z: f64) -> f64 {
    let a = 2.0 / (9.0 * freedom);
    freedom * (1.0 - a + z * a.sqrt()).max(0.0).powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_periodogram_is_one_for_noise_and_peaks_at_a_tone() {
        let mut state = 1_u64;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let noise: Vec<f64> = (0..6000).map(|_| (0..12).map(|_| uniform()).sum::<f64>() - 6.0).collect();
        let of_noise = bands(&noise, 30.0);
        let mean = of_noise.iter().map(|b| b.power * b.count).sum::<f64>() / of_noise.iter().map(|b| b.count).sum::<f64>();
        assert!((mean - 1.0).abs() < 0.05, "{mean}");
        let tone: Vec<f64> = noise.iter().enumerate().map(|(n, w)| w + (n as f64 * 0.3).sin()).collect();
        let found = bands(&tone, 30.0);
        let most = found.iter().max_by(|a, b| a.power.total_cmp(&b.power)).unwrap();
        let expected = 0.3 / std::f64::consts::TAU / 30.0;
        assert!((most.frequency / expected - 1.0).abs() < 0.15, "{} against {expected}", most.frequency);
    }

    #[test]
    fn the_band_has_the_quantiles_of_chi_square() {
        // tabulated: 6 degrees, 2.5 and 97.5 %
        assert!((chi_square(6.0, -Z975) / 1.237 - 1.0).abs() < 0.03 && (chi_square(6.0, Z975) / 14.449 - 1.0).abs() < 0.005);
        assert!((chi_square(100.0, Z975) / 129.561 - 1.0).abs() < 1e-3);
    }
}
