//! More or less adhesive than designed: other effective constants of the coil.

use crate::interpolation::nodes;
use crate::mechanism::{Effect, Extent, HeatPath, Named, Offer, Stage, Steady};
use coil::Design;
use diagnosis::Prior;

const ID: &str = "adhesive-content";

pub(super) const ADHESIVE_CONTENT: Named = Named {
    id: ID,
    title: "More or less adhesive",
    stage: Stage::Material,
    equation: "The polymer's share of the cross-section is v = v_0 + Δ. Rules of mixtures along the fibre (Voigt) and across it (Reuss), with the polymer's\n\
        constants such that Δ = 0 gives the design's:\n\
        \n\
        ```\n\
        E_z = (1 − v) E_g + v E_p,   α_z = ((1 − v) E_g α_g + v E_p α_p) / E_z\n\
        E_r, G ∝ 1/v,   α_r ∝ v,   1/k_r = (1 − v)/k_g + v/k_p\n\
        ρc = (1 − v) (ρc)_g + v (ρc)_p\n\
        ```\n\
        \n\
        with g the glass, fused silica, and p the polymer. v_0 follows from the design's E_z with E_p = 1 GPa; any E_p up to 3 GPa moves it by 0.03 at most.\n\
        A design whose constants are not those of silica in a polymer is not offered this mechanism.",
    place: "The material of the coil: `coil.material` and the heat capacity, from which mechanics and heat flow follow.",
    signature: "A softer coil that expands more changes the strain by nearly one factor everywhere. In slow ramps this is a gain, like that of a longer\n\
        tail. Heat capacity and conductivity change too, and these changes show in fast transients.",
    source: "R. Hill, *Journal of the Mechanics and Physics of Solids* 12, 199 (1964).",
    meaning: "the coil holds more (+) or less (−) polymer than designed, as a share of its volume",
    inspection: "weigh the coil before and after potting, or section a sister unit",
    columns: &[],
    heat_path: Some(|| HeatPath {
        places: |design| usize::from(glass(design).is_some()),
        nodes: nodes(-0.6, 0.6, 5),
        design: |design, _, x| with_polymer(design, x * glass(design).unwrap_or(0.0)),
        coordinate: None,
        nowhere: 0.0,
        nudge: None,
        factor_on: None,
        imitates: None,
    }),
    steady: &[Steady::Design(with_polymer)],
    extent: Extent::everywhere,
    caveat: |_| Some("the fibre is taken as silica, its share as the coil's stiffness along the fibre says"),
    offer: |design, _| {
        let prior = Prior::Normal { mean: 0.0, sd: PACKING * glass(design)? };
        Some(Offer::one("polymer_fraction_change", prior, &[0.0]))
    },
    effect: |chain, record, active| {
        let share = glass(chain.library().design()).unwrap_or(1.0);
        Ok(Effect::Coil(chain.along(record, ID, 0, active.values[0] / share)))
    },
    extended: |design, active| Some(with_polymer(design, active.values[0])),
};

/// Fused silica: E \[Pa\], α \[1/K\], k \[W/(m K)\], ρc \[J/(m³ K)\].
const GLASS: [f64; 4] = [70.2e9, 0.55e-6, 1.38, 2200.0 * 740.0];
/// E of coatings and adhesive together \[Pa\]: soft silicones have a thousandth of it, stiff epoxies three times as much; the share of glass that
/// follows moves by 0.03 at most.
const POLYMER_E: f64 = 1e9;
/// Shares of glass between which a coil is one of fibres in polymer.
const GLASS_SHARES: [f64; 2] = [0.02, 0.7];
/// Most glass that round fibres leave room for, and least that is left of the design's.
const MOST_GLASS: f64 = 0.9;
const LEAST_OF_GLASS: f64 = 0.1;
/// Standard deviation of the glass' share, relative: a winding is packed as closely as its pitch is kept.
const PACKING: f64 = 0.15;

/// Share of glass in a coil's cross-section, from its stiffness along the fibre; `None` where its constants are not those of silica in a polymer.
fn glass(design: &Design) -> Option<f64> {
    let body = &design.body;
    let [e_g, alpha_g, k_g, c_g] = GLASS;
    let share = (body.elastic.e_z - POLYMER_E) / (e_g - POLYMER_E);
    let of_polymer = [
        body.elastic.alpha_z * body.elastic.e_z - share * e_g * alpha_g,
        1.0 / body.conductivity_r - share / k_g,
        body.density * body.specific_heat - share * c_g,
    ];
    let fits = (GLASS_SHARES[0]..=GLASS_SHARES[1]).contains(&share) && of_polymer.iter().all(|constant| *constant > 0.0);
    fits.then_some(share)
}

/// More polymer by `change` of the cross-section: rules of mixtures along the fibre (Voigt) and across it (Reuss), with the polymer's
/// constants such that the nominal body has them.
fn with_polymer(design: &Design, change: f64) -> Design {
    let mut changed = design.clone();
    let Some(share) = glass(design) else { return changed };
    let body = &mut changed.body;
    let [e_g, alpha_g, k_g, c_g] = GLASS;
    let (v, new) = (1.0 - share, 1.0 - (share - change).clamp(LEAST_OF_GLASS * share, MOST_GLASS));
    let e = &mut body.elastic;
    let alpha_p = (e.alpha_z * e.e_z - (1.0 - v) * e_g * alpha_g) / (v * POLYMER_E);
    let k_p = v / (1.0 / body.conductivity_r - (1.0 - v) / k_g);
    let stored = body.density * body.specific_heat;
    let c_p = (stored - (1.0 - v) * c_g) / v;
    e.e_z = (1.0 - new) * e_g + new * POLYMER_E;
    e.alpha_z = ((1.0 - new) * e_g * alpha_g + new * POLYMER_E * alpha_p) / e.e_z;
    e.e_r *= v / new;
    e.g_zr *= v / new;
    e.alpha_r *= new / v;
    body.conductivity_r = 1.0 / ((1.0 - new) / k_g + new / k_p);
    body.specific_heat = ((1.0 - new) * c_g + new * c_p) / body.density;
    changed
}
