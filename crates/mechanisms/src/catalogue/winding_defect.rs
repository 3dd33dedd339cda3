//! One layer that holds turns too many or too few.

use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use coil::Design;
use diagnosis::Prior;
use winding::LayerDefect;

pub(super) const WINDING_DEFECT: Named = Named {
    id: "winding-defect",
    title: "A layer with turns too many or too few",
    stage: Stage::Winding,
    equation: "Layer k holds N_k + n turns, spread evenly over its unchanged width. The half that owns the layer is longer by 2π r_k n, every turn beyond\n\
        it moves along the fibre, and the layer's own share of Σ (L − 2z) grows.",
    place: "The winding: `winding.defect` of a design; layers count from the inside, and each is tried.",
    signature: "A longer half acts like a tail. Only the layer's own temperature and strain, which differ from the mean of the coil in transients, show which\n\
        layer it is. With 36 layers to choose from, the mechanism imitates any other one that moves the middle of the fibre.",
    source: "N. J. Frigo, *Proc. SPIE* 412, 268 (1983), for the balance of a pattern.",
    meaning: "one layer has turns too many (+) or too few (−)",
    inspection: "count the turns of each layer in the winding record, or section a sister unit",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Rewinds { turns: 0, changed: with_defect }],
    extent: |_, sight| {
        // a layer among all is not located
        let half = sight.design.winding.layers as f64 / 2.0;
        let few = sight.choices.filter(|[first, last]| last - first < half);
        Extent { layers: few.map(|ends| ends.map(|layer| layer as usize)), ..Extent::default() }
    },
    caveat: |_| Some("turns are whole in this file"),
    offer: |design, _| {
        let layers = design.winding.layers.min(MOST_LAYERS);
        let choice = Some(("layer".to_owned(), (1..=layers).map(|k| k as f64).collect()));
        Some(Offer { choice, ..Offer::one("turns", Prior::Normal { mean: 0.0, sd: 3.0 }, &[0.0]) })
    },
    effect: |chain, record, active| {
        let layer = active.choice.unwrap_or(1.0) as usize;
        let most = MOST_TURNS.min((chain.library().design().winding.turns_even_layers / 2) as f64 - 1.0).max(0.0);
        Ok(Effect::Coil(Change::of_parts(chain.with_turns(record, layer, active.values[0].clamp(-most, most))?)))
    },
    extended: |design, active| Some(with_defect(design, active.choice? as usize, active.values[0].round() as i32)),
};

/// Layers that are compared one by one.
const MOST_LAYERS: usize = 200;
/// More turns than this, or than half of a layer's, are no defect but another design.
const MOST_TURNS: f64 = 40.0;

fn with_defect(design: &Design, layer: usize, turns: i32) -> Design {
    let mut changed = design.clone();
    changed.winding.defect = (turns != 0).then_some(LayerDefect { layer, turns });
    changed
}
