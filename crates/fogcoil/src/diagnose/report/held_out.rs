//! The proof: a record that was not fitted.

use diagnosis::{HeldOut, Verdict, whiteness};
use mechanisms::RATE;

use super::multiples::multiples;
use super::{course, line, spectrum};
use crate::diagnose::{Held, NOMINAL, Outcome};
use crate::plot::{Figure, Panel, Style};
use crate::report::{Cells, grid, with_data};
use crate::table::significant;

impl Outcome {
    pub(super) fn held_out(&self, out: &mut String) {
        if self.holdouts.is_empty() {
            return;
        }
        out.push_str("<h2>Proof on a record that was held out</h2>\n");
        let mut rows = Vec::new();
        for held in &self.holdouts {
            for (name, prediction) in self.predictions(held) {
                let white = judged(self, held, prediction);
                rows.push(vec![
                    format!("{}: {name}", held.record.name()),
                    significant(prediction.rmse[RATE], 3),
                    significant(prediction.noise_floor[RATE], 3),
                    white,
                ]);
            }
        }
        let caption = "Errors of the predictions of the rate";
        grid(
            out,
            caption,
            Cells::Words,
            &["prediction", "rms error [°/h]", "noise as identified [°/h]", "Ljung–Box, 30 lags"],
            &rows,
        );
        let said = if self.diagnosis.verdict == Verdict::None {
            "No effect was found, so the nominal model is the prediction."
        } else if self.holdouts.iter().any(|held| !held.accepted) {
            "What was fitted predicts a held-out record worse than the nominal model: it is not accepted."
        } else {
            "Nothing was adjusted to a held-out record, its offset neither: it is that of the first record that was fitted."
        };
        out.push_str(&format!("<p>{said}</p>\n"));
        out.push_str(&with_data(&self.proof()));
    }

    /// What is shown of a held-out record: the nominal model and what was found, where that is another.
    fn predictions<'a>(&self, held: &'a Held) -> Vec<(&'static str, &'a HeldOut)> {
        let found = self.found().map(|name| (name, &held.model));
        [(NOMINAL, &held.nominal)].into_iter().chain(found).collect()
    }

    fn proof(&self) -> Figure<'static> {
        let (columns, panels) = multiples(self.holdouts.iter().map(|held| self.panels(held)).collect());
        let whose = match &self.holdouts[..] {
            [one] => one.record.name(),
            several => format!("{} records", several.len()),
        };
        Figure {
            id: "held-out",
            title: format!("{whose}: predicted and recorded"),
            description: "The held-out record's rate over time with its predictions, and what each prediction is off by.".into(),
            caption: "Driven by the record's own chamber temperature; the offset is that of the fit.".into(),
            columns,
            panels,
        }
    }

    /// One record's panels.
    fn panels(&self, held: &Held) -> Vec<Panel<'static>> {
        let (clock, time) = (self.clock(&held.record), &held.record.observed.time);
        let recorded = &held.record.observed.channels[RATE];
        let rows = |of: &dyn Fn(usize, f64) -> f64| -> Vec<(f64, f64)> {
            let used = (0..time.len()).filter(|n| recorded[*n].is_finite());
            used.map(|n| (clock.at(time[n]), of(n, recorded[n]))).collect()
        };
        let predictions = self.predictions(held);
        let mut both = vec![line("recording", Style::Fine(2), rows(&|_, y| y))];
        let mut panels = Vec::new();
        for (n, (name, held)) in predictions.iter().enumerate() {
            let predicted = &held.prediction[RATE];
            let last = n + 1 == predictions.len();
            both.push(line(*name, if last { Style::Second } else { Style::Third }, rows(&|n, _| predicted[n])));
            let style = if last { Style::Fine(2) } else { Style::Fine(0) };
            let mut panel = course::panel(&clock, "rate [°/h]", 1e-4, 9.0, vec![line("", style, rows(&|n, y| y - predicted[n]))]);
            panel.heading = format!("recorded less {name}");
            panels.push(panel);
        }
        // both differences on one scale
        let most = predictions.iter().flat_map(|(_, held)| rows(&|n, y| (y - held.prediction[RATE][n]).abs()));
        let most = most.fold(0.0, |most: f64, (_, r)| most.max(r));
        panels.iter_mut().for_each(|panel| panel.y.covers = Some([-most, most]));
        panels.insert(0, course::panel(&clock, "rate [°/h]", 1e-4, 16.0, both));
        if self.holdouts.len() > 1 {
            panels[0].heading = held.record.name();
        }
        course::label_last(&mut panels, &clock);
        panels
    }
}

/// Whiteness of what a prediction leaves, whatever its offset.
fn judged(outcome: &Outcome, held: &Held, prediction: &HeldOut) -> String {
    let observed = &held.record.observed;
    let residual: Vec<f64> = observed.channels[RATE].iter().zip(&prediction.prediction[RATE]).map(|(y, p)| y - p).collect();
    let used: Vec<f64> = residual.iter().copied().filter(|r| r.is_finite()).collect();
    let mean = used.iter().sum::<f64>() / (used.len() as f64).max(1.0);
    let centred: Vec<f64> = residual.iter().map(|r| r - mean).collect();
    spectrum::judged(whiteness(&outcome.diagnosis.best().fit.whiten(RATE, observed, &centred)))
}
