//! Water in a coil that is open to the air on one side: Fick's law in a plane sheet.

use crate::series::middles;

/// Modes that are followed one by one, and groups of the higher ones: two an octave.
const MODES: usize = 16;
const GROUPS: i32 = 20;
/// The gas constant \[J/(mol K)\], 0 °C \[K\], and the temperature at which diffusivities are told \[K\].
const GAS: f64 = 8.314_462_618;
const KELVIN: f64 = 273.15;
const TOLD_AT: f64 = KELVIN + 20.0;
/// Energy of activation of the diffusion of water in polymers, of the order of \[J/mol\].
const ACTIVATION: f64 = 40e3;

/// The diffusion of water in a sheet.
pub(super) struct Sheet {
    /// From the open face to the closed one \[m\].
    pub(super) thickness: f64,
    /// At 20 °C \[m²/s\].
    pub(super) diffusivity: f64,
}

impl Sheet {
    /// Mean content in each row, of a sheet that is alike throughout at the first; `temperature` \[°C\], `surface` the content that the open face has at once.
    pub(super) fn content(&self, time: &[f64], temperature: &[f64], surface: &[f64], first: f64) -> Vec<f64> {
        let faster = middles(temperature, |t| (ACTIVATION / GAS * (1.0 / TOLD_AT - 1.0 / (t + KELVIN))).exp());
        let modes = modes();
        let mut of_mode = vec![first; modes.len()];
        let mut mean = vec![first];
        for n in 1..time.len() {
            let step = self.diffusivity * faster[n] * (time[n] - time[n - 1]) / self.thickness.powi(2);
            let mut sum = 0.0;
            for (content, (share, rate)) in of_mode.iter_mut().zip(&modes) {
                // the surface is linear over the step: what is off from where the mode tends to decays
                let behind = (surface[n] - surface[n - 1]) / (rate * step);
                *content = surface[n] - behind + (*content - surface[n - 1] + behind) * (-rate * step).exp();
                sum += share * *content;
            }
            mean.push(sum);
        }
        mean
    }
}

/// Share of each mode in the mean content, and its rate in units of D/l²: 2/λ and λ = ((2n + 1) π/2)²; of a group, the sum and the rate that begins alike.
fn modes() -> Vec<(f64, f64)> {
    let rate = |n: usize| ((2 * n + 1) as f64 * std::f64::consts::FRAC_PI_2).powi(2);
    let alone = (0..MODES).map(|n| (2.0 / rate(n), rate(n)));
    let bound = |k: i32| (MODES as f64 * (f64::from(k) / 2.0).exp2()) as usize;
    let group = |k: i32| {
        let (from, to) = (bound(k), bound(k + 1));
        let share: f64 = (from..to).map(|n| 2.0 / rate(n)).sum();
        (share, 2.0 * (to - from) as f64 / share)
    };
    let mut all: Vec<(f64, f64)> = alone.chain((0..GROUPS).map(group)).collect();
    // what is left follows as the last group does
    let sum: f64 = all.iter().map(|(share, _)| share).sum();
    if let Some(last) = all.last_mut() {
        last.0 += 1.0 - sum;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Crank, eq. (4.18) with one face closed: 1 − Σ 8/((2n+1)²π²) exp(−(2n+1)²π²θ/4), θ = Dt/l², and 2 √(θ/π) at first.
    #[test]
    fn exact_a_sheet_fills_as_crank_s_series_says() {
        let sheet = Sheet { thickness: 5e-3, diffusivity: 3e-12 };
        let time: Vec<f64> = (0..2000).map(|n| 6e3 * f64::from(n)).collect();
        let (cold, wet) = (vec![20.0; time.len()], vec![1.0; time.len()]);
        let found = sheet.content(&time, &cold, &wet, 0.0);
        for n in [1, 3, 10, 100, 700, 1999] {
            let theta = 3e-12 * time[n] / 25e-6;
            let term = |n: usize| {
                let odd = ((2 * n + 1) as f64 * std::f64::consts::PI).powi(2);
                8.0 / odd * (-odd * theta / 4.0).exp()
            };
            let series = 1.0 - (0..20_000).map(term).sum::<f64>();
            assert!((found[n] - series).abs() < 2e-3 * series + 2e-5, "{n}: {} for {series}", found[n]);
            if theta < 0.1 {
                let short = 2.0 * (theta / std::f64::consts::PI).sqrt();
                assert!((found[n] - short).abs() < 5e-3 * short, "{n}: {} for {short}", found[n]);
            }
        }
        // drying is what filling leaves; what is as wet as the air stays so
        let dry = sheet.content(&time, &cold, &vec![0.0; time.len()], 1.0);
        assert!(dry.iter().zip(&found).all(|(a, b)| (a + b - 1.0).abs() < 1e-12));
        assert!(sheet.content(&time, &cold, &wet, 1.0).iter().all(|c| (c - 1.0).abs() < 1e-12));
    }

    /// Warmer by a temperature that makes D twice as large, the same is reached in half the time.
    #[test]
    fn exact_warmth_shortens_the_time() {
        let sheet = Sheet { thickness: 5e-3, diffusivity: 3e-12 };
        let time: Vec<f64> = (0..300).map(|n| 6e3 * f64::from(n)).collect();
        let warm = 1.0 / (1.0 / TOLD_AT - std::f64::consts::LN_2 * GAS / ACTIVATION) - KELVIN;
        let half: Vec<f64> = time.iter().map(|t| t / 2.0).collect();
        let wet = vec![1.0; time.len()];
        let slow = sheet.content(&time, &vec![20.0; time.len()], &wet, 0.0);
        let fast = sheet.content(&half, &vec![warm; time.len()], &wet, 0.0);
        assert!(warm > 30.0 && slow.iter().zip(&fast).all(|(a, b)| (a - b).abs() < 1e-12), "{warm}");
    }
}
