//! `cargo xtask prove --rows`: one thing at a time that was once taken for a fault, or for another one: ordinary properties, and strong paths of heat.

use std::fmt::Write as _;

use fogcoil::cache::Cache;
use fogcoil::{diagnose, input};

use crate::concealed::{Answer, each, publish, record};
use crate::files::{self, root};
use crate::generator::{Generator, NOTHING, Ordinary};
use crate::{Failure, program};

/// Properties of a unit, and the mechanism that is concealed beside it.
struct Row {
    what: &'static str,
    /// The design, in fixtures.
    drawing: &'static str,
    of: Ordinary,
    concealed: Option<&'static str>,
    /// Whether the mechanism of the tutorial is weighed, too.
    own: bool,
}

/// Units of each row.
const SEEDS: [u64; 2] = [1, 2];

const ROWS: [Row; 18] = [
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
        drawing: REFERENCE,
        what: "CW tail 2.5 m longer beside a thermometer's gain of 0.3 %",
        of: Ordinary { tail: 2.5, gains: [0.0, 0.003], ..NOTHING },
        concealed: Some("tail-asymmetry"),
        own: false,
    },
    Row {
        drawing: REFERENCE,
        what: "electronics that warm up slowly, of which a user's own file tells",
        of: Ordinary { board: (1500.0, 0.006), ..NOTHING },
        concealed: Some("slow-board"),
        own: true,
    },
    Row { drawing: FLANGED, ..row("60 mm coil: constants 4 % to 6 % off the drawing", strong([0.0, 0.0, 1.0])) },
    path("60 mm coil: mount of 45 W/(m² K)", [45.0, 0.0, 1.0], "axial-heat-path"),
    path("60 mm coil: mount of 150 W/(m² K)", [150.0, 0.0, 1.0], "axial-heat-path"),
    path("60 mm coil: hub's contact resistance of 0.025 m² K/W", [0.0, 0.025, 1.0], "interface-resistance"),
    path("60 mm coil: fan: surroundings that conduct 4 times as well", [0.0, 0.0, 4.0], "air-path"),
    path("60 mm coil: gas: surroundings that conduct 0.3 times as well", [0.0, 0.0, 0.3], "air-path"),
];

const REFERENCE: &str = "coil-reference.ron";
const FLANGED: &str = "designs/flanged.ron";

const fn row(what: &'static str, of: Ordinary) -> Row {
    Row { what, drawing: REFERENCE, of, concealed: None, own: false }
}

/// A path of heat that changes the bias more than all tolerances do, beside constants that are off.
const fn path(what: &'static str, heat: [f64; 3], id: &'static str) -> Row {
    Row { what, drawing: FLANGED, of: strong(heat), concealed: Some(id), own: false }
}

/// Constants 4 % to 6 % off the drawing beside the conductance of a mount [W/(m² K)], a contact resistance [m² K/W] and a factor on the surroundings.
const fn strong(heat: [f64; 3]) -> Ordinary {
    Ordinary { heat, constants: [0.96, 1.035, 0.945], ..NOTHING }
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
    let drawings = [REFERENCE, FLANGED].map(|drawing| -> Result<_, Failure> {
        let coil = input::read_coil(&root().join("fixtures").join(drawing))?;
        Ok((drawing, Generator::new(coil.design.clone())?, coil))
    });
    let drawings = drawings.into_iter().collect::<Result<Vec<_>, _>>()?;
    let named = |row: &Row, seed: u64| format!("{}, unit {seed}", row.what);
    let units: Vec<(&Row, u64)> = ROWS.iter().flat_map(|row| SEEDS.map(|seed| (row, seed))).collect();
    let names: Vec<String> = units.iter().map(|(row, seed)| named(row, *seed)).collect();
    let answers = each(&names, |name| {
        let of_name = units.iter().find(|(row, seed)| named(row, *seed) == name);
        let (row, seed) = of_name.ok_or_else(|| Failure("no unit has this name".into()))?;
        let of_row = drawings.iter().find(|(drawing, ..)| *drawing == row.drawing);
        let (_, generator, coil) = of_row.ok_or_else(|| Failure(format!("{} is not read", row.drawing)))?;
        let at = into.join(name.replace('/', " per "));
        let [fit, holdout, meta] = generator.ordinary(*seed, &row.of)?;
        let text = [("fit.csv", fit), ("holdout.csv", holdout), ("meta.ron", meta)];
        files::write_all(&text.map(|(file, text)| (at.join(file), text)))?;
        let (fit, holdout) = (record(&at.join("fit.csv"))?, record(&at.join("holdout.csv"))?);
        let kinds = if row.own { &own } else { &usual }.with_catalogue();
        let outcome = diagnose::diagnose(coil, &kinds, &[], &[fit], &[holdout], &cache, &|_| ())?;
        let answer: Answer = serde_json::from_str(&outcome.json().to_string())?;
        eprintln!("{name}: {} {:?}", answer.verdict, answer.set);
        Ok((right(&answer, row.concealed), answer))
    })?;
    let mut out = String::from("| what is so about it | right | said of each unit |\n|---|---|---|\n");
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
