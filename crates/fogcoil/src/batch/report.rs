//! The page of a batch.

use charts::{Cells, grid, nice, sections, significant};
use maud::{Markup, html};

use super::doubt::Doubt;
use super::finding::Inputs;
use super::kept::page;
use super::limits::Limits;
use super::lot::{BY_CHANCE, Common, FEWEST, Outlier, common, lots, outliers, within_tolerances};
use super::row::{Row, unit_of};
use super::run::Batch;
use super::serials::{copied, repeated};
use super::text::{NOT_PASSED, named};
use super::trends::trends;
use crate::input::Fingerprint;
use crate::report::provenance;

/// The page, with links to the pages of the units beside it.
pub fn report(inputs: &Inputs, limits: Option<&Limits>, batch: &Batch) -> String {
    let body = sections(&[
        ("Units", units(batch)),
        ("Trends", html! { @for trend in trends(batch, limits) { (trend.element()) } }),
        ("Outliers", standing_out(batch)),
        ("In common", in_common(batch)),
        sources(inputs, limits),
    ]);
    charts::page(&format!("{}: {} units", inputs.case.name, batch.rows.len()), &lead(batch, limits), &body)
}

fn lead(batch: &Batch, limits: Option<&Limits>) -> Markup {
    let count = |verdict: &str| batch.rows.iter().filter(|(row, _)| row.verdict.as_deref() == Some(verdict)).count();
    let (failing, not_known, all) = (batch.failing(), batch.not_known(), batch.rows.len());
    html! {
        p {
            @match (limits, failing + not_known) {
                (None, _) => { "No limits were given." }
                (Some(_), 0) => { "All " (all) " units keep the limits." }
                (Some(_), _) => {
                    (all - failing - not_known) " of " (all) " units pass, " (failing) " fail" (named(batch, "fail"))
                    @if not_known > 0 { "; of " (not_known) " it is not known" (named(batch, "not known")) ": " (NOT_PASSED) }
                    "."
                }
            }
            " Units that show no difference from the design: " (count("none")) "; that differ within tolerances: " (count("recalibrate"))
            "; by something that has a name: " (count("explained")) "; by something that has none: " (count("unknown"))
            @if batch.problems().next().is_some() { "; not diagnosed: " (batch.problems().count()) }
            "."
        }
        @if let Some(said) = Doubt::of(batch).said() { p { "Doubt: " (said) "." } }
        @for (serial, units) in repeated(&batch.units()) {
            p { (units.len()) " units have the serial number " (serial) ": " (units.join(", ")) "." }
        }
        @for units in copied(&batch.units()) {
            p { (units.join(", ")) " have a recording in common, byte for byte: is one of them a copy?" }
        }
    }
}

/// A text about a unit.
type Text = fn(&Row) -> &Option<String>;

fn units(batch: &Batch) -> Markup {
    let shown = |value: Option<f64>, digits| nice(&value.map_or("–".to_owned(), |value| significant(value, digits)));
    // those that did not pass come first
    let mut rows: Vec<_> = batch.rows.iter().collect();
    rows.sort_by_key(|(_, judged)| ["fail", "not known"].iter().position(|word| *word == judged.word()).unwrap_or(2));
    let told = |of: Text| batch.rows.iter().any(|(row, _)| of(row).is_some());
    let about: [(&str, Text); 3] = [("lot", |row| &row.lot), ("serial", |row| &row.serial), ("date", |row| &row.date)];
    let doubt = Doubt::of(batch);
    let about: Vec<_> = about.into_iter().filter(|(_, of)| told(*of)).collect();
    html! {
        div.scroll role="group" tabindex="0" aria-label="Units" {
            table.words.many {
                caption { "Units; sensitivities in (°/h)/(°C/min), with 90 % intervals" }
                thead { tr {
                    @for head in ["unit", "judged", "why", "sensitivity", "from the design's", "verdict", "its probability", "not excluded", "left over noise"] {
                        th scope="col" { (head) }
                    }
                    @for (head, _) in &about { th scope="col" { (head) } }
                } }
                tbody { @for (row, judged) in rows { tr {
                    th scope="row" {
                        @if row.problem.is_none() { a href=(page(&row.unit)) { (row.unit) } } @else { (row.unit) }
                    }
                    td { (judged.word()) }
                    td {
                        (nice(&[row.told_besides(), judged.reasons().or_else(|| row.problem.clone())].into_iter().flatten().collect::<Vec<_>>().join("; ")))
                    }
                    td {
                        (shown(row.number("sensitivity"), 4))
                        @if let Some([low, high]) = row.interval("sensitivity") { " (" (nice(&significant(low, 3))) " to " (nice(&significant(high, 3))) ")" }
                    }
                    td { @if let Some(sigmas) = row.number("sigmas_from_predicted") { (nice(&format!("{sigmas:+.1} σ"))) } }
                    td { (doubt.shown(row).unwrap_or_default()) }
                    td { (shown(row.number("verdict_probability"), 2)) }
                    td { (row.open()) }
                    td { (shown(row.number("residual_over_noise"), 3)) }
                    @for (_, of) in &about { td { (of(row).clone().unwrap_or_default()) } }
                } "\n" } }
            }
        } "\n"
        p {
            "Left over noise: root mean square that the best explanation leaves of the rate, over the white noise of a row, from neighbours' differences \
             (one standard deviation). The drift of the gyroscope counts as left."
        }
    }
}

