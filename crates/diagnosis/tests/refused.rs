//! A model that contradicts itself, and observations that do not fit it, are refused by an error that names them.

use diagnosis::{
    Active, Channel, Error, ForwardModel, Latent, NoisePrior, Nuisance, Observation, Omission, Parameter, Prior, Role, Settings,
    State, diagnose, diagnose_settled, settled,
};
use nalgebra::DMatrix;

const ROWS: usize = 40;

/// A reading y = gain · sin + slope · cos, of which every part can be made wrong.
struct Reading {
    channels: Vec<Channel>,
    nuisances: Vec<Nuisance>,
    mechanisms: Vec<Omission>,
    state: State,
    /// Lengths of the response's series, and of one that a mechanism changes.
    rows: [Vec<usize>; 2],
    stands_for: Option<usize>,
    precision: Option<DMatrix<f64>>,
    latent: Vec<Latent>,
    /// Row without a response.
    nan: Option<usize>,
}

impl Reading {
    fn new() -> Self {
        let noise = NoisePrior::new((0.1, 0.5), (0.01, 0.5), (500.0, 0.5), (1e-5, 0.5));
        let slope = Omission {
            id: "slip".into(),
            stage: "shaft".into(),
            parameters: vec![Parameter::new("slope", Prior::Normal { mean: 0.0, sd: 1.0 })],
            choice: None,
            starts: vec![vec![0.0]],
            named: true,
            weight: 1.0,
        };
        Self {
            channels: vec![Channel { name: "flow".into(), unit: "l/h".into(), offset: (0.0, 1.0), averaging: 0.0, noise }],
            nuisances: vec![Nuisance::normal("gain", 1.0, 0.01, Role::Constant)],
            mechanisms: vec![slope],
            state: State { level: wave(ROWS, 0.0), rate: wave(ROWS, 1.6) },
            rows: [vec![ROWS], vec![ROWS]],
            stands_for: None,
            precision: None,
            latent: Vec::new(),
            nan: None,
        }
    }
}

fn wave(rows: usize, shift: f64) -> Vec<f64> {
    (0..rows).map(|n| (0.4 * n as f64 + shift).sin()).collect()
}

impl ForwardModel for Reading {
    fn channels(&self) -> &[Channel] {
        &self.channels
    }

    fn nuisances(&self) -> &[Nuisance] {
        &self.nuisances
    }

    fn precision(&self) -> Option<&DMatrix<f64>> {
        self.precision.as_ref()
    }

    fn mechanisms(&self) -> &[Omission] {
        &self.mechanisms
    }

    fn stands_for(&self, _: usize) -> Option<usize> {
        self.stands_for
    }

    fn respond(&self, _: usize, nuisances: &[f64], active: &[Active]) -> Result<Vec<Vec<f64>>, diagnosis::Failure> {
        let slope = active.first().and_then(|a| a.values.first()).copied().unwrap_or(0.0);
        let gain = nuisances.first().copied().unwrap_or(1.0);
        let of = |rows: &usize| wave(*rows, 0.0).iter().zip(wave(*rows, 1.6)).map(|(x, y)| gain * x + slope * y).collect();
        let mut response: Vec<Vec<f64>> = self.rows[usize::from(!active.is_empty())].iter().map(of).collect();
        self.nan.iter().for_each(|row| response[0][*row] = f64::NAN);
        Ok(response)
    }

    fn state(&self, _: usize) -> &State {
        &self.state
    }

    fn latent(&self, _: usize) -> Result<Vec<Latent>, diagnosis::Failure> {
        Ok(self.latent.clone())
    }
}

fn observed() -> Observation {
    let mut normal = crate::common::normal(3);
    let flow = wave(ROWS, 0.0).iter().map(|x| x + 0.1 * normal()).collect();
    Observation { time: (0..ROWS).map(|n| 30.0 * n as f64).collect(), channels: vec![flow] }
}

