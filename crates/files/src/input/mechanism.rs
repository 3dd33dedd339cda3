//! Mechanisms of a user's own: `MECHANISM.ron`.

use std::path::{Path, PathBuf};

use diagnosis::{Parameter, Prior};
use laws::{State, Unit};
use mechanisms::{Target, Written};

use super::InputError;
use super::group::Group;
use super::mechanism_file::{GoesFile, LawFile, MechanismFile, ParameterFile, PriorFile};
use super::mechanism_quantities::{Quantities, Sight, expressions};
use super::mirror::Mirror;
use super::opened::open;
use super::source::{MECHANISM, Source};
use crate::shown;

/// Most parameters, columns, states and laws, each.
const MOST: usize = 8;
/// Most values from which fits of a parameter start, and most combinations of them.
const MOST_STARTS: usize = 50;
const MOST_COMBINATIONS: usize = 128;
/// Longest id.
const LONGEST_ID: usize = 40;
/// Step for differences, in standard deviations of the prior, of a parameter at which a law jumps.
const JUMPING_STEP: f64 = 0.05;

/// A mechanism's file that has been read and checked.
#[derive(Debug, Clone, PartialEq)]
pub struct MechanismCase {
    /// The file it was read from.
    pub file: PathBuf,
    /// The mechanism.
    pub mechanism: Written,
    /// Its parameters' values, as `simulate` takes them; `None` of one that has none.
    pub values: Vec<Option<f64>>,
    source: Source,
}

impl MechanismCase {
    /// Which content its file had.
    pub fn fingerprint(&self) -> super::Fingerprint {
        self.source.fingerprint()
    }

    /// Values of all parameters.
    ///
    /// # Errors
    /// The parameter that has none.
    pub fn at(&self) -> Result<Vec<f64>, InputError> {
        let missing = |k: usize| {
            let remedy = "give it, e.g. value: Some(0.1), or take the file that `fogcoil diagnose --model-out` writes".to_owned();
            self.source.fault(&format!("parameters[{k}]"), "the parameter has no value", remedy)
        };
        self.values.iter().enumerate().map(|(k, value)| value.ok_or_else(|| missing(k))).collect()
    }

    /// A complaint about one of its laws.
    pub fn law_fault(&self, law: usize, problem: String, remedy: &str) -> InputError {
        self.source.fault(&format!("laws[{law}]"), problem, remedy)
    }

    /// The file's text with values of the parameters put in.
    ///
    /// # Errors
    /// If a value cannot be written.
    pub fn with_values(&self, values: &[f64]) -> Result<String, InputError> {
        let mut file: MechanismFile = self.source.parse(Some(&MECHANISM))?;
        file.parameters.iter_mut().zip(values).for_each(|(parameter, value)| parameter.value = Some(*value));
        let pretty = ron::ser::PrettyConfig::new().struct_names(false);
        ron::ser::to_string_pretty(&file, pretty)
            .map(|text| text + "\n")
            .map_err(|error| InputError::whole(&self.file, error.to_string(), ""))
    }
}

/// Reads and checks a mechanism's file.
///
/// # Errors
/// The fault, in which file, line and field, and how to mend it.
pub fn read_mechanism(path: &Path) -> Result<MechanismCase, InputError> {
    checked(open(path)?)
}

/// Checks a mechanism that is not in a file, with the content of one; messages call it `path`.
///
/// # Errors
/// As [`read_mechanism`].
pub fn check_mechanism(path: &Path, text: String) -> Result<MechanismCase, InputError> {
    checked(Source::of(path, text))
}

