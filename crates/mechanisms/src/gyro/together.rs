//! Several changes of the parts of the bias at once.

use super::recalibrated::{ByHeat, Recalibrated};
use crate::change::Change;
use crate::course::{Parts, add};

/// A change among others.
pub(super) struct Acting<'a> {
    pub(super) change: &'a Change,
    /// share of every nominal part in its change
    pub(super) gain: [f64; 3],
    pub(super) kind: Kind,
    /// relative changes of the constants that it names, in their order
    pub(super) moved: Vec<f64>,
    /// by how much the CW tail is longer than drawn \[m\]
    pub(super) tail: f64,
}

impl Acting<'_> {
    /// Change of a part in every row.
    fn of(&self, part: usize) -> Vec<f64> {
        let mut changed = self.change.parts[part].clone();
        for (per, moved) in self.change.per.iter().zip(&self.moved).filter(|(_, moved)| **moved != 0.0) {
            add(&mut changed, &per.parts[part], *moved);
        }
        if let Some(per_tail) = self.change.apart.as_ref().filter(|_| self.tail != 0.0) {
            add(&mut changed, &per_tail[part], self.tail);
        }
        changed
    }
}

/// The way in which a change goes with what the constants do.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    /// it changes the temperatures
    Path,
    /// it weighs the turns otherwise, or lets the coil go: what the constants do to the temperatures alone is a gain on it, and it on that
    Beside,
    /// it says itself what constants do to it
    Apart,
    Other,
}

/// Parts of the bias with the nominal model's constants moved and `changes` at work, of which each is that of the `nominal` parts.
///
/// A path of heat changes the temperatures that all others act on: its gain on a part is one on their changes, too, and theirs is one on what it adds
/// beyond its gain. The others act on different things, and their changes add up: a tail's share of a part that cancels nearly, as a
/// quadrupole's does, says nothing of what it does to a softer coil. What the tolerance of the tails adds is of that kind, too. So a change of the winding, or
/// of its bond, goes with what constants do `by_heat`, and adds to what others do.
pub(super) fn together(nominal: &Parts, without: &Recalibrated, by_heat: Option<&ByHeat>, changes: &[Acting]) -> Parts {
    let mut parts = without.parts.clone();
    for (p, part) in parts.iter_mut().enumerate() {
        let of_paths = |but: Option<usize>| {
            let paths = changes.iter().enumerate().filter(|(k, acting)| acting.kind == Kind::Path && Some(*k) != but);
            paths.fold(1.0, |gain, (_, acting)| gain * (1.0 + acting.gain[p]))
        };
        let (all_paths, of_constants) = (of_paths(None), without.gain[p]);
        let of_others = 1.0
            + changes
                .iter()
                .filter(|acting| ![Kind::Path, Kind::Apart].contains(&acting.kind))
                .map(|acting| acting.gain[p])
                .sum::<f64>();
        part.iter_mut().zip(&without.of_tails[p]).for_each(|(rate, of_tails)| *rate = all_paths * (*rate + of_tails));
        for (k, acting) in changes.iter().enumerate() {
            let own = acting.gain[p];
            let (moved, of_constants) = match by_heat {
                Some(by_heat) if acting.kind == Kind::Beside => (&by_heat.parts[p], by_heat.gain[p]),
                _ => (&without.parts[p], of_constants),
            };
            let changed = acting.of(p);
            if acting.kind == Kind::Apart {
                // the chamber's thermometer says nothing of it
                add(part, &changed, all_paths * without.factors[p] / without.factors[1]);
                continue;
            }
            let rows = part.iter_mut().zip(changed).zip(nominal[p].iter().zip(moved));
            if acting.kind == Kind::Path {
                let beyond = of_constants * of_paths(Some(k)) * of_others;
                rows.for_each(|((rate, changed), (nominal, _))| *rate += beyond * (changed - own * nominal));
            } else {
                // constants that moved act on the change by their gain, and it on what they do beyond
                rows.for_each(|((rate, changed), (nominal, moved))| {
                    *rate += all_paths * (of_constants * changed + own * (moved - of_constants * nominal));
                });
            }
        }
    }
    parts
}

#[cfg(test)]
mod tests {
    use std::sync::OnceLock;

    use super::*;

    const NOMINAL: [f64; 4] = [1.0, -2.0, 0.5, 0.25];

    fn parts(series: [f64; 4]) -> Parts {
        [series.to_vec(), series.map(|x| 2.0 * x).to_vec(), vec![0.0; 4]]
    }

    fn change(series: [f64; 4]) -> Change {
        Change::of_parts(parts(series))
    }

