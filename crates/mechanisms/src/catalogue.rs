//! The library's entries: names, stages, parameters with their priors, and where fits start.

use crate::library::{Library, Path};
use diagnosis::{Mechanism, Parameter, Prior};

/// Which law a mechanism follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Law {
    Tail,
    Defect,
    Polymer,
    GlassTransition,
    Relaxation,
    Debond,
    HubResistance,
    Air,
    Mount,
    SelfHeating,
    SensorLag,
    Curvature,
    ReadOut,
    // beyond the named ones
    Ripple,
    Moisture,
    Ratchet,
    SpoolExpansion,
    Racket,
    Magnetic,
}

pub(crate) const fn normal(sd: f64) -> Prior {
    Prior::Normal { mean: 0.0, sd }
}

pub(crate) const fn about(median: f64, spread: f64) -> Prior {
    Prior::LogNormal { median, spread }
}

fn one(name: &str, prior: Prior) -> Vec<Parameter> {
    vec![Parameter::new(name, prior)]
}

/// Every combination of a value from each list.
pub(crate) fn grid(lists: &[&[f64]]) -> Vec<Vec<f64>> {
    lists.iter().fold(vec![Vec::new()], |grid, list| {
        grid.iter().flat_map(|v| list.iter().map(|x| [v.as_slice(), &[*x]].concat())).collect()
    })
}

/// The entries that apply to a design, each with its law; `range` is the coldest and hottest that the coil was \[°C\]: a transition that was
/// not passed cannot be told from other constants.
pub(crate) fn entries(library: &Library, range: [f64; 2]) -> Vec<(Law, Mechanism)> {
    let within = Prior::Uniform { low: range[0], high: range[1].max(range[0] + 1e-3) };
    let across = |count: u32| -> Vec<f64> {
        (0..count).map(|k| range[0] + (range[1] - range[0]) * (f64::from(k) + 0.5) / f64::from(count)).collect()
    };
    let has = |path: Path| library.paths[path as usize].is_some();
    let elastic = !library.modulus.is_empty();
    let mut entries = Vec::new();
    let mut add = |law: Law, id: &str, stage: &str, parameters: Vec<Parameter>, starts: Vec<Vec<f64>>| {
        let (id, stage) = (id.to_owned(), stage.to_owned());
        entries.push((law, Mechanism { id, stage, parameters, choice: None, starts, named: true, weight: 1.0 }));
    };
    add(Law::Tail, "tail-asymmetry", "winding", one("tail_m", normal(0.5)), vec![vec![0.0]]);
    add(Law::Defect, "winding-defect", "winding", one("turns", normal(3.0)), vec![vec![0.0]]);
    if has(Path::Polymer) {
        add(Law::Polymer, "adhesive-content", "material", one("polymer_fraction_change", normal(0.03)), vec![vec![0.0]]);
    }
    if elastic {
        let transition = vec![
            Parameter::new("tg_c", within),
            Parameter::new("width_k", about(5.0, 0.6)),
            Parameter::new("e_r_factor", about(0.8, 0.4)),
            Parameter::new("alpha_r_factor", about(1.05, 0.1)),
        ];
        let starts = grid(&[&across(12), &[5.0], &[0.8], &[1.05]]);
        add(Law::GlassTransition, "glass-transition", "material", transition, starts);
        let relaxation = vec![
            Parameter::new("relaxing_fraction", Prior::Uniform { low: 0.0, high: 0.8 }),
            Parameter::new("tau_s", about(4000.0, 1.0)),
        ];
        let starts = grid(&[&[0.2], &[700.0, 2500.0, 9000.0, 25000.0]]);
        add(Law::Relaxation, "viscoelastic-relaxation", "material", relaxation, starts);
    }
    if !library.openings.is_empty() {
        let debond = vec![
            Parameter::new("debond_c", within).with_step(0.02).with_search(&AROUND_K),
            Parameter::new("hysteresis_k", about(6.0, 0.6)).with_step(0.1).with_search(&AROUND_K),
            Parameter::new("fraction", Prior::Uniform { low: 0.01, high: 0.9 }).with_step(0.05),
        ];
        let starts = grid(&[&across(40), &[3.0, 9.0], &[0.05, 0.15, 0.35, 0.6]]);
        add(Law::Debond, "debond", "bond", debond, starts);
    }
    if has(Path::HubResistance) {
        let resistance = one("resistance_m2k_per_w", about(7e-4, 0.9));
        add(Law::HubResistance, "interface-resistance", "thermal", resistance, vec![vec![5e-4]]);
    }
    if has(Path::Air) {
        add(Law::Air, "air-path", "thermal", one("conductivity_factor", about(1.0, 0.2)), vec![vec![1.0]]);
    }
    if has(Path::Mount) {
        add(Law::Mount, "axial-heat-path", "thermal", one("conductance_w_per_m2k", about(1.5, 1.2)), vec![vec![0.5], vec![4.0]]);
    }
    if library.heater.is_some() {
        let heating = vec![
            Parameter::new("power_w", about(0.05, 1.4)),
            Parameter::new("before_s", Prior::LogNormal { median: 30.0, spread: 1.0 }),
        ];
        add(Law::SelfHeating, "self-heating", "thermal", heating, grid(&[&[0.005, 0.05], &[10.0, 60.0, 300.0]]));
    }
    add(Law::SensorLag, "sensor-lag", "sensor", one("lag_s", about(30.0, 0.9)), vec![vec![20.0], vec![60.0]]);
    add(Law::Curvature, "thermo-optic-curvature", "optics", one("curvature_per_k2", normal(6e-8)), vec![vec![0.0]]);
    let coefficient = one("coefficient_deg_per_h_per_k", normal(1.5e-3));
    add(Law::ReadOut, "rate-temperature-coefficient", "electronics", coefficient, vec![vec![0.0]]);
    for (law, mechanism) in &mut entries {
        if *law == Law::Defect {
            let layers = library.design().winding.layers.min(MOST_LAYERS);
            mechanism.choice = Some(("layer".to_owned(), (1..=layers).map(|k| k as f64).collect()));
        }
    }
    entries.extend(crate::beyond::entries());
    entries
}

/// Distances from a fitted switching temperature at which a better one is sought \[K\]: whether a row is before the switch is all or nothing.
const AROUND_K: [f64; 6] = [0.06, 0.15, 0.4, 1.0, 2.2, 4.5];

/// Layers that are compared one by one.
const MOST_LAYERS: usize = 200;
