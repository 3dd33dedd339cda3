//! Points where a curve, perhaps not monotonic, meets a value.

/// Range of the search about a prior's middle \[σ\].
pub(super) const REACH: f64 = 4.0;
/// Number of points of the first search.
const POINTS: i32 = 33;
/// Halvings of an interval; it is then as small as rounding allows to tell.
const HALVINGS: usize = 30;

/// Points (u, f(u)) over the reach, where there is a value.
pub(super) fn course(f: &impl Fn(f64) -> Option<f64>) -> Vec<(f64, f64)> {
    let at = |k: i32| REACH * f64::from(2 * k + 1 - POINTS) / f64::from(POINTS - 1);
    (0..POINTS).filter_map(|k| Some((at(k), f(at(k))?))).collect()
}

/// The u nearest to zero at which f is `target`, and the slope there.
pub(super) fn nearest(course: &[(f64, f64)], target: f64, f: &impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
    let crossing = |pair: &&[(f64, f64)]| (pair[0].1 - target) * (pair[1].1 - target) <= 0.0;
    let nearness = |pair: &&[(f64, f64)]| pair[0].0.abs().min(pair[1].0.abs());
    let pair = course.windows(2).filter(crossing).min_by(|a, b| nearness(a).total_cmp(&nearness(b)))?;
    let (mut low, mut high) = (pair[0], pair[1]);
    let slope = (high.1 - low.1) / (high.0 - low.0);
    for _ in 0..HALVINGS {
        // a secant that is kept inside the middle of the interval
        let secant = low.0 + (target - low.1) * (high.0 - low.0) / (high.1 - low.1);
        let width = high.0 - low.0;
        let u = if secant.is_finite() { secant.clamp(low.0 + 0.01 * width, high.0 - 0.01 * width) } else { low.0 + width / 2.0 };
        let value = f(u)?;
        if (value - target).abs() < 1e-7 {
            return Some((u, slope));
        }
        if (value - target) * (low.1 - target) <= 0.0 {
            high = (u, value);
        } else {
            low = (u, value);
        }
    }
    Some(((low.0 + high.0) / 2.0, slope))
}

/// The whole number up to ±`most` whose value is nearest to `target`, if that lies between values, and the slope; widens `range` to those met.
pub(super) fn whole(
    target: f64,
    most: i32,
    zero: f64,
    f: &impl Fn(i32) -> Option<f64>,
    range: &mut [f64; 2],
) -> Option<(i32, f64)> {
    let mut met: Option<(i32, f64)> = None;
    for end in [-most, most] {
        let Some(value) = f(end) else { continue };
        *range = [range[0].min(value), range[1].max(value)];
        if (zero - target) * (value - target) > 0.0 {
            continue;
        }
        let (mut near, mut far) = ((0, zero), (end, value));
        while (far.0 - near.0).abs() > 1 {
            let middle = (near.0 + far.0) / 2;
            let value = f(middle)?;
            let beyond = (value - target) * (near.1 - target) <= 0.0;
            *(if beyond { &mut far } else { &mut near }) = (middle, value);
        }
        let slope = (far.1 - near.1) / f64::from(far.0 - near.0);
        let closer = if (far.1 - target).abs() < (near.1 - target).abs() { far.0 } else { near.0 };
        if met.is_none_or(|(turns, _)| closer.abs() < turns.abs()) {
            met = Some((closer, slope));
        }
    }
    met
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_of_several_crossings_is_found_to_the_digit() {
        let f = |u: f64| (u < 3.9).then(|| (1.3 * u).sin() + 0.1 * u);
        let (u, slope) = nearest(&course(&f), 0.4, &f).unwrap();
        assert!((f(u).unwrap() - 0.4).abs() < 1e-6 && (0.0..0.6).contains(&u) && slope > 0.0, "{u}");
        assert_eq!(nearest(&course(&f), 9.0, &f), None);
    }

    #[test]
    fn whole_numbers_on_either_side() {
        let f = |n: i32| Some(-2.0 + 0.3 * f64::from(n));
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        assert_eq!(whole(-3.0, 12, -2.0, &f, &mut range).unwrap().0, -3);
        assert_eq!(whole(-1.22, 12, -2.0, &f, &mut range).unwrap().0, 3);
        assert_eq!(whole(5.0, 12, -2.0, &f, &mut range), None);
        assert!((range[0] + 5.6).abs() < 1e-12 && (range[1] - 1.6).abs() < 1e-12);
    }
}
