//! The reference coil in time against the responses that an independent finite-element code computes for it.

use bias::{Bias, units::DEG_PER_H_PER_RAD_PER_S};
use coil::{Drive, Dynamics, Profile, STANDARD};
use std::path::PathBuf;
use std::sync::LazyLock;

/// Parts of a row in which the chamber's course is followed.
const PARTS: usize = 6;

struct Case {
    /// Thermometer, Shupe, axial, radial part, sum: ours and theirs at every row.
    ours: [Vec<f64>; 5],
    theirs: [Vec<f64>; 5],
}

fn fixture(name: &str) -> PathBuf {
    [env!("CARGO_MANIFEST_DIR"), "..", "fixtures", name].iter().collect()
}

static DYNAMICS: LazyLock<Dynamics> = LazyLock::new(|| {
    let design = fogcoil::input::read_coil(&fixture("coil-reference.ron")).expect("coil file").design;
    Dynamics::new(&design, &[Drive::Chamber], &STANDARD).expect("model")
});

fn case(name: &str) -> Case {
    let text = std::fs::read_to_string(fixture("nominal").join(name)).expect("fixture");
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|line| line.split(',').map(|v| v.parse().expect("a number")).collect()).collect();
    let column = |k: usize| rows.iter().map(|row| row[k]).collect::<Vec<f64>>();
    let profile = Profile { time: column(0), drives: vec![column(1)] }.smoothed(PARTS);
    let responses = DYNAMICS.simulate(&profile).expect("run");
    let mut ours = [vec![responses[0].sensor], vec![0.0], vec![0.0], vec![0.0], vec![0.0]];
    for row in responses[1..].chunks(PARTS) {
        let sum = row.iter().fold(Bias::ZERO, |sum, r| sum + r.bias) * (DEG_PER_H_PER_RAD_PER_S / PARTS as f64);
        let values = [row[PARTS - 1].sensor, sum.shupe, sum.eo_axial, sum.eo_radial, sum.total()];
        ours.iter_mut().zip(values).for_each(|(channel, v)| channel.push(v));
    }
    Case { ours, theirs: [2, 3, 4, 5, 6].map(column) }
}

impl Case {
    /// Largest and rms difference of a channel, relative to its peak excursion.
    fn difference(&self, k: usize) -> [f64; 2] {
        let (ours, theirs) = (&self.ours[k], &self.theirs[k]);
        assert_eq!(ours.len(), theirs.len());
        let peak = theirs.iter().map(|v| (v - theirs[0]).abs()).fold(0.0, f64::max);
        let off: Vec<f64> = ours.iter().zip(theirs).map(|(a, b)| (a - b).abs() / peak).collect();
        [off.iter().copied().fold(0.0, f64::max), (off.iter().map(|e| e * e).sum::<f64>() / off.len() as f64).sqrt()]
    }

    /// The factor on a part that fits theirs best.
    fn gain(&self, k: usize) -> f64 {
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        dot(&self.ours[k], &self.theirs[k]) / dot(&self.ours[k], &self.ours[k])
    }
}

/// The tolerances lie just above what is measured: a drift of a thousandth of time constant or sensitivity breaks them.
fn check(name: &str, most_sensor: f64, most_rate: f64) {
    let case = case(name);
    let [sensor, _] = case.difference(0);
    assert!(sensor < most_sensor, "{name}: thermometer {sensor:.2e} of its peak");
    let [largest, rms] = case.difference(4);
    assert!(largest < most_rate && rms < 2e-3, "{name}: rate {largest:.2e}, rms {rms:.2e} of its peak");
    // their quadratic elements give 0.998 of the axial part and 0.996 of the radial one
    for (k, theirs) in [(2, 0.9981), (3, 0.9961), (4, 0.9979)] {
        let gain = case.gain(k);
        assert!((gain - theirs).abs() < 5e-4, "{name}: part {k} has a gain of {gain:.5}");
    }
    let shupe = case.gain(1);
    assert!((shupe - 1.0).abs() < 5e-3, "{name}: the Shupe part has a gain of {shupe:.5}");
}

#[test]
fn exact_the_slow_profile_agrees_with_an_independent_code() {
    check("P1.csv", 3.0e-4, 2.5e-3);
}

#[test]
fn exact_the_staircase_agrees_with_an_independent_code() {
    check("P3.csv", 4.5e-4, 5.1e-3);
}

#[test]
fn paper_elasto_optic_parts_rule_and_of_them_the_axial_one() {
    // Osunluk et al., section V: in a chamber profile EO is far above Shupe, axial far above radial
    for name in ["P1.csv", "P3.csv"] {
        let case = case(name);
        let peak = |k: usize| case.ours[k].iter().map(|v| v.abs()).fold(0.0, f64::max);
        let [shupe, axial, radial] = [1, 2, 3].map(peak);
        assert!(axial > 4.0 * shupe && axial > 7.0 * radial, "{name}: {shupe:.4}, {axial:.4}, {radial:.4} deg/h");
    }
}
