//! The least value of a function of a few variables, none of whose derivatives is known.

/// Effort of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Difference of the function's values over the simplex at which the search has settled, ≥ 0.
    pub tolerance: f64,
    /// Evaluations after which it ends, unsettled; a step that has begun is finished.
    pub evaluations: usize,
}

/// Reflect, expand, contract, shrink (Nelder and Mead, *Computer Journal* 7, 308, 1965), inside a box: where the least value was found, and it.
///
/// The first simplex is `start` and, along each variable, `start` moved by its entry of `edges`. Points beyond `bounds` (lower and upper
/// of each variable, which may be infinite) are moved onto them. Without variables the function is evaluated once.
///
/// ```
/// use recording::minimise::{Effort, nelder_mead};
///
/// // Rosenbrock's valley, least at (1, 1)
/// let valley = |x: &[f64]| (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
/// let effort = Effort { tolerance: 1e-14, evaluations: 1000 };
/// let (at, value) = nelder_mead(valley, &[-1.2, 1.0], &[0.7, 0.7], &[[-5.0, 5.0]; 2], effort);
/// assert!(value < 1e-12 && (at[0] - 1.0).abs() < 1e-5);
/// ```
///
/// # Panics
/// If there is not one edge and one pair of bounds for each variable.
pub fn nelder_mead(
    mut f: impl FnMut(&[f64]) -> f64,
    start: &[f64],
    edges: &[f64],
    bounds: &[[f64; 2]],
    effort: Effort,
) -> (Vec<f64>, f64) {
    let n = start.len();
    assert!(edges.len() == n && bounds.len() == n, "one edge and one pair of bounds for each variable");
    let mut at = |mut point: Vec<f64>| {
        point.iter_mut().zip(bounds).for_each(|(x, [low, high])| *x = x.clamp(*low, *high));
        let value = f(&point);
        (point, value)
    };
    // a + t (b − a)
    let between = |a: &[f64], b: &[f64], t: f64| -> Vec<f64> { a.iter().zip(b).map(|(a, b)| a + t * (b - a)).collect() };
    let mut simplex = vec![at(start.to_vec())];
    for (i, edge) in edges.iter().enumerate() {
        let mut point = start.to_vec();
        point[i] += edge;
        simplex.push(at(point));
    }
    let mut spent = simplex.len();
    while spent < effort.evaluations {
        simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
        let (best, worst) = (simplex[0].1, simplex[n].1);
        if n == 0 || worst - best <= effort.tolerance {
            break;
        }
        let centre: Vec<f64> = (0..n).map(|i| simplex[..n].iter().map(|(point, _)| point[i]).sum::<f64>() / n as f64).collect();
        let mut attempt = |t: f64| {
            spent += 1;
            at(between(&centre, &simplex[n].0, t))
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
        for vertex in &mut simplex[1..] {
            *vertex = at(between(&anchor, &vertex.0, 0.5));
        }
        spent += n;
    }
    simplex.sort_by(|a, b| a.1.total_cmp(&b.1));
    simplex.swap_remove(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn valley(x: &[f64]) -> f64 {
        (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2)
    }

    const EFFORT: Effort = Effort { tolerance: 1e-14, evaluations: 1000 };

    #[test]
    fn a_wall_in_a_bent_valley_and_no_variable() {
        let (at, _) = nelder_mead(valley, &[-1.2, 1.0], &[0.7; 2], &[[-5.0, 0.5], [-5.0, 5.0]], EFFORT);
        assert!((at[0] - 0.5).abs() < 1e-5 && (at[1] - 0.25).abs() < 1e-5, "{at:?}");
        assert_eq!(nelder_mead(|_| 7.0, &[], &[], &[], EFFORT), (vec![], 7.0));
    }

    #[test]
    fn the_effort_is_kept_and_the_best_point_met_is_returned() {
        for evaluations in 1..60 {
            let (mut spent, mut least) = (0, f64::INFINITY);
            let counted = |x: &[f64]| {
                spent += 1;
                least = least.min(valley(x));
                valley(x)
            };
            let effort = Effort { evaluations, ..EFFORT };
            let (at, value) = nelder_mead(counted, &[-1.2, 1.0], &[0.7; 2], &[[f64::NEG_INFINITY, f64::INFINITY]; 2], effort);
            assert_eq!((value, value), (least, valley(&at)));
            // the first simplex is three, and a step takes two, or four where it shrinks
            assert!(spent < evaluations.max(3) + 4, "{spent} of {evaluations}");
        }
    }
}
