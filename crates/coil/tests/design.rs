//! Bad designs end in a message that names the field; good ones are laid out where they belong.

use crate::common::{changed, reference, spool};
use coil::{Bonds, COARSE, Contact, Design, Domain, Error, Flange, Grid, Layout, MeshFineness, Model, Region, Side, ramp_lag};

#[test]
fn exact_layout_of_the_reference_coil() {
    let layout = Layout::new(&reference()).expect("layout");
    assert!((layout.chamber.r[1] - 59.825e-3).abs() < 1e-12);
    assert!((layout.chamber.y[0] + 10e-3).abs() < 1e-12 && (layout.chamber.y[1] - 30.02e-3).abs() < 1e-12);
    assert_eq!(layout.region(40e-3, 19e-3), Region::RightFlange);
    assert_eq!(layout.region(45e-3, 19e-3), Region::RightFlange);
    assert_eq!(layout.region(49e-3, 19e-3), Region::RightFlange);
    assert_eq!(layout.region(45e-3, 9e-3), Region::Coil);
    assert_eq!(layout.region(49e-3, 9e-3), Region::Medium);
}

#[test]
fn exact_unbonded_parts_stand_back_and_the_coil_stays() {
    let layout = Layout::new(&changed(|d| {
        spool(d).hub_contact = Contact::Gap;
        spool(d).flanges[0].contact = Contact::Gap;
    }))
    .expect("layout");
    assert!((layout.bore - 39.3e-3).abs() < 1e-12);
    assert_eq!(layout.region(43.4e-3, 9e-3), Region::Medium);
    assert_eq!(layout.region(45e-3, 18.1e-3), Region::Medium);
    assert_eq!(layout.region(43.6e-3, 18.0e-3), Region::Coil);
    assert_eq!(layout.region(40e-3, 9e-3), Region::Hub);
    assert_eq!(layout.region(43.4e-3, 19e-3), Region::RightFlange);
}

#[test]
fn bounds_each_bad_design_names_its_field() {
    type Change = fn(&mut Design);
    let cases: [(&str, Change); 12] = [
        ("coil.outer_radius", |d| d.body.outer_radius = 43.5e-3),
        ("coil.height", |d| d.body.height = f64::NAN),
        ("surroundings.margin", |d| d.surroundings.margin = 0.0),
        ("spool.hub_thickness", |d| spool(d).hub_thickness = 43.5e-3),
        ("spool.flanges[0].thickness", |d| spool(d).flanges[0].thickness = -1e-3),
        ("spool.flanges[0].overhang", |d| spool(d).flanges[0].overhang = f64::INFINITY),
        ("spool.flanges[1].side", |d| {
            let twice: Flange = spool(d).flanges[0];
            spool(d).flanges.push(twice);
        }),
        ("sensor", |d| d.sensor.radius = 0.1),
        ("winding", |d| d.body.height = 17e-3),
        ("nu_r", |d| d.body.elastic.nu_r = 0.9999),
        ("dehomogenization.m_rx", |d| d.dehomogenization.m_rx = f64::NAN),
        ("dehomogenization.m_rt", |d| d.dehomogenization.m_rt = f64::INFINITY),
    ];
    for (field, change) in cases {
        let error = Model::new(&changed(change), &COARSE).err().unwrap_or_else(|| panic!("{field} must be refused"));
        assert!(error.to_string().contains(field), "{field}: {error}");
    }
    let error = Model::new(&changed(|d| d.body.outer_radius = 46e-3), &COARSE).err().expect("turns without a coil");
    assert!(error.to_string().contains("enlarge the coil"), "{error}");
    let coarse = MeshFineness { order: 0, ..COARSE };
    assert!(matches!(Model::new(&reference(), &coarse), Err(Error::Resolution(_))));
}

