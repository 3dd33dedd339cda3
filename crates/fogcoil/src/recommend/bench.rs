//! Contenders, and their separation by a test.

use diagnosis::{Active, ForwardModel, Hypothesis, Observation, Plan, Settings, alternatives, expected, separation};
use mechanisms::{Chamber, Gyro, Library, Prepared, RATE, SPOOL};
use recording::noise::NoiseModel;

use super::Programme;

/// Ids besides the library's: the design as it is, and its own constants re-estimated.
const NOMINAL: &str = "nominal";
const RECALIBRATE: &str = "recalibrate";
/// Choices that stand for all of a mechanism's where a bound is enough.
const FEW: usize = 6;
/// Span of a reading in the tests that are proposed \[s\].
pub(super) const INTERVAL: f64 = 30.0;

pub(super) type Failure = diagnosis::Error;

/// A hypothesis to be told apart from others.
#[derive(Clone)]
pub(crate) struct Contender {
    pub(crate) id: String,
    pub(crate) hypotheses: Vec<Hypothesis>,
    /// the mechanism at work when it is the truth; the nominal and the recalibrated design are never taken for the truth
    pub(crate) truth: Option<Active>,
}

impl Contender {
    /// Contender of an id. A mechanism has a size that is neither small nor large: the middle of the priors, or one σ beyond where the middle means
    /// that nothing is at work. `None` if the library does not hold it.
    pub(crate) fn named(gyro: &Gyro, id: &str) -> Result<Option<Self>, Failure> {
        Ok(match (id, gyro.find(id)) {
            (NOMINAL, _) => Some(Self { id: NOMINAL.into(), hypotheses: vec![Hypothesis::NOMINAL], truth: None }),
            (RECALIBRATE, _) => Some(Self::recalibrated()),
            (_, Some(mechanism)) => Some(Self::of(gyro, typical(gyro, mechanism)?)),
            (_, None) => None,
        })
    }

    pub(crate) fn of(gyro: &Gyro, truth: Active) -> Self {
        let id = gyro.mechanisms()[truth.mechanism].id.clone();
        Self { id, hypotheses: alternatives(gyro, truth.mechanism), truth: Some(truth) }
    }

    pub(crate) fn recalibrated() -> Self {
        let hypotheses = vec![Hypothesis { constants_free: true, ..Hypothesis::NOMINAL }];
        Self { id: RECALIBRATE.into(), hypotheses, truth: None }
    }

    /// The contender with few of its choices. As a rival it is told apart at least as well as with all of them: an upper bound.
    pub(super) fn narrowed(&self) -> Self {
        let every = self.hypotheses.len().div_ceil(FEW);
        Self { hypotheses: self.hypotheses.iter().skip(every / 2).step_by(every.max(1)).cloned().collect(), ..self.clone() }
    }

    pub(super) fn known(gyro: &Gyro) -> String {
        let ids: Vec<&str> = gyro.mechanisms().iter().map(|m| m.id.as_str()).chain([NOMINAL, RECALIBRATE]).collect();
        ids.join(", ")
    }
}

fn typical(gyro: &Gyro, mechanism: usize) -> Result<Active, Failure> {
    let entry = &gyro.mechanisms()[mechanism];
    let choice = entry.choice.as_ref().map(|(_, values)| values[values.len() / 2]);
    let at = |u: f64| Active { mechanism, values: entry.parameters.iter().map(|p| p.prior.value(u)).collect(), choice };
    let middle = expected(gyro.nuisances());
    let respond = |active: &[Active]| gyro.respond(0, &middle, active).map_err(|source| diagnosis::Error::Model(source.into()));
    let (with, without) = (respond(&[at(0.0)])?, respond(&[])?);
    let off = with.iter().flatten().zip(without.iter().flatten()).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
    Ok(at(if off < 1e-9 { 1.0 } else { 0.0 }))
}

/// Separation of contenders: of the pair that is told apart worst.
#[derive(Debug, Clone, PartialEq)]
pub struct Odds {
    /// The truth, and the rival that is taken for it.
    pub pair: [String; 2],
    /// Distance in standard deviations of the noise.
    pub sigma: f64,
    /// Expected ln of the odds for the truth.
    pub log_odds: f64,
}

impl Odds {
    /// Whether the loser is expected to be excluded.
    pub fn decides(&self) -> bool {
        told_apart(self.log_odds)
    }
}

/// Whether expected ln odds are enough to exclude the loser.
pub(crate) fn told_apart(log_odds: f64) -> bool {
    log_odds >= -Settings::default().excluded.ln()
}

/// The ordered pair of contenders that is told apart worst.
pub(crate) fn odds(gyro: &Gyro, contenders: &[Contender], plan: &Plan) -> Result<Odds, Failure> {
    let mut worst: Option<Odds> = None;
    for truth in contenders {
        let Some(active) = &truth.truth else { continue };
        for rival in contenders.iter().filter(|r| r.id != truth.id) {
            let found = separation(gyro, plan, std::slice::from_ref(active), &rival.hypotheses)?;
            let odds = Odds { pair: [truth.id.clone(), rival.id.clone()], sigma: found.sigma(), log_odds: found.log_odds() };
            if worst.as_ref().is_none_or(|w| odds.log_odds < w.log_odds) {
                worst = Some(odds);
            }
        }
    }
    worst.ok_or_else(|| diagnosis::Error::Data("there is no pair to tell apart".into()))
}

pub(crate) fn prepared(library: &Library, programme: &Programme) -> Result<Prepared, coil::Error> {
    let (time, chamber) = programme.sampled(INTERVAL);
    Prepared::under(library, &time, &Chamber::given(&time, &chamber), INTERVAL)
}

/// Both channels at every instant of a programme.
pub(crate) fn everything(programme: &Programme) -> Observation {
    let (time, _) = programme.sampled(INTERVAL);
    let channels = vec![vec![0.0; time.len()]; 2];
    Observation { time, channels }
}

/// The medians of the channels' priors.
pub(crate) fn usual(gyro: &Gyro) -> [NoiseModel; 2] {
    [SPOOL, RATE].map(|channel| {
        let prior = &gyro.channels()[channel].noise;
        let averaging = if channel == RATE { INTERVAL } else { 0.0 };
        let [white, drift, drift_time, walk] = [prior.white.0, prior.drift.0, prior.drift_time.0, prior.walk.0];
        NoiseModel { drift, drift_time, walk, ..NoiseModel::white(white, averaging) }
    })
}
