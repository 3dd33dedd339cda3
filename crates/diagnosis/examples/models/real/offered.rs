//! A nominal model to which all small laws are offered.

use super::law::{self, Law, Of, Scales};
use super::noise;
use super::plant::{Acts, Kind, Moment, Plant};
use super::shapes::{Past, Rates};
use diagnosis::{
    Active, Channel, Fit, ForwardModel, Hypothesis, Nuisance, Observation, Omission, Parameter, Prior, State, fitted,
};
use std::ops::Range;

/// Rows of a test that make a record.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Part {
    pub(crate) test: usize,
    pub(crate) rows: Range<usize>,
}

/// Share of the shortest record over which a rate is taken.
const RATE_OVER: f64 = 0.01;
/// Size from which a law starts, in what is at its place: far below it, for a law is looked for by what it would begin to do.
const START: f64 = 0.1;

pub(crate) struct Offered<P> {
    pub(crate) plant: P,
    parts: Vec<Part>,
    pub(crate) laws: Vec<Law>,
    pub(crate) scales: Scales,
    mechanisms: Vec<Omission>,
    channels: Vec<Channel>,
    state: State,
}

/// By how much wider sizes are let go where least squares shall find them.
const WIDE: f64 = 100.0;

impl<P: Plant> Offered<P> {
    /// The plant with no law at all, its tests cut into records.
    pub(crate) fn nothing(plant: P, parts: Vec<Part>) -> Self {
        let scales = Scales { quantities: Vec::new(), rates: Vec::new(), places: Vec::new(), duration: 1.0 };
        let channels = plant.facts().channels.clone();
        Self {
            plant,
            parts,
            laws: Vec::new(),
            scales,
            mechanisms: Vec::new(),
            channels,
            state: State { level: Vec::new(), rate: Vec::new() },
        }
    }

    /// The same with all laws, on the scales that quantities and places have in the records that a fit is of.
    pub(crate) fn with_laws(mut self, nominal: &Fit, records: &[usize], observations: &[Observation]) -> Self {
        self.scales = self.scales_of(nominal, records, observations);
        self.laws = law::all(self.plant.facts().quantities, self.plant.facts().places);
        self.mechanisms = self.laws.iter().map(|law| self.omission(law)).collect();
        self
    }

    /// The same under white noise, sizes nearly free: a fit is one by least squares.
    pub(crate) fn by_squares(&self) -> Self
    where
        P: Clone,
    {
        let plain = |c: &Channel| Channel { noise: noise::plain(c.noise.white.0), ..c.clone() };
        let mut mechanisms = self.mechanisms.clone();
        mechanisms.iter_mut().for_each(|m| m.parameters[0].prior = Prior::Normal { mean: 0.0, sd: WIDE });
        Self {
            plant: self.plant.clone(),
            parts: self.parts.clone(),
            laws: self.laws.clone(),
            scales: self.scales.clone(),
            channels: self.channels.iter().map(plain).collect(),
            mechanisms,
            state: self.state.clone(),
        }
    }

    pub(crate) fn rows(&self, record: usize) -> Range<usize> {
        self.parts[record].rows.clone()
    }