/// Text of the error by which all ways into the comparison refuse.
fn refused_with(model: &Reading, observations: &[Observation]) -> String {
    let said = |error: Option<Error>| error.expect("a refusal").to_string();
    let text = said(diagnose(model, &[0], observations, &Settings::default(), &|_| ()).err());
    assert_eq!(said(settled(model, &[0], observations, &|_| ()).err()), text);
    let mut good = settled(&Reading::new(), &[0], &[observed()], &|_| ()).expect("a fit");
    assert_eq!(said(diagnose_settled(model, &mut good, &[0], observations, &Settings::default(), &|_| ()).err()), text);
    text
}

/// The same for a model that a change makes wrong.
fn refused(change: impl Fn(&mut Reading)) -> String {
    let mut model = Reading::new();
    change(&mut model);
    refused_with(&model, &[observed()])
}

#[test]
fn a_right_model_is_not_refused() {
    assert!(diagnose(&Reading::new(), &[0], &[observed()], &Settings::default(), &|_| ()).is_ok());
    // an offset that is known, one that may be anything, and a mechanism of weight 0 beside another
    for sd in [0.0, f64::INFINITY] {
        let mut model = Reading::new();
        model.channels[0].offset.1 = sd;
        model.mechanisms.push(Omission { id: "creep".into(), weight: 0.0, ..model.mechanisms[0].clone() });
        assert!(diagnose(&model, &[0], &[observed()], &Settings::default(), &|_| ()).is_ok());
    }
}

#[test]
fn a_response_of_another_shape_is_refused() {
    let short = "record 0: the response has 39 values of channel `flow` at 40 instants; give one for each";
    assert_eq!(refused(|m| m.rows[0] = vec![ROWS - 1]), short);
    assert_eq!(refused(|m| m.rows[1] = vec![ROWS - 1]), short);
    for (rows, found) in [(Vec::new(), 0), (vec![ROWS; 2], 2)] {
        let expected = format!("record 0: the response has {found} series, the model has 1 channel; give one series for each");
        assert_eq!(refused(|m| m.rows[0] = rows.clone()), expected);
    }
}

/// What is no number is told where it stands.
#[test]
fn what_is_not_finite_is_told_by_its_place() {
    // before anything is fitted the response is asked for with the middles of the priors
    let unknown = |m: &mut Reading| m.nan = Some(3);
    assert_eq!(
        refused(unknown),
        "record 0: the response of channel `flow` is not finite in row 3, with every nuisance as expected and no mechanism; give a number for every row"
    );
    for step in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let expected = |name: &str| format!("{name}: its step for differences is {step}; it has to be finite and above 0");
        assert_eq!(refused(|m| m.nuisances[0].parameter.step = step), expected("gain"));
        assert_eq!(refused(|m| m.mechanisms[0].parameters[0].step = step), expected("slip: slope"));
    }
    assert_eq!(
        refused(|m| m.mechanisms[0].starts.clear()),
        "slip: its fit has no start; give one, with a value for each parameter"
    );
    for (name, of) in [("level", 0), ("rate", 1)] {
        let mut model = Reading::new();
        [&mut model.state.level, &mut model.state.rate][of][7] = f64::NAN;
        let said = diagnose(&model, &[0], &[observed()], &Settings::default(), &|_| ()).expect_err("no number").to_string();
        assert_eq!(said, format!("record 0: the state's {name} is not finite in row 7; give a value in every row"));
    }
}

