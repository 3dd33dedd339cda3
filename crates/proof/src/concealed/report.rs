//! The scores as text and as sections of docs/proof.md.

use std::fmt::Write as _;

use super::answers::Case;
use super::baselines::REGRESSIONS;
use super::score::Scored;
use super::summary::{Bound, Form, ScoreRow, failures, summary};
use crate::statistics::{Measured, median};
use crate::truth::{Kind, Tier};
use crate::{Failure, files};

/// A number in three or four significant digits.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        let decimals = (3.0 - value.abs().max(1e-300).log10().floor()).clamp(0.0, 6.0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.3e}")
    }
}

fn value(form: Form, value: f64) -> String {
    match form {
        Form::Percent => format!("{:.0} %", 100.0 * value),
        Form::Number => format!("{value:.2}"),
    }
}

fn asked(row: &ScoreRow) -> String {
    let of = |bound: f64| value(row.form, bound);
    match row.bound {
        Bound::AtLeast(1.0) if row.form == Form::Percent => "all".into(),
        Bound::AtMost(0.0) => "none".into(),
        Bound::AtLeast(bound) => format!("≥ {}", of(bound)),
        Bound::AtMost(bound) => format!("≤ {}", of(bound)),
        Bound::Above(bound) => format!("> {}", of(bound)),
        Bound::Within(low, high) => format!("{} to {}", of(low), of(high)),
        Bound::Open => String::new(),
    }
}

fn verdict(row: &ScoreRow) -> &'static str {
    match row.holds() {
        Some(true) => "holds",
        Some(false) => "FAILS",
        None => "",
    }
}

fn measured(row: &ScoreRow) -> String {
    match row.measured {
        None => "no unit".into(),
        Some(Measured { value: v, interval: [low, high], cases }) => {
            format!("{} [{} to {}] of {cases}", value(row.form, v), value(row.form, low), value(row.form, high))
        }
    }
}

/// One line per score that was measured.
pub(crate) fn lines(rows: &[ScoreRow]) -> String {
    let mut out = String::new();
    for row in rows.iter().filter(|row| row.measured.is_some()) {
        let (asked, measured) = (asked(row), measured(row));
        let _ = writeln!(out, "  {:<6} {:<18} {:<38} {asked:>12}   {measured}", verdict(row), row.group, row.quantity);
    }
    out
}

/// The scores as a table; every interval is of 90 %.
pub(crate) fn markdown(rows: &[ScoreRow]) -> String {
    let mut out = String::from("| units | score | asked | measured [90 % interval] of cases | |\n|---|---|---|---|---|\n");
    for row in rows {
        let _ = writeln!(out, "| {} | {} | {} | {} | {} |", row.group, row.quantity, asked(row), measured(row), verdict(row));
    }
    out
}

/// Faults of the answer on a unit, in words.
pub(crate) fn faults(scored: &Scored) -> Vec<&'static str> {
    let library = matches!(scored.kind, Kind::Single | Kind::Double);
    let skill = scored.held.and_then(|held| held.skill());
    [
        (scored.kind == Kind::Null && scored.detected, "falsely detected"),
        (scored.kind == Kind::Outside && !scored.right, "not called unknown"),
        (library && !scored.detected, "not detected"),
        (library && scored.detected && !scored.right, "wrongly named"),
        (scored.kind == Kind::Double && scored.right && !scored.both, "only one of two named"),
        (library && !scored.in_set, "truth not in the set"),
        (scored.misnamed, "confident and wrong"),
        (scored.stage == Some(false), "wrong stage"),
        (scored.excess.is_some_and(|n| n > 0), "set too large"),
        (skill.is_some_and(|s| s < 0.8), "held-out skill below 0.8"),
        (scored.held.is_some_and(|held| held.is_worse()), "held-out prediction made worse"),
        (scored.parameters.iter().any(|p| !p.is_covered()), "an interval misses its parameter"),
    ]
    .into_iter()
    .filter_map(|(is, text)| is.then_some(text))
    .collect()
}

fn concealed(case: &Case) -> String {
    let of = |m: &crate::truth::ConcealedEffect| {
        let snr = case.truth.snr.iter().find(|s| s.id == m.id).map_or(String::new(), |s| format!(" (SNR {:.0})", s.snr));
        format!("{}{snr}", m.id)
    };
    let all: Vec<String> = case.truth.concealed().map(of).collect();
    if all.is_empty() { "nothing".into() } else { all.join(", ") }
}

fn said(case: &Case) -> String {
    let answer = &case.answer;
    let likely = answer.mechanisms.iter().filter(|m| m.probability >= 0.05).take(3);
    let names: Vec<String> = likely.map(|m| format!("{} {:.2}", m.id, m.probability)).collect();
    match (answer.verdict.as_str(), &answer.structure) {
        ("unknown", Some(structure)) => format!("unknown: {structure}"),
        ("explained", _) => names.join(", "),
        (verdict, _) => verdict.to_owned(),
    }
}

fn number(unit: &str) -> &str {
    unit.strip_prefix("case_").unwrap_or(unit)
}

