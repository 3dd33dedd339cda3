//! The compared hypotheses with their probabilities, and the evidence against each rival of the leading one.

use charts::{Cells, grid, signed, significant};
use diagnosis::{Candidate, ForwardModel, Structure};
use maud::{Markup, html};

use crate::diagnose::Outcome;
use crate::diagnose::apart::TOLD;
use crate::table::odds;

/// Most rows of the table of hypotheses.
const MOST: usize = 8;

/// Probability from which its ratio to another is no rounding.
const LEAST: f64 = 1e-12;

/// Hypotheses that differ in a choice alone.
struct Group<'a> {
    /// The most probable of them.
    first: &'a Candidate,
    count: usize,
    probability: f64,
    /// ln of the sum of their weights.
    log_weight: f64,
}

/// Test whether a candidate belongs to a rival's hypotheses.
type Fits = Box<dyn Fn(&Candidate) -> bool>;

impl Outcome<'_> {
    pub(super) fn candidates(&self) -> Markup {
        let d = &self.diagnosis;
        let [.., explained, _] = d.verdicts();
        let library = explained - self.law_in_place().unwrap_or(0.0);
        let unnamed = self.gyro.mechanisms().iter().filter(|m| !m.named).count();
        html! {
            h3 { "Explanations" } "\n"
            table.bars {
                caption.unseen { "Explanations and their probabilities" }
                tbody {
                    @for explanation in self.explanations() {
                        tr class=[explanation.open.then_some("marked")] {
                            th scope="row" { (explanation.said()) }
                            td { (format!("{:.3}", explanation.probability)) }
                            td.bar aria-hidden="true" {
                                span style=(format!("width:{:.1}%", 100.0 * explanation.probability.clamp(0.0, 1.0))) {}
                            }
                        } "\n"
                    }
                }
            } "\n"
            p {
                "Of a mechanism: the probability that it is at work, alone or with another of the library; of any in the library: "
                (signed(library, 3)) ". Something without a name may act alone or together with a named mechanism. The records do not exclude what is \
                in bold. " (d.candidates.len()) " hypotheses were compared: " (self.gyro.mechanisms().len() - unnamed) " mechanisms with \
                a name and " (unnamed) " without one alone, pairs of them, and the leading ones with free structure; every choice (a \
                layer, a second mechanism) is paid for by its share of the prior."
            }
            (self.hypotheses())
        }
    }

    fn hypotheses(&self) -> Markup {
        let groups = self.groups();
        let best = groups.first().map_or(0.0, |group| group.log_weight);
        let known = |group: &Group| (group.probability, self.said(group), Some(group.log_weight - best));
        let mut all: Vec<(f64, String, Option<f64>)> = groups.iter().map(known).collect();
        if let Some((law, probability)) = self.law_beside() {
            all.push((probability, law, None));
            all.sort_by(|a, b| b.0.total_cmp(&a.0));
        }
        let first = all.first().map_or(1.0, |(p, ..)| *p);
        // of a law and a candidate the probabilities tell the odds, down to what rounding leaves of them
        let leads = all.first().is_some_and(|(.., ln)| ln.is_none());
        let odds = |p: f64, ln: Option<f64>| match ln.filter(|_| !leads) {
            Some(ln) => significant(ln, 2),
            None if p > LEAST => significant((p / first).ln(), 2),
            None => format!("below {}", significant(LEAST.ln(), 2)),
        };
        let said = |(p, said, ln): &(f64, String, Option<f64>)| vec![said.clone(), format!("{p:.3}"), odds(*p, *ln)];
        let rows: Vec<Vec<String>> = all.iter().take(MOST).map(said).collect();
        html! {
            details {
                summary { "The " (rows.len()) " most probable hypotheses" } "\n"
                (grid("The most probable hypotheses", Cells::Words, &["hypothesis", "probability", "ln odds to the first"], &rows))
                @if let Some(before) = self.before_the_law() { p { (before) } "\n" }
            } "\n"
        }
    }

    /// A sentence on numbers that are of names alone, where a law in the place of one took its part.
    fn before_the_law(&self) -> Option<String> {
        let law = self.law_in_place().filter(|p| *p >= TOLD)?;
        Some(format!(
            "These numbers compare what has a name; under Explanations a law that nobody listed, which does the same, has taken {law:.3} of it."
        ))
    }

    /// An accepted law, which is none of the candidates, with the probability that they leave.
    fn law_beside(&self) -> Option<(String, f64)> {
        let known: f64 = self.diagnosis.candidates.iter().map(|candidate| candidate.probability).sum();
        self.law_name().map(|law| (law, (1.0 - known).max(0.0)))
    }

    /// All candidates, most probable first.
    fn groups(&self) -> Vec<Group<'_>> {
        let mut groups: Vec<Group> = Vec::new();
        for candidate in &self.diagnosis.candidates {
            let Candidate { probability, log_weight, .. } = *candidate;
            match groups.iter_mut().find(|group| alike(group.first, candidate)) {
                None => groups.push(Group { first: candidate, count: 1, probability, log_weight }),
                Some(group) => {
                    group.count += 1;
                    group.probability += probability;
                    let [low, high] = [group.log_weight.min(log_weight), group.log_weight.max(log_weight)];
                    group.log_weight = high + (low - high).exp().ln_1p();
                    if probability > group.first.probability {
                        group.first = candidate;
                    }
                }
            }
        }
        groups.sort_by(|a, b| b.log_weight.total_cmp(&a.log_weight));
        groups
    }

    fn said(&self, group: &Group) -> String {
        let h = &group.first.fit.hypothesis;
        let mechanism = |(m, choice): &(usize, Option<f64>)| match choice {
            Some(value) if group.count > 1 => format!("{} (best at {value})", self.id(*m)),
            Some(value) => format!("{} ({value})", self.id(*m)),
            None => self.id(*m).to_owned(),
        };
        let mut parts: Vec<String> = h.mechanisms.iter().map(mechanism).collect();
        if parts.is_empty() {
            parts.push("nominal".into());
        }
        if h.constants_free {
            parts.push("constants free".into());
        }
        if let Some(rival) = &group.first.rival {
            parts.push(format!("{}: {}", self.gyro.channels()[rival.channel].name, self.describe(rival)));
        }
        let all = parts.join(" + ");
        if group.count > 1 { format!("{all}, of {} choices", group.count) } else { all }
    }

    pub(super) fn rivals(&self) -> Markup {
        let (groups, best) = (self.groups(), self.diagnosis.best());
        // where a law leads, the table of hypotheses says how far they all are behind it
        if self.law_beside().is_some_and(|(_, probability)| probability > best.probability) {
            return Markup::default();
        }
        let Some(winner) = groups.iter().find(|group| alike(group.first, best)) else { return Markup::default() };
        let ids: Vec<&str> = best.fit.hypothesis.mechanisms.iter().map(|(number, _)| self.id(*number)).collect();
        let name = if ids.is_empty() { self.said(winner) } else { ids.join(" + ") };
        // best first; what was not tried comes last
        let mut rows: Vec<(f64, Vec<String>)> = self
            .contenders(best)
            .into_iter()
            .map(|(rival, fits)| match groups.iter().find(|group| !holds(group.first, best) && fits(group.first)) {
                Some(group) => {
                    let ln = winner.log_weight - group.log_weight;
                    (ln, vec![rival, odds(ln, |ln| signed(ln, 1)), self.said(group)])
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
            @if let Some(before) = self.before_the_law() { p { (before) } "\n" }
        }
    }

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

/// Structure that was added to a candidate, and its channel.
fn structure(candidate: &Candidate) -> Option<(Structure, usize)> {
    candidate.rival.as_ref().map(|rival| (rival.structure, rival.channel))
}

/// Whether two candidates differ in their choices alone.
fn alike(a: &Candidate, b: &Candidate) -> bool {
    let (x, y) = (&a.fit.hypothesis, &b.fit.hypothesis);
    x.constants_free == y.constants_free
        && x.mechanisms.len() == y.mechanisms.len()
        && x.mechanisms.iter().all(|(m, _)| y.mechanisms.iter().any(|(n, _)| n == m))
        && structure(a) == structure(b)
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
