//! Multipoles against finite elements, which share nothing with them but the constituents; reduced integration against full.

use crate::common::{glass, on, reference, solid, two_phase};
use homogenization::identify::Random;
use homogenization::{
    Constants, Constituent, Error, Extent, FibreCell, Homogenized, Integration, Packing, Ring, Role, TOLERANCE, effective,
    effective_with, homogenize_to, multipoles,
};

const PACKINGS: [Packing; 2] = [Packing::Hexagonal, Packing::Square];

fn cells() -> impl Iterator<Item = FibreCell> {
    crate::common::cells().flat_map(|cell| PACKINGS.map(|packing| FibreCell { packing, ..cell.clone() }))
}

/// Largest relative distance of a constant.
fn distance(a: &Constants, b: &Constants) -> f64 {
    a.combine(b, |a, b| (a / b - 1.0).abs()).named().into_iter().fold(0.0, |m, (_, d)| m.max(d))
}

/// Every entry, not the constants alone: stiffness, thermal stress, conductivity, strain of the glass.
#[test]
fn exact_finite_elements_converge_to_the_multipoles() {
    for cell in cells() {
        let (a, b) = (multipoles(&cell, 81).unwrap(), effective(&cell, &on(&cell, 12, Extent::Quarter)).unwrap());
        assert!((a.stiffness - b.stiffness).amax() < 1e-10 * b.stiffness.amax());
        assert!((a.thermal_stress - b.thermal_stress).amax() < 1e-10 * b.thermal_stress.amax());
        assert!((a.conductivity - b.conductivity).amax() < 1e-9 * b.conductivity.amax());
        assert!((a.glass_strain - b.glass_strain).amax() < 1e-9);
        assert!((a.conductivity_z / b.conductivity_z - 1.0).abs() < 1e-10);
        for (a, b) in [(4, 4), (5, 5)].map(|i| (a.stiffness[i], b.stiffness[i])) {
            assert!((a / b - 1.0).abs() < 1e-8, "{a} against {b}");
        }
        assert!(distance(&a.constants().unwrap(), &b.constants().unwrap()) < 1e-8);
    }
}

/// The quarter and the whole of the square cell say the same; neither is isotropic across the fibre.
#[test]
fn symmetry_square_packing_is_tetragonal() {
    for cell in cells().filter(|cell| cell.packing == Packing::Square) {
        let [whole, quarter] = [Extent::Whole, Extent::Quarter].map(|extent| effective(&cell, &on(&cell, 5, extent)).unwrap());
        assert!((whole.stiffness - quarter.stiffness).amax() < 1e-10 * whole.stiffness.amax());
        assert!((whole.glass_strain - quarter.glass_strain).amax() < 1e-9);
        let [axes, diagonal] = quarter.shear_moduli_across();
        assert!((diagonal / axes - 1.0).abs() > 0.05, "{axes} along the axes, {diagonal} at 45 degrees");
        assert!((quarter.stiffness[(0, 0)] / quarter.stiffness[(1, 1)] - 1.0).abs() < 1e-8);
    }
    let [axes, diagonal] = multipoles(&reference(), 61).unwrap().shear_moduli_across();
    assert!((diagonal / axes - 1.0).abs() < 1e-9, "hexagonal packing is isotropic: {axes}, {diagonal}");
}

/// A lattice of fibres of the adhesive's own material is that material; rings of one material are one ring.
#[test]
fn exact_trivial_cells() {
    for packing in PACKINGS {
        let m = solid(870e6, 0.4118, 102.75e-6, 0.30);
        let c = homogenize_to(&FibreCell { packing, ..two_phase(m, m) }, 1e-8).unwrap().constants;
        for (found, exact) in
            [(c.e_z, 870e6), (c.e_r, 870e6), (c.nu_r, 0.4118), (c.alpha_r, 102.75e-6), (c.k_r, 0.3), (c.m_rx, 0.5)]
        {
            assert!((found / exact - 1.0).abs() < 1e-12, "{found} against {exact}");
        }
    }
    for cell in cells() {
        let mut split = cell.clone();
        for (i, ring) in cell.rings.iter().enumerate() {
            split.rings.insert(2 * i, Ring { outer_radius: ring.outer_radius * 0.99, ..*ring });
        }
        let [a, b] = [&cell, &split].map(|cell| multipoles(cell, 61).unwrap().constants().unwrap());
        assert!(distance(&a, &b) < 5e-12, "{:e}", distance(&a, &b));
    }
}

