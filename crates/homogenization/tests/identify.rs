//! Identification: priors, what a posterior owes, and one cell found again from its noisy constants.

use homogenization::identify::literature::Kind;
use homogenization::identify::{Family, Prior, Random, RingPrior, Target, Uncertainty, identify};
use homogenization::{Role, homogenize};

/// A bare fibre in adhesive.
fn bare() -> Family {
    let silica = RingPrior {
        name: "silica".into(),
        outer_diameter: Prior::linear(124e-6, 126e-6),
        role: Role::Glass,
        material: Kind::Silica.prior(),
    };
    Family { name: "bare".into(), pitch: 170e-6, rings: vec![silica], adhesive: Kind::Adhesive.prior() }
}

#[test]
fn priors_hold_ninety_per_cent_and_come_back() {
    let mut random = Random::new(7);
    for prior in [Prior::log(0.5e6, 5e6), Prior::linear(-0.1, 0.4)] {
        let draws: Vec<f64> = (0..20_000).map(|_| prior.value(random.normal())).collect();
        let inside = draws.iter().filter(|x| prior.low < **x && **x < prior.high).count() as f64 / draws.len() as f64;
        assert!((inside - 0.9).abs() < 0.01, "{inside}");
        assert!(draws.iter().all(|x| (prior.value(prior.standard(*x)) / x - 1.0).abs() < 1e-9));
    }
}

#[test]
fn impossible_cells_are_none() {
    let family = bare();
    let names: Vec<_> = family.parameters().iter().map(|p| (p.phase.clone(), p.quantity)).collect();
    assert_eq!(names.len(), 9);
    let mut u = vec![0.0; 9];
    assert!(family.cell(&u).is_some());
    u[8] = 200.0; // wider than the pitch
    assert!(family.cell(&u).is_none());
    (u[8], u[4]) = (0.0, 4.0); // stiffer than three times the bulk modulus
    assert!(family.cell(&u).is_none());
    assert!(Target::new("m_rx", 0.03, Uncertainty::Normal(0.01)).is_none());
    let printed = Target::new("e_r", 95.2e6, Uncertainty::Rounded(0.05e6)).unwrap();
    assert_eq!(printed.name(), "e_r");
    assert!(printed.is_met(95.249e6) && !printed.is_met(95.251e6));
}

/// One of the synthetic cells of `cargo xtask identify`, smaller: 1 % noise on four constants, one printed to two digits.
#[test]
fn a_cell_is_found_again() {
    let family = bare();
    let mut random = Random::new(3);
    let truth = random.normals(9);
    let exact = homogenize(&family.cell(&truth).unwrap()).unwrap().constants;
    let mut measured = |name: &str, value: f64| {
        let sd = 0.01 * value.abs();
        Target::new(name, value + sd * random.normal(), Uncertainty::Normal(sd)).unwrap()
    };
    let targets = [
        measured("e_z", exact.e_z),
        measured("e_r", exact.e_r),
        measured("g_zr", exact.g_zr),
        measured("alpha_r", exact.alpha_r),
        Target::new("k_r", (exact.k_r * 100.0).round() / 100.0, Uncertainty::Rounded(0.005)).unwrap(),
    ];
    let found = identify(std::slice::from_ref(&family), &targets, 1, &|_| {}).unwrap();
    assert!(found.outcomes[0].explains());
    let posterior = found.posterior.unwrap();
    let wide = posterior.simultaneous(0.999);
    assert!(wide.iter().zip(&truth).all(|([low, high], u)| low < u && u < high), "{wide:?} {truth:?}");
    // along what the entries determine, where an interval may miss: the truth within 99.8 %, and little else
    for direction in posterior.directions.iter().take(posterior.rank()) {
        let along: f64 = truth.iter().zip(&direction.along).map(|(u, a)| u * a).sum();
        let [low, high] = posterior.interval_along(&direction.along, 0.998);
        let width = 2.0 * 3.09 * direction.shrinkage();
        assert!(high - low < 1.5 * width, "gain {}: {low} .. {high}, linearised {width}", direction.gain);
        assert!(low < along && along < high, "gain {}: {along} not in {low} .. {high}", direction.gain);
    }
    // five entries fix at most five combinations; the adhesive's modulus is among what they see, the glass's Poisson's ratio is not
    assert!((3..=5).contains(&posterior.rank()), "{}", posterior.rank());
    assert!(posterior.deviation(4) < 0.1 && posterior.deviation(1) > 0.9);
    assert!(posterior.emulator_error < 0.1 && posterior.acceptance > 0.4 && posterior.effective_draws > 100.0);
    // whatever is drawn rounds to the printed entry, but for the emulator's error
    for draw in posterior.draws.iter().step_by(90) {
        let k_r = homogenize(&family.cell(draw).unwrap()).unwrap().constants.k_r;
        assert!((k_r - targets[4].value).abs() < 0.0052, "{k_r} for {}", targets[4].value);
    }
    let alternatives = found.alternatives.unwrap();
    let [a, b] = &alternatives.sets;
    assert!(a.reproduces() && b.reproduces() && a.u.iter().zip(&b.u).any(|(a, b)| (a - b).abs() > 1.0));
    // both sets, solved anew
    for set in [a, b] {
        let again = homogenize(&set.cell).unwrap().constants;
        assert!((again.e_r / targets[1].value - 1.0).abs() < 0.03 && (again.k_r / targets[4].value - 1.0).abs() < 0.03);
    }
    assert!(alternatives.measurements[0].separation() > 2.0);
    // what is known of glass is not measured again, but for its diameter
    let of_glass: Vec<&str> =
        alternatives.measurements.iter().map(|m| m.what.as_str()).filter(|what| what.ends_with("silica")).collect();
    assert_eq!(of_glass, ["outer diameter (microscope) of the silica"]);
    assert!(alternatives.measurements.iter().any(|m| m.what == "Young's modulus of the adhesive"));
}
