//! The places that a design leaves for mechanisms, the names of its numbers, and what a mechanism says of itself.

use super::common::{reference, spool};
use super::{Gyro, Library, Prepared, course, gyro, minus, rms, shared};
use coil::{Bonds, Design, Flange, MechanicalState, Mechanics, Mount, Number, Parameter, Side};
use diagnosis::{Active, ForwardModel, Nuisance, Prior};
use mechanisms::{
    CATALOGUE, Chamber, Extent, Instrument, Instruments, Naming, ON_REQUEST, RATE, Scene, Steady, find, number_of, reading_of,
    with_constant,
};
use std::sync::OnceLock;

const SCENE: Scene = Scene { temperatures: [-20.0, 60.0], noise: 0.01, earth: None };

fn of_library(change: impl FnOnce(&mut Instruments)) -> Gyro<'static> {
    let library: Library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let mut instruments = Instruments::default();
    change(&mut instruments);
    super::read_by(&instruments, library, CATALOGUE)
}

#[test]
fn numbers_are_known_by_their_names() {
    let mut design = reference();
    design.sensor.lag = 5.0;
    let set = |name: &str, value: f64| with_constant(&design, name, value).unwrap_or_else(|| panic!("{name}"));
    let other = set("dn/dT", 1.1).optics.thermo_optic;
    assert!((other - 1.1 * design.optics.thermo_optic).abs() < 1e-12 * other);
    let tails = set("CW tail less CCW tail, beyond the drawing's [m]", 0.2).winding.tails;
    assert_eq!((tails.cw - tails.ccw, set("lag of the spool's thermometer", 1.2).sensor.lag), (0.2, 6.0));
    let conductivity = set("k_r", 0.9).body.conductivity_r;
    assert!((conductivity - 0.9 * design.body.conductivity_r).abs() < 1e-12);
    assert!((set("hub thickness [mm]", 3.5).spool.expect("a spool").hub_thickness - 3.5e-3).abs() < 1e-12);
    for (name, number) in [
        ("dn/dT", Number::ThermoOptic),
        ("CW tail less CCW tail, beyond the drawing's [m]", Number::Tail),
        ("lag of the spool's thermometer", Number::SensorLag),
        ("k_r", Number::Constant(Parameter::CoilConductivity)),
        ("margin [mm]", Number::Constant(Parameter::Margin)),
    ] {
        assert_eq!(number_of(name), Some(number), "{name}");
    }
    assert_eq!(number_of("gain of the rate"), None);
    assert!(with_constant(&design, "gain of the rate", 1.0).is_none());
}

#[test]
fn readings_are_known_by_column_and_kind() {
    for (name, key) in [
        ("gain of the chamber's thermometer", "chamber_c.gain"),
        ("delay of the chamber's readings [s]", "chamber_c.delay_s"),
        ("squared lag of the chamber's thermometer [s2]", "chamber_c.lag_squared_s2"),
        ("gain of the spool's thermometer", "spool_c.gain"),
        ("squared time constant of the rate's filter [s2]", "rate_deg_per_h.filter_squared_s2"),
        ("delay of the rate's readings [s]", "rate_deg_per_h.delay_s"),
    ] {
        assert_eq!(reading_of(name), Some(key));
        let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        assert!(gyro.nuisances().iter().any(|nuisance| nuisance.parameter.name == name), "{name}");
    }
    assert_eq!(reading_of("k_r"), None);
}

/// A coil of few turns whose thermometer is drawn with a lag of 4 s: its model is soon made.
fn small() -> Library {
    static SMALL: OnceLock<Library> = OnceLock::new();
    let made = SMALL.get_or_init(|| {
        let mut design = reference();
        design.winding = winding::Spec {
            layers: 4,
            turns_odd_layers: 25,
            turns_even_layers: 24,
            inner_radius: 43.5e-3,
            pitch: 0.17e-3,
            ..design.winding
        };
        (design.body.outer_radius, design.body.height) = (44.2e-3, 4.3e-3);
        (design.sensor.y, design.sensor.lag) = (2.0e-3, 4.0);
        shared::library(&design, &[], &|_| ())
    });
    made.clone()
}

