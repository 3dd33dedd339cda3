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
    equation: "The polymer's share of the cross-section is v = 0.80 + Δ. Rules of mixtures along the fibre (Voigt) and across it (Reuss), with the polymer's\n\
        constants such that Δ = 0 gives the design's:\n\
        \n\
        ```\n\
        E_z = (1 − v) E_g + v E_p,   α_z = ((1 − v) E_g α_g + v E_p α_p) / E_z\n\
        E_r, G ∝ 1/v,   α_r ∝ v,   1/k_r = (1 − v)/k_g + v/k_p\n\
        ρc = (1 − v) (ρc)_g + v (ρc)_p\n\
        ```\n\
        \n\
        with g the glass and p the polymer.",
    place: "The material of the coil: `coil.material` and the heat capacity, from which mechanics and heat flow follow.",
    signature: "A softer, more expanding coil changes the strain by nearly one factor everywhere: in slow ramps a gain, like a longer tail. Its heat capacity\n\
        and conductivity change too, and these show in fast transients.",
    source: "R. Hill, *Journal of the Mechanics and Physics of Solids* 12, 199 (1964).",
    meaning: "the coil holds more (+) or less (−) polymer than designed, as a share of its volume",
    inspection: "weigh the coil before and after potting, or section a sister unit",
    heat_path: Some(|| HeatPath {
        applies: |_| true,
        nodes: nodes(-0.12, 0.12, 5),
        design: with_polymer,
        nudge: None,
        factor_on: None,
    }),
    steady: &[Steady::Design(with_polymer)],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |_, _| Some(Offer::one("polymer_fraction_change", Prior::Normal { mean: 0.0, sd: 0.03 }, &[0.0])),
    effect: |chain, record, active| Ok(Effect::Coil(chain.along(record, ID, active.values[0]))),
    extended: |design, active| Some(with_polymer(design, active.values[0])),
};

/// Share of polymer in the coil's cross-section that the reference design has; fibre of 80 µm in a cell of 170 µm pitch.
const POLYMER_FRACTION: f64 = 0.80;
/// Bounds of a change of it that leave glass and polymer their places.
const LEAST_POLYMER: f64 = 0.5;
const MOST_POLYMER: f64 = 0.95;

/// Fused silica: E \[Pa\], α \[1/K\], k \[W/(m K)\], ρc \[J/(m³ K)\].
const GLASS: [f64; 4] = [70.2e9, 0.55e-6, 1.38, 2200.0 * 740.0];

/// More polymer by `change` of the cross-section: rules of mixtures along the fibre (Voigt) and across it (Reuss), with the polymer's
/// constants such that the nominal body has [`POLYMER_FRACTION`].
fn with_polymer(design: &Design, change: f64) -> Design {
    let mut changed = design.clone();
    let body = &mut changed.body;
    let [e_g, alpha_g, k_g, c_g] = GLASS;
    let v = POLYMER_FRACTION;
    let new = (v + change).clamp(LEAST_POLYMER, MOST_POLYMER);
    let e = &mut body.elastic;
    let e_p = (e.e_z - (1.0 - v) * e_g) / v;
    let alpha_p = (e.alpha_z * e.e_z - (1.0 - v) * e_g * alpha_g) / (v * e_p);
    let k_p = v / (1.0 / body.conductivity_r - (1.0 - v) / k_g);
    let stored = body.density * body.specific_heat;
    let c_p = (stored - (1.0 - v) * c_g) / v;
    e.e_z = (1.0 - new) * e_g + new * e_p;
    e.alpha_z = ((1.0 - new) * e_g * alpha_g + new * e_p * alpha_p) / e.e_z;
    e.e_r *= v / new;
    e.g_zr *= v / new;
    e.alpha_r *= new / v;
    body.conductivity_r = 1.0 / ((1.0 - new) / k_g + new / k_p);
    body.specific_heat = ((1.0 - new) * c_g + new * c_p) / body.density;
    changed
}
