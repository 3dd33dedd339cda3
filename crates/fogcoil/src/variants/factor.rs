//! A varied number of a drawing: a key of its file, or a number within its tolerance.

use coil::{Design, Number, Tolerances};

use super::group::Group;
use super::value::Value;
use super::varied::Varied;
use crate::input::keyed;

/// Word between keys that are given one value.
const TOGETHER: &str = " and ";

/// Something that is varied.
#[derive(Debug, Clone, PartialEq)]
pub struct Factor {
    /// Key of a coil file, or several that are given one value: `coil.material and dehomogenization`.
    pub key: String,
    /// The group of its key.
    pub group: Group,
    /// Kind of variation.
    pub kind: Kind,
}

/// Kind of variation.
#[derive(Debug, Clone, PartialEq)]
pub enum Kind {
    /// Variation that a plan states.
    Key(Varied),
    /// Normal variation, by its tolerance.
    Tolerance(Toleranced),
}

/// A number that has a tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Toleranced {
    /// A number that a design has once.
    Number(Number),
    /// The tail of the CW half.
    CwTail,
    /// The tail of the CCW half.
    CcwTail,
}

impl Factor {
    /// Numbers of a design that deviate within its tolerances.
    pub fn within_tolerances(design: &Design, tolerances: &Tolerances) -> Vec<Self> {
        let of = |number: Number| {
            let has = tolerances.sd(number, design).is_some_and(|sd| sd > 0.0);
            let Some((key, _)) = keyed(number, design).filter(|_| has) else { return Vec::new() };
            let one = |key: String, of| Self { group: Group::of(&key), key, kind: Kind::Tolerance(of) };
            match number {
                Number::Tail => {
                    vec![one(format!("{key}.cw"), Toleranced::CwTail), one(format!("{key}.ccw"), Toleranced::CcwTail)]
                }
                _ => vec![one(key.to_owned(), Toleranced::Number(number))],
            }
        };
        Number::every().flat_map(of).collect()
    }

    /// One key, or several that are given one value; of several the group that comes last.
    pub(super) fn of_keys(key: &str, varied: &Varied) -> Self {
        let one = Self { key: key.to_owned(), group: Group::Fibre, kind: Kind::Key(varied.clone()) };
        let group = one.keys().map(Group::of).max().unwrap_or(Group::Fibre);
        Self { group, ..one }
    }

    /// Its keys, one by one.
    pub(super) fn keys(&self) -> impl Iterator<Item = &str> {
        self.key.split(TOGETHER).map(str::trim)
    }

    /// Number of values; `None` for a number between two ends.
    pub fn levels(&self) -> Option<usize> {
        match &self.kind {
            Kind::Key(varied) => varied.count(),
            Kind::Tolerance(_) => None,
        }
    }

    /// Whether it is one of several that have no order.
    pub fn is_choice(&self) -> bool {
        matches!(&self.kind, Kind::Key(Varied::OneOf(_) | Varied::Named(_)))
    }

    /// The number that deviates within its tolerance.
    pub(super) fn number(&self) -> Option<Number> {
        match self.kind {
            Kind::Key(_) => None,
            Kind::Tolerance(Toleranced::Number(number)) => Some(number),
            Kind::Tolerance(Toleranced::CwTail | Toleranced::CcwTail) => Some(Number::Tail),
        }
    }

    /// Lets the number deviate by so many standard deviations from the design's present value.
    pub(super) fn deviate(&self, design: &mut Design, tolerances: &Tolerances, deviations: f64) {
        let Kind::Tolerance(of) = self.kind else { return };
        match of {
            Toleranced::Number(number) => {
                if let Some((drawn, sd)) = number.of(design).zip(tolerances.sd(number, design)) {
                    *design = number.set(design, drawn + deviations * sd);
                }
            }
            Toleranced::CwTail => design.winding.tails.cw += deviations * tolerances.of(Number::Tail).of(0.0),
            Toleranced::CcwTail => design.winding.tails.ccw += deviations * tolerances.of(Number::Tail).of(0.0),
        }
    }

    /// Its value in a design, in the unit of its key, if it is a number within its tolerance.
    pub(super) fn value(&self, design: &Design) -> Option<Value> {
        let Kind::Tolerance(of) = self.kind else { return None };
        let value = match of {
            Toleranced::Number(number) => keyed(number, design)?.1,
            Toleranced::CwTail => design.winding.tails.cw,
            Toleranced::CcwTail => design.winding.tails.ccw,
        };
        Some(Value::Number(value))
    }
}

/// Makes both tails longer by as much, so that neither has a negative length: only their difference counts.
pub(super) fn without_negative_tails(design: &mut Design) {
    let tails = &mut design.winding.tails;
    let missing = -tails.cw.min(tails.ccw).min(0.0);
    (tails.cw, tails.ccw) = (tails.cw + missing, tails.ccw + missing);
}
