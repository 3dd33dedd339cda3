//! Designs as coil files: what is written reads back as it was, and simulates as the diagnosis predicts.

use std::path::Path;
use std::sync::OnceLock;

use crate::common::{CELL, COIL, Folder, change};
use coil::{Design, Drive, Dynamics, Profile, STANDARD, Tolerances};
use diagnosis::{Active, ForwardModel, Nuisance, Role};
use fogcoil::cache::Cache;
use fogcoil::input::{RATE, RecordOptions, check_coil, read_coil, read_record};
use fogcoil::output::coil_file;
use fogcoil::prepare::library;
use mechanisms::{CATALOGUE, Gyro, Library, Prepared, RATE as RATE_CHANNEL, SPOOL, with_constant};

const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/concealed/open/case_13/fit.csv");

/// Every mechanism of the unit: id, values, choice.
const ALL: [(&str, &[f64], Option<f64>); 13] = [
    ("tail-asymmetry", &[-0.317], None),
    ("winding-defect", &[-3.0], Some(24.0)),
    ("adhesive-content", &[0.0388], None),
    ("glass-transition", &[33.6, 7.06, 0.66, 1.067], None),
    ("viscoelastic-relaxation", &[0.273, 8343.4], None),
    ("debond", &[-7.2073, 8.967, 0.05], None),
    ("interface-resistance", &[0.0010612], None),
    ("air-path", &[0.95262], None),
    ("axial-heat-path", &[0.56968], None),
    ("self-heating", &[0.18209, 1e-3], None),
    ("sensor-lag", &[46.147], None),
    ("thermo-optic-curvature", &[-2.2104e-8], None),
    ("rate-temperature-coefficient", &[0.0019903], None),
];

/// A coil's library, which the program keeps for other tests, too.
fn library_of(coil: &str) -> Library {
    let cache = Cache::in_folder(concat!(env!("CARGO_TARGET_TMPDIR"), "/cache")).of_code_in(env!("CARGO_BIN_EXE_fogcoil"));
    library(&check_coil(Path::new("coil.ron"), coil).unwrap(), &cache, &|_| ()).unwrap()
}

/// The reference coil's library and one record's chamber.
fn gyro() -> Gyro<'static> {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    under_the_record(LIBRARY.get_or_init(|| library_of(COIL)).clone())
}

fn under_the_record(library: Library) -> Gyro<'static> {
    let (time, chamber) = record();
    let prepared = Prepared::new(&library, &time, &chamber, 30.0).unwrap();
    Gyro::new(library, CATALOGUE, vec![prepared]).unwrap()
}

/// Instants and chamber, its thermometer's noise averaged away: it shakes fast modes that each model has its own number of.
fn record() -> (Vec<f64>, Vec<f64>) {
    const SIDE: usize = 4;
    let case = read_record(RECORD.as_ref(), &RecordOptions::default()).unwrap();
    let kept = case.kept();
    assert!(case.number(RATE).is_some());
    let chamber = &kept.channels()[0].values;
    let mean = |n: usize| {
        let side = SIDE.min(n).min(chamber.len() - 1 - n);
        chamber[n - side..=n + side].iter().sum::<f64>() / (2 * side + 1) as f64
    };
    (kept.time().to_vec(), (0..chamber.len()).map(mean).collect())
}

fn active(gyro: &Gyro, (id, values, choice): (&str, &[f64], Option<f64>)) -> Active {
    Active { mechanism: gyro.find(id).unwrap(), values: values.to_vec(), choice }
}

