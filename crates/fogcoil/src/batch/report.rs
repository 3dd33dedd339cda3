//! The page of a batch.

use charts::{Cells, grid, nice, sections, significant};
use maud::{Markup, html};

use super::finding::Inputs;
use super::kept::page;
use super::limits::Limits;
use super::lot::{Common, Outlier, common, lots, outliers};
use super::row::unit_of;
use super::run::Batch;
use super::serials::repeated;
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
    let doubtful = batch.rows.iter().filter(|(row, _)| row.shown_verdict().is_some_and(|verdict| verdict.ends_with('?'))).count();
    html! {
        p {
            @match (limits, failing + not_known) {
                (None, _) => { "No limits were given." }
                (Some(_), 0) => { "All " (all) " units keep the limits." }
                (Some(_), _) => {
                    (failing) " of " (all) " units do not keep the limits."
                    @if not_known > 0 { " Of " (not_known) " it is not known whether they keep them: they have not passed." }
                }
            }
            " " (count("none")) " units show no difference from the design; " (count("recalibrate")) " differ within tolerances; "
            (count("explained")) " by something that has a name; " (count("unknown")) " by something that has none."
            @if doubtful > 0 {
                " Of " (doubtful) " the verdict is doubtful (?): its probability is below 0.8, and a small fault may hide in it."
            }
        }
        @for (serial, units) in repeated(&batch.units()) {
            p { (units.len()) " units have the serial number " (serial) ": " (units.join(", ")) "." }
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
                    @for head in ["unit", "lot", "serial", "date", "sensitivity", "from the design's", "verdict", "set", "left over noise", "judged", "why"] {
                        th scope="col" { (head) }
                    }
                } }
                tbody { @for (row, judged) in &batch.rows { tr {
                    th scope="row" {
                        @if row.problem.is_none() { a href=(page(&row.unit)) { (row.unit) } } @else { (row.unit) }
                    }
                    td { (row.lot.clone().unwrap_or_default()) }
                    td { (row.serial.clone().unwrap_or_default()) }
                    td { (row.date.clone().unwrap_or_default()) }
                    td {
                        (shown(row.number("sensitivity"), 4))
                        @if let Some([low, high]) = row.interval("sensitivity") { " (" (nice(&significant(low, 3))) " to " (nice(&significant(high, 3))) ")" }
                    }
                    td { @if let Some(sigmas) = row.number("sigmas_from_predicted") { (nice(&format!("{sigmas:+.1} σ"))) } }
                    td { (row.shown_verdict().unwrap_or_default()) }
                    td { (row.set.join(", ")) }
                    td { (shown(row.number("residual_over_noise"), 3)) }
                    td { (judged.word()) }
                    td { (nice(&judged.reasons().or_else(|| row.problem.clone()).unwrap_or_default())) }
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
            format!("{}{}", significant(o.median, 4), unit_of(o.number)),
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
    let all: Vec<(Option<&str>, Vec<Common>)> = lots(batch).into_iter().map(|(lot, units)| (lot, common(&units))).collect();
    let row = |c: &Common| vec![c.name.clone(), format!("{:+.2}", c.mean), format!("{:.2}", c.sd), c.units.to_string()];
    html! {
        @for (lot, found) in &all {
            @if let Some(lot) = lot { h3 { "Lot " (lot) } "\n" }
            @if found.is_empty() {
                p { "No constant of the units that are within tolerances is off the design's on average, or they are fewer than five." }
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

fn sources(inputs: &Inputs, limits: Option<&Limits>) -> (&'static str, Markup) {
    let roles = ["coil"].into_iter().chain(std::iter::repeat("cell"));
    let mut files: Vec<(&str, &Fingerprint)> = roles.zip(&inputs.case.fingerprints).collect();
    files.extend(limits.map(|limits| ("limits", &limits.fingerprint)));
    provenance("batch", &files, &[])
}
