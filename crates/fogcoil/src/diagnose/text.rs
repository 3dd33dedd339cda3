//! The outcome for people.

use std::fmt::Write;

use bias::units::S_PER_H;
use diagnosis::{Estimate, Verdict};
use files::{Note, Remark, shown};
use mechanisms::{Extent, Naming, RATE as RATE_CHANNEL};

use super::apart::TOLD;
use super::constants::Constant;
use super::{NOMINAL, Outcome};
use crate::compose::StandIn;
use crate::table::{capital, significant, table};
use crate::units::parameter_unit;

/// Probability from which the design is said to suffice without more words.
const LIKELY: f64 = 0.65;

/// The same from which nothing is said of what may hide behind it.
const SURE: f64 = 0.9;

/// Standard deviations from which a constant that moved is worth a word beside a mechanism that would do the same.
const MUCH: f64 = 2.0;

/// That a constant is far off what is known of it, as a part of a sentence.
fn far(constant: &Constant) -> Option<String> {
    let (name, moved) = (&constant.posterior.name, constant.moved());
    (moved.abs() > MUCH).then(|| format!("{name} would be {moved:+.1} standard deviations off what is known of it"))
}

/// Constants that are told where none moved far, and mechanisms that are not far behind.
const MOST: usize = 3;

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

    /// The step that a warning asks for; of a drawing with the word that is in doubt.
    fn remedy(&self, warning: &Note) -> String {
        let remedy = warning.remark.explanation().remedy;
        let word = self.other_drawing.as_ref().filter(|_| warning.remark == Remark::DoubtedDrawing);
        word.map_or_else(|| remedy.to_owned(), |word| format!("{remedy} The word is {word}."))
    }

    /// The note of a kind, if there is one.
    fn warned(&self, remark: Remark) -> Option<&Note> {
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

    /// What narrows tolerances beside another record; a lot's design has been narrowed.
    fn or_lot(&self) -> &'static str {
        if self.is_lots { "" } else { ", or a design of the lot (fogcoil calibrate)" }
    }

    /// The step after this answer, where no two mechanisms are to be told apart.
    pub(super) fn next(&self) -> String {
        if let Some(warning) = self.misread() {
            return format!(
                "{} Then diagnose again: before that, nothing of this answer counts.",
                warning.remark.explanation().remedy
            );
        }
        let before = self.warned(Remark::DoubtedDrawing).map(|warning| (warning, "If it is as drawn"));
        match before.or_else(|| self.warned(Remark::FollowsColumn).map(|warning| (warning, "If that does not explain it"))) {
            Some((warning, otherwise)) => {
                format!("{} {otherwise}: {}", self.remedy(warning), self.next_as_drawn())
            }
            None => self.next_as_drawn(),
        }
    }

    /// The sentence that what was held out confirms `it`, as far as it does.
    fn confirmed(&self, it: &str) -> String {
        match self.far_in_held() {
            Some(over) => format!(
                "A record that was held out is predicted better by this explanation, but {} times the noise of its rate is left in it: the cause is confirmed, its size is not.",
                significant(over, 2)
            ),
            None if self.is_left_over() => {
                "A record that was held out is predicted better in its rate, but far more than noise is left of its thermometer: that is not explained.".into()
            }
            None => format!("A record that was held out confirms {it}."),
        }
    }

    /// The step after this answer if the unit is as it is drawn.
    fn next_as_drawn(&self) -> String {
        let proven = !self.holdouts.is_empty() && self.accepted();
        let another = "make a record of the same unit under another profile and give it with --holdout";
        if let Some((id, inspection)) = self.suspect() {
            // a second record that has not decided asks for no third one
            let several = self.fits.len() + self.holdouts.len() > 1;
            let or = if several { String::new() } else { format!("; or {another}") };
            return format!(
                "{id} is likelier than that the constants suffice, but not surely enough to be named. To decide: {inspection}{or}."
            );
        }
        if self.in_place_of_all().is_some() {
            let confirmed = if proven { format!(" {}", self.confirmed("the size of the effect")) } else { String::new() };
            return format!(
                "seek the cause among the known physics of the law's form; no mechanism with a name is likely, so no inspection for one is called \
                 for.{confirmed}"
            );
        }
        match self.diagnosis.verdict {
            Verdict::Unknown if self.warned(Remark::Gap).is_some() => {
                "repeat the profile without a gap, or give the rows before the gap alone (a file that ends there): the chamber turned within it, no reading \
                 tells how, and what is left may be of that and not of the unit."
                    .into()
            }
            Verdict::None | Verdict::Recalibrate
                if self.warned(Remark::Gap).is_none() && self.holdouts.iter().any(|held| self.reads_otherwise(held)) =>
            {
                "look at the thermometer of the record that was held out: the rate is as predicted, so it may have come off, or been moved. \
                 Empty its column, or record it again."
                    .into()
            }
            Verdict::None | Verdict::Recalibrate if self.is_left_over() => {
                "look at the record that was held out: it may be of another unit, or mounted otherwise. If it is of this one, give it with --fit, too."
                    .into()
            }
            Verdict::Explained if self.with_column().is_some() => {
                let (id, column) = self.with_column().unwrap_or_default();
                format!(
                    "inspect the unit for {}. These records do not exclude: {}. The law of {id} names the column {}, which no programme of the chamber tells: \
                     hold the temperature and change the quantity in that column alone.",
                    self.told_names().join(" and "),
                    self.others().join(", "),
                    shown(column)
                )
            }
            Verdict::Explained if proven => {
                let (names, several) = (self.told_names().join(" and "), self.told_names().len() > 1);
                let [is, it] = if several { ["are", "them"] } else { ["is", "it"] };
                match self.law_in_place() {
                    Some(_) if self.told_names().len() < self.names().len() => format!(
                        "inspect the unit for {names}. {} What acts beside {names} is best described by a law that nobody listed: seek its cause among \
                         the known physics of that form.",
                        self.confirmed("the size of the effect")
                    ),
                    Some(_) => format!(
                        "inspect the unit for {names}. {} It does not tell {names} from a law that nobody listed, which only the inspection does.",
                        self.confirmed("the size of the effect")
                    ),
                    None => format!("inspect the unit. Only {names} {is} left. {}{}", self.confirmed(it), self.second_fault()),
                }
            }
            Verdict::Explained if !self.holdouts.is_empty() => format!(
                "inspect the unit. What was held out does not confirm {}: if the inspection does not, {another}.",
                self.told_names().join(" and ")
            ),
            Verdict::Explained => {
                format!("inspect the unit; to confirm {} on data outside the fit, {another}.", self.told_names().join(" and "))
            }
            Verdict::None | Verdict::Recalibrate if self.is_close() => {
                let foremost = self.foremost();
                let [are, cheapest] = if foremost.len() > 1 { ["Not far behind are", "the inspection that costs least"] } else { ["Not far behind is", "this"] };
                let far = self.moved().first().and_then(far).map_or(String::new(), |far| format!("; {far}"));
                format!(
                    "{are} {}{far}. To decide, begin with {cheapest}; or give a record under another profile with --fit{}.",
                    foremost.join("; "),
                    self.or_lot()
                )
            }
            Verdict::None | Verdict::Recalibrate if !self.suffices_surely() => {
                format!(
                    "a small fault may hide behind the tolerances{}. A record under another profile, given with --fit{} may narrow them.",
                    self.hidden(),
                    self.or_lot()
                )
            }
            Verdict::Recalibrate if proven => {
                let hidden = self.hidden();
                let hidden = if hidden.is_empty() { hidden } else { format!(" A fault that is smaller than their tolerances may still hide behind them{hidden}.") };
                format!("the re-estimated constants predict a record that was held out, so no further test is called for.{hidden}")
            }
            Verdict::Recalibrate => format!("to confirm the re-estimated constants, {another}."),
            Verdict::Unknown if self.law().is_some() => {
                "the law predicts, but its form is no cause: seek the cause among the known physics of this form. --model-out FILE.ron keeps the law \
                 as a mechanism's file beside FILE.ron, for simulate and for the next diagnose (--mechanism)."
                    .into()
            }
            Verdict::Unknown => {
                let tried = if self.composed.is_none() { "No law that the program composes explains enough of it to be accepted. " } else { "" };
                format!(
                    "check signs, columns, units and times (fogcoil check), then repeat the same profile: a difference that does not return belongs to \
                     the test and not to the unit. {tried}Try a mechanism of your own with --mechanism."
                )
            }
            Verdict::None => "no test is needed to explain these records.".into(),
        }
    }

    /// A sentence on a constant of the design that is far off what is known of it beside the mechanisms of the answer.
    fn second_fault(&self) -> String {
        let constant = self.moved().into_iter().find(Constant::is_of_design);
        constant.as_ref().and_then(far).map_or(String::new(), |far| {
            let names = self.told_names().join(" and ");
            let imitated = self.imitated().map_or(String::new(), |other| format!("{other}, may look the same. Else "));
            format!(" Beside {names}, {far}: {imitated}measure it, too; a second, smaller fault may hide behind it.")
        })
    }

    /// Of several mechanisms that are left and that no chamber's programme tells apart, one whose law names a column of the records, with the column.
    fn with_column(&self) -> Option<(&str, &str)> {
        let others = self.others();
        let left = self.names().into_iter().chain(others.iter().copied());
        left.filter(|_| !others.is_empty()).find_map(|id| Some((id, self.column_of(id)?)))
    }

    /// The mechanism that is likelier than the constants, where these are the verdict all the same, and a check that decides about it.
    pub(super) fn suspect(&self) -> Option<(&str, &str)> {
        let d = &self.diagnosis;
        let [none, recalibrate, ..] = d.verdicts();
        let (first, probability) = *d.mechanisms.first()?;
        let constants = matches!(d.verdict, Verdict::None | Verdict::Recalibrate);
        let inspection = self.gyro.mechanism(first).facts().inspection()?;
        (constants && probability > none + recalibrate).then(|| (self.id(first), inspection))
    }

    /// Whether a mechanism is at least half as likely as that the design suffices.
    fn is_close(&self) -> bool {
        let [none, recalibrate, ..] = self.diagnosis.verdicts();
        let first = self.diagnosis.mechanisms.first().map_or(0.0, |(_, probability)| *probability);
        2.0 * first >= none + recalibrate && !self.foremost().is_empty()
    }

    /// The likeliest mechanisms and those half as likely, each with its probability and the check that decides about it.
    fn foremost(&self) -> Vec<String> {
        let first = self.diagnosis.mechanisms.first().map_or(0.0, |(_, probability)| *probability);
        let all = self.diagnosis.mechanisms.iter().filter(|(_, probability)| 2.0 * probability >= first);
        let told = all.filter_map(|&(m, probability)| {
            let inspection = self.gyro.mechanism(m).facts().inspection()?;
            Some(format!("{} (probability {probability:.2}): {inspection}", self.id(m)))
        });
        told.take(MOST).collect()
    }

    /// The likeliest mechanisms as the end of a sentence on what may hide, where the design does not suffice nearly surely.
    fn hidden(&self) -> String {
        let [none, recalibrate, ..] = self.diagnosis.verdicts();
        let foremost = self.foremost();
        if none + recalibrate > SURE || foremost.is_empty() {
            String::new()
        } else {
            format!(", most likely {}", foremost.join("; or "))
        }
    }

    /// Whether the design, or its constants, suffice for all records, and likely so.
    pub(super) fn stands_surely(&self) -> bool {
        self.suffices_surely() && !self.is_left_over() && self.withdrawn.is_empty()
    }

    fn suffices_surely(&self) -> bool {
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

    /// Mechanisms that the records do not exclude beside the likeliest, and the test that would decide.
    pub(super) fn alternatives(&self) -> Option<String> {
        let ids = self.apart();
        let command = (!ids.is_empty() && self.misread().is_none()).then(|| self.recommend(&ids))?;
        let before = self.warned(Remark::DoubtedDrawing).or_else(|| self.warned(Remark::FollowsColumn));
        let first = before.map_or(String::new(), |warning| format!("{} ", self.remedy(warning)));
        let others = self.others().join(", ");
        let sought = match ids.as_slice() {
            [other, nominal] if nominal == NOMINAL => format!("a test that shows whether {other} is at work, too"),
            _ => "a test that separates them".to_owned(),
        };
        let next = next_test(&sought, &command, self.sought.get());
        Some(format!("{first}These records do not exclude: {others}. {next}"))
    }
}

/// The command that seeks a test, with what it finds; what it finds alone where no test separates.
fn next_test(sought: &str, command: &str, found: Option<&(String, bool)>) -> String {
    match found {
        None => format!("This seeks {sought}: {command}"),
        Some((said, true)) => format!("This seeks {sought}: {command}\n  It finds: {said}"),
        Some((said, false)) => said.clone(),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_test_that_is_known_not_to_separate_is_not_sought() {
        let next = |found: Option<(String, bool)>| next_test("a test", "fogcoil recommend", found.as_ref());
        assert_eq!(next(None), "This seeks a test: fogcoil recommend");
        assert_eq!(next(Some(("A ramp.".into(), true))), "This seeks a test: fogcoil recommend\n  It finds: A ramp.");
        assert_eq!(next(Some(("No profile.".into(), false))), "No profile.");
    }
}
