//! Trends of a batch: its figures over serial numbers, or units in the order of their names, and over dates.

use charts::{Axis, Figure, Panel, Series, Style};

use super::limits::{Judged, Limits};
use super::row::Row;
use super::run::Batch;
use super::serials::{number, tell_apart};

/// Smallest spans that are drawn: less is rounding.
const LEAST: f64 = 1e-3;
/// Share of the drawn range that stays free beyond its values, so that no mark is cut.
const MARGIN: f64 = 0.08;
/// A limit farther from the values than so many times their range, or their size, is not drawn: it would squash them.
const NEAR: f64 = 3.0;
/// Numbers that are drawn, and their labels.
const DRAWN: [(&str, &str); 3] = [
    ("sensitivity", "sensitivity [(°/h)/(°C/min)]"),
    ("arw", "angle random walk [°/√h]"),
    ("residual_over_noise", "left over noise"),
];

/// A number of a unit at its place.
struct Mark<'a> {
    x: f64,
    y: f64,
    interval: Option<[f64; 2]>,
    judged: &'a Judged,
}

/// The trends.
pub(super) fn trends<'a>(batch: &'a Batch, limits: Option<&Limits>) -> Vec<Figure<'a>> {
    let units = batch.units();
    let all = || batch.rows.iter().enumerate();
    let mut figures = Vec::new();
    if tell_apart(&units) && units.iter().any(|row| number(row).is_some()) {
        let places = all().map(|(_, (row, _))| number(row)).collect();
        figures.push(trend(batch, limits, ("serial", "Over serial numbers"), "serial number", places));
    } else {
        let places = all().map(|(n, _)| Some(1.0 + n as f64)).collect();
        figures.push(trend(batch, limits, ("serial", "Over units by name"), "row of the unit in the table", places));
    }
    let first = units.iter().filter_map(|row| Some((day(row)?, row.date.as_deref()?))).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((first, date)) = first {
        let places = all().map(|(_, (row, _))| Some(day(row)? - first)).collect();
        figures.push(trend(batch, limits, ("date", "Over dates"), &format!("days since {date}"), places));
    }
    figures
}

/// Sensitivity with its interval, and noise, over the place of each unit.
fn trend<'a>(
    batch: &'a Batch,
    limits: Option<&Limits>,
    (id, title): (&'static str, &str),
    axis: &str,
    places: Vec<Option<f64>>,
) -> Figure<'a> {
    let known: Vec<f64> = places.iter().copied().flatten().collect();
    let ends = widened(&known, 1.0);
    let panel = |(n, (number, label)): (usize, &(&str, &str))| {
        let mark = |((row, judged), x): (&'a (Row, Judged), &Option<f64>)| {
            Some(Mark { x: (*x)?, y: row.number(number)?, interval: row.interval(number), judged })
        };
        let marks: Vec<Mark> = batch.rows.iter().zip(&places).filter_map(mark).collect();
        let x = Axis::tight(if n + 1 == DRAWN.len() { axis } else { "" }, 1.0).covering(ends);
        let limits = limits.and_then(|limits| limits.ends(number));
        let (range, series) = drawn(&marks, limits, ends);
        Panel::lines(x, Axis::tight(*label, LEAST.min(range[1] - range[0])).covering(range), 11.0, series)
    };
    Figure {
        id,
        title: title.to_owned(),
        description: format!("Measured sensitivity, angle random walk and residual over noise of every unit over its {axis}."),
        caption: "Upright lines: 90 % intervals, as far as the axis reaches. Level lines: limits near the values.".into(),
        columns: 1,
        panels: DRAWN.iter().enumerate().map(panel).collect(),
    }
}

/// Range of an axis of numbers, and the marks, intervals and limits in it: values and near limits count for the range, wide intervals do not.
fn drawn<'a>(marks: &[Mark], limits: Option<[f64; 2]>, along: [f64; 2]) -> ([f64; 2], Vec<Series<'a>>) {
    let values: Vec<f64> = marks.iter().map(|mark| mark.y).collect();
    let near: Vec<f64> = limits.into_iter().flatten().filter(|limit| is_near(*limit, &values)).collect();
    let size = values.iter().fold(0.0, |size: f64, value| size.max(value.abs()));
    let range = widened(&values.iter().chain(&near).copied().collect::<Vec<_>>(), LEAST * size);
    let mut series: Vec<Series> = near
        .iter()
        .enumerate()
        .map(|(n, limit)| Series::new(if n == 0 { "limits" } else { "" }, Style::Guide, along.map(|x| (x, *limit)).to_vec()))
        .collect();
    let clipped = |mark: &Mark| Some(mark.interval?.map(|end| (mark.x, end.clamp(range[0], range[1]))).to_vec());
    series.extend(marks.iter().filter_map(clipped).map(|ends| Series::new("", Style::Fine(2), ends)));
    for (word, name, kind) in [("", "passes, or is not judged", 0), ("fail", "fails", 1), ("not known", "is not known", 2)] {
        let own = marks.iter().filter(|mark| mark.judged.word() == word || (word.is_empty() && *mark.judged == Judged::Passes));
        let points: Vec<(f64, f64)> = own.map(|mark| (mark.x, mark.y)).collect();
        series.extend((!points.is_empty()).then(|| Series::new(name, Style::Points(kind), points)));
    }
    (range, series)
}

