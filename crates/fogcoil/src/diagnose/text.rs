//! The outcome for people.

use std::fmt::Write;

use bias::units::S_PER_H;
use diagnosis::{Estimate, Verdict};
use files::{Note, Remark};
use mechanisms::{Extent, Naming, RATE as RATE_CHANNEL};

use super::apart::TOLD;
use super::constants::Constant;
use super::{NOMINAL, Outcome};
use crate::compose::StandIn;
use crate::table::{capital, significant, table};
use crate::units::parameter_unit;

/// Probability from which the design is said to suffice without more words.
const LIKELY: f64 = 0.65;

/// Constants that are told where none moved far, and mechanisms that are not far behind.
pub(super) const MOST: usize = 3;

impl Outcome<'_> {
    /// For people: verdict, place, alternatives, parameters, held-out errors.
    pub fn text(&self) -> String {
        let d = &self.diagnosis;
        let mut out = String::new();
        for warning in self.notes.iter().filter(|note| note.is_warning()) {
            let _ = writeln!(out, "{warning}");
        }
        out.push_str(&self.verdict());
        out.push('\n');
        if d.verdict == Verdict::Explained {
            let named = self.told_names();
            let best = self.places().zip(&d.best().fit.active);
            for ((id, stage, extent), active) in best.filter(|((id, ..), _)| named.contains(id)) {
                let _ = writeln!(out, "{id}: {}.", place(stage, &extent));
                if let Naming::Named { meaning, inspection } = self.gyro.mechanism(active.mechanism).facts().naming {
                    let _ = writeln!(out, "  Meaning: {meaning}.\n  Inspection: {inspection}.");
                }
            }
            if let Some((id, inspection)) = self.first_elsewhere() {
                let _ = writeln!(out, "{id}, by many choices together:\n  Inspection: {inspection}.");
            }
            if let Some(structure) = self.structure() {
                let _ = writeln!(out, "Besides, {structure}.");
            }
            self.doubts().iter().for_each(|doubt| out += &format!("{doubt}\n"));
        }
        if let Some(late) = self.late() {
            let _ = writeln!(out, "{late}");
        }
        if self.holdouts.is_empty() && d.verdict != Verdict::None {
            out.push_str("No record was held out, so the result is not proven on data outside the fit (--holdout).\n");
        }
        let composed = self.composed.as_ref().map(|composed| composed.text());
        if let Some((law, _)) = &composed {
            out.push_str(law);
        }
        if let Some(nearest) = self.nearest_named() {
            let _ = writeln!(out, "Nearest named mechanism: {nearest}.");
        }
        match self.alternatives() {
            Some(alternatives) => {
                out += &format!("{alternatives}\n");
                for other in self.others() {
                    if let Some(inspection) = self.inspection(other) {
                        let _ = writeln!(out, "  Or inspect, for {other}: {inspection}.");
                    }
                }
            }
            None if d.verdict != Verdict::None || self.misread().is_some() => out += &format!("Next: {}\n", self.next()),
            None => {}
        }
        for text in self.stand_ins.iter().filter_map(StandIn::text) {
            let _ = writeln!(out, "{text}");
        }
        // of the third column, the units, the heading says nothing
        let line = |name: &str, value: String, unit: &str| vec![name.to_owned(), value, unit.to_owned(), String::new()];
        let mut rows = vec![line("explanation", "probability".into(), "")];
        rows.extend(self.explanations().iter().map(|e| line(&e.said(), format!("{:.3}", e.probability), "")));
        let is_named = d.verdict == Verdict::Explained && self.in_place_of_all().is_none();
        let explained = d.parameters.iter().flatten().filter(|_| is_named);
        let estimates: Vec<&Estimate> = explained.chain(composed.iter().flat_map(|(_, estimates)| estimates)).collect();
        if !estimates.is_empty() {
            rows.push(["parameter (fitted)", "value", "", "90 % interval"].map(str::to_owned).to_vec());
            for estimate in estimates {
                let (value, ends) = self.told(estimate, 4);
                let unit = parameter_unit(&estimate.name);
                let unit = if unit == "1" { "-".into() } else { unit.into_owned() };
                rows.push(vec![estimate.name.clone(), value, unit, ends.join(" to ")]);
            }
        }
        rows.extend(self.moved_rows());
        for held in &self.holdouts {
            let file = held.record.name();
            rows.push(line(&format!("held-out record {file}"), "rms, deg/h".into(), ""));
            rows.push(line(&format!("  {NOMINAL}"), significant(held.nominal.rmse[RATE_CHANNEL], 3), ""));
            if let Some(name) = self.fitted(held) {
                rows.push(line(&format!("  {name}"), significant(held.model.rmse[RATE_CHANNEL], 3), ""));
            }
            rows.push(line("  noise as identified", significant(held.model.noise_floor[RATE_CHANNEL], 3), ""));
            if let Some(([nominal, model], name)) = self.thermometer(held).zip(self.found()) {
                rows.push(line(&format!("  thermometer, {NOMINAL}"), significant(nominal, 3), "K"));
                rows.push(line(&format!("  thermometer, {name}"), significant(model, 3), "K"));
            }
            if !held.accepted && d.verdict != Verdict::None {
                rows.push(line("  the fitted model is worse here: not accepted", String::new(), ""));
            }
        }
        out.push_str(&table(&rows));
        if self.likely().next().is_some() {
            out.push_str(
                "(The probability of a mechanism is the probability that it takes part, alone or with others, so the numbers may add up to more \
                 than 1. Something without a name may act alone or together with a named mechanism.)\n",
            );
        }
        out
    }

    /// The constants that moved, below their head: value, standard deviations of what was known, 90 % interval. None where nothing explains the records.
    pub(super) fn moved_rows(&self) -> Vec<Vec<String>> {
        let suffices = self.diagnosis.verdict != Verdict::Unknown || self.law_name().is_some();
        let mut moved = if suffices { self.moved() } else { Vec::new() };
        let mut head = "constant that moved (fitted)";
        if moved.is_empty() && self.diagnosis.verdict == Verdict::Recalibrate {
            (moved, head) = (self.constants(), "none moved far; most of all (fitted)");
            moved.sort_by(|a, b| b.moved().abs().total_cmp(&a.moved().abs()));
            moved.truncate(MOST);
        }
        let row = |constant: &Constant| {
            let p = &constant.posterior;
            let interval = p.ci90().map(|end| significant(end, 4)).join(" to ");
            vec![p.name.clone(), significant(p.value(), 4), format!("{:+.1}", constant.moved()), interval]
        };
        let head = [head, "value", "sigma", "90 % interval"].map(str::to_owned).to_vec();
        let all = moved.iter().map(row);
        if moved.is_empty() { Vec::new() } else { std::iter::once(head).chain(all).collect() }
    }

    pub(super) fn verdict(&self) -> String {
        match self.misread() {
            Some(warning) => {
                let mistake = match warning.remark {
                    Remark::LooseThermometer => "the spool's thermometer came loose",
                    Remark::ChamberJump => "the chamber's readings jumped and not the air",
                    Remark::ReversedRate => "the rate has the other sign",
                    Remark::RateUnit => "the rate is in another unit",
                    _ => "a column is read wrongly",
                };
                format!("Void if {mistake}, as it seems. As it is read: {}", self.verdict_as_read())
            }
            None if self.warned(Remark::DoubtedDrawing).is_some() => {
                format!(
                    "Either the unit differs from its drawing in one word, as the warning says, or this. {}",
                    self.verdict_as_read()
                )
            }
            None if self.warned(Remark::FollowsColumn).is_some() => format!(
                "The rate follows a column that the model does not use, as the warning says. Without that column: {}",
                self.verdict_as_read()
            ),
            None => self.verdict_as_read(),
        }
    }

    /// The warning that a record seems to have columns exchanged, a loose thermometer, a chamber whose readings jumped or its rate negated or in another unit, if there is one.
    pub(super) fn misread(&self) -> Option<&Note> {
        self.notes.iter().find(|note| note.remark.voids())
    }

    /// The note of a kind, if there is one.
    pub(super) fn warned(&self, remark: Remark) -> Option<&Note> {
        self.notes.iter().find(|note| note.remark == remark)
    }

    fn verdict_as_read(&self) -> String {
        match self.diagnosis.verdict {
            Verdict::None if !self.withdrawn.is_empty() => {
                "The explanation of the fitted records is taken back: the nominal model predicts the record that was held out.".to_owned()
            }
            Verdict::None => self.suffices("the nominal model suffices", "no difference beyond noise"),
            Verdict::Recalibrate if self.drawing_stands() => self.suffices(
                "the instruments, recalibrated within what is known of them, suffice",
                "these records show no other departure from the drawing",
            ),
            Verdict::Recalibrate => {
                self.suffices("the design's own constants, re-estimated within their tolerances, suffice", "these records show nothing that is left out")
            }
            Verdict::Explained => format!("The recording differs from the design. {}.", self.likeliest()),
            Verdict::Unknown if !self.withdrawn.is_empty() && self.law().is_none() => {
                "The explanation of the fitted records is taken back: a record that was held out contradicts it. The cause is unknown."
                    .to_owned()
            }
            // the law that predicts says more of its form than what the residual looks like
            Verdict::Unknown if self.law().is_some() => {
                "The recording differs from the design in a way that nothing in the library explains; a law that was composed predicts it."
                    .to_owned()
            }
            Verdict::Unknown => {
                let structure = self.structure().map_or(String::new(), |structure| format!(": {structure}"));
                format!("The recording differs from the design in a way that nothing in the library explains{structure}.")
            }
        }
    }

    /// The likeliest explanation, how likely it is, and a law that does the same.
    fn likeliest(&self) -> String {
        if let Some(law) = self.in_place_of_all() {
            return format!("Most likely: a law that nobody listed (probability {:.3}): {}", law.taken, law.said());
        }
        let (best, first) = (self.names(), self.diagnosis.mechanisms.first().map_or("", |(m, _)| self.id(*m)));
        let sure = |id: &str| format!("{id} (probability {:.3})", self.probability(id).unwrap_or(0.0));
        let unlikely = |id: &str| self.probability(id).is_none_or(|p| p < 0.5);
        let several =
            !self.others().is_empty() && (unlikely(first) || best.contains(&first) && best.iter().any(|id| unlikely(id)));
        let lead = if several { "Likeliest of several" } else { "Most likely" };
        if !best.contains(&first) {
            // many choices of one mechanism together outweigh the best single hypothesis
            return format!("{lead}: {}; the best single hypothesis: {}", sure(first), best.join(" and "));
        }
        let told = self.told_names();
        let named = told.iter().map(|id| sure(id)).collect::<Vec<_>>().join(" and ");
        match self.law_in_place().filter(|p| *p >= TOLD) {
            Some(p) if told.len() < best.len() => {
                format!("{lead}: {named}, and beside it a law that nobody listed (probability {p:.3})")
            }
            Some(p) if best.iter().all(|id| Some(p) > self.probability(id)) => {
                format!("Either {named}, or a law that nobody listed and that does the same (probability {p:.3})")
            }
            Some(p) => format!("{lead}: {named}, or a law that nobody listed and that does the same (probability {p:.3})"),
            None => format!("{lead}: {named}"),
        }
    }

    /// Of what is unknown the best description by mechanisms with a name, with their parameters.
    pub(super) fn nearest_named(&self) -> Option<String> {
        let best = self.best_named().filter(|_| self.diagnosis.verdict == Verdict::Unknown)?;
        let ids: Vec<&str> = best.fit.active.iter().map(|a| self.id(a.mechanism)).collect();
        let values = (0..ids.len()).flat_map(|place| best.fit.estimates(&self.gyro, place));
        let values: Vec<String> = values.map(|e| format!("{} = {}", e.name, self.told(&e, 4).0)).collect();
        Some(format!("{} ({})", ids.join(" and "), values.join(", ")))
    }

    /// Ids of the best candidate's mechanisms, without those whose place a law took beside others: nobody should look for these.
    pub(super) fn told_names(&self) -> Vec<&str> {
        let names = self.names();
        let told: Vec<&str> = names.iter().copied().filter(|id| !self.is_displaced(id)).collect();
        if told.is_empty() && self.in_place_of_all().is_none() { names } else { told }
    }

    /// Whether a law took the place of a mechanism.
    fn is_displaced(&self, id: &str) -> bool {
        let by_law = self.stand_ins.iter().any(|stand_in| stand_in.is_near() && stand_in.of == id);
        by_law && self.probability(id).is_none_or(|p| p < TOLD)
    }

    /// The law that takes the place of everything that was named, where no other mechanism is likely either: nobody should look for these.
    pub(super) fn in_place_of_all(&self) -> Option<&StandIn> {
        let explained = self.diagnosis.verdict == Verdict::Explained && self.names().iter().all(|id| self.is_displaced(id));
        let likely = self.likely().any(|(_, probability)| probability >= TOLD);
        let near = self.stand_ins.iter().filter(|stand_in| stand_in.is_near() && explained && !likely);
        near.max_by(|a, b| a.taken.total_cmp(&b.taken))
    }

    /// The likeliest mechanism and a check that decides about it, where it is not part of the best single hypothesis.
    fn first_elsewhere(&self) -> Option<(&str, &str)> {
        let id = self.id(self.diagnosis.mechanisms.first().filter(|_| self.in_place_of_all().is_none())?.0);
        self.inspection(id).filter(|_| !self.names().contains(&id)).map(|inspection| (id, inspection))
    }

    /// Probability of a mechanism, if it is worth saying.
    fn probability(&self, id: &str) -> Option<f64> {
        self.likely().find(|(name, _)| *name == id).map(|(_, probability)| probability)
    }

    /// Whether the design, or its constants, suffice for all records, and likely so.
    pub(super) fn stands_surely(&self) -> bool {
        self.suffices_surely() && !self.is_left_over() && self.withdrawn.is_empty()
    }

    pub(super) fn suffices_surely(&self) -> bool {
        let [none, recalibrate, ..] = self.diagnosis.verdicts();
        none + recalibrate >= LIKELY
    }

    /// The statement that the design suffices: `surely` where it is likely, and no held-out record is far from its noise; open where it is less likely than
    /// not.
    fn suffices(&self, statement: &str, surely: &str) -> String {
        let [none, recalibrate, ..] = self.diagnosis.verdicts();
        let probability = none + recalibrate;
        // as the table has them, where its first row says another number
        let parts = if none.min(recalibrate) < 0.05 {
            String::new()
        } else {
            format!(": {none:.2} as drawn, {recalibrate:.2} within tolerances")
        };
        let sentence = capital(statement);
        if self.is_left_over() && self.warned(Remark::FitLeft).is_some() {
            "Something is unexplained, and nothing that was weighed is likelier than the design without it: far more than noise is left of the fitted records, and of one that was held out.".into()
        } else if self.is_left_over() {
            format!("{sentence} for the fitted records, but a record that was held out is left with far more than noise.")
        } else if self.is_open() {
            format!(
                "It is open whether {statement} (probability {probability:.2}{parts}): no other explanation is strong enough to be named."
            )
        } else if !self.suffices_surely() {
            format!("{sentence}, but not surely (probability {probability:.2}{parts}).")
        } else {
            format!("{sentence} (probability {probability:.2}{parts}): {surely}.")
        }
    }

    /// Whether nothing is likelier than not: the design is the answer for want of another.
    pub(super) fn is_open(&self) -> bool {
        let [none, recalibrate, ..] = self.diagnosis.verdicts();
        matches!(self.diagnosis.verdict, Verdict::None | Verdict::Recalibrate) && none + recalibrate < 0.5
    }
}

/// Place of the difference: stage of the chain, temperatures, layers, time.
pub(super) fn place(stage: &str, extent: &Extent) -> String {
    let mut place = format!("part of the chain: {stage}");
    if let Some([low, high]) = extent.temperature {
        let _ = write!(place, ", at a coil temperature between {} and {} degC", significant(low, 3), significant(high, 3));
    }
    if let Some([low, high]) = extent.layers {
        let _ = if low == high { write!(place, ", layer {low}") } else { write!(place, ", layers {low} to {high}") };
    }
    if let Some([from, to]) = extent.time {
        let _ = write!(place, ", from {} to {} h", significant(from / S_PER_H, 3), significant(to / S_PER_H, 3));
    }
    place
}
