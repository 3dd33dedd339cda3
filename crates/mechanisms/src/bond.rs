//! The changes that open shares of a bond of coil and flange make, as they are modelled.

use crate::course::{Functionals, Parts};
use crate::interpolation::cubic_weights;
use coil::Parameter;

/// Shares that may be open: of less nothing is seen, beyond it hardly anything holds.
pub(crate) const LEAST: f64 = 0.01;
pub(crate) const MOST: f64 = 0.9;
/// Steps of the shares that are modelled: near the rim, and in layers of the winding further in.
const NEAR_THE_RIM: f64 = 0.01;
const OF_A_LAYER: f64 = 0.5;
/// Share from which the layers alone say how fine the steps are.
const RIM: f64 = 0.1;
/// Ratio of the shares at which the constants' slopes are modelled: these do not turn back with the layers, as misfit at the crack's tip does.
const OF_SLOPES: f64 = 1.6;

/// Constants whose slopes are modelled share by share, beside the coil's transverse expansion. The spool's stiffness does nothing that shows beside them.
pub(crate) const FOLLOWED: [Parameter; 5] = [
    Parameter::TransverseModulus,
    Parameter::AxialModulus,
    Parameter::TransversePoisson,
    Parameter::AxialExpansion,
    Parameter::SpoolExpansion,
];

/// A bond that may open.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Bond<T> {
    /// by the open share
    pub(crate) openings: Vec<Opened<T>>,
    /// by fewer shares, each with what is added for a relative change of each of [`FOLLOWED`] by 1
    pub(crate) slopes: Vec<(f64, Vec<T>)>,
}

/// The change that an open share of a bond makes.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Opened<T> {
    pub(crate) share: f64,
    pub(crate) drawn: T,
    /// what is added for a relative change of the coil's transverse expansion by 1
    pub(crate) per_expansion: T,
}

/// Weights of openings and of slopes at an open share.
pub(crate) struct Weights {
    openings: Vec<f64>,
    slopes: Vec<f64>,
}

/// Open shares at which a bond is modelled: the response follows the layers of a winding, and turns back within two of them; at the rim it begins like a root.
pub(crate) fn shares(layers: usize) -> Vec<f64> {
    let along = OF_A_LAYER / layers as f64;
    let next = |share: &f64| {
        let step = if *share < RIM { along.min(NEAR_THE_RIM) } else { along };
        // the last step takes up what is left
        (*share < MOST).then_some(if share + 1.5 * step < MOST { share + step } else { MOST })
    };
    std::iter::successors(Some(LEAST), next).collect()
}

/// Those of the `shares` at which slopes are modelled.
pub(crate) fn of_slopes(shares: &[f64]) -> Vec<f64> {
    let mut kept: Vec<f64> = Vec::new();
    for share in shares {
        if kept.last().is_none_or(|last| *share >= OF_SLOPES * last || *share == MOST) {
            kept.push(*share);
        }
    }
    kept
}

/// Constants that change what an opening does, in the order of [`Bond::add_to`].
pub(crate) fn constants() -> impl Iterator<Item = Parameter> {
    std::iter::once(Parameter::TransverseExpansion).chain(FOLLOWED)
}

impl<T> Bond<T> {
    /// Of each share the change as it is drawn, per relative change of the transverse expansion, and of some per that of each of [`FOLLOWED`].
    pub(crate) fn new(of: Vec<(f64, Vec<T>)>) -> Self {
        let (mut openings, mut slopes) = (Vec::new(), Vec::new());
        for (share, of) in of {
            let mut of = of.into_iter();
            if let (Some(drawn), Some(per_expansion)) = (of.next(), of.next()) {
                openings.push(Opened { share, drawn, per_expansion });
            }
            let followed: Vec<T> = of.collect();
            if !followed.is_empty() {
                slopes.push((share, followed));
            }
        }
        Self { openings, slopes }
    }

