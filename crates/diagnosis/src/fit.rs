//! One hypothesis fitted to the records, and its evidence.

use crate::model::{Active, Role};
use crate::noise::Noise;
use crate::{Error, ForwardModel, Observation, Prior};
use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

/// Which mechanisms are at work, and whether the nominal constants are re-estimated.
#[derive(Debug, Clone, PartialEq)]
pub struct Hypothesis {
    /// Numbers in the library, each with the value of its choice, if it has one.
    pub mechanisms: Vec<(usize, Option<f64>)>,
    /// Whether the design's own constants are free.
    pub constants_free: bool,
}

impl Hypothesis {
    /// Nothing is left out.
    pub const NOMINAL: Self = Self { mechanisms: Vec::new(), constants_free: false };
}

/// A hypothesis at its most probable parameters.
#[derive(Debug, Clone)]
pub struct Fit {
    /// What was fitted.
    pub hypothesis: Hypothesis,
    /// ln of the marginal likelihood (Laplace), up to a constant that all fits to the same records share.
    pub log_evidence: f64,
    /// The nominal model's uncertain numbers, all of them, in every record.
    pub nuisances: Vec<Vec<f64>>,
    /// Mechanisms at work.
    pub active: Vec<Active>,
    /// Offset of every channel of every record.
    pub offsets: Vec<Vec<f64>>,
    /// Residual `[record][channel][row]`, NaN where nothing was recorded.
    pub residuals: Vec<Vec<Vec<f64>>>,
    pub(crate) u: DVector<f64>,
    pub(crate) layout: Layout,
    pub(crate) covariance: DMatrix<f64>,
    pub(crate) noise: Noise,
    pub(crate) whitened: DVector<f64>,
    pub(crate) jacobian: DMatrix<f64>,
}

/// Every nuisance at the middle of its prior.
pub(crate) fn expected(nuisances: &[crate::Nuisance]) -> Vec<f64> {
    nuisances.iter().map(|n| n.parameter.prior.value(0.0)).collect()
}

/// What each unknown is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Unknown {
    /// `record` where every record has its own
    Nuisance {
        number: usize,
        record: Option<usize>,
    },
    Mechanism {
        place: usize,
        parameter: usize,
    },
    Offset {
        record: usize,
        channel: usize,
    },
}

pub(crate) type Layout = Vec<Unknown>;

pub(crate) struct Fitter<'a, M> {
    pub(crate) model: &'a M,
    pub(crate) observations: &'a [Observation],
    /// numbers of the model's records
    pub(crate) records: &'a [usize],
}

const MOST_STEPS: usize = 12;
/// Change of ln p at which a fit has settled.
const SETTLED: f64 = 5e-3;
/// Largest step of an unknown [u].
const STRIDE: f64 = 2.0;

type Responses = Vec<Vec<Vec<f64>>>;

