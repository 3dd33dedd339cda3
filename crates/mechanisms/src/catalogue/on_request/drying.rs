//! A coil that is wetter, or dryer, than its surroundings at the first row, and that shrinks as it dries.

use super::moisture::{DIFFUSIVITY, offered, swollen};
use crate::mechanism::{Effect, Extent, Named, Offer, Stage, Steady};
use diagnosis::{Parameter, Prior};

pub(super) const DRYING: Named = Named {
    id: "drying",
    title: "A coil that dries",
    stage: Stage::Material,
    equation: "At the first row the coil is swollen by ε throughout, across its fibre, beyond the equilibrium with the air around it. The air stays as it is,\n\
        and the water leaves by Fick's law as in `moisture`:\n\
        \n\
        ```\n\
        strain = ε Σ 8/((2n+1)²π²) exp(−(2n+1)²π²θ/4),   θ = ∫ D(T) dt / l²\n\
        ```\n\
        \n\
        with l the coil's thickness from hub to outer face. A coil that takes water up has a negative ε.",
    place: "The material of the coil: a strain across its fibre beside that of α_r; by eqs. (1) and (2) its rate of change gives a bias.",
    signature: "The rate falls with the root of time from the first row on, in the soaks too, and faster at higher temperature. A second run shows less of the\n\
        effect, because a coil that dries does not repeat. Relaxing stress falls faster at the end; a heater shows in the spool's thermometer as well.",
    source: "J. Crank, *The Mathematics of Diffusion*, 2nd ed., Oxford (1975), eq. (4.18).",
    meaning: "the coil is swollen by wet_strain at the first row, and dries with diffusivity_um2_per_s at 20 degC",
    inspection: "weigh the coil before and after the test, or bake it dry and repeat",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Nothing("it goes by itself, whatever the temperature's rate")],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        offered(design).then(|| Offer {
            parameters: vec![
                // half of what is held at saturation
                Parameter::new("wet_strain", Prior::Normal { mean: 0.0, sd: 5e-4 }),
                Parameter::new("diffusivity_um2_per_s", DIFFUSIVITY),
            ],
            choice: None,
            starts: vec![vec![0.0, 0.5], vec![0.0, 8.0]],
        })
    },
    effect: |chain, record, active| {
        let dry = vec![0.0; record.time.len()];
        Ok(Effect::Coil(swollen(chain, record, active.values[1], &dry, active.values[0])))
    },
    extended: |_, _| None,
};