    /// All that is modelled, in one order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &T> {
        let openings = self.openings.iter().flat_map(|opened| [&opened.drawn, &opened.per_expansion]);
        openings.chain(self.slopes.iter().flat_map(|(_, slopes)| slopes))
    }

    /// The same of something else, made in the order of [`Self::iter`].
    pub(crate) fn map<U>(&self, mut of: impl FnMut(&T) -> U) -> Bond<U> {
        let opened = |opened: &Opened<T>| {
            let [drawn, per_expansion] = [&opened.drawn, &opened.per_expansion].map(&mut of);
            Opened { share: opened.share, drawn, per_expansion }
        };
        let openings = self.openings.iter().map(opened).collect();
        let slopes = self.slopes.iter().map(|(share, slopes)| (*share, slopes.iter().map(&mut of).collect())).collect();
        Bond { openings, slopes }
    }

    /// Weights at an open share.
    pub(crate) fn weights(&self, share: f64) -> Weights {
        let at = |shares: &mut dyn Iterator<Item = f64>| {
            // nothing open changes nothing
            let nodes: Vec<f64> = std::iter::once(0.0).chain(shares).collect();
            cubic_weights(&nodes, share.clamp(0.0, nodes[nodes.len() - 1])).split_off(1)
        };
        let openings = at(&mut self.openings.iter().map(|opened| opened.share));
        Weights { openings, slopes: at(&mut self.slopes.iter().map(|(share, _)| *share)) }
    }
}

impl Bond<Functionals> {
    /// The same about other constants, each changed by so much of itself.
    pub(crate) fn moved(mut self, relative: impl Fn(Parameter) -> f64) -> Self {
        let (expansion, followed) = (relative(Parameter::TransverseExpansion), FOLLOWED.map(relative));
        let at: Vec<Weights> = self.openings.iter().map(|opened| self.weights(opened.share)).collect();
        for (opened, at) in self.openings.iter_mut().zip(&at) {
            add(&mut opened.drawn, expansion, &opened.per_expansion);
            scale(&mut opened.per_expansion, 1.0 + expansion);
            for (weight, (_, slopes)) in at.slopes.iter().zip(&self.slopes) {
                slopes.iter().zip(followed).for_each(|(slope, moved)| add(&mut opened.drawn, weight * moved, slope));
            }
        }
        for (_, slopes) in &mut self.slopes {
            slopes.iter_mut().zip(followed).for_each(|(slope, moved)| scale(slope, 1.0 + moved));
        }
        self
    }
}

fn add(to: &mut Functionals, much: f64, of: &Functionals) {
    to.iter_mut().zip(of).for_each(|(to, of)| to.axpy(much, of, 1.0));
}

fn scale(functionals: &mut Functionals, factor: f64) {
    functionals.iter_mut().for_each(|part| *part *= factor);
}