/// Every unit: what it conceals, what is said of it, and what is wrong with that.
fn units(cases: &[Case]) -> String {
    let mut out =
        String::from("| unit | concealed | said, with probability | set | inseparable by the record | not as it should be |\n");
    out.push_str("|---|---|---|---|---|---|\n");
    for case in cases {
        let inseparable: Vec<String> = case.truth.confusable_sets.iter().map(|set| set.join(", ")).collect();
        let faults = faults(&case.scored).join("; ");
        let (set, unit) = (case.answer.set.join(", "), number(&case.scored.unit));
        let (hidden, said) = (concealed(case), said(case));
        let _ = writeln!(out, "| {unit} | {hidden} | {said} | {set} | {} | {faults} |", inseparable.join("; "));
    }
    out
}

fn parameters(cases: &[Case]) -> String {
    let mut out = String::from("| unit | parameter | true | fitted | 90 % interval | holds it |\n|---|---|---|---|---|---|\n");
    for case in cases {
        for p in &case.scored.parameters {
            let [low, high] = p.ci90.map(short);
            let (truth, fitted) = (short(p.truth), short(p.value));
            let (unit, holds) = (number(&case.scored.unit), if p.is_covered() { "yes" } else { "no" });
            let _ = writeln!(out, "| {unit} | `{}` | {truth} | {fitted} | {low} to {high} | {holds} |", p.name);
        }
    }
    out
}

fn held_out(cases: &[Case]) -> String {
    let mut out = String::from("| unit | nominal | fogcoil | true model | noise | skill |\n|---|---|---|---|---|---|\n");
    for case in cases {
        let skill = case.held.skill().map_or("–".to_owned(), |s| format!("{s:.3}"));
        let [nominal, model, truth, noise] =
            [case.held.nominal, case.held.model, case.held.truth, case.noise].map(|v| format!("{v:.4}"));
        let _ = writeln!(out, "| {} | {nominal} | {model} | {truth} | {noise} | {skill} |", number(&case.scored.unit));
    }
    out
}

/// Median held-out root mean squares beside those of the regressions.
fn regressions(cases: &[Case]) -> String {
    let mut out = String::from("| model | nothing concealed | weak | medium | strong |\n|---|---|---|---|---|\n");
    let groups = |test: &dyn Fn(&Case) -> f64| -> Vec<String> {
        let of = |pick: &dyn Fn(&Case) -> bool| {
            let values: Vec<f64> = cases.iter().filter(|c| pick(c)).map(test).collect();
            median(&values).map_or("–".to_owned(), |m| format!("{:.4} of {}", m.value, m.cases))
        };
        let null = of(&|c| c.scored.kind == Kind::Null);
        let tier = |tier: Tier| of(&|c: &Case| c.scored.kind != Kind::Null && c.scored.tier == tier);
        std::iter::once(null).chain(Tier::ASKED.map(tier)).collect()
    };
    for (k, name) in REGRESSIONS.iter().enumerate() {
        let _ = writeln!(out, "| {name} | {} |", groups(&|c| c.regressions[k]).join(" | "));
    }
    let _ = writeln!(out, "| fogcoil | {} |", groups(&|c| c.held.model).join(" | "));
    let _ = writeln!(out, "| true model | {} |", groups(&|c| c.held.truth).join(" | "));
    out
}

/// Names by fogcoil beside those by BIC.
fn selection(cases: &[Case]) -> String {
    let [ours, theirs] = [|c: &Case| c.scored.clone(), |c: &Case| c.selection.clone()]
        .map(|of| summary(&cases.iter().map(of).collect::<Vec<Scored>>()));
    let mut out = String::from("| units | score | asked | fogcoil | BIC in white noise |\n|---|---|---|---|---|\n");
    for (a, b) in ours.iter().zip(&theirs).filter(|(a, b)| a.measured.is_some() && b.measured.is_some()) {
        let [ours, theirs] = [a, b].map(|row| row.measured.map_or(String::new(), |m| value(row.form, m.value)));
        let _ = writeln!(out, "| {} | {} | {} | {ours} | {theirs} |", a.group, a.quantity, asked(a));
    }
    out
}

pub(crate) fn open(cases: &[Case], rows: &[ScoreRow]) -> String {
    let failing: Vec<String> = failures(rows).map(|row| format!("{}: {}", row.group, row.quantity)).collect();
    let failing = if failing.is_empty() { "none".to_owned() } else { failing.join("; ") };
    format!("Scores that are not as asked: {failing}.\n\n{}\n{}", markdown(rows), details(cases))
}

/// Unit by unit, and what is commonly done with the same records.
pub(crate) fn details(cases: &[Case]) -> String {
    let sections = [
        ("Every unit", units(cases)),
        ("Parameters of the mechanisms that were rightly named", parameters(cases)),
        ("The records held out: root mean square of recorded less predicted, deg/h", held_out(cases)),
        ("Regressions on the same records: median held-out root mean square, deg/h", regressions(cases)),
        ("Naming beside selection by BIC", selection(cases)),
    ];
    sections.map(|(title, table)| format!("### {title}\n\n{table}")).join("\n")
}

/// Puts a section between its two marks in docs/proof.md, under the hash of the program whose answers it scores.
pub(crate) fn publish(name: &str, program: &str, section: &str) -> Result<(), Failure> {
    let marks = [&format!("<!-- {name}: written by `cargo xtask prove` -->")[..], &format!("<!-- {name} end -->")];
    let section = section.trim_end();
    let text = format!("\n\nAnswered by the program `{}…` (SHA-256 of the crates' sources).\n\n{section}\n\n", &program[..16]);
    files::renew(&files::root().join("docs/proof.md"), marks, &text)
}