/// From a fat film to one of 0.1 µm, compressible to four nines, any tolerance: the estimate holds against twice the order, the tolerance
/// is met, and not by working to rounding always.
#[test]
fn bounds_estimates_cover_the_error_and_meet_the_tolerance() {
    let film = |pitch: f64| FibreCell { pitch, ..reference() };
    let mut soft = film(170e-6);
    soft.adhesive = solid(5.6e6, 0.49999, 250e-6, 0.45);
    soft.rings[1].constituent = solid(2e6, 0.49999, 250e-6, 0.15);
    let mut crowd: Vec<FibreCell> = cells().chain([film(166e-6), film(165.1e-6), soft]).collect();
    crowd.extend(PACKINGS.map(|packing| FibreCell { packing, ..two_phase(solid(400e9, 0.2, 1e-6, 400.0), glass()) }));
    for cell in crowd {
        let exact = multipoles(&cell, 401).unwrap().constants().unwrap();
        let mut orders = Vec::new();
        for tolerance in [1e-3, 1e-6, 1e-9] {
            let result = homogenize_to(&cell, tolerance).unwrap();
            orders.push(result.unknowns);
            let errors = result.constants.combine(&exact, |a, b| (a / b - 1.0).abs()).named();
            for ((name, error), (_, estimate)) in errors.into_iter().zip(result.relative_error.named()) {
                assert!(
                    error <= estimate && estimate <= tolerance,
                    "{name}: {error:e}, estimated {estimate:e}, asked {tolerance:e}"
                );
            }
        }
        assert!(orders[0] < orders[2], "{orders:?}");
    }
}

/// A cell of one to four rings of anything: moduli over nine decades, Poisson's ratio to six nines, a film from 1 % of the pitch on.
fn anything(random: &mut Random) -> FibreCell {
    let mut log = |low: f64, high: f64| low * (high / low).powf(random.uniform());
    let material = |log: &mut dyn FnMut(f64, f64) -> f64| {
        let poisson_ratio = if log(1.0, 4.0) < 2.0 { 0.5 - log(1e-6, 0.5) } else { log(0.01, 0.4) };
        solid(log(1e3, 1e12), poisson_ratio, log(1e-7, 1e-3), log(1e-2, 1e3))
    };
    let packing = PACKINGS[(log(1.0, 4.0) < 2.0) as usize];
    let outer = 85e-6 * (1.0 - log(0.01, 0.4));
    let mut radii: Vec<f64> = (1..log(1.0, 5.0) as usize).map(|_| outer * log(0.1, 0.99)).chain([outer]).collect();
    radii.sort_by(f64::total_cmp);
    let ring = |(i, outer_radius)| Ring {
        outer_radius,
        constituent: material(&mut log),
        role: if i == 0 { Role::Glass } else { Role::Coating },
    };
    let rings = radii.into_iter().enumerate().map(ring).collect();
    FibreCell { packing, pitch: 170e-6, rings, adhesive: material(&mut log) }
}

/// No constant of `found` is farther from `exact` than its estimate says.
fn assert_covered(found: &Homogenized, exact: &Constants, what: &str) {
    let sizes = found.constants.size().named();
    let all = found.constants.named().into_iter().zip(exact.named()).zip(found.relative_error.named());
    for ((((name, found), (_, exact)), (_, estimate)), (_, size)) in all.zip(sizes) {
        let error = (found - exact).abs() / size;
        assert!(error <= estimate, "{what}, {name}: {error:e}, estimated {estimate:e}");
    }
}

