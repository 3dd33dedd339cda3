//! The parametric model: exact properties, the full chain at points of the box, its error estimate, its derivatives.

use crate::common::{QUICK, random, reference};
use coil::{
    Contact, Design, Drive, Dynamics, Error, Fidelity, Flange, MechanicalState, Mechanics, ModelEffort, Opening, Parameter,
    ParametricModel, Profile, Range, Reduced, Side, Steps,
};
use std::sync::OnceLock;
use winding::LayerDefect;

/// Usual tolerances, and what may be wrong besides.
fn ranges(design: &Design) -> Vec<Range> {
    let mut ranges = Range::usual(design);
    let k = design.surroundings.conductivity;
    let wrong = [
        (Parameter::MediumConductivity, 0.4 * k, 2.5 * k),
        (Parameter::HubResistance, 0.0, 1e-2),
        (Parameter::FlangeResistance(Side::Right), 0.0, 1e-2),
        (Parameter::Mount(Side::Right), 0.0, 20.0),
        (Parameter::Heater(Side::Right), 0.0, 1.0),
    ];
    ranges.retain(|range| wrong.iter().all(|(parameter, ..)| *parameter != range.parameter));
    ranges.extend(wrong.map(|(parameter, low, high)| Range { parameter, low, high }));
    ranges
}

fn model() -> &'static ParametricModel {
    static MODEL: OnceLock<ParametricModel> = OnceLock::new();
    MODEL.get_or_init(|| modelled(&reference()))
}

fn modelled(design: &Design) -> ParametricModel {
    ParametricModel::new(design, &ranges(design), &QUICK.resolution, &ModelEffort::default(), &|| ()).expect("model")
}

/// A design at a random point of the box, heaters left out.
fn somewhere(design: &Design, ranges: &[Range], seed: &mut u64) -> Design {
    // the winding's ends come last, so that all other numbers are those of a box without them
    let (ends, others): (Vec<&Range>, Vec<&Range>) = ranges
        .iter()
        .filter(|range| !matches!(range.parameter, Parameter::Heater(_)))
        .partition(|range| range.parameter.of_winding());
    others.into_iter().chain(ends).fold(design.clone(), |design, range| {
        // room for differences
        let share = 0.02 + 0.96 * random(seed);
        range.parameter.set(&design, range.at(share))
    })
}

/// Ten hours with ramps, a soak and a ripple.
fn profile() -> Profile {
    let time: Vec<f64> = (0..600).map(|k| 60.0 * f64::from(k)).collect();
    let chamber = |t: &f64| 20.0 + 30.0 * (t / 3000.0).sin().tanh() + 5.0 * (t / 700.0).sin();
    Profile { drives: vec![time.iter().map(chamber).collect()], time }
}

/// Thermometer [K] and total bias [rad/s] in every row after the first.
fn courses(reduced: &Reduced, profile: &Profile) -> [Vec<f64>; 2] {
    let mut steps: Steps = reduced.steps(&profile.time, &profile.drives, &[profile.drives[0][0]]);
    let phase = |steps: &Steps| reduced.parts().iter().map(|part| part.of(steps.state())).sum::<f64>();
    let (mut before, mut rows) = (phase(&steps), [Vec::new(), Vec::new()]);
    while let Some(step) = steps.next() {
        let now = phase(&steps);
        rows[0].push(reduced.thermometer().of(steps.state()));
        rows[1].push((now - before) / step.dt);
        before = now;
    }
    rows
}

