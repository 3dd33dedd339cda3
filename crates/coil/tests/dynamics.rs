//! A coil in time: the reduced model against all unknowns, ramps against the steady sensitivity, heat paths against each other.

use crate::common::{QUICK, changed, dynamics, half_minutes, reference, run, scaled, spool};
use bias::{Bias, Sensitivity};
use coil::{
    COARSER, Contact, Drive, Dynamics, FactorsAt, Fidelity, Heater, Mechanics, MeshFineness, Model, Mount, Opening, Profile,
    STANDARD, Side, ThermalModel, functionals,
};

/// Chamber: rest, a step of 20 K within 10 s, rest, a ramp of 1 K/min, rest.
fn step_and_ramp(interval: f64) -> Profile {
    let chamber = |t: f64| (t - 600.0).clamp(0.0, 10.0) * 2.0 + (t - 4800.0).clamp(0.0, 1200.0) / 60.0;
    let time: Vec<f64> = (0..).map(|k| f64::from(k) * interval).take_while(|t| *t <= 9000.0).collect();
    Profile { drives: vec![time.iter().map(|t| chamber(*t)).collect()], time }
}

#[test]
fn exact_reduced_model_agrees_with_all_unknowns_on_steps_and_ramps() {
    let design = reference();
    let thermal = ThermalModel::new(&design, &QUICK.resolution, &[Drive::Chamber]).expect("model");
    let dynamics = dynamics(&design, &[Drive::Chamber]);
    let model = Model::new(&design, &QUICK.resolution).expect("model");
    let outputs = functionals(&design, &model, &thermal).expect("outputs");
    let profile = step_and_ramp(10.0);
    let [shupe, eo_axial, eo_radial] = outputs.parts[0].clone();
    let full = thermal.run(&profile, &[shupe, eo_axial, eo_radial, outputs.thermometer], 1e-5).expect("run");
    let reduced = dynamics.simulate(&profile).expect("run");
    let of = |r: &coil::Response| [r.bias.shupe, r.bias.eo_axial, r.bias.eo_radial];
    for part in 0..3 {
        let full = |n: usize| (full.outputs[n][part] - full.outputs[n - 1][part]) / 10.0;
        let peak = (1..profile.time.len()).map(|n| full(n).abs()).fold(0.0, f64::max);
        for (n, response) in reduced.iter().enumerate().skip(1) {
            let error = (full(n) - of(response)[part]).abs() / peak;
            assert!(error < 1e-3, "part {part} at {} s: {error:.1e} of the peak", profile.time[n]);
        }
    }
    let bound = dynamics.reduction_error();
    assert!(bound.bias < 0.06 && bound.sensor < 1e-4, "an estimate that says nothing: {bound:?}");
    let sensor = (0..reduced.len()).map(|n| (full.outputs[n][3] - reduced[n].sensor).abs()).fold(0.0, f64::max);
    // 2 K/s at most; beside the reduction stands the stepping's own 1e-5 K a step
    assert!(sensor < 2.0 * bound.sensor + 2e-3, "{sensor}");
}

/// The distance to the coarser mesh covers the error of the standard one, for a free and for a fixed hub.
#[test]
fn bounds_the_distance_to_a_coarser_mesh_covers_the_error() {
    let free = changed(|d| d.spool.as_mut().expect("a spool").hub_contact = Contact::Gap);
    let fine = Fidelity { resolution: MeshFineness { order: 8, layers: 3, ..STANDARD.resolution }, ..STANDARD };
    for design in [reference(), free] {
        let run = |fidelity: &Fidelity| {
            Dynamics::new(&design, &[Drive::Chamber], fidelity).expect("model").simulate(&step_and_ramp(30.0)).expect("run")
        };
        let [coarse, standard, fine] = [COARSER, STANDARD, fine].map(|fidelity| run(&fidelity));
        for (what, of) in [
            ("thermometer", (|r| r.sensor) as fn(&coil::Response) -> f64),
            ("axial strain", |r| r.bias.eo_axial),
            ("radial strain", |r| r.bias.eo_radial),
            ("rate", coil::Response::rate),
        ] {
            let distance =
                |other: &[coil::Response]| standard.iter().zip(other).map(|(a, b)| (of(a) - of(b)).abs()).fold(0.0, f64::max);
            let (error, estimate) = (distance(&fine), distance(&coarse));
            assert!(error <= estimate && estimate <= 100.0 * error, "{what}: {error:.1e}, estimated {estimate:.1e}");
        }
    }
}