#[test]
fn exact_locating_a_point_returns_its_coordinates() {
    let layout = Layout::new(&reference()).expect("layout");
    let grid = Grid::new(&layout, &COARSE, Domain::Solids, Bonds::Closed).expect("grid");
    let (nodes, elements) = (grid.mesh().nodes(), grid.mesh().elements());
    for (r, y) in [(43.5e-3, 18.02e-3), (48.825e-3, 0.0), (39.5e-3, 10.01e-3), (44.0e-3, 3.3e-3), (49.8e-3, 20.0e-3)] {
        let hits = grid.locate(r, y);
        assert!(!hits.is_empty());
        for (e, xi, eta) in hits {
            assert!(xi.abs() <= 1.0 + 1e-6 && eta.abs() <= 1.0 + 1e-6);
            let (low, high) = (nodes[elements[e][0]], nodes[elements[e][elements[e].len() - 1]]);
            let at = |k: usize, s: f64| low[k] + (high[k] - low[k]) * (1.0 + s) / 2.0;
            assert!((at(0, xi) - r).abs() < 1e-12 && (at(1, eta) - y).abs() < 1e-12);
        }
    }
    assert_eq!(grid.locate(43.5e-3, 18.02e-3).len(), 4, "the corner of coil, hub and flange");
    assert!(grid.locate(49.5e-3, 9e-3).is_empty(), "air beside the coil is not meshed");
}

/// Lag at the middle of a homogeneous cylinder: series in sines along the axis and modified Bessel functions across it.
fn cylinder_lag(capacity_over_conductivity: f64, radius: f64, height: f64, r: f64, y: f64) -> f64 {
    use std::f64::consts::PI;
    // I0(x) e^-x by quadrature of its integral representation; the integrand is periodic, so the midpoint rule is exact to rounding
    let scaled_i0 = |x: f64| (0..4000).map(|k| (x * ((PI * (k as f64 + 0.5) / 4000.0).cos() - 1.0)).exp()).sum::<f64>() / 4000.0;
    (1..400)
        .step_by(2)
        .map(|n| {
            let w = n as f64 * PI / height;
            let ratio = scaled_i0(w * r) / scaled_i0(w * radius) * (w * (r - radius)).exp();
            4.0 / (n as f64 * PI) * capacity_over_conductivity / (w * w) * (1.0 - ratio) * (w * y).sin()
        })
        .sum()
}

#[test]
fn exact_ramp_lag_of_a_homogeneous_cylinder() {
    let design = changed(|d| {
        let (k, density, specific_heat) = (0.34, 1400.0, 1300.0);
        let solid = &mut spool(d).material;
        (solid.conductivity, solid.density, solid.specific_heat) = (k, density, specific_heat);
        let s = &mut d.surroundings;
        (s.conductivity, s.density, s.specific_heat) = (k, density, specific_heat);
    });
    let lag = ramp_lag(&design, &MeshFineness { order: 8, layers: 1, ratio: 0.2 }).expect("solve");
    let exact = cylinder_lag(1400.0 * 1300.0 / 0.34, 59.825e-3, 40.02e-3, 39.5e-3, 20.01e-3);
    assert!((lag.sensor / exact - 1.0).abs() < 1e-6, "{} against {exact}", lag.sensor);
}

#[test]
fn bounds_ramp_lag_of_the_reference_coil_is_near_its_slowest_time_constant() {
    let lag = ramp_lag(&reference(), &MeshFineness { order: 6, layers: 2, ratio: 0.2 }).expect("solve");
    assert!((lag.sensor / 2185.0 - 1.0).abs() < 0.01, "{}", lag.sensor);
    let spread = lag.turns.iter().fold((f64::MAX, f64::MIN), |(a, b), t| (a.min(*t), b.max(*t)));
    assert!(spread.0 > 0.85 * lag.sensor && spread.1 < 1.01 * lag.sensor, "{spread:?}");
    let loose = changed(|d| spool(d).flanges[0].side = Side::Left);
    assert!(ramp_lag(&loose, &MeshFineness { order: 4, layers: 1, ratio: 0.2 }).is_ok());
}

#[test]
fn exact_no_wall_is_lost_to_rounding() {
    // at these margins the last node of the graded mesh lay one rounding off the wall, which then let no heat through
    for margin in [40.3e-3, 41.2e-3, 43.0e-3, 43.7e-3] {
        let lag = |margin: f64| {
            let design = changed(|d| {
                spool(d).flanges.clear();
                d.surroundings.margin = margin;
            });
            ramp_lag(&design, &MeshFineness { order: 4, layers: 2, ratio: 0.2 }).expect("solve").sensor
        };
        assert!(
            (lag(margin) / lag(margin + 1e-6) - 1.0).abs() < 1e-3,
            "{margin}: {} against {}",
            lag(margin),
            lag(margin + 1e-6)
        );
    }
}