/// Where two orders agree in one constant by chance, the estimate is not fooled.
#[test]
fn bounds_estimates_cover_the_error_of_any_cell() {
    let mut random = Random::new(99);
    let mut judged = 0;
    for k in 0..150 {
        let cell = anything(&mut random);
        let tolerance = [1e-3, 1e-6][k % 2];
        let (Ok(found), Ok(exact)) = (homogenize_to(&cell, tolerance), homogenize_to(&cell, 1e-9)) else { continue };
        judged += 1;
        assert_covered(&found, &exact.constants, &format!("cell {k}"));
    }
    assert!(judged > 100, "{judged}");
}

/// A cell of which one order, 47, is off by more than its neighbours on both sides, and agrees with order 39 by chance.
#[test]
fn bounds_estimates_cover_an_order_that_stands_out() {
    let ring = |outer_radius, constituent, role| Ring { outer_radius, constituent, role };
    let rings = vec![
        ring(37.740_725_713_365_84e-6, solid(65.207_156_511_824_54e9, 0.191_639_000_656_521_98, 0.55e-6, 1.38), Role::Glass),
        ring(65.314_703_731_535_95e-6, solid(55.097_649_238_979e6, 0.499_912_585, 24.34e-6, 0.100_57), Role::Coating),
        ring(74.163_237_206_551_54e-6, solid(1.843_103_368_905e9, 0.498_710_799, 1.788e-6, 0.104), Role::Coating),
    ];
    let adhesive = solid(71.437_419e6, 0.491_988_033, 110.539e-6, 0.117_78);
    let cell = FibreCell { packing: Packing::Square, pitch: 151.795_446_937_033e-6, rings, adhesive };
    let of = |order| multipoles(&cell, order).unwrap().constants().unwrap().k_plane_strain;
    let exact = multipoles(&cell, 401).unwrap().constants().unwrap();
    let off = |order| (of(order) / exact.k_plane_strain - 1.0).abs();
    assert!(off(47) > 2.0 * off(43) && off(47) > 10.0 * off(51), "{:e} {:e} {:e}", off(43), off(47), off(51));
    assert_covered(&homogenize_to(&cell, TOLERANCE).unwrap(), &exact, "the cell");
}

/// Cancellation is in the estimate, wherever in the solution it is: up to the thirteenth nine of Poisson's ratio, where rounding turns the
/// sign of an expansion, and in an adhesive of 1 Pa.
#[test]
fn bounds_rounding_is_in_the_estimate() {
    let nines = |poisson_ratio: f64, packing: Packing| {
        let mut cell = FibreCell { packing, ..reference() };
        cell.adhesive.elastic.poisson_ratio = poisson_ratio;
        cell.rings[1].constituent.elastic.poisson_ratio = poisson_ratio;
        cell
    };
    for packing in PACKINGS {
        // linear in 1/2 − ν, and there already to eight digits
        let [a, b] = [0.499999, 0.4999999].map(|nu| homogenize_to(&nines(nu, packing), 1e-7).unwrap().constants.alpha_z);
        let limit = b - (a - b) / 9.0;
        for nu in [0.49999, 0.4999999] {
            assert!(homogenize_to(&nines(nu, packing), TOLERANCE).is_ok(), "{nu}");
        }
        let (mut refused, mut solved) = (0, 0);
        for (nu, tolerance) in
            [0.499999999, 0.4999999999, 0.4999999999999].into_iter().flat_map(|nu| [1e-6, 1e-4, 1e-2].map(|t| (nu, t)))
        {
            match homogenize_to(&nines(nu, packing), tolerance) {
                Ok(found) => {
                    let error = (found.constants.alpha_z / limit - 1.0).abs();
                    assert!(error <= found.relative_error.alpha_z, "{nu}: {error:e}, {:e}", found.relative_error.alpha_z);
                    solved += 1;
                }
                Err(Error::Accuracy { why, reached, .. }) => {
                    assert!(why.contains("rounding") && reached > tolerance, "{nu}: {why}");
                    refused += 1;
                }
                Err(other) => panic!("{other}"),
            }
        }
        assert!(refused >= 5 && solved >= 3, "{refused} refused, {solved} solved");
        for modulus in [1.0, 1e3] {
            let soft = |modulus: f64| FibreCell { packing, adhesive: solid(modulus, 0.3, 250e-6, 0.45), ..reference() };
            let exact = homogenize_to(&soft(modulus), 1e-7).unwrap();
            for ulps in 1..6 {
                let near = multipoles(&soft(modulus * (1.0 + f64::from(ulps) * f64::EPSILON)), exact.unknowns - 3).unwrap();
                assert_covered(&exact, &near.constants().unwrap(), &format!("{modulus} Pa"));
            }
            match homogenize_to(&soft(modulus), 1e-10) {
                Err(Error::Accuracy { why, .. }) => assert!(why.contains("rounding"), "{why}"),
                other => panic!("{modulus} Pa: {other:?}"),
            }
        }
    }
}

