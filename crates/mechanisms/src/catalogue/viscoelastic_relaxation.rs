//! Transverse stiffness that relaxes with a time constant.

use crate::Prepared;
use crate::course::{Parts, add};
use crate::interpolation::weights;
use crate::mechanism::{Change, Effect, Extent, Named, Offer, Stage, Steady, grid};
use coil::{Design, MechanicalState, Mechanics, Relaxation};
use diagnosis::{Parameter, Prior};

pub(super) const VISCOELASTIC_RELAXATION: Named = Named {
    id: "viscoelastic-relaxation",
    title: "Relaxation of the adhesive",
    stage: Stage::Material,
    equation: "E_r and G relax with one time constant: E(t)/E_0 = 1 − g + g e^{−t/τ}. The nominal value is the unrelaxed one.",
    place: "The material of the coil: `mechanics: Relaxing(...)`.",
    signature: "In ramps much slower than τ the coil is merely softer. After the chamber has come to rest the rate goes on changing for τ. Heat that still flows\n\
        does the same on its own time scale.",
    source: "J. D. Ferry, *Viscoelastic Properties of Polymers*, 3rd ed., Wiley (1980), ch. 1 to 3.",
    meaning: "the transverse stiffness relaxes by relaxing_fraction with the time constant tau_s",
    inspection: "measure the adhesive's stress relaxation (DMA)",
    columns: &[],
    heat_path: None,
    steady: &[Steady::Changes {
        parameter: 0,
        changed: |d, x| (d.clone(), MechanicalState { transverse_modulus: 1.0 - x, ..MechanicalState::NOMINAL }),
        when: "in ramps much slower than the relaxation",
    }],
    extent: Extent::everywhere,
    caveat: |_| None,
    offer: |design, _| {
        (design.mechanics == Mechanics::Elastic).then(|| Offer {
            parameters: vec![
                Parameter::new("relaxing_fraction", Prior::Uniform { low: 0.0, high: 0.8 }),
                Parameter::new("tau_s", Prior::LogNormal { median: 4000.0, spread: 1.0 }),
            ],
            choice: None,
            starts: grid(&[&[0.2], &[700.0, 2500.0, 9000.0, 25000.0]]),
        })
    },
    effect: |_, record, active| Ok(Effect::Coil(Change::of_parts(relaxed(record, active.values[0], active.values[1], None)))),
    extended: |design, active| {
        let (fraction, time) = (active.values[0], active.values[1]);
        let relaxing = || Design { mechanics: Mechanics::Relaxing { fraction, time }, ..design.clone() };
        (design.mechanics == Mechanics::Elastic).then(relaxing)
    },
};

/// Time in which a sudden strain comes about, short beside any relaxation [s].
const SUDDEN_S: f64 = 1e-3;

/// Parts of a coil whose transverse moduli relax, less the nominal ones; `sudden` are the phases, at each node of the moduli, of a strain that came about
/// suddenly before the first row.
pub(super) fn relaxed(record: &Prepared, fraction: f64, time: f64, sudden: Option<&[[f64; 3]]>) -> Parts {
    let nodes: Vec<f64> = record.modulus.iter().map(|(x, ..)| *x).collect();
    let at: Vec<Vec<f64>> = Relaxation::nodes().iter().map(|x| weights(&nodes, (1.0 - fraction * x).ln())).collect();
    let nominal = weights(&nodes, 0.0);
    let mut relaxation = Relaxation::new(time);
    let mut change: Parts = [0, 1, 2].map(|_| vec![0.0; record.time.len()]);
    let mut states = vec![[0.0; 3]; at.len()];
    if let Some(phases) = sudden {
        for (state, w) in states.iter_mut().zip(&at) {
            *state = [0, 1, 2].map(|p: usize| w.iter().zip(phases).map(|(w, phase)| w * phase[p]).sum::<f64>() / SUDDEN_S);
        }
        relaxation.rates(&states, SUDDEN_S);
    }
    // of each relaxing state, and as designed, in every row
    let of = |w: &Vec<f64>| {
        let mut sum: Parts = [0, 1, 2].map(|_| vec![0.0; record.time.len()]);
        for (w, (_, as_designed, _)) in w.iter().zip(&record.modulus) {
            sum.iter_mut().zip(as_designed).for_each(|(sum, part)| add(sum, part, *w));
        }
        sum
    };
    let (driving, nominal): (Vec<Parts>, Parts) = (at.iter().map(of).collect(), of(&nominal));
    for n in 1..record.time.len() {
        states.iter_mut().zip(&driving).for_each(|(state, driving)| *state = [0, 1, 2].map(|p: usize| driving[p][n]));
        let relaxed = relaxation.rates(&states, record.time[n] - record.time[n - 1]);
        for p in 0..3 {
            change[p][n] = relaxed[p] - nominal[p][n];
        }
    }
    change
}