fn standing_out(batch: &Batch) -> Markup {
    let all = outliers(batch);
    let row = |o: &Outlier| {
        vec![
            o.unit.to_owned(),
            o.number.to_owned(),
            format!("{}{}", significant(o.value, 4), unit_of(o.number)),
            format!("{}{}{}", significant(o.median, 4), unit_of(o.number), o.of_sizes()),
            format!("{:+.1}", o.distance),
        ]
    };
    html! {
        @if batch.rows.len() < FEWEST {
            p { "Only " (batch.rows.len()) " units; " (FEWEST) " are needed to tell which number is far from the others." }
        } @else if all.is_empty() {
            p { "No number of a unit is far from those of the others." }
        } @else {
            (grid("Numbers far from the median of all units, in robust standard deviations", Cells::Words,
                &["unit", "number", "value", "median", "distance"], &all.iter().map(row).collect::<Vec<_>>()))
            p { (chance()) }
        }
    }
}

/// How often chance makes a number stand out.
fn chance() -> String {
    format!(
        "In about one sound batch in {:.0} at most a number is so far from it by chance, all numbers of all units together; the fewer the units, the larger the \
         distance.",
        1.0 / BY_CHANCE
    )
}

fn in_common(batch: &Batch) -> Markup {
    let all: Vec<(Option<&str>, Vec<Common>)> = lots(batch).into_iter().map(|(lot, units)| (lot, common(&units))).collect();
    let row = |c: &Common| vec![c.name.clone(), format!("{:+.2}", c.mean), format!("{:.2}", c.sd), c.units.to_string()];
    html! {
        @for (lot, found) in &all {
            @if let Some(lot) = lot { h3 { "Lot " (lot) } "\n" }
            @if found.is_empty() {
                p { (nothing(batch, *lot)) }
            } @else {
                (grid("Constants off the design's on average, in tolerances (one standard deviation)", Cells::Words,
                    &["constant", "mean", "spread between units", "units"], &found.iter().map(row).collect::<Vec<_>>()))
            }
        }
        @if all.iter().any(|(_, found)| !found.is_empty()) {
            p { "Fitted. What a lot has in common belongs into its design: fogcoil calibrate writes one from its good units." }
        }
    }
}

/// Why nothing is in common.
fn nothing(batch: &Batch, lot: Option<&str>) -> String {
    let within = lots(batch).into_iter().find(|(name, _)| *name == lot).map_or(0, |(_, units)| within_tolerances(&units).len());
    match within {
        n if n < FEWEST => format!("Only {n} units are within tolerances; {FEWEST} are needed to tell what they have in common."),
        n => format!("No constant of the {n} units that are within tolerances is off the design's on average."),
    }
}

fn sources(inputs: &Inputs, limits: Option<&Limits>) -> (&'static str, Markup) {
    let roles = ["coil"].into_iter().chain(std::iter::repeat("cell"));
    let mut files: Vec<(&str, &Fingerprint)> = roles.zip(&inputs.case.fingerprints).collect();
    files.extend(limits.map(|limits| ("limits", &limits.fingerprint)));
    provenance("batch", &files, &[])
}
