//! A mechanism's page: the part with numbers.

use std::fmt::Write;

use diagnosis::{Prior, Settings};

use super::{Comparison, Entry, Told};
use crate::recommend::number;
use crate::table::significant;
use crate::units::parameter_unit;

/// Rivals in a page's table.
const NEAREST: usize = 5;

fn prior(prior: Option<&Prior>) -> String {
    let n = |x: f64| significant(x, 3);
    match prior {
        None => "each as likely".into(),
        Some(Prior::Normal { mean, sd }) => format!("normal, {} ± {}", n(*mean), n(*sd)),
        Some(Prior::Size { scale }) => format!("a size of either sign, {}", n(*scale)),
        Some(Prior::LogNormal { median, spread }) => {
            format!("log-normal, median {}, spread of the logarithm {}", n(*median), n(*spread))
        }
        Some(Prior::Uniform { low, high }) => format!("uniform, {} to {}", n(*low), n(*high)),
    }
}

fn odds(told: Told) -> String {
    crate::table::odds(told.log_odds, number)
}

impl Comparison {
    /// Parameters, signature, confusions and the tests against them, in Markdown; the picture at `picture`.
    pub fn page(&self, entry: &Entry, picture: &str) -> String {
        let mut out = format!("Stage: {}.\n\n| parameter | unit | prior | typical |\n|---|---|---|---|\n", entry.stage);
        for row in &entry.parameters {
            let _ = writeln!(
                out,
                "| `{}` | {} | {} | {} |",
                row.name,
                parameter_unit(&row.name).replace("degC", "°C"),
                prior(row.prior.as_ref()),
                significant(row.typical, 3)
            );
        }
        let most = |c: usize, k: usize| entry.changes[k][c].iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        let _ = writeln!(
            out,
            "\nAt the typical size it changes the rate by up to {} deg/h in the slow ramp and {} deg/h in the fast one, the spool's reading by \
             up to {} and {} K.\n\n![Change of rate and spool temperature]({picture})\n",
            significant(most(1, 0), 2),
            significant(most(1, 1), 2),
            significant(most(0, 0), 2),
            significant(most(0, 1), 2)
        );
        let Some(i) = self.entries.iter().position(|e| e.id == entry.id) else { return out };
        let mut near: Vec<usize> = (0..self.rivals.len()).filter(|j| *j != i).collect();
        let rank = |j: &usize| self.told[0][i][*j].map_or(f64::INFINITY, |t| t.log_odds);
        near.sort_by(|a, b| rank(a).total_cmp(&rank(b)));
        out.push_str(
            "Expected ln odds for it over each rival that is fitted in its place, in 24 h; above 3.5 the two are told apart:\n\n\
             | fitted in its place |",
        );
        out.extend(self.programmes.iter().map(|p| format!(" {} |", p.family)));
        out.push_str(" best test |\n|---|");
        out.push_str(&"---|".repeat(self.programmes.len() + 1));
        out.push('\n');
        let decides = -Settings::default().excluded.ln();
        for &j in near.iter().take(NEAREST) {
            let told: Vec<Option<Told>> = (0..self.programmes.len()).map(|k| self.told[k][i][j]).collect();
            let best = told.iter().enumerate().filter_map(|(k, t)| Some((k, (*t)?)));
            let best = best.max_by(|a, b| a.1.log_odds.total_cmp(&b.1.log_odds));
            let _ = write!(out, "| {} |", self.rivals[j]);
            out.extend(told.iter().map(|t| format!(" {} |", t.map_or(String::new(), odds))));
            let test = best.filter(|b| b.1.log_odds >= decides).map_or("none of these", |b| self.programmes[b.0].name.as_str());
            let _ = writeln!(out, " {test} |");
        }
        out
    }

    /// The mechanisms with the nearest rival of each under the slow ramp and under the best of the programmes, in Markdown.
    pub fn overview(&self) -> String {
        let mut out =
            "| truth | stage | hardest rival, slow ramp | ln odds | hardest rival, best programme against it | ln odds |\n"
                .to_owned();
        out.push_str("|---|---|---|---|---|---|\n");
        for (i, entry) in self.entries.iter().enumerate() {
            let hardest = |value: &dyn Fn(usize) -> Option<Told>| {
                let all = (0..self.rivals.len()).filter_map(|j| Some((j, value(j)?)));
                all.min_by(|a, b| a.1.log_odds.total_cmp(&b.1.log_odds))
            };
            let best = |j: usize| {
                let all = (0..self.programmes.len()).filter_map(|k| self.told[k][i][j]);
                all.max_by(|a, b| a.log_odds.total_cmp(&b.log_odds))
            };
            let (slow, fast) = (hardest(&|j| self.told[0][i][j]), hardest(&best));
            let cell =
                |h: Option<(usize, Told)>| h.map_or(" | | ".into(), |(j, t)| format!(" {} | {} |", self.rivals[j], odds(t)));
            let _ = writeln!(out, "| [{0}]({0}.md) | {1} |{2}{3}", entry.id, entry.stage, cell(slow), cell(fast));
        }
        out
    }
}