    fn omission(&self, law: &Law) -> Omission {
        let mut parameters = vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 1.0 })];
        let mut starts = vec![vec![START]];
        for beside in law.shape.beside(self.scales.duration) {
            parameters.push(beside.parameter);
            let with = |start: &Vec<f64>| beside.starts.iter().map(|x| [start.as_slice(), &[*x]].concat()).collect::<Vec<_>>();
            starts = starts.iter().flat_map(with).collect();
        }
        let (quantities, places) = (self.plant.facts().quantities, self.plant.facts().places);
        Omission {
            id: law.words(quantities, places),
            stage: places[law.at].name.into(),
            parameters,
            choice: None,
            starts,
            named: true,
            weight: law.weight(),
        }
    }

    /// Quantities, and what the nominal model has at the places, at every moment of a record.
    pub(crate) fn moments(&self, record: usize, constants: &[f64]) -> Vec<(f64, Vec<f64>, Vec<f64>)> {
        let mut all = Vec::new();
        self.plant.run(self.parts[record].test, constants, &mut |m| all.push((m.step, m.quantities.to_vec(), m.places.to_vec())));
        // models may go in finer steps than rows
        let (rows, of) = (&self.parts[record].rows, self.plant.time(self.parts[record].test).len());
        let finer = all.len() / of;
        all.truncate(rows.end * finer);
        all
    }

    fn scales_of(&self, nominal: &Fit, records: &[usize], observations: &[Observation]) -> Scales {
        let runs: Vec<_> = records.iter().zip(&nominal.nuisances).map(|(r, constants)| self.moments(*r, constants)).collect();
        let span = |o: &Observation| o.time.last().zip(o.time.first()).map_or(1.0, |(b, a)| b - a);
        let duration = observations.iter().map(span).fold(f64::INFINITY, f64::min);
        let quantity = |i: usize| {
            let values = || runs.iter().flatten().map(move |(_, q, _)| q[i]);
            let (low, high) = values().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            match self.plant.facts().quantities[i].kind {
                Kind::Level => ((low + high) / 2.0, ((high - low) / 2.0).max(1e-9)),
                Kind::Flow | Kind::Time => (0.0, low.abs().max(high.abs()).max(1e-9)),
                Kind::Phase => (0.0, 1.0),
            }
        };
        let quantities: Vec<(f64, f64)> = (0..self.plant.facts().quantities.len()).map(quantity).collect();
        let rate = |i: usize| {
            let rates = Rates { over: RATE_OVER * duration, largest: 1.0 };
            let mut largest = 0.0_f64;
            for run in &runs {
                let mut past = Past::default();
                let x = |q: &[f64]| (q[i] - quantities[i].0) / quantities[i].1;
                run.iter().for_each(|(step, q, _)| largest = largest.max(rates.raw(x(q), *step, &mut past).abs()));
            }
            Rates { largest, ..rates }
        };
        let place = |i: usize| match self.plant.facts().places[i].acts {
            Acts::Reading(channel) => half_range(observations.iter().flat_map(|o| &o.channels[channel]).copied()),
            Acts::Flow | Acts::Loss => half_range(runs.iter().flatten().map(|(_, _, p)| p[i])),
        };
        Scales {
            rates: (0..quantities.len()).map(rate).collect(),
            places: (0..self.plant.facts().places.len()).map(place).collect(),
            duration,
            quantities,
        }
    }

    /// Recorded values of a test, `[channel][row]`, in a record's rows.
    pub(crate) fn observed(&self, record: usize, channels: &[Vec<f64>]) -> Observation {
        let Part { test, rows } = &self.parts[record];
        Observation {
            time: self.plant.time(*test)[rows.clone()].to_vec(),
            channels: channels.iter().map(|c| c[rows.clone()].to_vec()).collect(),
        }
    }

    /// The same with noise that is no larger than what the nominal model leaves by least squares.
    pub(crate) fn with_noise(mut self, records: &[usize], observations: &[Observation]) -> Result<Self, diagnosis::Error>
    where
        P: Clone,
    {
        let least = self.by_squares().nominal(records, observations)?;
        for (c, channel) in self.channels.iter_mut().enumerate() {
            let left: Vec<f64> = least.residuals.iter().flat_map(|r| &r[c]).copied().filter(|r| r.is_finite()).collect();
            channel.noise = noise::beside(&channel.noise, rms(&left));
        }
        Ok(self)
    }

    /// The nominal model, fitted.
    pub(crate) fn nominal(&self, records: &[usize], observations: &[Observation]) -> Result<Fit, diagnosis::Error> {
        fitted(self, records, observations, &[Hypothesis::RECALIBRATED])
    }

    /// A law's scale in words: what x stands for.
    pub(crate) fn legend(&self, law: &Law) -> String {
        let Of::Quantity(i) = law.of else { return String::new() };
        let (q, (middle, half)) = (&self.plant.facts().quantities[i], self.scales.quantities[i]);
        match q.kind {
            Kind::Phase => String::new(),
            _ => format!("x = ({} - {middle:.4}) / {half:.4} {}", q.name, q.unit),
        }
    }
}

/// Half of the range of what is a number.
fn half_range(values: impl Iterator<Item = f64>) -> f64 {
    let [low, high] = values.filter(|x| x.is_finite()).fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], x| [a.min(x), b.max(x)]);
    if low < high { (high - low) / 2.0 } else { 1e-12 }
}

/// Standard deviation of what is a number.
pub(crate) fn spread(values: impl Iterator<Item = f64>) -> f64 {
    let (mut n, mut sum, mut squares) = (0.0_f64, 0.0, 0.0);
    let first = &mut None;
    for x in values.filter(|x| x.is_finite()) {
        let x = x - *first.get_or_insert(x);
        (n, sum, squares) = (n + 1.0, sum + x, squares + x * x);
    }
    let mean = sum / n.max(1.0);
    (squares / n.max(1.0) - mean * mean).max(0.0).sqrt()
}

impl<P: Plant> ForwardModel for Offered<P> {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.plant.facts().nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }

    fn respond(&self, record: usize, constants: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let mut pasts = vec![[Past::default(), Past::default()]; active.len()];
        let mut nominal = Vec::new();
        let mut laws = |mut moment: Moment<'_>| {
            nominal.clear();
            nominal.extend_from_slice(moment.places);
            for (active, past) in active.iter().zip(&mut pasts) {
                self.laws[active.mechanism].act(
                    &active.values,
                    &self.scales,
                    &nominal,
                    (self.plant.facts().places, past),
                    &mut moment,
                );
            }
        };
        let Part { test, rows } = &self.parts[record];
        let channels = self.plant.run(*test, constants, &mut laws);
        Ok(channels.into_iter().map(|c| c[rows.clone()].to_vec()).collect())
    }
}

/// Root mean square.
pub(crate) fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len().max(1) as f64).sqrt()
}
