//! What is accepted for each kind of number, in the unit of its key: wide enough for any coil, narrow enough to catch a wrong unit.

use schemars::Schema;
use serde_json::{Map, Value};

use super::InputError;
use super::fields::join;
use super::source::Source;

/// Accepted values and what to say about others.
pub(crate) struct Limit {
    least: f64,
    most: f64,
    unit: &'static str,
    example: &'static str,
}

const fn limit(least: f64, most: f64, unit: &'static str, example: &'static str) -> Limit {
    Limit { least, most, unit, example }
}

pub(crate) const FIBRE_UM: Limit = limit(0.1, 1e5, "um", "170.0");
pub(crate) const PLACE_UM: Limit = limit(-1e6, 1e6, "um", "85.0");
pub(crate) const ANGLE_DEG: Limit = limit(-360.0, 360.0, "deg", "30.0");
pub(crate) const PITCH_MM: Limit = limit(1e-3, 50.0, "mm", "0.170");
pub(crate) const LENGTH_MM: Limit = limit(1e-3, 1e5, "mm", "43.5");
pub(crate) const EXTRA_LENGTH_MM: Limit = limit(0.0, 1e5, "mm", "1.0");
pub(crate) const POSITION_MM: Limit = limit(-1e5, 1e5, "mm", "10.01");
pub(crate) const TAIL_M: Limit = limit(0.0, 1e5, "m", "0.5");
pub(crate) const MODULUS_MPA: Limit = limit(1e-6, 2e6, "MPa", "70200.0 for silica");
pub(crate) const MODULUS_GPA: Limit = limit(1e-9, 2e3, "GPa", "70.2 for silica");
pub(crate) const EXPANSION_PER_K: Limit = limit(-1e-2, 1e-2, "1/K", "0.55e-6 for silica");
pub(crate) const CONDUCTIVITY: Limit = limit(1e-6, 1e4, "W/(m K)", "1.38 for silica");
pub(crate) const DENSITY: Limit = limit(1e-9, 3e4, "kg/m3", "1400.0");
pub(crate) const SPECIFIC_HEAT: Limit = limit(1.0, 1e5, "J/(kg K)", "1300.0");
pub(crate) const RATIO: Limit = limit(-10.0, 10.0, "", "0.392");
pub(crate) const LAG_S: Limit = limit(0.0, 1e6, "s", "20.0");
pub(crate) const RESISTANCE: Limit = limit(0.0, 1e2, "m2 K/W", "1e-4");
pub(crate) const CONDUCTANCE: Limit = limit(1e-6, 1e6, "W/(m2 K)", "50.0");
pub(crate) const FACTOR: Limit = limit(1e-3, 1e3, "", "1.5");
pub(crate) const SHARE: Limit = limit(1e-6, 0.999, "", "0.3");
pub(crate) const TIME_S: Limit = limit(1e-3, 1e9, "s", "1800.0");
pub(crate) const TEMPERATURE_C: Limit = limit(-273.15, 1000.0, "degC", "-20.0");
pub(crate) const HYSTERESIS_K: Limit = limit(0.0, 1000.0, "K", "5.0");
pub(crate) const POWER_W: Limit = limit(-1e3, 1e3, "W", "0.5");
pub(crate) const CURVATURE_PER_K2: Limit = limit(-1e-4, 1e-4, "1/K2", "2e-8");
pub(crate) const DRIFT_DEG_PER_H_PER_K: Limit = limit(-1e3, 1e3, "(deg/h)/K", "0.001");
pub(crate) const INDEX: Limit = limit(1.0, 5.0, "", "1.45 for silica");
pub(crate) const PHOTOELASTIC: Limit = limit(-1.0, 1.0, "", "0.121 and 0.270 for silica");
pub(crate) const STRAIN_RATIO: Limit = limit(-10.0, 10.0, "", "0.0274");
pub(crate) const NOT_NEGATIVE: Limit = limit(0.0, f64::MAX, "", "0.01");

