//! Parser of a text into an expression.

use crate::Fault;
use crate::expression::{Expression, FUNCTIONS, FUNCTIONS_OF_TWO, Node, Operator, Term};
use pest::Parser;
use pest::error::{ErrorVariant, InputLocation};
use pest::iterators::Pair;
use pest::pratt_parser::{Assoc, Op, PrattParser};
use pest_derive::Parser;
use std::ops::Range;
use std::sync::LazyLock;

#[derive(Parser)]
#[grammar = "grammar.pest"]
struct Grammar;

/// Longest expression that is read, bytes, and its deepest brackets.
const LONGEST: usize = 1000;
const DEEPEST: usize = 40;
/// Names that stand for numbers.
const CONSTANTS: [(&str, f64); 1] = [("pi", std::f64::consts::PI)];

/// Least binding first. A sign binds less than a power: −x² is −(x²).
static PRECEDENCE: LazyLock<PrattParser<Rule>> = LazyLock::new(|| {
    PrattParser::new()
        .op(Op::infix(Rule::add, Assoc::Left) | Op::infix(Rule::subtract, Assoc::Left))
        .op(Op::infix(Rule::multiply, Assoc::Left) | Op::infix(Rule::divide, Assoc::Left))
        .op(Op::prefix(Rule::minus) | Op::prefix(Rule::plus))
        .op(Op::infix(Rule::power, Assoc::Right))
});

impl Expression {
    /// An expression in some names, each standing for the value at its place among them.
    ///
    /// It has numbers, `+ - * / ^`, brackets, `pi`, and the functions abs, sign, step (1 from 0 on, 0 below), exp, ln, sqrt, sin, cos, tan, atan, tanh,
    /// min and max. It cannot loop, and has no effect but its value.
    ///
    /// # Errors
    /// The name that is not known, the sign that does not belong there, or numbers that have no finite value, such as 1 / 0.
    pub fn parse(text: &str, names: &[&str]) -> Result<Self, Fault> {
        if text.len() > LONGEST {
            let remedy = "divide it: a state or another law may hold a part";
            return Err(Fault::new(0..0, format!("the expression is longer than {LONGEST} characters"), remedy));
        }
        check_depth(text)?;
        let whole = Grammar::parse(Rule::whole, text).map_err(|error| misread(text, &error))?;
        let reader = Names { names };
        let Some(sum) = whole.into_iter().find(|pair| pair.as_rule() == Rule::sum) else {
            return Err(Fault::new(0..text.len(), "there is no expression", "write one, e.g. size * spool_rate"));
        };
        let root = reader.sum(sum)?;
        root.check_constants()?;
        Ok(Self { root })
    }
}

/// Whether a text can be a name in an expression.
///
/// # Errors
/// The fault.
pub fn check_name(name: &str) -> Result<(), Fault> {
    let fault = |problem: String| Err(Fault::new(0..name.len(), problem, "take letters, digits and _, e.g. size or tau_slow"));
    let taken = FUNCTIONS.iter().map(|f| f.0).chain(FUNCTIONS_OF_TWO.iter().map(|f| f.0)).chain(CONSTANTS.iter().map(|c| c.0));
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    if !starts || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_') || name.len() > 64 {
        return fault(format!("{name:?} is no name"));
    }
    if taken.into_iter().any(|known| known == name) {
        return fault(format!("{name} is a function or a constant already"));
    }
    Ok(())
}

/// The reader goes down with every bracket.
fn check_depth(text: &str) -> Result<(), Fault> {
    let mut depth = 0_usize;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > DEEPEST {
            return Err(Fault::new(at..at + 1, format!("more than {DEEPEST} brackets are nested"), "write it flatter"));
        }
    }
    Ok(())
}

fn misread(text: &str, error: &pest::error::Error<Rule>) -> Fault {
    let at = match error.location {
        InputLocation::Pos(at) => at..at,
        InputLocation::Span((start, end)) => start..end,
    };
    let wanted: &[Rule] = match &error.variant {
        ErrorVariant::ParsingError { positives, .. } => positives,
        ErrorVariant::CustomError { .. } => &[],
    };
    let rest = text[at.start..].chars().next();
    let here = rest.map_or_else(|| "at the end".to_owned(), |c| format!("at `{}`", c.escape_debug()));
    let operand = wanted.iter().any(|rule| {
        matches!(rule, Rule::number | Rule::name | Rule::sum | Rule::call | Rule::group | Rule::operand | Rule::minus)
    });
    let remedy = "write products with *, powers with ^, decimals with a point";
    let word: String = text[at.start..].chars().take_while(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '.')).collect();
    if operand && word.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        return Fault::new(at.start..at.start + word.len(), format!("`{word}` is no number"), remedy);
    }
    let needed = if operand { "a number, a name or a bracket" } else { "an operator + - * / ^ or a closing bracket" };
    Fault::new(at, format!("{here} {needed} is needed"), remedy)
}