fn checked(source: Source) -> Result<MechanismCase, InputError> {
    let file: MechanismFile = source.parse(Some(&MECHANISM))?;
    let top = Group::whole(&source);
    check_id(&top, &file.id)?;
    for (field, count, least) in [
        ("parameters", file.parameters.len(), 1),
        ("columns", file.columns.len(), 0),
        ("states", file.states.len(), 0),
        ("laws", file.laws.len(), 1),
    ] {
        if !(least..=MOST).contains(&count) {
            return Err(top.fault(field, format!("{count} are given"), format!("give {least} to {MOST}")));
        }
    }
    let quantities = Quantities::of(&top, &file)?;
    let states = file
        .states
        .iter()
        .enumerate()
        .map(|(k, state)| quantities.state(&top.group(&format!("states[{k}].goes")), k, &state.goes));
    let states = states.collect::<Result<Vec<_>, _>>()?;
    let (mut targets, mut written) = (Vec::new(), Vec::new());
    for (k, law) in file.laws.iter().enumerate() {
        let (target, text) = target(law);
        let unit = Unit::parse(target.unit()).unwrap_or(Unit::ONE);
        written.push(quantities.expression(&top, &format!("laws[{k}]"), text, unit, Sight::All)?);
        targets.push(target);
    }
    quantities.check_used(&top, &file, &states, &written)?;
    let mut parameters = Vec::new();
    for (here, parameter) in top.each("parameters", &file.parameters) {
        let prior = prior(&here, parameter.prior)?;
        check_starts(&here, parameter, prior)?;
        let own = Parameter::new(reported(&parameter.name, &parameter.unit), prior);
        let k = parameters.len();
        let plays = |state: &State| matches!(state, State::Play { width, .. } if width.has(k));
        // what heat has to carry follows the instant of a jump smoothly
        let at_once = written.iter().zip(&targets).filter(|(_, target)| !target.is_carried_by_heat()).map(|(law, _)| law);
        let jumps = at_once.chain(states.iter().flat_map(expressions)).any(|expression| expression.jumps(k));
        // where a small step changes nothing, or all at once, a larger one tells the slope
        parameters.push(if jumps || states.iter().any(plays) { own.with_step(JUMPING_STEP) } else { own });
    }
    let starts = starts(&top, &file.parameters, &parameters)?;
    let (system, inputs) = quantities.system(states, written);
    let equation = equation(&file);
    let MechanismFile { id, title, stage, meaning, signature, inspection, source: literature, .. } = file;
    let or = |text: String, other: &str| if text.is_empty() { other.to_owned() } else { text };
    let mechanism = Written {
        meaning: or(meaning, &title),
        inspection: or(inspection, "change what its law depends on, and nothing else"),
        signature,
        source: literature,
        stage: stage.model(),
        id,
        title,
        equation,
        parameters,
        starts,
        inputs,
        system,
        targets,
    };
    let values = file.parameters.iter().map(|parameter| parameter.value).collect();
    Ok(MechanismCase { file: source.path().to_owned(), mechanism, values, source })
}

fn check_id(top: &Group, id: &str) -> Result<(), InputError> {
    let kebab = id.split('-').all(|word| !word.is_empty() && word.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit()));
    if !kebab || id.len() > LONGEST_ID {
        let problem = format!("`{}` is no id", id.escape_debug().take(LONGEST_ID).collect::<String>());
        return Err(top.fault(
            "id",
            problem,
            format!("take up to {LONGEST_ID} small letters, digits and hyphens, e.g. slow-board"),
        ));
    }
    if ["nominal", "recalibrate", "unknown", "none"].contains(&id) || mechanisms::find(id).is_some() {
        return Err(top.fault(
            "id",
            format!("`{id}` is taken by the program itself"),
            "take another; `fogcoil explain` lists those that are known",
        ));
    }
    Ok(())
}

fn target(law: &LawFile) -> (Target, &str) {
    match law {
        LawFile::Rate(text) => (Target::Rate, text),
        LawFile::Thermometer(text) => (Target::Thermometer, text),
        LawFile::Chamber(text) => (Target::Chamber, text),
        LawFile::FlangePower(text) => (Target::FlangePower, text),
        LawFile::Stiffness(text) => (Target::Stiffness, text),
        LawFile::Expansion(text) => (Target::Expansion, text),
        LawFile::OpenBond(text) => (Target::OpenBond, text),
        LawFile::Tail(text) => (Target::Tail, text),
        LawFile::Shupe(text) => (Target::Shupe, text),
        LawFile::Axial(text) => (Target::Axial, text),
        LawFile::Radial(text) => (Target::Radial, text),
        LawFile::Bias(text) => (Target::Bias, text),
    }
}

