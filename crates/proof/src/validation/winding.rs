//! Table III: the winding, from the pattern alone.

use super::cell::NINE_DIGITS;
use super::fixtures::{Fixtures, Printed};
use super::row::{Agreement, ComparisonRow, Section, Verdict, rounds_to};
use crate::Failure;
use winding::{Half, Pattern, Spec, wind};

fn row(printed: &Printed, computed: f64, kind: Agreement) -> ComparisonRow {
    // counts are exact
    ComparisonRow::beside(printed, computed, if printed.unit == "-" { 0.0 } else { NINE_DIGITS }, kind)
}

/// A row of what is put in: it cannot fail, so nothing is tested.
fn given(printed: &Printed, value: f64, kind: Agreement, reason: &str) -> ComparisonRow {
    ComparisonRow { verdict: Verdict::Shown, ..row(printed, value, kind) }.because(reason)
}

fn must_round(row: ComparisonRow) -> ComparisonRow {
    let printed = row.printed.clone().unwrap_or_default();
    let holds = rounds_to(&printed, row.computed, row.numerical_error);
    row.required(holds)
}

fn counted(id: &str, quantity: &str, computed: usize, expected: usize, reason: &str) -> ComparisonRow {
    let row = ComparisonRow::shown([id, quantity, "-"], computed as f64, 0.0, Agreement::Verified);
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
    section.rows.push(given(at("III.layers")?, layers as f64, Agreement::Identified, "an input"));
    let loops = |layer: usize| coil.turns().iter().filter(|t| t.layer == layer).count();
    let text = format!("holds for odd layers; even layers have {} (see the length)", loops(2));
    let everywhere = loops(1) == 106 && loops(2) == 106;
    section.rows.push(row(at("III.loops")?, loops(1) as f64, Agreement::Misprint).compared(everywhere, text));
    let diameter = "printed as a radius, but it is the diameter";
    let input = format!("{diameter}; an input");
    section.rows.push(given(at("III.inner")?, 2.0 * spec.inner_radius, Agreement::Misprint, &input));
    section.rows.push(must_round(row(at("III.outer")?, 2.0 * coil.outer_radius(), Agreement::Misprint)).because(diameter));
    let pitch = "an input: the pitch is this height over 106 loops";
    section.rows.push(given(at("III.height")?, coil.height(), Agreement::Identified, pitch));
    let turns = coil.turns().len();
    section.rows.push(counted("III.turns", "turns", turns, 3798, "18 layers of 106 and 18 of 105"));
    let (cw, ccw) = (coil.count(Half::Cw), coil.count(Half::Ccw));
    section.rows.push(counted("III.cw", "turns of the CW half", cw, 1899, "the first turn of each layer is CCW, the last CW"));
    section.rows.push(counted("III.ccw", "turns of the CCW half", ccw, 1899, "the first turn of each layer is CCW, the last CW"));
    Ok(section)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inputs_are_shown_and_what_is_not_printed_is_verified() {
        let rows = table_3(&Fixtures::read().unwrap()).unwrap().rows;
        let row = |id: &str| rows.iter().find(|row| row.id == id).unwrap();
        for input in ["III.layers", "III.inner", "III.height"] {
            assert_eq!((row(input).verdict, row(input).must_hold), (Verdict::Shown, false), "{input}");
        }
        assert_eq!((row("III.length").kind, row("III.length").must_hold), (Agreement::Predicted, true));
        assert!(rows.iter().all(|row| row.printed.is_some() || row.kind == Agreement::Verified));
    }
}
