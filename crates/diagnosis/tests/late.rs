//! A clock that is late with all that is read, beside a mechanism that is switched on at the first row and makes most of the reading: what the delay does
//! beside the mechanism is another thing than what it does without.

use crate::common::normal;
use diagnosis::{
    Active, Channel, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State, settled,
};

const WHITE: [f64; 2] = [0.01, 0.013];
const ROWS: usize = 400;
const STEP_S: f64 = 30.0;
const DELAY: usize = 0;

/// A temperature and its rate, of a body that follows a slow drive and is heated in two layers.
struct Body {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    heater: Vec<Omission>,
    state: State,
}

fn time() -> impl Iterator<Item = f64> {
    (0..ROWS).map(|n| STEP_S * n as f64)
}

/// Rise of the temperature and of a phase, so long after a heater of unit power was switched on \[s\].
fn heated(since: f64) -> [f64; 2] {
    let [slow, quick] = [900.0, 25.0].map(|lag: f64| 1.0 - (-since.max(0.0) / lag).exp());
    [20.0 * slow, 400.0 * quick + 300.0 * slow]
}

impl Body {
    fn new() -> Self {
        let channel = |name: &str, averaging: f64, white: f64| Channel {
            name: name.into(),
            unit: "1".into(),
            offset: (0.0, f64::INFINITY),
            averaging,
            noise: NoisePrior::new((white, 0.5), (0.3 * white, 1.2), (5000.0, 0.8), (1e-4 * white, 1.5)),
        };
        let starts = [0.005, 0.05, 0.5].iter().flat_map(|power| [10.0, 60.0, 300.0].map(|before| vec![*power, before])).collect();
        Self {
            channels: vec![channel("temperature", 0.0, WHITE[0]), channel("rate", STEP_S, WHITE[1])],
            nuisances: vec![
                Nuisance::normal("delay [s]", 0.0, 15.0, Role::Sensor),
                Nuisance::normal("gain", 1.0, 0.1, Role::Constant),
                Nuisance::normal("delay of the drive [s]", 0.0, 67.0, Role::Sensor),
            ],
            heater: vec![Omission {
                id: "heater".into(),
                stage: "heat".into(),
                parameters: vec![
                    Parameter::new("power", Prior::LogNormal { median: 0.2, spread: 1.6 }),
                    Parameter::new("before_s", Prior::LogNormal { median: 60.0, spread: 1.5 }),
                ],
                choice: None,
                starts,
                named: true,
                weight: 1.0,
            }],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
        }
    }

    fn run(&self, nuisances: &[f64], active: &[Active]) -> [Vec<f64>; 2] {
        let [delay, gain] = [nuisances[DELAY], nuisances[1]];
        let drive = |t: f64| [10.0, gain * 100.0].map(|most| most * ((t + nuisances[2]) / 2000.0).sin());
        let of = |t: f64, channel: usize| {
            let on = active.iter().map(|own| own.values[0] * heated(t + own.values[1])[channel]).sum::<f64>();
            drive(t)[channel] + on
        };
        let temperature = time().map(|t| of(t, 0)).collect();
        let rates: Vec<f64> = time().map(|t| (of(t, 1) - of(t - STEP_S, 1)) / STEP_S).collect();
        // read between rows on straight lines; beyond the ends stands that of the end
        let late = |t: f64| {
            let at = ((t - delay) / STEP_S).clamp(0.0, (ROWS - 1) as f64);
            let row = (at as usize).min(ROWS - 2);
            rates[row] + (at - row as f64) * (rates[row + 1] - rates[row])
        };
        [temperature, time().map(late).collect()]
    }
}

impl ForwardModel for Body {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.heater
    }

    fn acts_on_mechanisms(&self, nuisance: usize) -> bool {
        nuisance == DELAY
    }

    fn respond(&self, _: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        Ok(self.run(nuisances, active).to_vec())
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

#[test]
fn a_heater_is_found_beside_a_clock_that_may_be_late() {
    let body = Body::new();
    for seed in 1..=30 {
        let mut normal = normal(seed);
        let delay = 15.0 * normal();
        // every other heater is switched on at the first row
        let before = 0.13 + if seed % 2 == 0 { 0.0 } else { 100.0 * (1.0 + normal()).abs() };
        let (late, gain) = (40.0 * normal(), 1.0 + 0.05 * normal());
        let truth = Active { mechanism: 0, values: vec![0.25, before], choice: None };
        let read = body.run(&[delay, gain, late], &[truth]);
        let channels =
            read.iter().zip(WHITE).map(|(series, white)| series.iter().map(|y| y + white * normal()).collect()).collect();
        let observed = Observation { time: time().collect(), channels };
        let found = settled(&body, &[0], std::slice::from_ref(&observed), &|_| ()).expect("a fit").leading.expect("a heater");
        let squares = found.residuals[0][1].iter().map(|r| r * r).sum::<f64>();
        let left = (squares / ROWS as f64).sqrt();
        let told = (&found.active, found.nuisances[0][DELAY]);
        assert!(left < 1.2 * WHITE[1], "seed {seed}, {delay} s late, on for {before} s: {told:?} leaves {left}");
    }
}
