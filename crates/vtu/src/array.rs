//! Named values at points or cells.

use std::io::{self, Write};

/// Values at the points, or in the cells, of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Its name, with the unit.
    pub name: String,
    /// Names of the components of a vector or tensor; none of a scalar.
    pub components: Vec<&'static str>,
    /// The values, component fastest.
    pub values: Values,
}

/// Numbers of an [`Array`].
#[derive(Debug, Clone, PartialEq)]
pub enum Values {
    /// Real numbers.
    Real(Vec<f64>),
    /// Whole numbers, e.g. of parts.
    Whole(Vec<i32>),
}

impl Array {
    /// One real number a place.
    pub fn scalar(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), components: Vec::new(), values: Values::Real(values) }
    }

    /// As many real numbers a place as there are names of components: a vector has three, a symmetric tensor six, in the order xx, yy, zz,
    /// xy, yz, xz of ParaView. Of two components it makes three, the third of them 0: viewers take no shorter vector.
    pub fn components(name: impl Into<String>, components: &[&'static str], values: Vec<f64>) -> Self {
        let (mut components, mut values) = (components.to_vec(), values);
        if components.len() == 2 && values.len().is_multiple_of(2) {
            values = values.chunks(2).flat_map(|pair| [pair[0], pair[1], 0.0]).collect();
            components.push("0");
        }
        Self { name: name.into(), components, values: Values::Real(values) }
    }

    /// One whole number a place.
    pub fn whole(name: impl Into<String>, values: Vec<i32>) -> Self {
        Self { name: name.into(), components: Vec::new(), values: Values::Whole(values) }
    }

    /// Number of places, if the values fill them all.
    pub(crate) fn places(&self) -> Option<usize> {
        let values = match &self.values {
            Values::Real(values) => values.len(),
            Values::Whole(values) => values.len(),
        };
        let width = self.components.len().max(1);
        values.is_multiple_of(width).then_some(values / width)
    }

    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let named: String = self.components.iter().enumerate().map(|(i, c)| format!(" ComponentName{i}=\"{c}\"")).collect();
        let count = self.components.len().max(1);
        let name = format!("Name=\"{}\" NumberOfComponents=\"{count}\"{named}", escaped(&self.name));
        match &self.values {
            Values::Real(values) => written(out, "Float64", &name, values.chunks(count), |v| format!("{v:.7e}")),
            Values::Whole(values) => written(out, "Int32", &name, values.chunks(count), i32::to_string),
        }
    }
}

/// A `DataArray` with a line for each place.
pub(crate) fn written<'a, T: 'a>(
    out: &mut dyn Write,
    kind: &str,
    attributes: &str,
    places: impl Iterator<Item = &'a [T]>,
    text: impl Fn(&T) -> String,
) -> io::Result<()> {
    writeln!(out, "<DataArray type=\"{kind}\" {attributes} format=\"ascii\">")?;
    for values in places {
        let line: Vec<String> = values.iter().map(&text).collect();
        writeln!(out, "{}", line.join(" "))?;
    }
    writeln!(out, "</DataArray>")
}

/// Text as an attribute of XML holds it.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;")
}
