//! Minimum of a function of a few variables inside a box.

/// Reflect, expand, contract, shrink (Nelder and Mead, *Computer Journal* 7, 308, 1965), kept in the box.
pub(super) fn nelder_mead(
    f: &mut impl FnMut(&[f64]) -> f64,
    start: &[f64],
    bounds: &[[f64; 2]],
    tolerance: f64,
) -> (Vec<f64>, f64) {
    let n = start.len();
    let inside =
        |point: Vec<f64>| -> Vec<f64> { point.iter().zip(bounds).map(|(x, [low, high])| x.clamp(*low, *high)).collect() };
    let mut simplex: Vec<(Vec<f64>, f64)> = Vec::with_capacity(n + 1);
    for vertex in 0..=n {
        let mut point = start.to_vec();
        if vertex > 0 {
            let i = vertex - 1;
            point[i] += if point[i] + FIRST_STEP <= bounds[i][1] { FIRST_STEP } else { -FIRST_STEP };
        }
        let point = inside(point);
        let value = f(&point);
        simplex.push((point, value));
    }
    for _ in 0..MOST_STEPS {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, worst) = (simplex[0].1, simplex[n].1);
        if n == 0 || worst - best <= tolerance {
            break;
        }
        let centre: Vec<f64> = (0..n).map(|i| simplex[..n].iter().map(|(point, _)| point[i]).sum::<f64>() / n as f64).collect();
        let mut attempt = |factor: f64| {
            let point = inside((0..n).map(|i| centre[i] + factor * (simplex[n].0[i] - centre[i])).collect());
            let value = f(&point);
            (point, value)
        };
        let reflected = attempt(-1.0);
        let next = if reflected.1 < best {
            let expanded = attempt(-2.0);
            if expanded.1 < reflected.1 { expanded } else { reflected }
        } else if reflected.1 < simplex[n - 1].1 {
            reflected
        } else {
            attempt(if reflected.1 < worst { -0.5 } else { 0.5 })
        };
        if next.1 < worst {
            simplex[n] = next;
            continue;
        }
        let anchor = simplex[0].0.clone();
        for (point, value) in &mut simplex[1..] {
            point.iter_mut().zip(&anchor).for_each(|(x, a)| *x = (*x + a) / 2.0);
            *value = f(point);
        }
    }
    simplex.swap_remove(0)
}

/// Edge of the first simplex: the variables are logarithms.
const FIRST_STEP: f64 = 0.7;
const MOST_STEPS: usize = 400;

#[cfg(test)]
mod tests {
    use super::nelder_mead;

    #[test]
    fn a_bent_valley_and_a_wall() {
        let mut valley = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        let (at, value) = nelder_mead(&mut valley, &[-1.2, 1.0], &[[-5.0, 5.0]; 2], 1e-14);
        assert!(value < 1e-12 && (at[0] - 1.0).abs() < 1e-5, "{at:?} {value}");
        let (at, _) = nelder_mead(&mut valley, &[-1.2, 1.0], &[[-5.0, 0.5], [-5.0, 5.0]], 1e-14);
        assert!((at[0] - 0.5).abs() < 1e-5 && (at[1] - 0.25).abs() < 1e-5, "{at:?}");
    }
}