#[test]
fn bounds_what_cannot_be_reached_is_said() {
    for (cell, tolerance, cause) in [
        (reference(), 1e-13, "rounding"),
        (FibreCell { pitch: 165.0001e-6, ..reference() }, 1e-6, "too thin"),
        (reference(), 0.0, "rounding"),
    ] {
        match homogenize_to(&cell, tolerance) {
            Err(Error::Accuracy { reached, why, requested, .. }) => {
                assert!(reached > requested && requested == tolerance && why.contains(cause), "{reached} {why}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(matches!(multipoles(&reference(), 403), Err(Error::Multipoles { .. })));
}

/// With fewer points for the volumetric part low orders do not lock; at high order both ways agree.
#[test]
fn bounds_reduced_integration_helps_low_orders_and_leaves_high_ones() {
    let rubber: Constituent = solid(5.6e6, 0.49999, 250e-6, 0.45);
    for packing in PACKINGS {
        let cell = FibreCell { packing, adhesive: rubber, ..reference() };
        let exact = homogenize_to(&cell, 1e-9).unwrap().constants.e_r;
        let error = |order: usize, volumetric| {
            let found = effective_with(&cell, &on(&cell, order, Extent::Quarter), volumetric).unwrap().constants().unwrap().e_r;
            (found / exact - 1.0).abs()
        };
        for order in [4, 5, 6] {
            let (full, reduced) = (error(order, Integration::Full), error(order, Integration::Reduced));
            assert!(reduced < full / 30.0 && full > 5e-7, "order {order}: {full:e} in full, {reduced:e} reduced");
        }
        let (full, reduced) = (error(11, Integration::Full), error(11, Integration::Reduced));
        assert!(full < 2e-9 && reduced < 2e-9, "{full:e}, {reduced:e}");
    }
    // nothing but the volumetric part has fewer points: solids without one do not know the difference
    let mut corks = reference();
    corks.rings.iter_mut().for_each(|ring| ring.constituent.elastic.poisson_ratio = 0.0);
    corks.adhesive.elastic.poisson_ratio = 0.0;
    let [full, reduced] = [Integration::Full, Integration::Reduced]
        .map(|volumetric| effective_with(&corks, &on(&corks, 4, Extent::Quarter), volumetric).unwrap().stiffness);
    assert!((full - reduced).amax() < 1e-12 * full.amax());
}

/// Area means, only if every constituent has its own; a bad one is named.
#[test]
fn exact_densities_and_heat_capacities() {
    let mut cell = reference();
    assert_eq!((cell.density().unwrap(), cell.heat_capacity().unwrap()), (None, None));
    let (areas, whole) = (cell.outline().unwrap().phase_areas(), cell.outline().unwrap().area());
    for ring in &mut cell.rings {
        (ring.constituent.density, ring.constituent.specific_heat) = (Some(2200.0), Some(700.0));
    }
    (cell.adhesive.density, cell.adhesive.specific_heat) = (Some(1000.0), Some(2000.0));
    let share = areas[3] / whole;
    assert!((cell.density().unwrap().unwrap() / (2200.0 - 1200.0 * share) - 1.0).abs() < 1e-12);
    assert!((cell.heat_capacity().unwrap().unwrap() / (1.54e6 + 0.46e6 * share) - 1.0).abs() < 1e-12);
    cell.rings[1].constituent.density = Some(-1.0);
    let message = cell.heat_capacity().unwrap_err().to_string();
    assert!(message.contains("ring 1") && message.contains("density"), "{message}");
}
