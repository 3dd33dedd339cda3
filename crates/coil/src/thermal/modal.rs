//! Exact courses of a reduced model while its drives are linear in time.

use super::Reduced;

/// (1 − e^−x)/x, smooth at 0.
pub(super) fn settled(x: f64) -> f64 {
    if x.abs() < 1e-8 { 1.0 - x / 2.0 } else { -(-x).exp_m1() / x }
}

/// Decay and response of each mode over one interval, for as many steps as have its length.
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    /// Its length \[s\].
    pub dt: f64,
    decay: Vec<f64>,
    push: Vec<f64>,
}

impl Reduced {
    /// Output `k` for drives `u` and modes `q`.
    pub fn output(&self, k: usize, u: &[f64], q: &[f64]) -> f64 {
        let of = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        of(&self.outputs[k].at_rest, u) + of(&self.outputs[k].modal, q)
    }

    /// A jump of the drives.
    pub fn jump(&self, q: &mut [f64], by: &[f64]) {
        for (q, drive) in q.iter_mut().zip(&self.drive) {
            *q -= drive.iter().zip(by).map(|(d, u)| d * u).sum::<f64>();
        }
    }

    /// q̇ while the drives change at `slope`.
    pub fn mode_rates(&self, q: &[f64], slope: &[f64]) -> Vec<f64> {
        let push = |drive: &Vec<f64>| drive.iter().zip(slope).map(|(d, s)| d * s).sum::<f64>();
        self.rates.iter().zip(&self.drive).zip(q).map(|((rate, drive), q)| -rate * q - push(drive)).collect()
    }

    /// What an interval of `dt` \[s\] does to each mode.
    pub fn interval(&self, dt: f64) -> Interval {
        let of = |f: &dyn Fn(f64) -> f64| self.rates.iter().map(|rate| f(rate * dt)).collect();
        Interval { dt, decay: of(&|x| (-x).exp()), push: of(&|x| dt * settled(x)) }
    }

    /// Advances the modes by an interval over which the drives change at `slope`: exact.
    pub fn advance(&self, q: &mut [f64], slope: &[f64], interval: &Interval) {
        for (((q, drive), decay), push) in q.iter_mut().zip(&self.drive).zip(&interval.decay).zip(&interval.push) {
            let rate: f64 = drive.iter().zip(slope).map(|(d, s)| d * s).sum();
            *q = *q * decay - rate * push;
        }
    }

    /// Mean of output `k` over an interval `dt` \[s\], > 0, over which the drives move linearly from `u` at `slope`: exact.
    pub fn mean(&self, k: usize, u: &[f64], q: &[f64], slope: &[f64], dt: f64) -> f64 {
        let output = &self.outputs[k];
        let of_drives: f64 = output.at_rest.iter().zip(u).zip(slope).map(|((rest, u), s)| rest * (u + s * dt / 2.0)).sum();
        let of_mode = |i: usize| {
            let push: f64 = self.drive[i].iter().zip(slope).map(|(d, s)| d * s).sum::<f64>() / self.rates[i];
            output.modal[i] * ((q[i] + push) * settled(self.rates[i] * dt) - push)
        };
        of_drives + (0..self.rates.len()).map(of_mode).sum::<f64>()
    }

    /// A first-order follower of output `k` with time constant `lag` \[s\], > 0, from its value `x` at the start of an interval `dt` over
    /// which the drives move linearly from `u`: exact.
    #[expect(clippy::too_many_arguments, reason = "the state of one interval")]
    pub fn lagged(&self, k: usize, u: &[f64], q: &[f64], slope: &[f64], dt: f64, lag: f64, x: f64) -> f64 {
        // y(t) = y0 + y1 t + Σ a_i e^(−rate_i t); the follower of each term is elementary
        let output = &self.outputs[k];
        let (mut constant, mut linear) = (0.0, 0.0);
        for ((rest, u), s) in output.at_rest.iter().zip(u).zip(slope) {
            constant += rest * u;
            linear += rest * s;
        }
        let forget = (-dt / lag).exp();
        let mut sum = x * forget;
        for (i, rate) in self.rates.iter().enumerate() {
            let push: f64 = self.drive[i].iter().zip(slope).map(|(d, s)| d * s).sum();
            constant -= output.modal[i] * push / rate;
            let a = output.modal[i] * (q[i] + push / rate);
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
    use super::super::ReducedOutput;
    use super::*;

    fn one_mode(rate: f64) -> Reduced {
        // y follows u with time constant 1/rate: y = u + q, q' = −rate q − u'
        let outputs = vec![ReducedOutput { at_rest: vec![1.0], modal: vec![1.0] }];
        Reduced { rates: vec![rate], drive: vec![vec![1.0]], outputs }
    }

    #[test]
    fn exact_a_ramp_is_followed_by_its_time_constant() {
        let r = one_mode(0.01);
        let mut q = vec![0.0];
        for _ in 0..40 {
            r.advance(&mut q, &[2.0], &r.interval(100.0));
        }
        let lag = 4000.0 * 2.0 - r.output(0, &[8000.0], &q);
        assert!((lag - 200.0).abs() < 1e-10 * 200.0);
    }

    #[test]
    fn exact_a_mean_over_a_long_interval_is_that_of_short_ones() {
        let r = one_mode(0.01);
        let (u, slope, mut q) = ([5.0], [0.3], vec![-2.0]);
        let long = r.mean(0, &u, &q, &slope, 300.0);
        let (mut at, mut sum) = (u, 0.0);
        for _ in 0..3000 {
            let before = r.output(0, &at, &q);
            r.advance(&mut q, &slope, &r.interval(0.1));
            at[0] += 0.1 * slope[0];
            sum += (before + r.output(0, &at, &q)) / 2.0;
        }
        assert!((long - sum / 3000.0).abs() < 1e-7 * long.abs(), "{long} against {}", sum / 3000.0);
    }

    #[test]
    fn exact_the_follower_agrees_with_fine_steps_also_near_resonance() {
        for (rate, lag) in [(0.01, 60.0), (0.01, 100.0), (0.01, 100.0 + 1e-7), (0.5, 700.0)] {
            let r = one_mode(rate);
            let (slope, mut u, mut q, mut x) = ([0.3], vec![5.0], vec![-2.0], 1.0);
            let exact = r.lagged(0, &u, &q, &slope, 90.0, lag, x);
            let n = 200_000;
            let dt = 90.0 / f64::from(n);
            let interval = r.interval(dt);
            for _ in 0..n {
                let before = r.output(0, &u, &q);
                r.advance(&mut q, &slope, &interval);
                u[0] += slope[0] * dt;
                let middle = (before + r.output(0, &u, &q)) / 2.0;
                x = middle + (x - middle) * (-dt / lag).exp();
            }
            assert!((x - exact).abs() < 1e-8, "rate {rate}, lag {lag}: {x} against {exact}");
        }
    }
}
