//! The proof: a record that was not fitted.

use charts::{Cells, Figure, Panel, Series, Style, grid, significant};
use diagnosis::{HeldOut, Verdict, whiteness};
use maud::{Markup, html};
use mechanisms::{RATE, SPOOL};

use super::course::{self, multiples};
use super::spectrum;
use crate::diagnose::{Held, NOMINAL, Outcome};

/// Meaning of the errors of a prediction.
const ABOUT: &str = "Errors are about the mean of the record where a channel's offset may be anything; the prediction itself, in the figure and by \
                     --prediction, has the offset of the first fitted record.";

impl Outcome<'_> {
    pub(super) fn held_out(&self) -> Markup {
        let all = self.holdouts.iter().flat_map(|held| self.predictions(held).into_iter().map(move |shown| (held, shown)));
        let row = |(held, (name, prediction)): (&Held, (&str, &HeldOut))| {
            vec![
                format!("{}: {name}", held.record.name()),
                significant(prediction.rmse[RATE], 3),
                significant(prediction.noise_floor[RATE], 3),
                judged(self, held, prediction),
                if self.thermometer(held).is_some() { significant(prediction.rmse[SPOOL], 3) } else { "–".into() },
            ]
        };
        let rows: Vec<Vec<String>> = all.map(row).collect();
        let head =
            ["prediction", "rms error [°/h]", "noise as identified [°/h]", "Ljung–Box, 30 lags", "thermometer, rms error [K]"];
        let said = if self.holdouts.iter().any(|held| !held.accepted) {
            "What was fitted predicts a held-out record worse than the nominal model: it is not accepted."
        } else if self.diagnosis.verdict == Verdict::None {
            "No effect was found: the prediction is that of the design as drawn, with the instruments as the fitted records tell them."
        } else {
            "No parameter was adjusted to a held-out record."
        };
        html! {
            (grid("Errors of the predictions", Cells::Words, &head, &rows))
            p { (said) " " (ABOUT) } "\n"
            (self.proof().element())
        }
    }

    /// Predictions of a held-out record that are shown: the nominal model's, and the found model's where it is another.
    fn predictions<'a>(&self, held: &'a Held) -> Vec<(&'static str, &'a HeldOut)> {
        let found = self.fitted(held).map(|name| (name, &held.model));
        [(NOMINAL, &held.nominal)].into_iter().chain(found).collect()
    }

    fn proof(&self) -> Figure<'static> {
        let (columns, panels) = multiples(self.holdouts.iter().map(|held| self.panels(held)).collect());
        let records: Vec<_> = self.holdouts.iter().map(|held| &held.record).collect();
        Figure {
            id: "held-out",
            title: format!("{}: predicted and recorded", course::whose(&records)),
            description: "The held-out record's rate over time with its predictions, and what each prediction is off by.".into(),
            caption: "Driven by the record's own chamber temperature; the offset is that of the fit.".into(),
            columns,
            panels,
        }
    }

    fn panels(&self, held: &Held) -> Vec<Panel<'static>> {
        let (clock, observed) = (self.clock(&held.record), &held.record.observed);
        let recorded: Vec<(usize, f64)> =
            observed.channels[RATE].iter().copied().enumerate().filter(|(_, y)| y.is_finite()).collect();
        let rows = |of: &dyn Fn(usize, f64) -> f64| -> Vec<(f64, f64)> {
            recorded.iter().map(|(n, y)| (clock.at(observed.time[*n]), of(*n, *y))).collect()
        };
        let predictions = self.predictions(held);
        let mut both = vec![Series::new("recording", Style::Fine(2), rows(&|_, y| y))];
        let (mut panels, mut most) = (Vec::new(), 0.0_f64);
        for (n, (name, held)) in predictions.iter().enumerate() {
            let predicted = &held.prediction[RATE];
            let [style, of_left] =
                if n + 1 == predictions.len() { [Style::Second, Style::Fine(2)] } else { [Style::Third, Style::Fine(0)] };
            both.push(Series::new(*name, style, rows(&|n, _| predicted[n])));
            let left = rows(&|n, y| y - predicted[n]);
            most = left.iter().fold(most, |most, (_, r)| most.max(r.abs()));
            let left = vec![Series::new("", of_left, left)];
            panels.push(course::panel(&clock, "rate [°/h]", 1e-4, 9.0, left).headed(format!("recorded less {name}")));
        }
        // both differences on one scale
        panels.iter_mut().for_each(|panel| panel.y.covers = Some([-most, most]));
        let name = if self.holdouts.len() > 1 { held.record.name() } else { String::new() };
        panels.insert(0, course::panel(&clock, "rate [°/h]", 1e-4, 16.0, both).headed(name));
        course::label_last(&mut panels, &clock);
        panels
    }
}

/// Whiteness of what a prediction leaves, whatever its offset.
fn judged(outcome: &Outcome<'_>, held: &Held, prediction: &HeldOut) -> String {
    let observed = &held.record.observed;
    let residual: Vec<f64> = observed.channels[RATE].iter().zip(&prediction.prediction[RATE]).map(|(y, p)| y - p).collect();
    let used: Vec<f64> = residual.iter().copied().filter(|r| r.is_finite()).collect();
    let mean = used.iter().sum::<f64>() / (used.len() as f64).max(1.0);
    let centred: Vec<f64> = residual.iter().map(|r| r - mean).collect();
    spectrum::judged(whiteness(&outcome.leading().whiten(RATE, observed, &centred)))
}
