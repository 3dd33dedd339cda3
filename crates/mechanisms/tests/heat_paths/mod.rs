//! Paths of heat: joints, the surroundings, mounts.

use coil::{Contact, Flange, Heater, Mount, Side};
use diagnosis::{Active, ForwardModel};
use mechanisms::{CATALOGUE, Gyro, RATE, SPOOL};

use super::common::{reference, spool};
use super::{agree, agrees, anew, gyro, minus, of, recorded, rms, shared, with_mechanism};

#[test]
fn heat_paths_follow_the_chain() {
    agrees("interface-resistance", &[1.3e-3], None, &[RATE, SPOOL]);
    agrees("air-path", &[1.17], None, &[RATE, SPOOL]);
    agrees("axial-heat-path", &[0.9], None, &[RATE, SPOOL]);
}

/// As far as physics goes: a joint that has come off, thin and heavy gas and a fan, a flange that hangs free and one that is screwed to metal.
#[test]
fn heat_paths_follow_the_chain_however_strong() {
    heat_paths(&[4e-2], &[0.2, 8.0], &[400.0]);
}

#[test]
#[ignore = "half a minute"]
fn heat_paths_follow_the_chain_at_every_strength() {
    heat_paths(&[1e-4, 1e-2], &[0.5, 3.0], &[0.1, 10.0, 45.0]);
}

fn heat_paths(resistances: &[f64], factors: &[f64], conductances: &[f64]) {
    let paths = [("interface-resistance", resistances), ("air-path", factors), ("axial-heat-path", conductances)];
    for (id, values) in paths {
        values.iter().for_each(|value| agrees(id, &[*value], None, &[RATE, SPOOL]));
    }
}

/// Constants act otherwise beside a strong path of heat than without it: the model is made about the path.
#[test]
fn constants_beside_a_strong_path_of_heat_follow_the_chain() {
    let design = reference();
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let active = Active { mechanism: gyro.find("axial-heat-path").expect("a mechanism"), values: vec![45.0], choice: None };
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let about = gyro.about(&middle, std::slice::from_ref(&active)).expect("a model").expect("another place");
    assert!(about.about(&middle, std::slice::from_ref(&active)).expect("a model").is_none());
    assert!(about.about(&middle, &[]).expect("a model").is_some());
    let mounted = gyro.extended(&design, &active).expect("a place");
    let exact_mounted = anew(&mounted);
    for (name, moved) in [
        ("conductivity of the surroundings", coil::Parameter::MediumConductivity),
        ("specific heat of the coil", coil::Parameter::CoilSpecificHeat),
    ] {
        let mut u = middle.clone();
        let place = gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a place");
        let factor = gyro.nuisances()[place].parameter.prior.value(1.0);
        u[place] = factor;
        let of = |model: &Gyro, active: &[Active]| {
            minus(
                &model.respond(0, &u, active).expect("response")[RATE],
                &model.respond(0, &middle, active).expect("response")[RATE],
            )
        };
        let value = moved.of(&mounted).expect("it has one");
        let effect = minus(&anew(&moved.set(&mounted, factor * value))[RATE], &exact_mounted[RATE]);
        let off = |told: &[f64]| rms(&minus(told, &effect)) / rms(&effect);
        let (here, added) = (off(&of(&about, std::slice::from_ref(&active))), off(&of(&gyro, std::slice::from_ref(&active))));
        // what is made about the drawing adds effects, each as if the other were not there
        assert!(here < 0.05 && added > 4.0 * here, "{name}: off by {here:.3}, and by {added:.3} where effects are added");
    }
    // a hypothesis without the path has it taken away
    let [without, nominal] = [&about, &*gyro].map(|model| model.respond(0, &middle, &[]).expect("response"));
    let effect = minus(&exact_mounted[RATE], &nominal[RATE]);
    assert!(rms(&minus(&without[RATE], &nominal[RATE])) < 1e-6 * rms(&effect));
}