fn full(design: &Design, profile: &Profile) -> [Vec<f64>; 2] {
    let fidelity = Fidelity { modes: 60, ..QUICK };
    let rows = Dynamics::new(design, &[Drive::Chamber], &fidelity).expect("model").simulate(profile).expect("rows");
    [rows[1..].iter().map(|row| row.sensor).collect(), rows[1..].iter().map(|row| row.bias.total()).collect()]
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn largest(a: &[f64]) -> f64 {
    a.iter().map(|a| a.abs()).fold(0.0, f64::max)
}

fn at(model: &ParametricModel, design: &Design) -> Reduced {
    model.at(design).expect("a design of the box")
}

/// At random points of the box the bias is within 1e-3 of the change that the point makes, or 1e-4 of the peak.
fn holds(model: &ParametricModel, points: usize, seed: &mut u64) {
    let profile = profile();
    let nominal = full(model.design(), &profile);
    for point in 0..points {
        let design = somewhere(model.design(), model.ranges(), seed);
        assert_eq!(model.outside(&design), None);
        let left_out = model.left_out(&design).expect("a design of the box");
        assert!(left_out < 1e-6, "point {point}: {left_out:e}");
        let (ours, theirs) = (courses(&at(model, &design), &profile), full(&design, &profile));
        for (of, what) in ["thermometer", "bias"].into_iter().enumerate() {
            let (error, effect) = (distance(&ours[of], &theirs[of]), distance(&theirs[of], &nominal[of]));
            let allowed = (1e-3 * effect).max(1e-4 * largest(&theirs[of]));
            assert!(error < allowed, "point {point}, {what}: off by {error:.1e}, the change is {effect:.1e}");
        }
    }
}

#[test]
fn the_full_chain_at_points_of_the_box() {
    holds(model(), 6, &mut 42);
}

#[test]
fn the_full_chain_of_other_designs() {
    let mut without_flange = reference();
    crate::common::spool(&mut without_flange).flanges.clear();
    let mut with_two = reference();
    let gap = Flange { side: Side::Left, thickness: 3e-3, overhang: 1e-3, contact: Contact::Gap };
    crate::common::spool(&mut with_two).flanges.push(gap);
    let mut free = reference();
    free.spool = None;
    free.sensor.radius = 45e-3;
    let mut in_film = reference();
    in_film.heat.film = Some(8.0);
    let mut loose_in_film = in_film.clone();
    crate::common::spool(&mut loose_in_film).flanges[0].contact = Contact::Gap;
    for design in [without_flange, with_two, free, in_film, loose_in_film] {
        let model = modelled(&design);
        holds(&model, 2, &mut 7);
        heaters_settle(&model);
    }
}

#[test]
fn the_few_modes_of_a_design_respond_as_all_of_them_do() {
    let (model, profile) = (model(), profile());
    const FOLLOWED: u64 = 5;
    for (first, heated) in (1..=8).flat_map(|seed| [(seed, 0.0), (seed, 0.5)]) {
        let mut seed = first;
        let design = Parameter::Heater(Side::Right).set(&somewhere(&reference(), model.ranges(), &mut seed), heated);
        let (few, all) = (at(model, &design), model.slopes(&design, &[]).expect("a design of the box").reduced().clone());
        assert!(2 * few.rates().len() < all.rates().len());
        let drives: Vec<Vec<f64>> =
            [profile.drives[0].clone(), vec![1.0; profile.time.len()]].into_iter().take(1 + usize::from(heated > 0.0)).collect();
        // from rest; and at one design after a jump by 20 K, which drives every mode: at others fast modes leave out up to 5e-5
        for (rest, within) in [(drives[0][0], 2e-6), (0.0, 2e-5)].into_iter().take(1 + usize::from(first == FOLLOWED)) {
            let run = |reduced: &Reduced| reduced.run(&profile.time, &drives, &[rest, 0.0]);
            let (few, all) = (run(&few), run(&all));
            let off = distance(&few.thermometer, &all.thermometer);
            assert!(off < 2e-4, "{off} K");
            for (few, all) in few.parts[0].iter().zip(&all.parts[0]) {
                assert!(distance(few, all) < within * largest(all), "{:e} of {:e}", distance(few, all), largest(all));
            }
        }
    }
}

#[test]
fn exact_conductivities_and_capacities_in_proportion_change_nothing() {
    let (model, profile) = (model(), profile());
    let mut scaled = reference();
    scaled.body.conductivity_r *= 1.05;
    scaled.body.specific_heat *= 1.05;
    scaled.surroundings.conductivity *= 1.05;
    scaled.surroundings.specific_heat *= 1.05;
    let material = &mut crate::common::spool(&mut scaled).material;
    material.conductivity *= 1.05;
    material.specific_heat *= 1.05;
    let [a, b] = [reference(), scaled].map(|design| courses(&at(model, &design), &profile));
    let off = [0, 1].map(|k| distance(&a[k], &b[k]) / largest(&a[k]));
    assert!(off.iter().all(|off| *off < 1e-7), "{off:?}");
}

#[test]
fn exact_a_steady_ramp_has_the_sensitivity_of_the_mechanics_alone() {
    // in a ramp that lasts, every place warms at the chamber's rate: at rest, the parts are the operator's sums
    let model = model();
    let design = somewhere(model.design(), model.ranges(), &mut 3);
    let mechanics = coil::Model::new(&design, &QUICK.resolution).unwrap().bias_in_ramp().unwrap();
    let reduced = model.at(&design).unwrap();
    let ramp = Profile { time: vec![0.0, 1e6, 1e6 + 60.0], drives: vec![vec![0.0, 1e4, 1e4 + 0.6]] };
    let bias = courses(&reduced, &ramp)[1][1] / 0.01;
    assert!((bias / mechanics.total() - 1.0).abs() < 2e-4, "{bias:e} against {:e}", mechanics.total());
}

#[test]
fn a_design_beyond_the_box_or_with_other_parts_is_noticed() {
    let model = model();
    let hot = Parameter::CoilConductivity.set(&reference(), 1.0);
    assert_eq!(model.outside(&hot), Some((Parameter::CoilConductivity, 1.0)));
    let wider = model.including(&hot, &|| ()).expect("model");
    assert_eq!(wider.outside(&hot), None);
    assert!(matches!(model.at(&hot), Err(Error::Design { .. })));
    let (ours, theirs) = (courses(&at(&wider, &hot), &profile()), full(&hot, &profile()));
    let off = distance(&ours[1], &theirs[1]) / largest(&theirs[1]);
    assert!(off < 5e-4, "{off:e}");
    let mut open = reference();
    open.mechanics = Mechanics::Opening(Opening { side: Side::Right, below: 0.0, hysteresis: 1.0, fraction: 0.3 });
    let mut rewound = reference();
    rewound.winding.defect = Some(LayerDefect { layer: 3, turns: 1 });
    let mut unlike = reference();
    crate::common::spool(&mut unlike).hub_thickness = f64::NAN;
    for design in [open, rewound, unlike] {
        assert!(matches!(model.at(&design), Err(Error::Design { .. })));
        assert!(matches!(model.slopes(&design, &[]), Err(Error::Design { .. })));
    }
    let mut without_flange = reference();
    crate::common::spool(&mut without_flange).flanges.clear();
    assert!(matches!(model.at(&without_flange), Err(Error::Design { .. })));
    let mut larger = reference();
    larger.body.outer_radius += 1e-4;
    assert!(matches!(model.at(&larger), Err(Error::Design { .. })));
}

#[test]
fn the_distance_to_a_coarser_model_covers_the_error() {
    let (model, profile) = (model(), profile());
    let mut seed = 11;
    let mut ratios = Vec::new();
    for point in 0..6 {
        let design = somewhere(model.design(), model.ranges(), &mut seed);
        let (ours, theirs) = (courses(&at(model, &design), &profile), full(&design, &profile));
        let apart = model.coarser(&design).unwrap().map(|coarser| distance(&ours[1], &courses(&coarser, &profile)[1]));
        let (stated, error) = (coil::MODEL_SAFETY * apart[0].max(apart[1]), distance(&ours[1], &theirs[1]));
        assert!(stated > error, "point {point}: states {stated:.1e}, is off by {error:.1e}");
        ratios.push(stated / error);
    }
    ratios.sort_by(f64::total_cmp);
    assert!(ratios[ratios.len() / 2] < 30.0, "{ratios:?}");
}

#[test]
fn derivatives_are_those_of_differences() {
    let model = model();
    let design = Parameter::Mount(Side::Right).set(&somewhere(model.design(), model.ranges(), &mut 5), 3.0);
    derivatives(model, &design);
    // with a second drive, of which the heater's power is a parameter
    derivatives(model, &Parameter::Heater(Side::Right).set(&design, 0.4));
}

fn derivatives(model: &ParametricModel, design: &Design) {
    let mut profile = profile();
    profile.drives.push(profile.time.iter().map(|t| 1.0 + (t / 5000.0).sin()).collect());
    let heated = !design.heat.heaters.is_empty();
    profile.drives.truncate(1 + usize::from(heated));
    let off = |range: &&Range| matches!(range.parameter, Parameter::Heater(_)) && !heated;
    let free: Vec<&Range> = model.ranges().iter().filter(|range| !off(range)).collect();
    let parameters: Vec<Parameter> = free.iter().map(|range| range.parameter).collect();
    let slopes = model.slopes(design, &parameters).expect("a design of the box");
    let rest = [profile.drives[0][0], 0.0];
    let all = slopes.run(&profile.time, &profile.drives, &rest);
    let flat = |outputs: &coil::Outputs<Vec<f64>>| -> Vec<Vec<f64>> {
        [&outputs.thermometer, &outputs.coil_mean].into_iter().chain(&outputs.parts[0]).cloned().collect()
    };
    let at =
        |design: &Design| flat(&model.slopes(design, &[]).expect("inside").run(&profile.time, &profile.drives, &rest).outputs);
    for (k, Range { parameter, low, high }) in free.into_iter().enumerate() {
        let value = parameter.of(design).expect("a number of it");
        let [first, last] = design.winding.reach();
        let by = match parameter {
            // strain jumps from element to element: over as much as the model itself
            Parameter::WindingStart => (0.1 * design.winding.pitch).min(first / 2.0),
            Parameter::WindingEnd => (0.1 * design.winding.pitch).min((design.body.height - last) / 2.0),
            _ => 1e-3 * value.min(high - low),
        };
        let [low, high] = [-by, by].map(|by| at(&parameter.set(design, value + by)));
        for (o, slope) in flat(&all.slopes[k]).iter().enumerate() {
            let difference: Vec<f64> = high[o].iter().zip(&low[o]).map(|(h, l)| (h - l) / (2.0 * by)).collect();
            // what differences lose of an output that the parameter hardly moves
            let rounding = 1e-9 * largest(&high[o]) / by;
            let off = distance(slope, &difference);
            assert!(
                off < 2e-5 * largest(&difference) + rounding,
                "{parameter:?}, output {o}: {off:.1e} of {:.1e}",
                largest(&difference)
            );
        }
    }
}

#[test]
fn the_full_chain_of_a_stiffer_and_a_softer_state() {
    let model = model();
    let profile = profile();
    for transverse_modulus in [0.15, 0.5, 2.2] {
        let state = MechanicalState { transverse_modulus, ..MechanicalState::NOMINAL };
        let ours = courses(&model.in_states(&reference(), &[state]).expect("a state"), &profile);
        let mut changed = reference();
        changed.body.elastic.e_r *= transverse_modulus;
        changed.body.elastic.g_zr *= transverse_modulus;
        let theirs = full(&changed, &profile);
        let off = distance(&ours[1], &theirs[1]) / largest(&theirs[1]);
        assert!(off < 3e-4, "{transverse_modulus}: {off:e}");
    }
}

#[test]
fn exact_heaters_add_up_and_settle_at_what_conduction_carries() {
    heaters_settle(model());
}

/// In the flange at the right, or in the hub of a spool that has none there.
fn heaters_settle(model: &ParametricModel) {
    if model.design().spool.is_none() {
        return;
    }
    let with = |power: f64| Parameter::Heater(Side::Right).set(model.design(), power);
    let heated = |power: f64| {
        let design = with(power);
        let reduced = at(model, &design);
        let profile = Profile { time: vec![0.0, 1e7], drives: vec![vec![0.0; 2], vec![1.0; 2]] };
        let mut steps = reduced.steps(&profile.time, &profile.drives, &[0.0, 0.0]);
        steps.next();
        reduced.thermometer().of(steps.state())
    };
    let dynamics = Dynamics::new(&with(1.0), &[Drive::Chamber, Drive::Heaters], &QUICK).expect("model");
    let steady =
        dynamics.simulate(&Profile { time: vec![0.0, 1e7], drives: vec![vec![0.0; 2], vec![1.0; 2]] }).expect("rows")[1].sensor;
    assert!((heated(1.0) / steady - 1.0).abs() < 1e-4, "{} against {steady}", heated(1.0));
    assert!((heated(0.5) / heated(1.0) - 0.5).abs() < 1e-9);
}

/// A wide tolerance keeps half of a length below, and all of its reach above.
#[test]
fn a_wide_tolerance_of_a_length_reaches_three_deviations_up() {
    let design = crate::common::reference();
    let drawn = Parameter::Margin.of(&design).unwrap();
    let margin = (coil::Number::Constant(Parameter::Margin), coil::Tolerance::Absolute(0.4 * drawn));
    let tolerances = coil::Tolerances { given: vec![margin], ..coil::Tolerances::default() };
    let ranges = Range::tolerated(&design, &tolerances);
    let range = ranges.iter().find(|range| range.parameter == Parameter::Margin).unwrap();
    assert!((range.low / drawn - 0.5).abs() < 1e-12 && (range.high / drawn - 2.2).abs() < 1e-12, "{range:?} of {drawn}");
}
