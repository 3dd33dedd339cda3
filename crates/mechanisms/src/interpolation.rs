//! Polynomial interpolation between the values of a parameter at which a model was made.

/// Lobatto's points of Chebyshev on [low, high], increasing.
pub(crate) fn nodes(low: f64, high: f64, count: usize) -> Vec<f64> {
    let at = |k: usize| (1.0 - (std::f64::consts::PI * k as f64 / (count - 1) as f64).cos()) / 2.0;
    (0..count).map(|k| low + (high - low) * at(k)).collect()
}

/// Weight of each node's value at x, which is taken into the nodes' range.
pub(crate) fn weights(nodes: &[f64], x: f64) -> Vec<f64> {
    lagrange(nodes, x.clamp(nodes[0], nodes[nodes.len() - 1]))
}

/// Lagrange's polynomials at x.
fn lagrange(nodes: &[f64], x: f64) -> Vec<f64> {
    let mut at = vec![0.0; nodes.len()];
    Lagrange::new(nodes).at(x, &mut at);
    at
}

/// Lagrange's polynomials of some nodes, for many places.
pub(crate) struct Lagrange<'a> {
    nodes: &'a [f64],
    /// 1/∏(own node − others), of each
    scales: Vec<f64>,
}

impl<'a> Lagrange<'a> {
    pub(crate) fn new(nodes: &'a [f64]) -> Self {
        let others = |k: usize| nodes.iter().enumerate().filter(move |(j, _)| *j != k).map(|(_, node)| node);
        let scale = |k: usize| others(k).map(|node| nodes[k] - node).product::<f64>().recip();
        Self { nodes, scales: (0..nodes.len()).map(scale).collect() }
    }

    /// The value of each at x, by the products of what stands before it and behind it.
    fn at(&self, x: f64, values: &mut [f64]) {
        let mut before = 1.0;
        for (k, node) in self.nodes.iter().enumerate() {
            values[k] = before * self.scales[k];
            before *= x - node;
        }
        let mut behind = 1.0;
        for (k, node) in self.nodes.iter().enumerate().rev() {
            values[k] *= behind;
            behind *= x - node;
        }
    }

    /// Weight of each node's value at x, which is taken into the nodes' range.
    pub(crate) fn weights(&self, x: f64, values: &mut [f64]) {
        self.at(x.clamp(self.nodes[0], self.nodes[self.nodes.len() - 1]), values);
    }
}

/// Weights of the up to four nodes about x, others 0: Lagrange's cubic.
pub(crate) fn cubic_weights(nodes: &[f64], x: f64) -> Vec<f64> {
    let first = nodes.partition_point(|n| *n < x).saturating_sub(2).min(nodes.len().saturating_sub(4));
    let end = (first + 4).min(nodes.len());
    let mut all = vec![0.0; nodes.len()];
    all[first..end].copy_from_slice(&lagrange(&nodes[first..end], x));
    all
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
            let cubic: f64 = cubic_weights(&nodes, x).iter().zip(&nodes).map(|(w, n)| w * (1.0 + 2.0 * n.powi(3))).sum();
            assert!((cubic - 1.0 - 2.0 * x.powi(3)).abs() < 1e-12);
        }
    }
}
