//! Variation of a key, as a plan states it.

use std::fmt::Formatter;
use std::marker::PhantomData;

use recording::statistics::normal_quantile;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::value::Value;

/// Variation of a key.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub enum Varied {
    /// By its tolerance, which the drawing gives or which is usual.
    Tolerance,
    /// Evenly between two ends.
    Uniform(f64, f64),
    /// Evenly in its logarithm between two ends.
    LogUniform(f64, f64),
    /// Normally: mean and one standard deviation.
    Normal(f64, f64),
    /// Whole numbers from, to, by steps of.
    Whole(i64, i64, i64),
    /// Numbers from, to, so many.
    Steps(f64, f64, usize),
    /// Numbers, or choices as a coil file has them.
    OneOf(Vec<Choice>),
    /// Choices by name, as a coil file has them.
    Named(#[serde(deserialize_with = "each_once")] Vec<(String, String)>),
}

/// One of several.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Choice {
    /// A number.
    Number(f64),
    /// A choice.
    Text(String),
}

/// Reads a map in its order, no key twice.
///
/// # Errors
/// The key that stands there twice.
pub fn each_once<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Vec<(String, T)>, D::Error> {
    struct Entries<T>(PhantomData<T>);
    impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
        type Value = Vec<(String, T)>;

        fn expecting(&self, formatter: &mut Formatter) -> std::fmt::Result {
            formatter.write_str("keys and what is said of them")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Self::Value, A::Error> {
            let mut all: Self::Value = Vec::new();
            while let Some((key, value)) = entries.next_entry::<String, T>()? {
                if all.iter().any(|(known, _)| *known == key) {
                    return Err(A::Error::custom(format!("{key:?} is given twice")));
                }
                all.push((key, value));
            }
            Ok(all)
        }
    }
    deserializer.deserialize_map(Entries(PhantomData))
}

/// Most values that a key may have in turn.
const MOST_LEVELS: usize = 100_000;

/// Distance of a coordinate from 0 and 1 that is kept: half of what a single-precision coordinate resolves.
const WITHIN: f64 = 1.0 / (1u64 << 25) as f64;

/// The standard normal deviation at a coordinate between 0 and 1.
pub(crate) fn normal(u: f64) -> f64 {
    normal_quantile(u.clamp(WITHIN, 1.0 - WITHIN))
}

/// The place of a coordinate among `count` equal parts.
fn part(u: f64, count: usize) -> usize {
    ((u * count as f64) as usize).min(count.saturating_sub(1))
}

/// A number of a grid as one would write it: what twelve digits do not show is rounding.
fn as_written(value: f64) -> f64 {
    format!("{value:.11e}").parse().unwrap_or(value)
}

impl Varied {
    /// Fault of the range or of the values, if there is one.
    pub fn fault(&self) -> Option<String> {
        let ends = |low: f64, high: f64| {
            let bad = !low.is_finite() || !high.is_finite() || low >= high;
            bad.then(|| format!("from {low} to {high} is no range; give two numbers, the lower first"))
        };
        match self {
            Self::Tolerance => None,
            Self::Uniform(low, high) => ends(*low, *high),
            Self::LogUniform(low, high) => {
                ends(*low, *high).or_else(|| (*low <= 0.0).then(|| format!("{low} has no logarithm; give numbers above 0")))
            }
            Self::Normal(mean, sd) => (!mean.is_finite() || !sd.is_finite() || *sd <= 0.0)
                .then(|| format!("mean {mean}, standard deviation {sd}: give finite numbers, the deviation above 0")),
            Self::Whole(from, to, by) => {
                let count = to.checked_sub(*from).filter(|_| *by > 0).map(|span| span / by);
                let good = count.is_some_and(|count| (1..MOST_LEVELS as i64).contains(&count));
                (!good)
                    .then(|| format!("from {from} to {to} by {by}: give 2 to {MOST_LEVELS} whole numbers, the lower end first"))
            }
            Self::Steps(from, to, count) => {
                let good = (2..=MOST_LEVELS).contains(count);
                ends(*from, *to).or_else(|| (!good).then(|| format!("{count} steps: give 2 to {MOST_LEVELS}")))
            }
            Self::OneOf(choices) => {
                let bad = choices.iter().any(|choice| matches!(choice, Choice::Number(value) if !value.is_finite()));
                let count = choices.len();
                (bad || count == 0 || count > MOST_LEVELS)
                    .then(|| format!("{count} values, all of which must be finite: give 1 to {MOST_LEVELS}"))
            }
            Self::Named(choices) => choices.is_empty().then(|| "no choice is named; give at least one".to_owned()),
        }
    }

    /// Whether it is numbers between two ends, of which an optimiser may take any.
    pub fn is_continuous(&self) -> bool {
        matches!(self, Self::Uniform(..) | Self::LogUniform(..) | Self::Normal(..) | Self::Tolerance)
    }