    fn at(series: [f64; 4], gain: f64) -> Recalibrated {
        let of_tails = parts([0.0; 4]);
        let (at, thermometer, by_heat) = (Vec::new(), Vec::new(), OnceLock::new());
        let (gain, factors) = ([gain; 3], [1.0; 3]);
        Recalibrated { record: 0, at, parts: parts(series), of_tails, thermometer, gain, factors, by_heat }
    }

    fn acting(change: &Change, gain: f64, is_path: bool) -> Acting<'_> {
        Acting { change, gain: [gain; 3], kind: if is_path { Kind::Path } else { Kind::Other }, moved: Vec::new(), tail: 0.0 }
    }

    fn first(changes: &[Acting], without: &Recalibrated) -> Vec<f64> {
        let [first, ..] = together(&parts(NOMINAL), without, None, changes);
        first
    }

    fn near(a: &[f64], b: &[f64]) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12), "{a:?} {b:?}");
    }

    #[test]
    fn one_change_of_the_drawing_is_itself() {
        let (odd, drawing) = (change([0.3, 0.1, -0.2, 0.7]), at(NOMINAL, 1.0));
        for is_path in [true, false] {
            let sum: Vec<f64> = NOMINAL.iter().zip(&odd.parts[0]).map(|(a, b)| a + b).collect();
            near(&first(&[acting(&odd, 0.4, is_path)], &drawing), &sum);
        }
    }

    #[test]
    fn gains_multiply_where_one_is_a_path_of_heat_and_add_up_where_none_is() {
        let (twice, half) = (change(NOMINAL), change(NOMINAL.map(|x| 0.5 * x)));
        let both = |paths: [bool; 2], constants: f64| {
            let without = at(NOMINAL.map(|x| constants * x), constants);
            first(&[acting(&twice, 1.0, paths[0]), acting(&half, 0.5, paths[1])], &without)
        };
        for constants in [1.0, 1.1] {
            for paths in [[true, true], [true, false], [false, true]] {
                near(&both(paths, constants), &NOMINAL.map(|x| constants * 3.0 * x));
            }
            near(&both([false, false], constants), &NOMINAL.map(|x| constants * 2.5 * x));
        }
    }

    /// A change eighteen times the nominal bias, beside tails that differ by a little.
    #[test]
    fn tails_that_differ_are_no_gain_and_have_none() {
        let (tail, large) = ([0.5, 0.4, -0.3, 0.2], NOMINAL.map(|x| 18.0 * x));
        let without = Recalibrated { of_tails: parts(tail), ..at(NOMINAL, 1.0) };
        for is_path in [true, false] {
            let paths = if is_path { 19.0 } else { 1.0 };
            let sum: Vec<f64> = NOMINAL.iter().zip(&large).zip(&tail).map(|((n, l), t)| n + l + paths * t).collect();
            near(&first(&[acting(&change(large), 18.0, is_path)], &without), &sum);
        }
    }

    /// Constants that make the coil twice as warm, and a softer coil that adds half of the nominal bias: the winding's change is twice as large, and adds to that.
    #[test]
    fn a_change_of_the_winding_goes_with_heat_alone() {
        let (more, large) = (change(NOMINAL.map(|x| 0.7 * x)), change([0.3, 0.1, -0.2, 0.7]));
        let by_heat = ByHeat { parts: parts(NOMINAL.map(|x| 2.0 * x)), gain: [2.0; 3] };
        let without = at(NOMINAL.map(|x| 2.5 * x), 2.5);
        let winding = |change, gain| Acting { change, gain: [gain; 3], kind: Kind::Beside, moved: Vec::new(), tail: 0.0 };
        let [first, ..] = together(&parts(NOMINAL), &without, Some(&by_heat), &[winding(&more, 0.7), winding(&large, 0.2)]);
        let sum: Vec<f64> = NOMINAL.iter().zip(&large.parts[0]).map(|(n, l)| (2.5 + 1.4) * n + 2.0 * l).collect();
        near(&first, &sum);
    }

    #[test]
    fn the_order_of_changes_does_not_matter() {
        let (a, b, c) = (change([0.3, 0.1, -0.2, 0.7]), change([1.0, 0.0, 0.0, 2.0]), change([0.0, -1.0, 0.1, 0.0]));
        let without = at([1.2, -2.1, 0.4, 0.3], 1.07);
        let all = || [acting(&a, 0.4, true), acting(&b, -0.2, false), acting(&c, 0.1, true)];
        let mut turned = all();
        turned.reverse();
        near(&first(&all(), &without), &first(&turned, &without));
    }
}
