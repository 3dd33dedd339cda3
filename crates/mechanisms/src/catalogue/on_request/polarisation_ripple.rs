//! Two polarisation paths that interfere as their birefringence changes with temperature, as far as the source is coherent.

use crate::REFERENCE_C;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use crate::series::middles;
use diagnosis::{Parameter, Prior};
use std::f64::consts::{LN_2, PI, TAU};

pub(super) const POLARISATION_RIPPLE: Named = Named {
    id: "polarisation-ripple",
    title: "Two polarisation paths that interfere",
    stage: Stage::Optics,
    equation: "Light that crosses to the other polarisation and back interferes with light that does not. The delay between the two paths grows with the\n\
        temperature T of the coil, by a fringe every P:\n\
        \n\
        ```\n\
        bias = γ (a sin 2π(T − 20 °C)/P + b cos 2π(T − 20 °C)/P),   γ = exp(−(π m/N)² / (4 ln 2)),   m = (T − T_0)/P\n\
        ```\n\
        \n\
        T is the reading of the spool's thermometer. At T_0 the delays are equal. N = λ/Δλ is the coherence of a source whose spectrum is a normal curve with the full width Δλ at half\n\
        its height: so many fringes from T_0 the paths no longer interfere.",
    place: "The optics, beside the bias of the coil: the effect adds to the rate.",
    signature: "The rate is periodic in the temperature itself, alike on the way up and on the way down, and its amplitude decreases away from one temperature.\n\
        A slow ramp shows several periods; a fast ramp shows them in less time. Any other effect that is periodic in the temperature, such as\n\
        reflections between two faces, has the same signature.",
    source: "H. C. Lefèvre, *The Fiber-Optic Gyroscope*, 2nd ed., Artech House (2014), ch. 5; the coherence of a normal spectrum is textbook optics.",
    meaning: "two polarisation paths interfere: a ripple in the spool's temperature with period_k, largest at centre_c, gone some coherence_fringes from it",
    inspection: "repeat the test with a depolariser in the coil, or with a source of another width",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the temperature, not its rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, scene| {
        let [coldest, hottest] = scene.temperatures;
        let (middle, range) = ((coldest + hottest) / 2.0, hottest - coldest);
        let size = Prior::Normal { mean: 0.0, sd: scene.noise };
        // fringes over the range, closely enough that one of them is nowhere out of phase by more than a third of a fringe
        let most = (range / SHORTEST_K / STEP).ceil().clamp(1.0, MOST) as u32;
        let phases = [[0.5, 0.0], [0.0, 0.5], [-0.5, 0.0], [0.0, -0.5]];
        let start =
            |k: u32, [a, b]: [f64; 2]| vec![a * scene.noise, b * scene.noise, range / (STEP * f64::from(k)), middle, COHERENCE];
        let starts = (1..=most).flat_map(|k| phases.map(|phase| start(k, phase))).collect();
        Some(Offer {
            parameters: vec![
                Parameter::new("sine_deg_per_h", size),
                Parameter::new("cosine_deg_per_h", size),
                Parameter::new("period_k", Prior::LogNormal { median: 12.0, spread: 0.8 }).with_step(0.01),
                Parameter::new("centre_c", Prior::Normal { mean: middle, sd: range }),
                Parameter::new("coherence_fringes", Prior::LogNormal { median: COHERENCE, spread: 0.6 }),
            ],
            choice: None,
            starts,
        })
    },
    effect: |_, record, active| {
        let v = &active.values;
        let period = v[2].max(1e-3);
        let rate =
            middles(record.spool(), |t| visibility((t - v[3]) / period, v[4]) * wave([v[0], v[1]], (t - REFERENCE_C) / period));
        Ok(Effect::Coil(Change::of_rate(record, rate)))
    },
    extended: |_, _| None,
};

/// The shortest period from which fits start \[K\], and the step between starts \[fringes over the range\], of which there are so many at most.
const SHORTEST_K: f64 = 3.0;
const STEP: f64 = 0.6;
const MOST: f64 = 80.0;
/// Wavelength over width of a broadband source: 1550 nm and some tens of them.
const COHERENCE: f64 = 40.0;

/// Sine and cosine of so many fringes.
fn wave([a, b]: [f64; 2], fringes: f64) -> f64 {
    let (sine, cosine) = (TAU * fringes).sin_cos();
    a * sine + b * cosine
}

/// Degree of interference of paths that are so many fringes apart.
fn visibility(fringes: f64, coherence: f64) -> f64 {
    (-(PI * fringes / coherence).powi(2) / (4.0 * LN_2)).exp()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The visibility of a spectrum is its Fourier transform: Σ over the spectrum of cos(2π m ν/ν_0).
    #[test]
    fn exact_the_ripple_fades_as_the_fringes_of_a_normal_spectrum() {
        let (coherence, n) = (25.0, 4000);
        for m in [0.0, 3.0, 10.25, 18.1, 30.5] {
            let (mut sum, mut weight) = (0.0, 0.0);
            for k in -n..=n {
                // ν/ν_0 − 1 in full widths at half the height, to four of them
                let x = 4.0 * f64::from(k) / f64::from(n);
                let w = (-4.0 * LN_2 * x * x).exp();
                sum += w * (TAU * m * (1.0 + x / coherence)).cos();
                weight += w;
            }
            assert!((visibility(m, coherence) * wave([0.0, 1.0], m) - sum / weight).abs() < 1e-9, "{m}");
        }
        // nothing of size 0; the sine turns its sign with the fringes, the cosine does not, and neither does what is seen of them
        assert_eq!(wave([0.0, 0.0], 3.3), 0.0);
        assert_eq!(wave([1.0, 0.0], -3.3), -wave([1.0, 0.0], 3.3));
        assert_eq!(wave([0.0, 1.0], -3.3), wave([0.0, 1.0], 3.3));
        assert_eq!(visibility(-3.3, coherence), visibility(3.3, coherence));
    }
}
