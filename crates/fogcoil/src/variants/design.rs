//! The design at a point of the unit cube.

use std::path::Path;

use coil::{Design, Number, Tolerances};
use nalgebra::{DMatrix, DVector};

use super::factor::{Factor, Kind, without_negative_tails};
use super::follow::Dimensions;
use super::value::Value;
use super::varied::{Varied, normal};
use crate::FileError;
use crate::input::{CoilCase, Fingerprint, check_variant, field_text, read_coil_with_text, with_fields};
use files::{Note, Remark};

/// A drawing, with the text of its file.
pub struct Drawing {
    /// The drawing.
    pub case: CoilCase,
    text: String,
}

impl Drawing {
    /// Reads and checks a coil file.
    ///
    /// # Errors
    /// As [`read_coil`](crate::input::read_coil).
    pub fn read(path: &Path) -> Result<Self, FileError> {
        let (case, text) = read_coil_with_text(path)?;
        Ok(Self { case, text })
    }
}

/// Variations of a drawing.
pub struct Variants {
    /// The drawing.
    pub case: CoilCase,
    /// The varied factors, each with a coordinate.
    pub factors: Vec<Factor>,
    /// Whether the body follows the winding.
    pub dimensions: Dimensions,
    /// Files of cells that choices name.
    pub cells: Vec<Fingerprint>,
    text: String,
    /// Lower triangle that gives the numbers within their tolerances their correlations.
    mixing: DMatrix<f64>,
}

/// One design.
#[derive(Debug, Clone)]
pub struct Variant {
    /// The design.
    pub design: Design,
    /// Value of each factor in it, in the unit of its key; `None` where the design has no such number.
    pub values: Vec<Option<Value>>,
}

impl Variants {
    /// Variations of a drawing.
    pub fn new(Drawing { case, text }: Drawing, factors: Vec<Factor>, dimensions: Dimensions) -> Self {
        let mixing = mixing(&factors, &case.tolerances);
        Self { case, factors, dimensions, cells: Vec::new(), text, mixing }
    }

    /// A design made of the drawing, with the drawing's text.
    #[cfg(not(target_family = "wasm"))]
    pub(crate) fn drawing_of(&self, case: CoilCase) -> Drawing {
        Drawing { case, text: self.text.clone() }
    }

    /// The design at a point of the unit cube.
    ///
    /// # Errors
    /// Message that says why there is no such design.
    pub fn at(&self, point: &[f64]) -> Result<Variant, String> {
        let written: Vec<(usize, Value)> = self.keys().map(|(n, varied)| (n, varied.at(point[n]))).collect();
        let mut design = self.with(&written)?;
        let deviations = self.deviations(point);
        for (factor, deviation) in self.numbers().zip(deviations.iter()) {
            factor.deviate(&mut design, &self.case.tolerances, *deviation);
        }
        without_negative_tails(&mut design);
        let mut values: Vec<Option<Value>> = self.factors.iter().map(|factor| factor.value(&design)).collect();
        written.into_iter().for_each(|(n, value)| values[n] = Some(value));
        Ok(Variant { design, values })
    }

    /// Values that the plan itself gives at a point, also for a design that cannot be.
    pub fn values(&self, point: &[f64]) -> Vec<Option<Value>> {
        let mut values = vec![None; self.factors.len()];
        self.keys().for_each(|(n, varied)| values[n] = Some(varied.at(point[n])));
        values
    }

    /// The drawing with one of the factors at its middle; any value of a factor that is none.
    ///
    /// # Errors
    /// Message that says why there is no such design.
    pub(super) fn alone(&self, factor: &Factor) -> Result<Design, String> {
        let own = self.keys().find(|(n, _)| self.factors[*n] == *factor);
        self.with(&own.map(|(n, varied)| (n, varied.at(0.5))).into_iter().collect::<Vec<_>>())
    }

    /// The drawing with some of its keys written anew: places of factors, and their values.
    ///
    /// # Errors
    /// Message that says why there is no such design.
    pub fn with(&self, written: &[(usize, Value)]) -> Result<Design, String> {
        if written.is_empty() {
            return Ok(self.case.design.clone());
        }
        self.case_with(written).map(|case| case.design)
    }

