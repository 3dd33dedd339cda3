//! Origin of a mismatch in the chain, found by one flexible input at a time, placed at each stage.

use crate::fit::{Fit, checked, products};
use crate::locate::whiteness;
use crate::{Error, Failure, ForwardModel, Latent, Observation};
use nalgebra::{Cholesky, DMatrix, DVector};

/// Responses `[function][channel][row]` of one record.
type Functions = Vec<Vec<Vec<f64>>>;

/// Fit of a flexible input at one stage to a mismatch.
#[derive(Debug, Clone, PartialEq)]
pub struct Stage {
    /// Part of the chain.
    pub stage: String,
    /// Gain of ln evidence over the nominal model.
    pub gain: f64,
    /// Probability among the stages, each as likely as another beforehand.
    pub probability: f64,
    /// Probability that noise is less white than the residual in each channel of the first record ([`whiteness`]).
    pub whiteness: Vec<f64>,
}

/// Resolution of the members of a group, such as layers.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberResolution {
    /// Most probable amplitude of each member, all at once.
    pub values: Vec<f64>,
    /// Their standard deviations.
    pub errors: Vec<f64>,
    /// Diagonal of the resolution matrix (JᵀJ + P⁻¹)⁻¹ JᵀJ: 1 where the records alone determine the amplitude, 0 where the prior does.
    pub resolved: Vec<f64>,
}

impl MemberResolution {
    /// Number of combinations that the records determine: the trace of the resolution matrix.
    pub fn combinations(&self) -> f64 {
        self.resolved.iter().sum()
    }

    /// Whether members can be located: more than half of some member's amplitude is the records' own.
    pub fn locatable(&self) -> bool {
        self.resolved.iter().any(|r| *r > 0.5)
    }
}

/// Amplitudes that are averaged over, in units of the noise of one sample.
const AMPLITUDES: [f64; 7] = [0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0];

impl Fit {
    /// Whitened responses to the functions, all records one below another, each scaled to a largest response of a channel's white noise.
    fn whitened_functions(&self, records: &[Functions]) -> Option<(DMatrix<f64>, Vec<f64>)> {
        let count = records.iter().map(Vec::len).min()?;
        let (mut columns, mut scales) = (Vec::new(), Vec::new());
        for f in 0..count {
            let size = |r: usize, c: usize| {
                let most = records[r][f][c].iter().fold(0.0_f64, |m, v| m.max(v.abs()));
                most / self.noise.model(r, c).white
            };
            let pairs = (0..records.len()).flat_map(|r| (0..records[r][f].len()).map(move |c| (r, c)));
            let most = pairs.map(|(r, c)| size(r, c)).fold(0.0, f64::max);
            let scale = if most > 0.0 { 1.0 / most } else { 0.0 };
            let mut column = Vec::with_capacity(self.whitened.len());
            for (r, functions) in records.iter().enumerate() {
                for (c, series) in functions[f].iter().enumerate() {
                    column.extend(self.noise.whiten(r, c, series).iter().map(|w| w * scale));
                }
            }
            columns.push(DVector::from_vec(column));
            scales.push(scale);
        }
        (!columns.is_empty()).then(|| (DMatrix::from_columns(&columns), scales))
    }

    /// The latent inputs of the stages that every record has.
    fn latent(
        &self,
        model: &dyn ForwardModel,
        records: &[usize],
        of: impl Fn(usize) -> Result<Vec<Latent>, Failure>,
    ) -> Result<Vec<(String, Vec<Functions>)>, Error> {
        let mut stages: Vec<(String, Vec<Functions>)> = Vec::new();
        for (record, residuals) in records.iter().zip(&self.residuals) {
            for latent in of(*record).map_err(Error::Model)? {
                let (rows, what) = (residuals.first().map_or(0, Vec::len), format!("an input at stage `{}`", latent.stage));
                latent.functions.iter().try_for_each(|f| checked::shape(model, *record, rows, &what, f))?;
                match stages.iter_mut().find(|(stage, _)| *stage == latent.stage) {
                    Some((_, functions)) => functions.push(latent.functions),
                    None => stages.push((latent.stage, vec![latent.functions])),
                }
            }
        }
        stages.retain(|(_, functions)| functions.len() == records.len());
        Ok(stages)
    }

    /// Fit of a flexible input at each stage of the chain to this fit's residual, best first. Meant for the fit of the nominal model under the
    /// noise of the best candidate.
    ///
    /// # Errors
    /// [`Error`] if the model fails.
    pub fn stages(&self, model: &dyn ForwardModel, records: &[usize], observations: &[Observation]) -> Result<Vec<Stage>, Error> {
        let mut stages = Vec::new();
        for (stage, functions) in self.latent(model, records, |r| model.latent(r))? {
            let Some((columns, _)) = self.whitened_functions(&functions) else { continue };
            let gains = self.gain(&columns, &AMPLITUDES);
            let most = gains.iter().fold(f64::NEG_INFINITY, |m, g| m.max(*g));
            let gain = most + (gains.iter().map(|g| (g - most).exp()).sum::<f64>() / gains.len() as f64).ln();
            let best = gains.iter().position(|g| *g == most).map_or(1.0, |k| AMPLITUDES[k]);
            let left = self.after(&columns, best);
            let mut rest = left.as_slice();
            let whiteness = (0..model.channels().len())
                .map(|c| {
                    let rows = observations.first().map_or(0, |_| self.noise.rows(0, c).len());
                    let part;
                    (part, rest) = rest.split_at(rows);
                    whiteness(part)
                })
                .collect();
            stages.push(Stage { stage, gain, probability: 0.0, whiteness });
        }
        let most = stages.iter().fold(f64::NEG_INFINITY, |m, s| m.max(s.gain));
        let sum: f64 = stages.iter().map(|s| (s.gain - most).exp()).sum();
        stages.iter_mut().for_each(|s| s.probability = (s.gain - most).exp() / sum);
        stages.sort_by(|a, b| b.gain.total_cmp(&a.gain));
        Ok(stages)
    }

