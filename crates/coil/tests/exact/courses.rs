//! Courses between the rows of a profile.

use super::QUICK;
use crate::common::reference;
use coil::{Drive, Dynamics, Error, Fidelity, Profile};

#[test]
fn exact_a_smoothed_profile_keeps_rows_lines_and_parabolas() {
    let time: Vec<f64> = [0.0, 30.0, 60.0, 85.0, 120.0, 200.0].to_vec();
    let of = |f: fn(f64) -> f64| Profile { time: time.clone(), drives: vec![time.iter().map(|t| f(*t)).collect()] };
    let smooth = of(|t| 3.0 - t * t / 1e3).smoothed(5);
    assert_eq!(smooth.time.len(), 26);
    // between two rows with neighbours on either side
    for (t, u) in smooth.time.iter().zip(&smooth.drives[0]).filter(|(t, _)| (30.0..=120.0).contains(*t)) {
        assert!((u - (3.0 - t * t / 1e3)).abs() < 1e-12, "{t}: {u}");
    }
    for (n, t) in time.iter().enumerate() {
        assert_eq!((smooth.time[5 * n], smooth.drives[0][5 * n]), (*t, 3.0 - t * t / 1e3));
    }
    let line = of(|t| 1.0 + t / 7.0).smoothed(4);
    assert!(line.time.iter().zip(&line.drives[0]).all(|(t, u)| (u - 1.0 - t / 7.0).abs() < 1e-13));
    assert_eq!(line.smoothed(1), line);
}

#[test]
fn bounds_a_smoothed_profile_leaves_its_rows_by_a_quarter_of_a_change_at_most() {
    // a jump of 10 K within a second, then an hour of rest: no slope of the jump may reach into the hour
    let jump = Profile { time: vec![0.0, 30.0, 31.0, 3631.0, 3661.0], drives: vec![vec![0.0, 0.0, 10.0, 10.0, 9.0]] };
    let (low, high) = jump.smoothed(50).drives[0].iter().fold((0.0_f64, 0.0_f64), |(l, h), u| (l.min(*u), h.max(*u)));
    assert!(low >= -2.5 && high <= 12.5 && high > 10.0, "{low} to {high}");
    let bad = Profile { time: vec![0.0, 30.0, 30.0], drives: vec![vec![1.0, 2.0, f64::NAN]] };
    let dynamics = Dynamics::new(&reference(), &[Drive::Chamber], &Fidelity { resolution: QUICK, modes: 6 }).expect("model");
    assert!(matches!(dynamics.simulate(&bad.smoothed(4)), Err(Error::Profile { .. })));
    assert_eq!(Profile { time: vec![0.0], drives: vec![vec![4.0]] }.smoothed(4).drives, [[4.0]]);
}
