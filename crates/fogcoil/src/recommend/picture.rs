//! The recommended test as a picture.

use charts::{Axis, Figure, Panel, Series, Style, significant};

use super::course::Course;
use super::recommendation::Recommendation;
use crate::units::DurationUnit;

/// Share of the squared distance from which a thermometer's course is drawn.
const WORTH_DRAWING: f64 = 0.05;

/// The recommended profile and its expected course, an SVG document.
pub fn svg(found: &Recommendation) -> String {
    figure(found).document()
}

/// The profile, the contributions of the pair that it tells apart worst, and the remainder that tells them apart.
pub(crate) fn figure(found: &Recommendation) -> Figure<'static> {
    let best = &found.profiles[0];
    let what = if best.odds.decides() { "The recommended test" } else { "The best within these limits, which does not decide" };
    let sizes = if found.fitted { "that were fitted to the record" } else { "that are typical" };
    let Course { pair: [truth, rival], time, chamber, rate, spool } = &found.course;
    let unit = DurationUnit::of(time.last().copied().unwrap_or(0.0));
    let over = |values: &[f64]| time.iter().zip(values).map(|(t, v)| (unit.of_seconds(*t), *v)).collect::<Vec<_>>();
    let panel = |heading: &str, label: &str, least: f64, lines: f64, series| {
        Panel::lines(Axis::tight("", 1e-6), Axis::round(label, least), lines, series).headed(heading)
    };
    let mut panels = vec![panel("the profile", "chamber [°C]", 0.1, 10.0, vec![Series::new("", Style::First, over(chamber))])];
    for (trace, label, of, least) in [(rate, "rate [°/h]", "°/h", 1e-4), (spool, "spool thermometer [K]", "K", 0.01)] {
        if trace.share < WORTH_DRAWING && label != "rate [°/h]" {
            continue;
        }
        let [own, other] = &trace.added;
        let both =
            vec![Series::new(truth.clone(), Style::First, over(own)), Series::new(rival.clone(), Style::Second, over(other))];
        panels.push(panel("what each adds to the design", label, least, 14.0, both));
        let noise = trace.noise;
        let at = |level: f64| over(&vec![level; time.len()]);
        let noise_name = format!("± noise of a reading, {} {of}", significant(noise, 2));
        let left = vec![
            Series::new(noise_name, Style::Third, at(noise)),
            Series::new("", Style::Third, at(-noise)),
            Series::new(format!("left of {truth}"), Style::First, over(&trace.left)),
        ];
        panels.push(panel("what tells them apart", label, least, 10.0, left));
    }
    if let Some(last) = panels.last_mut() {
        last.x.label = format!("time [{}]", unit.name);
    }
    Figure {
        id: "next-test",
        title: format!("{what}: {}", best.programme.name),
        description: format!(
            "Chamber temperature of the recommended profile over time, the rates that {truth} and {rival} add to the design's, and what tells \
             the two apart."
        ),
        caption: format!(
            "Predicted, without noise, at the sizes {sizes}, each mechanism alone. What tells them apart: what is left of \
             {truth} when {rival}, the model's own errors and the offset are fitted to it; over the whole test this decides."
        ),
        columns: 1,
        panels,
    }
}
