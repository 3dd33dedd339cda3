//! Heat that is stored against heat that flows in.

use crate::common::changed;
use coil::{Drive, Heater, MeshFineness, Mount, Outputs, Profile, Reduction, Side, ThermalModel};
use fem_core::polynomial;

/// Heat content \[J\] and heat flow out through walls and mounts \[W\] as functionals of the temperature at all nodes.
///
/// Summed over the free nodes the discrete equations read d/dt Σ(C T) = P − Σ(K T), exactly; what the walls' nodes hold and pass on
/// is put on one of them, as all have the chamber's temperature.
fn heat(thermal: &ThermalModel) -> Vec<Vec<f64>> {
    let ones = vec![1.0; thermal.map().reduced()];
    let wall = thermal.map().expand(&ones).iter().position(|v| *v == 0.0).expect("a node on the wall");
    let content = thermal.capacity().multiply(&ones);
    let flow = thermal.conductivity().matrix().multiply(&ones);
    let on_wall = [thermal.stored()[0].iter().sum::<f64>() - content.iter().sum::<f64>(), -flow.iter().sum::<f64>()];
    [content, flow]
        .iter()
        .zip(on_wall)
        .map(|(free, at_wall)| {
            let mut functional = thermal.map().expand(free);
            functional[wall] = at_wall;
            functional
        })
        .collect()
}

const POWER: f64 = 0.7;
/// Corners of the chamber's course: rest, 20 K up, rest until all is steady.
const CORNERS: [(f64, f64); 4] = [(0.0, 0.0), (600.0, 0.0), (1200.0, 20.0), (60_000.0, 20.0)];
const DRIVES: [Drive; 2] = [Drive::Chamber, Drive::Heaters];

fn heated() -> ThermalModel {
    let design = changed(|d| {
        d.heat.mounts.push(Mount { side: Side::Right, conductance: 20.0 });
        d.heat.heaters.push(Heater { side: Side::Right, power: POWER });
    });
    ThermalModel::new(&design, &MeshFineness { order: 2, layers: 0, ratio: 0.2 }, &DRIVES).expect("model")
}

/// Instants after each corner at the Gauss points of panels that double in length, with their weights; the corners have none.
fn instants() -> Vec<(f64, f64, f64)> {
    let rule = polynomial::gauss(8);
    let mut all = vec![(CORNERS[0].0, CORNERS[0].1, 0.0)];
    for w in CORNERS.windows(2) {
        let [(t0, u0), (t1, u1)] = [w[0], w[1]];
        let (mut from, mut to) = (t0, t0 + 1e-4);
        while from < t1 {
            for (x, weight) in rule.points.iter().zip(&rule.weights) {
                let t = from + (to - from) * (1.0 + x) / 2.0;
                all.push((t, u0 + (u1 - u0) * (t - t0) / (t1 - t0), weight * (to - from) / 2.0));
            }
            (from, to) = (to, (to + 2.0 * (to - from)).min(t1));
        }
        all.push((t1, u1, 0.0));
    }
    all
}

#[test]
fn exact_the_full_run_keeps_the_energy() {
    let thermal = heated();
    let instants = instants();
    let time: Vec<f64> = instants.iter().map(|i| i.0).collect();
    let profile = Profile { drives: vec![instants.iter().map(|i| i.1).collect(), vec![1.0; time.len()]], time };
    let run = thermal.run(&profile, &heat(&thermal), 1e-9).expect("run").outputs;
    let out: f64 = run.iter().zip(&instants).map(|(row, i)| i.2 * row[1]).sum();
    let (gained, put_in) = (run[run.len() - 1][0] - run[0][0], POWER * CORNERS[3].0);
    let off = (put_in - out - gained) / put_in;
    assert!(off.abs() < 1e-8, "{off:e}");
    assert!((run[run.len() - 1][1] / POWER - 1.0).abs() < 1e-8, "at the end the power leaves: {} W", run[run.len() - 1][1]);
}

#[test]
fn exact_the_reduced_model_keeps_the_energy() {
    let thermal = heated();
    let [content, flow]: [Vec<f64>; 2] = heat(&thermal).try_into().expect("two functionals");
    // read in the places of thermometer and coil
    let outputs = Outputs { thermometer: content, coil_mean: flow, parts: Vec::new() };
    let reduced = Reduction::new(&thermal, &outputs, 24).expect("reduction").reduced;
    let (content, flow) = (reduced.thermometer(), reduced.coil_mean());
    let instants = instants();
    let time: Vec<f64> = instants.iter().map(|i| i.0).collect();
    let courses = [instants.iter().map(|i| i.1).collect(), vec![1.0; time.len()]];
    let mut steps = reduced.steps(&time, &courses, &[0.0, 0.0]);
    let (start, mut out) = (content.of(steps.state()), 0.0);
    for (t, _, weight) in &instants[1..] {
        steps.next().expect("a step an instant");
        out += weight * flow.of(steps.state());
        let put_in = POWER * t;
        // at every corner, in the middle of a transient or at rest
        if CORNERS[1..].iter().any(|corner| corner.0 == *t) {
            let off = (put_in - out - (content.of(steps.state()) - start)) / put_in;
            assert!(off.abs() < 1e-8, "until {t} s: {off:e}");
        }
    }
}
