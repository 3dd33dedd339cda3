//! The front as a picture.

use charts::{Axis, Figure, Panel, Series, Style};

use super::front::front;
use super::plan::Plan;
use super::search::Found;

/// The first two measures of every design that keeps the limits, of the front and of the drawing; `None` where one alone is minimised.
pub fn svg(plan: &Plan, found: &Found) -> Option<String> {
    Some(figure(plan, found)?.document())
}

pub(super) fn figure<'a>(plan: &Plan, found: &Found) -> Option<Figure<'a>> {
    let [first, second, ..] = plan.minimise[..] else { return None };
    let at = |measures| (first.of(measures), second.of(measures));
    let sound = found.all.iter().filter(|tried| tried.violation == 0.0).map(|tried| at(&tried.measures)).collect();
    let mut best: Vec<(f64, f64)> = front(&found.all, &plan.minimise).iter().map(|n| at(&found.all[*n].measures)).collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    let series = vec![
        Series::new("tried", Style::Points(4), sound),
        Series::new("front", Style::Marked(1), best),
        Series::new("the drawing", Style::Points(3), vec![at(&found.drawn)]),
    ];
    Some(Figure {
        id: "front",
        title: format!("Designs of {}", plan.variants.case.name),
        description: format!("{} over {} of every design that was tried.", second.label(), first.label()),
        caption: "On the front are designs of which none is better in everything that is minimised.".into(),
        columns: 1,
        panels: vec![Panel::lines(Axis::round(first.label(), 1e-6), Axis::round(second.label(), 1e-6), 24.0, series)],
    })
}