#[test]
fn bounds_the_stated_reduction_error_covers_the_true_one_and_not_by_much() {
    let design = reference();
    let profile = step_and_ramp(10.0);
    let truth = run(&design, &[Drive::Chamber], &profile);
    let fastest = profile.time.windows(2).zip(profile.drives[0].windows(2)).map(|(t, u)| ((u[1] - u[0]) / (t[1] - t[0])).abs());
    let fastest = fastest.fold(0.0, f64::max);
    let peak = truth.iter().map(|r| r.bias.total().abs()).fold(0.0, f64::max);
    for modes in [6, 8, 10] {
        let few = Dynamics::new(&design, &[Drive::Chamber], &coil::Fidelity { modes, ..QUICK }).expect("model");
        let rows = few.simulate(&profile).expect("run");
        let most = |f: &dyn Fn(usize) -> f64| (0..rows.len()).map(f).fold(0.0, f64::max);
        let sensor = most(&|n| (rows[n].sensor - truth[n].sensor).abs()) / fastest;
        let bias = most(&|n| (rows[n].bias.total() - truth[n].bias.total()).abs()) / peak;
        let stated = few.reduction_error();
        assert!(sensor <= stated.sensor && stated.sensor < 1e4 * sensor, "{modes} modes, sensor: {sensor:.1e}, {stated:?}");
        assert!(bias <= stated.bias && stated.bias < 1e4 * bias, "{modes} modes, bias: {bias:.1e}, {stated:?}");
    }
}

#[test]
fn exact_a_long_ramp_has_the_steady_sensitivity_and_its_lag() {
    let design = reference();
    let rate = 1.0 / 60.0;
    let time = half_minutes(2000);
    let chamber: Vec<f64> = time.iter().map(|t| rate * t).collect();
    let rows = run(&design, &[Drive::Chamber], &Profile { drives: vec![chamber.clone()], time });
    let last = rows.len() - 1;
    let steady = coil::Model::new(&design, &QUICK.resolution).expect("model").sensitivity().expect("solve");
    let ramp = Sensitivity::from_ramp(&rows[last].bias, rate).expect("ramp");
    assert!((ramp.total() / steady.total() - 1.0).abs() < 1e-6, "{} against {}", ramp.total(), steady.total());
    assert!(ramp.shupe.abs() < 1e-6);
    let lag = coil::ramp_lag(&design, &QUICK.resolution).expect("solve").sensor;
    assert!(((chamber[last] - rows[last].sensor) / rate / lag - 1.0).abs() < 1e-6);
}

#[test]
fn symmetry_exchanging_the_ends_of_everything_mirrors_the_drives() {
    let ends = [Drive::Chamber, Drive::EndWall(Side::Left), Drive::EndWall(Side::Right)];
    let time = half_minutes(200);
    let warm: Vec<f64> = time.iter().map(|t| t / 300.0).collect();
    let still = vec![0.0; time.len()];
    let bias = |design: &coil::Design, drives: [&Vec<f64>; 3]| {
        let profile = Profile { time: time.clone(), drives: drives.map(|d| d.clone()).to_vec() };
        run(design, &ends, &profile)[150].bias.total()
    };
    let mirrored = changed(|d| {
        d.winding.cw_climbs = winding::ClimbSide::Left;
        spool(d).flanges[0].side = Side::Left;
        d.sensor.y = 8.01e-3;
    });
    let (a, b) = (bias(&reference(), [&still, &warm, &still]), bias(&mirrored, [&still, &still, &warm]));
    assert!((a / b - 1.0).abs() < 1e-6, "{a:e} against {b:e}");
    // all walls together are one chamber
    let all = bias(&reference(), [&warm, &warm, &warm]);
    let profile = Profile { time: time.clone(), drives: vec![warm.clone()] };
    let one = run(&reference(), &[Drive::Chamber], &profile);
    assert!((all / one[150].bias.total() - 1.0).abs() < 1e-4, "{all:e} against {:e}", one[150].bias.total());
}