/// Written and read.
fn back(design: &Design) -> Design {
    let text = coil_file("a \"name\"", design, &Tolerances::default(), &["a comment\nof two lines".into()]);
    let case = check_coil(Path::new("m.ron"), &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(case.name, "a \"name\"");
    case.design
}

#[test]
fn every_design_that_a_file_can_say_reads_back_as_it_was() {
    let folder = Folder::new();
    folder.write("cell-reference.ron", CELL);
    let constants = &COIL[COIL.find("Constants((").unwrap()..COIL.find("        )),\n    ),\n").unwrap() + 10];
    let spool = &COIL[COIL.find("spool: Some").unwrap()..COIL.find("    surroundings").unwrap()];
    let flange = "flanges: [(side: Right, thickness_mm: 2.0, overhang_mm: 1.0, bonded: true)]";
    let two = "flanges: [(side: Left, thickness_mm: 1.1, overhang_mm: 0.0, bonded: false), \
               (side: Right, thickness_mm: 2.3, overhang_mm: 1.7, bonded: true)]";
    let heat = "heat: (hub_resistance_m2k_per_w: 1.3e-4, mounts: [(side: Right, conductance_w_per_m2k: 7.7)], \
                heaters: [(side: Right, power_w: -0.1)], film_w_per_m2k: Some(9.3)), sensor:";
    for (name, text) in [
        ("reference", COIL.to_owned()),
        ("of a cell", change(COIL, constants, "FromCell(\"cell-reference.ron\")")),
        ("as printed", change(COIL, &COIL[COIL.find("Matrix((m_rx").unwrap()..COIL.rfind(",\n)").unwrap()], "Printed")),
        ("free", change(COIL, spool, "spool: None,\n")),
        ("two flanges", change(COIL, flange, two)),
        ("loose hub", change(COIL, "hub_bonded: true", "hub_bonded: false")),
        ("heat", change(COIL, "sensor:", heat)),
        ("relaxing", change(COIL, "sensor:", "mechanics: Relaxing((fraction: 0.31, time_s: 901.7)), sensor:")),
        ("lag", change(COIL, "y_mm: 10.01", "y_mm: 10.017, lag_s: 21.3")),
        ("left", change(COIL, "cw_climbs: Right", "cw_climbs: Left")),
        ("equal turns", change(COIL, "turn_length: True", "turn_length: Equal")),
        ("mechanical", change(COIL, "strain: Total", "strain: Mechanical")),
        ("drifts", change(COIL, "optics:", "drifts: (reference_c: 23.7, read_out_deg_per_h_per_k: 1.23e-3), optics:")),
    ] {
        let path = folder.write("coil.ron", text);
        let design = read_coil(&path).unwrap_or_else(|error| panic!("{name}: {error}")).design;
        let read = back(&design);
        if name == "of a cell" {
            // its moduli come from a solve: no decimal in GPa need give them to the last bit
            assert_eq!(back(&read), read, "{name}");
            assert!(near(&read, &design), "{name}");
        } else {
            assert_eq!(read, design, "{name}");
        }
    }
}

/// Equal but for the last bit of what a file has in another unit.
fn near(a: &Design, b: &Design) -> bool {
    let close = |a: f64, b: f64| (a - b).abs() <= 2.0 * f64::EPSILON * b.abs();
    let (mut same, e) = (a.clone(), &b.body.elastic);
    let own = a.body.elastic;
    (same.body.elastic.e_z, same.body.elastic.e_r, same.body.elastic.g_zr) = (e.e_z, e.e_r, e.g_zr);
    same.drifts.read_out = b.drifts.read_out;
    same == *b
        && close(own.e_z, e.e_z)
        && close(own.e_r, e.e_r)
        && close(own.g_zr, e.g_zr)
        && close(a.drifts.read_out, b.drifts.read_out)
}

#[test]
fn every_mechanism_reads_back_as_it_was() {
    let gyro = gyro();
    assert_eq!(gyro.mechanisms().iter().filter(|m| m.named).count(), ALL.len() + 2);
    let nominal = gyro.library().design().clone();
    // of the test or the electronics, not of the coil: a coil file has no key for them
    let elsewhere: [(&str, &[f64]); 2] = [("chamber-lag", &[302.6]), ("compensated-rate", &[0.8, 60.0])];
    assert!(elsewhere.iter().all(|(id, values)| gyro.extended(&nominal, &active(&gyro, (id, values, None))).is_none()));
    for found in ALL {
        let design = gyro.extended(&nominal, &active(&gyro, found)).unwrap();
        assert_ne!(design, nominal, "{}", found.0);
        let read = back(&design);
        assert!(near(&read, &design), "{}: {read:?} against {design:?}", found.0);
        assert_eq!(back(&read), read, "{}", found.0);
    }
    // two mechanisms in two places are both there; two laws of the mechanics have one place
    let both = |a: usize, b: usize| {
        let one = gyro.extended(&nominal, &active(&gyro, ALL[a])).unwrap();
        gyro.extended(&one, &active(&gyro, ALL[b]))
    };
    let pair = both(0, 5).unwrap();
    assert_eq!(pair.winding.tails.ccw, 0.317);
    assert!(matches!(back(&pair).mechanics, coil::Mechanics::Opening(_)));
    assert_eq!(both(3, 5), None);
}

#[test]
fn a_wide_transition_is_one_that_a_file_holds() {
    let gyro = gyro();
    let wide = active(&gyro, ("glass-transition", &[-60.0, 40.0, 0.7, 1.1], None));
    back(&gyro.extended(gyro.library().design(), &wide).unwrap());
}

/// Root mean square.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(s, n), v| (s + v * v, n + 1));
    (sum / f64::from(count)).sqrt()
}

