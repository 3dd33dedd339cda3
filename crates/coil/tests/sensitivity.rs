//! Steady-ramp sensitivity: adjoint against brute force, symmetries, exact cases, the reference coil's numbers.

use crate::common::{changed, reference, spool};
use bias::{Bias, Sensitivity, StrainConvention};
use coil::{COARSE, Contact, Design, FINE, Flange, MeshFineness, Model, Side, steady_sensitivity};
use fem_core::material::{Isotropic, TransverselyIsotropic};
use winding::{ClimbSide, Pattern, Spec, Tails, TurnLength};

/// Enough for identities that hold on any mesh.
const QUICK: MeshFineness = MeshFineness { order: 4, layers: 1, ratio: 0.2 };

fn sensitivity(design: &Design, resolution: &MeshFineness) -> Sensitivity {
    Model::new(design, resolution).expect("model").sensitivity().expect("solve")
}

fn total(design: &Design) -> f64 {
    sensitivity(design, &QUICK).total()
}

/// Bias by running the forward model twice and differencing, through the slices of the bias integral.
fn brute_force(design: &Design, rate: impl Fn([f64; 2]) -> f64) -> (Bias, Bias) {
    let model = Model::new(design, &QUICK).expect("model");
    let rates: Vec<f64> = model.grid().mesh().nodes().iter().map(|&p| rate(p)).collect();
    let operator = model.bias_operator().expect("adjoint");
    let dot = |g: &[f64]| g.iter().zip(&rates).map(|(g, r)| g * r).sum::<f64>();
    let adjoint = Bias { shupe: dot(&operator.shupe), eo_axial: dot(&operator.eo_axial), eo_radial: dot(&operator.eo_radial) };
    // two states an hour apart, far from the stress-free one
    let before: Vec<f64> = rates.iter().map(|r| -60.0 - 1800.0 * r).collect();
    let after: Vec<f64> = before.iter().zip(&rates).map(|(t, r)| t + 3600.0 * r).collect();
    let (s0, s1) = (model.slices(&before).expect("solve"), model.slices(&after).expect("solve"));
    let slices: Vec<_> = s0
        .iter()
        .zip(s1)
        .map(|(a, b)| bias::Slice {
            z_start: a.z_start,
            z_end: a.z_end,
            temperature_rate: (b.temperature_rate - a.temperature_rate) / 3600.0,
            axial_strain_rate: (b.axial_strain_rate - a.axial_strain_rate) / 3600.0,
            radial_strain_rate: (b.radial_strain_rate - a.radial_strain_rate) / 3600.0,
        })
        .collect();
    let forward = bias::bias(&design.optics, model.winding().length(), &slices).expect("slices");
    (adjoint, forward)
}

fn assert_close(a: Bias, b: Bias, what: &str) {
    let scale = b.shupe.abs() + b.eo_axial.abs() + b.eo_radial.abs();
    for (a, b) in [(a.shupe, b.shupe), (a.eo_axial, b.eo_axial), (a.eo_radial, b.eo_radial)] {
        assert!((a - b).abs() < 1e-8 * scale, "{what}: adjoint {a:e}, brute force {b:e}");
    }
}

#[test]
fn exact_adjoint_matches_brute_force_differencing() {
    let designs = [
        ("reference", reference()),
        (
            "tails, mechanical strain, left climb",
            changed(|d| {
                d.winding.tails = Tails { cw: 0.7, ccw: 0.1 };
                d.optics.strain = StrainConvention::Mechanical;
                d.winding.cw_climbs = ClimbSide::Left;
            }),
        ),
        (
            "steel, two flanges, one loose",
            changed(|d| {
                let s = spool(d);
                s.material.elastic = Isotropic { youngs_modulus: 193e9, poisson_ratio: 0.29, thermal_expansion: 17.3e-6 };
                let left = Flange { side: Side::Left, contact: Contact::Gap, ..s.flanges[0] };
                s.flanges.push(left);
            }),
        ),
        (
            "no spool, equal turns, soft",
            changed(|d| {
                d.spool = None;
                d.winding.turn_length = TurnLength::Equal;
                d.body.elastic.e_r *= 0.5;
            }),
        ),
    ];
    for (name, design) in designs {
        let (adjoint, forward) = brute_force(&design, |_| 1.0 / 60.0);
        assert_close(adjoint, forward, &format!("{name}, ramp"));
        let (adjoint, forward) = brute_force(&design, |[r, y]| (300.0 * r).sin() / 60.0 + 0.3 * y - 8.0 * r * y);
        assert_close(adjoint, forward, &format!("{name}, uneven warming"));
        assert!(forward.shupe.abs() > 1e-3 * forward.eo_axial.abs(), "the uneven field must have a Shupe part");
    }
}