/// Least and most of some numbers.
fn ends(values: &[f64]) -> Option<[f64; 2]> {
    values.iter().fold(None, |ends, value| {
        let [low, high] = ends.unwrap_or([*value; 2]);
        Some([value.min(low), value.max(high)])
    })
}

/// Range of numbers, of `least` where they are all alike, with a margin.
fn widened(values: &[f64], least: f64) -> [f64; 2] {
    let [low, high] = ends(values).unwrap_or([0.0, 1.0]);
    let span = (high - low).max(least).max(f64::MIN_POSITIVE);
    [low - MARGIN * span, high + MARGIN * span]
}

fn is_near(limit: f64, values: &[f64]) -> bool {
    ends(values).is_some_and(|[low, high]| {
        let reach = NEAR * (high - low).max(low.abs()).max(high.abs());
        // a magnitude limits numbers of the other sign, too
        (low - reach..=high + reach).contains(&limit) && (limit >= 0.0 || low < 0.0) && (limit <= 0.0 || high > 0.0)
    })
}

/// Days from 1 January 2000 to the date of a unit, if it is one.
fn day(row: &Row) -> Option<f64> {
    let mut parts = row.date.as_deref()?.splitn(3, '-').map(str::parse::<i64>);
    let [year, month, day] = [parts.next()?.ok()?, parts.next()?.ok()?, parts.next()?.ok()?];
    // days of the civil calendar with years that begin in March (E. Richards, 2013)
    let shifted = |y: i64, m: i64| if m > 2 { (y, m - 3) } else { (y - 1, m + 9) };
    let number = |y: i64, m: i64, d: i64| {
        let (y, m) = shifted(y, m);
        365 * y + y.div_euclid(4) - y.div_euclid(100) + y.div_euclid(400) + (153 * m + 2) / 5 + d
    };
    ((1..=12).contains(&month) && (1..=31).contains(&day)).then(|| (number(year, month, day) - number(2000, 1, 1)) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn days_of_the_calendar() {
        let of = |date: &str| day(&Row::of(&json!({"unit": "U", "date": date})));
        assert_eq!([of("2000-01-01"), of("2000-03-01"), of("2026-03-02")], [Some(0.0), Some(60.0), Some(9557.0)]);
        assert_eq!([of("1999-12-31"), of("2026-13-01"), of("soon"), of("")], [Some(-1.0), None, None, None]);
    }

    #[test]
    fn dates_count_from_the_first_of_them() {
        let row = |date: &str| {
            let finding = json!({"unit": date, "date": date, "measured": {"sensitivity": {"value": 1.0}}});
            (Row::of(&finding), Judged::Unjudged)
        };
        let batch = Batch { rows: ["2026-11-05", "2026-11-01", "soon"].map(row).into() };
        let figures = trends(&batch, None);
        let over_dates = figures.iter().find(|figure| figure.id == "date").unwrap();
        assert_eq!(over_dates.panels.last().unwrap().x.label, "days since 2026-11-01");
        let [low, high] = over_dates.panels[0].x.covers.unwrap();
        assert!(low < 0.0 && low > -1.0 && high > 4.0 && high < 5.0, "{low} {high}");
    }

    fn mark(x: f64, y: f64, interval: [f64; 2]) -> Mark<'static> {
        Mark { x, y, interval: Some(interval), judged: &Judged::Passes }
    }

    #[test]
    fn a_useless_interval_squashes_nothing() {
        let marks = [mark(1.0, -2.7, [-2.8, -2.6]), mark(2.0, -2.9, [-40.0, 40.0])];
        let ([low, high], series) = drawn(&marks, Some([-3.2, -2.3]), [0.9, 2.1]);
        assert!(low < -3.2 && low > -3.5 && high > -2.3 && high < -2.0, "{low} {high}");
        let spans: Vec<[f64; 2]> = series.iter().filter_map(Series::ranges).map(|[_, y]| y).collect();
        assert!(spans.iter().all(|[a, b]| *a >= low && *b <= high), "{spans:?}");
        assert!(spans.contains(&[-3.2, -3.2]) && spans.contains(&[-2.3, -2.3]), "both limits are drawn: {spans:?}");
    }

    #[test]
    fn a_limit_far_from_the_values_is_not_drawn() {
        let marks = [mark(1.0, 0.001, [0.0009, 0.0011]), mark(2.0, 0.0012, [0.001, 0.0013])];
        assert_eq!(drawn(&marks, Some([-1.0, 1.0]), [0.9, 2.1]).1.len(), 3);
        let (range, _) = drawn(&marks, Some([-0.002, 0.002]), [0.9, 2.1]);
        assert!(range[0] > 0.0 && range[1] > 0.002 && range[1] < 0.0022, "{range:?}");
    }
}
