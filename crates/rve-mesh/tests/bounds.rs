//! Refused inputs, and their messages.

use rve_mesh::{Error, Extent, LatticeCell, Resolution, mesh};

#[test]
fn bounds_cells_out_of_range() {
    for pitch in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(LatticeCell::hexagonal(pitch, vec![0.1]), Err(Error::Pitch(_))));
    }
    assert_eq!(LatticeCell::hexagonal(1.0, vec![]), Err(Error::NoRing));
    for (radii, bad) in [
        (vec![0.0], 0),
        (vec![-0.1], 0),
        (vec![f64::NAN], 0),
        (vec![0.2, 0.2], 1),
        (vec![0.2, 0.3, 0.1], 2),
        (vec![0.1, f64::INFINITY], 1),
    ] {
        assert!(matches!(LatticeCell::hexagonal(1.0, radii), Err(Error::RingOrder { ring, .. }) if ring == bad));
    }
    for radius in [0.5, 0.7] {
        assert_eq!(LatticeCell::hexagonal(1.0, vec![0.2, radius]), Err(Error::Overlap { radius, pitch: 1.0 }));
    }
    let message = LatticeCell::hexagonal(170e-6, vec![85e-6]).expect_err("touching fibres").to_string();
    assert!(message.contains("8.5e-5") && message.contains("half the pitch"), "{message}");
}

#[test]
fn bounds_resolutions_and_lattices_out_of_range() {
    let cell = LatticeCell::hexagonal(1.0, vec![0.2, 0.4]).unwrap();
    let good = Resolution { sectors: 1, grading: 1.0, across: vec![1, 1, 1] };
    let quadratic = [-1.0, 0.0, 1.0];
    assert!(mesh(&cell, Extent::Whole, &good, &quadratic).is_ok());
    for bad in [
        Resolution { sectors: 0, ..good.clone() },
        Resolution { sectors: usize::MAX, ..good.clone() },
        Resolution { sectors: 1_000_000_000, ..good.clone() },
        Resolution { across: vec![usize::MAX; 3], ..good.clone() },
        Resolution { grading: 0.1, ..good.clone() },
        Resolution { grading: 6.0, ..good.clone() },
        Resolution { grading: f64::NAN, ..good.clone() },
        Resolution { across: vec![1, 1], ..good.clone() },
        Resolution { across: vec![1, 0, 1], ..good.clone() },
    ] {
        assert!(matches!(mesh(&cell, Extent::Quarter, &bad, &quadratic), Err(Error::Resolution(_))), "{bad:?}");
    }
    let lattices: [&[f64]; 6] = [&[], &[-1.0], &[-1.0, 0.9], &[-1.0, 0.5, 0.5, 1.0], &[-1.0, f64::NAN, 1.0], &[0.0, 1.0]];
    for lattice in lattices {
        assert!(matches!(mesh(&cell, Extent::Quarter, &good, lattice), Err(Error::Resolution(_))), "{lattice:?}");
    }
}
