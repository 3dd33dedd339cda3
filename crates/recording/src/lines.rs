//! Lines of a series: sinusoids that go on through it, as hum and vibration leave them.
//!
//! A line stands in one place of the spectrum, noise in all: of Hann's window, the power at a frequency is held against the mean of the frequencies
//! around it (Fisher's test of 1929, with the noise of a neighbourhood in place of that of the whole).

use nalgebra::{Complex, Matrix3, Vector3};
use std::f64::consts::TAU;

use crate::median_interval;

/// Chance of a line in a series of noise.
const CHANCE: f64 = 1e-6;
/// Chance that noise stands out at one frequency that is given.
const CHANCE_AT_ONE: f64 = 1e-3;
/// Cycles in a series from which on they are a line: fewer are a course.
const FEWEST_CYCLES: f64 = 20.0;
/// Frequencies, in steps of 1/length, on either side that tell the noise, beyond those that Hann's window fills with a line.
const AROUND: f64 = 64.0;
const OWN: f64 = 4.0;
/// Neighbours in Hann's window that tell as much as one without it: 1 + 2 (2/3)² + 2 (1/6)².
const ALIKE: f64 = 1.944;
/// Most slots of an even lattice for each row: a series of more holes is not searched.
const MOST_SLOTS: usize = 4;
/// Fewest rows.
const FEWEST_ROWS: usize = 256;

/// A sinusoid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Its period in the rows \[s\]; a faster one than two rows looks like a slower one.
    pub period: f64,
    /// Amount of the cosine and of the sine from the origin of time \[u\].
    parts: [f64; 2],
    /// Origin of time \[s\].
    start: f64,
}

impl Line {
    /// Its amplitude \[u\].
    pub fn amplitude(&self) -> f64 {
        self.parts[0].hypot(self.parts[1])
    }

    /// Its value at an instant \[s\].
    pub fn at(&self, instant: f64) -> f64 {
        let (sine, cosine) = phase(instant - self.start, 1.0 / self.period).sin_cos();
        self.parts[0] * cosine + self.parts[1] * sine
    }
}

impl Line {
    /// Amplitude of a sinusoid of its period in some rows: instants \[s\] and what the line leaves there. `None` where these rows do not tell it.
    pub fn left<'a>(&self, rows: impl Iterator<Item = (&'a f64, &'a f64)>) -> Option<f64> {
        let mut sums = [0.0; 5];
        for (t, value) in rows {
            let (sine, cosine) = phase(*t, 1.0 / self.period).sin_cos();
            let products = [cosine * cosine, sine * sine, cosine * sine, cosine * value, sine * value];
            sums.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
        }
        let [cc, ss, cs, cv, sv] = sums;
        let determinant = cc * ss - cs * cs;
        (determinant > 1e-6 * cc * ss).then(|| (cv * ss - sv * cs).hypot(sv * cc - cv * cs) / determinant)
    }
}

/// The line of a series that noise is least likely to be; `None` where noise may be it. NaN is a value that is not used.
///
/// `white` is the series whitened, in which the line is sought; `values` is the series itself, which tells its amplitude.
///
/// # Panics
/// If instants do not increase, or the series are not as long as they are.
pub fn strongest(time: &[f64], values: &[f64], white: &[f64]) -> Option<Line> {
    assert_eq!((values.len(), white.len()), (time.len(), time.len()), "a value for each instant");
    let spectrum = Spectrum::new(time, white)?;
    let bin = spectrum.line()?;
    fitted(time, values, finer(time, white, bin as f64 * spectrum.step, spectrum.step))
}

/// Whether a series has a line of a period \[s\], or of a small multiple of it. NaN is a value that is not used.
///
/// # Panics
/// If instants do not increase, or the series is not as long as they are.
pub fn has_line(time: &[f64], values: &[f64], period: f64) -> bool {
    assert_eq!(values.len(), time.len(), "a value for each instant");
    // a course leaks into all of a spectrum, its differences hardly do
    let differences: Vec<f64> = std::iter::once(f64::NAN).chain(values.windows(2).map(|pair| pair[1] - pair[0])).collect();
    let Some(spectrum) = Spectrum::new(time, &differences) else { return false };
    let bin = |multiple: f64| (1.0 / (multiple * period * spectrum.step)).round() as usize;
    [1.0, 2.0, 3.0].map(bin).into_iter().any(|bin| spectrum.bins().contains(&bin) && spectrum.chance(bin) < CHANCE_AT_ONE)
}

