//! The library's interpolated responses against the chain itself: every mechanism as a changed design, modelled anew.

mod beside;
mod chamber_lag;
#[path = "../../coil/tests/common/mod.rs"]
mod common;
mod figures;
#[path = "../../recording/tests/common/figures.rs"]
mod figures_kit;
mod flexible;
mod heat_paths;
mod offers;
mod on_request;
mod read_out_curvature;
mod shared;
mod written;

use coil::{Contact, Design, Drive, Dynamics, Heater, Mechanics, Profile, STANDARD, Side};
use common::reference as design;
use diagnosis::{Active, ForwardModel};
use mechanisms::{CATALOGUE, Gyro, Instruments, Library, Mechanism, Prepared, RATE, REFERENCE_C, SPOOL, with_constant};
use read_out_curvature::ReadOutCurvature;
use std::sync::OnceLock;

/// Twelve hours of a smooth course between −20 and 60 °C that starts at rest, a row a minute.
fn course() -> (Vec<f64>, Vec<f64>) {
    let time: Vec<f64> = (0..720).map(|n| 60.0 * f64::from(n)).collect();
    let chamber = time.iter().map(|t| chamber_at(*t)).collect();
    (time, chamber)
}

fn chamber_at(t: f64) -> f64 {
    20.0 + (1.0 - (-(t / 2000.0).powi(2)).exp()) * 40.0 * (t / 4000.0).sin() * (0.3 + 0.7 * (t / 9000.0).cos())
}

/// Steps that were told while the model of [`gyro`] was made, and of how many.
static TOLD: std::sync::Mutex<Vec<(usize, usize)>> = std::sync::Mutex::new(Vec::new());

fn gyro() -> &'static std::sync::Mutex<Gyro<'static>> {
    static GYRO: OnceLock<std::sync::Mutex<Gyro<'static>>> = OnceLock::new();
    GYRO.get_or_init(|| {
        let told = |step: progress::Step| TOLD.lock().expect("counts").extend(step.done);
        let library = shared::library(&design(), CATALOGUE, &told);
        std::sync::Mutex::new(of(library, CATALOGUE))
    })
}

