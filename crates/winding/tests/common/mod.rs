//! Coils that the tests share.

#![allow(dead_code, reason = "each test binary uses its part")]

use proptest::prelude::*;
use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength};

/// The paper's coil, Table III.
pub(crate) const REFERENCE: Spec = Spec {
    pattern: Pattern::PracticalQuadrupole,
    layers: 36,
    turns_odd_layers: 106,
    turns_even_layers: 105,
    inner_radius: 43.5e-3,
    pitch: 0.170e-3,
    start: 0.0,
    end: None,
    cw_climbs: ClimbSide::Right,
    turn_length: TurnLength::True,
    tails: Tails { cw: 0.0, ccw: 0.0 },
    defect: None,
};

/// Any valid coil of up to 24 layers and 40 turns a layer, of the given patterns.
pub(crate) fn any_spec(patterns: &'static [Pattern]) -> impl Strategy<Value = Spec> {
    let choices = (
        prop::sample::select(patterns),
        prop::sample::select(&[ClimbSide::Left, ClimbSide::Right][..]),
        prop::sample::select(&[TurnLength::True, TurnLength::Equal][..]),
    );
    let counts = (1_usize..=24, 3_usize..=40, 0_usize..=1);
    let lengths = (1e-3..0.5_f64, 5e-5..1e-3_f64, prop::option::of((0.0..3.0_f64, 0.0..3.0_f64)));
    (choices, counts, lengths).prop_map(|(choices, (layers, turns, fewer), (inner_radius, pitch, tails))| {
        let (cw, ccw) = tails.unwrap_or((0.0, 0.0));
        Spec {
            pattern: choices.0,
            layers,
            turns_odd_layers: turns,
            turns_even_layers: turns - fewer,
            inner_radius,
            pitch,
            start: 0.0,
            end: None,
            cw_climbs: choices.1,
            turn_length: choices.2,
            tails: Tails { cw, ccw },
            defect: None,
        }
    })
}

/// Every pattern.
pub(crate) const ALL: &[Pattern] =
    &[Pattern::Cylindrical, Pattern::Dipole, Pattern::Quadrupole, Pattern::PracticalQuadrupole, Pattern::Octupole];
