//! The evidence against each rival of what leads: the best hypothesis in which a rival does without it.

use charts::{Cells, grid, signed};
use diagnosis::{Candidate, ForwardModel};
use maud::{Markup, html};

use super::candidates::{alike, structure};
use crate::diagnose::Outcome;

/// What a rival's hypotheses are known by.
type Fits = Box<dyn Fn(&Candidate) -> bool>;

impl Outcome {
    pub(super) fn rivals(&self) -> Markup {
        let (groups, best) = (self.groups(), self.diagnosis.best());
        let Some(winner) = groups.iter().find(|group| alike(group.first, best)) else { return Markup::default() };
        let ids: Vec<&str> = best.fit.hypothesis.mechanisms.iter().map(|(number, _)| self.id(*number)).collect();
        let name = if ids.is_empty() { self.said(winner) } else { ids.join(" + ") };
        // best first; what was not tried comes last
        let mut rows: Vec<(f64, Vec<String>)> = self
            .contenders(best)
            .into_iter()
            .map(|(rival, fits)| match groups.iter().find(|group| !holds(group.first, best) && fits(group.first)) {
                Some(group) => {
                    let odds = winner.log_weight - group.log_weight;
                    (odds, vec![rival, signed(odds, 1), self.said(group)])
                }
                None => (f64::INFINITY, vec![rival, "–".into(), format!("not tried without {name}")]),
            })
            .collect();
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let rows: Vec<Vec<String>> = rows.into_iter().map(|(_, row)| row).collect();
        html! {
            h3 { "Rivals" } "\n"
            p {
                "What else could it be? Of each rival the most probable hypothesis that does without what leads, " (name) ", and the \
                evidence against it: ln of the odds of the one over the other, by the records that were fitted, with the priors counted \
                in. A mechanism is excluded by its probability in all hypotheses together, as under Explanations."
            } "\n"
            (grid(&format!("ln odds of {name} over each rival"), Cells::Words, &["rival", "ln odds", "its best hypothesis"], &rows))
        }
    }

    /// Who stands against `best`.
    fn contenders(&self, best: &Candidate) -> Vec<(String, Fits)> {
        let plain =
            |free: bool| move |c: &Candidate| bare(c) && structure(c).is_none() && c.fit.hypothesis.constants_free == free;
        let mut all: Vec<(String, Fits)> = vec![
            ("the design as it is".into(), Box::new(plain(false))),
            ("its constants re-estimated".into(), Box::new(plain(true))),
            ("a structure without a name".into(), Box::new(|c| structure(c).is_some())),
        ];
        // what leads is no rival of itself
        let alone = structure(best).is_none();
        all.retain(|(_, fits)| !(alone && fits(best)));
        let leads = |number| alone && matches!(best.fit.hypothesis.mechanisms[..], [(only, _)] if only == number);
        for (number, mechanism) in self.gyro.mechanisms().iter().enumerate().filter(|(number, _)| !leads(*number)) {
            let with =
                move |c: &Candidate| structure(c).is_none() && c.fit.hypothesis.mechanisms.iter().any(|(m, _)| *m == number);
            all.push((mechanism.id.clone(), Box::new(with)));
        }
        all
    }
}

/// Whether a hypothesis has no mechanism.
fn bare(candidate: &Candidate) -> bool {
    candidate.fit.hypothesis.mechanisms.is_empty()
}

/// Whether all of `best` is in a candidate: then it is no rival.
fn holds(candidate: &Candidate, best: &Candidate) -> bool {
    if bare(best) && structure(best).is_none() {
        return alike(candidate, best);
    }
    let mechanisms = |c: &Candidate| c.fit.hypothesis.mechanisms.iter().map(|(m, _)| *m).collect::<Vec<_>>();
    let all = mechanisms(candidate);
    mechanisms(best).iter().all(|m| all.contains(m)) && (structure(best).is_none() || structure(best) == structure(candidate))
}
