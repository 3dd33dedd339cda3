//! The section of coil and spool: it agrees with the turns, fills its area, and moves as uniform warming moves it.

use crate::common::{QUICK, changed, half_minutes, reference};
use coil::{Drive, Dynamics, Layout, Profile, Region, Section, SectionFields, ThermalState, TurnFields};
use fem_core::material::TransverselyIsotropic;

type Modelled = (Dynamics, TurnFields, SectionFields);

fn modelled(design: &coil::Design, drives: &[Drive]) -> Modelled {
    Dynamics::with_section(design, drives, &QUICK).expect("model")
}

/// A chamber from 20 °C up 1 K/min; the state after half an hour and how fast it changes.
fn in_a_ramp(dynamics: &Dynamics) -> [ThermalState; 2] {
    let time = half_minutes(60);
    let profile = Profile { drives: vec![time.iter().map(|t| 20.0 + t / 60.0).collect()], time };
    let step = dynamics.steps(&profile).expect("steps").last().expect("a step");
    let reduced = dynamics.reduced();
    let state = reduced.within(&step, 12.0);
    let change = reduced.change(&state, &step.slope);
    [state, change]
}

#[test]
fn exact_the_section_at_a_turn_is_the_turn() {
    let design = reference();
    let (dynamics, turns, fields) = modelled(&design, &[Drive::Chamber]);
    let [state, _] = in_a_ramp(&dynamics);
    let section = Section::new(&design, &QUICK.resolution, &fields).expect("section");
    let winding = winding::wind(&design.winding).expect("winding");
    let centres: Vec<[f64; 2]> = winding.turns().iter().map(|t| [t.r, t.y]).collect();
    let found = section.at(&state, &[20.0]).at_places(&section.places(&centres));
    let since = turns.at(&ThermalState { drives: vec![state.drives[0] - 20.0], ..state.clone() });
    let temperature = turns.at(&state).temperature;
    let strain = since.axial.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
    assert!(strain > 1e-5, "{strain}");
    for (i, found) in found.iter().enumerate() {
        let found = found.expect("in the coil");
        assert!((found.temperature - temperature[i]).abs() < 1e-10, "turn {i}");
        assert!((found.strain[2] - since.axial[i]).abs() < 1e-11 * strain, "turn {i}");
        assert!(
            (found.glass_radial - since.radial[i]).abs() < 1e-9 * strain,
            "turn {i}: {} {}",
            found.glass_radial,
            since.radial[i]
        );
    }
}

#[test]
fn exact_elements_fill_the_solids_and_agree_with_points() {
    let design = reference();
    let (dynamics, _, fields) = modelled(&design, &[Drive::Chamber]);
    let [state, _] = in_a_ramp(&dynamics);
    let section = Section::new(&design, &QUICK.resolution, &fields).expect("section");
    let at = section.at(&state, &[20.0]);
    let elements = at.elements();
    let area = |region: Region| {
        let of = elements.iter().filter(|e| e.region == region);
        of.map(|e| (0..2).map(|c| e.points[e.points.len() - 1][c] - e.points[0][c]).product::<f64>()).sum::<f64>()
    };
    let layout = Layout::new(&design).expect("layout");
    let rectangle = |region: Region| {
        let s = layout.solids.iter().find(|s| s.region == region).expect("a solid");
        (s.r[1] - s.r[0]) * (s.y[1] - s.y[0])
    };
    assert!((area(Region::Coil) / rectangle(Region::Coil) - 1.0).abs() < 1e-12);
    // the flange takes its end of the hub
    let hub = rectangle(Region::Hub) - 4e-3 * 2e-3;
    assert!((area(Region::RightFlange) / rectangle(Region::RightFlange) - 1.0).abs() < 1e-12);
    assert!((area(Region::Hub) / hub - 1.0).abs() < 1e-12);
    // nodes inside an element are that element's alone
    let n = QUICK.resolution.order + 1;
    for element in &elements {
        let inner = n + 1;
        let point = at.at_places(&section.places(&element.points[inner..=inner]))[0].expect("inside");
        let node = element.values[inner];
        let close = |a: f64, b: f64, scale: f64| (a - b).abs() < 1e-9 * scale || (a.is_nan() && b.is_nan());
        assert!(close(point.temperature, node.temperature, 1.0));
        (0..2).for_each(|c| assert!(close(point.displacement[c], node.displacement[c], 1e-6)));
        (0..4).for_each(|c| assert!(close(point.strain[c], node.strain[c], 1e-4), "{c}: {point:?} {node:?}"));
        assert!(close(point.glass_radial, node.glass_radial, 1e-4));
    }
    let outside = section.places(&[[design.winding.inner_radius, -1.0], [0.0, 0.01]]);
    assert_eq!(at.at_places(&outside), [None, None]);
}

#[test]
fn exact_a_bare_coil_that_warms_as_one_expands_freely() {
    let alpha = 2e-5;
    let isotropic =
        TransverselyIsotropic { e_z: 1e9, e_r: 1e9, g_zr: 1e9 / 2.6, nu_zr: 0.3, nu_r: 0.3, alpha_z: alpha, alpha_r: alpha };
    let bare = changed(|d| {
        d.spool = None;
        d.sensor.radius = d.winding.inner_radius;
        d.body.elastic = isotropic;
    });
    let (dynamics, _, fields) = modelled(&bare, &[Drive::Chamber]);
    let section = Section::new(&bare, &QUICK.resolution, &fields).expect("section");
    let warm = ThermalState { drives: vec![21.0], amplitudes: vec![0.0; dynamics.reduced().rates().len()] };
    let place = [0.045, 0.009];
    let found = section.at(&warm, &[20.0]).at_places(&section.places(&[place]))[0].expect("inside");
    let m = bare.dehomogenization;
    assert!((found.temperature - 21.0).abs() < 1e-12);
    for (strain, expected) in found.strain.iter().zip([alpha, alpha, alpha, 0.0]) {
        assert!((strain - expected).abs() < 1e-9 * alpha, "{found:?}");
    }
    assert!((found.displacement[0] - alpha * place[0]).abs() < 1e-9 * alpha * place[0], "{found:?}");
    let glass = (m.m_rx + m.m_ry + m.m_rz) * alpha + m.m_rt;
    assert!((found.glass_radial - glass).abs() < 1e-9 * alpha, "{found:?}");
}

#[test]
fn exact_the_phase_of_a_changing_state_grows_as_the_turns_do() {
    let design = reference();
    let (dynamics, turns, _) = modelled(&design, &[Drive::Chamber]);
    let [state, change] = in_a_ramp(&dynamics);
    let winding = winding::wind(&design.winding).expect("winding");
    let slices = turns.at(&change).slices(&winding, design.optics.thermal_expansion);
    let of_turns = bias::bias(&design.optics, winding.length(), &slices).expect("bias").total();
    let reduced = dynamics.reduced();
    // a mean over a step too short for anything to happen
    let value = |state: &ThermalState| {
        let step = coil::Step { from: state.clone(), slope: vec![0.0], dt: 1e-12 };
        reduced.parts().iter().map(|part| reduced.mean(part, &step)).sum::<f64>()
    };
    let rate = value(&change);
    assert!((of_turns / rate - 1.0).abs() < 1e-8, "{of_turns} against {rate}");
    // a change is the difference of states in the limit of short times
    let step = coil::Step { from: state.clone(), slope: change.drives.clone(), dt: 1.0 };
    let difference = (value(&reduced.within(&step, 1e-3)) - value(&state)) / 1e-3;
    assert!((difference / rate - 1.0).abs() < 1e-3, "{difference} against {rate}");
}
