//! Quantities that a mechanism's expressions may name, with their units.

use laws::{Expression, Fault, State, System, Unit, check_name};
use mechanisms::{INPUTS, Input};

use super::InputError;
use super::group::Group;
use super::mechanism_file::{GoesFile, MechanismFile};

/// Names that an expression may have.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sight {
    Parameters,
    Record,
    All,
}

/// Names with their units: parameters, quantities of a record, states.
pub(super) struct Quantities {
    names: Vec<String>,
    units: Vec<Unit>,
    parameters: usize,
    inputs: Vec<Input>,
}

impl Quantities {
    pub(super) fn of(top: &Group, file: &MechanismFile) -> Result<Self, InputError> {
        let mut all = Self { names: Vec::new(), units: Vec::new(), parameters: file.parameters.len(), inputs: Vec::new() };
        for (here, parameter) in top.each("parameters", &file.parameters) {
            all.take(&here, &parameter.name, &parameter.unit)?;
        }
        for (name, input, unit) in INPUTS {
            all.names.push(name.to_owned());
            all.units.push(Unit::parse(unit).unwrap_or(Unit::ONE));
            all.inputs.push(input);
        }
        for (here, column) in top.each("columns", &file.columns) {
            if let (Err(fault), None) = (check_name(&column.name), &column.column) {
                let remedy = format!(
                    "give its name in the file by column: {:?}, and a name of letters, digits and _ for laws",
                    column.name
                );
                return Err(here.fault("name", fault.problem, remedy));
            }
            all.take(&here, &column.name, &column.unit)?;
            all.inputs.push(Input::Column(column.in_record().to_owned()));
        }
        for (here, state) in top.each("states", &file.states) {
            all.take(&here, &state.name, &state.unit)?;
        }
        Ok(all)
    }

    fn take(&mut self, here: &Group, name: &str, unit: &str) -> Result<(), InputError> {
        check_name(name).map_err(|fault| here.fault("name", fault.problem, fault.remedy))?;
        if self.names.iter().any(|known| known == name) || INPUTS.iter().any(|(known, ..)| *known == name) {
            return Err(here.fault("name", format!("`{name}` is taken already"), "take another name"));
        }
        let unit = Unit::parse(unit).map_err(|fault| here.fault("unit", placed(&fault, unit), fault.remedy.clone()))?;
        self.names.push(name.to_owned());
        self.units.push(unit);
        Ok(())
    }

    pub(super) fn expression(
        &self,
        here: &Group,
        field: &str,
        text: &str,
        unit: Unit,
        sight: Sight,
    ) -> Result<Expression, InputError> {
        let seen = match sight {
            Sight::Parameters => self.parameters,
            Sight::Record => self.parameters + self.inputs.len(),
            Sight::All => self.names.len(),
        };
        let names: Vec<&str> = self.names[..seen].iter().map(String::as_str).collect();
        let parsed = Expression::parse(text, &names).and_then(|law| law.check_unit(&self.units, unit).map(|()| law));
        parsed.map_err(|fault| here.fault(field, placed(&fault, text), fault.remedy.clone()))
    }

    pub(super) fn state(&self, here: &Group, number: usize, goes: &GoesFile) -> Result<State, InputError> {
        let unit = self.units[self.parameters + self.inputs.len() + number];
        let per_second = unit.over(Unit::parse("s").unwrap_or(Unit::ONE));
        let of = |field: &str, text: &str, unit: Unit, sight: Sight| self.expression(here, field, text, unit, sight);
        Ok(match goes {
            GoesFile::Rate { rate, first } => {
                State::Rate { rate: of("rate", rate, per_second, Sight::All)?, first: of("first", first, unit, Sight::Record)? }
            }
            GoesFile::Play { of: followed, width } => {
                State::Play { of: of("of", followed, unit, Sight::Record)?, width: of("width", width, unit, Sight::Parameters)? }
            }
            GoesFile::Highest(text) => State::Highest(of("", text, unit, Sight::Record)?),
            GoesFile::Lowest(text) => State::Lowest(of("", text, unit, Sight::Record)?),
        })
    }

    /// Refuses a parameter, a column or a state that nothing depends on.
    pub(super) fn check_used(
        &self,
        top: &Group,
        file: &MechanismFile,
        states: &[State],
        laws: &[Expression],
    ) -> Result<(), InputError> {
        let used = |k: usize| laws.iter().chain(states.iter().flat_map(expressions)).any(|expression| expression.has(k));
        let seen = INPUTS.len();
        let columns = self.parameters + seen;
        let states = columns + file.columns.len();
        for (field, first, count) in
            [("parameters", 0, self.parameters), ("columns", columns, file.columns.len()), ("states", states, file.states.len())]
        {
            if let Some(k) = (0..count).find(|k| !used(first + k)) {
                let problem = format!("nothing depends on `{}`", self.names[first + k]);
                return Err(top.fault(&format!("{field}[{k}].name"), problem, "name it in a state or a law, or remove it"));
            }
        }
        Ok(())
    }

    /// The laws in the quantities of a record alone.
    pub(super) fn system(&self, states: Vec<State>, laws: Vec<Expression>) -> (System, Vec<Input>) {
        let used = |k: &usize| {
            let place = self.parameters + k;
            laws.iter().chain(states.iter().flat_map(expressions)).any(|expression| expression.has(place))
        };
        let kept: Vec<usize> = (0..self.inputs.len()).filter(used).collect();
        let after = self.parameters + self.inputs.len();
        let places: Vec<usize> =
            (0..self.parameters).chain(kept.iter().map(|k| self.parameters + k)).chain(after..self.names.len()).collect();
        let moved = |expression: &Expression| expression.placed(|old| places.iter().position(|kept| *kept == old).unwrap_or(0));
        let states = states
            .iter()
            .map(|state| match state {
                State::Rate { rate, first } => State::Rate { rate: moved(rate), first: moved(first) },
                State::Play { of, width } => State::Play { of: moved(of), width: moved(width) },
                State::Highest(of) => State::Highest(moved(of)),
                State::Lowest(of) => State::Lowest(moved(of)),
            })
            .collect();
        let laws = laws.iter().map(moved).collect();
        let inputs: Vec<Input> = kept.into_iter().map(|k| self.inputs[k].clone()).collect();
        (System { parameters: self.parameters, inputs: inputs.len(), states, laws }, inputs)
    }
}

/// Of a state.
pub(super) fn expressions(state: &State) -> Vec<&Expression> {
    match state {
        State::Rate { rate, first } => vec![rate, first],
        State::Play { of, width } => vec![of, width],
        State::Highest(of) | State::Lowest(of) => vec![of],
    }
}

/// A fault with the part of the text that it concerns.
fn placed(fault: &Fault, text: &str) -> String {
    let part = text.get(fault.at.clone()).unwrap_or("");
    let character = text.get(..fault.at.start).map_or(0, |before| before.chars().count()) + 1;
    if part.is_empty() || fault.problem.contains(part) {
        format!("{} (character {character})", fault.problem)
    } else {
        format!("`{}` {} (character {character})", part.escape_debug(), fault.problem)
    }
}
