//! Two tanks, one above the other: a pump fills the upper one, it drains into the lower one, the lower one into a basin; the lower level is read.
//! Nominal is Bernoulli's law; the library holds what else tanks, pipes, pumps and sensors do.

use diagnosis::{Active, Channel, ForwardModel, NoisePrior, Nuisance, Omission, Parameter, Prior, Role, State};

/// Input of the pump \[V\], every `step` seconds, held in between; and the lower level at the start \[V\].
#[derive(Debug, Clone)]
pub(crate) struct Feed {
    /// Interval \[s\].
    pub(crate) step: f64,
    /// Pump's voltage.
    pub(crate) pump: Vec<f64>,
    /// Level of the lower tank at the first instant.
    pub(crate) start: f64,
}

/// Levels of both tanks and the reading, at every instant.
#[derive(Debug, Clone, Default)]
pub(crate) struct Course {
    /// Upper level.
    pub(crate) upper: Vec<f64>,
    /// Lower level.
    pub(crate) lower: Vec<f64>,
    /// Reading of the sensor of the lower level.
    pub(crate) reading: Vec<f64>,
}

/// The library, in its order.
pub(crate) const UPPER_OVERFLOW: usize = 0;
pub(crate) const LOWER_OVERFLOW: usize = 1;
pub(crate) const VISCOUS_OUTFLOW: usize = 2;
pub(crate) const LEAK: usize = 3;
pub(crate) const DEAD_ZONE: usize = 4;
pub(crate) const PUMP_SATURATION: usize = 5;
pub(crate) const SENSOR_SATURATION: usize = 6;

/// Parts of an interval in which the levels are integrated.
const PARTS: usize = 4;

pub(crate) struct Tanks {
    feeds: Vec<Feed>,
    states: Vec<State>,
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
}

fn mechanism(id: &str, stage: &str, parameters: &[(&str, Prior)], starts: &[&[f64]]) -> Omission {
    Omission {
        id: id.into(),
        stage: stage.into(),
        // levels that are reached or not make kinks
        parameters: parameters.iter().map(|(name, prior)| Parameter::new(*name, *prior).with_step(0.05)).collect(),
        choice: None,
        starts: starts.iter().map(|start| start.to_vec()).collect(),
        named: true,
        weight: 1.0,
    }
}

fn library() -> Vec<Omission> {
    let level = Prior::Uniform { low: 4.0, high: 16.0 };
    let share = Prior::Uniform { low: 0.0, high: 1.0 };
    let small = |median: f64| Prior::LogNormal { median, spread: 1.0 };
    vec![
        mechanism(
            "upper-overflow",
            "upper tank",
            &[("rim_v", level), ("share_into_lower", share)],
            &[5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.0].map(|rim| [rim, 0.5]).each_ref().map(|start| start.as_slice()),
        ),
        mechanism("lower-overflow", "lower tank", &[("rim_v", level)], &[&[7.0], &[9.0], &[10.0], &[12.0]]),
        mechanism("viscous-outflow", "pipes", &[("share_per_root_v", small(0.1))], &[&[0.05], &[0.3]]),
        mechanism("leak", "upper tank", &[("loss_per_s", small(1e-3))], &[&[5e-4], &[5e-3]]),
        mechanism("pump-dead-zone", "pump", &[("dead_zone_v", small(0.3))], &[&[0.2], &[0.8]]),
        mechanism("pump-saturation", "pump", &[("most_v", Prior::Uniform { low: 1.0, high: 9.0 })], &[&[4.0], &[5.0], &[6.0]]),
        mechanism("sensor-saturation", "sensor", &[("most_v", level)], &[&[8.0], &[9.0], &[10.0]]),
    ]
}

/// Constants of the nominal model: what drains from above, arrives below, drains from below [√V/s]; the pump's gain [1/s]; the upper start
/// and the sensor's zero \[V\]; exponents of the outflows.
fn constants(doubt: f64) -> Vec<Nuisance> {
    let unknown = |name: &str, median: f64, spread: f64| Nuisance {
        parameter: Parameter::new(name, Prior::LogNormal { median, spread: doubt * spread }),
        // nobody measured them well: they are always free
        role: Role::ModelError,
        local: false,
    };
    vec![
        unknown("drain of the upper tank", 0.05, 0.7),
        unknown("inflow of the lower tank", 0.05, 0.7),
        unknown("drain of the lower tank", 0.05, 0.7),
        unknown("gain of the pump", 0.05, 0.7),
        unknown("upper level at the start", 4.0, 0.6),
        Nuisance::normal("level at which the sensor reads zero", 0.0, doubt, Role::ModelError),
        Nuisance::normal("exponent of the upper outflow", 0.5, 0.05 * doubt, Role::ModelError),
        Nuisance::normal("exponent of the lower outflow", 0.5, 0.05 * doubt, Role::ModelError),
    ]
}