fn prior(here: &Group, file: PriorFile) -> Result<Prior, InputError> {
    let (numbers, prior, holds, remedy) = match file {
        PriorFile::Normal(mean, sd) => {
            ([mean, sd], Prior::Normal { mean, sd }, sd > 0.0, "give Normal(mean, standard deviation), the latter above 0")
        }
        PriorFile::Size(scale) => ([scale, 0.0], Prior::Size { scale }, scale > 0.0, "give Size(scale), above 0"),
        PriorFile::LogNormal(median, spread) => (
            [median, spread],
            Prior::LogNormal { median, spread },
            median > 0.0 && spread > 0.0,
            "give LogNormal(median, standard deviation of the logarithm), both above 0",
        ),
        PriorFile::Uniform(low, high) => {
            ([low, high], Prior::Uniform { low, high }, low < high, "give Uniform(low, high), the lower end first")
        }
    };
    // what the ends of the range that is looked at must be
    let ends = [-8.0, 8.0].map(|u| prior.value(u));
    if numbers.iter().chain(&ends).all(|number| number.is_finite()) && holds {
        return Ok(prior);
    }
    Err(here.fault("prior", format!("{} and {} are no prior", numbers[0], numbers[1]), remedy))
}

/// A parameter's name in every output: it ends in its unit.
fn reported(name: &str, unit: &str) -> String {
    let words = crate::units::suffix(unit);
    // a name that looks like a unit is set apart from its own
    let apart = if crate::units::parameter_unit(name) == "1" { "" } else { "_in" };
    match (words.as_str(), apart) {
        (own, _) if !own.is_empty() && name.ends_with(&format!("_{own}")) => name.to_owned(),
        ("", "") => name.to_owned(),
        ("", _) => format!("{name}_in_1"),
        (own, apart) => format!("{name}{apart}_{own}"),
    }
}

fn check_starts(here: &Group, parameter: &ParameterFile, prior: Prior) -> Result<(), InputError> {
    if parameter.starts.len() > MOST_STARTS {
        return Err(here.fault("starts", format!("{} are given", parameter.starts.len()), format!("give up to {MOST_STARTS}")));
    }
    let outside = |value: &f64| !value.is_finite() || !(prior.value(-8.0)..=prior.value(8.0)).contains(value);
    let given =
        parameter.starts.iter().map(|value| ("starts", value)).chain(parameter.value.iter().map(|value| ("value", value)));
    match given.into_iter().find(|(_, value)| outside(value)) {
        Some((field, value)) => {
            Err(here.fault(field, format!("{value} lies outside the prior"), "give a value that the prior allows"))
        }
        None => Ok(()),
    }
}

/// Values from which fits start: all combinations of each parameter's.
fn starts(top: &Group, files: &[ParameterFile], parameters: &[Parameter]) -> Result<Vec<Vec<f64>>, InputError> {
    let own = |(file, parameter): (&ParameterFile, &Parameter)| {
        if !file.starts.is_empty() {
            return file.starts.clone();
        }
        // away from the middle, where a size is 0 and says nothing of the others; one that is no size from three
        match parameter.prior {
            Prior::Normal { .. } | Prior::Size { .. } => vec![parameter.prior.value(0.5)],
            _ if files.len() > 1 => [-1.0, 0.0, 1.0].map(|u| parameter.prior.value(u)).to_vec(),
            _ => vec![parameter.prior.value(0.0)],
        }
    };
    let lists: Vec<Vec<f64>> = files.iter().zip(parameters).map(own).collect();
    let given: usize = files.iter().map(|file| file.starts.len().max(1)).product();
    if given > MOST_COMBINATIONS {
        return Err(top.fault(
            "parameters",
            format!("their starts make {given} combinations"),
            format!("give fewer: up to {MOST_COMBINATIONS}"),
        ));
    }
    let (mut all, mut count) = (vec![Vec::new()], given);
    for (list, file) in lists.iter().zip(files) {
        // of those that are not given, the middle where there would be too many
        let own = file.starts.is_empty() && count * list.len() > MOST_COMBINATIONS;
        let list = if own { &list[list.len() / 2..=list.len() / 2] } else { &list[..] };
        count *= if file.starts.is_empty() { list.len() } else { 1 };
        all = all.iter().flat_map(|start: &Vec<f64>| list.iter().map(|value| [start.as_slice(), &[*value]].concat())).collect();
    }
    Ok(all)
}