/// Gives the schema of a field least and most of its numbers, and the unit.
pub(crate) fn within(limit: &'static Limit) -> impl Fn(&mut Schema) {
    move |schema| {
        let object = schema.ensure_object();
        if !limit.unit.is_empty() {
            object.insert("x-unit".into(), limit.unit.into());
        }
        bound(object, limit);
    }
}

fn bound(schema: &mut Map<String, Value>, limit: &Limit) {
    let is_number = |kind: &Value| kind == "number" || kind.as_array().is_some_and(|kinds| kinds.iter().any(|k| k == "number"));
    if schema.get("type").is_some_and(is_number) {
        schema.insert("minimum".into(), limit.least.into());
        if limit.most < f64::MAX {
            schema.insert("maximum".into(), limit.most.into());
        }
    }
    let items = ["items", "prefixItems"];
    for (_, items) in schema.iter_mut().filter(|(key, _)| items.contains(&key.as_str())) {
        match items {
            Value::Array(items) => items.iter_mut().filter_map(Value::as_object_mut).for_each(|item| bound(item, limit)),
            item => item.as_object_mut().into_iter().for_each(|item| bound(item, limit)),
        }
    }
}

impl Limit {
    fn problem(&self, value: f64) -> Option<String> {
        let Self { least, most, unit, .. } = *self;
        let with_unit = |number: f64| format!("{number} {unit}").trim_end().to_owned();
        if !value.is_finite() {
            Some(format!("{value} is not a finite number"))
        } else if least > 0.0 && value <= 0.0 {
            Some(format!("{value} is not greater than 0"))
        } else if least == 0.0 && value < 0.0 {
            Some(format!("{value} is negative"))
        } else if value < least {
            Some(format!("{} is less than {}, the least accepted", with_unit(value), with_unit(least)))
        } else if value > most {
            Some(format!("{} is more than {}, the most accepted", with_unit(value), with_unit(most)))
        } else {
            None
        }
    }
}

/// A group of fields in a file, whose values are checked one by one.
#[derive(Clone)]
pub(crate) struct Group<'a> {
    source: &'a Source,
    path: String,
}

impl<'a> Group<'a> {
    pub(crate) fn whole(source: &'a Source) -> Self {
        Self { source, path: String::new() }
    }

    pub(crate) fn group(&self, name: &str) -> Self {
        Self { source: self.source, path: join(&self.path, name) }
    }

    /// The value, if `limit` accepts it.
    pub(crate) fn number(&self, name: &str, value: f64, limit: &Limit) -> Result<f64, InputError> {
        let Some(problem) = limit.problem(value) else { return Ok(value) };
        let unit = if limit.unit.is_empty() { String::new() } else { format!(" in {}", limit.unit) };
        Err(self.fault(name, problem, format!("give the value{unit}, e.g. {}", limit.example)))
    }

    /// The count, if it is between 1 and `most`.
    pub(crate) fn count(&self, name: &str, value: usize, most: usize) -> Result<usize, InputError> {
        match value {
            0 => Err(self.fault(name, "0 is not a count", "give at least 1")),
            _ if value > most => Err(self.fault(name, format!("{value} is more than {most}"), "give the count of one coil")),
            _ => Ok(value),
        }
    }

    pub(crate) fn fault(&self, name: &str, problem: impl Into<String>, remedy: impl Into<String>) -> InputError {
        self.source.fault(&join(&self.path, name), problem, remedy)
    }

    /// The result of a material law, with its complaint at the field it names.
    pub(crate) fn law<T>(&self, law: Result<T, fem_core::Error>) -> Result<T, InputError> {
        law.map_err(|error| match error {
            fem_core::Error::Material { field, value, range } => {
                let remedy = match field {
                    "poisson_ratio" => "give the measured value to all its digits, e.g. 0.4998",
                    "nu_r" => "give nu_r to more digits, or check e_r, e_z and nu_zr",
                    _ => "check the material's data",
                };
                self.fault(field, format!("{value} is not {range}"), remedy)
            }
            other => self.fault("", other.to_string(), "check the material's data"),
        })
    }
}