impl Tanks {
    /// Tanks under several feeds; the records are in their order. With a `doubt` of 1 next to nothing is known of the constants, with one of 0.1
    /// they were measured to a tenth.
    pub(crate) fn new(feeds: Vec<Feed>, doubt: f64) -> Self {
        // Bernoulli's law is good for a tenth of a volt
        let noise = NoisePrior::new((0.1, 0.3), (0.1, 0.3), (100.0, 0.5), (1e-6, 0.5));
        let channel = Channel { name: "lower level".into(), unit: "V".into(), offset: (0.0, 0.05), averaging: 0.0, noise };
        let mut tanks =
            Self { feeds, states: Vec::new(), channels: vec![channel], nuisances: constants(doubt), mechanisms: library() };
        let middle: Vec<f64> = tanks.nuisances.iter().map(|n| n.parameter.prior.value(0.0)).collect();
        tanks.settle(&middle);
        tanks
    }

    /// Takes the nominal model with these constants as the state that a mismatch may depend on.
    pub(crate) fn settle(&mut self, constants: &[f64]) {
        let state = |record: usize| {
            let level = self.run(record, constants, &[]).lower;
            let step = self.feeds[record].step;
            let rate = (0..level.len()).map(|n| (level[n] - level[n.saturating_sub(1)]) / step).collect();
            State { level, rate }
        };
        self.states = (0..self.feeds.len()).map(state).collect();
    }

    /// Levels and reading during a record.
    pub(crate) fn run(&self, record: usize, constants: &[f64], active: &[Active]) -> Course {
        let feed = &self.feeds[record];
        let of = |mechanism: usize, parameter: usize, otherwise: f64| {
            active.iter().find(|a| a.mechanism == mechanism).map_or(otherwise, |a| a.values[parameter])
        };
        let [drain_upper, inflow, drain_lower, gain, start, zero] = [0, 1, 2, 3, 4, 5].map(|k: usize| constants[k]);
        // nobody reads the upper level, so its scale is free: its rim is told by what the water in it is in the lower tank
        let upper_rim = of(UPPER_OVERFLOW, 0, f64::INFINITY) * drain_upper / inflow;
        let lower_rim = of(LOWER_OVERFLOW, 0, f64::INFINITY);
        let (share, leak, viscous) = (of(UPPER_OVERFLOW, 1, 0.0), of(LEAK, 0, 0.0), of(VISCOUS_OUTFLOW, 0, 0.0));
        let (dead, most) = (of(DEAD_ZONE, 0, 0.0), of(PUMP_SATURATION, 0, f64::INFINITY));
        let reads = of(SENSOR_SATURATION, 0, f64::INFINITY);
        let dt = feed.step / PARTS as f64;
        let (mut upper, mut lower) = (start.min(upper_rim), (feed.start + zero).min(lower_rim));
        let mut course = Course::default();
        for pump in &feed.pump {
            course.upper.push(upper);
            course.lower.push(lower);
            course.reading.push((lower - zero).min(reads));
            let filled = gain * (pump - dead).max(0.0).min(most);
            for _ in 0..PARTS {
                // the slow flow of a thick film adds to Bernoulli's
                let flow = |level: f64, exponent: f64| level.max(0.0).powf(exponent) + viscous * level;
                let (above, below) = (flow(upper, constants[6]), flow(lower, constants[7]));
                upper += dt * (filled - drain_upper * above - leak * upper);
                lower += dt * (inflow * above - drain_lower * below);
                let spilt = (upper - upper_rim).max(0.0);
                upper = (upper - spilt).max(0.0);
                lower = (lower + share * spilt * inflow / drain_upper).clamp(0.0, lower_rim);
            }
        }
        course
    }
}

impl ForwardModel for Tanks {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, record: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        Ok(vec![self.run(record, nuisances, active).reading])
    }

    fn state(&self, record: usize) -> &State {
        &self.states[record]
    }
}
