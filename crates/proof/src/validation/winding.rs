//! Table III: the winding, from the pattern alone.

use super::cell::NINE_DIGITS;
use super::fixtures::{Fixtures, Printed};
use super::row::{Agreement, ComparisonRow, Section, rounds_to};
use crate::Failure;
use winding::{Half, Pattern, Spec, wind};

fn row(printed: &Printed, computed: f64, kind: Agreement) -> ComparisonRow {
    // counts are exact
    ComparisonRow::beside(printed, computed, if printed.unit == "-" { 0.0 } else { NINE_DIGITS }, kind)
}

fn must_round(row: ComparisonRow) -> ComparisonRow {
    let printed = row.printed.clone().unwrap_or_default();
    let holds = rounds_to(&printed, row.computed, row.numerical_error);
    row.required(holds)
}

fn counted(id: &str, quantity: &str, computed: usize, expected: usize, reason: &str) -> ComparisonRow {
    let row = ComparisonRow::shown([id, quantity, "-"], computed as f64, 0.0, Agreement::Predicted);
    row.required(computed == expected).because(reason)
}

pub(crate) fn table_3(fixtures: &Fixtures) -> Result<Section, Failure> {
    let spec = fixtures.coil.winding;
    let coil = wind(&spec)?;
    let mut section = Section::new("Table III: winding");
    section.note(
        "From pitch, layers, loops and inner radius by the practical pattern. Layers, loops and inner radius are inputs; the pitch is \
         the printed height over 106 loops; length, turn counts and outer diameter follow. Three entries are printed wrongly.",
    );
    let at = |id: &str| fixtures.printed(id);
    let full = wind(&Spec { pattern: Pattern::Quadrupole, turns_even_layers: spec.turns_odd_layers, ..spec })?;
    let length = format!(
        "an orthocyclic even layer sits in the grooves of the one below and holds one turn fewer, {}; {} everywhere would give {:.2} m",
        spec.turns_even_layers,
        spec.turns_odd_layers,
        full.length()
    );
    section.rows.push(must_round(row(at("III.length")?, coil.length(), Agreement::Predicted)).because(&length));
    let layers = coil.turns().iter().map(|t| t.layer).max().unwrap_or(0);
    section.rows.push(must_round(row(at("III.layers")?, layers as f64, Agreement::Identified)).because("an input"));
    let loops = |layer: usize| coil.turns().iter().filter(|t| t.layer == layer).count();
    let text = format!("holds for odd layers; even layers have {} (see the length)", loops(2));
    let everywhere = loops(1) == 106 && loops(2) == 106;
    section.rows.push(row(at("III.loops")?, loops(1) as f64, Agreement::Misprint).compared(everywhere, text));
    let diameter = "printed as a radius, but it is the diameter";
    section.rows.push(must_round(row(at("III.inner")?, 2.0 * spec.inner_radius, Agreement::Misprint)).because(diameter));
    section.rows.push(must_round(row(at("III.outer")?, 2.0 * coil.outer_radius(), Agreement::Misprint)).because(diameter));
    let height = must_round(row(at("III.height")?, coil.height(), Agreement::Identified));
    section.rows.push(height.because("the pitch is this height over 106 loops"));
    let turns = coil.turns().len();
    section.rows.push(counted("III.turns", "turns", turns, 3798, "18 layers of 106 and 18 of 105"));
    let (cw, ccw) = (coil.count(Half::Cw), coil.count(Half::Ccw));
    section.rows.push(counted("III.cw", "turns of the CW half", cw, 1899, "the first turn of each layer is CCW, the last CW"));
    section.rows.push(counted("III.ccw", "turns of the CCW half", ccw, 1899, "the first turn of each layer is CCW, the last CW"));
    Ok(section)
}