#[test]
fn exact_one_isotropic_material_expands_freely_and_has_no_bias() {
    let design = changed(|d| {
        let Isotropic { youngs_modulus: e, poisson_ratio: nu, thermal_expansion: a } = crate::common::aluminium().elastic;
        let g = e / (2.0 * (1.0 + nu));
        d.body.elastic = TransverselyIsotropic { e_z: e, e_r: e, g_zr: g, nu_zr: nu, nu_r: nu, alpha_z: a, alpha_r: a };
    });
    let model = Model::new(&design, &QUICK).expect("model");
    let turns = model.at_turns(&[vec![1.0; model.grid().mesh().nodes().len()]]).expect("solve").remove(0);
    let m = design.dehomogenization;
    let radial = (m.m_rx + m.m_ry + m.m_rz) * 23.6e-6 + m.m_rt;
    for (axial, across) in turns.axial.iter().zip(&turns.radial) {
        assert!((axial / 23.6e-6 - 1.0).abs() < 1e-9 && (across / radial - 1.0).abs() < 1e-9, "{axial} {across}");
    }
    assert!(model.sensitivity().expect("solve").total().abs() < 1e-6 * total(&reference()).abs());
}

#[test]
fn exact_no_shupe_part_in_a_steady_ramp_with_or_without_tails() {
    for tails in [Tails { cw: 0.0, ccw: 0.0 }, Tails { cw: 1.3, ccw: 0.2 }] {
        let s = sensitivity(&changed(|d| d.winding.tails = tails), &QUICK);
        assert!(s.shupe.abs() < 1e-9, "{}", s.shupe);
    }
}

#[test]
fn symmetry_mirroring_coil_and_spool_changes_nothing_and_mirroring_one_does() {
    let mirrored = changed(|d| {
        d.winding.cw_climbs = ClimbSide::Left;
        spool(d).flanges[0].side = Side::Left;
    });
    let half = changed(|d| d.winding.cw_climbs = ClimbSide::Left);
    let s = total(&reference());
    assert!((total(&mirrored) / s - 1.0).abs() < 1e-7, "{} against {s}", total(&mirrored));
    assert!((total(&half) - s).abs() > 0.5, "handedness against the flange must matter: {} and {s}", total(&half));
    // nearer to one flange is nearer to its mirror image
    let nearer = |design: &Design, [start, end]: [f64; 2]| {
        total(&Design { winding: Spec { start, end: Some(18.02e-3 + end), ..design.winding }, ..design.clone() })
    };
    let (near, far) = (nearer(&reference(), [0.01e-3, -0.03e-3]), nearer(&mirrored, [0.03e-3, -0.01e-3]));
    assert!((near - s).abs() > 0.01 && (near / far - 1.0).abs() < 1e-7, "{near} against {far}, {s} in its place");
}

#[test]
fn symmetry_strain_conventions_agree_in_a_steady_ramp() {
    let mechanical = changed(|d| {
        d.optics.strain = StrainConvention::Mechanical;
        d.winding.tails = Tails { cw: 0.4, ccw: 0.0 };
    });
    let total_strain = changed(|d| d.winding.tails = Tails { cw: 0.4, ccw: 0.0 });
    assert!((total(&mechanical) - total(&total_strain)).abs() < 1e-9);
}

#[test]
fn exact_loose_bodies_are_each_held_once_and_do_not_touch_the_coil() {
    let loose = changed(|d| {
        spool(d).hub_contact = Contact::Gap;
        spool(d).flanges[0].contact = Contact::Gap;
    });
    let none = changed(|d| d.spool = None);
    // the spool's lines refine the loose coil's mesh differently, so the two agree to discretisation only
    let s = |d: &Design| sensitivity(d, &COARSE).total();
    assert!((s(&loose) / s(&none) - 1.0).abs() < 1e-4, "{} against {}", s(&loose), s(&none));
}

