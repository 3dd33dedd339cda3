//! The cells of `cargo xtask cells` by NGSolve, beside ours. Its values are kept in a file with the cells they are of; a cell that has
//! changed since has none.

use crate::{Failure, peers};
use homogenization::{Constants, Constituent, FibreCell, Packing, Ring, Role, TOLERANCE};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

const SCRIPT: &str = "cells_ngsolve.py";
const VALUES: &str = "benches/peers/cells_ngsolve.jsonl";
/// The peer agrees if it is no farther from ours than so many times its own error, or [`TOLERANCE`].
const MARGIN: f64 = 2.0;

pub(crate) struct Solved {
    pub(crate) name: &'static str,
    pub(crate) cell: FibreCell,
    pub(crate) constants: Constants,
}

/// Output of the script for a cell: its constants at two orders of the elements.
#[derive(Serialize, Deserialize)]
struct Answer {
    version: String,
    orders: [usize; 2],
    lower: BTreeMap<String, f64>,
    higher: BTreeMap<String, f64>,
}

/// A line of [`VALUES`].
#[derive(Serialize, Deserialize)]
struct Kept {
    cell: Value,
    #[serde(flatten)]
    answer: Answer,
}

/// The cell as the script reads it.
fn description(cell: &FibreCell) -> Value {
    let solid = |c: &Constituent| {
        let elastic = &c.elastic;
        json!([elastic.youngs_modulus, elastic.poisson_ratio, elastic.thermal_expansion, c.conductivity])
    };
    let ring =
        |r: &Ring| json!({ "outer_radius": r.outer_radius, "glass": r.role == Role::Glass, "solid": solid(&r.constituent) });
    let rings: Vec<_> = cell.rings.iter().map(ring).collect();
    json!({ "pitch": cell.pitch, "square": cell.packing == Packing::Square, "rings": rings, "adhesive": solid(&cell.adhesive) })
}

/// Has `python` solve the cells; writes [`VALUES`].
fn solve(cells: &[Solved], python: &Path) -> Result<(), Failure> {
    if !peers::has(python, "ngsolve, numpy") {
        return Err(Failure(format!("{}: lacks ngsolve or numpy (benches/peers/README.md)", python.display())));
    }
    let descriptions: Vec<_> = cells.iter().map(|solved| description(&solved.cell)).collect();
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("cells.json");
    std::fs::write(&file, Value::from(descriptions.clone()).to_string())?;
    let answers = peers::results(python, &[SCRIPT.into(), file.into()])?;
    if answers.len() != cells.len() {
        return Err(Failure(format!("{SCRIPT}: {} answers for {} cells", answers.len(), cells.len())));
    }
    let mut text = String::new();
    for (cell, answer) in descriptions.into_iter().zip(answers) {
        let answer = serde_json::from_str(&answer).map_err(|e| Failure(format!("{SCRIPT}: {e}")))?;
        let line = serde_json::to_string(&Kept { cell, answer }).map_err(|e| Failure(format!("{VALUES}: {e}")))?;
        text += &(line + "\n");
    }
    std::fs::write(VALUES, text).map_err(|e| Failure(format!("{VALUES}: {e}")))
}

fn kept() -> Result<Vec<Kept>, Failure> {
    let failed = |line: usize, e: serde_json::Error| Failure(format!("{VALUES}, line {}: {e}", line + 1));
    let text = match std::fs::read_to_string(VALUES) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => String::new(),
        text => text.map_err(|e| Failure(format!("{VALUES}: {e}")))?,
    };
    text.lines().enumerate().map(|(i, line)| serde_json::from_str(line).map_err(|e| failed(i, e))).collect()
}

/// The peer's largest difference from ours, and between its orders; `None` if it lacks a constant.
fn compare(ours: &Constants, peer: &Answer) -> Option<[f64; 2]> {
    let mut largest = [0.0_f64; 2];
    for ((name, value), (_, size)) in ours.named().into_iter().zip(ours.size().named()) {
        let [lower, higher] = [*peer.lower.get(name)?, *peer.higher.get(name)?];
        for (largest, difference) in largest.iter_mut().zip([higher - value, higher - lower]) {
            *largest = largest.max(difference.abs() / size);
        }
    }
    Some(largest)
}

/// The section of the page, and whether NGSolve agrees wherever it has a value; with `python` it is run first.
pub(crate) fn section(cells: &[Solved], python: Option<&Path>) -> Result<(String, bool), Failure> {
    if let Some(python) = python {
        solve(cells, python)?;
    }
    let kept = kept()?;
    let (mut rows, mut good, mut last) = (String::new(), true, None);
    for Solved { name, cell, constants } in cells {
        // a number may change its last bit when it is read: ours is read, too
        let text = description(cell).to_string();
        let description: Value = serde_json::from_str(&text).map_err(|e| Failure(format!("{name}: {e}")))?;
        let Some(Kept { answer, .. }) = kept.iter().find(|kept| kept.cell == description) else {
            let _ = writeln!(rows, "| {name} | not run | | |");
            continue;
        };
        let lacks = || Failure(format!("{VALUES}: {name}: a constant is missing"));
        let [difference, error] = compare(constants, answer).ok_or_else(lacks)?;
        let agrees = difference <= TOLERANCE.max(MARGIN * error);
        good &= agrees;
        let _ = writeln!(rows, "| {name} | {difference:.1e} | {error:.1e} | {} |", if agrees { "yes" } else { "**no**" });
        last = Some(answer);
    }
    let setting = last.map_or(String::new(), |a| format!(" {}, elements of order {}", a.version, a.orders[1]));
    let lower = last.map_or(String::new(), |a| format!(" {}", a.orders[0]));
    let section = format!(
        "\n## Beside NGSolve\n\n\
         The same cells by NGSolve{setting}: quarter cell, curved blocks graded towards the narrow part of the film \
         ([{SCRIPT}](../benches/peers/{SCRIPT})).\nIts own error is the distance to its constants at order{lower}. It agrees if the \
         difference of all sixteen constants is at most twice that, or {TOLERANCE:.0e}.\n\
         `cargo xtask cells --peers-python PATH` runs it anew and keeps its values in \
         [cells_ngsolve.jsonl](../{VALUES}); a cell that was changed since is \"not run\".\n\n\
         | cell | largest difference | NGSolve's own error | agrees |\n|---|---|---|---|\n{rows}"
    );
    print!("{section}");
    Ok((section, good))
}