/// Phase of a frequency \[Hz\] after a time \[s\]; whole turns are taken off, so that long records lose no digits.
fn phase(after: f64, frequency: f64) -> f64 {
    TAU * (after * frequency).fract()
}

/// Weight of Hann's window at a share of the length.
fn hann(share: f64) -> f64 {
    0.5 - 0.5 * (TAU * share).cos()
}

/// Rows that are used: instant since the first, value and weight of the window.
fn weighed<'a>(time: &'a [f64], values: &'a [f64]) -> impl Iterator<Item = (f64, f64, f64)> + 'a {
    let (start, length) = (time[0], time[time.len() - 1] - time[0]);
    let used = time.iter().zip(values).filter(|(_, value)| value.is_finite());
    used.map(move |(t, value)| (t - start, *value, hann((t - start) / length)))
}

/// Power of a series at frequencies up to half of that of its rows.
struct Spectrum {
    /// Sums of the powers below each bin.
    sums: Vec<f64>,
    /// Distance of the bins \[Hz\].
    step: f64,
    /// Bins for each frequency of 1/length.
    filled: f64,
}

impl Spectrum {
    fn new(time: &[f64], values: &[f64]) -> Option<Self> {
        if time.len() < FEWEST_ROWS {
            return None;
        }
        assert!(time.is_sorted_by(|a, b| a < b), "instants increase");
        let usual = median_interval(time)?;
        let slots: f64 = time.windows(2).map(|pair| ((pair[1] - pair[0]) / usual).round().max(1.0)).sum();
        // the mean interval of the lattice: the median one may be off by the clock's last digit
        let interval = (time[time.len() - 1] - time[0]) / slots;
        if slots > (MOST_SLOTS * time.len()) as f64 {
            return None;
        }
        let size = (slots as usize + 1).next_power_of_two();
        let (sum, count) =
            weighed(time, values).fold((0.0, 0.0), |(sum, n), (_, value, weight)| (sum + weight * value, n + weight));
        let mut series = vec![Complex::new(0.0, 0.0); size];
        for (after, value, weight) in weighed(time, values) {
            series[(after / interval).round() as usize].re += weight * (value - sum / count);
        }
        transform(&mut series);
        let powers = series[..size / 2].iter().map(Complex::norm_sqr);
        let sums = std::iter::once(0.0).chain(powers.scan(0.0, |sum, power| {
            *sum += power;
            Some(*sum)
        }));
        Some(Self { sums: sums.collect(), step: 1.0 / (size as f64 * interval), filled: size as f64 / slots })
    }

    /// The bins that may hold a line.
    fn bins(&self) -> std::ops::Range<usize> {
        (FEWEST_CYCLES * self.filled).ceil() as usize..self.sums.len().saturating_sub(1 + (OWN * self.filled) as usize)
    }

    /// The bin that noise is least likely to fill, if that is unlikely of any.
    fn line(&self) -> Option<usize> {
        let (bin, chance) = self.bins().map(|bin| (bin, self.chance(bin))).min_by(|a, b| a.1.total_cmp(&b.1))?;
        (chance * self.bins().len() as f64 / self.filled <= CHANCE).then_some(bin)
    }

    /// Chance that noise alone has the power of a bin.
    fn chance(&self, bin: usize) -> f64 {
        let [own, around] = [OWN, OWN + AROUND].map(|reach| (reach * self.filled) as usize);
        let last = self.sums.len() - 1;
        let sides =
            [bin.saturating_sub(around)..bin.saturating_sub(own), (bin + own + 1).min(last)..(bin + around + 1).min(last)];
        let (power, count) = sides.into_iter().fold((0.0, 0.0), |(power, count), side| {
            (power + self.sums[side.end] - self.sums[side.start], count + side.len() as f64)
        });
        let told = count / self.filled / ALIKE;
        // an exponential variable over a mean of so many others
        (1.0 + (self.sums[bin + 1] - self.sums[bin]) * count / power / told).powf(-told)
    }
}

