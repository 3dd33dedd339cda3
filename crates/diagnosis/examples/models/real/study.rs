//! One recording studied: the nominal model fitted, a law composed, what was held out predicted; and the same by least squares and by a network.

use super::law::Law;
use super::network::Network;
use super::offered::Offered;
use super::plant::{Kind, Plant};
use super::shapes::Past;
use diagnosis::{
    Active, Breadth, Composed, Earlier, Fit, ForwardModel, Hypothesis, Observation, Plan, Proof, compose_within, fitted, prove,
    proven, separation,
};

pub(crate) use diagnosis::Error;

/// Laws that are looked for in a recording.
pub(crate) const BREADTH: Breadth = Breadth { terms: 6, followed: 12, likeliest: 6, turnings: 5, earlier: Earlier::Weighed };
/// Seeds of the networks, of which the median counts.
const SEEDS: [u64; 3] = [1, 2, 3];
/// Shares of a record's duration by which a network's inputs are lagged.
const LAGS: [f64; 2] = [1.0 / 30.0, 1.0 / 6.0];

/// Records by their numbers in the model.
pub(crate) struct Records<'a> {
    pub(crate) fitted: &'a [usize],
    pub(crate) held: &'a [usize],
}

/// Terms that a fit by least squares is told.
pub(crate) struct Told {
    pub(crate) name: &'static str,
    pub(crate) laws: Vec<Law>,
}

