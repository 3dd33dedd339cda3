//! Tails of unequal length outside the winding: they shift every z.

use crate::design::with_tail;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use diagnosis::Prior;

pub(super) const TAIL_ASYMMETRY: Named = Named {
    id: "tail-asymmetry",
    title: "Tails of unequal length",
    stage: Stage::Winding,
    equation: "Bare fibre beyond the winding, longer on one end than drawn: Δ is how much CW tail − CCW tail exceeds the drawing's, at the spool's temperature and free to expand. It moves the\n\
        middle of the fibre: with z the place along the fibre and L its length, every weight L − 2z of\n\
        \n\
        ```\n\
        Ω(t) = n/(L D) ∫₀ᴸ dφ′/dt(z) (L − 2z) dz\n\
        ```\n\
        \n\
        shifts by Δ, and the tails add their own share. φ′ is the phase per length of eqs. (1) and (2) of the paper.",
    place: "The winding, before the optics: `winding.tails_m` of the coil file.",
    signature: "One constant added to all weights weighs the coil's mean phase rate: nearly a gain on the rate in a slow ramp. A changed coil gives the\n\
        same gain. Only the transient tells the two apart, because the mean of the coil and its ends follow the chamber differently.",
    source: "D. M. Shupe, *Applied Optics* 19, 654 (1980); F. Mohr, *Journal of Lightwave Technology* 14, 27 (1996).",
    meaning: "one of the fibre's tails outside the winding is longer than drawn; tail_m is the CW one less the CCW one, beyond what the drawing has",
    inspection: "measure both tails' lengths outside the winding, and take the drawing's difference off",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Design(with_tail)],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, _| Some(Offer::one("tail_m", Prior::Size { scale: 0.5 }, &[0.0])),
    effect: |chain, record, active| Ok(Effect::Coil(Change::of_parts(chain.with_tail(record, active.values[0])?))),
    extended: |design, active| Some(with_tail(design, active.values[0])),
};