#[test]
fn bounds_heat_paths_act_in_the_right_direction() {
    let lag = |design: &coil::Design| coil::ramp_lag(design, &QUICK.resolution).expect("solve");
    let plain = lag(&reference());
    let mounted = lag(&changed(|d| d.heat.mounts.push(Mount { side: Side::Right, conductance: 50.0 })));
    assert!(mounted.sensor < 0.9 * plain.sensor, "{} against {}", mounted.sensor, plain.sensor);
    let blown = lag(&changed(|d| d.heat.film = Some(20.0)));
    assert!(blown.sensor < 0.5 * plain.sensor, "{} against {}", blown.sensor, plain.sensor);
    // a contact resistance holds the coil back behind the hub
    let behind = |l: &coil::RampLag| l.turns.iter().sum::<f64>() / l.turns.len() as f64 - l.sensor;
    let poor = lag(&changed(|d| d.heat.hub_resistance = 1e-2));
    assert!(behind(&poor) > behind(&plain) + 1.0, "{} against {}", behind(&poor), behind(&plain));
    let gap = lag(&changed(|d| {
        spool(d).hub_contact = Contact::Gap;
        d.heat.hub_resistance = 1e-2; // no contact, no resistance
    }));
    assert!(gap.turns.iter().all(|t| t.is_finite()));
}

#[test]
fn bounds_a_film_does_not_blow_into_gaps() {
    // slow exchange: the lag is heat capacity over film and area, and the faces of a gap belong to no area
    let lag = |hub: Contact, flange: Contact| {
        let design = changed(|d| {
            d.heat.film = Some(0.1);
            let spool = spool(d);
            spool.hub_contact = hub;
            spool.flanges[0].contact = flange;
        });
        coil::ramp_lag(&design, &QUICK.resolution).expect("solve").sensor
    };
    let bonded = lag(Contact::Bonded, Contact::Bonded);
    for (hub, flange) in [(Contact::Gap, Contact::Bonded), (Contact::Bonded, Contact::Gap), (Contact::Gap, Contact::Gap)] {
        let loose = lag(hub, flange);
        assert!((loose / bonded - 1.0).abs() < 0.02, "{hub:?} {flange:?}: {loose} against {bonded}");
    }
}

#[test]
fn exact_a_heater_settles_where_its_power_leaves_through_the_mount() {
    // nearly all heat leaves through the mount: its face sits at power / (conductance × area) above it, be it a flange's or the bare hub's
    for (flanged, outer, conductance) in [(true, 49.825e-3f64, 2000.0), (false, 43.5e-3, 20.0)] {
        let design = changed(|d| {
            d.heat.mounts.push(Mount { side: Side::Right, conductance });
            d.heat.heaters.push(Heater { side: Side::Right, power: 1.0 });
            d.surroundings.conductivity = 1e-6;
            if !flanged {
                spool(d).flanges.clear();
            }
        });
        let time: Vec<f64> = (0..5000).map(|k| 60.0 * f64::from(k)).collect();
        let profile = Profile { drives: vec![vec![20.0; time.len()], vec![1.0; time.len()]], time };
        let rows = run(&design, &[Drive::Chamber, Drive::Heaters], &profile);
        assert!(
            (rows[0].sensor - 20.0).abs() < 1e-9 && rows[0].bias == Bias::ZERO,
            "rest before the heater is on: {:?}",
            rows[0]
        );
        let area = std::f64::consts::PI * (outer.powi(2) - 39.5e-3f64.powi(2));
        let (rise, expected) = (rows[rows.len() - 1].sensor - 20.0, 1.0 / (conductance * area));
        assert!((rise / expected - 1.0).abs() < 0.02, "{rise} K against {expected} K");
    }
}

#[test]
fn bounds_profiles_that_cannot_be_run_name_the_instant() {
    let dynamics = dynamics(&reference(), &[Drive::Chamber]);
    let rows = |time: &[f64], chamber: &[f64]| {
        let profile = Profile { time: time.to_vec(), drives: vec![chamber.to_vec()] };
        dynamics.simulate(&profile).map(|rows| rows.len()).map_err(|e| e.to_string())
    };
    assert_eq!(rows(&[0.0], &[20.0]), Ok(1));
    assert!(rows(&[], &[]).expect_err("empty").contains("at least one"));
    assert!(rows(&[0.0, 30.0, 30.0], &[1.0, 2.0, 3.0]).expect_err("twice").contains("instant 2"));
    assert!(rows(&[0.0, 30.0], &[1.0, f64::NAN]).expect_err("NaN").contains("instant 1"));
    assert!(rows(&[0.0, 30.0], &[1.0]).expect_err("short").contains("1 values where there are 2 instants"));
    assert_eq!(rows(&[0.0, 1e-6, 1e9], &[-40.0, 500.0, 0.0]), Ok(3), "a jump is a profile like any other");
}