#[test]
fn a_state_of_another_length_a_model_without_channels_and_an_input_of_another_shape_are_refused() {
    let state = |levels: usize, rates: usize| State { level: wave(levels, 0.0), rate: wave(rates, 1.6) };
    for (levels, rates) in [(ROWS - 1, ROWS), (ROWS, 0), (0, 0), (ROWS + 1, ROWS)] {
        let model = Reading { state: state(levels, rates), ..Reading::new() };
        let expected =
            format!("record 0: the state has {levels} levels and {rates} rates at 40 instants; give one of each for each");
        let said = diagnose(&model, &[0], &[observed()], &Settings::default(), &|_| ()).expect_err("another state");
        assert_eq!(said.to_string(), expected);
        // structures alone need it
        let mut found = settled(&model, &[0], &[observed()], &|_| ()).expect("a fit");
        let said =
            diagnose_settled(&model, &mut found, &[0], &[observed()], &Settings::default(), &|_| ()).expect_err("as before");
        assert_eq!(said.to_string(), expected);
    }
    let none = refused_with(&Reading { channels: Vec::new(), ..Reading::new() }, &[observed()]);
    assert_eq!(none, "the model has no channel; give it one, or there is nothing to compare");
    let latent = |rows: usize| Latent { stage: "shaft".into(), functions: vec![vec![wave(rows, 0.0)]] };
    let model = Reading { latent: vec![latent(ROWS - 1)], ..Reading::new() };
    let error = diagnose(&model, &[0], &[observed()], &Settings::default(), &|_| ()).expect_err("a short input").to_string();
    assert_eq!(error, "record 0: an input at stage `shaft` has 39 values of channel `flow` at 40 instants; give one for each");
}

#[test]
fn an_observation_of_another_shape_or_without_a_value_is_refused() {
    let of = |change: &dyn Fn(&mut Observation)| {
        let mut observation = observed();
        change(&mut observation);
        refused_with(&Reading::new(), &[observation])
    };
    let series =
        |found: usize| format!("record 0: {found} series are observed, the model has 1 channel; give one series for each");
    assert_eq!(of(&|o| o.channels.clear()), series(0));
    assert_eq!(of(&|o| o.channels.push(o.channels[0].clone())), series(2));
    let long = "record 0: channel `flow` has 41 observed values at 40 instants; give one for each, NaN where there is none";
    assert_eq!(of(&|o| o.channels[0].push(0.0)), long);
    let nothing = "record 0: no channel has a value, so that there is nothing to compare; leave the record out";
    assert_eq!(of(&|o| o.channels[0].fill(f64::NAN)), nothing);
    for (value, said) in [(f64::INFINITY, "inf"), (-1e308, &format!("{}", -1e308))] {
        let huge = format!("record 0: channel `flow` is {said} in row 7; give a size below 1e100, NaN where there is none");
        assert_eq!(of(&|o| o.channels[0][7] = value), huge);
    }
    assert!(of(&|o| o.time[5] = f64::NAN).starts_with("instant 5, NaN s, "));
}

#[test]
fn what_the_caller_gives_wrong_is_no_failure_of_the_model() {
    let none = "0 observations of 1 records; give one of each, and at least one";
    assert_eq!(refused_with(&Reading::new(), &[]), none);
    let choice = refused(|m| m.mechanisms[0].choice = Some(("place".into(), Vec::new())));
    assert_eq!(choice, "slip: nothing to choose; give its choice a value, or leave it out");
}

#[test]
fn a_mechanism_with_wrong_starts_weight_or_constant_is_refused() {
    for (start, found) in [(Vec::new(), "0 values"), (vec![0.0; 2], "2 values")] {
        let expected = format!("slip: a start has {found}, the mechanism has 1 parameter; give one value for each");
        assert_eq!(refused(|m| m.mechanisms[0].starts.push(start.clone())), expected);
    }
    for start in [f64::NAN, f64::INFINITY] {
        let expected = format!("slip: slope: a start of {start} is outside its prior; give one inside");
        assert_eq!(refused(|m| m.mechanisms[0].starts.push(vec![start])), expected);
    }
    for (prior, start) in [(Prior::LogNormal { median: 1.0, spread: 1.0 }, -30.0), (Prior::Uniform { low: 0.0, high: 1.0 }, 1.5)]
    {
        let change = |m: &mut Reading| {
            m.mechanisms[0].parameters[0].prior = prior;
            m.mechanisms[0].starts = vec![vec![start]];
        };
        assert_eq!(refused(change), format!("slip: slope: a start of {start} is outside its prior; give one inside"));
    }
    assert_eq!(refused(|m| m.mechanisms.push(m.mechanisms[0].clone())), "slip: two mechanisms have this id; give each its own");
    for weight in [-1.0, f64::NAN, f64::INFINITY] {
        let expected = format!("slip: its weight is {weight}; it has to be finite and at least 0");
        assert_eq!(refused(|m| m.mechanisms[0].weight = weight), expected);
    }
    let weightless = "the mechanisms with a name all have weight 0; give one of them a weight, or leave them out";
    assert_eq!(refused(|m| m.mechanisms[0].weight = 0.0), weightless);
    let constant = "slip: it stands for nuisance 1, the model has 1 nuisance, numbered from 0";
    assert_eq!(refused(|m| m.stands_for = Some(1)), constant);
    assert!(refused(|m| m.precision = Some(DMatrix::identity(2, 2))).starts_with("the precision has 2 rows and 2 columns, "));
}