/// Discrete Fourier transform of a power of two of values, in their place (Cooley and Tukey 1965).
fn transform(series: &mut [Complex<f64>]) {
    let size = series.len();
    for n in 1..size {
        let other = n.reverse_bits() >> (size.leading_zeros() + 1);
        if n < other {
            series.swap(n, other);
        }
    }
    let mut half = 1;
    while half < size {
        let turns: Vec<Complex<f64>> = (0..half).map(|n| Complex::cis(-TAU * n as f64 / (2 * half) as f64)).collect();
        for pair in series.chunks_exact_mut(2 * half) {
            let (first, second) = pair.split_at_mut(half);
            for ((a, b), turn) in first.iter_mut().zip(second).zip(&turns) {
                (*a, *b) = (*a + *b * turn, *a - *b * turn);
            }
        }
        half *= 2;
    }
}

/// The frequency near one \[Hz\] at which the power is largest: the tip of a parabola through three logarithms of it, ever closer.
fn finer(time: &[f64], values: &[f64], mut frequency: f64, step: f64) -> f64 {
    let power = |frequency: f64| {
        let sum =
            weighed(time, values).map(|(after, value, weight)| Complex::from_polar(weight * value, phase(after, frequency)));
        sum.sum::<Complex<f64>>().norm_sqr().ln()
    };
    for apart in [0.5, 0.1, 0.02].map(|share| share * step) {
        let [low, middle, high] = [-apart, 0.0, apart].map(|by| power(frequency + by));
        let by = 0.5 * (low - high) / (low - 2.0 * middle + high) * apart;
        if by.is_finite() {
            frequency += by.clamp(-step, step);
        }
    }
    frequency
}