/// Every flange may be mounted, heated and open, not the first alone.
#[test]
fn heat_paths_of_a_second_flange_follow_the_chain() {
    let mut design = reference();
    let flanges = &mut spool(&mut design).flanges;
    // no bond that could open: fewer models
    flanges[0].contact = Contact::Gap;
    flanges.push(Flange { side: Side::Left, thickness: 1.5 * flanges[0].thickness, ..flanges[0] });
    let gyro = of(shared::library(&design, CATALOGUE, &|_| ()), CATALOGUE);
    let nominal = anew(&design);
    let mut warmed = Vec::new();
    for (flange, side) in [(1.0, Side::Right), (2.0, Side::Left)] {
        let (changed, responses) = with_mechanism(&gyro, &design, "axial-heat-path", &[0.9], Some(flange));
        assert_eq!(changed.heat.mounts, [Mount { side, conductance: 0.9 }]);
        agree(&format!("mount of flange {flange}"), &responses, &anew(&changed), &nominal, &[RATE, SPOOL]);
        let (changed, [cold, hot]) = with_mechanism(&gyro, &design, "self-heating", &[0.2, 60.0], Some(flange));
        assert_eq!(changed.heat.heaters, [Heater { side, power: 0.2 }]);
        warmed.push(minus(&hot[RATE], &cold[RATE]));
    }
    // a model about the one mount, and a hypothesis of the other: the first is taken away
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let mechanism = gyro.find("axial-heat-path").expect("offered");
    let [right, left] = [1.0, 2.0].map(|flange| Active { mechanism, values: vec![0.9], choice: Some(flange) });
    let about = gyro.about(&middle, &[right]).expect("a model").expect("another place");
    let rate = |model: &Gyro, active: &[Active]| model.respond(0, &middle, active).expect("response").swap_remove(RATE);
    let [told, here] = [&about, &gyro].map(|model| rate(model, std::slice::from_ref(&left)));
    let [off, effect] = [&told, &rate(&gyro, &[])].map(|other| rms(&minus(other, &here)));
    assert!(off < 0.1 * effect, "{off} of {effect}");
    // a quadrupole feels heat from the left as it feels heat from the right, the other way round; the flanges are not alike
    let [right, left] = &warmed[..] else { panic!("two flanges") };
    assert!(rms(&minus(right, left)) > 0.1 * rms(right), "{} {}", rms(right), rms(left));
    assert!(gyro.find("debond").is_none());
    let choice = |id: &str| gyro.mechanisms()[gyro.find(id).expect("offered")].choice.clone();
    for id in ["axial-heat-path", "self-heating"] {
        assert_eq!(choice(id), Some(("flange".to_owned(), vec![1.0, 2.0])));
    }
}

/// Far from the drawing, beside constants that are off, too: a mount does nearly the same from one side.
#[test]
fn surroundings_that_conduct_four_times_as_well_are_named() {
    is_named("air-path", 4.0, &[("specific heat of the coil", 0.9), ("k_r", -1.0), ("E_r and G", -0.8), ("alpha_r", 0.8)]);
}

/// Near the drawing surroundings that conduct better within their tolerance do nearly the same, and hide it.
#[test]
fn a_flange_that_is_coupled_is_named() {
    is_named(
        "axial-heat-path",
        5.0,
        &[("margin [mm]", -0.7), ("k_r", 0.8), ("conductivity of the surroundings", 0.3), ("alpha_r", 0.4)],
    );
}

/// A unit with one path of heat and constants off by so many deviations: that path is named, and its interval holds the value.
fn is_named(id: &str, value: f64, off: &[(&str, f64)]) {
    let library = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner).library().clone();
    let known = ["air-path", "axial-heat-path", "interface-resistance"].map(|id| mechanisms::find(id).expect("in the catalogue"));
    let gyro = of(library, &known);
    let own = gyro.find(id).expect("offered");
    let deviation = |name: &str| off.iter().find(|(own, _)| *own == name).map_or(0.0, |(_, deviations)| *deviations);
    let u: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(deviation(&n.parameter.name))).collect();
    let active = Active { mechanism: own, values: vec![value], choice: None };
    let unit = gyro.about(&u, std::slice::from_ref(&active)).expect("a model").expect("another place");
    let record = recorded(&unit, &u, &[active]);
    let settled = diagnosis::settled(&gyro, &[0], std::slice::from_ref(&record), &|_| ()).expect("a model");
    let about = settled.model.as_ref().unwrap_or(&gyro);
    let found = diagnosis::diagnose(about, &[0], &[record], &diagnosis::Settings::default(), &|_| ()).expect("diagnosis");
    assert_eq!((found.verdict, &found.set[..]), (diagnosis::Verdict::Explained, &[own][..]));
    let estimate = &found.parameters[0][0];
    assert!((estimate.ci90[0]..estimate.ci90[1]).contains(&value), "{estimate:?}");
}

/// A mount of the drawing may couple better or worse than drawn; where it is drawn, none is sought besides.
#[test]
fn a_drawn_mount_follows_the_chain() {
    let mut design = reference();
    let side = spool(&mut design).flanges[0].side;
    design.heat.mounts.push(Mount { side, conductance: 20.0 });
    let known = ["axial-heat-path", "mount-conductance"].map(|id| mechanisms::find(id).expect("in the catalogue"));
    let gyro = of(shared::library(&design, &known, &|_| ()), &known);
    assert!(gyro.find("axial-heat-path").is_none());
    let nominal = anew(&design);
    for factor in [0.2, 1.1, 6.0] {
        let (changed, responses) = with_mechanism(&gyro, &design, "mount-conductance", &[factor], None);
        assert_eq!(changed.heat.mounts, [Mount { conductance: 20.0 * factor, ..design.heat.mounts[0] }]);
        agree(&format!("mount {factor}"), &responses, &anew(&changed), &nominal, &[RATE, SPOOL]);
    }
    // beside a model made about the mount as it is, another hypothesis has it as drawn
    let middle: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let active = Active { mechanism: gyro.find("mount-conductance").expect("offered"), values: vec![6.0], choice: None };
    let about = gyro.about(&middle, std::slice::from_ref(&active)).expect("a model").expect("another place");
    let of = |model: &Gyro, active: &[Active]| model.respond(0, &middle, active).expect("response").swap_remove(RATE);
    let [drawn, without, with] = [of(&gyro, &[]), of(&about, &[]), of(&gyro, &[active])];
    let [off, effect] = [&without, &with].map(|other| rms(&minus(other, &drawn)));
    assert!(off < 1e-3 * effect, "{off:e} of {effect:e}");
}

