//! Expressions: numbers, names and functions of them, with their values, derivatives and units.

use crate::{Fault, Unit};
use std::ops::Range;

/// An expression in names that stand for places in a list of values.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    pub(crate) root: Term,
}

/// A part of an expression, and the bytes where it stands.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Term {
    pub(crate) node: Node,
    pub(crate) at: Range<usize>,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Node {
    Number(f64),
    /// the value at this place
    Value(usize),
    Minus(Box<Term>),
    Two(Operator, Box<[Term; 2]>),
    One(Function, Box<Term>),
}

/// Operation of two terms.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Operator {
    Sum,
    Difference,
    Product,
    Quotient,
    Power,
    Least,
    Most,
}

/// Operation of one term.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Function {
    Abs,
    Sign,
    Step,
    Exp,
    Ln,
    Sqrt,
    Sin,
    Cos,
    Tan,
    Atan,
    Tanh,
}

/// Functions of one term by their names.
pub(crate) const FUNCTIONS: [(&str, Function); 11] = [
    ("abs", Function::Abs),
    ("sign", Function::Sign),
    ("step", Function::Step),
    ("exp", Function::Exp),
    ("ln", Function::Ln),
    ("sqrt", Function::Sqrt),
    ("sin", Function::Sin),
    ("cos", Function::Cos),
    ("tan", Function::Tan),
    ("atan", Function::Atan),
    ("tanh", Function::Tanh),
];

/// Functions of two terms by their names.
pub(crate) const FUNCTIONS_OF_TWO: [(&str, Operator); 2] = [("min", Operator::Least), ("max", Operator::Most)];

/// A value with its derivative.
#[derive(Debug, Clone, Copy)]
struct Dual {
    value: f64,
    slope: f64,
}

impl Dual {
    fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    /// A function of it that has this value and this slope there; no change stays none where the function is steep.
    fn chain(self, value: f64, slope: f64) -> Self {
        Self { value, slope: if self.slope == 0.0 { 0.0 } else { slope * self.slope } }
    }
}

impl Expression {
    /// Its value, each name having the value at its place.
    ///
    /// # Panics
    /// If there are fewer values than names.
    pub fn at(&self, values: &[f64]) -> f64 {
        value(&self.root, values)
    }

    /// Its value and its derivative by the value at place `k`.
    ///
    /// # Panics
    /// As [`Self::at`].
    pub fn slope(&self, values: &[f64], k: usize) -> (f64, f64) {
        let Dual { value, slope } = dual(&self.root, values, k);
        (value, slope)
    }

    /// Whether the value at place `k` occurs in it.
    pub fn has(&self, k: usize) -> bool {
        fn within(term: &Term, k: usize) -> bool {
            match &term.node {
                Node::Number(_) => false,
                Node::Value(place) => *place == k,
                Node::Minus(term) | Node::One(_, term) => within(term, k),
                Node::Two(_, terms) => terms.iter().any(|term| within(term, k)),
            }
        }
        within(&self.root, k)
    }

    /// Whether it jumps as the value at place `k` changes: that stands within a `step` or a `sign`.
    pub fn jumps(&self, k: usize) -> bool {
        fn within(term: &Term, k: usize) -> bool {
            match &term.node {
                Node::Number(_) | Node::Value(_) => false,
                Node::One(Function::Step | Function::Sign, inner) => Expression { root: (**inner).clone() }.has(k),
                Node::Minus(term) | Node::One(_, term) => within(term, k),
                Node::Two(_, terms) => terms.iter().any(|term| within(term, k)),
            }
        }
        within(&self.root, k)
    }

    /// What stands within each `step` and `sign`: the expression jumps where one of these goes through 0. With it, whether it is on beyond 0 alone: a `sign`
    /// has a value of its own at 0, and is a switch of either kind.
    pub(crate) fn switches(&self) -> Vec<(Self, bool)> {
        fn within(term: &Term, found: &mut Vec<(Expression, bool)>) {
            if let Node::One(function @ (Function::Step | Function::Sign), inner) = &term.node {
                let kinds = if *function == Function::Sign { &[false, true][..] } else { &[false] };
                found.extend(kinds.iter().map(|beyond| (Expression { root: (**inner).clone() }, *beyond)));
            }
            match &term.node {
                Node::Number(_) | Node::Value(_) => (),
                Node::Minus(term) | Node::One(_, term) => within(term, found),
                Node::Two(_, terms) => terms.iter().for_each(|term| within(term, found)),
            }
        }
        let mut found = Vec::new();
        within(&self.root, &mut found);
        found
    }

