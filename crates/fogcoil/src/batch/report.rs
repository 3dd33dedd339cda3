//! The page of a batch.

use charts::{Axis, Cells, Figure, Panel, Series, Style, grid, nice, significant};
use maud::{Markup, html};

use super::finding::Inputs;
use super::kept::page;
use super::limits::{Judged, Limits};
use super::lot::{common, outliers};
use super::row::{Row, trailing};
use super::run::Batch;
use crate::input::Fingerprint;
use crate::report::provenance;

/// Smallest spans that are drawn: less is rounding.
const LEAST: f64 = 1e-3;

/// The page, with links to the pages of the units beside it.
pub fn report(inputs: &Inputs, limits: Option<&Limits>, batch: &Batch) -> String {
    let body = html! {
        h2 { "Units" } "\n"
        (units(batch))
        h2 { "Trends" } "\n"
        (trend(batch, "serial", "Over serial numbers", "serial number", &|row| trailing(row.serial.as_deref()?)?.parse().ok()).element())
        @if batch.rows.iter().any(|(row, _)| day(row).is_some()) {
            (trend(batch, "date", "Over dates", "days since 1 January 2000", &day).element())
        }
        h2 { "What stands out" } "\n"
        (standing_out(batch))
        h2 { "What the units have in common" } "\n"
        (in_common(batch))
        (sources(inputs, limits))
    };
    charts::page(&format!("{}: {} units", inputs.case.name, batch.rows.len()), &lead(batch, limits), &body)
}

fn lead(batch: &Batch, limits: Option<&Limits>) -> Markup {
    let count = |verdict: &str| batch.rows.iter().filter(|(row, _)| row.verdict.as_deref() == Some(verdict)).count();
    let (failing, all) = (batch.failing(), batch.rows.len());
    html! {
        p {
            @match (limits, failing) {
                (None, _) => { "No limits were given." }
                (Some(_), 0) => { "All " (all) " units keep the limits." }
                (Some(_), _) => { (failing) " of " (all) " units do not keep the limits." }
            }
            " Of the design as it is " (count("none")) " units differ by nothing that shows, " (count("recalibrate")) " within its tolerances; "
            (count("explained")) " by something that has a name, " (count("unknown")) " by something that has none."
        }
    }
}

fn units(batch: &Batch) -> Markup {
    let shown = |value: Option<f64>, digits| nice(&value.map_or("–".to_owned(), |value| significant(value, digits)));
    html! {
        div.scroll role="group" tabindex="0" aria-label="Units" {
            table.words.many {
                caption { "Units; sensitivities in (°/h)/(°C/min), with 90 % intervals" }
                thead { tr {
                    @for head in ["unit", "serial", "date", "sensitivity", "from the design's", "verdict", "set", "left over noise", "judged", "why"] {
                        th scope="col" { (head) }
                    }
                } }
                tbody { @for (row, judged) in &batch.rows { tr {
                    th scope="row" {
                        @if row.problem.is_none() { a href=(page(&row.unit)) { (row.unit) } } @else { (row.unit) }
                    }
                    td { (row.serial.clone().unwrap_or_default()) }
                    td { (row.date.clone().unwrap_or_default()) }
                    td {
                        (shown(row.number("sensitivity"), 4))
                        @if let Some([low, high]) = row.interval("sensitivity") { " (" (nice(&significant(low, 3))) " to " (nice(&significant(high, 3))) ")" }
                    }
                    td { @if let Some(sigmas) = row.number("sigmas_from_predicted") { (nice(&format!("{sigmas:+.1} σ"))) } }
                    td { (row.verdict.clone().unwrap_or_default()) }
                    td { (row.set.join(", ")) }
                    td { (shown(row.number("residual_over_noise"), 3)) }
                    td { (judged.word()) }
                    td { (nice(&judged.reasons().or_else(|| row.problem.clone()).unwrap_or_default())) }
                } "\n" } }
            }
        } "\n"
    }
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

/// Sensitivity with its interval, and noise, over something of a unit.
fn trend<'a>(batch: &'a Batch, id: &'static str, title: &str, axis: &str, of: &dyn Fn(&Row) -> Option<f64>) -> Figure<'a> {
    let panel = |number: &str, label: &str, last: bool| {
        let known: Vec<(f64, f64, &Row, &Judged)> =
            batch.rows.iter().filter_map(|(row, judged)| Some((of(row)?, row.number(number)?, row, judged))).collect();
        let mut series: Vec<Series> = known
            .iter()
            .filter_map(|(x, _, row, _)| row.interval(number).map(|ends| ends.map(|end| (*x, end)).to_vec()))
            .map(|ends| Series::new("", Style::Fine(2), ends))
            .collect();
        for (fails, name, kind) in [(false, "passes, or is not judged", 0), (true, "fails", 1)] {
            let own = known.iter().filter(|(.., judged)| matches!(judged, Judged::Fails(_)) == fails);
            let points: Vec<(f64, f64)> = own.map(|(x, y, ..)| (*x, *y)).collect();
            series.extend((!points.is_empty()).then(|| Series::new(name, Style::Points(kind), points)));
        }
        let x = Axis::tight(if last { axis } else { "" }, 1.0);
        Panel::lines(x, Axis::round(label, LEAST), 11.0, series)
    };
    Figure {
        id,
        title: title.to_owned(),
        description: format!("Measured sensitivity, angle random walk and residual over noise of every unit over its {axis}."),
        caption: "Lines: 90 % intervals.".into(),
        columns: 1,
        panels: vec![
            panel("sensitivity", "sensitivity [(°/h)/(°C/min)]", false),
            panel("arw", "angle random walk [°/√h]", false),
            panel("residual_over_noise", "left over noise", true),
        ],
    }
}

fn standing_out(batch: &Batch) -> Markup {
    let all = outliers(batch);
    let row = |o: &super::lot::Outlier| {
        vec![
            o.unit.to_owned(),
            o.number.to_owned(),
            significant(o.value, 4),
            significant(o.median, 4),
            format!("{:+.1}", o.distance),
        ]
    };
    html! {
        @if all.is_empty() {
            p { "No number of a unit is far from those of the others." }
        } @else {
            (grid("Numbers farther than 3.5 robust standard deviations from the median of all units", Cells::Words,
                &["unit", "number", "value", "median", "distance"], &all.iter().map(row).collect::<Vec<_>>()))
        }
    }
}

fn in_common(batch: &Batch) -> Markup {
    let all = common(batch);
    let row =
        |c: &super::lot::Common| vec![c.name.clone(), format!("{:+.2}", c.mean), format!("{:.2}", c.sd), c.units.to_string()];
    html! {
        @if all.is_empty() {
            p { "No constant of the units that are within tolerances is off the design's on average, or they are fewer than five." }
        } @else {
            (grid("Constants off the design's on average, in standard deviations of their tolerance", Cells::Words,
                &["constant", "mean", "units differ by", "units"], &all.iter().map(row).collect::<Vec<_>>()))
            p { "Fitted. What a lot has in common belongs into its design: fogcoil calibrate writes one from its good units." }
        }
    }
}

fn sources(inputs: &Inputs, limits: Option<&Limits>) -> Markup {
    let roles = ["coil"].into_iter().chain(std::iter::repeat("cell"));
    let mut files: Vec<(&str, &Fingerprint)> = roles.zip(&inputs.case.fingerprints).collect();
    files.extend(limits.map(|limits| ("limits", &limits.fingerprint)));
    provenance("batch", &files, &[])
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
}
