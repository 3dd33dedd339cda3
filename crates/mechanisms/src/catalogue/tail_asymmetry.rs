//! Tails of unequal length outside the winding: they shift every z.

use crate::design::with_tail;
use crate::mechanism::Change;
use crate::mechanism::{Effect, Extent, Facts, Mechanism, Naming, Offer, Stage, Steady};
use crate::{Chain, Prepared};
use coil::MechanicalState;
use coil::{Design, Error};
use diagnosis::{Active, Prior};

pub(crate) const ID: &str = "tail-asymmetry";

pub(super) struct TailAsymmetry;

impl Mechanism for TailAsymmetry {
    fn facts(&self) -> Facts<'_> {
        Facts {
            id: ID,
            title: "Tails of unequal length",
            stage: Stage::Winding,
            equation: "Bare fibre beyond the winding, longer on one end by Δ = CW tail − CCW tail, at the spool's temperature and free to expand. It moves the\n\
                middle of the fibre: with z the place along the fibre and L its length, every weight L − 2z of\n\
                \n\
                ```\n\
                Ω(t) = n/(L D) ∫₀ᴸ dφ′/dt(z) (L − 2z) dz\n\
                ```\n\
                \n\
                shifts by Δ, and the tails add their own share. φ′ is the phase per length of eqs. (1) and (2) of the paper.",
            place: "The winding, before the optics: `winding.tails_m` of the coil file.",
            signature: "Shifting all weights by one constant weighs the coil's mean phase rate: nearly a gain on the rate in a slow ramp, which a changed coil\n\
                gives as well. What is left to tell them is the transient, in which the mean of the coil and its ends do not follow the chamber alike.",
            source: "D. M. Shupe, *Applied Optics* 19, 654 (1980); F. Mohr, *Journal of Lightwave Technology* 14, 27 (1996).",
            naming: Naming::Named {
                meaning: "the fibre's tails outside the winding are of unequal length; tail_m is the CW one less the CCW one",
                inspection: "measure both tails' lengths outside the winding",
            },
            heat_path: None,
            steady: vec![Steady::Changes { parameter: 0, changed: |d, x| (with_tail(d, x), MechanicalState::NOMINAL), when: "" }],
            extent: Extent::everywhere,
            caveat: |_| None,
        }
    }

    fn offer(&self, _: &Design, _: [f64; 2]) -> Option<Offer> {
        Some(Offer::one("tail_m", Prior::Normal { mean: 0.0, sd: 0.5 }, &[0.0]))
    }

    fn effect(&self, chain: &Chain, record: &Prepared, active: &Active) -> Result<Effect, Error> {
        Ok(Effect::Coil(Change::of_parts(chain.with_tail(record, active.values[0])?)))
    }

    fn extended(&self, design: &Design, active: &Active) -> Option<Design> {
        Some(with_tail(design, active.values[0]))
    }
}
