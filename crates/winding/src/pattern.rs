//! The order in which a pattern fills the places of the lattice.

use std::ops::RangeInclusive;

use crate::spec::{ClimbSide, Half, Pattern, Spec};

/// A place of the lattice and the half that takes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) half: Half,
    pub(crate) layer: usize,
    pub(crate) turn: usize,
}

/// All places in the order of the fibre, from the outer end of the CCW half to the outer end of the CW half.
pub(crate) fn places(spec: &Spec) -> Vec<Place> {
    let mut places = lay(spec, Half::Ccw);
    places.reverse();
    places.extend(lay(spec, Half::Cw));
    match spec.cw_climbs {
        ClimbSide::Right => {}
        ClimbSide::Left => {
            let turns = |layer| spec.turns_in(layer).saturating_add_signed(spec.surplus_in(layer));
            places.iter_mut().for_each(|place| place.turn = turns(place.layer) + 1 - place.turn);
        }
    }
    places
}

/// The places of one half in the order of laying, for a CW half that climbs at +y.
///
/// Both halves start towards +y and turn round after every layer they own; a single passing turn does not turn them.
fn lay(spec: &Spec, half: Half) -> Vec<Place> {
    let mut places = Vec::new();
    let mut owned_before = 0;
    for layer in 1..=spec.layers {
        let owned = owner(spec.pattern, layer) == half;
        let stretch = as_wound(spec, layer, owned, stretch(spec, half, layer, owned)).map(|turn| Place { half, layer, turn });
        if owned_before % 2 == 0 {
            places.extend(stretch);
        } else {
            places.extend(stretch.rev());
        }
        owned_before += usize::from(owned);
    }
    places
}

/// The turns of a layer that a half lays.
fn stretch(spec: &Spec, half: Half, layer: usize, owned: bool) -> RangeInclusive<usize> {
    let turns = spec.turns_in(layer);
    match (spec.pattern, half, owned) {
        (Pattern::PracticalQuadrupole, Half::Cw, true) => 2..=turns,
        (Pattern::PracticalQuadrupole, Half::Cw, false) => turns..=turns,
        (Pattern::PracticalQuadrupole, Half::Ccw, true) => 1..=turns - 1,
        (Pattern::PracticalQuadrupole, Half::Ccw, false) => 1..=1,
        (Pattern::Cylindrical | Pattern::Dipole | Pattern::Quadrupole | Pattern::Octupole, _, true) => 1..=turns,
        #[expect(clippy::reversed_empty_ranges, reason = "a half lays nothing in a layer it does not own")]
        (Pattern::Cylindrical | Pattern::Dipole | Pattern::Quadrupole | Pattern::Octupole, _, false) => 1..=0,
    }
}

/// A stretch with the turns that its layer has too many or too few.
fn as_wound(spec: &Spec, layer: usize, owned: bool, stretch: RangeInclusive<usize>) -> RangeInclusive<usize> {
    let (first, last) = stretch.into_inner();
    let more = |turn: usize| turn.saturating_add_signed(spec.surplus_in(layer));
    let passing_behind = !owned && first > 1;
    if owned {
        first..=more(last)
    } else if passing_behind {
        more(first)..=more(last)
    } else {
        first..=last
    }
}

/// First and last turn of a layer that its owner lays, as designed.
pub(crate) fn owned_stretch(spec: &Spec, layer: usize) -> (usize, usize) {
    let (first, last) = stretch(spec, owner(spec.pattern, layer), layer, true).into_inner();
    match spec.cw_climbs {
        ClimbSide::Right => (first, last),
        ClimbSide::Left => (spec.turns_in(layer) + 1 - last, spec.turns_in(layer) + 1 - first),
    }
}

