//! Two mechanisms with nearly the same effect, one of which a model about the drawing knows badly: which of them it is shows about each of them alone.

use crate::common::normal;
use diagnosis::{
    Active, Channel, ForwardModel, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, State, settled,
};

const WHITE: f64 = 0.05;
const ROWS: usize = 241;
const TRUTH: f64 = 4.0;
/// The mechanism that is at work, and the one that looks like it about the drawing.
const WORKS: usize = 1;
const LOOKS: usize = 0;

struct Pair {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    /// the mechanism that it is made about
    about: Option<usize>,
}

fn x() -> impl Iterator<Item = f64> {
    (0..ROWS).map(|n| n as f64 / (ROWS - 1) as f64)
}

impl Pair {
    fn new(about: Option<usize>) -> Self {
        let noise = NoisePrior::new((WHITE, 1e-4), (1e-9, 1e-4), (100.0, 1e-4), (1e-9, 1e-4));
        let one = |id: &str| Omission {
            id: id.into(),
            stage: "one".into(),
            parameters: vec![Parameter::new("size", Prior::Normal { mean: 0.0, sd: 3.0 })],
            choice: None,
            starts: vec![vec![1.0]],
            named: true,
            weight: 1.0,
        };
        Self {
            channels: vec![Channel { name: "y".into(), unit: "1".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![Nuisance::normal("gain", 1.0, 0.01, Role::Constant)],
            mechanisms: vec![one("looks"), one("works")],
            state: State { level: vec![0.0; ROWS], rate: vec![0.0; ROWS] },
            about,
        }
    }
}

impl ForwardModel for Pair {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn respond(&self, _: usize, gain: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let of = |x: f64| {
            let effect = |a: &Active| {
                let beside = match a.mechanism {
                    LOOKS => 0.05 * (9.0 * x).cos(),
                    // only about itself it is known well
                    _ if self.about == Some(WORKS) => 0.0,
                    _ => 0.1 * (14.0 * x).cos(),
                };
                a.values[0] * ((5.0 * x).sin() + beside)
            };
            gain[0] * (x + active.iter().map(effect).sum::<f64>())
        };
        Ok(vec![x().map(of).collect()])
    }

    fn about(&self, _: &[f64], active: &[Active]) -> Result<Option<Self>, diagnosis::Failure> {
        let leads = active.first().map(|a| a.mechanism);
        Ok((leads != self.about).then(|| Self::new(leads)))
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }
}

#[test]
fn the_runner_up_is_followed_to_where_it_leads() {
    let mut normal = normal(4);
    let y = x().map(|x| x + TRUTH * (5.0 * x).sin() + WHITE * normal()).collect();
    let observed = Observation { time: x().map(|x| 600.0 * x).collect(), channels: vec![y] };
    let settled = settled(&Pair::new(None), &[0], &[observed], &|_| ()).expect("a fit");
    let leading = settled.leading.expect("one leads");
    assert_eq!(leading.active[0].mechanism, WORKS);
    assert!((leading.active[0].values[0] - TRUTH).abs() < 0.1, "{:?}", leading.active);
    assert_eq!(settled.model.expect("a model").about, Some(WORKS));
}