/// Results of a study.
pub(crate) struct Study<P> {
    pub(crate) model: Offered<P>,
    pub(crate) nominal: Fit,
    pub(crate) composed: Option<Composed>,
    /// Predictions of the held-out records, by the nominal model and with all composed laws.
    pub(crate) proof: Option<Proof>,
    /// Those of the laws that the held-out records confirm, and their predictions of these records.
    pub(crate) accepted: Option<(Fit, Proof)>,
    /// By least squares with the terms told.
    pub(crate) told: Vec<(&'static str, Proof)>,
    /// Root mean squares `[record][channel]` with a network.
    pub(crate) network: Vec<Vec<f64>>,
    /// Root mean squares `[record][channel]` of the nominal model.
    pub(crate) before: Vec<Vec<f64>>,
}

/// Composes a law for records of a plant; `recorded` are the channels of every test.
pub(crate) fn composed<P: Plant + Clone>(
    plain: Offered<P>,
    recorded: &[Observation],
    records: &Records<'_>,
    breadth: Breadth,
) -> Result<(Offered<P>, Fit, Option<Composed>), Error> {
    let observations: Vec<Observation> = records.fitted.iter().map(|r| recorded[*r].clone()).collect();
    let plain = plain.with_noise(records.fitted, &observations)?;
    let nominal = plain.nominal(records.fitted, &observations)?;
    let model = plain.with_laws(&nominal, records.fitted, &observations);
    let all = 0..model.mechanisms().len();
    let composed = compose_within(&model, all, records.fitted, &observations, &nominal, breadth, &|_| ())?;
    Ok((model, nominal, composed))
}

/// All of it: `recorded` are the records by their numbers.
pub(crate) fn study<P: Plant + Clone>(
    plain: Offered<P>,
    recorded: &[Observation],
    records: &Records<'_>,
    told: &[Told],
    breadth: Breadth,
) -> Result<Study<P>, Error> {
    let (model, nominal, composed) = self::composed(plain, recorded, records, breadth)?;
    let held: Vec<(usize, &Observation)> = records.held.iter().map(|r| (*r, &recorded[*r])).collect();
    let proof = composed.as_ref().map(|c| prove(&model, &nominal, &c.fit, &held)).transpose()?;
    let steps = composed.as_ref().map_or(&[][..], |c| &c.steps);
    let accepted = match proven(&model, &nominal, steps, &held)? {
        Some(fit) => Some((fit.clone(), prove(&model, &nominal, fit, &held)?)),
        None => None,
    };
    let before = held.iter().map(|(r, o)| Ok(nominal.hold_out(&model, *r, o, &nominal)?.rmse)).collect::<Result<_, Error>>()?;
    let mut by_told = Vec::new();
    for Told { name, laws } in told {
        // laws that run away where nothing holds them have no fit by least squares
        match by_least_squares(&model, laws, recorded, records, &held) {
            Ok(proof) => by_told.push((*name, proof)),
            Err(Error::NotFinite | Error::NoStart) => {}
            Err(error) => return Err(error),
        }
    }
    let network = networks(&model, &nominal, recorded, records)?;
    Ok(Study { model, nominal, composed, proof, accepted, told: by_told, network, before })
}

fn by_least_squares<P: Plant + Clone>(
    model: &Offered<P>,
    laws: &[Law],
    recorded: &[Observation],
    records: &Records<'_>,
    held: &[(usize, &Observation)],
) -> Result<Proof, Error> {
    let observations: Vec<Observation> = records.fitted.iter().map(|r| recorded[*r].clone()).collect();
    let squares = model.by_squares();
    let number = |law: &Law| squares.laws.iter().position(|l| l == law).map(|at| (at, None));
    let hypothesis = Hypothesis { mechanisms: laws.iter().filter_map(number).collect(), constants_free: true };
    let fit = |hypothesis| fitted(&squares, records.fitted, &observations, &[hypothesis]);
    prove(&squares, &fit(Hypothesis::RECALIBRATED)?, &fit(hypothesis)?, held)
}

/// Inputs of a network in every row of a record: the nominal model's quantities, and the same lagged.
fn features<P: Plant>(model: &Offered<P>, record: usize, constants: &[f64]) -> Vec<Vec<f64>> {
    let moments = model.moments(record, constants);
    let rows = model.rows(record);
    let finer = (moments.len() / rows.end).max(1);
    let kinds: Vec<Kind> = model.plant.facts().quantities.iter().map(|q| q.kind).collect();
    let mut pasts = vec![[Past::default(), Past::default()]; kinds.len()];
    let mut all = Vec::new();
    for (n, (step, q, _)) in moments.iter().enumerate() {
        let mut row = Vec::new();
        for ((x, kind), pasts) in q.iter().zip(&kinds).zip(&mut pasts) {
            match kind {
                Kind::Phase => row.extend(
                    [1.0, 2.0]
                        .iter()
                        .flat_map(|k| [(std::f64::consts::TAU * k * x).sin(), (std::f64::consts::TAU * k * x).cos()]),
                ),
                // what goes on beyond the fitted records is no input that a network can learn
                Kind::Time => {}
                _ => {
                    row.push(*x);
                    row.extend(
                        pasts.iter_mut().zip(LAGS).map(|(past, lag)| past.follow(0, *x, *step, lag * model.scales.duration)),
                    );
                }
            }
        }
        if n % finer == 0 && n / finer >= rows.start {
            all.push(row);
        }
    }
    all
}

/// The median network of each channel beside the nominal model.
fn networks<P: Plant>(
    model: &Offered<P>,
    nominal: &Fit,
    recorded: &[Observation],
    records: &Records<'_>,
) -> Result<Vec<Vec<f64>>, Error> {
    let constants = &nominal.nuisances[0];
    let inputs: Vec<Vec<f64>> = records.fitted.iter().flat_map(|r| features(model, *r, constants)).collect();
    let mut all = vec![Vec::new(); records.held.len()];
    for channel in 0..model.channels().len() {
        let wanted: Vec<f64> = nominal.residuals.iter().flat_map(|r| r[channel].iter().copied()).collect();
        let own_offset = model.channels()[channel].offset.1.is_infinite();
        let mut tries = vec![Vec::new(); records.held.len()];
        for seed in SEEDS {
            let net = Network::trained(&inputs, &wanted, seed);
            for (tries, record) in tries.iter_mut().zip(records.held) {
                let response = &nominal.hold_out(model, *record, &recorded[*record], nominal)?.prediction[channel];
                let rows = features(model, *record, constants);
                let left: Vec<f64> = recorded[*record].channels[channel]
                    .iter()
                    .zip(response)
                    .zip(&rows)
                    .map(|((y, p), x)| y - p - net.of(x))
                    .collect();
                let mean = if own_offset { left.iter().sum::<f64>() / left.len() as f64 } else { 0.0 };
                tries.push((left.iter().map(|r| (r - mean).powi(2)).sum::<f64>() / left.len() as f64).sqrt());
            }
        }
        for (all, mut tries) in all.iter_mut().zip(tries) {
            tries.sort_by(f64::total_cmp);
            all.push(tries[tries.len() / 2]);
        }
    }
    Ok(all)
}

/// How far in standard deviations a record yet to be made would set a law, of the size at which it was composed, apart from a rival in its place.
pub(crate) fn versus<P: Plant>(study: &Study<P>, law: &Law, rival: &Law, record: usize, time: &[f64]) -> Result<f64, Error> {
    let number = |law: &Law| study.model.laws.iter().position(|l| l == law);
    let (Some(composed), Some(own), Some(rival)) = (&study.composed, number(law), number(rival)) else { return Ok(0.0) };
    if composed.fit.active.iter().all(|a| a.mechanism != own) {
        return Ok(0.0);
    }
    let hypothesis = |law: usize| {
        let kept = composed.fit.hypothesis.mechanisms.iter().filter(|(m, _)| *m != own).copied();
        Hypothesis { mechanisms: kept.chain([(law, None)]).collect(), constants_free: true }
    };
    apart(study, &composed.fit, &composed.fit.active, hypothesis(rival), record, time)
}

/// How far a record of the noise of a fit would set what is at work apart from a hypothesis.
fn apart<P: Plant>(
    study: &Study<P>,
    like: &Fit,
    truth: &[Active],
    rival: Hypothesis,
    record: usize,
    time: &[f64],
) -> Result<f64, Error> {
    let channels = study.model.channels().len();
    let instants = [Observation { time: time.to_vec(), channels: vec![vec![0.0; time.len()]; channels] }];
    let noise: Vec<_> = (0..channels).map(|c| *like.noise_model(0, c)).collect();
    let plan = Plan { records: &[record], instants: &instants, noise: Some(&noise) };
    Ok(separation(&study.model, &plan, truth, &[rival])?.sigma())
}