impl Spec {
    /// Axial position of a turn's centre as wound \[m\].
    pub(crate) fn centre(&self, layer: usize, turn: usize) -> f64 {
        let surplus = self.surplus_in(layer);
        if surplus == 0 {
            return self.position(layer, turn);
        }
        let (first, last) = owned_stretch(self, layer);
        let designed = last + 1 - first;
        let wound = designed.saturating_add_signed(surplus);
        if turn < first {
            self.position(layer, turn)
        } else if turn < first + wound {
            let share = (turn - first) as f64 + 0.5;
            self.position(layer, first) + (share * designed as f64 / wound as f64 - 0.5) * self.spacing()
        } else {
            self.position(layer, turn.saturating_add_signed(-surplus))
        }
    }
}

/// The half that owns a layer. A cylindrical winding is laid as one CW half; its fibre is divided at the middle afterwards.
fn owner(pattern: Pattern, layer: usize) -> Half {
    let cw = match pattern {
        Pattern::Cylindrical => true,
        Pattern::Dipole => layer % 2 == 1,
        Pattern::Quadrupole | Pattern::PracticalQuadrupole => matches!(layer % 4, 0 | 1),
        Pattern::Octupole => matches!(layer % 8, 1 | 4 | 6 | 7),
    };
    if cw { Half::Cw } else { Half::Ccw }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Tails, TurnLength};

    fn spec(pattern: Pattern, layers: usize) -> Spec {
        Spec {
            pattern,
            layers,
            turns_odd_layers: 3,
            turns_even_layers: 2,
            inner_radius: 0.04,
            pitch: 2e-4,
            start: 0.0,
            end: None,
            cw_climbs: ClimbSide::Right,
            turn_length: TurnLength::True,
            tails: Tails { cw: 0.0, ccw: 0.0 },
            defect: None,
        }
    }

    /// (layer, turn) along the fibre, and how many of them are CCW.
    fn order(spec: &Spec) -> (Vec<(usize, usize)>, usize) {
        let places = places(spec);
        let ccw = places.iter().take_while(|place| place.half == Half::Ccw).count();
        assert!(places[ccw..].iter().all(|place| place.half == Half::Cw));
        (places.iter().map(|place| (place.layer, place.turn)).collect(), ccw)
    }

    #[test]
    fn owners_follow_the_names() {
        let owners =
            |pattern| -> String { (1..=16).map(|layer| if owner(pattern, layer) == Half::Cw { 'A' } else { 'B' }).collect() };
        assert_eq!(owners(Pattern::Dipole), "ABABABABABABABAB");
        assert_eq!(owners(Pattern::Quadrupole), "ABBAABBAABBAABBA");
        assert_eq!(owners(Pattern::PracticalQuadrupole), "ABBAABBAABBAABBA");
        assert_eq!(owners(Pattern::Octupole), "ABBABAABABBABAAB");
    }

    #[test]
    fn practical_quadrupole_of_five_layers() {
        let (places, ccw) = order(&spec(Pattern::PracticalQuadrupole, 5));
        let outside_in = [(5, 1), (4, 1), (3, 1), (3, 2), (2, 1), (1, 1)];
        let inside_out = [(1, 2), (1, 3), (2, 2), (3, 3), (4, 2), (5, 2), (5, 3)];
        assert_eq!(places, [&outside_in[..], &inside_out[..]].concat());
        assert_eq!(ccw, outside_in.len());
    }

    #[test]
    fn ideal_quadrupole_of_four_layers_on_the_other_hand() {
        let (places, ccw) = order(&Spec { cw_climbs: ClimbSide::Left, ..spec(Pattern::Quadrupole, 4) });
        let outside_in = [(3, 3), (3, 2), (3, 1), (2, 1), (2, 2)];
        let inside_out = [(1, 3), (1, 2), (1, 1), (4, 1), (4, 2)];
        assert_eq!(places, [&outside_in[..], &inside_out[..]].concat());
        assert_eq!(ccw, outside_in.len());
    }

    #[test]
    fn cylinder_of_three_layers() {
        let (places, _) = order(&spec(Pattern::Cylindrical, 3));
        assert_eq!(places, [(1, 1), (1, 2), (1, 3), (2, 2), (2, 1), (3, 1), (3, 2), (3, 3)]);
    }
}
