//! Expected course of a programme for the pair that it tells apart worst.

use diagnosis::{ForwardModel, Plan, expected, separation};
use mechanisms::{Gyro, RATE, SPOOL};

use super::Programme;
use super::bench::{Contender, Failure, INTERVAL, Odds, everything};

/// The expected course of a test.
#[derive(Debug, Clone)]
pub struct Course {
    /// The truth, and the rival that is taken for it.
    pub pair: [String; 2],
    /// Instants \[s\].
    pub time: Vec<f64>,
    /// Chamber \[°C\].
    pub chamber: Vec<f64>,
    /// Rate \[deg/h\].
    pub rate: Trace,
    /// Spool thermometer \[K\].
    pub spool: Trace,
}

/// One channel of it.
#[derive(Debug, Clone)]
pub struct Trace {
    /// Contribution of each of the pair, at its size, to the response of the design; zero where it is no mechanism.
    pub added: [Vec<f64>; 2],
    /// Remainder of the truth when its rival, the model's errors and the offset are fitted to it.
    pub left: Vec<f64>,
    /// Share of that in the squared distance, 0 to 1.
    pub share: f64,
    /// Standard deviation of the white noise of a reading.
    pub noise: f64,
}

impl Course {
    /// Course of the pair that `odds` names, under the record `number` of the model, which is `programme`.
    pub(super) fn new(
        gyro: &Gyro,
        contenders: &[Contender],
        odds: &Odds,
        (number, programme): (usize, &Programme),
        plan: &Plan,
    ) -> Result<Self, Failure> {
        let of = |id: &String| contenders.iter().find(|c| c.id == *id);
        let ([Some(truth), Some(rival)], middle) = (odds.pair.each_ref().map(of), expected(gyro.nuisances())) else {
            return Err(diagnosis::Error::Data(format!("{} are not compared", odds.pair.join(" and "))));
        };
        let active = truth.truth.as_slice();
        let apart = separation(gyro, plan, active, &rival.hypotheses)?;
        let respond = |active| gyro.respond(number, &middle, active).map_err(|source| diagnosis::Error::Model(source.into()));
        let (design, own, other) = (respond(&[])?, respond(active)?, respond(rival.truth.as_slice())?);
        let instants = everything(programme);
        let trace = |channel: usize| {
            let added = [&own, &other].map(|r| r[channel].iter().zip(&design[channel]).map(|(a, b)| a - b).collect());
            let (_, white) = apart.rival.whitened_residual(0, channel, &instants, &apart.rival);
            let share = white.iter().map(|w| w * w).sum::<f64>() / apart.squared.max(f64::MIN_POSITIVE);
            let noise = apart.rival.noise_model(0, channel).white;
            Trace { added, left: apart.rival.residuals[0][channel].clone(), share, noise }
        };
        let (time, chamber) = programme.sampled(INTERVAL);
        Ok(Self { pair: odds.pair.clone(), time, chamber, rate: trace(RATE), spool: trace(SPOOL) })
    }
}
