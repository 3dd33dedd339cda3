//! Parameters that a nuisance carries along, against a model in which the nuisance acts on the mechanism itself.

use crate::common::normal;
use diagnosis::{
    Active, Channel, ForwardModel, Hypothesis, NoisePrior, Nuisance, Observation, Omission, Parameter, Place, Prior, Role, State,
    fitted,
};

const ROWS: usize = 300;
const WHITE: f64 = 0.05;
/// What one unit of the nuisance does to each parameter while the effect stays.
const BY: [f64; 3] = [1.7, -0.4, 0.9];
const NUISANCE: f64 = 0.3;

/// A series that a nuisance makes a part of, and a mechanism with a term for each of three parameters.
struct Terms {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    terms: Vec<Omission>,
    state: State,
    /// whether the nuisance acts on the terms, or carries their parameters along
    acts: bool,
}

impl Terms {
    fn new(acts: bool) -> Self {
        let noise = NoisePrior::new((WHITE, 0.01), (0.3 * WHITE, 1.2), (5000.0, 0.8), (1e-4 * WHITE, 1.5));
        let parameters = vec![
            Parameter::new("from a range", Prior::Uniform { low: -10.0, high: 20.0 }),
            Parameter::new("positive", Prior::LogNormal { median: 4.0, spread: 2.0 }),
            Parameter::new("a size", Prior::Size { scale: 5.0 }),
        ];
        let starts = vec![vec![1.0, 5.0, 1.0]];
        let (id, stage) = ("terms".into(), String::new());
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![Nuisance::normal("nuisance", 0.0, 2.0, Role::Sensor)],
            terms: vec![Omission { id, stage, parameters, choice: None, starts, named: true, weight: 1.0 }],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            acts,
        }
    }
}

impl ForwardModel for Terms {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.terms
    }

    fn acts_on_mechanisms(&self, _: usize) -> bool {
        self.acts
    }

    fn carries(&self, _: usize, active: &Active) -> Vec<f64> {
        assert_eq!(active.values.len(), BY.len());
        if self.acts { Vec::new() } else { BY.to_vec() }
    }

    fn respond(&self, _: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let by = if self.acts { nuisances[0] } else { 0.0 };
        let row = |n: usize| {
            let t = n as f64;
            let size = |k: usize| active.iter().map(|own| own.values[k] - by * BY[k]).sum::<f64>();
            let terms: f64 = (0..BY.len()).map(|k| size(k) * (t / (9.0 + 5.0 * k as f64)).sin()).sum();
            nuisances[0] * (t / 70.0).cos() + terms
        };
        Ok(vec![(0..ROWS).map(row).collect()])
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

#[test]
fn a_parameter_is_as_open_as_if_the_nuisance_acted_on_its_effect() {
    let truth = Active { mechanism: 0, values: vec![2.0, 6.0, -1.5], choice: None };
    let mut read = Terms::new(true).respond(0, &[NUISANCE], &[truth]).expect("a response");
    let mut normal = normal(5);
    read[0].iter_mut().for_each(|y| *y += WHITE * normal());
    let observed = Observation { time: (0..ROWS).map(|n| n as f64).collect(), channels: read };
    let hypothesis = Hypothesis { mechanisms: vec![(0, None)], constants_free: false };
    let [acting, carrying] = [true, false].map(|acts| {
        let model = Terms::new(acts);
        let fit = fitted(&model, &[0], std::slice::from_ref(&observed), std::slice::from_ref(&hypothesis)).expect("a fit");
        let own = fit.posteriors(&model).into_iter().filter(|p| p.place == Place::Mechanism(0));
        // in units of the values
        own.map(|p| (p.prior.value(p.u + 0.5 * p.sd) - p.prior.value(p.u - 0.5 * p.sd), p.value())).collect::<Vec<_>>()
    });
    for (k, ((exact, at), (told, carried))) in acting.iter().zip(&carrying).enumerate() {
        // the value is that for which the model was made, at the middle of the nuisance's prior
        assert!((at - carried - NUISANCE * BY[k]).abs() < 4.0 * exact, "{at} {carried}");
        assert!((told / exact - 1.0).abs() < 0.02, "parameter {k}: {told} for {exact}");
        println!("{k}: {told} for {exact}");
    }
}