#[test]
fn exact_a_data_sheet_s_lag_is_one_of_the_drawing_s() {
    let prior = |library: Library, lag: Option<f64>, unsaid: f64| -> [Prior; 2] {
        let spool = Instrument { lag, ..Instrument::default() };
        let instruments = Instruments { spool, unsaid, ..Instruments::default() };
        let gyro = super::read_by(&instruments, library, &[]);
        let of = |name: &str| {
            let is_it = |nuisance: &&Nuisance| nuisance.parameter.name == name;
            gyro.nuisances().iter().find(is_it).expect("a number").parameter.prior
        };
        ["lag of the spool's thermometer", "squared time constant of the rate's filter [s2]"].map(of)
    };
    let [lag, filter] = prior(small(), Some(6.0), 60.0);
    assert_eq!(lag, Prior::Normal { mean: 1.5, sd: 0.2 * 1.5 });
    let Prior::Normal { mean, sd } = filter else { panic!("{filter:?}") };
    assert!(mean == 0.0 && (sd - 500.0_f64.hypot(300.0)).abs() < 1e-9, "{sd}");
    let drawn = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    // where it is drawn without one, a data sheet's is no multiple of it
    let [lag, _] = prior(drawn, Some(6.0), 0.0);
    assert!(matches!(lag, Prior::Normal { mean: 1.0, .. }), "{lag:?}");
}

#[test]
fn drifts_have_one_reference() {
    for (id, value) in [("thermo-optic-curvature", 1e-8), ("rate-temperature-coefficient", 1e-3)] {
        let mechanism = find(id).expect("in the catalogue");
        let active = Active { mechanism: 0, values: vec![value], choice: None };
        let extended = |change: fn(&mut coil::Drifts)| {
            let mut design = reference();
            design.drifts.reference = 35.0;
            change(&mut design.drifts);
            mechanism.extended(&design, &active)
        };
        // drifts that vanish nowhere else go with it
        let free = extended(|_| ()).expect("a place");
        assert_eq!(free.drifts.reference, 20.0);
        assert!(extended(|drifts| (drifts.read_out, drifts.reference) = (1e-9, 20.0)).is_some());
        assert!(extended(|drifts| drifts.read_out = 1e-9).is_none());
        assert!(extended(|drifts| drifts.thermo_optic_curvature = 1e-8).is_none());
    }
}

#[test]
fn a_layer_is_located_among_less_than_half_of_all() {
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let active =
        |turns: f64| Active { mechanism: gyro.find("winding-defect").expect("offered"), values: vec![turns], choice: Some(24.0) };
    let layers = |first: f64, last: f64| gyro.extent(&active(1.0), Some([first, last])).layers;
    assert_eq!(layers(3.0, 5.0), Some([3, 5]));
    assert_eq!(layers(10.0, 27.0), Some([10, 27]));
    // of 36 layers
    assert_eq!((layers(10.0, 28.0), layers(1.0, 36.0)), (None, None));
    assert_eq!(gyro.extent(&active(1.0), None), Extent::default());
    // at most forty turns, or one less than half of a layer's
    let u = diagnosis::expected(gyro.nuisances());
    let of = |turns: f64| gyro.respond(0, &u, &[active(turns)]).expect("response").swap_remove(RATE);
    let [most, beyond, less] = [40.0, 1000.0, 39.0].map(of);
    assert!(most == beyond && rms(&minus(&most, &less)) > 1e-3);
}

/// A layer of few turns has fewer to lose.
#[test]
fn exact_a_short_layer_keeps_a_turn() {
    let gyro = super::of(small(), &[find("winding-defect").expect("in the catalogue")]);
    let u = diagnosis::expected(gyro.nuisances());
    let of = |turns: f64| {
        let active = Active { mechanism: 0, values: vec![turns], choice: Some(2.0) };
        gyro.respond(0, &u, &[active]).expect("response").swap_remove(RATE)
    };
    let [most, beyond, less] = [11.0, 30.0, 10.0].map(of);
    assert!(most == beyond && rms(&minus(&most, &less)) > 0.0);
}

#[test]
fn mounts_are_counted_among_flanges_or_from_the_left() {
    let mechanism = find("mount-conductance").expect("in the catalogue");
    let choice = |flanges: &[Side], mounts: &[Side]| {
        let mut design = reference();
        let flange = spool(&mut design).flanges[0];
        spool(&mut design).flanges = flanges.iter().map(|side| Flange { side: *side, ..flange }).collect();
        design.heat.mounts = mounts.iter().map(|side| Mount { side: *side, conductance: 20.0 }).collect();
        mechanism.offer(&design, &SCENE).map(|offer| offer.choice)
    };
    let both = [Side::Right, Side::Left];
    assert_eq!(choice(&both, &[]), None);
    assert_eq!(choice(&both, &[Side::Left]), Some(None));
    assert_eq!(choice(&both, &both), Some(Some(("flange".into(), vec![1.0, 2.0]))));
    assert_eq!(choice(&[Side::Right], &both), Some(Some(("mount_from_left".into(), vec![1.0, 2.0]))));
}