/// Offset, cosine and sine of a frequency \[Hz\] in a series by least squares in Hann's window.
fn fitted(time: &[f64], values: &[f64], frequency: f64) -> Option<Line> {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for (after, value, weight) in weighed(time, values) {
        let (sine, cosine) = phase(after, frequency).sin_cos();
        let row = Vector3::new(1.0, cosine, sine);
        normal += weight * row * row.transpose();
        right += weight * value * row;
    }
    let amounts = normal.try_inverse()? * right;
    Some(Line { period: 1.0 / frequency, parts: [amounts[1], amounts[2]], start: time[0] })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_the_transform_is_the_sum_that_defines_it() {
        let series: Vec<Complex<f64>> = (0..16).map(|n| Complex::new(f64::from(n * n % 7), f64::from(n % 3))).collect();
        let mut found = series.clone();
        transform(&mut found);
        for (k, found) in found.iter().enumerate() {
            let turned = |(n, value): (usize, &Complex<f64>)| value * Complex::cis(-TAU * (k * n) as f64 / 16.0);
            let sum: Complex<f64> = series.iter().enumerate().map(turned).sum();
            assert!((found - sum).norm() < 1e-12, "{k}: {found} {sum}");
        }
    }

    #[test]
    fn exact_the_window_is_one_in_the_middle_and_nothing_at_the_ends() {
        // NaN is left out
        let rows: Vec<_> = weighed(&[10.0, 11.0, 12.0, 14.0], &[1.0, f64::NAN, 2.0, 3.0]).collect();
        assert_eq!(rows, [(0.0, 1.0, 0.0), (2.0, 2.0, 1.0), (4.0, 3.0, 0.0)]);
        assert!((hann(0.25) - 0.5).abs() < 1e-15 && (hann(1.0 / 6.0) - 0.25).abs() < 1e-15);
    }

    /// Of any rows in which cosine and sine differ, many or few, however they lie; what is left of the line itself is one of its period.
    #[test]
    fn exact_the_amplitude_that_is_left() {
        let line = Line { period: 7.3, parts: [0.3, -0.2], start: 11.0 };
        let left = |time: &[f64]| {
            let wave = |t: &f64| (0.4 * (TAU * t / line.period).cos(), 0.9 * (TAU * t / line.period).sin());
            let values: Vec<f64> = time.iter().map(wave).map(|(cosine, sine)| cosine + sine).collect();
            line.left(time.iter().zip(&values))
        };
        let about = |share: f64| [share - 0.001, share + 0.001].map(|turns| turns * line.period);
        let uneven = [100.0, 100.9, 103.7, 104.1, 109.0, -3.0];
        for time in [&uneven[..], &uneven[..2], &uneven[3..], &about(0.0), &about(0.25), &about(2.125)] {
            let found = left(time).expect("an amplitude");
            assert!((found - 0.4_f64.hypot(0.9)).abs() < 1e-9, "{time:?}: {found}");
        }
        // no row, one, and such as are whole periods or halves apart
        assert_eq!([left(&[]), left(&[5.0]), left(&[0.0, 0.5, 1.0, 3.5].map(|turns| (turns + 0.3) * line.period))], [None; 3]);
    }

    fn of_powers(powers: &[f64], filled: f64) -> Spectrum {
        let sums = std::iter::once(0.0).chain(powers.iter().scan(0.0, |sum, power| {
            *sum += power;
            Some(*sum)
        }));
        Spectrum { sums: sums.collect(), step: 1.0, filled }
    }

    /// A variable of two degrees of freedom over a mean of n such ones exceeds x with the chance (1 + x/n)⁻ⁿ, as Fisher's distribution has it.
    #[test]
    fn exact_the_chance_of_a_power_is_that_of_fisher_s_distribution() {
        let powers: Vec<f64> = (0..1000).map(|n| f64::from(n * n % 997 + n)).collect();
        for filled in [1.0, 1.5, 1.99] {
            let spectrum = of_powers(&powers, filled);
            // 20 cycles at least, and 4 steps off the end at least
            let bins = spectrum.bins();
            assert_eq!((bins.start, bins.end), ((20.0 * filled).ceil() as usize, 1000 - (4.0 * filled) as usize));
            for bin in [bins.start, bins.start + 60, 500, 900, bins.end - 1] {
                let is_beside = |n: &usize| {
                    (4.0 * filled..=68.0 * filled).contains(&(n.abs_diff(bin) as f64)) && n.abs_diff(bin) as f64 > 4.0 * filled
                };
                let around: Vec<f64> = (0..1000).filter(is_beside).map(|n| powers[n]).collect();
                let mean = around.iter().sum::<f64>() / around.len() as f64;
                let others = around.len() as f64 / filled / (1.0 + 8.0 / 9.0 + 2.0 / 36.0);
                let chance = (1.0 + powers[bin] / mean / others).powf(-others);
                assert!((spectrum.chance(bin) / chance - 1.0).abs() < 2e-3, "{filled} {bin}: {} {chance}", spectrum.chance(bin));
            }
        }
    }

    /// One bin over even ones: it is a line from the power on that noise has in one of a million series.
    #[test]
    fn exact_a_line_is_what_one_series_of_noise_in_a_million_has() {
        for filled in [1.0, 1.5, 2.0] {
            let mut powers = [1.0; 1000];
            let others = 128.0 / ALIKE;
            let bins = of_powers(&powers, filled).bins();
            let chance = 1e-6 / (bins.len() as f64 / filled);
            let least = others * (chance.powf(-1.0 / others) - 1.0);
            for (share, found) in [(0.99, None), (1.01, Some(400))] {
                powers[400] = share * least;
                assert_eq!(of_powers(&powers, filled).line(), found, "{filled} {share}");
            }
        }
    }

    /// Of a sinusoid alone, between two steps of the spectrum.
    #[test]
    fn exact_the_frequency_of_a_sinusoid_is_found_between_the_steps() {
        let time: Vec<f64> = (0..=500).map(f64::from).collect();
        for cycles in [40.3, 101.5, 180.82] {
            let values: Vec<f64> = time.iter().map(|t| (TAU * cycles * t / 500.0 + 0.4).sin()).collect();
            let found = finer(&time, &values, cycles.round() / 500.0, 1.0 / 500.0);
            assert!((found * 500.0 - cycles).abs() < 1e-5, "{cycles}: {}", found * 500.0);
        }
    }
}