    /// The same with every name's place moved.
    #[must_use]
    pub fn placed(&self, to: impl Fn(usize) -> usize) -> Self {
        fn moved(term: &Term, to: &dyn Fn(usize) -> usize) -> Term {
            let node = match &term.node {
                Node::Number(number) => Node::Number(*number),
                Node::Value(place) => Node::Value(to(*place)),
                Node::Minus(term) => Node::Minus(Box::new(moved(term, to))),
                Node::One(function, term) => Node::One(*function, Box::new(moved(term, to))),
                Node::Two(operator, terms) => Node::Two(*operator, Box::new([moved(&terms[0], to), moved(&terms[1], to)])),
            };
            Term { node, at: term.at.clone() }
        }
        Self { root: moved(&self.root, &to) }
    }

    /// Checks that its value is in a unit, each name's value being in the unit at its place. Numbers are in whatever unit their neighbour in a sum or
    /// a comparison has, and pure in a product.
    ///
    /// # Errors
    /// The part whose units do not go together, or the whole if it is in another unit.
    ///
    /// # Panics
    /// If there are fewer units than names.
    pub fn check_unit(&self, units: &[Unit], wanted: Unit) -> Result<(), Fault> {
        let all = &self.root;
        match measure(all, units)? {
            None => Ok(()),
            Some(unit) if unit.is(wanted) => Ok(()),
            Some(unit) => {
                let problem = format!("is in {unit}, where {wanted} is needed");
                Err(Fault::new(all.at.clone(), problem, remedy(unit, wanted)))
            }
        }
    }
}

fn remedy(found: Unit, wanted: Unit) -> String {
    if found.is_of_kind(wanted) {
        let factor = found.in_units_of(wanted);
        format!("numbers have no unit, so a factor of {factor} does not mend it: give a parameter or a column the unit that does")
    } else {
        "give a parameter the unit that makes it so".to_owned()
    }
}

fn value(term: &Term, values: &[f64]) -> f64 {
    match &term.node {
        Node::Number(number) => *number,
        Node::Value(place) => values[*place],
        Node::Minus(term) => -value(term, values),
        Node::One(function, term) => function.of(value(term, values)),
        Node::Two(operator, terms) => operator.of(value(&terms[0], values), value(&terms[1], values)),
    }
}

fn dual(term: &Term, values: &[f64], k: usize) -> Dual {
    match &term.node {
        Node::Number(number) => Dual::constant(*number),
        Node::Value(place) => Dual { value: values[*place], slope: if *place == k { 1.0 } else { 0.0 } },
        Node::Minus(term) => {
            let x = dual(term, values, k);
            x.chain(-x.value, -1.0)
        }
        Node::One(function, term) => {
            let x = dual(term, values, k);
            x.chain(function.of(x.value), function.slope(x.value))
        }
        Node::Two(operator, terms) => {
            let (a, b) = (dual(&terms[0], values, k), dual(&terms[1], values, k));
            let value = operator.of(a.value, b.value);
            let [by_a, by_b] = operator.slopes(a.value, b.value);
            Dual { value, slope: a.chain(0.0, by_a).slope + b.chain(0.0, by_b).slope }
        }
    }
}

impl Operator {
    pub(crate) fn of(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Sum => a + b,
            Self::Difference => a - b,
            Self::Product => a * b,
            Self::Quotient => a / b,
            Self::Power => a.powf(b),
            // of what is no number nothing is least or most
            Self::Least | Self::Most if a.is_nan() || b.is_nan() => f64::NAN,
            Self::Least => a.min(b),
            Self::Most => a.max(b),
        }
    }

    fn slopes(self, a: f64, b: f64) -> [f64; 2] {
        match self {
            Self::Sum => [1.0, 1.0],
            Self::Difference => [1.0, -1.0],
            Self::Product => [b, a],
            Self::Quotient => [1.0 / b, -a / (b * b)],
            Self::Power => [b * a.powf(b - 1.0), a.powf(b) * a.ln()],
            Self::Least => {
                if a <= b {
                    [1.0, 0.0]
                } else {
                    [0.0, 1.0]
                }
            }
            Self::Most => {
                if a >= b {
                    [1.0, 0.0]
                } else {
                    [0.0, 1.0]
                }
            }
        }
    }
}

