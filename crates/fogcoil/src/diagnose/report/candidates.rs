//! What was compared, and how probable each is.

use charts::{Cells, grid, signed, significant};
use diagnosis::{Candidate, ForwardModel, Structure};
use maud::{Markup, html};

use crate::diagnose::Outcome;
use crate::diagnose::explanations::Explanation;

/// Most rows of the table of hypotheses.
const MOST: usize = 8;

/// Hypotheses that differ in a choice alone.
pub(super) struct Group<'a> {
    /// The most probable of them.
    pub(super) first: &'a Candidate,
    count: usize,
    probability: f64,
    /// ln of the sum of their weights.
    pub(super) log_weight: f64,
}

impl Outcome {
    pub(super) fn candidates(&self) -> Markup {
        let d = &self.diagnosis;
        let [.., library, _] = d.verdicts();
        let unnamed = self.gyro.mechanisms().iter().filter(|m| !m.named).count();
        html! {
            h3 { "Explanations" } "\n"
            table.bars {
                caption.unseen { "Explanations and their probabilities" }
                tbody {
                    @for Explanation { name, probability, open } in self.explanations() {
                        tr class=[open.then_some("marked")] {
                            th scope="row" { (name) }
                            td { (format!("{probability:.3}")) }
                            td.bar aria-hidden="true" {
                                span style=(format!("width:{:.1}%", 100.0 * probability.clamp(0.0, 1.0))) {}
                            }
                        } "\n"
                    }
                }
            } "\n"
            p {
                "Of a mechanism: the probability that it is at work, alone or with another of the library; of any in the library: "
                (signed(library, 3)) ". Something without a name may stand alone or beside one that has a name. What is in bold is not \
                excluded. " (d.candidates.len()) " hypotheses were compared: " (self.gyro.mechanisms().len() - unnamed) " mechanisms with \
                a name and " (unnamed) " without one alone, pairs of them, and the leading ones with free structure; every choice (a \
                layer, a second mechanism) is paid for by its share of the prior."
            }
            (self.hypotheses())
        }
    }

    fn hypotheses(&self) -> Markup {
        let groups = self.groups();
        let best = groups.first().map_or(0.0, |group| group.log_weight);
        let said =
            |group: &Group| vec![self.said(group), format!("{:.3}", group.probability), significant(group.log_weight - best, 2)];
        let rows: Vec<Vec<String>> = groups.iter().take(MOST).map(said).collect();
        html! {
            details {
                summary { "The " (rows.len()) " most probable hypotheses" } "\n"
                (grid("The most probable hypotheses", Cells::Words, &["hypothesis", "probability", "ln odds to the first"], &rows))
            } "\n"
        }
    }

    /// All candidates, most probable first.
    pub(super) fn groups(&self) -> Vec<Group<'_>> {
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

    /// A hypothesis in words.
    pub(super) fn said(&self, group: &Group) -> String {
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
}

/// What was added to a candidate, and where.
pub(super) fn structure(candidate: &Candidate) -> Option<(Structure, usize)> {
    candidate.rival.as_ref().map(|rival| (rival.structure, rival.channel))
}

/// Whether two candidates differ in their choices alone.
pub(super) fn alike(a: &Candidate, b: &Candidate) -> bool {
    let (x, y) = (&a.fit.hypothesis, &b.fit.hypothesis);
    x.constants_free == y.constants_free
        && x.mechanisms.len() == y.mechanisms.len()
        && x.mechanisms.iter().all(|(m, _)| y.mechanisms.iter().any(|(n, _)| n == m))
        && structure(a) == structure(b)
}
