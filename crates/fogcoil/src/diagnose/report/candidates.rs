//! What was compared, and how probable each is.

use std::fmt::Write;

use diagnosis::{Candidate, ForwardModel, Verdict};

use crate::diagnose::Outcome;
use crate::picture::escape;

/// Most rows of the table of mechanisms and of that of hypotheses.
const MOST: usize = 8;
/// Mechanisms that are shown however improbable, and the probability below which others are not.
const FEWEST: usize = 3;
const NEGLIGIBLE: f64 = 5e-4;

impl Outcome {
    pub(super) fn candidates(&self, out: &mut String) {
        let d = &self.diagnosis;
        let whole =
            |test: &dyn Fn(&Candidate) -> bool| d.candidates.iter().filter(|c| test(c)).map(|c| c.probability).sum::<f64>();
        let bare = |c: &Candidate| c.rival.is_none() && c.fit.hypothesis.mechanisms.is_empty();
        let library = self.gyro.mechanisms();
        let named = |c: &Candidate| c.rival.is_none() && c.fit.hypothesis.mechanisms.iter().all(|(m, _)| library[*m].named);
        let verdicts = [
            ("nominal model", whole(&|c| bare(c) && !c.fit.hypothesis.constants_free), d.verdict == Verdict::None),
            ("constants re-estimated", whole(&|c| bare(c) && c.fit.hypothesis.constants_free), d.verdict == Verdict::Recalibrate),
            ("a mechanism of the library", whole(&|c| !bare(c) && named(c)), d.verdict == Verdict::Explained),
            ("something else", whole(&|c| !named(c)), d.verdict == Verdict::Unknown),
        ];
        out.push_str("<h3>Kinds of explanation</h3>\n");
        bars(out, verdicts.iter().map(|(name, p, chosen)| ((*name).to_owned(), *p, *chosen)));
        out.push_str("<h3>Mechanisms</h3>\n");
        let shown = d.mechanisms.iter().enumerate().take(MOST).filter(|(n, (_, p))| *n < FEWEST || *p >= NEGLIGIBLE);
        bars(out, shown.map(|(_, (m, p))| (self.id(*m).to_owned(), *p, d.set.contains(m))));
        let set = match d.set.len() {
            0 => String::new(),
            1 => " The marked one alone is not excluded.".into(),
            n => format!(" The {n} marked ones are not excluded."),
        };
        let _ = writeln!(
            out,
            "<p>Probability that a mechanism is at work, alone or with another.{set} {} hypotheses were compared: {} mechanisms alone, \
             their pairs, and each of the leading ones with free structure; every choice (a layer, a second mechanism) is paid for by its \
             share of the prior.</p>",
            d.candidates.len(),
            self.gyro.mechanisms().len(),
        );
        self.hypotheses(out);
    }

    fn hypotheses(&self, out: &mut String) {
        let candidates = &self.diagnosis.candidates;
        let best = candidates[0].log_weight;
        let rows: Vec<Vec<String>> = candidates
            .iter()
            .take(MOST)
            .map(|c| {
                let weight = format!("{:.1}", c.log_weight - best).replace('-', "\u{2212}");
                vec![self.said(c), format!("{:.3}", c.probability), weight]
            })
            .collect();
        let _ = writeln!(out, "<details>\n<summary>The {} most probable hypotheses</summary>", rows.len());
        super::grid(out, &["hypothesis", "probability", "ln odds to the first"], &rows);
        out.push_str("</details>\n");
    }

    /// A hypothesis in words.
    fn said(&self, candidate: &Candidate) -> String {
        let h = &candidate.fit.hypothesis;
        let mechanism = |(m, choice): &(usize, Option<f64>)| match choice {
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
        if let Some(rival) = &candidate.rival {
            parts.push(format!("{}: {}", self.gyro.channels()[rival.channel].name, self.describe(rival)));
        }
        parts.join(" + ")
    }
}

/// Names, probabilities as bars, and which are marked.
fn bars(out: &mut String, rows: impl Iterator<Item = (String, f64, bool)>) {
    out.push_str("<table class=\"bars\">\n<tbody>\n");
    for (name, p, marked) in rows {
        let mark = if marked { " class=\"marked\"" } else { "" };
        let _ = writeln!(
            out,
            "<tr{mark}><th scope=\"row\">{}</th><td>{p:.3}</td><td class=\"bar\"><span style=\"width:{:.1}%\"></span></td></tr>",
            escape(&name),
            100.0 * p.clamp(0.0, 1.0)
        );
    }
    out.push_str("</tbody>\n</table>\n");
}
