//! The racket effect, read as a stiffness that follows temperature.

use crate::REFERENCE_C;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady};
use coil::{Design, FactorsAt, Mechanics};
use diagnosis::Prior;

pub(super) const RACKET: Named = Named {
    id: "racket",
    title: "The racket effect, read as a stiffness that follows temperature",
    stage: Stage::Material,
    equation: "The transverse moduli of the coil fall with its mean temperature T, and rise again in the cold as a racket's strings are tightened:\n\
        \n\
        ```\n\
        E_r, G → exp(−b (T − 20 °C)) E_r, G\n\
        ```\n\
        \n\
        with the incremental law of `glass-transition`. At 20 °C the sensitivity is that of the design.",
    place: "The material of the coil: `mechanics: TemperatureTable(...)`.",
    signature: "The same ramp gives another bias at one end of the range than at the other, alike on the way up and on the way down and in every run. A glass\n\
        transition changes the bias about one temperature, this mechanism everywhere. The other reading of the name, `ratcheting`, shows once only.",
    source: "The paper names a racket effect without a source; that the moduli of polymers fall with temperature is in J. D. Ferry, *Viscoelastic Properties of Polymers*, 3rd ed., Wiley (1980), ch. 11.",
    meaning: "the transverse stiffness falls by softening_per_k with the coil's temperature",
    inspection: "measure the adhesive's storage modulus against temperature (DMA)",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("at 20 degC nothing changes: the sensitivity is another at any other temperature")],
    extent: Extent::everywhere,
    caveat: |_| Some("the stiffness is tabulated, linear between the rows"),
    offer: |design, _| {
        // a polymer between its transitions loses up to a percent a kelvin; a colder one stiffens
        let prior = Prior::Normal { mean: 0.0, sd: 0.01 };
        (design.mechanics == Mechanics::Elastic).then(|| Offer::one("softening_per_k", prior, &[0.0]))
    },
    effect: |chain, record, active| {
        let coil = record.coil();
        let parts = chain.softened(record, |n| {
            let middle = (coil[n] + coil[n.saturating_sub(1)]) / 2.0;
            (factor(active.values[0], middle), 1.0)
        });
        Ok(Effect::Coil(Change::of_parts(parts)))
    },
    extended: |design, active| (design.mechanics == Mechanics::Elastic).then(|| with_softening(design, active.values[0])),
};

/// Temperatures between which the stiffness is tabulated \[°C\], and the rows of the table.
const TABULATED_C: [f64; 2] = [-80.0, 120.0];
const ROWS: u32 = 100;

/// Factor on the transverse moduli at a temperature \[°C\].
fn factor(softening: f64, temperature: f64) -> f64 {
    (-softening * (temperature - REFERENCE_C)).exp()
}

fn with_softening(design: &Design, softening: f64) -> Design {
    let [low, high] = TABULATED_C;
    let row = |k: u32| {
        let temperature = low + (high - low) * f64::from(k) / f64::from(ROWS);
        FactorsAt { temperature, transverse_modulus: factor(softening, temperature), transverse_expansion: 1.0 }
    };
    Design { mechanics: Mechanics::TemperatureTable((0..=ROWS).map(row).collect()), ..design.clone() }
}