    /// Number of values; `None` for a number between two ends.
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Tolerance | Self::Uniform(..) | Self::LogUniform(..) | Self::Normal(..) => None,
            Self::Whole(from, to, by) => usize::try_from((to - from) / by + 1).ok(),
            Self::Steps(_, _, count) => Some(*count),
            Self::OneOf(choices) => Some(choices.len()),
            Self::Named(choices) => Some(choices.len()),
        }
    }

    /// The coordinate at which a number between two ends, of no distribution, has a value; `None` beyond its ends.
    pub(super) fn coordinate(&self, value: f64) -> Option<f64> {
        let u = match self {
            Self::Uniform(low, high) => (value - low) / (high - low),
            Self::LogUniform(low, high) => (value / low).ln() / (high / low).ln(),
            _ => return None,
        };
        (0.0..=1.0).contains(&u).then_some(u)
    }

    /// The middles of the coordinates that share a value; none where every coordinate has its own.
    pub(super) fn middles(&self) -> impl Iterator<Item = f64> + use<> {
        let count = self.count().unwrap_or(0);
        (0..count).map(move |place| (place as f64 + 0.5) / count as f64)
    }

    /// Its value at a coordinate between 0 and 1.
    pub fn at(&self, u: f64) -> Value {
        let between = |low: f64, high: f64| low + u * (high - low);
        let place = self.count().map_or(0, |count| part(u, count));
        match self {
            Self::Tolerance => Value::Number(normal(u)),
            Self::Uniform(low, high) => Value::Number(between(*low, *high)),
            Self::LogUniform(low, high) => Value::Number(between(low.ln(), high.ln()).exp()),
            Self::Normal(mean, sd) => Value::Number(mean + sd * normal(u)),
            Self::Whole(from, _, by) => Value::Number((from + by * place as i64) as f64),
            Self::Steps(from, to, count) => {
                Value::Number(as_written(from + (to - from) * place as f64 / (count.saturating_sub(1)).max(1) as f64))
            }
            Self::OneOf(choices) => match &choices[place] {
                Choice::Number(value) => Value::Number(*value),
                Choice::Text(text) => Value::Choice(text.clone()),
            },
            Self::Named(choices) => Value::Named(choices[place].0.clone(), choices[place].1.clone()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_become_values() {
        assert_eq!(Varied::Uniform(2.0, 6.0).at(0.25), Value::Number(3.0));
        assert_eq!(Varied::Uniform(2.0, 6.0).coordinate(3.0), Some(0.25));
        assert!((Varied::LogUniform(1.0, 100.0).coordinate(10.0).unwrap() - 0.5).abs() < 1e-12);
        assert_eq!(Varied::Uniform(2.0, 6.0).coordinate(1.9), None);
        let Value::Number(middle) = Varied::LogUniform(1.0, 100.0).at(0.5) else { panic!() };
        assert!((middle - 10.0).abs() < 1e-12);
        assert_eq!(Varied::Whole(24, 60, 4).count(), Some(10));
        assert_eq!([0.0, 0.11, 0.999, 1.0].map(|u| Varied::Whole(24, 60, 4).at(u).ron()), ["24", "28", "60", "60"]);
        assert_eq!([0.0, 0.5, 1.0].map(|u| Varied::Steps(1.0, 2.0, 3).at(u)), [1.0, 1.5, 2.0].map(Value::Number));
        let grid = Varied::Steps(0.3, 0.6, 7);
        assert_eq!(
            grid.middles().map(|u| grid.at(u).shown()).collect::<Vec<_>>(),
            ["0.3", "0.35", "0.4", "0.45", "0.5", "0.55", "0.6"]
        );
        let pair = Varied::OneOf(vec![Choice::Text("Left".into()), Choice::Number(2.0)]);
        assert_eq!([0.49, 0.5].map(|u| pair.at(u).ron()), ["Left", "2"]);
        // one standard deviation, and finite ends
        let Value::Number(one) = Varied::Normal(5.0, 2.0).at(0.841_344_746_068_542_9) else { panic!() };
        assert!((one - 7.0).abs() < 1e-9 && normal(0.0).is_finite() && normal(1.0) == -normal(0.0));
    }

    #[test]
    fn what_cannot_vary_is_refused() {
        let bad = [
            Varied::Uniform(2.0, 2.0),
            Varied::Uniform(f64::NAN, 2.0),
            Varied::LogUniform(0.0, 1.0),
            Varied::Normal(1.0, 0.0),
            Varied::Normal(f64::INFINITY, 1.0),
            Varied::Whole(4, 8, 0),
            Varied::Whole(i64::MIN, i64::MAX, 1),
            Varied::Whole(0, 1_000_000, 1),
            Varied::Steps(0.0, 1.0, 1),
            Varied::OneOf(Vec::new()),
            Varied::OneOf(vec![Choice::Number(f64::NAN)]),
            Varied::Named(Vec::new()),
        ];
        assert!(bad.iter().all(|varied| varied.fault().is_some()));
        assert_eq!(Varied::Whole(24, 60, 4).fault(), None);
    }
}
