//! `fogcoil wind`: the turn table.

use std::fmt::Write;

use serde_json::{Value, json};
use winding::{Half, Turn, Winding};

use crate::input::CoilCase;
use crate::table::{significant, table};
use crate::tabular::{Column, Table};
use crate::units::to_mm;

/// The turn table, one row a turn, in order along the fibre from z = 0; every number reads back to the same double.
pub fn csv(winding: &Winding) -> String {
    let mut text = "half,layer,turn,y_mm,r_mm,z_start_m,z_end_m\n".to_owned();
    for turn in winding.turns() {
        let (half, y, r) = (name(turn.half), to_mm(turn.y), to_mm(turn.r));
        let _ = writeln!(text, "{half},{},{},{y},{r},{},{}", turn.layer, turn.turn, turn.z_start, turn.z_end);
    }
    text
}

/// The turn table, a row a turn, in order along the fibre from z = 0.
pub fn turns(winding: &Winding) -> Table {
    let all = winding.turns();
    let numbers = |name: &str, of: fn(&Turn) -> f64| Column::numbers(name, all.iter().map(|turn| Some(of(turn))).collect());
    let whole = |name: &str, of: fn(&Turn) -> usize| Column::whole(name, all.iter().map(|turn| of(turn) as i64).collect());
    let columns = vec![
        Column::texts("half", all.iter().map(|turn| Some(name(turn.half).to_owned())).collect()),
        whole("layer", |turn| turn.layer),
        whole("turn", |turn| turn.turn),
        numbers("y_mm", |turn| to_mm(turn.y)),
        numbers("r_mm", |turn| to_mm(turn.r)),
        numbers("z_start_m", |turn| turn.z_start),
        numbers("z_end_m", |turn| turn.z_end),
    ];
    Table { columns, about: Vec::new() }
}

/// `CW` or `CCW`.
pub fn name(half: Half) -> &'static str {
    match half {
        Half::Cw => "CW",
        Half::Ccw => "CCW",
    }
}

/// The winding; `fibre_m` holds the tails too, moments as in [`text`].
pub fn json(case: &CoilCase) -> Value {
    let (winding, spec) = (&case.winding, case.winding.spec());
    json!({
        "name": case.name,
        "pattern": format!("{:?}", spec.pattern),
        "fibre_m": winding.length(),
        "tails_m": {"cw": spec.tails.cw, "ccw": spec.tails.ccw},
        "layers": spec.layers,
        "turns": winding.turns().len(),
        "turns_cw": winding.count(Half::Cw),
        "turns_ccw": winding.count(Half::Ccw),
        "inner_diameter_mm": 2.0 * to_mm(spec.inner_radius),
        "outer_diameter_mm": 2.0 * to_mm(winding.outer_radius()),
        "height_mm": to_mm(winding.height()),
        "radial_first_moment_m3": winding.moment(1, 0),
        "axial_first_moment_m3": winding.moment(0, 1),
    })
}

/// The winding, in a few lines.
pub fn text(case: &CoilCase) -> String {
    let (winding, spec) = (&case.winding, case.winding.spec());
    let row = |name: &str, value: String, unit: &str| vec![name.to_owned(), value, unit.to_owned()];
    let rows = [
        row("fibre", format!("{:.4}", winding.length()), "m, tails included"),
        row("tails CW, CCW", format!("{}, {}", spec.tails.cw, spec.tails.ccw), "m"),
        row("layers", spec.layers.to_string(), ""),
        row("turns", winding.turns().len().to_string(), ""),
        row("turns CW, CCW", format!("{}, {}", winding.count(Half::Cw), winding.count(Half::Ccw)), ""),
        row("inner diameter", format!("{:.4}", 2.0 * to_mm(spec.inner_radius)), "mm"),
        row("outer diameter", format!("{:.4}", 2.0 * to_mm(winding.outer_radius())), "mm, half a pitch beyond the last layer"),
        row("height", format!("{:.4}", to_mm(winding.height())), "mm, half a pitch beyond the last turn"),
        row("radial first moment", significant(winding.moment(1, 0), 7), "m^3, sum of W (r - mean r), W = int (L - 2z) dz"),
        row("axial first moment", significant(winding.moment(0, 1), 7), "m^3, sum of W (y - mean y)"),
    ];
    format!("{}: {:?} winding\n\n{}", case.name, spec.pattern, table(&rows))
}
