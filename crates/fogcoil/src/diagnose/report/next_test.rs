//! The test to make next: the profile that tells apart what the records do not, what it is expected to show, and how to get it.

use charts::{facts, nice, row, significant};
use diagnosis::{Settings, Verdict};
use maud::{Markup, html};

use crate::diagnose::Outcome;
use crate::diagnose::apart::TOLD;
use crate::recommend::{Limits, Odds, Question, Recommendation, figure, number, sentence};
use crate::table::capital;

impl Outcome<'_> {
    pub(super) fn next_test(&self) -> Markup {
        let between = self.apart();
        if between.is_empty() {
            return html! { p { (self.nothing_to_tell_apart()) } };
        }
        let command = format!("{} --out next.csv", self.recommend(&between));
        let beside = self.beside(&between);
        if !beside.is_empty() {
            return html! {
                p {
                    "The test is to be sought for the design with " (beside.join(" and ")) ". The first command writes that design, the second \
                     seeks the test and writes its profile:"
                } "\n"
                p { code { (command) } }
            };
        }
        let (records, limits) = (self.fits.clone(), Limits::USUAL);
        let question =
            Question { file: &self.coil, mechanisms: &self.mechanisms, between: &between, records, limits, thorough: false };
        // of the drawing, as the command works it out
        let answer = question.answer(self.library.clone(), &|_| ());
        if let Ok(found) = &answer {
            self.sought.get_or_init(|| (sentence(found), found.separates()));
        }
        html! {
            @match answer {
                Ok(found) => (recommended(&found)),
                Err(error) => p { "It could not be worked out: " (error) },
            }
            p {
                "This writes the profile, as " code { "fogcoil simulate --profile" } " reads it; other limits of the chamber are flags of \
                the same command:"
            } "\n"
            p { code { (command) } }
        }
    }

    /// Tests that would confirm or sharpen the answer, where no two mechanisms are left.
    fn nothing_to_tell_apart(&self) -> String {
        let next = capital(&self.next());
        let likeliest = self.likely().next().filter(|(_, p)| *p >= Settings::default().excluded);
        match (self.diagnosis.verdict, likeliest) {
            _ if self.misread().is_some() => next,
            (Verdict::Explained, _) => {
                let names = self.told_names();
                let looks: Vec<&str> = names.iter().filter_map(|id| self.inspection(id)).collect();
                // of a mechanism of the user's own the command would need the file
                let listed = |id: &str| mechanisms::find(id).is_some();
                // of a rival that is far behind no test is worth its time
                let near = |(id, probability): &(&str, f64)| !names.contains(id) && listed(id) && *probability >= TOLD;
                let rival = self.likely().find(near).map(|(id, _)| id);
                let surer = names.first().filter(|id| listed(id)).zip(rival).map_or(String::new(), |(first, rival)| {
                    let command = self.recommend(&[(*first).to_owned(), rival.to_owned()]);
                    format!(
                        " To be surer before it is taken apart: {command} seeks the test that tells {first} from {rival} best."
                    )
                });
                format!("{next} Inspection: {}.{surer}", looks.join("; "))
            }
            (Verdict::None, Some((id, p))) => {
                let command = self.recommend(&[id.to_owned(), "nominal".into()]);
                format!("{next} They exclude {id} least (probability {p:.3}); {command} seeks the test that would show it.")
            }
            _ => next,
        }
    }
}

fn recommended(found: &Recommendation) -> Markup {
    let said = nice(&sentence(found));
    let (best, limits) = (&found.profiles[0], &found.limits);
    let mut rows = vec![
        row("told apart", found.between.join(", ")),
        row("profile", best.programme.name.clone()),
        row("duration", format!("{} h", significant(best.programme.duration() / 3600.0, 3))),
        row("chamber", nice(&format!("{} to {} degC, at most {} K/min", limits.coldest, limits.hottest, limits.fastest))),
        row("sensors", "those of the record: the gyro's rate and the spool's thermometer, with the noise that was identified"),
        row("expected separation", meaning(&best.odds)),
        row(&format!("{} instead, as long", found.repeat.0), brief(&found.repeat.1)),
    ];
    rows.extend(found.sensors.iter().map(|s| row(&format!("with {}", s.sensor), format!("{}: {}", s.programme, brief(&s.odds)))));
    for size in &found.sizes {
        let values: Vec<String> = size.values.iter().map(|(name, v)| format!("{name} = {}", significant(*v, 3))).collect();
        rows.push(row(&format!("size of {} (fitted alone)", size.id), nice(&values.join(", "))));
    }
    html! {
        p { (capital(&said)) } "\n"
        (facts("The recommended test", &rows))
        (figure(found).element())
    }
}

fn brief(odds: &Odds) -> String {
    let apart = if odds.decides() { "tells them apart" } else { "does not" };
    format!("{apart} (ln odds {}, {} σ)", nice(&number(odds.log_odds)), number(odds.sigma))
}

/// Meaning of an expected separation, in words.
fn meaning(odds: &Odds) -> String {
    let excluded = Settings::default().excluded;
    let [truth, rival] = &odds.pair;
    format!(
        "{}: if {truth} is at work, the nearest {rival} stays {} standard deviations of the noise away, and the ln of the odds for {truth} over \
         {rival} is expected to be {}; from {:.1} on (1 in {:.0}) the loser counts as excluded. Of all pairs this one is told apart worst",
        if odds.decides() { "enough" } else { "not enough" },
        number(odds.sigma),
        nice(&number(odds.log_odds)),
        -excluded.ln(),
        1.0 / excluded,
    )
}