#[test]
fn paper_reference_coil_against_two_independent_codes() {
    let s = steady_sensitivity(&reference()).expect("solve");
    assert!((s.sensitivity.total().abs() / 2.7335 - 1.0).abs() < 1e-3, "{}", s.sensitivity.total());
    assert!((s.sensitivity.eo_axial.abs() / 2.412 - 1.0).abs() < 1e-3, "{}", s.sensitivity.eo_axial);
    assert!(s.sensitivity.total() < 0.0 && s.sensitivity.shupe.abs() < 1e-9);
    assert!(s.error_estimate < 2e-3);
}

#[test]
fn paper_ideal_quadrupole_and_tails() {
    let quadrupole = sensitivity(&changed(|d| d.winding.pattern = Pattern::Quadrupole), &COARSE);
    assert!((quadrupole.total().abs() - 0.437).abs() < 0.003);
    let tail = |cw: f64| total(&changed(|d| d.winding.tails = Tails { cw, ccw: 0.0 }));
    assert_eq!(format!("{:.1}", tail(1.0) - tail(0.0)), "1.8");
}

#[test]
fn bounds_error_estimate_covers_the_true_error_of_total_and_parts_at_most_tenfold() {
    // the reference and three altered designs are in `cargo xtask validate`
    let two_flanges = |d: &mut Design| {
        let left = Flange { side: Side::Left, ..spool(d).flanges[0] };
        spool(d).flanges.push(left);
    };
    let designs = [
        ("no flange", changed(|d| spool(d).flanges.clear())),
        ("loose flange", changed(|d| spool(d).flanges[0].contact = Contact::Gap)),
        ("two flanges, loose hub", changed(|d| (two_flanges(d), spool(d).hub_contact = Contact::Gap).0)),
        ("two flanges, tails", changed(|d| (two_flanges(d), d.winding.tails = Tails { cw: 0.7, ccw: 0.1 }).0)),
        ("no overhang, thin hub", changed(|d| (spool(d).flanges[0].overhang, spool(d).hub_thickness) = (0.0, 0.5e-3))),
        (
            "polymer spool",
            changed(|d| {
                let plastic = Isotropic { youngs_modulus: 3e9, poisson_ratio: 0.38, thermal_expansion: 60e-6 };
                spool(d).material.elastic = plastic;
            }),
        ),
    ];
    let truth_mesh = MeshFineness { order: FINE.order + 1, ..FINE };
    for (name, design) in designs {
        let s = steady_sensitivity(&design).expect("solve");
        let truth = sensitivity(&design, &truth_mesh);
        let ratio = s.error_estimate / (s.sensitivity.total() - truth.total()).abs();
        assert!((1.0..10.0).contains(&ratio), "{name}: estimate over true error {ratio}");
        let (value, error) = (s.sensitivity, s.part_errors);
        assert!((value.eo_axial - truth.eo_axial).abs() < error.eo_axial, "{name}: axial part");
        assert!((value.eo_radial - truth.eo_radial).abs() < error.eo_radial, "{name}: radial part");
    }
}

#[test]
fn exact_the_shear_modulus_along_the_fibre_has_no_part_in_axisymmetry() {
    // Table I cannot tell G_r from G_zr, they are equal to 0.2 %
    let s = total(&changed(|d| d.body.elastic.g_zr *= 3.0));
    assert!((s / total(&reference()) - 1.0).abs() < 1e-12);
}

#[test]
fn exact_a_contact_resistance_has_no_part_in_a_steady_ramp() {
    let s = |d: &Design| sensitivity(d, &COARSE).total();
    let resisting = changed(|d| d.heat.hub_resistance = 1e-3);
    // the skin shifts the grading of the hub by a micrometre
    assert!((s(&resisting) / s(&reference()) - 1.0).abs() < 2e-5, "{} against {}", s(&resisting), s(&reference()));
}

#[test]
fn exact_a_tail_warms_with_the_bore_and_not_with_the_coil() {
    let tailed = changed(|d| d.winding.tails = Tails { cw: 2.0, ccw: 0.0 });
    let model = Model::new(&tailed, &QUICK).expect("model");
    let nodes = model.grid().mesh().nodes();
    // the bore stays, all else warms: the tail's slice, the last one, must not
    let rate: Vec<f64> = nodes.iter().map(|[r, _]| if (r - 39.5e-3).abs() < 1e-9 { 0.0 } else { 1.0 }).collect();
    let slices = model.slices(&rate).expect("solve");
    let tail = slices[slices.len() - 1];
    assert!((tail.z_end - tail.z_start - 2.0).abs() < 1e-9);
    assert_eq!((tail.temperature_rate, tail.axial_strain_rate), (0.0, 0.0));
}
