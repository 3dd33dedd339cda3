//! Polynomial interpolation between the values of a parameter at which a model was made.

/// Lobatto's points of Chebyshev on [low, high], increasing.
pub(crate) fn nodes(low: f64, high: f64, count: usize) -> Vec<f64> {
    let at = |k: usize| (1.0 - (std::f64::consts::PI * k as f64 / (count - 1) as f64).cos()) / 2.0;
    (0..count).map(|k| low + (high - low) * at(k)).collect()
}

/// Weight of each node's value at x, which is taken into the nodes' range: Lagrange's polynomials.
pub(crate) fn weights(nodes: &[f64], x: f64) -> Vec<f64> {
    let x = x.clamp(nodes[0], nodes[nodes.len() - 1]);
    let basis = |k: usize| -> f64 {
        nodes.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, node)| (x - node) / (nodes[k] - node)).product()
    };
    (0..nodes.len()).map(basis).collect()
}

/// Weights of the two nodes about x: linear interpolation.
pub(crate) fn linear_weights(nodes: &[f64], x: f64) -> Vec<f64> {
    let mut weights = vec![0.0; nodes.len()];
    let x = x.clamp(nodes[0], nodes[nodes.len() - 1]);
    let upper = nodes.partition_point(|n| *n < x).clamp(1, nodes.len() - 1);
    let share = (x - nodes[upper - 1]) / (nodes[upper] - nodes[upper - 1]);
    weights[upper - 1] = 1.0 - share;
    weights[upper] = share;
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_a_polynomial_is_reproduced() {
        let nodes = nodes(-1.0, 3.0, 6);
        let p = |x: f64| 1.0 - 2.0 * x + 0.3 * x.powi(5);
        for x in [-1.0, -0.2, 0.7, 2.9, 3.0] {
            let sum: f64 = weights(&nodes, x).iter().zip(&nodes).map(|(w, n)| w * p(*n)).sum();
            assert!((sum - p(x)).abs() < 1e-12);
            let linear: f64 = linear_weights(&nodes, x).iter().zip(&nodes).map(|(w, n)| w * (1.0 + 2.0 * n)).sum();
            assert!((linear - 1.0 - 2.0 * x).abs() < 1e-12);
        }
    }
}
