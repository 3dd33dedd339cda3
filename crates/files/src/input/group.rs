//! Place in a file of a value that is checked against others.

use super::InputError;
use super::fields::join;
use super::quantity::Quantity;
use super::source::Source;

/// A group of fields in a file, whose complaints know their place.
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

    /// The elements of a list, each with its place.
    pub(crate) fn each<'t, T>(&self, name: &str, items: &'t [T]) -> impl Iterator<Item = (Self, &'t T)> {
        items.iter().enumerate().map(move |(i, item)| (self.group(&format!("{name}[{i}]")), item))
    }

    /// The value in SI, if its kind accepts it.
    pub(crate) fn number(&self, name: &str, value: f64, kind: &Quantity) -> Result<f64, InputError> {
        match kind.fault(value) {
            Some((problem, remedy)) => Err(self.fault(name, problem, remedy)),
            None => Ok((kind.si)(value)),
        }
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
