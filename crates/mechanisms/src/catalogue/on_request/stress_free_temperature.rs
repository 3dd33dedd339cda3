//! Stress that was stored since the adhesive was cured, or last warmed, and that goes on relaxing.

use crate::catalogue::viscoelastic_relaxation::relaxed;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady, grid};
use coil::{Design, MechanicalState, Mechanics};
use diagnosis::{Parameter, Prior};

pub(super) const STRESS_FREE_TEMPERATURE: Named = Named {
    id: "stress-free-temperature",
    title: "A coil that is not yet free of the stress of its cure",
    stage: Stage::Material,
    equation: "The transverse moduli relax as in `viscoelastic-relaxation`, E(t)/E_0 = 1 − g + g e^{−t/τ}, but the coil does not begin at rest: at the first\n\
        row the relaxing stress is that of a coil which is free of stress at T_f,\n\
        \n\
        ```\n\
        σ_relaxing(0) = g D (α(T_f) − α(T(0))),   dσ_relaxing/dt = −σ_relaxing/τ + g D (dε/dt − α dT/dt)\n\
        ```\n\
        \n\
        T_f is the temperature of the cure right after it, and the coil's own after a long rest.",
    place: "The material of the coil: `mechanics: Relaxing(...)`, with a stress at the start that a coil file does not hold.",
    signature: "The rate decays over τ from the first row on, even if the chamber rests, in proportion to the distance of T_f from the temperature of storage.\n\
        Then it is the rate of a coil whose moduli relax. A run after a long rest has the second part alone.",
    source: "J. D. Ferry, *Viscoelastic Properties of Polymers*, 3rd ed., Wiley (1980), ch. 1 to 3; S. P. Timoshenko and J. N. Goodier, *Theory of Elasticity*, 3rd ed., McGraw-Hill (1970), ch. 13, for thermal stress.",
    meaning: "a stored_fraction of the transverse stiffness relaxes with stored_tau_s; at the first row its stress is that of a coil which is free of it at stress_free_c",
    inspection: "repeat the test after a week at rest, or anneal the coil",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Changes {
        parameter: 0,
        changed: |d, x| (d.clone(), MechanicalState { transverse_modulus: 1.0 - x, ..MechanicalState::NOMINAL }),
        when: "in ramps much slower than the relaxation",
    }],
    extent: Extent::everywhere,
    caveat: |_| Some("the stress at the start is not in this file, only what relaxes"),
    offer: |design, _| {
        (design.mechanics == Mechanics::Elastic).then(|| Offer {
            parameters: vec![
                Parameter::new("stored_fraction", Prior::Uniform { low: 0.0, high: 0.8 }),
                Parameter::new("stored_tau_s", Prior::LogNormal { median: 4000.0, spread: 1.0 }),
                // adhesives cure between room temperature and 120 degC, and part of the stress has relaxed since
                Parameter::new("stress_free_c", Prior::Normal { mean: 40.0, sd: 30.0 }),
            ],
            choice: None,
            starts: grid(&[&[0.2], &[2500.0, 9000.0, 25_000.0], &[40.0]]),
        })
    },
    effect: |chain, record, active| {
        let v = &active.values;
        let kelvin = record.coil()[0] - v[2];
        let sudden: Vec<[f64; 3]> = chain.even().iter().map(|(_, phase, _)| phase.map(|phase| kelvin * phase)).collect();
        Ok(Effect::Coil(Change::of_parts(relaxed(record, v[0], v[1], Some(&sudden)))))
    },
    extended: |design, active| {
        let (fraction, time) = (active.values[0], active.values[1]);
        let relaxing = || Design { mechanics: Mechanics::Relaxing { fraction, time }, ..design.clone() };
        (design.mechanics == Mechanics::Elastic).then(relaxing)
    },
};
