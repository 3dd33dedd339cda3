//! The fields at points, for pictures and files.

use super::{Fields, State};
use fem_core::ReferenceElement;

/// States at the points of small quadrilaterals that cover the cell. Points of different elements are never shared: stress and strain
/// jump at interfaces.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Quadrilaterals along an element's side.
    pub divisions: usize,
    /// (divisions + 1)² states of each element, from the inner curve outwards first.
    pub states: Vec<State>,
    /// Corners of each quadrilateral, counter-clockwise; divisions² for each element, in the order of the elements.
    pub quadrilaterals: Vec<[usize; 4]>,
}

/// How far from the point to which a wedge's inner curve shrinks the state there is taken.
const FROM_APEX: f64 = 1e-6;

impl Fields<'_> {
    /// Samples every element at `divisions` + 1 (at least 2) equidistant points along each side.
    pub fn sample(&self, divisions: usize) -> Sample {
        let (divisions, mesh) = (divisions.max(1), &self.solution.mesh);
        let reference = ReferenceElement::new(mesh.order(), 1);
        let n = divisions + 1;
        let at = |k: usize| -1.0 + 2.0 * k as f64 / divisions as f64;
        let (mut states, mut quadrilaterals) = (Vec::new(), Vec::new());
        for (e, element) in mesh.elements().iter().enumerate() {
            let first = states.len();
            let is_wedge = element[0] == element[mesh.order() + 1];
            for k in 0..n * n {
                let xi = if is_wedge && k % n == 0 { -1.0 + FROM_APEX } else { at(k % n) };
                let [value, dx, dy] = reference.at_point(mesh, e, xi, at(k / n));
                states.push(self.state(e, [&value, &dx, &dy]));
            }
            for (i, j) in (0..divisions).flat_map(|j| (0..divisions).map(move |i| (i, j))) {
                let corner = first + j * n + i;
                quadrilaterals.push([corner, corner + 1, corner + n + 1, corner + n]);
            }
        }
        Sample { divisions, states, quadrilaterals }
    }
}