/// Rate of the total bias in a slow ramp at the end of a run, per state of the mechanics.
fn slow_ramp(mechanics: Mechanics, from: f64, to: f64) -> Vec<(f64, f64)> {
    let design = changed(|d| d.mechanics = mechanics);
    let time = half_minutes(4000);
    let end = time[time.len() - 1];
    let chamber = time.iter().map(|t| from + (to - from) * t / end).collect();
    let rows = run(&design, &[Drive::Chamber], &Profile { time, drives: vec![chamber] });
    rows.iter().map(|r| (r.coil, r.bias.total() / ((to - from) / end))).collect()
}

fn steady(change: impl FnOnce(&mut coil::Design)) -> f64 {
    steady_on(&QUICK.resolution, change)
}

fn steady_on(resolution: &MeshFineness, change: impl FnOnce(&mut coil::Design)) -> f64 {
    let model = Model::new(&changed(change), resolution).expect("model");
    model.sensitivity().expect("solve").total() / bias::units::DEG_PER_H_PER_K_PER_MIN_PER_RAD_PER_K
}

#[test]
fn exact_temperature_table_gives_each_rows_own_sensitivity() {
    let row = |temperature, transverse_modulus| FactorsAt { temperature, transverse_modulus, transverse_expansion: 1.0 };
    let rows = slow_ramp(Mechanics::TemperatureTable(vec![row(-30.0, 2.0), row(-20.0, 2.0), row(20.0, 0.5)]), -60.0, 60.0);
    let at = |t: f64| rows.iter().find(|(coil, _)| *coil >= t).expect("passed").1;
    let stiff = steady(scaled(2.0));
    let soft = steady(scaled(0.5));
    assert!((at(-22.0) / stiff - 1.0).abs() < 1e-3 && (at(50.0) / soft - 1.0).abs() < 1e-3, "{} {}", at(-22.0), at(50.0));
    let middle = steady(scaled(1.25));
    assert!(
        (at(0.0) / middle - 1.0).abs() < 3e-3,
        "halfway between the rows the factor is the mean: {} against {middle}",
        at(0.0)
    );
}

#[test]
fn exact_a_relaxing_coil_ends_with_its_relaxed_sensitivity() {
    let ends = |fraction: f64| slow_ramp(Mechanics::Relaxing { fraction, time: 1800.0 }, -60.0, 60.0);
    // the largest share is followed by its polynomial
    for (fraction, off) in [(0.5, 1e-4), (0.8, 2e-4)] {
        let (rows, relaxed) = (ends(fraction), steady(scaled(1.0 - fraction)));
        let last = rows[rows.len() - 1].1;
        assert!((last / relaxed - 1.0).abs() < off, "{fraction}: {last:e} against {relaxed:e}");
    }
    let (none, elastic) = (ends(0.0), slow_ramp(Mechanics::Elastic, -60.0, 60.0));
    let relaxed = steady(scaled(0.5));
    assert!(none.iter().zip(&elastic).all(|(a, b)| (a.1 - b.1).abs() < 1e-9 * relaxed.abs()));
    let too_much = changed(|d| d.mechanics = Mechanics::Relaxing { fraction: 0.9, time: 1800.0 });
    assert!(Dynamics::new(&too_much, &[Drive::Chamber], &QUICK).is_err());
}

#[test]
fn exact_an_opening_bond_switches_with_hysteresis_and_without_a_jump_of_the_phase() {
    let opening = |below| Mechanics::Opening(Opening { side: Side::Right, below, hysteresis: 10.0, fraction: 0.5 });
    // a design whose bond can open is meshed with a layer more
    let closed = steady_on(&MeshFineness { layers: QUICK.resolution.layers + 1, ..QUICK.resolution }, |_| ());
    let warming = slow_ramp(opening(-20.0), -60.0, 60.0);
    let at = |rows: &[(f64, f64)], t: f64| rows.iter().find(|(coil, _)| *coil >= t).expect("passed").1;
    let open = at(&warming, -30.0);
    assert!((open / closed - 1.0).abs() > 0.05, "half the bond matters: {open:e} against {closed:e}");
    assert!((at(&warming, -15.0) / open - 1.0).abs() < 1e-3, "still open within the hysteresis");
    assert!((at(&warming, 0.0) / closed - 1.0).abs() < 1e-2);
    let cooling = slow_ramp(opening(-20.0), 60.0, -60.0);
    let down = |t: f64| cooling.iter().find(|(coil, _)| *coil <= t).expect("passed").1;
    assert!((down(-15.0) / closed - 1.0).abs() < 1e-2 && (down(-25.0) / open - 1.0).abs() < 1e-2);
    assert!(warming.iter().skip(1).all(|(_, rate)| rate.abs() < 3.0 * closed.abs()), "no jump at the switch");
}

