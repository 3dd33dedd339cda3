//! The sensitivity against the keys that a plan varies, as a picture.

use charts::{Axis, Figure, Panel, Series, Style};

use super::outputs::TOTAL;
use super::plan::Plan;
use super::row::Row;
use crate::variants::{Kind, Value};

/// Most keys, names and points of a name that are drawn.
const KEYS: usize = 6;
const NAMES: usize = 5;
/// Most of them that are lines, each of its own kind.
const LINES: usize = 4;
const POINTS: usize = 1000;
/// Least span of the sensitivity's axis \[(deg/h)/(degC/min)\]: below it differences are rounding.
const LEAST_SPAN: f64 = 1e-3;

/// Share of the drawn range that stays free beyond its values, so that no mark is cut.
const MARGIN: f64 = 0.04;

/// Range of a number with a margin.
fn around(made: &[(&Row, f64)], number: impl Fn(&Row) -> Option<f64>) -> [f64; 2] {
    let values = made.iter().filter_map(|(row, _)| number(row));
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    let margin = MARGIN * (high - low);
    [low - margin, high + margin]
}

/// A panel for each key of the plan that is a number and varies; a colour for each combination of those that are names, of as many of them as leave few. `None` where there is no such
/// number, or no sensitivity.
pub(super) fn against_keys<'a>(plan: &Plan, rows: &[Row]) -> Option<Figure<'a>> {
    let place = plan.names().iter().position(|name| *name == TOTAL)?;
    let made: Vec<(&Row, f64)> = rows.iter().filter_map(|row| Some((row, row.outputs[place]?))).collect();
    let number = |row: &Row, key: usize| match row.values[key] {
        Some(Value::Number(value)) => Some(value),
        _ => None,
    };
    let stated: Vec<usize> =
        (0..plan.variants.factors.len()).filter(|k| matches!(plan.variants.factors[*k].kind, Kind::Key(_))).collect();
    let varies = |key: &usize| {
        let mut values = made.iter().map(|(row, _)| number(row, *key));
        let first = values.next().flatten();
        first.is_some() && values.any(|value| value.is_some() && value != first)
    };
    let keys: Vec<usize> = stated.iter().copied().filter(varies).take(KEYS).collect();
    let is_name = |key: &&usize| made.first().is_some_and(|(row, _)| row.values[**key].is_some() && number(row, **key).is_none());
    let name_of = |row: &Row, key: usize| row.values[key].as_ref().map_or(String::new(), Value::shown);
    let all_named: Vec<usize> = stated.iter().filter(is_name).copied().collect();
    let names_of = |row: &Row, keys: &[usize]| keys.iter().map(|key| name_of(row, *key)).collect::<Vec<_>>().join(", ");
    // of as many keys as leave few enough combinations
    let few = |keys: &[usize]| {
        let mut names: Vec<String> = made.iter().map(|(row, _)| names_of(row, keys)).collect();
        names.sort();
        names.dedup();
        (names.len() <= NAMES).then_some(names)
    };
    let (named, names) = (1..=all_named.len())
        .rev()
        .find_map(|count| Some((&all_named[..count], few(&all_named[..count])?)))
        .unwrap_or((&[], vec![String::new()]));
    // of one key alone every name is a course
    let is_course = stated.len() == keys.len() + if names.len() > 1 { named.len() } else { 0 } && keys.len() == 1;
    let series = |key: usize, (n, name): (usize, &String)| {
        let own = |row: &Row| names_of(row, named) == *name;
        let mut points: Vec<(f64, f64)> =
            made.iter().filter(|(row, _)| own(row)).filter_map(|(row, s)| Some((number(row, key)?, *s))).collect();
        if is_course {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        let stride = points.len().div_ceil(POINTS).max(1);
        let points = points.into_iter().step_by(stride).collect();
        let style = if is_course && n < LINES { Style::Marked(n as u8) } else { Style::Points(n as u8) };
        Series::new(name.clone(), style, points)
    };
    let panel = |key: &usize| {
        Panel::lines(
            Axis::tight(plan.variants.factors[*key].key.clone(), 1e-12).covering(around(&made, |row| number(row, *key))),
            Axis::round("sensitivity [(°/h)/(°C/min)]", LEAST_SPAN),
            14.0,
            names.iter().enumerate().map(|named| series(*key, named)).collect(),
        )
    };
    let others = if keys.len() > 1 || plan.variants.factors.len() > stated.len() {
        " All keys of the plan vary at once: points above one another differ in the others."
    } else {
        ""
    };
    (!keys.is_empty()).then(|| Figure {
        id: "sensitivity-against-keys",
        title: format!("Sensitivity of {} against what the plan varies", plan.variants.case.name),
        description: "Steady-ramp sensitivity of every design against each number that the plan varies.".into(),
        caption: format!("Of {} designs.{others}", made.len()),
        columns: keys.len().min(2),
        panels: keys.iter().map(panel).collect(),
    })
}
