//! Spread of a sensitivity by tolerances: the linear band against sampled designs, and its exact cases.

use crate::common::{changed, normal, reference};
use coil::{Design, FINE, MeshFineness, Model, Number, Parameter, Tolerance, Tolerances, sensitivity_band};
use winding::Tails;

const QUICK: MeshFineness = MeshFineness { order: 4, layers: 1, ratio: 0.2 };

fn total(design: &Design) -> f64 {
    Model::new(design, &QUICK).expect("model").sensitivity().expect("solve").total()
}

/// Designs within the tolerances, drawn from normal densities: two correlated, the others independent.
#[test]
fn sampled_designs_spread_as_the_band_says() {
    // with tails that may be longer and shorter
    let design = changed(|d| d.winding.tails = Tails { cw: 0.2, ccw: 0.2 });
    let (e_r, alpha_r) = (Number::Constant(Parameter::TransverseModulus), Number::Constant(Parameter::TransverseExpansion));
    for correlation in [0.0, 0.8, -0.8] {
        let correlations = if correlation == 0.0 { Vec::new() } else { vec![(alpha_r, e_r, correlation)] };
        let tolerances = Tolerances { given: Vec::new(), correlations };
        let band = sensitivity_band(&design, &tolerances).expect("a band");
        assert!((band.shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let numbers: Vec<Number> = band.changes.iter().map(|(number, _)| *number).filter(|n| *n != Number::Tail).collect();
        let factor = tolerances.correlation(&numbers).cholesky().expect("correlations").l();
        let mut seed = 7;
        let samples: Vec<f64> = (0..400)
            .map(|_| {
                let u = &factor * nalgebra::DVector::from_fn(numbers.len(), |_, _| normal(&mut seed));
                let put = |design: Design, (number, u): (&Number, &f64)| {
                    let drawn = number.of(&design).expect("a number");
                    number.set(&design, drawn + u * tolerances.sd(*number, &design).expect("a number"))
                };
                let mut changed = numbers.iter().zip(u.iter()).fold(design.clone(), put);
                let tail = tolerances.of(Number::Tail).of(0.0);
                changed.winding.tails.cw += tail * normal(&mut seed);
                changed.winding.tails.ccw += tail * normal(&mut seed);
                total(&changed)
            })
            .collect();
        let mean = samples.iter().sum::<f64>() / 400.0;
        let sd = (samples.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / 399.0).sqrt();
        // 400 samples tell a standard deviation to 3.5 % (1 sigma)
        assert!((sd / band.sd - 1.0).abs() < 0.1, "{correlation}: sampled {sd}, band {}", band.sd);
    }
}

#[test]
fn exact_a_band_is_as_wide_as_its_tolerance() {
    let design = reference();
    let only = |number: Number, tolerance: Tolerance| {
        let constants = Parameter::ALL.iter().map(|p| Number::Constant(*p));
        let all = constants.chain([Number::ThermoOptic, Number::Tail]).filter(|n| *n != number);
        let given = all.map(|n| (n, Tolerance::Exact)).chain([(number, tolerance)]).collect();
        sensitivity_band(&design, &Tolerances { given, correlations: Vec::new() }).expect("a band")
    };
    // strain is linear in an expansion
    let expansion = |share: f64| only(Number::Constant(Parameter::TransverseExpansion), Tolerance::Relative(share));
    assert_eq!((expansion(0.1).changes.len(), expansion(0.1).shares[0]), (1, 1.0));
    assert!((expansion(0.1).sd / expansion(0.01).sd - 10.0).abs() < 1e-6);
    assert!(expansion(0.1).sd > 1e-3 * total(&design).abs(), "{}", expansion(0.1).sd);
    assert_eq!(expansion(0.0).sd, 0.0);
    // one temperature throughout: no thermal phase between the halves, and nothing flows
    assert_eq!(only(Number::ThermoOptic, Tolerance::Relative(0.1)).changes, []);
    assert!((total(&Number::ThermoOptic.set(&design, 1e-5)) - total(&design)).abs() < 1e-9);
    assert_eq!(only(Number::Constant(Parameter::CoilConductivity), Tolerance::Relative(0.1)).changes, []);
}

/// Slopes on the mesh of the band against those on the fine one, to the per cent that is stated.
#[test]
fn the_mesh_is_good_to_a_per_cent_of_the_slopes() {
    let (design, tolerances) = (reference(), Tolerances::default());
    let band = sensitivity_band(&design, &tolerances).expect("a band");
    let fine = |design: &Design| Model::new(design, &FINE).expect("model").sensitivity().expect("solve").total();
    let largest: Vec<(Number, f64)> = band.changes.iter().filter(|(n, _)| *n != Number::Tail).take(4).copied().collect();
    assert_eq!(largest[0].0, Number::Constant(Parameter::TransverseModulus));
    for (number, change) in largest {
        let drawn = number.of(&design).expect("a number");
        let at = |sign: f64| fine(&number.set(&design, drawn + sign * tolerances.sd(number, &design).expect("a number")));
        let expected = (at(1.0) - at(-1.0)) / 2.0;
        assert!((change / expected - 1.0).abs() < 0.01, "{number:?}: {change} {expected}");
    }
}