    /// Whitened residual that remains after functions of amplitude `scale` and the fit's own unknowns have taken their part.
    fn after(&self, columns: &DMatrix<f64>, scale: f64) -> DVector<f64> {
        let scaled = columns * scale;
        let all = DMatrix::from_columns(&self.jacobian().column_iter().chain(scaled.column_iter()).collect::<Vec<_>>());
        match Cholesky::new(self.beforehand.curvature(products(&all))) {
            Some(factor) => &self.whitened - &all * factor.solve(&all.tr_mul(&self.whitened)),
            None => self.whitened.clone(),
        }
    }

    /// Resolution of the members of the model's group ([`ForwardModel::members`]) by the records, where the prior of each amplitude has
    /// 1σ = `prior`; `None` if the model has no such group.
    ///
    /// # Errors
    /// [`Error`] if the model fails.
    pub fn resolution(&self, model: &dyn ForwardModel, records: &[usize], prior: f64) -> Result<Option<MemberResolution>, Error> {
        let group = self.latent(model, records, |r| Ok(model.members(r)?.into_iter().collect()))?;
        let Some((mut columns, scales)) = group.first().and_then(|(_, functions)| self.whitened_functions(functions)) else {
            return Ok(None);
        };
        // in units of the prior
        for (k, scale) in scales.iter().enumerate() {
            columns.column_mut(k).scale_mut(if *scale > 0.0 { prior / scale } else { 0.0 });
        }
        let own = self.jacobian().ncols();
        let all = DMatrix::from_columns(&self.jacobian().column_iter().chain(columns.column_iter()).collect::<Vec<_>>());
        let covariance = Cholesky::new(self.beforehand.curvature(products(&all))).ok_or(Error::NotFinite)?.inverse();
        // the fit's own unknowns are where they fit best, at u
        let mut gradient = all.tr_mul(&self.whitened);
        gradient.rows_mut(0, own).zip_apply(&self.beforehand.slope(&self.u), |g, u| *g -= u);
        let amplitudes = &covariance * gradient;
        let member = own..all.ncols();
        Ok(Some(MemberResolution {
            values: member.clone().map(|k| prior * amplitudes[k]).collect(),
            errors: member.clone().map(|k| prior * covariance[(k, k)].max(0.0).sqrt()).collect(),
            // (A + I)⁻¹ A = I − (A + I)⁻¹
            resolved: member.map(|k| 1.0 - covariance[(k, k)]).collect(),
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{Fitter, Hypothesis};
    use crate::noise::Noise;
    use crate::{Active, Channel, NoisePrior, Nuisance, Omission, State};

    const ROWS: usize = 200;

    /// Nothing in two channels; an input raises both.
    struct Two {
        channels: [Channel; 2],
        state: State,
    }

    impl ForwardModel for Two {
        fn channels(&self) -> &[Channel] {
            &self.channels
        }
        fn nuisances(&self) -> &[Nuisance] {
            &[]
        }
        fn mechanisms(&self) -> &[Omission] {
            &[]
        }
        fn respond(&self, _: usize, _: &[f64], _: &[Active]) -> Result<Vec<Vec<f64>>, Failure> {
            Ok(vec![vec![0.0; ROWS]; 2])
        }
        fn state(&self, _: usize) -> &State {
            &self.state
        }
        fn latent(&self, _: usize) -> Result<Vec<Latent>, Failure> {
            let ramp: Vec<f64> = (0..ROWS).map(|n| n as f64 / ROWS as f64).collect();
            Ok(vec![Latent { stage: "one".into(), functions: vec![vec![ramp.clone(), ramp]] }])
        }
    }

    #[test]
    fn every_channel_of_a_stage_has_its_own_whiteness() {
        let noise = NoisePrior::new((0.3, 1e-3), (1e-9, 1e-3), (1500.0, 1e-3), (1e-12, 1e-3));
        let channel = Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise };
        let state = State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] };
        let two = Two { channels: [channel.clone(), channel], state };
        let mut digits = 1_u64;
        let mut white = || {
            digits = digits.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (digits >> 40) as f64 / f64::from(1_u32 << 24) - 0.5
        };
        let series = [(0..ROWS).map(|_| white()).collect::<Vec<_>>(), (0..ROWS).map(|n| (n as f64 / 5.0).sin()).collect()];
        for waves in [0, 1] {
            let channels = vec![series[1 - waves].clone(), series[waves].clone()];
            let observed = [Observation { time: (0..ROWS).map(|n| 60.0 * n as f64).collect(), channels }];
            let typical = Noise::typical(two.channels(), &observed).expect("noise");
            let fitter = Fitter::new(&two, &[0], &observed).expect("a fitter");
            let fit = fitter.fit(&Hypothesis::NOMINAL, &typical, None).expect("a fit");
            let stages = fit.stages(&two, &[0], &observed).expect("stages");
            let [first, second] = stages[0].whiteness[..] else { panic!("two channels") };
            let (even, wavy) = if waves == 1 { (first, second) } else { (second, first) };
            assert!(even > 0.05 && wavy < 1e-6, "{first} {second}");
        }
    }
}