fn equation(file: &MechanismFile) -> String {
    let renamed = file.columns.iter().filter(|column| column.column.is_some());
    let mut lines: Vec<String> =
        renamed.map(|column| format!("{}: the column `{}` of the record", column.name, shown(column.in_record()))).collect();
    for state in &file.states {
        let name = &state.name;
        lines.push(match &state.goes {
            GoesFile::Rate { rate, first } => format!("d{name}/dt = {rate}, at first {first}"),
            GoesFile::Play { of, width } => format!("{name}: a play of {of}, {width} wide"),
            GoesFile::Highest(of) => format!("{name}: the highest {of} so far"),
            GoesFile::Lowest(of) => format!("{name}: the lowest {of} so far"),
        });
    }
    lines.extend(file.laws.iter().map(|law| {
        let (target, text) = target(law);
        format!("{} [{}]: {text}", target.place(), target.unit())
    }));
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechanisms::Input;
    use mechanisms::Mechanism;

    const SLOW: &str = r#"(
        id: "slow-board",
        title: "A board that warms up slowly",
        stage: Electronics,
        parameters: [
            (name: "size", unit: "deg/h/K", prior: Normal(0.0, 0.01)),
            (name: "tau", unit: "s", prior: LogNormal(1800.0, 1.0), value: Some(600.0)),
        ],
        columns: [(name: "supply_v", unit: "V")],
        states: [(name: "board", unit: "degC", goes: Rate(rate: "(spool - board) / tau", first: "spool"))],
        laws: [Rate("size * (spool - board) * supply_v / max(abs(supply_v), 1)")],
    )"#;

    fn read(text: &str) -> Result<MechanismCase, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("m.ron");
        std::fs::write(&path, text).expect("written");
        read_mechanism(&path).map_err(|error| error.to_string())
    }

    #[test]
    fn a_mechanism_is_read_with_what_it_sees_alone() {
        let case = read(SLOW).expect("a mechanism");
        let Written { parameters, inputs, system, starts, targets, .. } = &case.mechanism;
        assert_eq!(parameters.iter().map(|p| p.name.as_str()).collect::<Vec<_>>(), ["size_deg_per_h_per_k", "tau_s"]);
        assert_eq!(*inputs, [Input::Temperature(mechanisms::Body::Spool, 0), Input::Column("supply_v".into())]);
        assert_eq!((targets.as_slice(), starts.len(), system.states.len()), (&[Target::Rate][..], 3, 1));
        assert_eq!(case.mechanism.columns(), ["supply_v"]);
        assert_eq!(case.values, [None, Some(600.0)]);
        // a step of the spool by 1 K: the board is 1/e behind after its time constant
        let time: Vec<f64> = (0..=60).map(|n| 10.0 * f64::from(n)).collect();
        let spool = time.iter().map(|t| if *t > 0.0 { 1.0 } else { 0.0 }).collect();
        let rate = system.run(&time, &[0.5, 600.0], &[spool, vec![5.0; 61]]);
        assert!((rate[0][60] - 0.5 * (-595.0_f64 / 600.0).exp()).abs() < 2e-3, "{}", rate[0][60]);
    }

    #[test]
    fn the_instant_of_a_jump_is_stepped_by_as_much_as_shows() {
        let switched = |law: &str, unit: &str| {
            let parameters = format!(
                "(name: \"size\", unit: \"{unit}\", prior: Normal(0.0, 0.5)), (name: \"when\", unit: \"s\", prior: Uniform(0.0, 9000.0))"
            );
            let text = format!(
                "(id: \"switch\", title: \"A switch\", stage: Thermal, parameters: [{parameters}], laws: [{law}(\"size * step(time - when)\")])"
            );
            read(&text).expect("a mechanism").mechanism.parameters.iter().map(|p| p.step).collect::<Vec<_>>()
        };
        let smooth = Parameter::new("size", Prior::Normal { mean: 0.0, sd: 1.0 }).step;
        assert_eq!(switched("FlangePower", "W"), [smooth, smooth]);
        assert_eq!(switched("Rate", "deg/h"), [smooth, JUMPING_STEP]);
    }

    #[test]
    fn a_column_has_a_name_of_its_own_in_the_record() {
        let logged = SLOW.replace("name: \"supply_v\", unit", "name: \"supply_v\", column: \"Ub [V]\", unit");
        let case = read(&logged).expect("a mechanism");
        assert_eq!(case.mechanism.columns(), ["Ub [V]"]);
        assert!(
            case.mechanism.equation.starts_with("supply_v: the column `Ub [V]` of the record\n"),
            "{}",
            case.mechanism.equation
        );
        let again = case.with_values(&[0.002, 900.0]).expect("a text");
        assert_eq!(read(&again).expect("a mechanism").mechanism, case.mechanism);
        let message = read(&SLOW.replace("name: \"supply_v\"", "name: \"Ub [V]\"")).expect_err("no name");
        assert!(
            message.contains("columns[0].name: \"Ub [V]\" is no name; give its name in the file by column: \"Ub [V]\""),
            "{message}"
        );
    }

    #[test]
    fn values_are_written_and_read_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("m.ron");
        std::fs::write(&path, SLOW).expect("written");
        let case = read_mechanism(&path).expect("a mechanism");
        assert!(case.at().expect_err("no value").to_string().contains("m.ron:6: parameters[0]: the parameter has no value"));
        let text = case.with_values(&[0.002, 900.0]).expect("a text");
        std::fs::write(&path, text).expect("written");
        let again = read_mechanism(&path).expect("a mechanism");
        assert_eq!((again.at().expect("values"), &again.mechanism), (vec![0.002, 900.0], &case.mechanism));
    }

    #[test]
    fn every_mistake_is_one_message_with_line_and_remedy() {
        for (from, to, says) in [
            ("slow-board", "Slow Board", "m.ron:2: id: `Slow Board` is no id; take"),
            ("slow-board", "air-path", "id: `air-path` is taken by the program"),
            ("\"size\", unit", "\"spool\", unit", "parameters[0].name: `spool` is taken"),
            ("\"size\", unit", "\"exp\", unit", "parameters[0].name: exp is a function"),
            ("\"deg/h/K\"", "\"deg/hour\"", "m.ron:6: parameters[0].unit: `hour` is no unit here (character 5); the units are"),
            ("\"deg/h/K\"", "\"deg/h\"", "m.ron:11: laws[0]: `size * (spool - board) * supply_v / max(abs(supply_v), 1)` is in"),
            ("Normal(0.0, 0.01)", "Normal(0.0, -0.01)", "parameters[0].prior: 0 and -0.01 are no prior; give Normal"),
            (
                "Normal(0.0, 0.01)",
                "Normal(0.0)",
                "m.ron:6: parameters[0].prior: 1 value is given, which is not how many are needed; write Normal(mean, standard deviation), e.g.",
            ),
            ("LogNormal(1800.0, 1.0)", "Uniform(5.0, 5.0)", "parameters[1].prior"),
            ("LogNormal(1800.0, 1.0)", "LogNormal(1800.0, 1e9)", "parameters[1].prior"),
            ("Some(600.0)", "Some(-600.0)", "parameters[1].value: -600 lies outside"),
            (
                "(spool - board) / tau",
                "(spool - bord) / tau",
                "m.ron:10: states[0].goes.rate: `bord` is not known (character 10); the names here are",
            ),
            ("(spool - board) / tau", "(spool - board) * tau", "states[0].goes.rate"),
            ("first: \"spool\"", "first: \"board\"", "states[0].goes.first: `board` is not known"),
            ("Electronics", "Cellar", "stage: `Cellar` is not a choice here; choose"),
            ("size * (spool", "(spool", "laws[0]"),
            (
                "size * (spool",
                "size * exp(-(spool - 20)) * (spool",
                "laws[0]: `-(spool - 20)` in K, where a pure number is needed",
            ),
            ("size * (spool", "size * (spool - board) * sqrt(tau) * (spool", "is in deg/h s^0.5 K, where deg/h is needed"),
            (
                "size * (spool",
                "size / (1 - 1) * (spool",
                "m.ron:11: laws[0]: `(1 - 1)` this divides by 0 (character 8); divide by",
            ),
            ("laws: [Rate", "laws: [Torque", "`Torque` is not a choice"),
            ("title:", "titel:", "unknown field `titel`"),
        ] {
            let text = SLOW.replacen(from, to, 1);
            let message = read(&text).expect_err(to);
            assert!(message.contains(says), "{to}: {message}");
        }
        let unused = SLOW.replace(" * supply_v / max(abs(supply_v), 1)", "");
        assert!(read(&unused).expect_err("unused").contains("columns[0].name: nothing depends on `supply_v`"));
        let none = SLOW.split("laws:").next().expect("a part").to_owned() + "laws: [])";
        assert!(read(&none).expect_err("none").contains("laws: 0 are given; give 1 to 8"));
    }
}