/// Thermometer \[°C\] and rate \[deg/h\] of a design at the rows of the record, its chamber smooth between them.
fn simulated(design: &Design, time: &[f64], chamber: &[f64]) -> [Vec<f64>; 2] {
    const PARTS: usize = 4;
    let heated = !design.heat.heaters.is_empty();
    let drives: &[Drive] = if heated { &[Drive::Chamber, Drive::Heaters] } else { &[Drive::Chamber] };
    let mut courses = vec![chamber.to_vec()];
    courses.extend(heated.then(|| vec![1.0; time.len()]));
    let profile = Profile { time: time.to_vec(), drives: courses }.smoothed(PARTS);
    let responses = Dynamics::new(design, drives, &STANDARD).unwrap().simulate(&profile).unwrap();
    let per_rate = bias::units::DEG_PER_H_PER_RAD_PER_S;
    let mut rate = vec![responses[0].rate() * per_rate];
    rate.extend(responses[1..].chunks(PARTS).map(|part| part.iter().map(|r| r.rate()).sum::<f64>() * per_rate / PARTS as f64));
    [responses.iter().step_by(PARTS).map(|r| r.sensor).collect(), rate]
}

/// Below every chamber \[°C\].
const COLDEST: f64 = -150.0;

/// The part of a mechanism's effect by which simulating the file differs from what the diagnosis predicts.
fn disagreement(gyro: &Gyro, found: (&str, &[f64], Option<f64>)) -> f64 {
    let (time, chamber) = record();
    let active = active(gyro, found);
    let design = back(&gyro.extended(gyro.library().design(), &active).unwrap());
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let predicted = gyro.respond(0, &middle, std::slice::from_ref(&active)).unwrap();
    let nominal = gyro.respond(0, &middle, &[]).unwrap();
    // a bond that can open is meshed more finely: without effect it is one that stays closed
    let nominal_design = if found.0 == "debond" {
        let values = [&[COLDEST], &found.1[1..]].concat();
        back(&gyro.extended(gyro.library().design(), &self::active(gyro, (found.0, &values, None))).unwrap())
    } else {
        gyro.library().design().clone()
    };
    let (with, without) = (simulated(&design, &time, &chamber), simulated(&nominal_design, &time, &chamber));
    let (channel, of) = if found.0 == "sensor-lag" { (SPOOL, 0) } else { (RATE_CHANNEL, 1) };
    // a reading after a gap is a mean over its own span alone, which simulate has no notion of
    let rows: Vec<usize> = (1..time.len()).filter(|&n| time[n] - time[n - 1] < 45.0).collect();
    let effect = |n: &usize| predicted[channel][*n] - nominal[channel][*n];
    let other = |n: &usize| with[of][*n] - without[of][*n];
    let size = rms(rows.iter().map(effect));
    assert!(size > 1e-4, "{}: an effect of {size}", found.0);
    rms(rows.iter().map(|n| effect(n) - other(n))) / size
}

#[test]
fn simulating_the_file_gives_what_the_diagnosis_predicts() {
    let off = disagreement(&gyro(), ALL[5]);
    assert!(off < 0.02, "debond: {off}");
}

#[test]
#[ignore = "minutes"]
fn simulating_any_mechanism_gives_what_the_diagnosis_predicts() {
    let gyro = gyro();
    for found in ALL {
        let off = disagreement(&gyro, found);
        eprintln!("{}: {off:.4}", found.0);
        assert!(off < 0.02, "{}: {off}", found.0);
    }
}

/// Of a file with mechanisms put in: the part of the largest single effect on the rate by which a full simulation differs from what the diagnosis
/// predicts of all at once; none of a heater.
fn missed(gyro: &Gyro, found: &[(&str, &[f64], Option<f64>)]) -> Option<f64> {
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let active: Vec<Active> = found.iter().map(|found| active(gyro, *found)).collect();
    let design = active.iter().fold(gyro.library().design().clone(), |design, active| gyro.extended(&design, active).unwrap());
    let missed = gyro.missed(0, &middle, &active, &back(&design)).unwrap()?;
    let rate = |active: &[Active]| gyro.respond(0, &middle, active).unwrap().swap_remove(RATE_CHANNEL);
    let nominal = rate(&[]);
    let effect = |active: &Active| rms(rate(std::slice::from_ref(active)).iter().zip(&nominal).map(|(a, b)| a - b));
    Some(rms(missed[RATE_CHANNEL].iter().copied()) / active.iter().map(effect).fold(0.0, f64::max))
}

