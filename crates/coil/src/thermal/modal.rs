//! Exact courses of a reduced model while its drives are linear in time.

use super::state::settled;
use super::{Output, Reduced, Step};

/// Decay and response of each mode over one interval, for as many steps as have its length.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Interval {
    /// Its length \[s\].
    pub(crate) dt: f64,
    decay: Vec<f64>,
    /// For each drive, what each mode loses per unit of its slope.
    push: Vec<Vec<f64>>,
}

impl Interval {
    /// The modes at its end, `now`, from those `before`, the drives changing at `slope`: exact.
    pub(crate) fn step(&self, before: &[f64], now: &mut [f64], slope: &[f64]) {
        now.iter_mut().zip(before).zip(&self.decay).for_each(|((now, before), decay)| *now = before * decay);
        self.push(now, slope);
    }

    /// The same in place.
    pub(crate) fn advance(&self, amplitudes: &mut [f64], slope: &[f64]) {
        amplitudes.iter_mut().zip(&self.decay).for_each(|(q, decay)| *q *= decay);
        self.push(amplitudes, slope);
    }

    /// Drive by drive: a pass over all modes at once is several times as quick as one over the drives of each.
    fn push(&self, amplitudes: &mut [f64], slope: &[f64]) {
        for (push, slope) in self.push.iter().zip(slope) {
            amplitudes.iter_mut().zip(push).for_each(|(q, push)| *q -= push * slope);
        }
    }
}

/// Drive of a mode: the sum over the drives, of which there are few.
fn forced(drive: &[f64], by: &[f64]) -> f64 {
    drive.iter().zip(by).map(|(drive, by)| drive * by).sum()
}

impl Reduced {
    /// A jump of the drives.
    pub(crate) fn jump(&self, amplitudes: &mut [f64], by: &[f64]) {
        amplitudes.iter_mut().zip(&self.drive).for_each(|(q, drive)| *q -= forced(drive, by));
    }

    /// Effect of an interval of `dt` \[s\] on each mode.
    pub(crate) fn interval(&self, dt: f64) -> Interval {
        let drives = self.drive.first().map_or(0, Vec::len);
        let push =
            |d: usize| self.rates.iter().zip(&self.drive).map(|(rate, drive)| drive[d] * dt * settled(rate * dt)).collect();
        Interval { dt, decay: self.rates.iter().map(|rate| (-rate * dt).exp()).collect(), push: (0..drives).map(push).collect() }
    }

    /// Mean of an output over a step: exact.
    pub fn mean(&self, output: &Output, Step { from, slope, dt }: &Step) -> f64 {
        let drives = output.at_rest.iter().zip(&from.drives).zip(slope);
        let of_drives: f64 = drives.map(|((rest, u), s)| rest * (u + s * dt / 2.0)).sum();
        let of_mode = |i: usize| {
            let push = forced(&self.drive[i], slope) / self.rates[i];
            output.modal[i] * ((from.amplitudes[i] + push) * settled(self.rates[i] * dt) - push)
        };
        of_drives + (0..self.rates.len()).map(of_mode).sum::<f64>()
    }

    /// A first-order follower of an output with time constant `lag` \[s\], > 0, at the end of a step, from its value `x` at the start:
    /// exact.
    pub fn lagged(&self, output: &Output, Step { from, slope, dt }: &Step, lag: f64, x: f64) -> f64 {
        // y(t) = y0 + y1 t + Σ a_i e^(−rate_i t); the follower of each term is elementary
        let (mut constant, mut linear) = (0.0, 0.0);
        for ((rest, u), s) in output.at_rest.iter().zip(&from.drives).zip(slope) {
            constant += rest * u;
            linear += rest * s;
        }
        let forget = (-dt / lag).exp();
        let mut sum = x * forget;
        for (i, rate) in self.rates.iter().enumerate() {
            let push = forced(&self.drive[i], slope);
            constant -= output.modal[i] * push / rate;
            let a = output.modal[i] * (from.amplitudes[i] + push / rate);
            // ∫ e^(−(dt−s)/lag) e^(−rate s) ds / lag, without cancellation where rate ≈ 1/lag
            let x = (1.0 / lag - rate) * dt;
            let shared = if x >= 0.0 { (-rate * dt).exp() * settled(x) } else { forget * settled(-x) };
            sum += a * dt / lag * shared;
        }
        sum + constant * (1.0 - forget) + linear * (dt - lag * (1.0 - forget))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Outputs, ThermalState};
    use super::*;

    fn one_mode(rate: f64) -> Reduced {
        // y follows u with time constant 1/rate: y = u + q, q' = −rate q − u'
        let y = Output { at_rest: vec![1.0], modal: vec![1.0] };
        let outputs = Outputs { thermometer: y.clone(), coil_mean: y, parts: Vec::new() };
        Reduced { rates: vec![rate], drive: vec![vec![1.0]], outputs }
    }

    /// A step of `dt` from u = 5, q = −2.
    fn rising(dt: f64) -> Step {
        Step { from: ThermalState { drives: vec![5.0], amplitudes: vec![-2.0] }, slope: vec![0.3], dt }
    }

    #[test]
    fn exact_a_ramp_is_followed_by_its_time_constant() {
        let r = one_mode(0.01);
        let time: Vec<f64> = (0..=40).map(|k| 100.0 * f64::from(k)).collect();
        let ramp = [time.iter().map(|t| 2.0 * t).collect()];
        let mut steps = r.steps(&time, &ramp, &[0.0]);
        assert_eq!(steps.by_ref().count(), 40);
        let lag = 4000.0 * 2.0 - r.thermometer().of(steps.state());
        assert!((lag - 200.0).abs() < 1e-10 * 200.0);
    }

    #[test]
    fn exact_a_mean_over_a_long_interval_is_that_of_short_ones() {
        let r = one_mode(0.01);
        let step = rising(300.0);
        let long = r.mean(r.thermometer(), &step);
        let at = |k: u32| r.thermometer().of(&r.within(&step, 0.1 * f64::from(k)));
        let sum: f64 = (0..3000).map(|k| (at(k) + at(k + 1)) / 2.0).sum();
        assert!((long - sum / 3000.0).abs() < 1e-7 * long.abs(), "{long} against {}", sum / 3000.0);
    }

    #[test]
    fn exact_the_follower_agrees_with_fine_steps_also_near_resonance() {
        for (rate, lag) in [(0.01, 60.0), (0.01, 100.0), (0.01, 100.0 + 1e-7), (0.5, 700.0)] {
            let r = one_mode(rate);
            let step = rising(90.0);
            let exact = r.lagged(r.thermometer(), &step, lag, 1.0);
            let n = 200_000;
            let dt = 90.0 / f64::from(n);
            let (mut x, mut before) = (1.0, r.thermometer().of(&step.from));
            for k in 1..=n {
                let after = r.thermometer().of(&r.within(&step, f64::from(k) * dt));
                let middle = (before + after) / 2.0;
                x = middle + (x - middle) * (-dt / lag).exp();
                before = after;
            }
            assert!((x - exact).abs() < 1e-8, "rate {rate}, lag {lag}: {x} against {exact}");
        }
    }
}
