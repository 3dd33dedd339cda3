//! The outcome for people.

use std::fmt::Write;

use bias::units::S_PER_H;
use diagnosis::Verdict;
use mechanisms::{Located, RATE as RATE_CHANNEL};

use super::meaning::meaning;
use super::record::WARNING;
use super::{NOMINAL, Outcome};
use crate::recommend::inspection;
use crate::table::{significant, table};

impl Outcome {
    /// For people: verdict, place, alternatives, parameters, held-out errors.
    pub fn text(&self) -> String {
        let d = &self.diagnosis;
        let mut out = String::new();
        for warning in self.notes.iter().filter(|note| note.starts_with(WARNING)) {
            let _ = writeln!(out, "{warning}");
        }
        out.push_str(&self.verdict());
        out.push('\n');
        if d.verdict == Verdict::Explained {
            for (n, active) in d.best().fit.active.iter().enumerate() {
                let id = self.id(active.mechanism);
                let _ = writeln!(out, "{id}: {}.", place(&self.gyro.located(active, d.choice(n))));
                if let Some(meaning) = meaning(id) {
                    let _ = writeln!(out, "  What it is: {meaning}.");
                }
                if let Some(inspection) = inspection(id) {
                    let _ = writeln!(out, "  What would show it: {inspection}.");
                }
            }
            if let Some(structure) = self.structure() {
                let _ = writeln!(out, "Besides, {structure}.");
            }
        }
        if d.verdict == Verdict::Unknown {
            out.push_str("What to do: check signs, columns, units and times (fogcoil check), then repeat the test under another profile.\n");
        }
        if let Some(alternatives) = self.alternatives() {
            let _ = writeln!(out, "{alternatives}");
        }
        let mut rows = vec![vec!["explanation".to_owned(), "probability".to_owned(), String::new()]];
        rows.extend(self.explanations().iter().map(|e| vec![e.name.to_owned(), format!("{:.3}", e.probability), String::new()]));
        if d.verdict == Verdict::Explained {
            rows.push(vec!["parameter (fitted)".to_owned(), "value".to_owned(), "90 % interval".to_owned()]);
            for estimate in d.parameters.iter().flatten() {
                let interval = estimate.ci90.map(|end| significant(end, 4)).join(" to ");
                rows.push(vec![estimate.name.clone(), significant(estimate.value, 4), interval]);
            }
        }
        for held in &self.holdouts {
            let file = held.record.name();
            rows.push(vec![format!("held-out record {file}"), "rms, deg/h".to_owned(), String::new()]);
            rows.push(vec![format!("  {NOMINAL}"), significant(held.nominal.rmse[RATE_CHANNEL], 3), String::new()]);
            if let Some(name) = self.found() {
                rows.push(vec![format!("  {name}"), significant(held.model.rmse[RATE_CHANNEL], 3), String::new()]);
            }
            let floor = significant(held.model.noise_floor[RATE_CHANNEL], 3);
            rows.push(vec!["  noise as identified".to_owned(), floor, String::new()]);
            if let Some(([nominal, model], name)) = self.thermometer(held).zip(self.found()) {
                rows.push(vec![format!("  thermometer, {NOMINAL}"), significant(nominal, 3), "K".to_owned()]);
                rows.push(vec![format!("  thermometer, {name}"), significant(model, 3), "K".to_owned()]);
            }
            if !held.accepted && d.verdict != Verdict::None {
                rows.push(vec!["  what was fitted is worse here: not accepted".to_owned(), String::new(), String::new()]);
            }
        }
        out.push_str(&table(&rows));
        out
    }

    /// In a sentence.
    pub(super) fn verdict(&self) -> String {
        match self.diagnosis.verdict {
            Verdict::None => "The nominal model suffices: no difference beyond noise.".to_owned(),
            Verdict::Recalibrate => "The design's own constants, re-estimated within their uncertainties, suffice.".to_owned(),
            Verdict::Explained => {
                let (best, first) = (self.names(), self.diagnosis.mechanisms.first().map_or("", |(m, _)| self.id(*m)));
                let all = best.join(" and ");
                if best.contains(&first) {
                    format!("The recording differs from the design. Most likely: {all}.")
                } else {
                    // many choices of one mechanism together outweigh the best single hypothesis
                    format!("The recording differs from the design. Most likely: {first}; the best single hypothesis: {all}.")
                }
            }
            Verdict::Unknown => {
                let structure = self.structure().map_or(String::new(), |structure| format!(": {structure}"));
                format!("The recording differs from the design in a way that nothing in the library explains{structure}.")
            }
        }
    }

    /// What the records do not exclude beside what is most likely, and what would tell.
    pub(super) fn alternatives(&self) -> Option<String> {
        let ids = self.apart();
        let command = (!ids.is_empty()).then(|| self.recommend(&ids))?;
        Some(format!("These records do not exclude: {}. What would tell: {command}", self.others().join(", ")))
    }
}

/// Where in the chain, at which temperatures, in which layers, when.
pub(super) fn place(located: &Located) -> String {
    let mut place = format!("part of the chain: {}", located.stage);
    if let Some([low, high]) = located.temperature {
        let _ = write!(place, ", at a coil temperature between {} and {} degC", significant(low, 3), significant(high, 3));
    }
    if let Some([low, high]) = located.layers {
        let _ = if low == high { write!(place, ", layer {low}") } else { write!(place, ", layers {low} to {high}") };
    }
    if let Some([from, to]) = located.time {
        let _ = write!(place, ", from {} to {} h", significant(from / S_PER_H, 3), significant(to / S_PER_H, 3));
    }
    place
}