/// The joint effect of two mechanisms follows from the effect of each, and from their kinds.
#[test]
fn mechanisms_act_together_as_a_full_simulation_has_it() {
    let gyro = gyro();
    let all = |ids: &[&str]| -> Vec<_> { ids.iter().map(|id| *ALL.iter().find(|of| of.0 == *id).unwrap()).collect() };
    for (ids, most) in [
        // both move the middle of the fibre, and add up
        (&["tail-asymmetry", "winding-defect"][..], 1e-3),
        // one is another temperature of the other
        (&["air-path", "tail-asymmetry"], 1e-3),
        // two changes of the same stiffness
        (&["adhesive-content", "glass-transition"], 0.02),
        // a bond that can open is meshed more finely
        (&["debond"], 0.05),
    ] {
        let off = missed(&gyro, &all(ids)).unwrap();
        assert!(off < most, "{ids:?}: {off}");
    }
    // when a heater was switched on is no part of a design
    assert_eq!(missed(&gyro, &all(&["self-heating"])), None);
}

/// Tails of an octupole make twenty times its own bias: neither is a share of the other, whatever the constants are.
#[test]
#[ignore = "a minute"]
fn a_tail_of_a_winding_that_cancels_is_the_same_beside_other_constants() {
    let gyro = under_the_record(library_of(&COIL.replace("PracticalQuadrupole", "Octupole").replace("layers: 36", "layers: 32")));
    let drawing = gyro.library().design();
    let tail = [active(&gyro, ("tail-asymmetry", &[0.5], None))];
    let told = |sign: f64| -> Vec<f64> {
        let of = |(k, n): (usize, &Nuisance)| {
            n.parameter.prior.value(if n.role == Role::Constant { sign * [1.0, -1.0][k % 2] } else { 0.0 })
        };
        gyro.nuisances().iter().enumerate().map(of).collect()
    };
    for u in [told(0.0), told(1.0), told(-1.0)] {
        let constants = gyro.nuisances().iter().zip(&u).filter(|(n, _)| n.role == Role::Constant);
        let design = constants
            .fold(drawing.clone(), |design, (n, value)| with_constant(&design, &n.parameter.name, *value).unwrap_or(design));
        let left = |active: &[Active]| {
            let design = active.iter().fold(design.clone(), |design, active| gyro.extended(&design, active).unwrap());
            gyro.missed(0, &u, active, &design).unwrap().unwrap().swap_remove(RATE_CHANNEL)
        };
        let rate = |active: &[Active]| gyro.respond(0, &u, active).unwrap().swap_remove(RATE_CHANNEL);
        let differ = |with: Vec<f64>, without: Vec<f64>| rms(with.iter().zip(&without).map(|(a, b)| a - b));
        let off = differ(left(&tail), left(&[])) / differ(rate(&tail), rate(&[]));
        assert!(off < 0.1, "{off}");
    }
}

/// A unit far from its drawing: the model is made about the unit, and is no measure of what the drawing does.
#[test]
fn a_film_far_off_the_drawing_leaves_nothing_of_the_thermometer() {
    let dehomogenization = "    dehomogenization: Matrix";
    let coil = change(COIL, dehomogenization, &format!("    heat: (film_w_per_m2k: Some(14.0)),\n{dehomogenization}"));
    let drawn = under_the_record(library_of(&coil));
    let told = |n: &Nuisance| n.parameter.prior.value(if n.parameter.name == "film coefficient" { -2.8 } else { 0.0 });
    let u: Vec<f64> = drawn.nuisances().iter().map(told).collect();
    let (film, value) = drawn.nuisances().iter().zip(&u).find(|(n, _)| n.parameter.name == "film coefficient").unwrap();
    let unit = with_constant(drawn.library().design(), &film.parameter.name, *value).unwrap();
    let gyro = drawn.about(&u, &[]).unwrap().unwrap();
    let missed = gyro.missed(0, &u, &[], &unit).unwrap().unwrap();
    let as_drawn = gyro.in_full(drawn.library().design()).unwrap().under(0).unwrap();
    let of_unit = gyro.in_full(&unit).unwrap().under(0).unwrap();
    for (channel, most) in [(SPOOL, 1e-3), (RATE_CHANNEL, 1e-2)] {
        let effect = rms(of_unit[channel].iter().zip(&as_drawn[channel]).map(|(a, b)| a - b));
        let off = rms(missed[channel].iter().copied()) / effect;
        assert!(off < most, "{channel}: {off} of {effect}");
    }
}

#[test]
#[ignore = "minutes"]
fn any_two_mechanisms_act_together_as_a_full_simulation_has_it() {
    let gyro = gyro();
    // a law of the mechanics leaves no place for another
    let excludes = |a: &str| ["glass-transition", "viscoelastic-relaxation", "debond"].contains(&a);
    for (k, a) in ALL.iter().enumerate() {
        for b in ALL[k + 1..].iter().filter(|b| !(excludes(a.0) && excludes(b.0))) {
            let Some(off) = missed(&gyro, &[*a, *b]) else { continue };
            eprintln!("{} and {}: {off:.4}", a.0, b.0);
            assert!(off < 0.1, "{} and {}: {off}", a.0, b.0);
        }
    }
}