#[test]
fn a_prior_that_is_no_distribution_is_refused_by_the_name_of_its_parameter() {
    let (nan, infinite) = (f64::NAN, f64::INFINITY);
    let normal = |mean: f64, sd: f64| Prior::Normal { mean, sd };
    let lognormal = |median: f64, spread: f64| Prior::LogNormal { median, spread };
    let uniform = |low: f64, high: f64| Prior::Uniform { low, high };
    for (prior, said) in [
        (normal(0.0, 0.0), "the sd of its prior is 0; "),
        (normal(0.0, -1.0), "the sd of its prior is -1; "),
        (normal(0.0, nan), "the sd of its prior is NaN; "),
        (normal(nan, 1.0), "the mean of its prior is NaN; "),
        (uniform(1.0, 1.0), "its prior reaches from 1 to 1; "),
        (uniform(2.0, 1.0), "its prior reaches from 2 to 1; "),
        (uniform(0.0, infinite), "the upper end of its prior is inf; "),
        (lognormal(0.0, 1.0), "the median of its prior is 0; "),
        (lognormal(-3.0, 1.0), "the median of its prior is -3; "),
        (lognormal(1.0, 0.0), "the spread of its prior is 0; "),
        (Prior::Size { scale: 0.0 }, "the scale of its prior is 0; "),
    ] {
        let of_mechanism = refused(|m| m.mechanisms[0].parameters[0].prior = prior);
        assert!(of_mechanism.starts_with(&format!("slip: slope: {said}")), "{of_mechanism}");
        let of_constant = refused(|m| m.nuisances[0].parameter.prior = prior);
        assert!(of_constant.starts_with(&format!("gain: {said}")), "{of_constant}");
    }
    for (mean, sd) in [(nan, 1.0), (0.0, -1.0), (0.0, nan)] {
        assert!(refused(|m| m.channels[0].offset = (mean, sd)).starts_with("channel `flow`: its offset has mean "));
    }
}

#[test]
fn a_held_out_record_of_another_shape_is_refused() {
    let (model, fitted) = (Reading::new(), observed());
    let mut found = diagnose(&model, &[0], std::slice::from_ref(&fitted), &Settings::default(), &|_| ()).expect("a diagnosis");
    let mut judged = |held: &Observation, channel: usize| {
        found.judge(&model, &model, None, (0, &fitted), &[(0, held)], channel).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(judged(&fitted, 0), Ok(()));
    assert_eq!(judged(&fitted, 1), Err("channel 1 is to judge, the model has 1, numbered from 0".into()));
    let short = Observation { time: fitted.time[1..].to_vec(), channels: vec![fitted.channels[0][1..].to_vec()] };
    let said = judged(&short, 0).expect_err("40 responses to 39 instants");
    assert_eq!(said, "record 0: the response has 40 values of channel `flow` at 39 instants; give one for each");
    let none = Observation { channels: Vec::new(), ..fitted.clone() };
    assert!(judged(&none, 0).is_err_and(|said| said.starts_with("record 0: 0 series are observed, ")));
    let empty = Observation { channels: vec![vec![f64::NAN; ROWS]], ..fitted.clone() };
    assert!(judged(&empty, 0).is_err_and(|said| said.starts_with("record 0: no channel has a value, ")));
}