impl Function {
    pub(crate) fn of(self, x: f64) -> f64 {
        match self {
            Self::Abs => x.abs(),
            Self::Sign if x == 0.0 => 0.0,
            Self::Sign => x.signum(),
            Self::Step => {
                if x.is_nan() {
                    x
                } else {
                    f64::from(u8::from(x >= 0.0))
                }
            }
            Self::Exp => x.exp(),
            Self::Ln => x.ln(),
            Self::Sqrt => x.sqrt(),
            Self::Sin => x.sin(),
            Self::Cos => x.cos(),
            Self::Tan => x.tan(),
            Self::Atan => x.atan(),
            Self::Tanh => x.tanh(),
        }
    }

    fn slope(self, x: f64) -> f64 {
        match self {
            Self::Abs => Self::Sign.of(x),
            Self::Sign | Self::Step => 0.0,
            Self::Exp => x.exp(),
            Self::Ln => 1.0 / x,
            Self::Sqrt => 0.5 / x.sqrt(),
            Self::Sin => x.cos(),
            Self::Cos => -x.sin(),
            Self::Tan => 1.0 / x.cos().powi(2),
            Self::Atan => 1.0 / (1.0 + x * x),
            Self::Tanh => 1.0 - x.tanh().powi(2),
        }
    }
}

/// The unit of a term; `None` of a number, which is in any.
fn measure(term: &Term, units: &[Unit]) -> Result<Option<Unit>, Fault> {
    match &term.node {
        Node::Number(_) => Ok(None),
        Node::Value(place) => Ok(Some(units[*place])),
        Node::Minus(term) => measure(term, units),
        Node::One(Function::Abs, term) => measure(term, units),
        Node::One(Function::Sign | Function::Step, term) => measure(term, units).map(|_| Some(Unit::ONE)),
        Node::One(Function::Sqrt, term) => Ok(measure(term, units)?.map(|unit| unit.to_the(0.5))),
        Node::One(function, term) => {
            require_pure(term, units, matches!(function, Function::Sin | Function::Cos | Function::Tan))?;
            Ok(Some(Unit::ONE))
        }
        Node::Two(operator, terms) => {
            let [a, b] = [measure(&terms[0], units)?, measure(&terms[1], units)?];
            match operator {
                Operator::Product => Ok(a.zip(b).map(|(a, b)| a.times(b)).or(a).or(b)),
                Operator::Quotient => Ok(match (a, b) {
                    (a, None) => a,
                    (a, Some(b)) => Some(a.unwrap_or(Unit::ONE).over(b)),
                }),
                Operator::Power => {
                    require_pure(&terms[1], units, false)?;
                    match (a, constant(&terms[1])) {
                        (None, _) => Ok(None),
                        (Some(unit), Some(power)) => Ok(Some(unit.to_the(power))),
                        (Some(unit), None) if unit.is(Unit::ONE) => Ok(Some(unit)),
                        (Some(unit), None) => {
                            let problem = format!("a quantity in {unit} has a power that varies");
                            Err(Fault::new(terms[0].at.clone(), problem, "divide it by a quantity in the same unit first"))
                        }
                    }
                }
                Operator::Sum | Operator::Difference | Operator::Least | Operator::Most => match (a, b) {
                    (Some(a), Some(b)) if !a.is(b) => {
                        let problem = format!("in {b}, beside a term in {a}");
                        Err(Fault::new(terms[1].at.clone(), problem, remedy(b, a)))
                    }
                    _ => Ok(a.or(b)),
                },
            }
        }
    }
}

/// Refuses a term that has a unit where a pure number belongs; radians, too, where an angle does.
fn require_pure(term: &Term, units: &[Unit], angle: bool) -> Result<(), Fault> {
    let radian = Unit::parse("rad").unwrap_or(Unit::ONE);
    match measure(term, units)? {
        Some(unit) if !(unit.is(Unit::ONE) || angle && unit.is(radian)) => {
            let problem = format!("in {unit}, where a pure number is needed");
            let remedy = if unit.is_of_kind(Unit::ONE) {
                remedy(unit, Unit::ONE)
            } else {
                "divide it by a quantity in the same unit".into()
            };
            Err(Fault::new(term.at.clone(), problem, remedy))
        }
        _ => Ok(()),
    }
}

/// The value of a term without names.
fn constant(term: &Term) -> Option<f64> {
    let within = Expression { root: term.clone() };
    let named = within.names_anything();
    (!named).then(|| within.at(&[]))
}

impl Expression {
    fn names_anything(&self) -> bool {
        fn within(term: &Term) -> bool {
            match &term.node {
                Node::Number(_) => false,
                Node::Value(_) => true,
                Node::Minus(term) | Node::One(_, term) => within(term),
                Node::Two(_, terms) => terms.iter().any(within),
            }
        }
        within(&self.root)
    }
}