impl<M: ForwardModel> Fitter<'_, M> {
    fn layout(&self, hypothesis: &Hypothesis) -> Layout {
        let free = |role: Role| role == Role::ModelError || hypothesis.constants_free;
        let mut layout = Layout::new();
        for (number, nuisance) in self.model.nuisances().iter().enumerate().filter(|(_, n)| free(n.role)) {
            if nuisance.local {
                layout.extend((0..self.observations.len()).map(|r| Unknown::Nuisance { number, record: Some(r) }));
            } else {
                layout.push(Unknown::Nuisance { number, record: None });
            }
        }
        for (place, (mechanism, _)) in hypothesis.mechanisms.iter().enumerate() {
            let count = self.model.mechanisms()[*mechanism].parameters.len();
            layout.extend((0..count).map(|parameter| Unknown::Mechanism { place, parameter }));
        }
        for record in 0..self.observations.len() {
            layout.extend((0..self.model.channels().len()).map(|channel| Unknown::Offset { record, channel }));
        }
        layout
    }

    fn prior(&self, hypothesis: &Hypothesis, unknown: Unknown) -> Prior {
        match unknown {
            Unknown::Nuisance { number, .. } => self.model.nuisances()[number].parameter.prior,
            Unknown::Mechanism { place, parameter } => {
                self.model.mechanisms()[hypothesis.mechanisms[place].0].parameters[parameter].prior
            }
            Unknown::Offset { channel, .. } => Prior::Normal { mean: 0.0, sd: self.model.channels()[channel].offset_sd },
        }
    }

    fn step(&self, hypothesis: &Hypothesis, unknown: Unknown) -> f64 {
        match unknown {
            Unknown::Nuisance { number, .. } => self.model.nuisances()[number].parameter.step,
            Unknown::Mechanism { place, parameter } => {
                self.model.mechanisms()[hypothesis.mechanisms[place].0].parameters[parameter].step
            }
            Unknown::Offset { .. } => 1.0,
        }
    }

    /// Nuisances of every record and mechanisms at the unknowns.
    pub(crate) fn at(&self, hypothesis: &Hypothesis, layout: &Layout, u: &DVector<f64>) -> (Vec<Vec<f64>>, Vec<Active>) {
        let mut nuisances = vec![expected(self.model.nuisances()); self.observations.len()];
        let mut active: Vec<Active> = hypothesis
            .mechanisms
            .iter()
            .map(|&(mechanism, choice)| {
                let count = self.model.mechanisms()[mechanism].parameters.len();
                Active { mechanism, values: vec![0.0; count], choice }
            })
            .collect();
        for (unknown, u) in layout.iter().zip(u.iter()) {
            let value = self.prior(hypothesis, *unknown).value(*u);
            match *unknown {
                Unknown::Nuisance { number, record } => {
                    let records = record.map_or(0..nuisances.len(), |r| r..r + 1);
                    nuisances[records].iter_mut().for_each(|n| n[number] = value);
                }
                Unknown::Mechanism { place, parameter } => active[place].values[parameter] = value,
                Unknown::Offset { .. } => {}
            }
        }
        (nuisances, active)
    }

    fn responses(&self, hypothesis: &Hypothesis, layout: &Layout, u: &DVector<f64>) -> Result<Responses, Error<M::Error>> {
        let (nuisances, active) = self.at(hypothesis, layout, u);
        let of = |(record, n): (&usize, &Vec<f64>)| self.model.respond(*record, n, &active).map_err(Error::Model);
        self.records.iter().zip(&nuisances).map(of).collect()
    }

    /// Series of all records and channels, whitened, one behind another.
    pub(crate) fn whiten(&self, noise: &Noise, series: &Responses) -> DVector<f64> {
        let mut all = Vec::new();
        for (record, channels) in series.iter().enumerate() {
            for (channel, series) in channels.iter().enumerate() {
                all.extend(noise.whiten(record, channel, series));
            }
        }
        DVector::from_vec(all)
    }

    fn residuals(&self, layout: &Layout, u: &DVector<f64>, responses: &Responses) -> Responses {
        let mut residuals: Responses = responses
            .iter()
            .zip(self.observations)
            .map(|(response, o)| {
                let difference = |(r, y): (&Vec<f64>, &Vec<f64>)| y.iter().zip(r).map(|(y, r)| y - r).collect();
                response.iter().zip(&o.channels).map(difference).collect()
            })
            .collect();
        for (unknown, u) in layout.iter().zip(u.iter()) {
            if let Unknown::Offset { record, channel } = *unknown {
                let offset = self.model.channels()[channel].offset_sd * u;
                residuals[record][channel].iter_mut().for_each(|r| *r -= offset);
            }
        }
        residuals
    }

    /// Unknowns at which every start of the hypothesis' mechanisms begins, all combinations.
    fn starts(&self, hypothesis: &Hypothesis, layout: &Layout, known: Option<&Fit>) -> Vec<DVector<f64>> {
        let mut base = DVector::zeros(layout.len());
        for (i, unknown) in layout.iter().enumerate() {
            let of = |fit: &Fit| fit.layout.iter().position(|other| other == unknown).map(|at| fit.u[at]);
            if !matches!(unknown, Unknown::Mechanism { .. }) {
                base[i] = known.and_then(of).unwrap_or(0.0);
            }
        }
        // where the known fit has strayed far to make up for what it lacks, its unknowns are a poor start
        let strayed = base.amax() > STRAYED;
        let mut starts = vec![base];
        if strayed {
            starts.push(DVector::zeros(layout.len()));
        }
        for (place, (mechanism, choice)) in hypothesis.mechanisms.iter().enumerate() {
            let entry = &self.model.mechanisms()[*mechanism];
            // a mechanism that is already fitted goes on from there
            let fitted = known.and_then(|fit| {
                let same = |a: &&Active| a.mechanism == *mechanism && a.choice == *choice;
                fit.active.iter().find(same).map(|a| vec![a.values.clone()])
            });
            let values = fitted.unwrap_or_else(|| entry.starts.clone());
            starts = starts
                .iter()
                .flat_map(|u| {
                    values.iter().map(|values| {
                        let mut u = u.clone();
                        for (i, unknown) in layout.iter().enumerate() {
                            match *unknown {
                                Unknown::Mechanism { place: at, parameter } if at == place => {
                                    u[i] = entry.parameters[parameter].prior.standard(values[parameter]);
                                }
                                _ => {}
                            }
                        }
                        u
                    })
                })
                .collect();
        }
        starts
    }

    /// Fits a hypothesis under a known noise; `known` gives a place to start from.
    pub(crate) fn fit(&self, hypothesis: &Hypothesis, noise: &Noise, known: Option<&Fit>) -> Result<Fit, Error<M::Error>> {
        let layout = self.layout(hypothesis);
        let starts = self.starts(hypothesis, &layout, known);
        let mut tried = Vec::with_capacity(starts.len());
        for u in starts {
            let responses = self.responses(hypothesis, &layout, &u)?;
            let r = self.whiten(noise, &self.residuals(&layout, &u, &responses));
            tried.push((r.norm_squared() + u.norm_squared(), u));
        }
        // the likeliest starts are followed
        tried.sort_by(|a, b| a.0.total_cmp(&b.0));
        tried.truncate(STARTS);
        let mut best: Option<Fit> = None;
        for (_, u) in tried {
            let fit = self.descend(hypothesis, &layout, noise, u)?;
            if best.as_ref().is_none_or(|b| fit.log_evidence > b.log_evidence) {
                best = Some(fit);
            }
        }
        best.ok_or(Error::NoStart)
    }

    /// Whitened derivatives of the prediction by every unknown at `u`; by those that are no mechanism's, which hardly change on the way,
    /// from `known`.
    fn jacobian(
        &self,
        hypothesis: &Hypothesis,
        layout: &Layout,
        noise: &Noise,
        u: &DVector<f64>,
        responses: &Responses,
        known: Option<&DMatrix<f64>>,
    ) -> Result<DMatrix<f64>, Error<M::Error>> {
        let mut columns = Vec::with_capacity(layout.len());
        for (i, unknown) in layout.iter().enumerate() {
            if let Some(known) = known.filter(|_| !matches!(unknown, Unknown::Mechanism { .. })) {
                columns.push(known.column(i).into_owned());
                continue;
            }
            let step = self.step(hypothesis, *unknown);
            let series: Responses = if let Unknown::Offset { record, channel } = *unknown {
                let offset = self.model.channels()[channel].offset_sd;
                let of = |(r, c): (usize, usize), n: usize| vec![if (r, c) == (record, channel) { offset } else { 0.0 }; n];
                let channels = |(r, o): (usize, &Observation)| (0..o.channels.len()).map(|c| of((r, c), o.time.len())).collect();
                self.observations.iter().enumerate().map(channels).collect()
            } else {
                let mut beside = u.clone();
                // away from the end of the range that is looked at
                let step = if u[i] > 0.0 { -step } else { step };
                beside[i] += step;
                let mut there = self.responses(hypothesis, layout, &beside)?;
                for (there, here) in there.iter_mut().flatten().flatten().zip(responses.iter().flatten().flatten()) {
                    *there = (*there - here) / step;
                }
                there
            };
            columns.push(self.whiten(noise, &series));
        }
        Ok(DMatrix::from_columns(&columns))
    }

    /// Levenberg's and Marquardt's method on whitened residuals and standard-normal priors.
    fn descend(
        &self,
        hypothesis: &Hypothesis,
        layout: &Layout,
        noise: &Noise,
        start: DVector<f64>,
    ) -> Result<Fit, Error<M::Error>> {
        let objective = |r: &DVector<f64>, u: &DVector<f64>| (r.norm_squared() + u.norm_squared()) / 2.0;
        let mut u = start;
        let mut responses = self.responses(hypothesis, layout, &u)?;
        let mut r = self.whiten(noise, &self.residuals(layout, &u, &responses));
        let mut value = objective(&r, &u);
        let mut damping = 1e-3;
        let mut jacobian = self.jacobian(hypothesis, layout, noise, &u, &responses, None)?;
        for _ in 0..MOST_STEPS {
            let normal = jacobian.tr_mul(&jacobian) + DMatrix::identity(layout.len(), layout.len());
            let gradient = jacobian.tr_mul(&r) - &u;
            let mut gained = 0.0;
            while damping < 1e8 {
                let mut damped = normal.clone();
                for i in 0..layout.len() {
                    damped[(i, i)] += damping * normal[(i, i)];
                }
                let Some(factor) = Cholesky::new(damped) else { return Err(Error::NotFinite) };
                let mut step = factor.solve(&gradient);
                for (i, unknown) in layout.iter().enumerate() {
                    if matches!(unknown, Unknown::Mechanism { .. }) {
                        step[i] = step[i].clamp(-STRIDE, STRIDE);
                    }
                }
                let tried = &u + step;
                let there = self.responses(hypothesis, layout, &tried)?;
                let residual = self.whiten(noise, &self.residuals(layout, &tried, &there));
                let new = objective(&residual, &tried);
                if new < value {
                    gained = value - new;
                    (u, responses, r, value) = (tried, there, residual, new);
                    damping = (damping / 10.0).max(1e-9);
                    break;
                }
                damping *= 10.0;
            }
            if gained < SETTLED {
                break;
            }
            jacobian = self.jacobian(hypothesis, layout, noise, &u, &responses, Some(&jacobian))?;
        }
        jacobian = self.jacobian(hypothesis, layout, noise, &u, &responses, None)?;
        let normal: Cholesky<f64, Dyn> =
            Cholesky::new(jacobian.tr_mul(&jacobian) + DMatrix::identity(layout.len(), layout.len())).ok_or(Error::NotFinite)?;
        let half_log_det: f64 = normal.l_dirty().diagonal().iter().map(|d| d.ln()).sum();
        let log_evidence = -value - half_log_det - noise.half_log_det() + noise.log_prior;
        if !log_evidence.is_finite() {
            return Err(Error::NotFinite);
        }
        let (nuisances, active) = self.at(hypothesis, layout, &u);
        let mut offsets = vec![vec![0.0; self.model.channels().len()]; self.observations.len()];
        for (unknown, u) in layout.iter().zip(u.iter()) {
            if let Unknown::Offset { record, channel } = *unknown {
                offsets[record][channel] = self.model.channels()[channel].offset_sd * u;
            }
        }
        let residuals = self.residuals(layout, &u, &responses);
        Ok(Fit {
            hypothesis: hypothesis.clone(),
            log_evidence,
            nuisances,
            active,
            offsets,
            residuals,
            u,
            layout: layout.clone(),
            covariance: normal.inverse(),
            noise: noise.clone(),
            whitened: r,
            jacobian,
        })
    }

    /// Fits a hypothesis and its noise in turn, `rounds` times.
    pub(crate) fn fit_with_noise(&self, hypothesis: &Hypothesis, known: &Fit, rounds: usize) -> Result<Fit, Error<M::Error>> {
        let mut best = self.fit(hypothesis, &known.noise, Some(known))?;
        for _ in 0..rounds {
            let noise = best.noise.refitted(self.model.channels(), self.observations, &best.residuals)?;
            let fit = self.fit(hypothesis, &noise, Some(&best))?;
            let gained = fit.log_evidence - best.log_evidence;
            if gained > 0.0 {
                best = fit;
            }
            if gained < 0.1 {
                break;
            }
        }
        self.searched(best)
    }

    /// Looks for a better minimum around a fit's parameters whose responses have kinks: each is set aside by its distances, the other
    /// unknowns following by one linear step.
    fn searched(&self, mut best: Fit) -> Result<Fit, Error<M::Error>> {
        let library = self.model.mechanisms();
        for _ in 0..SEARCHES {
            let (hypothesis, layout) = (best.hypothesis.clone(), best.layout.clone());
            let value = |r: &DVector<f64>, u: &DVector<f64>| (r.norm_squared() + u.norm_squared()) / 2.0;
            let mut found: Option<(f64, DVector<f64>)> = None;
            let parameter = |i: usize| match layout[i] {
                Unknown::Mechanism { place, parameter } => Some(&library[hypothesis.mechanisms[place].0].parameters[parameter]),
                _ => None,
            };
            let searched: Vec<usize> =
                (0..layout.len()).filter(|i| parameter(*i).is_some_and(|p| !p.around.is_empty())).collect();
            // one alone, or one against another: the sum of two may be what the records know
            let moves = searched.iter().flat_map(|i| {
                std::iter::once((*i, None)).chain(searched.iter().filter(move |j| *j != i).map(|j| (*i, Some(*j))))
            });
            for (i, other) in moves {
                let Some(moved) = parameter(i) else { continue };
                for by in moved.around.iter().flat_map(|d| [-d, *d]) {
                    let mut u = best.u.clone();
                    u[i] = moved.prior.standard(moved.prior.value(u[i]) + by);
                    if let Some((j, against)) = other.and_then(|j| Some((j, parameter(j)?))) {
                        u[j] = against.prior.standard(against.prior.value(u[j]) - by);
                    }
                    let responses = self.responses(&hypothesis, &layout, &u)?;
                    let r = self.whiten(&best.noise, &self.residuals(&layout, &u, &responses));
                    let mut jacobian = self.jacobian(&hypothesis, &layout, &best.noise, &u, &responses, Some(&best.jacobian))?;
                    let gradient = jacobian.tr_mul(&r) - &u;
                    std::iter::once(i).chain(other).for_each(|k| jacobian.column_mut(k).fill(0.0));
                    let normal = jacobian.tr_mul(&jacobian) + DMatrix::identity(layout.len(), layout.len());
                    let Some(factor) = Cholesky::new(normal) else { continue };
                    let mut step = factor.solve(&gradient);
                    std::iter::once(i).chain(other).for_each(|k| step[k] = 0.0);
                    step.iter_mut().for_each(|s| *s = s.clamp(-STRIDE, STRIDE));
                    let u = u + step;
                    let responses = self.responses(&hypothesis, &layout, &u)?;
                    let r = self.whiten(&best.noise, &self.residuals(&layout, &u, &responses));
                    let at = value(&r, &u);
                    if found.as_ref().is_none_or(|(least, _)| at < *least) {
                        found = Some((at, u));
                    }
                }
            }
            let Some((least, u)) = found else { break };
            if least > value(&best.whitened, &best.u) - WORTH {
                break;
            }
            let fit = self.descend(&hypothesis, &layout, &best.noise, u)?;
            if fit.log_evidence <= best.log_evidence {
                break;
            }
            best = fit;
        }
        Ok(best)
    }
}

