//! The Allan deviation as a picture.

use recording::allan::{AllanPoint, CONFIDENCE};

use super::text::taken_off;
use super::{Analysis, GyroNoise};
use crate::plot::{Axis, Content, Figure, Height, Panel, Series, Style, Thinning};

/// The Allan deviation with its intervals and the fitted model, as an SVG document; `None` without identified noise.
pub fn svg(analysis: &Analysis) -> Option<String> {
    let noise = analysis.noise.as_ref().filter(|noise| noise.allan.iter().any(|point| point.deviation > 0.0))?;
    let file = analysis.case.fingerprint.file.file_name().unwrap_or_default().to_string_lossy();
    let figure = Figure {
        id: "allan",
        title: format!("Allan deviation of the rate, {file}"),
        description: "Overlapping Allan deviation against averaging time, both axes logarithmic, between the ends of its 90 % \
                      intervals, and that of the fitted noise model."
            .into(),
        caption: format!("{file}; beside {}.", taken_off(noise)),
        columns: 1,
        panels: vec![Panel {
            heading: String::new(),
            x: Axis::logarithmic("averaging time [s]"),
            y: Axis::logarithmic("Allan deviation [°/h]"),
            height: Height::Lines(24.0),
            content: Content::Lines(vec![
                interval(noise),
                curve(noise, "fitted model", Style::Marked(1), |noise, point| {
                    noise.estimate.model.allan_deviation(point.tau, noise.interval)
                }),
                curve(noise, "recording", Style::Marked(0), |_, point| point.deviation),
            ]),
        }],
    };
    Some(figure.document())
}

/// Out along the lower ends, back along the upper.
fn interval(noise: &GyroNoise) -> Series<'_> {
    let count = noise.allan.len();
    let at = move |n: usize| {
        let point = noise.allan[n.min(2 * count - 1 - n)];
        (point.tau, if n < count { point.low } else { point.high })
    };
    let name = format!("{:.0} % interval", 100.0 * CONFIDENCE);
    Series { name, style: Style::Third, count: 2 * count, at: Box::new(at), thinning: Thinning::Distance }
}

fn curve<'a>(noise: &'a GyroNoise, name: &str, style: Style, of: fn(&GyroNoise, &AllanPoint) -> f64) -> Series<'a> {
    Series {
        name: name.to_owned(),
        style,
        count: noise.allan.len(),
        at: Box::new(move |n| (noise.allan[n].tau, of(noise, &noise.allan[n]))),
        thinning: Thinning::Distance,
    }
}
