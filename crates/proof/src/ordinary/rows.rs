//! `cargo xtask prove --rows`: one thing at a time that is ordinary about a unit and was once taken for a fault.

use std::fmt::Write as _;

use fogcoil::cache::Cache;
use fogcoil::{diagnose, input};

use crate::concealed::{Answer, each, publish, record};
use crate::files::{self, root};
use crate::generator::{Generator, NOTHING, Ordinary};
use crate::{Failure, program};

/// An ordinary property, and the mechanism that is concealed beside it.
struct Row {
    what: &'static str,
    of: Ordinary,
    concealed: Option<&'static str>,
    /// Whether the mechanism of the tutorial is weighed, too.
    own: bool,
}

/// Units of each row.
const SEEDS: [u64; 2] = [1, 2];

const ROWS: [Row; 12] = [
    row("nothing", NOTHING),
    row("Earth's rate left in, 7.5 deg/h", Ordinary { earth: 7.5, ..NOTHING }),
    row("spool thermometer 0.5 K off", Ordinary { spool_offset: 0.5, ..NOTHING }),
    row("spool thermometer 1 K off", Ordinary { spool_offset: -1.0, ..NOTHING }),
    row(
        "thermometers' gains 0.3 % off, chamber's sensor 60 s slow, its clock 45 s late",
        Ordinary { gains: [0.003, -0.003], chamber_late: [60.0, 45.0], ..NOTHING },
    ),
    row("k_r 10 % off the drawing", Ordinary { constants: [1.1, 1.0, 1.0], ..NOTHING }),
    row("specific heat of the coil 8 % off", Ordinary { constants: [1.0, 1.08, 1.0], ..NOTHING }),
    row("adhesive 25 % stiffer, E_r 13 %", Ordinary { constants: [1.0, 1.0, 1.13], ..NOTHING }),
    row("gyroscope ten times noisier", Ordinary { noise: 10.0, ..NOTHING }),
    row("chamber ripples by 0.15 K and moves at the first row", Ordinary { ripple: 0.15, ..NOTHING }),
    Row {
        what: "CW tail 2.5 m longer beside a thermometer's gain of 0.3 %",
        of: Ordinary { tail: 2.5, gains: [0.0, 0.003], ..NOTHING },
        concealed: Some("tail-asymmetry"),
        own: false,
    },
    Row {
        what: "electronics that warm up slowly, of which a user's own file tells",
        of: Ordinary { board: (1500.0, 0.006), ..NOTHING },
        concealed: Some("slow-board"),
        own: true,
    },
];

const fn row(what: &'static str, of: Ordinary) -> Row {
    Row { what, of, concealed: None, own: false }
}

/// Whether an answer is right: nothing is named where nothing is concealed, what is concealed is named alone.
fn right(answer: &Answer, concealed: Option<&str>) -> bool {
    match concealed {
        None => ["none", "recalibrate"].contains(&answer.verdict.as_str()),
        Some(id) => answer.verdict == "explained" && answer.set == [id],
    }
}

/// Makes the units of every row, answers them with the reference drawing, and says which are answered rightly; writes the section of docs/proof.md.
/// Whether all are.
pub(crate) fn run() -> Result<bool, Failure> {
    let program = program::hash(&root())?;
    let (cache, into) = (Cache::of_user(), root().join("target/prove/rows"));
    let (usual, own) =
        (input::Asked::default(), input::read_mechanisms(&[root().join("crates/fogcoil/templates/mechanism.ron")])?);
    let coil = input::read_coil(&root().join("fixtures/coil-reference.ron"))?;
    let generator = Generator::new(coil.design.clone())?;
    let named = |row: &Row, seed: u64| format!("{}, unit {seed}", row.what);
    let units: Vec<(&Row, u64)> = ROWS.iter().flat_map(|row| SEEDS.map(|seed| (row, seed))).collect();
    let names: Vec<String> = units.iter().map(|(row, seed)| named(row, *seed)).collect();
    let answers = each(&names, |name| {
        let of_name = units.iter().find(|(row, seed)| named(row, *seed) == name);
        let (row, seed) = of_name.ok_or_else(|| Failure("no unit has this name".into()))?;
        let at = into.join(name.replace('/', " per "));
        let [fit, holdout, meta] = generator.ordinary(*seed, &row.of)?;
        let text = [("fit.csv", fit), ("holdout.csv", holdout), ("meta.ron", meta)];
        files::write_all(&text.map(|(file, text)| (at.join(file), text)))?;
        let (fit, holdout) = (record(&at.join("fit.csv"))?, record(&at.join("holdout.csv"))?);
        let kinds = if row.own { &own } else { &usual }.with_catalogue();
        let outcome = diagnose::diagnose(&coil, &kinds, &[fit], &[holdout], &cache, &|_| ())?;
        let answer: Answer = serde_json::from_str(&outcome.json().to_string())?;
        eprintln!("{name}: {} {:?}", answer.verdict, answer.set);
        Ok((right(&answer, row.concealed), answer))
    })?;
    let mut out = String::from("| what is ordinary | right | said of each unit |\n|---|---|---|\n");
    for (row, answers) in ROWS.iter().zip(answers.chunks(SEEDS.len())) {
        let hits = answers.iter().filter(|(right, _)| *right).count();
        let said: Vec<String> =
            answers.iter().map(|(_, a)| format!("{} {}", a.verdict, a.set.join(" + ")).trim().to_owned()).collect();
        let _ = writeln!(out, "| {} | {hits} of {} | {} |", row.what, answers.len(), said.join("; "));
    }
    publish("rows", &program, &out)?;
    let all = answers.iter().all(|(right, _)| *right);
    println!("{} of {} are answered rightly", answers.iter().filter(|(right, _)| *right).count(), answers.len());
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_where_nothing_is_concealed_is_wrong() {
        let of = |verdict: &str, set: &[&str]| Answer {
            verdict: verdict.into(),
            set: set.iter().map(ToString::to_string).collect(),
            ..Answer::default()
        };
        assert!(right(&of("recalibrate", &[]), None) && right(&of("none", &[]), None));
        assert!(!right(&of("unknown", &[]), None) && !right(&of("explained", &["air-path"]), None));
        let tail = Some("tail-asymmetry");
        assert!(right(&of("explained", &["tail-asymmetry"]), tail));
        assert!(!right(&of("explained", &["tail-asymmetry", "air-path"]), tail) && !right(&of("recalibrate", &[]), tail));
    }
}
