//! Explanations that the records leave to be told apart, with their probabilities.

use std::path::{Path, PathBuf};

use coil::Mechanics;
use diagnosis::{Active, Candidate, ForwardModel, Verdict};
use mechanisms::CATALOGUE;

use super::Outcome;

/// Most ids that one test is asked to tell apart.
const MOST: usize = 3;

/// Most mechanisms whose probability is shown, and the probability below which none is.
const SHOWN: usize = 6;
const NEGLIGIBLE: f64 = 5e-4;
/// Least probability that is told beside the answer.
pub(super) const TOLD: f64 = 0.05;

/// Name of the design as it is among ids to be told apart.
pub(super) const NOMINAL: &str = "nominal";

/// A row of the table of probabilities.
pub(super) struct Explanation<'a> {
    pub(super) name: &'a str,
    pub(super) probability: f64,
    /// whether the records do not exclude it
    pub(super) open: bool,
    /// whether a record that was held out took it back
    pub(super) withdrawn: bool,
}

impl Explanation<'_> {
    /// Its name, with a word if it was taken back.
    pub(super) fn said(&self) -> String {
        if self.withdrawn { format!("{}, taken back", self.name) } else { self.name.to_owned() }
    }
}

impl Outcome<'_> {
    /// Mechanisms with probabilities worth saying, most probable first.
    pub(super) fn likely(&self) -> impl Iterator<Item = (&str, f64)> {
        self.diagnosis.mechanisms.iter().filter(|(_, p)| *p >= NEGLIGIBLE).map(|(m, p)| (self.id(*m), *p))
    }

    /// The design, its constants, the likeliest mechanisms, and the unknown.
    pub(super) fn explanations(&self) -> Vec<Explanation<'_>> {
        let d = &self.diagnosis;
        let [none, recalibrate, _, unknown] = d.verdicts();
        let of = |name, probability, verdict| Explanation { name, probability, open: d.verdict == verdict, withdrawn: false };
        let mut all = vec![
            of("the design as it is", none, Verdict::None),
            of("its constants re-estimated", recalibrate, Verdict::Recalibrate),
        ];
        let set: Vec<&str> = d.set.iter().map(|m| self.id(*m)).collect();
        let likely = self.likely().take(SHOWN);
        all.extend(likely.map(|(name, probability)| Explanation {
            name,
            probability,
            open: set.contains(&name),
            withdrawn: false,
        }));
        let withdrawn = self.withdrawn.iter().filter(|(_, p)| *p >= NEGLIGIBLE).take(SHOWN);
        let withdrawn = withdrawn.map(|(m, p)| Explanation { name: self.id(*m), probability: *p, open: false, withdrawn: true });
        all.extend(withdrawn);
        // a user's own are told in any case; those that are not offered are noted
        for (number, mechanism) in self.gyro.mechanisms().iter().enumerate() {
            let name = mechanism.id.as_str();
            let is_asked = mechanisms::find(name).is_none() && !self.of_columns.contains(name);
            if is_asked && all.iter().all(|told| told.name != name) {
                let probability = d.mechanisms.iter().find(|(m, _)| *m == number).map_or(0.0, |(_, p)| *p);
                all.push(Explanation { name, probability, open: set.contains(&name), withdrawn: false });
            }
        }
        if let Some(law) = self.law_in_place() {
            all.push(Explanation { name: "a law that nobody listed", probability: law, open: false, withdrawn: false });
        }
        all.push(of("something without a name", unknown, Verdict::Unknown));
        all
    }

    /// Probability that was taken from mechanisms with a name for laws that the records hardly tell from them, of several the largest; `None` without such a
    /// law.
    pub(super) fn law_in_place(&self) -> Option<f64> {
        self.stand_ins.iter().filter(|stand_in| stand_in.is_near()).map(|stand_in| stand_in.taken).reduce(f64::max)
    }

    /// Mechanisms that are not excluded beside those of the best hypothesis, best first.
    pub(super) fn others(&self) -> Vec<&str> {
        let best = self.names();
        self.diagnosis.set.iter().map(|m| self.id(*m)).filter(|id| !best.contains(id)).collect()
    }

    /// Ids that the next test should tell apart, most probable first; empty where there is nothing to tell apart.
    pub(super) fn apart(&self) -> Vec<String> {
        // no programme of the chamber tells what a column holds
        let others: Vec<&str> = self.others().into_iter().filter(|id| self.column_of(id).is_none()).collect();
        let Some(first) = others.first() else { return Vec::new() };
        let holds = |c: &&Candidate| c.rival.is_none() && c.fit.active.iter().any(|a| self.id(a.mechanism) == *first);
        let with_it = self.diagnosis.candidates.iter().filter(holds).max_by(|a, b| a.probability.total_cmp(&b.probability));
        let kept = |id: &str| with_it.is_some_and(|c| c.fit.active.iter().any(|a| self.id(a.mechanism) == id));
        // of a pair the one whose place it takes
        let best = self.names();
        let replaced = best.iter().find(|id| !kept(id));
        if replaced.is_some_and(|id| self.column_of(id).is_some()) {
            return Vec::new();
        }
        if replaced.is_none() && !best.is_empty() {
            // it takes nobody's place: whether it is there beside them is the question
            return vec![(*first).to_owned(), NOMINAL.to_owned()];
        }
        let ids: Vec<String> = replaced.into_iter().chain(&others).take(MOST).map(|id| (*id).to_owned()).collect();
        if ids.len() > 1 { ids } else { Vec::new() }
    }

    /// A column of the records that a mechanism's law names, if it names one.
    pub(super) fn column_of(&self, id: &str) -> Option<&str> {
        self.gyro.find(id).and_then(|own| self.gyro.mechanism(own).columns().first().copied())
    }

    /// The command that finds the test that tells `ids` apart: where others were found beside them, after one that writes the design with those.
    pub(super) fn recommend(&self, ids: &[String]) -> String {
        let each = |flag: &str| -> String {
            self.fits.iter().map(|record| format!(" {flag} {}", word(&record.fingerprint.file))).collect()
        };
        // all were read alike
        let flags = self.fits.first().map_or(&[][..], |record| &record.flags);
        let flags: String = flags.iter().map(|(flag, file)| format!(" {flag} {}", word(file))).collect();
        let on_request = mechanisms::ON_REQUEST.iter().map(|mechanism| mechanism.facts().id);
        let asked: String =
            on_request.filter(|id| ids.iter().any(|other| other == id)).map(|id| format!(" --mechanism {id}")).collect();
        let command =
            |coil: &Path| format!("fogcoil recommend {} --between {}{asked}{}{flags}", word(coil), ids.join(","), each("--from"));
        let beside = self.beside(ids);
        if beside.is_empty() {
            return command(&self.coil);
        }
        let left_out =
            CATALOGUE.iter().map(|usual| usual.facts().id).filter(|id| self.mechanisms.iter().all(|m| m.facts().id != *id));
        let without = ids.iter().map(String::as_str).filter(|id| *id != NOMINAL).chain(left_out);
        let without: String = without.map(|id| format!(" --without {id}")).collect();
        let stem = self.coil.file_stem().unwrap_or_default().to_string_lossy();
        let file = PathBuf::from(format!("{stem}-with-{}.ron", beside.join("-and-")));
        let [coil, with] = [&self.coil, &file].map(|path| word(path));
        let held: String =
            self.holdouts.iter().map(|held| format!(" --holdout {}", word(&held.record.fingerprint.file))).collect();
        format!("fogcoil diagnose {coil}{}{held}{flags}{without} --model-out {with} && {}", each("--fit"), command(&file))
    }

    /// Ids of what was found beside those that a test is to tell apart, if a design that a test can be sought for can hold it.
    pub(super) fn beside(&self, ids: &[String]) -> Vec<&str> {
        let is_usual = |id: &str| CATALOGUE.iter().any(|usual| usual.facts().id == id);
        let is_asked = |active: &&Active| ids.iter().any(|id| id == self.id(active.mechanism));
        let kept: Vec<&Active> = self.diagnosis.best().fit.active.iter().filter(|active| !is_asked(active)).collect();
        let named: Vec<&str> = kept.iter().map(|active| self.id(active.mechanism)).collect();
        // a file of the user's own would have to be given again
        let usual = ids.iter().map(String::as_str).filter(|id| *id != NOMINAL).chain(named.iter().copied()).all(is_usual);
        let drawn = self.gyro.library().design();
        let design = kept.iter().try_fold(drawn.clone(), |design, active| self.gyro.extended(&design, active));
        let is_sought_for = design.is_some_and(|design| design.mechanics == Mechanics::Elastic);
        if usual && is_sought_for { named } else { Vec::new() }
    }
}

/// A path as one word of a shell's line.
fn word(path: &Path) -> String {
    let text = path.display().to_string();
    let plain = |c: char| c.is_alphanumeric() || "/._-+,:@%=".contains(c);
    if !text.is_empty() && text.chars().all(plain) { text } else { format!("'{}'", text.replace('\'', r"'\''")) }
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_path_is_one_word() {
        let word = |text: &str| super::word(text.as_ref());
        assert_eq!(word("a/b-1.csv"), "a/b-1.csv");
        assert_eq!(word("my records/unit's.csv"), r"'my records/unit'\''s.csv'");
        assert_eq!(word(""), "''");
    }
}
