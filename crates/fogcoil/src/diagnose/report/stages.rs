//! Stage of the chain in which the difference enters, and whether it is in single layers.

use charts::{Axis, Cells, Figure, Panel, Series, Style, grid, significant};
use diagnosis::{MemberResolution, Verdict};
use maud::{Markup, html};
use mechanisms::RATE;

use super::spectrum;
use crate::diagnose::Outcome;

/// Turns that a layer may be off by beforehand, 1σ: as the library's.
const TURNS: f64 = 3.0;
/// Largest gain of ln evidence that is told by its digits.
const MOST_TOLD: f64 = 1000.0;

/// A gain of ln evidence in words: beyond a thousand its digits say nothing.
fn gained(gain: f64) -> String {
    match gain {
        gain if gain.abs() < 0.05 => "0.0".into(),
        gain if gain > MOST_TOLD => format!("> {MOST_TOLD}"),
        gain => format!("{gain:.1}"),
    }
}

impl Outcome<'_> {
    pub(super) fn stages(&self) -> Markup {
        let stages = &self.diagnosis.stages;
        let row = |s: &diagnosis::Stage| {
            let white = s.whiteness.get(RATE).map_or(String::new(), |p| spectrum::judged(*p));
            vec![s.stage.clone(), gained(s.gain), white]
        };
        let rows: Vec<Vec<String>> = stages.iter().map(row).collect();
        let head = ["any smooth course put in at", "ln evidence gained", "rate's residual, Ljung–Box"];
        let restored = stages.iter().any(|s| s.whiteness.get(RATE).is_some_and(|p| *p >= spectrum::WHITE));
        let leads_white = stages.first().is_some_and(|s| s.whiteness.get(RATE).is_some_and(|p| *p >= spectrum::WHITE));
        let said = if matches!(self.diagnosis.verdict, Verdict::None | Verdict::Recalibrate) && self.stands_surely() {
            "Design, constants and instruments do the same here, and these records show no part at fault."
        } else if restored && !leads_white {
            "The part that gains most does not leave the rate's residual white: the difference is not one smooth course there."
        } else if restored {
            "Where several gain alike, this recording does not tell them apart."
        } else {
            "None leaves the rate's residual white: the difference is not what one smooth course makes, and the order of the parts says \
             nothing."
        };
        html! {
            @if !stages.is_empty() {
                h3 { "One smooth course at each part of the chain" } "\n"
                @if let Some(elsewhere) = self.elsewhere() { p { (elsewhere) } "\n" }
                (grid("What any smooth course at one part would follow: not the place of the fault", Cells::Words, &head, &rows))
                p {
                    "One course at a time, free but for being smooth, takes the place of every mechanism. It shows how much of the difference has the \
                     shape that this part gives; where the fault is, the mechanisms' probabilities say. " (said)
                } "\n"
            }
            (self.layers())
        }
    }

    /// A sentence on an explanation that acts elsewhere than where one flexible input gains most.
    fn elsewhere(&self) -> Option<String> {
        /// Probability below which the two speak of different parts of the chain.
        const FAR: f64 = 0.05;
        let stages = &self.diagnosis.stages;
        let first = stages.first().filter(|_| self.diagnosis.verdict == Verdict::Explained)?;
        let own = |name: &str| stages.iter().find(|s| s.stage == name && s.probability < FAR);
        let (id, own) = self.places().find_map(|(id, stage, _)| Some((id.to_owned(), own(stage)?)))?;
        Some(format!(
            "{id} acts in the part \"{}\". One smooth course there gains {} of ln evidence, in the part \"{}\" {} more. Such a course has not the law of a \
             mechanism: which mechanism it is, the table of probabilities above says; this one is no proof of it.",
            own.stage,
            gained(own.gain),
            first.stage,
            gained(first.gain - own.gain)
        ))
    }

    fn layers(&self) -> Markup {
        let records: Vec<usize> = (0..self.fits.len()).collect();
        let Ok(Some(found)) = self.diagnosis.mismatch.resolution(&self.gyro, &records, TURNS) else { return Markup::default() };
        let verdict = if found.locatable() {
            "some layers can be located"
        } else {
            "no single layer can be located by this recording: what is drawn is mostly the prior"
        };
        html! {
            (figure(&found).element())
            p {
                "The recording determines " (significant(found.combinations(), 2)) " combinations of " (found.values.len()) " layers: "
                (verdict) "."
            } "\n"
        }
    }
}

fn figure(found: &MemberResolution) -> Figure<'static> {
    let of = |value: &dyn Fn(usize) -> f64| -> Vec<(f64, f64)> {
        (0..found.values.len()).map(|k| ((k + 1) as f64, value(k))).collect()
    };
    let panel =
        |label: &str, series| Panel::lines(Axis::tight("layer, 1 = innermost", 1.0), Axis::round(label, 1e-3), 11.0, series);
    let (values, errors, resolved) = (&found.values, &found.errors, &found.resolved);
    let mut share = panel("share from the recording", vec![Series::new("", Style::First, of(&|k| resolved[k]))]);
    share.y.covers = Some([0.0, 1.0]);
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
                    Series::new("± 1σ", Style::Third, of(&|k| values[k] + errors[k])),
                    Series::new("", Style::Third, of(&|k| values[k] - errors[k])),
                    Series::new("most probable", Style::First, of(&|k| values[k])),
                ],
            ),
            share,
        ],
    }
}
