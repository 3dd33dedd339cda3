//! The probabilities that are shown, in one order everywhere.

use diagnosis::Verdict;

use super::Outcome;

/// Most mechanisms whose probability is shown, and the probability below which none is.
const MOST: usize = 6;
const NEGLIGIBLE: f64 = 5e-4;

/// A row of the table of probabilities.
pub(super) struct Explanation<'a> {
    pub(super) name: &'a str,
    pub(super) probability: f64,
    /// whether the records do not exclude it
    pub(super) open: bool,
}

impl Outcome {
    /// Mechanisms with probabilities worth saying, most probable first.
    pub(super) fn likely(&self) -> impl Iterator<Item = (&str, f64)> {
        self.diagnosis.mechanisms.iter().filter(|(_, p)| *p >= NEGLIGIBLE).map(|(m, p)| (self.id(*m), *p))
    }

    /// The design, its constants, the likeliest mechanisms, and what has no name.
    pub(super) fn explanations(&self) -> Vec<Explanation<'_>> {
        let d = &self.diagnosis;
        let [none, recalibrate, _, unknown] = d.verdicts();
        let of = |name, probability, verdict| Explanation { name, probability, open: d.verdict == verdict };
        let mut all = vec![
            of("the design as it is", none, Verdict::None),
            of("its constants re-estimated", recalibrate, Verdict::Recalibrate),
        ];
        let set: Vec<&str> = d.set.iter().map(|m| self.id(*m)).collect();
        let mechanisms = self.likely().take(MOST);
        all.extend(mechanisms.map(|(name, probability)| Explanation { name, probability, open: set.contains(&name) }));
        all.push(of("something without a name", unknown, Verdict::Unknown));
        all
    }
}