struct Names<'a> {
    names: &'a [&'a str],
}

impl Names<'_> {
    fn sum(&self, pair: Pair<Rule>) -> Result<Term, Fault> {
        let span = |pair: &Pair<Rule>| pair.as_span().start()..pair.as_span().end();
        PRECEDENCE
            .map_primary(|pair| self.operand(pair))
            .map_prefix(|sign, term| {
                let (term, from) = (term?, span(&sign).start);
                let at = from..term.at.end;
                Ok(if sign.as_rule() == Rule::minus { Term { node: Node::Minus(Box::new(term)), at } } else { term })
            })
            .map_infix(|a, sign, b| {
                let (a, b) = (a?, b?);
                let operator = match sign.as_rule() {
                    Rule::add => Operator::Sum,
                    Rule::subtract => Operator::Difference,
                    Rule::multiply => Operator::Product,
                    Rule::divide => Operator::Quotient,
                    _ => Operator::Power,
                };
                Ok(two(operator, a, b))
            })
            .parse(pair.into_inner())
    }

    fn operand(&self, pair: Pair<Rule>) -> Result<Term, Fault> {
        let at = pair.as_span().start()..pair.as_span().end();
        match pair.as_rule() {
            Rule::number => {
                let number: Option<f64> = pair.as_str().parse().ok().filter(|number: &f64| number.is_finite());
                let number = number.ok_or_else(|| Fault::new(at.clone(), "the number is too large", "write it like 1.5e-6"))?;
                Ok(Term { node: Node::Number(number), at })
            }
            Rule::name => self.named(pair.as_str(), at),
            Rule::call => self.called(pair, at),
            // with its brackets: what is quoted of a text has both
            _ => match pair.into_inner().next() {
                Some(sum) => self.sum(sum).map(|term| Term { at, ..term }),
                None => Err(Fault::new(at, "there is nothing between these brackets", "write an expression there")),
            },
        }
    }

    fn named(&self, name: &str, at: Range<usize>) -> Result<Term, Fault> {
        if let Some((_, number)) = CONSTANTS.iter().find(|(known, _)| *known == name) {
            return Ok(Term { node: Node::Number(*number), at });
        }
        match self.names.iter().position(|known| *known == name) {
            Some(place) => Ok(Term { node: Node::Value(place), at }),
            None => {
                let function = FUNCTIONS.iter().any(|f| f.0 == name) || FUNCTIONS_OF_TWO.iter().any(|f| f.0 == name);
                let remedy =
                    if function { format!("write {name}(...)") } else { format!("the names here are {}", self.names.join(", ")) };
                Err(Fault::new(at, format!("`{name}` is not known"), remedy))
            }
        }
    }

    fn called(&self, pair: Pair<Rule>, at: Range<usize>) -> Result<Term, Fault> {
        let mut inner = pair.into_inner();
        let name = inner.next().map_or("", |name| name.as_str());
        let mut terms = inner.map(|pair| self.sum(pair)).collect::<Result<Vec<_>, _>>()?;
        if let Some((_, function)) = FUNCTIONS.iter().find(|(known, _)| *known == name) {
            return match (terms.pop(), terms.len()) {
                (Some(term), 0) => Ok(Term { node: Node::One(*function, Box::new(term)), at }),
                _ => Err(Fault::new(at, format!("{name} is of one term"), format!("write {name}(x)"))),
            };
        }
        if let Some((_, operator)) = FUNCTIONS_OF_TWO.iter().find(|(known, _)| *known == name) {
            return match (terms.pop(), terms.pop(), terms.len()) {
                (Some(b), Some(a), 0) => Ok(Term { at, ..two(*operator, a, b) }),
                _ => Err(Fault::new(at, format!("{name} is of two terms"), format!("write {name}(a, b)"))),
            };
        }
        let known: Vec<&str> = FUNCTIONS.iter().map(|f| f.0).chain(FUNCTIONS_OF_TWO.iter().map(|f| f.0)).collect();
        Err(Fault::new(
            at,
            format!("`{name}` is no function"),
            format!("the functions are {}; a product needs *", known.join(", ")),
        ))
    }
}