#[test]
fn exact_the_thermometers_own_lag_adds_to_the_ramps() {
    let ramp = |lag: f64| {
        let time = half_minutes(2000);
        let profile = Profile { drives: vec![time.iter().map(|t| t / 60.0).collect()], time };
        let design = changed(|d| d.sensor.lag = lag);
        let rows = run(&design, &[Drive::Chamber], &profile);
        rows[rows.len() - 1].sensor
    };
    assert!(((ramp(0.0) - ramp(300.0)) * 60.0 / 300.0 - 1.0).abs() < 1e-6);
}

#[test]
fn exact_a_strong_mount_takes_the_spool_to_its_own_temperature_on_either_side() {
    // the reference spool has a flange at the right and its bare hub at the left
    for (side, flanged) in [(Side::Left, true), (Side::Right, true), (Side::Left, false)] {
        let design = changed(|d| {
            if flanged {
                spool(d).flanges[0].side = side;
            }
            d.heat.mounts.push(Mount { side, conductance: 1e5 });
            d.sensor.y = 9.01e-3;
        });
        let time = half_minutes(2000);
        let warm = time.iter().map(|t| (t / 600.0).min(10.0)).collect();
        let profile = Profile { drives: vec![vec![0.0; time.len()], warm], time };
        let rows = run(&design, &[Drive::Chamber, Drive::Mount(side)], &profile);
        let sensor = rows[rows.len() - 1].sensor;
        assert!((9.5..10.0).contains(&sensor), "{side:?}: {sensor}");
    }
}

#[test]
fn exact_reduced_and_full_runs_agree_when_a_heater_is_switched_on() {
    let design = changed(|d| d.heat.heaters.push(Heater { side: Side::Right, power: 2.0 }));
    let drives = [Drive::Chamber, Drive::Heaters];
    let thermal = ThermalModel::new(&design, &QUICK.resolution, &drives).expect("model");
    let model = Model::new(&design, &QUICK.resolution).expect("model");
    let outputs = functionals(&design, &model, &thermal).expect("outputs");
    let time = half_minutes(200);
    let profile = Profile { drives: vec![vec![20.0; 200], vec![1.0; 200]], time };
    let full = thermal.run(&profile, &[outputs.thermometer], 1e-4).expect("run");
    let reduced = run(&design, &drives, &profile);
    for (full, reduced) in full.outputs.iter().zip(&reduced) {
        assert!((full[0] - reduced.sensor).abs() < 5e-3, "{} against {}", full[0], reduced.sensor);
    }
}

#[test]
fn bounds_what_cannot_be_modelled_is_refused() {
    let none = Fidelity { modes: 0, ..QUICK };
    assert!(Dynamics::new(&reference(), &[Drive::Chamber], &none).is_err());
    assert!(Dynamics::new(&reference(), &[], &QUICK).is_err());
    assert!(Dynamics::new(&reference(), &[Drive::Heaters], &QUICK).is_err());
}

/// Response at 1 − 0.8 x against its interpolation of degree 8 through Chebyshev–Lobatto points, midway between them, where it is worst.
#[test]
fn exact_the_response_of_a_relaxing_coil_is_a_polynomial_to_2e_4() {
    let response = |x: f64| steady(scaled(1.0 - 0.8 * x));
    let at = |k: f64| (1.0 - (std::f64::consts::PI * k / 8.0).cos()) / 2.0;
    let nodes: Vec<f64> = (0..=8).map(|k| at(f64::from(k))).collect();
    let values: Vec<f64> = nodes.iter().map(|x| response(*x)).collect();
    let largest = values.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    for k in 0..8 {
        let x = at(f64::from(k) + 0.5);
        let basis = |i: usize| (0..9).filter(|j| *j != i).map(|j| (x - nodes[j]) / (nodes[i] - nodes[j])).product::<f64>();
        let polynomial: f64 = (0..9).map(|i| basis(i) * values[i]).sum();
        let error = (polynomial - response(x)).abs() / largest;
        assert!(error < 2e-4, "x = {x}: {error:e}");
    }
}
