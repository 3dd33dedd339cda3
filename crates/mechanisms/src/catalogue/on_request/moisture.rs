//! Water that the coil takes up and gives off as the recorded humidity says, and that swells it.

use super::fick::Sheet;
use crate::law_tools::Chain;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use crate::record_to_bias::Prepared;
use coil::{Design, Mechanics};
use diagnosis::{Parameter, Prior};

pub(super) const MOISTURE: Named = Named {
    id: "moisture",
    title: "A coil that swells with the recorded humidity",
    stage: Stage::Material,
    equation: "Water diffuses into the coil from its outer face; hub and flanges let none pass. Its concentration c, relative to saturation, follows Fick's law,\n\
        \n\
        ```\n\
        ∂c/∂t = D(T) ∂²c/∂x²,   c = φ/100 % at the outer face,   ∂c/∂x = 0 at the hub,   D(T) = D exp(E/R (1/293.15 K − 1/T))\n\
        ```\n\
        \n\
        with φ the record's column `humidity_percent`, E = 40 kJ/mol and T the coil's mean temperature. The coil swells across its fibre by β c̄, c̄ the mean of c: as α_r ΔT would\n\
        widen it, but alone. It strains the coil where the spool holds it. At the first row c is that of the humidity throughout.",
    place: "The material of the coil: a strain across its fibre beside that of α_r; by eqs. (1) and (2) its rate of change gives a bias.",
    signature: "The rate answers a step of the humidity at once, in the direction of the step, and then falls with the root of time, for hours or for weeks,\n\
        whatever the chamber does. Many other effects follow a humidity that follows the chamber's temperature; a step of the humidity at a steady\n\
        temperature tells them apart.",
    source: "J. Crank, *The Mathematics of Diffusion*, 2nd ed., Oxford (1975), ch. 4; that the diffusivity of water in polymers goes by Arrhenius' law is textbook physics.",
    meaning: "the coil takes up and gives off water with diffusivity_um2_per_s at 20 degC, and swells by swelling at saturation",
    inspection: "step the humidity at a steady temperature, or weigh the coil",
    columns: &[HUMIDITY],
    heat_path: None,
    steady: &[Steady::Nothing("it follows the humidity, not the temperature's rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        offered(design).then(|| Offer {
            parameters: vec![
                Parameter::new("swelling", Prior::LogNormal { median: SWELLING, spread: 1.0 }),
                Parameter::new("diffusivity_um2_per_s", DIFFUSIVITY),
            ],
            choice: None,
            starts: vec![vec![SWELLING, 0.5], vec![SWELLING, 8.0]],
        })
    },
    effect: |chain, record, active| {
        let Some(humidity) = record.column(HUMIDITY) else { return Ok(Effect::Coil(Change::none(record))) };
        let (swelling, diffusivity) = (active.values[0], active.values[1]);
        let surface: Vec<f64> = humidity.iter().map(|percent| swelling * percent / 100.0).collect();
        Ok(Effect::Coil(swollen(chain, record, diffusivity, &surface, surface[0])))
    },
    extended: |_, _| None,
};

/// The record's column: relative humidity at the coil \[%\].
const HUMIDITY: &str = "humidity_percent";
/// Strain at saturation: polymers of a coil hold some tenths of a percent of water, and each adds a third of it to a length.
const SWELLING: f64 = 1e-3;
/// Of water in adhesives and coatings at 20 °C \[µm²/s\]: from stiff epoxies to silicones.
pub(super) const DIFFUSIVITY: Prior = Prior::LogNormal { median: 2.0, spread: 1.5 };
/// \[m²/s\]
const UM2_PER_S: f64 = 1e-12;

/// Whether a design has a place for a strain of its own: one whose mechanics does not change already.
pub(super) fn offered(design: &Design) -> bool {
    design.mechanics == Mechanics::Elastic
}

/// Response of a coil whose outer face swells by `surface`, a strain for each row, from an even strain at the first.
pub(super) fn swollen(chain: &Chain, record: &Prepared, diffusivity: f64, surface: &[f64], first: f64) -> Change {
    let design = chain.library().design();
    let sheet = Sheet {
        thickness: design.body.outer_radius - design.winding.inner_radius,
        diffusivity: diffusivity.max(1e-9) * UM2_PER_S,
    };
    let strain = sheet.content(&record.time, record.coil(), surface, first);
    Change::of_parts(chain.swollen(record, &strain))
}