impl Term {
    /// Refuses parts without names that have no finite value, the innermost first.
    pub(crate) fn check_constants(&self) -> Result<(), Fault> {
        self.finite().map(|_| ())
    }

    /// Its value where it names nothing.
    fn finite(&self) -> Result<Option<f64>, Fault> {
        let value = match &self.node {
            Node::Number(number) => Some(*number),
            Node::Value(_) => None,
            Node::Minus(term) => term.finite()?.map(|x| -x),
            Node::One(function, term) => term.finite()?.map(|x| function.of(x)),
            Node::Two(operator, terms) => {
                let [a, b] = [terms[0].finite()?, terms[1].finite()?];
                if *operator == Operator::Quotient && b == Some(0.0) {
                    let remedy = "divide by a quantity that is never 0, e.g. max(abs(x), 1)";
                    return Err(Fault::new(terms[1].at.clone(), "this divides by 0", remedy));
                }
                a.zip(b).map(|(a, b)| operator.of(a, b))
            }
        };
        match value {
            Some(value) if !value.is_finite() => {
                Err(Fault::new(self.at.clone(), "this is no finite number", "check the numbers in it"))
            }
            value => Ok(value),
        }
    }
}

fn two(operator: Operator, a: Term, b: Term) -> Term {
    let at = a.at.start..b.at.end;
    Term { node: Node::Two(operator, Box::new([a, b])), at }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Unit;
    use proptest::prelude::*;

    const NAMES: [&str; 3] = ["x", "y", "tau"];

    fn of(text: &str) -> Expression {
        Expression::parse(text, &NAMES).unwrap_or_else(|fault| panic!("{text}: {fault}"))
    }

    #[test]
    fn exact_arithmetic_is_read_as_it_is_written() {
        let (x, y, tau) = (2.0_f64, -3.0_f64, 0.5_f64);
        for (text, value) in [
            ("-x^2", -4.0),
            ("(-x)^2", 4.0),
            ("2^-x", 0.25),
            ("2^3^2", 512.0),
            ("x - y - 1", 4.0),
            ("x / 4 / 2", 0.25),
            ("x / 4 * 2", 1.0),
            ("- -x", 2.0),
            ("x*-y", 6.0),
            ("1.5e-3 * x", 3e-3),
            (".5 + 1.", 1.5),
            ("max(x, min(y, tau))", 2.0),
            ("step(y) + step(0) + step(x)", 2.0),
            ("sign(y) * abs(y)", y),
            ("exp(-x / tau)", (-x / tau).exp()),
            ("sin(pi / 2) + atan(0) + tanh(0) + cos(0) + tan(0) + ln(exp(1)) + sqrt(4)", 5.0),
        ] {
            assert!((of(text).at(&[x, y, tau]) - value).abs() < 1e-15, "{text}");
        }
    }

    #[test]
    fn mistakes_are_found_where_they_stand() {
        for (text, at, says) in [
            ("x + z", 4..5, "`z` is not known"),
            ("2 x", 2..2, "at `x` an operator"),
            ("x +", 3..3, "at the end a number"),
            ("(x", 2..2, "at the end an operator"),
            ("x)", 1..1, "at `)`"),
            ("foo(x)", 0..6, "`foo` is no function"),
            ("sin(x, y)", 0..9, "of one term"),
            ("max(x)", 0..6, "of two terms"),
            ("sin", 0..3, "`sin` is not known"),
            ("x,5", 1..1, "at `,`"),
            ("1e999", 0..5, "too large"),
            ("3x", 0..2, "`3x` is no number"),
            ("x + 1.2.3", 4..9, "`1.2.3` is no number"),
            ("x 2", 2..2, "at `2` an operator"),
            ("", 0..0, "at the end a number"),
            ("x = 3", 2..2, "at `=`"),
            ("\u{1b}[2J", 0..0, "at `\\u{1b}`"),
            ("open(\"/etc\")", 5..5, "at `\\\"`"),
            ("x / 0", 4..5, "divides by 0"),
            ("x * (y + tau / (2 - 2.0))", 15..24, "divides by 0"),
            ("x / -0", 4..6, "divides by 0"),
            ("ln(0) * x", 0..5, "is no finite number"),
            ("x + sqrt(1 - 2)", 4..15, "is no finite number"),
            ("x * 0^-1", 4..8, "is no finite number"),
            ("x * (1e300 * 1e300)", 4..19, "is no finite number"),
        ] {
            let fault = Expression::parse(text, &NAMES).expect_err(text);
            assert!(fault.at == at && fault.problem.contains(says) && !fault.remedy.is_empty(), "{text}: {fault:?}");
        }
        assert!(Expression::parse(&format!("{}x{}", "(".repeat(100), ")".repeat(100)), &NAMES).is_err());
        assert!(Expression::parse(&"-".repeat(10_000), &NAMES).is_err());
        assert!(Expression::parse(&format!("{}x", "-".repeat(900)), &NAMES).is_ok());
    }

    #[test]
    fn exact_units_go_through_every_operation() {
        let units = [Unit::parse("degC"), Unit::parse("deg/h"), Unit::parse("s")].map(|unit| unit.expect("a unit"));
        let check = |text: &str, wanted: &str| of(text).check_unit(&units, Unit::parse(wanted).expect("a unit"));
        for (text, wanted) in [
            ("y * (x - 20)", "deg/h K"),
            ("y * exp(-(x - 20) / x)", "deg/h"),
            ("20 - x", "K"),
            ("x / tau", "K/s"),
            ("sqrt(x^2)", "K"),
            ("(x / x)^(tau / tau)", "1"),
            ("x^-2", "1/K2"),
            ("step(x - 20) * y", "deg/h"),
            ("min(x, 5) * max(1, 2)", "degC"),
            ("5", "K"),
            ("1 / tau", "Hz"),
        ] {
            assert_eq!(check(text, wanted), Ok(()), "{text}");
        }
        for (text, wanted, at, says, remedy) in [
            ("x + y", "K", 4..5, "in deg/h, beside a term in K", "parameter"),
            ("exp(x)", "1", 4..5, "in K, where a pure number", "divide"),
            ("y^x", "1", 2..3, "pure number", "divide"),
            ("x^(x/x)", "K", 0..1, "a power that varies", "divide"),
            ("x", "deg/h", 0..1, "is in K, where deg/h is needed", "parameter"),
            ("y * exp(-(x - 20))", "deg/h", 8..17, "in K, where a pure number", "divide"),
            ("(x - 20) * (y + x) + 5", "deg/h K", 16..17, "beside a term in deg/h", "parameter"),
            ("(x - 20) / tau", "deg/h", 0..14, "is in K/s", "parameter"),
            ("60 * x / tau", "K/min", 0..12, "is in K/s, where K/min is needed", "a factor of 60 does not"),
            ("sin(y)", "1", 4..5, "pure number", "divide"),
        ] {
            let fault = check(text, wanted).expect_err(text);
            assert!(fault.at == at && fault.problem.contains(says) && fault.remedy.contains(remedy), "{text}: {fault:?}");
        }
    }

    proptest! {
        /// Derivatives are those of differences, and no text is too much for the reader.
        #[test]
        fn slopes_are_those_of_differences(x in 0.3_f64..3.0, y in 0.3_f64..3.0, tau in 0.3_f64..3.0) {
            for text in ["x^y * tau", "exp(-x / tau) * sin(y * x)", "tanh(x) / sqrt(y) + atan(x * tau)", "max(x, 2 * y) - abs(x - 10) * ln(tau)", "cos(x)^2 - tan(x / 4)", "-x + min(y, tau + 5)"] {
                let expression = of(text);
                for k in 0..3 {
                    let by = |h: f64| {
                        let mut values = [x, y, tau];
                        values[k] += h;
                        expression.at(&values)
                    };
                    let (value, slope) = expression.slope(&[x, y, tau], k);
                    prop_assert_eq!(value, by(0.0));
                    let kink = (x - 2.0 * y).abs() < 1e-4;
                    prop_assert!(kink || (slope - (by(1e-5) - by(-1e-5)) / 2e-5).abs() < 1e-6 * (1.0 + slope.abs()), "{} by {}", text, k);
                    prop_assert_eq!(expression.has(k), text.contains(NAMES[k]) && !(k == 0 && text.replace("max", "").replace("exp", "").find('x').is_none()));
                }
            }
        }

        #[test]
        fn any_text_is_read_or_refused(text in ".{0,60}") {
            let _ = Expression::parse(&text, &NAMES);
            let _ = Unit::parse(&text);
            let _ = check_name(&text);
        }

        #[test]
        fn any_string_of_signs_is_read_or_refused(text in "[-+*/^()xy12., e]{0,60}") {
            if let Ok(expression) = Expression::parse(&text, &NAMES) {
                let _ = expression.slope(&[1.0, 2.0, 3.0], 0);
                let _ = expression.check_unit(&[Unit::ONE; 3], Unit::ONE);
            }
        }
    }
}