#[test]
fn a_mechanism_says_what_it_is() {
    let mut design = reference();
    let caveat = |id: &str, design: &Design| (find(id).expect("a mechanism").facts().caveat)(design);
    assert_eq!(caveat("sensor-lag", &design), None);
    design.sensor.lag = 5.0;
    assert_eq!(caveat("sensor-lag", &design), Some("the thermometer's own lag and this one are added"));

    let relaxing = Design { mechanics: Mechanics::TemperatureTable(Vec::new()), ..reference() };
    for id in ["moisture", "drying"] {
        let offered = |design: &Design| find(id).expect("on request").offer(design, &SCENE).is_some();
        assert!(offered(&reference()) && !offered(&relaxing), "{id}");
    }

    let debond = find("debond").expect("in the catalogue").facts();
    let [Steady::Changes { changed, parameter: 2, .. }] = debond.steady[..] else { panic!("a share") };
    let (with, state) = changed(&reference(), 0.3);
    assert_eq!(state, MechanicalState { bonds: Bonds::Opened, ..MechanicalState::NOMINAL });
    assert!(matches!(with.mechanics, Mechanics::Opening(opening) if opening.fraction == 0.3));

    let needs: Vec<(&str, Vec<&str>)> = CATALOGUE
        .iter()
        .chain(ON_REQUEST)
        .map(|m| (m.facts().id, m.columns()))
        .filter(|(_, columns)| !columns.is_empty())
        .collect();
    let of_humidity = needs.iter().find(|(id, _)| *id == "moisture").expect("it sees a column");
    assert_eq!(of_humidity.1, ["humidity_percent"]);
    assert!(needs.iter().flat_map(|(_, columns)| columns).all(|column| column.contains('_')), "{needs:?}");
    for id in ["debond", "unknown:racket", "tail-asymmetry"] {
        assert!(needs.iter().all(|(own, _)| *own != id));
    }
    for mechanism in CATALOGUE.iter().chain(ON_REQUEST) {
        let facts = mechanism.facts();
        let told = facts.inspection();
        match facts.naming {
            Naming::Named { inspection, .. } => assert!(told == Some(inspection) && inspection.len() > 10, "{}", facts.id),
            Naming::Described { .. } => assert_eq!(told, None, "{}", facts.id),
        }
    }
}

/// What decays with time does so from the record's first instant.
#[test]
fn exact_time_begins_with_the_record() {
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let (time, chamber) = course();
    let later: Vec<f64> = time.iter().map(|t| t + 5000.0).collect();
    let [now, then] = [&time, &later].map(|time| {
        let prepared = Prepared::new(&library, time, &chamber, 60.0).expect("prepared");
        let gyro = Gyro::new(library.clone(), CATALOGUE, vec![prepared]).expect("gyro");
        let active =
            Active { mechanism: gyro.find("unknown:moisture").expect("offered"), values: vec![0.3, 7200.0], choice: None };
        let u = diagnosis::expected(gyro.nuisances());
        let [with, without] = [&[active][..], &[]].map(|active| gyro.respond(0, &u, active).expect("response").swap_remove(RATE));
        minus(&with, &without)
    });
    assert!(rms(&minus(&now, &then)) < 1e-9 && (now[120] - 0.3 * (-1.0_f64).exp()).abs() < 1e-9, "{} {}", now[120], then[120]);
}

#[test]
fn a_path_of_heat_is_not_another_one() {
    let gyro = of_library(|_| ());
    let u = diagnosis::expected(gyro.nuisances());
    let at_work = |id: &str, value: f64| Active { mechanism: gyro.find(id).expect("offered"), values: vec![value], choice: None };
    let mounted = gyro.about(&u, &[at_work("axial-heat-path", 20.0)]).expect("a model").expect("another place");
    assert!(mounted.about(&u, &[at_work("axial-heat-path", 20.0)]).expect("a model").is_none());
    // another one, the same further along, and none
    assert!(mounted.about(&u, &[at_work("air-path", 1.3)]).expect("a model").is_some());
    assert!(mounted.about(&u, &[at_work("axial-heat-path", 60.0)]).expect("a model").is_some());
    assert!(mounted.about(&u, &[]).expect("a model").is_some());
}

#[test]
fn a_chamber_of_few_readings_is_bridged_and_read_twice() {
    let chamber = Chamber::recorded(&[0.0, 10.0, 30.0], &[5.0, f64::NAN, 8.0], None);
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let time = [0.0, 10.0, 20.0, 30.0];
    let read = |chamber: &Chamber| Prepared::under(&library, &time, chamber, 0.0).expect("prepared").chamber().to_vec();
    assert_eq!(read(&chamber), [5.0, 6.0, 7.0, 8.0]);
    // at instants of its own it has these
    assert_eq!(read(&chamber.at(&[0.0, 20.0, 30.0])), [5.0, 6.0, 7.0, 8.0]);
}
