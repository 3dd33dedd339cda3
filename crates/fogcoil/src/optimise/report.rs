//! The page of an optimisation.

use charts::{Cells, grid, nice, sections};
use maud::{Markup, html};

use super::check::Checked;
use super::front::front;
use super::picture::figure;
use super::plan::Plan;
use super::search::Found;
use super::text::{NOTHING, designs, of_optimum, on_the_front, remarks, steps};
use crate::report::{provenance, sentence};

/// The front, the optimum with its check, and the changes that lead to it.
pub fn report(plan: &Plan, found: &Found, checked: Option<&Checked>) -> String {
    let best = front(&found.all, &plan.minimise);
    let sound = found.all.iter().filter(|tried| tried.violation == 0.0).count();
    let lead = html! {
        p {
            (found.all.len()) " designs were tried, " (sound) " keep the limits, " (on_the_front(best.len())) "."
            @if let Some((count, first)) = &found.failed { " " (count) " points of the plan have no design; of the first: " (nice(first)) "." }
        }
    };
    let files: Vec<_> = ["plan", "coil"].into_iter().chain(std::iter::repeat("cell")).zip(&plan.files).collect();
    let front = html! {
        @if let Some(front) = figure(plan, found) { (front.element()) }
        (headed("The drawing and designs of the front", &designs(plan, found, &best)))
    };
    let optimum = html! {
        @match checked {
            None => p { (sentence(NOTHING)) },
            Some(checked) => {
                @for text in of_optimum(plan, found, checked) { p { (sentence(&text)) } }
                (headed("What leads there, change by change; S in (deg/h)/(degC/min)", &steps(found, checked)))
                @for text in remarks(plan, found, &best, checked) {
                    p { (sentence(&text)) }
                }
            }
        }
    };
    let provenance = provenance("optimise", &files, &[("seed".to_owned(), plan.seed.to_string())]);
    let body = sections(&[("Front", front), ("Optimum", optimum), provenance]);
    charts::page(&format!("{}: the best of {} designs", plan.variants.case.name, found.all.len()), &lead, &body)
}

/// A table whose first row is its head.
fn headed(caption: &str, rows: &[Vec<String>]) -> Markup {
    html! { @if let Some((head, rows)) = rows.split_first() { (grid(caption, Cells::Words, head, rows)) } }
}
