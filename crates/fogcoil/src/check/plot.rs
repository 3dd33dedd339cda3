//! The Allan deviation as a picture.

use charts::{Axis, Figure, Panel, Series, Style};
use recording::allan::{AllanPoint, CONFIDENCE};
use recording::noise::NoiseModel;

use super::Analysis;
use super::text::taken_off;

/// The Allan deviation with its intervals and the fitted model, as an SVG document; `None` without identified noise.
pub fn svg(analysis: &Analysis) -> Option<String> {
    let noise = analysis.noise.as_ref()?;
    let file = analysis.case.fingerprint.file.file_name().unwrap_or_default().to_string_lossy();
    let caption = format!("{file}; beside {}.", taken_off(noise));
    let title = format!("Allan deviation of the rate, {file}");
    let allan = Allan { points: &noise.allan, model: &noise.estimate.model, interval: noise.interval };
    Some(allan.figure("allan", title, caption)?.document())
}

/// An Allan deviation and the noise model that was fitted.
#[derive(Clone, Copy)]
pub(crate) struct Allan<'a> {
    pub(crate) points: &'a [AllanPoint],
    pub(crate) model: &'a NoiseModel,
    /// Interval of the rows \[s\].
    pub(crate) interval: f64,
}

impl<'a> Allan<'a> {
    /// Deviation, intervals and model; `None` where there is no deviation to draw.
    pub(crate) fn figure(self, id: &'static str, title: String, caption: String) -> Option<Figure<'a>> {
        self.points.iter().any(|point| point.deviation > 0.0).then(|| Figure {
            id,
            title,
            description:
                "Overlapping Allan deviation against averaging time, both axes logarithmic, between the ends of its 90 % \
                          intervals, and that of the fitted noise model."
                    .into(),
            caption,
            columns: 1,
            panels: vec![Panel::lines(
                Axis::logarithmic("averaging time [s]"),
                Axis::logarithmic("Allan deviation [°/h]"),
                24.0,
                vec![
                    self.curve(&format!("{:.0} % interval", 100.0 * CONFIDENCE), Style::Third, |_, point| point.low),
                    self.curve("", Style::Third, |_, point| point.high),
                    self.curve("fitted model", Style::Marked(1), |allan, point| {
                        allan.model.allan_deviation(point.tau, allan.interval)
                    }),
                    self.curve("recording", Style::Marked(0), |_, point| point.deviation),
                ],
            )],
        })
    }

    fn curve(self, name: &str, style: Style, of: fn(&Self, &AllanPoint) -> f64) -> Series<'a> {
        Series::new(name, style, self.points.iter().map(|point| (point.tau, of(&self, point))).collect())
    }
}