impl Bond<Parts> {
    /// Adds so much of what is open in a row: to the change as it is, and to those per relative change of each of the [`constants`].
    pub(crate) fn add_to(&self, change: &mut Parts, per: &mut [Parts], at: &Weights, row: usize, much: f64) {
        let add = |sum: &mut Parts, weight: f64, of: &Parts| {
            sum.iter_mut().zip(of).for_each(|(sum, part)| sum[row] += much * weight * part[row]);
        };
        for (weight, opened) in at.openings.iter().zip(&self.openings).filter(|(weight, _)| **weight != 0.0) {
            add(change, *weight, &opened.drawn);
            add(&mut per[0], *weight, &opened.per_expansion);
        }
        for (weight, (_, slopes)) in at.slopes.iter().zip(&self.slopes).filter(|(weight, _)| **weight != 0.0) {
            per[1..].iter_mut().zip(slopes).for_each(|(per, slope)| add(per, *weight, slope));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    #[test]
    fn shares_follow_the_layers_and_end_where_hardly_anything_holds() {
        for layers in [1, 2, 8, 36, 80, 200] {
            let all = shares(layers);
            assert_eq!((all[0], all[all.len() - 1]), (LEAST, MOST), "{layers}");
            let step = OF_A_LAYER / layers as f64;
            for w in all.windows(2) {
                let finest = if w[0] < RIM { step.min(NEAR_THE_RIM) } else { step };
                assert!(w[1] > w[0] && w[1] - w[0] < 1.5 * finest + 1e-12, "{layers}: {w:?}");
            }
            let coarse = of_slopes(&all);
            assert_eq!((coarse[0], coarse[coarse.len() - 1]), (LEAST, MOST), "{layers}");
            assert!(coarse.iter().all(|share| all.contains(share)) && coarse.len() < 18, "{layers}: {coarse:?}");
        }
    }

    /// Changes that are cubic in the share and nothing at none are followed exactly, those of one row alone.
    #[test]
    fn exact_what_is_cubic_in_the_share_is_followed() {
        let of = |factor: f64, share: f64| [0, 1, 2].map(|p: usize| vec![factor * share * (1.0 + p as f64 * share * share); 2]);
        let all = shares(8);
        let count = |share: &f64| if of_slopes(&all).contains(share) { 2 + FOLLOWED.len() } else { 2 };
        let bond = Bond::new(all.iter().map(|x| (*x, (1..=count(x)).map(|k| of(k as f64, *x)).collect())).collect());
        assert_eq!(bond.iter().count(), 2 * all.len() + FOLLOWED.len() * of_slopes(&all).len());
        let none = || [0, 1, 2].map(|_: usize| vec![0.0; 2]);
        for share in [0.0, 0.004, 0.033, 0.27, 0.9] {
            let (mut change, mut per) = (none(), vec![none(); 1 + FOLLOWED.len()]);
            bond.add_to(&mut change, &mut per, &bond.weights(share), 1, 0.5);
            for (factor, told) in (1..).zip(std::iter::once(&change).chain(&per)) {
                for (told, exact) in told.iter().zip(of(0.5 * f64::from(factor), share)) {
                    assert!(told[0] == 0.0 && (told[1] - exact[1]).abs() < 1e-12, "{share}: {told:?} for {}", exact[1]);
                }
            }
        }
        let doubled = bond.map(|parts| parts[0][0] * 2.0);
        assert!(doubled.iter().zip(bond.iter()).all(|(a, b)| (a - 2.0 * b[0][0]).abs() < 1e-15));
    }

    /// A coil whose expansion is a tenth more and whose stiffness a fifth: each slope acts at every share, those between the slopes', too, and follows its constant.
    #[test]
    fn exact_a_bond_is_moved_to_other_constants() {
        let of = |number: f64| [0, 1, 2].map(|p: usize| DVector::from_element(2, number * (1.0 + p as f64)));
        let all = shares(8);
        let coarse = of_slopes(&all);
        let each = |share: &f64| {
            let slopes = if coarse.contains(share) { FOLLOWED.len() } else { 0 };
            (*share, (1..=2 + slopes).map(|k| of(share * k as f64)).collect())
        };
        let moved = Bond::new(all.iter().map(each).collect()).moved(|constant| match constant {
            Parameter::TransverseExpansion => 0.1,
            Parameter::TransverseModulus => 0.2,
            _ => 0.0,
        });
        for opened in &moved.openings {
            for (part, factor) in opened.drawn.iter().zip([1.0, 2.0, 3.0]) {
                // 1 as drawn, 2 per expansion, 3 per stiffness
                assert!((part[1] - opened.share * factor * (1.0 + 0.2 + 0.6)).abs() < 1e-12, "{}: {part}", opened.share);
            }
            assert!((opened.per_expansion[0][0] - 2.2 * opened.share).abs() < 1e-12);
        }
        for (share, slopes) in &moved.slopes {
            assert!((slopes[0][0][0] - 3.6 * share).abs() < 1e-12 && (slopes[1][0][0] - 4.0 * share).abs() < 1e-12);
        }
    }
}
