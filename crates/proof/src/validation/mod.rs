//! The whole chain once, against the paper's Tables I to IV and an independent code.

mod cell;
mod coil;
mod fixtures;
mod nominal;
pub mod report;
mod row;
mod spread;
mod winding;

pub use row::{Agreement, ComparisonRow, Section, Verdict};

use crate::Failure;
use fixtures::Fixtures;

/// S over spools: (material, hub, flanges; S \[(deg/h)/(degC/min)\]).
/// [`Failure`] if a fixture cannot be read or a system not be solved.
pub fn over_spools() -> Result<Vec<(String, f64)>, Failure> {
    Ok(spread::over_spools(&Fixtures::read()?)?.lines)
}

/// |S| of the paper's theoretical model (Table IV) \[(deg/h)/(degC/min)\], and its label.
/// [`Failure`] if a fixture cannot be read.
pub fn printed() -> Result<(String, f64), Failure> {
    let fixtures = Fixtures::read()?;
    let row = fixtures.printed("IV.theory")?;
    Ok((format!("printed, Table {}: {}", row.table, row.printed), row.value()?))
}

/// Everything computed and compared, table by table; `step` is told what comes next.
/// [`Failure`] if a fixture cannot be read or a system not be solved.
pub fn compared(step: impl Fn(&str)) -> Result<[Section; 5], Failure> {
    let fixtures = Fixtures::read()?;
    step("Table I: reference cell");
    let (table_1, cell) = cell::table_1(&fixtures)?;
    step("Table II: dehomogenisation");
    let table_2 = cell::table_2(&fixtures, &cell)?;
    step("Table III: winding");
    let table_3 = winding::table_3(&fixtures)?;
    step("Table IV: sensitivity, spools, tails, error estimates (some 10 s)");
    let table_4 = coil::table_4(&fixtures, &cell.constants)?;
    step("five profiles in time against an independent code (some 10 s)");
    let nominal = nominal::nominal(&fixtures)?;
    Ok([table_1, table_2, table_3, table_4, nominal])
}