fn of(library: Library, mechanisms: &[&'static dyn Mechanism]) -> Gyro<'static> {
    read_by(&Instruments::default(), library, mechanisms)
}

fn read_by(instruments: &Instruments, library: Library, mechanisms: &[&'static dyn Mechanism]) -> Gyro<'static> {
    let (time, chamber) = course();
    let prepared = Prepared::new(&library, &time, &chamber, 60.0).expect("prepared");
    Gyro::fitted_to(library, mechanisms, vec![prepared], 1, instruments).expect("gyro")
}

/// Thermometer and rate \[deg/h\] of a design modelled anew.
fn anew(design: &Design) -> [Vec<f64>; 2] {
    under(design, course().1)
}

/// The same under another course of the air.
fn under(design: &Design, chamber: Vec<f64>) -> [Vec<f64>; 2] {
    shared::solved(&(design, &chamber), || solved(design, chamber.clone()))
}

fn solved(design: &Design, chamber: Vec<f64>) -> [Vec<f64>; 2] {
    const PARTS: usize = 4;
    let heaters = (!design.heat.heaters.is_empty()).then(|| (Drive::Heaters, vec![1.0; chamber.len()]));
    let (drives, courses): (Vec<Drive>, Vec<Vec<f64>>) = std::iter::once((Drive::Chamber, chamber)).chain(heaters).unzip();
    let dynamics = Dynamics::new(design, &drives, &STANDARD).expect("dynamics");
    let time = course().0;
    let rows = dynamics.simulate(&Profile { time, drives: courses }.smoothed(PARTS)).expect("run");
    let scale = bias::units::DEG_PER_H_PER_RAD_PER_S;
    let rate = |rows: &[coil::Response]| rows.iter().map(|r| scale * r.rate()).sum::<f64>() / PARTS as f64;
    let rates = [scale * rows[0].rate()].into_iter().chain(rows[1..].chunks(PARTS).map(rate)).collect();
    [rows.iter().step_by(PARTS).map(|r| r.sensor).collect(), rates]
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len() as f64).sqrt()
}

fn minus(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

#[test]
fn exact_a_rate_of_its_instants_and_one_of_its_rows_change_alike() {
    // the phase of a curved dn/dT goes through the same values, whatever a reading is called
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let (time, chamber) = course();
    let told = [0.0, 60.0].map(|averaging| {
        let prepared = Prepared::new(&library, &time, &chamber, averaging).expect("prepared");
        assert_eq!(prepared.time(), time);
        let gyro = Gyro::new(library.clone(), CATALOGUE, vec![prepared]).expect("gyro");
        let of = |id: &str, values: &[f64], choice: Option<f64>| {
            let [nominal, with] = with_mechanism(&gyro, &design(), id, values, choice).1;
            minus(&with[RATE], &nominal[RATE])
        };
        [of("thermo-optic-curvature", &[2.5e-8], None), of("self-heating", &[0.05, 30.0], Some(1.0))]
    });
    let [[bent, heated], [bent_in_rows, heated_in_rows]] = told;
    let (off, size) = (rms(&minus(&bent, &bent_in_rows)), rms(&bent_in_rows));
    assert!(size > 0.0 && off < 1e-6 * size, "{off} of {size}");
    // so does what a heater does, once a row has one before it: a rate of the first instant alone is not known
    let (off, size) = (rms(&minus(&heated[1..], &heated_in_rows[1..])), rms(&heated_in_rows[1..]));
    assert!(size > 0.0 && off < 1e-6 * size && heated[0] == 0.0, "{off} of {size}, {} first", heated[0]);
}

#[test]
fn a_heater_of_the_design_s_own_follows_the_chain() {
    let mut heated = design();
    // neither an open bond nor a medium: fewer models
    common::spool(&mut heated).flanges[0].contact = Contact::Gap;
    heated.heat.film = Some(8.0);
    heated.heat.heaters.push(Heater { side: Side::Right, power: 0.05 });
    let mut unheated = heated.clone();
    unheated.heat.heaters.clear();
    let [with, without] = [&heated, &unheated].map(|design| {
        let gyro = of(shared::library(design, &[], &|_| ()), &[]);
        let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        gyro.respond(0, &middle, &[]).expect("response")
    });
    let [heated, unheated] = [&heated, &unheated].map(anew);
    for (channel, name) in ["thermometer", "rate"].iter().enumerate() {
        let effect = minus(&heated[channel], &unheated[channel]);
        let off = rms(&minus(&minus(&with[channel], &without[channel]), &effect));
        assert!(rms(&effect) > 0.0 && off < SHARE * rms(&effect), "{name}: {off} of {}", rms(&effect));
    }
}

/// A read-out that drifts and a dn/dT that is curved are parts of the design: nothing of them is left to be found.
#[test]
fn a_drift_of_the_design_s_own_follows_the_chain() {
    let mut drifting = design();
    drifting.drifts.read_out = 0.01 / bias::units::DEG_PER_H_PER_RAD_PER_S;
    drifting.drifts.reference = 35.0;
    drifting.drifts.thermo_optic_curvature = 2.5e-8;
    let sound = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let [with, without] = [shared::library(&drifting, &[], &|_| ()), sound].map(|library| {
        let gyro = of(library, &[]);
        let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        gyro.respond(0, &middle, &[]).expect("response").swap_remove(RATE)
    });
    let [drifts, sound] = [&drifting, &design()].map(|design| {
        let [_, rate] = anew(design);
        rate
    });
    // an offset is the record's own
    let [of_library, of_chain] = [minus(&with, &without), minus(&drifts, &sound)].map(|effect| effect[1..].to_vec());
    assert!(rms(&of_chain) > 0.1 && rms(&minus(&of_library, &of_chain)) < 1e-3 * rms(&of_chain), "{}", rms(&of_library));
}

/// Largest share of a mechanism's effect by which the library may differ from the chain.
const SHARE: f64 = 0.02;

/// The design with a mechanism put in, modelled anew, against the library's interpolation.
fn agrees(id: &str, values: &[f64], choice: Option<f64>, channels: &[usize]) {
    static NOMINAL: OnceLock<[Vec<f64>; 2]> = OnceLock::new();
    let (changed, responses) = {
        let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        with_mechanism(&gyro, &design(), id, values, choice)
    };
    let exact_nominal = NOMINAL.get_or_init(|| anew(&design()));
    agree(&format!("{id} {values:?}"), &responses, &anew(&changed), exact_nominal, channels);
}

/// A design with a mechanism put in, and the library's responses without it and with it.
fn with_mechanism(gyro: &Gyro, design: &Design, id: &str, values: &[f64], choice: Option<f64>) -> (Design, [Vec<Vec<f64>>; 2]) {
    let mechanism = gyro.find(id).expect("a mechanism");
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let active = Active { mechanism, values: values.to_vec(), choice };
    let changed = gyro.extended(design, &active).expect("a place in the design");
    (changed, [&[][..], &[active]].map(|active| gyro.respond(0, &middle, active).expect("response")))
}

fn agree(
    what: &str,
    [nominal, with]: &[Vec<Vec<f64>>; 2],
    exact: &[Vec<f64>; 2],
    exact_nominal: &[Vec<f64>; 2],
    channels: &[usize],
) {
    for &channel in channels {
        let effect = minus(&exact[channel], &exact_nominal[channel]);
        let off = rms(&minus(&minus(&with[channel], &nominal[channel]), &effect));
        assert!(off < SHARE * rms(&effect), "{what}, channel {channel}: off by {off:e} of {:e}", rms(&effect));
    }
    assert!(rms(&minus(&nominal[RATE], &exact_nominal[RATE])) < 2e-4 * rms(&exact_nominal[RATE]));
}

#[test]
fn winding_type_mechanisms_follow_the_chain() {
    agrees("tail-asymmetry", &[-0.63], None, &[RATE]);
    agrees("winding-defect", &[-3.0], Some(24.0), &[RATE]);
}

/// A fit tries a part of a turn.
#[test]
fn a_part_of_a_turn_is_that_part_of_its_effect() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let of = |turns: f64| with_mechanism(&gyro, &design(), "winding-defect", &[turns], Some(24.0)).1[1].swap_remove(RATE);
    let [two, part, three] = [-2.0, -2.75, -3.0].map(of);
    let (whole, between) = (minus(&three, &two), minus(&part, &two));
    assert!(rms(&whole) > 1e-3 && rms(&minus(&between, &whole.iter().map(|x| 0.75 * x).collect::<Vec<_>>())) < 1e-9);
}

/// A shorter coil of fewer layers, with a thicker flange, whose bias is nearly all elasto-optic.
fn short() -> Design {
    let mut short = design();
    short.winding = winding::Spec {
        layers: 32,
        turns_odd_layers: 60,
        turns_even_layers: 59,
        inner_radius: 30e-3,
        pitch: 0.168e-3,
        ..short.winding
    };
    (short.body.outer_radius, short.body.height) = (34.6783e-3, 10.08e-3);
    common::spool(&mut short).flanges[0].thickness = 3e-3;
    short.sensor = coil::Sensor { radius: 26e-3, y: 5.04e-3, ..short.sensor };
    short.optics.sagnac_diameter = 64.6783e-3;
    short
}

#[test]
fn a_short_coil_s_tail_follows_the_chain() {
    let tail = [mechanisms::find("tail-asymmetry").expect("in the catalogue")];
    let gyro = of(shared::library(&short(), &tail, &|_| ()), &tail);
    let (changed, responses) = with_mechanism(&gyro, &short(), "tail-asymmetry", &[0.3], None);
    let [exact, nominal] = [&changed, &short()].map(anew);
    agree("a short coil's tail", &responses, &exact, &nominal, &[RATE]);
}

#[test]
fn material_mechanisms_follow_the_chain() {
    agrees("adhesive-content", &[0.037], None, &[RATE, SPOOL]);
    agrees("viscoelastic-relaxation", &[0.3, 5000.0], None, &[RATE]);
    agrees("glass-transition", &[28.0, 6.0, 0.65, 1.08], None, &[RATE]);
}

#[test]
fn a_bond_that_opens_follows_the_chain() {
    // from the middle of a layer to that of the next but one the sign of what it does turns
    for share in [0.24, 0.47] {
        agrees("debond", &[28.0, 8.0, share], None, &[RATE]);
    }
}

/// However far from the drawing: by its tolerance, or by the mechanism that is a factor on it and takes its place.
#[test]
fn a_constant_with_a_path_of_its_own_follows_the_chain() {
    let (nominal, moved, factor) = {
        let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        let place =
            gyro.nuisances().iter().position(|n| n.parameter.name == "conductivity of the surroundings").expect("a place");
        let mut u = middle.clone();
        u[place] = 0.6;
        let active = Active { mechanism: gyro.find("air-path").expect("a mechanism"), values: vec![0.6], choice: None };
        let of = |u: &[f64], active: &[Active]| gyro.respond(0, u, active).expect("response");
        let factor = of(&middle, std::slice::from_ref(&active));
        assert_eq!(factor, of(&u, &[active]));
        (of(&middle, &[]), of(&u, &[]), factor)
    };
    assert_eq!(moved, factor);
    let mut changed = design();
    changed.surroundings.conductivity *= 0.6;
    let (exact, exact_nominal) = (anew(&changed), anew(&design()));
    for channel in [SPOOL, RATE] {
        let effect = minus(&exact[channel], &exact_nominal[channel]);
        let off = rms(&minus(&minus(&moved[channel], &nominal[channel]), &effect));
        assert!(off < SHARE * rms(&effect), "channel {channel}: off by {off:e} of {:e}", rms(&effect));
    }
}

#[test]
fn optics_read_out_and_sensor_follow_the_chain() {
    agrees("thermo-optic-curvature", &[2.5e-8], None, &[RATE]);
    agrees("rate-temperature-coefficient", &[2e-3], None, &[RATE]);
    agrees("sensor-lag", &[70.0], None, &[SPOOL]);
}

/// Air that follows the recorded chamber, stepped second by second, drives a chain of its own.
#[test]
fn air_that_lags_behind_the_chamber_s_reading_follows_the_chain() {
    const LAG: f64 = 400.0;
    let mut air = vec![chamber_at(0.0)];
    for minute in 1..course().0.len() {
        let step = |air: f64, s: usize| {
            let t = 60.0 * (minute - 1) as f64 + s as f64;
            let slope = |t: f64, air: f64| (chamber_at(t) - air) / LAG;
            let first = slope(t, air);
            air + (first + slope(t + 1.0, air + first)) / 2.0
        };
        air.push((0..60).fold(air[minute - 1], step));
    }
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let active = Active { mechanism: gyro.find("chamber-lag").expect("a mechanism"), values: vec![LAG], choice: None };
    let responses = [&[][..], std::slice::from_ref(&active)].map(|active| gyro.respond(0, &middle, active).expect("response"));
    agree("chamber-lag", &responses, &under(&design(), air), &anew(&design()), &[SPOOL, RATE]);
    assert!(gyro.extended(&design(), &active).is_none(), "it is of the test");
}

/// The chain's own readings, compensated step by step with the sensitivity that the coil has on a mesh of its own.
#[test]
fn a_compensated_rate_follows_the_chain() {
    const TAKEN: f64 = 0.9;
    const FILTER: f64 = 90.0;
    let nominal = anew(&design());
    let [thermometer, rate] = &nominal;
    let per_k_per_s = coil::steady_sensitivity(&design()).expect("a ramp").sensitivity.total() * bias::units::S_PER_MIN;
    let (mut filtered, mut compensated) = (thermometer[0], rate.clone());
    for n in 1..rate.len() {
        let before = filtered;
        for second in 1..=60 {
            let read = thermometer[n - 1] + (thermometer[n] - thermometer[n - 1]) * (f64::from(second) - 0.5) / 60.0;
            filtered += (read - filtered) / (FILTER + 0.5);
        }
        compensated[n] -= TAKEN * per_k_per_s * (filtered - before) / 60.0;
    }
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let active =
        Active { mechanism: gyro.find("compensated-rate").expect("a mechanism"), values: vec![TAKEN, FILTER], choice: None };
    let responses = [&[][..], std::slice::from_ref(&active)].map(|active| gyro.respond(0, &middle, active).expect("response"));
    assert!(rms(&compensated) < 0.6 * rms(rate), "compensation takes bias off");
    agree("compensated-rate", &responses, &[thermometer.clone(), compensated], &nominal, &[RATE]);
    assert!(gyro.extended(&design(), &active).is_none(), "it is of the electronics");
}

/// Effect of each mechanism on a design, by hand.
#[test]
fn exact_the_extended_design_has_the_change_at_its_place() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let with = |id: &str, values: &[f64], choice: Option<f64>| {
        let active = Active { mechanism: gyro.find(id).expect("a mechanism"), values: values.to_vec(), choice };
        gyro.extended(&design(), &active).expect("a place in the design")
    };
    let of = |change: &dyn Fn(&mut Design)| {
        let mut changed = design();
        change(&mut changed);
        changed
    };
    assert_eq!(with("tail-asymmetry", &[-0.63], None), of(&|d| d.winding.tails.ccw = 0.63));
    let defect = Some(winding::LayerDefect { layer: 24, turns: -3 });
    assert_eq!(with("winding-defect", &[-3.0], Some(24.0)), of(&|d| d.winding.defect = defect));
    assert_eq!(with("interface-resistance", &[1.3e-3], None), of(&|d| d.heat.hub_resistance = 1.3e-3));
    assert_eq!(with("air-path", &[1.17], None), of(&|d| d.surroundings.conductivity = 0.026 * 1.17));
    let mount = coil::Mount { side: Side::Right, conductance: 0.9 };
    assert_eq!(with("axial-heat-path", &[0.9], None), of(&|d| d.heat.mounts.push(mount)));
    let heater = coil::Heater { side: Side::Right, power: 0.2 };
    assert_eq!(with("self-heating", &[0.2, 60.0], None), of(&|d| d.heat.heaters.push(heater)));
    assert_eq!(with("sensor-lag", &[70.0], None), of(&|d| d.sensor.lag = 70.0));
    assert_eq!(with("thermo-optic-curvature", &[2.5e-8], None), of(&|d| d.drifts.thermo_optic_curvature = 2.5e-8));
    let read_out = 2e-3 / bias::units::DEG_PER_H_PER_RAD_PER_S;
    assert_eq!(with("rate-temperature-coefficient", &[2e-3], None), of(&|d| d.drifts.read_out = read_out));
    assert_eq!(
        with("viscoelastic-relaxation", &[0.3, 5000.0], None).mechanics,
        Mechanics::Relaxing { fraction: 0.3, time: 5000.0 }
    );
    // rule of mixtures: the glass that the polymer takes the place of carries the load along the fibre
    let e_z = with("adhesive-content", &[0.037], None).body.elastic.e_z;
    assert!((e_z - (14.5e9 - 0.037 * (70.2e9 - 1e9))).abs() < 1e-6 * e_z);
    // one kind of changing mechanics has the place of another
    let relaxing = Design { mechanics: Mechanics::Relaxing { fraction: 0.1, time: 1.0 }, ..design() };
    let opening = Active { mechanism: gyro.find("debond").expect("a mechanism"), values: vec![0.0, 1.0, 0.2], choice: None };
    assert_eq!(gyro.extended(&relaxing, &opening), None);
}

/// A record of a unit with its constants and instruments somewhere, and a mechanism: white noise of the size that the channels' priors expect.
fn recorded(gyro: &Gyro, u: &[f64], active: &[Active]) -> diagnosis::Observation {
    let with = gyro.respond(0, u, active).expect("response");
    let mut state = 1_u64;
    let mut uniform = move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut noise = move |sd: f64| sd * ((0..12).map(|_| uniform()).sum::<f64>() - 6.0);
    let noisy = |(series, channel): (&Vec<f64>, &diagnosis::Channel)| -> Vec<f64> {
        series.iter().map(|x| x + noise(channel.noise.white.0)).collect()
    };
    let channels = with.iter().zip(gyro.channels()).map(noisy).collect();
    diagnosis::Observation { time: course().0, channels }
}

/// Of a design with a longer tail and another constant, the model that is told both misses nothing; the one that is told neither misses all of it.
#[test]
fn a_full_solution_misses_what_the_model_is_not_told() {
    let gyro = gyro().lock().expect("a model");
    let drawing = gyro.library().design();
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let tail = [Active { mechanism: gyro.find("tail-asymmetry").expect("a tail"), values: vec![0.5], choice: None }];
    // one that both channels depend on
    let constant =
        gyro.nuisances().iter().position(|n| n.parameter.name == "conductivity of the surroundings").expect("a constant");
    let name = gyro.nuisances()[constant].parameter.name.clone();
    let mut told = middle.clone();
    told[constant] = gyro.nuisances()[constant].parameter.prior.value(0.5);
    let design = with_constant(drawing, &name, told[constant]).expect("a design");
    let design = gyro.extended(&design, &tail[0]).expect("a design with a tail");
    let missed = |u: &[f64], active: &[Active]| gyro.missed(0, u, active, &design).expect("solves").expect("no heaters");
    let [with, without] = [(&told, &tail[..]), (&middle, &[])].map(|(u, active)| gyro.respond(0, u, active).expect("responds"));
    for channel in [SPOOL, RATE] {
        let effect = minus(&with[channel], &without[channel]);
        let [both, neither] = [missed(&told, &tail), missed(&middle, &[])].map(|mut all| all.swap_remove(channel));
        eprintln!(
            "{name}, channel {channel}: {:.2e}, {:.2e} of {:.2e}",
            rms(&both),
            rms(&minus(&neither, &effect)),
            rms(&effect)
        );
        assert!(rms(&both) < 0.02 * rms(&effect) && rms(&minus(&neither, &effect)) < 0.02 * rms(&effect), "channel {channel}");
    }
}

/// The spool's expansion as a constant of the design, and as one that changes with temperature.
#[test]
fn an_expansion_that_changes_has_the_effect_of_the_constant_s_change() {
    const BY: f64 = 1e-3;
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let gyro = of(library, &[mechanisms::find("unknown:spool-expansion").expect("in the catalogue")]);
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let mut larger = middle.clone();
    let constant = gyro.nuisances().iter().position(|n| n.parameter.name == "spool expansion").expect("a constant");
    larger[constant] += BY;
    let nominal = gyro.respond(0, &middle, &[]).expect("response");
    let of_constant = minus(&gyro.respond(0, &larger, &[]).expect("response")[RATE], &nominal[RATE]);
    let active = Active { mechanism: 0, values: vec![BY], choice: None };
    let with = gyro.respond(0, &middle, &[active]).expect("response");
    let of_change = minus(&with[RATE], &nominal[RATE]);
    // a row is a mean since the one before
    let between = |n: usize| f64::midpoint(nominal[SPOOL][n.saturating_sub(1)], nominal[SPOOL][n]);
    let expected: Vec<f64> = of_constant.iter().enumerate().map(|(n, x)| x * (between(n) - REFERENCE_C)).collect();
    assert!(rms(&of_constant) > 1e-6, "{}", rms(&of_constant));
    assert!(rms(&minus(&of_change, &expected)) < 1e-3 * rms(&expected), "{} {}", rms(&of_change), rms(&expected));
}

/// docs/adding-a-mechanism.md: a mechanism that the crate does not know is fitted, compared and named like any other.
#[test]
fn a_mechanism_of_one_s_own_is_named() {
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let known = ["tail-asymmetry", "thermo-optic-curvature", "rate-temperature-coefficient"];
    let known = known.map(|id| mechanisms::find(id).expect("in the catalogue"));
    let gyro = of(library, &[&known[..], &[&ReadOutCurvature]].concat());
    let own = gyro.find("read-out-curvature").expect("its own");
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let respond = |active: &[Active]| gyro.respond(0, &middle, active).expect("response");
    let active = Active { mechanism: own, values: vec![6e-5], choice: None };
    let (with, without) = (respond(std::slice::from_ref(&active)), respond(&[]));
    // the mean since the row before, on the steepest ramp too
    for row in 1..with[SPOOL].len() {
        let bent = |n: usize| 6e-5 * (with[SPOOL][n] - REFERENCE_C).powi(2);
        let expected = f64::midpoint(bent(row - 1), bent(row));
        assert!((with[RATE][row] - without[RATE][row] - expected).abs() < 1e-12, "row {row}");
    }

    let record = recorded(&gyro, &middle, &[active]);
    let found = diagnosis::diagnose(&gyro, &[0], &[record], &diagnosis::Settings::default(), &|_| ()).expect("diagnosis");
    assert_eq!(found.verdict, diagnosis::Verdict::Explained);
    assert_eq!(found.set, [own]);
    let estimate = &found.parameters[0][0];
    assert!((estimate.ci90[0]..estimate.ci90[1]).contains(&6e-5), "{estimate:?}");
}

/// A coil whose constants are not those of glass in a polymer has no content of adhesive to change.
#[test]
fn exact_an_adhesive_content_needs_a_coil_of_glass_and_polymer() {
    let content = mechanisms::find("adhesive-content").expect("known");
    let scene = mechanisms::Scene { temperatures: [-40.0, 60.0], noise: 0.01, earth: None };
    let offered = |change: &dyn Fn(&mut coil::Body)| {
        let mut design = design();
        change(&mut design.body);
        content.offer(&design, &scene).is_some()
    };
    assert!(offered(&|_| ()));
    assert!(!offered(&|body| body.elastic.alpha_z = 0.0));
    assert!(!offered(&|body| body.conductivity_r *= 200.0));
    assert!(!offered(&|body| body.density *= 0.05));
    assert!(!offered(&|body| body.elastic.e_z *= 0.05));
}

/// In a steady ramp each parameter that matters makes its own change of the mechanical state.
#[test]
fn exact_a_steady_change_of_the_mechanical_state_is_that_of_its_parameter() {
    let of = |id: &str, value: f64| -> Vec<coil::MechanicalState> {
        let facts = mechanisms::find(id).expect("known").facts();
        let changed = |steady: &mechanisms::Steady| match steady {
            mechanisms::Steady::Changes { changed, .. } => Some(changed(&design(), value).1),
            _ => None,
        };
        facts.steady.iter().filter_map(changed).collect()
    };
    let nominal = coil::MechanicalState::NOMINAL;
    let softer = coil::MechanicalState { transverse_modulus: 0.7, ..nominal };
    assert_eq!(of("glass-transition", 0.7), [softer, coil::MechanicalState { transverse_expansion: 0.7, ..nominal }]);
    // the share that relaxes is gone in the end
    for id in ["viscoelastic-relaxation", "stress-free-temperature"] {
        let [relaxed] = of(id, 0.3)[..] else { panic!("{id}") };
        assert!((relaxed.transverse_modulus - 0.7).abs() < 1e-15, "{id}");
        assert_eq!(coil::MechanicalState { transverse_modulus: 1.0, ..relaxed }, nominal);
    }
}

/// Steps are counted up to the last, and none beyond.
#[test]
fn progress_ends_with_the_last_model() {
    if shared::are_models_kept() {
        return;
    }
    drop(gyro().lock());
    let told = TOLD.lock().expect("counts");
    assert!(told.iter().all(|(done, of)| done <= of), "{told:?}");
    let (last, of) = told.iter().copied().max().expect("a step");
    assert!(last == of && told.len() == of && told.iter().all(|(_, other)| *other == of), "{last} of {of}");
}

#[test]
fn a_chamber_that_rests_has_a_range_of_temperatures_all_the_same() {
    let library = gyro().lock().expect("a gyro").library().clone();
    let time: Vec<f64> = (0..60).map(|n| 60.0 * f64::from(n)).collect();
    let rest = Prepared::new(&library, &time, &[25.0; 60], 60.0).expect("prepared");
    let [low, high] = Gyro::new(library, &[], vec![rest]).expect("gyro").scene().temperatures;
    assert!((low - 25.0).abs() < 1e-9 && high > low && high < 25.01, "{low} {high}");
}

/// Tails that double the bias, read a quarter of a row late: where nobody said which minute a rate is the mean of, all of it is late, not the design's
/// part alone.
#[test]
fn a_rate_that_is_read_late_is_late_with_what_a_mechanism_adds() {
    const LATE_S: f64 = 15.0;
    let (changed, told) = {
        let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
        let gyro = read_by(&Instruments { unsaid: 60.0, ..Instruments::default() }, library, CATALOGUE);
        let place =
            gyro.nuisances().iter().position(|n| n.parameter.name == "delay of the rate's readings [s]").expect("a place");
        let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        let mut late = middle.clone();
        late[place] = LATE_S;
        let tail = Active { mechanism: gyro.find("tail-asymmetry").expect("a mechanism"), values: vec![-1.5], choice: None };
        let rate = |u: &[f64]| gyro.respond(0, u, std::slice::from_ref(&tail)).expect("response").swap_remove(RATE);
        (gyro.extended(&design(), &tail).expect("a place"), minus(&rate(&late), &rate(&middle)))
    };
    let [exact, on_time] = [LATE_S, 0.0].map(|late| under(&changed, course().0.iter().map(|t| chamber_at(t - late)).collect()));
    let effect = minus(&exact[RATE], &on_time[RATE]);
    let off = rms(&minus(&told, &effect));
    assert!(off < SHARE * rms(&effect), "off by {off:e} of {:e}", rms(&effect));
}

/// Derivatives by the chamber's instruments, about a thermometer without a lag and about a slow one, against models made beside it: behind a follower
/// the derivatives are not those of the course itself.
#[test]
fn the_chamber_s_instruments_act_as_in_a_model_made_anew() {
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    for (interval, lag) in [(20.0, 0.0), (20.0, 40.0), (30.0, 0.0), (30.0, 40.0), (60.0, 0.0), (60.0, 40.0)] {
        // a step up, and one down, behind a controller
        let time: Vec<f64> = (0..).map(|n| interval * f64::from(n)).take_while(|t| *t < 10_800.0).collect();
        let after = |t: f64| 1.0 - (1.0 + t.max(0.0) / 150.0) * (-t.max(0.0) / 150.0).exp();
        let chamber: Vec<f64> = time.iter().map(|t| 20.0 + 10.0 * after(t - 1800.0) - 15.0 * after(t - 6000.0)).collect();
        let prepared = Prepared::new(&library, &time, &chamber, interval).expect("prepared");
        let gyro = Gyro::new(library.clone(), &[], vec![prepared]).expect("gyro");
        let place = |name: &str| gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a place");
        let (delay, squared) =
            (place("delay of the chamber's readings [s]"), place("squared lag of the chamber's thermometer [s2]"));
        let mut here: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
        (here[delay], here[squared]) = (11.0, lag * lag);
        let about = gyro.about(&here, &[]).expect("a model").expect("another place");
        let of = |model: &Gyro, u: &[f64]| model.respond(0, u, &[]).expect("response");
        // of second derivatives rows that are far apart know less; from no lag to one of ten seconds, the least step at which a model is
        // made anew, the next term of the expansion is a fifth of the effect
        let far = if lag > 0.0 { 0.1 } else { 0.25 };
        for (place, by, close) in [(delay, 6.0, 0.1), (squared, 108.0, far)] {
            let mut beside = here.clone();
            beside[place] += by;
            let anew = of(&about.about(&beside, &[]).expect("a model").expect("another place"), &beside);
            let (linear, nominal) = (of(&about, &beside), of(&about, &here));
            for channel in [SPOOL, RATE] {
                let effect = minus(&anew[channel], &nominal[channel]);
                let off = rms(&minus(&linear[channel], &anew[channel])) / rms(&effect);
                assert!(
                    off < close,
                    "{interval} s, lag {lag} s, nuisance {place}, channel {channel}: off by {off:.3} of the effect"
                );
            }
        }
    }
}