const AIR: &str = "conductivity of the surroundings";

/// Temperatures stay where all conductivities and heat capacities change alike: so they do by the model, by however much, though a path of heat follows one
/// of these constants and the others are linear. Else intervals of all of them come out too narrow.
#[test]
fn exact_what_conducts_and_what_stores_change_alike_without_a_trace() {
    let alike = [
        "k_r",
        "specific heat of the coil",
        "spool conductivity",
        "spool specific heat",
        AIR,
        "specific heat of the surroundings",
    ];
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let place = |name: &str| gyro.nuisances().iter().position(|n| n.parameter.name == name).expect("a constant");
    let mut here: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let change = |here: &[f64], names: &[&str], by: f64| {
        let [low, high] = [1.0 - by, 1.0 + by].map(|factor| {
            let mut u = here.to_vec();
            names.iter().for_each(|name| u[place(name)] *= factor);
            gyro.respond(0, &u, &[]).expect("response").swap_remove(SPOOL)
        });
        rms(&minus(&high, &low))
    };
    // where the model is made, all together by a percent and by many
    for by in [1e-3, 0.01, 0.05] {
        let [all, one] = [change(&here, &alike, by), change(&here, &[AIR], by)];
        assert!(all < 1e-3 * one, "by {by}: {all:e} of {one:e}");
    }
    here[place(AIR)] *= 1.008;
    let [all, one] = [change(&here, &alike, 1e-3), change(&here, &[AIR], 1e-3)];
    assert!(all < 1e-3 * one, "{all:e} of {one:e}");
}

/// A gap that is wider, of a medium that conducts better, leaves the temperatures nearly as they are, as far as its tolerance goes and beside any factor:
/// no record tells the two apart, and what the model made of them would be taken for knowledge.
#[test]
fn a_wider_gap_that_conducts_better_follows_the_chain() {
    const FACTOR: f64 = 2.9;
    const MORE: f64 = 1.04;
    const WIDER: f64 = 1.06;
    let gyro = gyro().lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    let mechanism = gyro.find("air-path").expect("offered");
    let air = |factor: f64| [Active { mechanism, values: vec![factor], choice: None }];
    let place = gyro.nuisances().iter().position(|n| n.parameter.name == "margin [mm]").expect("a constant");
    let drawn: Vec<f64> = gyro.nuisances().iter().map(|n| n.parameter.prior.value(0.0)).collect();
    let about = gyro.about(&drawn, &air(FACTOR)).expect("a model").expect("another place");
    let told = |more: f64, wider: f64| {
        let mut u = drawn.clone();
        u[place] *= wider;
        about.respond(0, &u, &air(FACTOR * more)).expect("response")
    };
    let exact = |more: f64, wider: f64| {
        let mut design = reference();
        design.surroundings.conductivity *= FACTOR * more;
        design.surroundings.margin *= wider;
        anew(&design)
    };
    let (told_here, exact_here) = (told(1.0, 1.0), exact(1.0, 1.0));
    let (told_both, exact_both, exact_one) = (told(MORE, WIDER), exact(MORE, WIDER), exact(MORE, 1.0));
    for channel in [SPOOL, RATE] {
        let change = |of: &[Vec<f64>], from: &[Vec<f64>]| minus(&of[channel], &from[channel]);
        let one = rms(&change(&exact_one, &exact_here));
        let both = change(&exact_both, &exact_here);
        assert!(rms(&both) < 0.1 * one, "{} of {one}", rms(&both));
        let off = rms(&minus(&change(&told_both, &told_here), &both));
        assert!(off < 0.01 * one, "{off} of {one}");
    }
}

/// A film as the mechanism words it, in place of still air: of what the factor does it leaves little, and is not the same.
#[test]
fn air_that_conducts_better_imitates_the_film_that_it_names() {
    const FACTOR: f64 = 2.9;
    let path = mechanisms::find("air-path").and_then(|own| own.facts().heat_path).expect("a path of heat");
    let drawing = reference();
    let said = path.imitates.expect("a film")(&drawing, FACTOR);
    let film = said.split_once("heat.film_w_per_m2k: Some(").and_then(|(_, of)| of.strip_suffix(')')?.parse().ok());
    let (mut moving, mut still) = (drawing.clone(), drawing.clone());
    moving.heat.film = film;
    still.surroundings.conductivity *= FACTOR;
    assert!(film.is_some(), "{said}");
    let [drawn, moving, still] = [&drawing, &moving, &still].map(anew);
    let [off, effect] = [&moving, &drawn].map(|other| rms(&minus(&still[SPOOL], &other[SPOOL])));
    assert!(off < 0.2 * effect && off > 1e-3 * effect, "{off} of {effect}");
}
