//! Transverse stiffness and expansion that change around a temperature.

use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady, across, grid};
use coil::{Design, FactorsAt, MechanicalState, Mechanics};
use diagnosis::{Parameter, Prior};

pub(super) const GLASS_TRANSITION: Named = Named {
    id: "glass-transition",
    title: "A glass transition",
    stage: Stage::Material,
    equation: "Around T_g, over a width w, the transverse stiffness and expansion change by factors:\n\
        \n\
        ```\n\
        E_r, G → (1 + (f_E − 1) s) E_r, G,   α_r → (1 + (f_α − 1) s) α_r,   s = 1 / (1 + exp(−(T − T_g)/w))\n\
        ```\n\
        \n\
        with the incremental law dσ = D(T)(dε − α(T) dT) and T the mean temperature of the coil.",
    place: "The material of the coil: `mechanics: TemperatureTable(...)`.",
    signature: "The sensitivity differs on the two sides of T_g. Any profile with ramps on both sides shows the difference; a profile that stays on one side\n\
        shows a gain.",
    source: "J. D. Ferry, *Viscoelastic Properties of Polymers*, 3rd ed., Wiley (1980), ch. 11.",
    meaning: "transverse stiffness and expansion change around tg_c, by the factors, over some width_k to either side",
    inspection: "measure the adhesive's storage modulus against temperature (DMA)",
    columns: &[],
    heat_path: None,
    steady: &[
        Steady::Changes {
            parameter: 2,
            changed: |d, transverse_modulus| (d.clone(), MechanicalState { transverse_modulus, ..MechanicalState::NOMINAL }),
            when: "above the transition",
        },
        Steady::Changes {
            parameter: 3,
            changed: |d, transverse_expansion| (d.clone(), MechanicalState { transverse_expansion, ..MechanicalState::NOMINAL }),
            when: "above the transition",
        },
    ],
    extent: |active, _| {
        // nearly nine tenths of a logistic step lie within two widths
        let (tg, width) = (active.values[0], active.values[1]);
        Extent { temperature: Some([tg - 2.0 * width, tg + 2.0 * width]), ..Extent::default() }
    },
    caveat: |_| Some("the transition is tabulated, linear between the rows"),
    offer: |design, scene| {
        let range = scene.temperatures;
        (design.mechanics == Mechanics::Elastic).then(|| Offer {
            parameters: vec![
                // a transition that was not passed cannot be told from other constants
                Parameter::new("tg_c", Prior::Uniform { low: range[0], high: range[1] }),
                Parameter::new("width_k", Prior::LogNormal { median: 5.0, spread: 0.6 }),
                Parameter::new("e_r_factor", Prior::LogNormal { median: 0.8, spread: 0.4 }),
                Parameter::new("alpha_r_factor", Prior::LogNormal { median: 1.05, spread: 0.1 }),
            ],
            choice: None,
            starts: grid(&[&across(range, 12), &[5.0], &[0.8], &[1.05]]),
        })
    },
    effect: |chain, record, active| {
        let (v, coil) = (&active.values, record.coil());
        let parts = chain.softened(record, |n| {
            let middle = (coil[n] + coil[n.saturating_sub(1)]) / 2.0;
            let s = logistic((middle - v[0]) / v[1]);
            (1.0 + (v[2] - 1.0) * s, 1.0 + (v[3] - 1.0) * s)
        });
        Ok(Effect::Coil(Change::of_parts(parts)))
    },
    extended: |design, active| {
        let v = &active.values;
        (design.mechanics == Mechanics::Elastic).then(|| with_transition(design, v[0], v[1], v[2], v[3]))
    },
};

/// Half the span in which a logistic step is tabulated, in widths: 5e-5 of the step lies beyond.
const SPAN: f64 = 10.0;
/// Rows of that table.
const ROWS: i32 = 80;
/// A wide transition is tabulated between these \[°C\]; no coil goes there.
const COLDEST_C: f64 = -250.0;
const HOTTEST_C: f64 = 500.0;

/// Factors on transverse stiffness and expansion that set in around a temperature, as a logistic step of the given width.
fn with_transition(design: &Design, tg: f64, width: f64, modulus: f64, expansion: f64) -> Design {
    let row = |k: i32| {
        let x = SPAN * f64::from(2 * k - ROWS) / f64::from(ROWS);
        let share = logistic(x);
        FactorsAt {
            temperature: tg + width * x,
            transverse_modulus: 1.0 + (modulus - 1.0) * share,
            transverse_expansion: 1.0 + (expansion - 1.0) * share,
        }
    };
    let rows = (0..=ROWS).map(row).filter(|row| (COLDEST_C..HOTTEST_C).contains(&row.temperature));
    Design { mechanics: Mechanics::TemperatureTable(rows.collect()), ..design.clone() }
}

fn logistic(x: f64) -> f64 {
    1.0 / (1.0 + (-x).exp())
}
