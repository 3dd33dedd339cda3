//! The step after an answer.

use diagnosis::Verdict;
use files::{Note, Remark, shown};

use super::constants::Constant;
use super::text::MOST;
use super::{NOMINAL, Outcome};
use crate::table::significant;

/// The same from which nothing is said of what may hide behind it.
const SURE: f64 = 0.9;

/// Standard deviations from which a constant that moved is worth a word beside a mechanism that would do the same.
const MUCH: f64 = 2.0;

/// That a constant is far off what is known of it, as a part of a sentence.
fn far(constant: &Constant) -> Option<String> {
    let (name, moved) = (&constant.posterior.name, constant.moved());
    (moved.abs() > MUCH).then(|| format!("{name} would be {moved:+.1} standard deviations off what is known of it"))
}

impl Outcome<'_> {
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

    /// The step that a warning asks for; of a drawing with the word that is in doubt.
    fn remedy(&self, warning: &Note) -> String {
        let remedy = warning.remark.explanation().remedy;
        let word = self.other_drawing.as_ref().filter(|_| warning.remark == Remark::DoubtedDrawing);
        word.map_or_else(|| remedy.to_owned(), |word| format!("{remedy} The word is {word}."))
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

    /// What narrows tolerances beside another record; a lot's design has been narrowed.
    fn or_lot(&self) -> &'static str {
        if self.is_lots { "" } else { ", or a design of the lot (fogcoil calibrate)" }
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
