//! In which part of the chain the difference is, and whether in single layers.

use std::fmt::Write;

use diagnosis::Resolution;
use mechanisms::RATE;

use super::{line, spectrum};
use crate::diagnose::Outcome;
use crate::plot::{Axis, Content, Figure, Height, Panel, Style};
use crate::report::{Cells, grid, with_data};
use crate::table::significant;

/// Turns that a layer may be off by beforehand, 1σ: as the library's.
const TURNS: f64 = 3.0;

impl Outcome {
    pub(super) fn stages(&self, out: &mut String) {
        let stages = &self.diagnosis.stages;
        if !stages.is_empty() {
            let gain = |gain: f64| if gain.abs() < 0.05 { "0.0".into() } else { format!("{gain:.1}") };
            let rows: Vec<Vec<String>> = stages
                .iter()
                .map(|s| {
                    let white = s.whiteness.get(RATE).map_or(String::new(), |p| spectrum::judged(*p));
                    vec![s.stage.clone(), gain(s.gain), format!("{:.3}", s.probability), white]
                })
                .collect();
            out.push_str("<h3>Part of the chain</h3>\n");
            grid(
                out,
                "Parts of the chain compared",
                Cells::Words,
                &["flexible input at", "ln evidence gained", "probability", "rate's residual, Ljung–Box"],
                &rows,
            );
            let restored = stages.iter().any(|s| s.whiteness.get(RATE).is_some_and(|p| *p >= spectrum::WHITE));
            let said = if restored {
                "Where several gain alike, this recording does not tell them apart."
            } else {
                "None leaves the rate's residual white: the difference is not what one smooth input makes, and the probabilities compare \
                 stages that all fail."
            };
            let _ = writeln!(out, "<p>One flexible input at a time takes the place of every mechanism. {said}</p>");
        }
        self.layers(out);
    }

    fn layers(&self, out: &mut String) {
        let records: Vec<usize> = (0..self.fits.len()).collect();
        let Ok(Some(found)) = self.diagnosis.mismatch.resolution(&self.gyro, &records, TURNS) else { return };
        out.push_str(&with_data(&figure(&found)));
        let verdict = if found.locatable() {
            "some layers can be located"
        } else {
            "no single layer can be located by this recording: what is drawn is mostly the prior"
        };
        let _ = writeln!(
            out,
            "<p>The recording determines {} combinations of {} layers: {verdict}.</p>",
            significant(found.combinations(), 2),
            found.values.len()
        );
    }
}

fn figure(found: &Resolution) -> Figure<'static> {
    let of = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..found.values.len()).map(|k| ((k + 1) as f64, value(k))).collect()
    };
    let panel = |label: &str, series| Panel {
        heading: String::new(),
        x: Axis::tight("layer, 1 = innermost", 1.0),
        y: Axis::round(label, 1e-3),
        height: Height::Lines(11.0),
        content: Content::Lines(series),
    };
    let (values, errors, resolved) = (&found.values, &found.errors, &found.resolved);
    let mut share = panel("share from the recording", vec![line("", Style::First, of(&|k| resolved[k]))]);
    share.y = share.y.covering([0.0, 1.0]);
    Figure {
        id: "layers",
        title: "Layer by layer".into(),
        description:
            "Turns too many in each layer that would make the mismatch, with their standard deviations, and the diagonal of the \
                      resolution matrix."
                .into(),
        caption: format!(
            "All layers at once, each known to ± {TURNS} turns (1σ) beforehand. Share from the recording: diagonal of the resolution matrix, 1 where \
             it alone says how much, 0 where the prior does."
        ),
        columns: 2,
        panels: vec![
            panel(
                "turns too many",
                vec![
                    line("± 1σ", Style::Third, of(&|k| values[k] + errors[k])),
                    line("", Style::Third, of(&|k| values[k] - errors[k])),
                    line("most probable", Style::First, of(&|k| values[k])),
                ],
            ),
            share,
        ],
    }
}