    /// Files of cells that choices name beside the drawing's, and warnings of such cells that the drawing has not: each once.
    pub(super) fn cells_of_choices(&self) -> (Vec<Fingerprint>, Vec<Note>) {
        let (mut files, mut warnings) = (Vec::new(), Vec::new());
        for (n, varied) in self.keys().filter(|(n, _)| self.factors[*n].is_choice()) {
            let values = varied.middles().map(|u| varied.at(u));
            for value in values.filter(|value| value.ron().contains("FromCell")) {
                // a choice that no design can have says so in its rows
                let Ok(case) = self.case_with(&[(n, value)]) else { continue };
                // the first is the coil's own text
                add_new(&mut files, case.fingerprints.into_iter().skip(1), &self.case.fingerprints);
                let of_cells =
                    |note: &Note| matches!(note.remark, Remark::OtherCell | Remark::OtherPitch | Remark::AnisotropicCell);
                add_new(&mut warnings, case.warnings.into_iter().filter(of_cells), &self.case.warnings);
            }
        }
        (files, warnings)
    }

    /// The drawing's own coordinate of each factor that the plan states; `None` where the plan does not let it be as drawn.
    pub fn drawn(&self) -> Vec<Option<f64>> {
        let mut drawn = vec![None; self.factors.len()];
        for (n, varied) in self.keys() {
            drawn[n] = if varied.count().is_some() {
                let as_drawn = |u: &f64| self.with(&[(n, varied.at(*u))]).is_ok_and(|design| design == self.case.design);
                varied.middles().find(as_drawn)
            } else {
                let of_key = |key: &str| {
                    let text = field_text(&self.case.file, &self.text, key).ok()?;
                    let inner = text.strip_prefix("Some(").and_then(|rest| rest.strip_suffix(')')).unwrap_or(text);
                    varied.coordinate(inner.trim().parse().ok()?)
                };
                let all: Option<Vec<f64>> = self.factors[n].keys().map(of_key).collect();
                all.filter(|all| all.iter().all(|u| *u == all[0])).map(|all| all[0])
            };
        }
        drawn
    }

    fn case_with(&self, written: &[(usize, Value)]) -> Result<CoilCase, String> {
        let of = |(n, value): &(usize, Value)| {
            let text = value.ron();
            let one = move |key: &str| {
                let optional = field_text(&self.case.file, &self.text, key).is_ok_and(|text| text.starts_with("Some("));
                let text = if optional && !text.starts_with("None") { format!("Some({text})") } else { text.clone() };
                (key.to_owned(), text)
            };
            self.factors[*n].keys().map(one).collect::<Vec<_>>()
        };
        let edits: Vec<(String, String)> = written.iter().flat_map(of).collect();
        let room = self.dimensions.room(&self.case, &edits);
        let file = &self.case.file;
        let text = with_fields(file, &self.text, &[&edits[..], &room].concat()).map_err(|error| error.to_string())?;
        let mut case = check_variant(file, &text).map_err(|error| error.to_string())?;
        self.dimensions.follow(&self.case, &edits, &mut case);
        Ok(case)
    }

    fn keys(&self) -> impl Iterator<Item = (usize, &Varied)> {
        self.factors.iter().enumerate().filter_map(|(n, factor)| match &factor.kind {
            Kind::Key(varied) => Some((n, varied)),
            Kind::Tolerance(_) => None,
        })
    }

    fn numbers(&self) -> impl Iterator<Item = &Factor> {
        self.factors.iter().filter(|factor| matches!(factor.kind, Kind::Tolerance(_)))
    }

    /// Deviations of the numbers within their tolerances, in standard deviations.
    fn deviations(&self, point: &[f64]) -> DVector<f64> {
        let of = |(factor, u): (&Factor, &f64)| matches!(factor.kind, Kind::Tolerance(_)).then(|| normal(*u));
        let independent: Vec<f64> = self.factors.iter().zip(point).filter_map(of).collect();
        &self.mixing * DVector::from_vec(independent)
    }
}

/// Adds those that are in neither list.
fn add_new<T: PartialEq>(all: &mut Vec<T>, more: impl Iterator<Item = T>, known: &[T]) {
    for one in more {
        if !known.contains(&one) && !all.contains(&one) {
            all.push(one);
        }
    }
}

/// The Cholesky factor of the correlations of those factors that are numbers within their tolerances.
fn mixing(factors: &[Factor], tolerances: &Tolerances) -> DMatrix<f64> {
    let numbers: Vec<Number> = factors.iter().filter_map(Factor::number).collect();
    let mut correlation = tolerances.correlation(&numbers);
    // both tails are one number of a file, and deviate each by itself
    for (i, j) in (0..numbers.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        if numbers[i] == numbers[j] {
            (correlation[(i, j)], correlation[(j, i)]) = (0.0, 0.0);
        }
    }
    // a file's correlations are positive definite, and so is any part of them
    correlation.cholesky().map_or_else(|| DMatrix::identity(numbers.len(), numbers.len()), |factor| factor.l())
}