/// Rounds of the search around a fit, and the gain of ln p that makes one worth while.
const SEARCHES: usize = 6;
const WORTH: f64 = 0.3;
/// An unknown of a known fit [u] beyond which a fit starts from the middles of the priors, too.
const STRAYED: f64 = 3.0;
/// Starts that are followed to the end.
const STARTS: usize = 4;

/// 95th percentile of the standard normal distribution.
const Z95: f64 = 1.644_853_626_951_472_2;

/// A parameter with its 90 % interval.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Name with unit.
    pub name: String,
    /// Most probable value.
    pub value: f64,
    /// Ends of the interval that holds it with probability 0.9.
    pub ci90: [f64; 2],
}

impl Fit {
    /// Noise of a channel of a record that was fitted.
    pub fn noise_model(&self, record: usize, channel: usize) -> &recording::noise::NoiseModel {
        self.noise.model(record, channel)
    }

    /// Parameters of the mechanism at `place` in the hypothesis.
    pub fn estimates<M: ForwardModel>(&self, model: &M, place: usize) -> Vec<Estimate> {
        let mut estimates = Vec::new();
        let Some(active) = self.active.get(place) else { return estimates };
        let mechanism = &model.mechanisms()[active.mechanism];
        if let (Some((name, _)), Some(value)) = (&mechanism.choice, active.choice) {
            estimates.push(Estimate { name: name.clone(), value, ci90: [value, value] });
        }
        for (i, unknown) in self.layout.iter().enumerate() {
            let Unknown::Mechanism { place: at, parameter } = *unknown else { continue };
            if at == place {
                let crate::Parameter { name, prior, .. } = mechanism.parameters[parameter].clone();
                let half = Z95 * self.covariance[(i, i)].max(0.0).sqrt();
                let ci90 = [prior.value(self.u[i] - half), prior.value(self.u[i] + half)];
                estimates.push(Estimate { name, value: prior.value(self.u[i]), ci90 });
            }
        }
        estimates
    }
}
