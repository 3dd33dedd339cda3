//! Models and observations that cannot be compared are refused before anything is computed: shapes, priors, starts, weights.

use crate::{Active, Channel, Error, ForwardModel, Observation, Omission, Parameter};

/// No observed value is of this size.
const HUGE: f64 = 1e100;

/// Response `[channel][row]`.
pub(crate) type Response = Vec<Vec<f64>>;

fn plural(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// # Errors
/// [`Error::Definition`] if the model contradicts itself.
pub(crate) fn definition(model: &dyn ForwardModel) -> Result<(), Error> {
    let problem = offset_problem(model).or_else(|| nuisance_problem(model)).or_else(|| library_problem(model));
    problem.map_or(Ok(()), |problem| Err(Error::Definition(problem)))
}

fn offset_problem(model: &dyn ForwardModel) -> Option<String> {
    if model.channels().is_empty() {
        return Some("the model has no channel; give it one, or there is nothing to compare".into());
    }
    // a standard deviation of 0 says that the offset is known, an infinite one that it may be anything
    let wrong = |(mean, sd): (f64, f64)| !mean.is_finite() || sd.is_nan() || sd < 0.0;
    let channel = model.channels().iter().find(|channel| wrong(channel.offset))?;
    let (mean, sd) = channel.offset;
    Some(format!(
        "channel `{}`: its offset has mean {mean} and sd {sd}; give a finite mean and an sd of at least 0",
        channel.name
    ))
}

fn nuisance_problem(model: &dyn ForwardModel) -> Option<String> {
    let nuisances = model.nuisances();
    nuisances.iter().find_map(|nuisance| parameter_problem(&nuisance.parameter)).or_else(|| {
        let precision = model.precision().filter(|p| p.shape() != (nuisances.len(), nuisances.len()))?;
        let (rows, columns) = precision.shape();
        let needed = plural(nuisances.len(), "nuisance");
        Some(format!("the precision has {rows} rows and {columns} columns, the model has {needed}; give one of each for each"))
    })
}

fn parameter_problem(parameter: &Parameter) -> Option<String> {
    let Parameter { name, prior, step, .. } = parameter;
    let of_step = || {
        let is_step = step.is_finite() && *step > 0.0;
        (!is_step).then(|| format!("its step for differences is {step}; it has to be finite and above 0"))
    };
    Some(format!("{name}: {}", prior.problem().or_else(of_step)?))
}

fn library_problem(model: &dyn ForwardModel) -> Option<String> {
    let library = model.mechanisms();
    let own = library.iter().find_map(|mechanism| Some(format!("{}: {}", mechanism.id, mechanism_problem(mechanism)?)));
    let twice = || {
        let again = library.iter().enumerate().find(|(n, one)| library[..*n].iter().any(|before| before.id == one.id))?.1;
        Some(format!("{}: two mechanisms have this id; give each its own", again.id))
    };
    own.or_else(twice)
        .or_else(|| library.iter().enumerate().find_map(|(number, mechanism)| stand_in_problem(model, number, mechanism)))
        .or_else(|| {
            let weightless = |named: bool| {
                let mut weights = library.iter().filter(|m| m.named == named).map(|m| m.weight).peekable();
                weights.peek().is_some() && weights.all(|weight| weight == 0.0)
            };
            let kind = [(true, "with"), (false, "without")].into_iter().find(|(named, _)| weightless(*named))?.1;
            Some(format!("the mechanisms {kind} a name all have weight 0; give one of them a weight, or leave them out"))
        })
}

fn mechanism_problem(mechanism: &Omission) -> Option<String> {
    let count = mechanism.parameters.len();
    if mechanism.choice.as_ref().is_some_and(|(_, values)| values.is_empty()) {
        return Some("nothing to choose; give its choice a value, or leave it out".into());
    }
    if !(mechanism.weight.is_finite() && mechanism.weight >= 0.0) {
        return Some(format!("its weight is {}; it has to be finite and at least 0", mechanism.weight));
    }
    if let Some(start) = mechanism.starts.iter().find(|start| start.len() != count) {
        let (found, needed) = (plural(start.len(), "value"), plural(count, "parameter"));
        return Some(format!("a start has {found}, the mechanism has {needed}; give one value for each"));
    }
    if mechanism.starts.is_empty() {
        return Some("its fit has no start; give one, with a value for each parameter".into());
    }
    mechanism.parameters.iter().find_map(parameter_problem).or_else(|| {
        let each = mechanism.starts.iter().flat_map(|start| mechanism.parameters.iter().zip(start));
        let (parameter, value) = each.into_iter().find(|(parameter, value)| !parameter.prior.allows(**value))?;
        Some(format!("{}: a start of {value} is outside its prior; give one inside", parameter.name))
    })
}

fn stand_in_problem(model: &dyn ForwardModel, number: usize, mechanism: &Omission) -> Option<String> {
    let (nuisance, count) = (model.stands_for(number)?, model.nuisances().len());
    if nuisance >= count {
        let known = plural(count, "nuisance");
        return Some(format!("{}: it stands for nuisance {nuisance}, the model has {known}, numbered from 0", mechanism.id));
    }
    let none = mechanism.parameters.is_empty();
    none.then(|| format!("{}: it stands for nuisance {nuisance} without a parameter; give it one", mechanism.id))
}

/// # Errors
/// [`Error::Data`] if the observation has not one series for each channel, or not one value for each instant, or no value at all, or one that is
/// infinite.
pub(crate) fn observed(model: &dyn ForwardModel, record: usize, observed: &Observation) -> Result<(), Error> {
    let (channels, instants) = (model.channels(), plural(observed.time.len(), "instant"));
    let refused = |problem: String| Err(Error::Data(format!("record {record}: {problem}")));
    if observed.channels.len() != channels.len() {
        let (found, needed) = (observed.channels.len(), plural(channels.len(), "channel"));
        return refused(format!("{found} series are observed, the model has {needed}; give one series for each"));
    }
    let of_other_length = |(_, series): &(&Channel, &Vec<f64>)| series.len() != observed.time.len();
    if let Some((channel, series)) = channels.iter().zip(&observed.channels).find(of_other_length) {
        let (name, found) = (&channel.name, plural(series.len(), "observed value"));
        return refused(format!("channel `{name}` has {found} at {instants}; give one for each, NaN where there is none"));
    }
    // a square has to be a number, too
    let huge = |value: &f64| !value.is_nan() && value.abs() >= HUGE;
    for (channel, series) in channels.iter().zip(&observed.channels) {
        if let Some(row) = series.iter().position(huge) {
            let (name, value) = (&channel.name, series[row]);
            return refused(format!(
                "channel `{name}` is {value} in row {row}; give a size below {HUGE:e}, NaN where there is none"
            ));
        }
    }
    if observed.channels.iter().flatten().all(|value| value.is_nan()) {
        return refused("no channel has a value, so that there is nothing to compare; leave the record out".into());
    }
    Ok(())
}

/// Structures are functions of the state: it is asked for where they are sought.
///
/// # Errors
/// [`Error::Definition`] if the state of a record has not one value for each instant.
pub(crate) fn states(model: &dyn ForwardModel, records: &[usize], observations: &[Observation]) -> Result<(), Error> {
    records.iter().zip(observations).try_for_each(|(record, observed)| state(model, *record, observed.time.len()))
}

fn state(model: &dyn ForwardModel, record: usize, rows: usize) -> Result<(), Error> {
    let state = model.state(record);
    let (level, rate) = (state.level.len(), state.rate.len());
    if level == rows && rate == rows {
        let series = [("level", &state.level), ("rate", &state.rate)];
        let unknown = series.into_iter().find_map(|(name, of)| Some((name, of.iter().position(|value| !value.is_finite())?)));
        return match unknown {
            Some((name, row)) => {
                let problem =
                    format!("record {record}: the state's {name} is not finite in row {row}; give a value in every row");
                Err(Error::Definition(problem))
            }
            None => Ok(()),
        };
    }
    let instants = plural(rows, "instant");
    let problem = format!("the state has {} and {} at {instants}", plural(level, "level"), plural(rate, "rate"));
    Err(Error::Definition(format!("record {record}: {problem}; give one of each for each")))
}

/// The model's response in a record of so many `rows`.
///
/// # Errors
/// [`Error::Model`] if the model cannot respond; [`Error::Definition`] if it responds in another shape.
pub(crate) fn responded(
    model: &dyn ForwardModel,
    record: usize,
    rows: usize,
    nuisances: &[f64],
    active: &[Active],
) -> Result<Response, Error> {
    let response = model.respond(record, nuisances, active).map_err(Error::Model)?;
    shape(model, record, rows, "the response", &response)?;
    Ok(response)
}

/// # Errors
/// [`Error::Definition`] if the response with all numbers as they are expected is not finite: there is nothing to compare with.
pub(crate) fn finite(model: &dyn ForwardModel, record: usize, response: &Response) -> Result<(), Error> {
    let row = |series: &Vec<f64>| series.iter().position(|value| !value.is_finite());
    match model.channels().iter().zip(response).find_map(|(channel, series)| Some((&channel.name, row(series)?))) {
        Some((name, row)) => Err(Error::Definition(format!(
            "record {record}: the response of channel `{name}` is not finite in row {row}, with every nuisance as expected and no mechanism; give a number for every row"
        ))),
        None => Ok(()),
    }
}

/// # Errors
/// [`Error::Definition`] if a response of the model, `what`, has not one series for each channel with one value for each of the `rows`.
pub(crate) fn shape(model: &dyn ForwardModel, record: usize, rows: usize, what: &str, response: &Response) -> Result<(), Error> {
    let (channels, instants) = (model.channels(), plural(rows, "instant"));
    let refused = |problem: String| Err(Error::Definition(format!("record {record}: {what} has {problem}")));
    if response.len() != channels.len() {
        let (found, needed) = (response.len(), plural(channels.len(), "channel"));
        return refused(format!("{found} series, the model has {needed}; give one series for each"));
    }
    match channels.iter().zip(response).find(|(_, series)| series.len() != rows) {
        Some((channel, series)) => {
            let (found, name) = (plural(series.len(), "value"), &channel.name);
            refused(format!("{found} of channel `{name}` at {instants}; give one for each"))
        }
        None => Ok(()),
    }
}
