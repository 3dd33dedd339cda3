//! Rectangles with sides along the axes: integrals over them are products of integrals along the sides.

use crate::geometry::{ElementGeometry, Measure};
use crate::{Form, Mesh, ReferenceElement};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Functions along a side: slope, value, value over x. The operators ∂x, ∂y, 1/x are products of one along x and one along y.
const SLOPE: usize = 0;
const VALUE: usize = 1;
const OVER_X: usize = 2;
const ALONG_X: [usize; 3] = [SLOPE, VALUE, OVER_X];
const ALONG_Y: [usize; 3] = [VALUE, SLOPE, VALUE];

/// Integrals of the shape functions of one element along each of its sides.
#[derive(Debug)]
pub(crate) struct Rectangle {
    nodes: usize,
    /// `∫ f_i g_k w dx` at [3 f + g], w from the measure
    x: Vec<DMatrix<f64>>,
    /// `∫ f_j g_l dy`
    y: Vec<DMatrix<f64>>,
}

/// Coefficients of a form on the operators ∂x, ∂y, 1/x of the shape functions (rows: operator, then component) for one law.
#[derive(Debug, Clone)]
pub(crate) struct Coefficients(DMatrix<f64>);

/// One point at which the first node has ∂x = 1, the second ∂y = 1, the third 1/x = 1, all else zero: a form's matrix for it is the
/// form's coefficients.
fn unit_point() -> (DMatrix<f64>, ElementGeometry) {
    let unit = |node: usize| DMatrix::from_fn(3, 1, |a, _| f64::from(a == node));
    (unit(2), ElementGeometry { d_x: unit(0), d_y: unit(1), x: vec![1.0], y: vec![0.0], weight: vec![1.0] })
}

impl Coefficients {
    pub(crate) fn stiffness(form: Form, law: &DMatrix<f64>) -> Self {
        let (value, point) = unit_point();
        Self(form.stiffness(&value, &point, law))
    }

    /// Of a stress in each column.
    pub(crate) fn loads(form: Form, stresses: &DMatrix<f64>) -> Self {
        let (value, point) = unit_point();
        let columns: Vec<_> = stresses.column_iter().map(|s| form.load(&value, &point, s.as_slice())).collect();
        Self(DMatrix::from_columns(&columns))
    }
}

impl Rectangle {
    /// Element `e` of `mesh`, unless it is no such rectangle, is turned inside out, or reaches across the axis of a body of revolution.
    pub(crate) fn new(reference: &ReferenceElement, mesh: &Mesh, e: usize, measure: Measure) -> Option<Self> {
        let (points, n) = (reference.basis.points(), mesh.order() + 1);
        let element = &mesh.elements()[e];
        let (first, last) = (mesh.nodes()[element[0]], mesh.nodes()[element[n * n - 1]]);
        let middle = [0, 1].map(|c| (first[c] + last[c]) / 2.0);
        let half = [0, 1].map(|c| (last[c] - first[c]) / 2.0);
        let scale = [0, 1].map(|c| 4.0 * f64::EPSILON * first[c].abs().max(last[c].abs()));
        let in_place = element.iter().enumerate().all(|(a, &node)| {
            let reference = [points[a % n], points[a / n]];
            (0..2).all(|c| (mesh.nodes()[node][c] - middle[c] - half[c] * reference[c]).abs() <= scale[c])
        });
        if !(in_place && half[0] > 0.0 && half[1] > 0.0 && half[0].is_finite() && half[1].is_finite()) {
            return None;
        }
        let ([value, slope], quadrature) = (&reference.one_dimension, &reference.quadrature);
        let x: Vec<f64> = quadrature.points.iter().map(|xi| middle[0] + half[0] * xi).collect();
        let weight = |c: usize, k: usize| quadrature.weights[k] * half[c];
        let along_x = match measure {
            Measure::Area => (0..x.len()).map(|k| weight(0, k)).collect(),
            Measure::Revolution if x[0] > 0.0 => (0..x.len()).map(|k| weight(0, k) * TAU * x[k]).collect(),
            Measure::Revolution => return None,
        };
        let along_y = (0..x.len()).map(|k| weight(1, k)).collect();
        let over_x = DMatrix::from_fn(n, x.len(), |i, k| value[(i, k)] / x[k]);
        let integrals = |functions: &[DMatrix<f64>], weights: Vec<f64>| {
            let mut list = vec![DMatrix::zeros(0, 0); 9];
            for (f, left) in functions.iter().enumerate() {
                let weighted = DMatrix::from_fn(x.len(), n, |k, i| weights[k] * left[(i, k)]);
                for (g, right) in functions.iter().enumerate() {
                    list[3 * g + f] = right * &weighted;
                }
            }
            list
        };
        Some(Self {
            nodes: n,
            x: integrals(&[slope / half[0], value.clone(), over_x], along_x),
            y: integrals(&[slope / half[1], value.clone()], along_y),
        })
    }

    /// `Σ C_ts ∫ O_t N_a O_s N_b` over pairs of operators; shape (nodes × components)².
    pub(crate) fn stiffness(&self, coefficients: &Coefficients) -> DMatrix<f64> {
        let (n, c) = (self.nodes, coefficients.0.nrows() / 3);
        let mut k = DMatrix::zeros(n * n * c, n * n * c);
        let mut block = vec![0.0; n * n];
        for (column_component, row_component) in (0..c * c).map(|k| (k / c, k % c)) {
            let at = |t: usize, s: usize| coefficients.0[(t * c + row_component, s * c + column_component)];
            let products: Vec<_> = [(VALUE, VALUE), (VALUE, SLOPE), (SLOPE, VALUE), (SLOPE, SLOPE)]
                .into_iter()
                .filter_map(|(f, g)| {
                    let pairs = (0..9).map(|p| (p / 3, p % 3)).filter(|&(t, s)| ALONG_Y[t] == f && ALONG_Y[s] == g);
                    let terms = pairs.filter(|&(t, s)| at(t, s) != 0.0);
                    let x = terms.map(|(t, s)| &self.x[3 * ALONG_X[t] + ALONG_X[s]] * at(t, s)).reduce(|a, b| a + b);
                    x.map(|x| (x, &self.y[3 * f + g]))
                })
                .collect();
            for (b, column) in k.as_mut_slice().chunks_exact_mut(n * n * c).skip(column_component).step_by(c).enumerate() {
                block.fill(0.0);
                for (x, y) in &products {
                    let (x, y) = (&x.as_slice()[b % n * n..][..n], &y.as_slice()[b / n * n..][..n]);
                    for (row, y) in block.chunks_exact_mut(n).zip(y) {
                        row.iter_mut().zip(x).for_each(|(sum, x)| *sum += x * y);
                    }
                }
                column.iter_mut().skip(row_component).step_by(c).zip(&block).for_each(|(k, value)| *k = *value);
            }
        }
        k
    }

    /// `∫ N_a N_b`.
    pub(crate) fn mass(&self) -> DMatrix<f64> {
        self.y[3 * VALUE + VALUE].kronecker(&self.x[3 * VALUE + VALUE])
    }

    /// `Σ c_t ∫ O_t N_a N_b`: the load of a nodal field; shape (nodes × components, nodes).
    pub(crate) fn coupling(&self, coefficients: &Coefficients) -> DMatrix<f64> {
        let (n, c) = (self.nodes, coefficients.0.nrows() / 3);
        let mut h = DMatrix::zeros(n * n * c, n * n);
        for t in 0..3 {
            let (x, y) = (&self.x[3 * ALONG_X[t] + VALUE], &self.y[3 * ALONG_Y[t] + VALUE]);
            for component in (0..c).filter(|i| coefficients.0[t * c + i] != 0.0) {
                let factor = coefficients.0[t * c + component];
                for b in 0..n * n {
                    for a in 0..n * n {
                        h[(a * c + component, b)] += factor * x[(a % n, b % n)] * y[(a / n, b / n)];
                    }
                }
            }
        }
        h
    }

    /// `Σ c_t ∫ O_t N_a` for each column of the coefficients.
    pub(crate) fn loads(&self, coefficients: &Coefficients) -> DMatrix<f64> {
        let (n, c) = (self.nodes, coefficients.0.nrows() / 3);
        let mut f = DMatrix::zeros(n * n * c, coefficients.0.ncols());
        for t in 0..3 {
            // the shape functions sum to one
            let (x, y) = (self.x[3 * ALONG_X[t] + VALUE].column_sum(), self.y[3 * ALONG_Y[t] + VALUE].column_sum());
            for (mut f, factors) in f.column_iter_mut().zip(coefficients.0.column_iter()) {
                for component in (0..c).filter(|i| factors[t * c + i] != 0.0) {
                    let factor = factors[t * c + component];
                    (0..n * n).for_each(|a| f[a * c + component] += factor * x[a % n] * y[a / n]);
                }
            }
        }
        f
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One element with corners (1, 2) and (1.3, 2.7), its inside moved by `inside` \[m\].
    fn mesh(order: usize, inside: f64) -> Mesh {
        let points = crate::polynomial::gauss_lobatto(order);
        let n = order + 1;
        let node = |a: usize| {
            let [xi, eta] = [points[a % n], points[a / n]];
            let bump = inside * (1.0 - xi * xi) * (1.0 - eta * eta);
            [1.15 + 0.15 * xi + bump, 2.35 + 0.35 * eta]
        };
        Mesh::new(order, (0..n * n).map(node).collect(), vec![(0..n * n).collect()], vec![0]).unwrap()
    }

    fn law(rows: usize, columns: usize) -> DMatrix<f64> {
        // without symmetry or zeros: every coefficient counts
        DMatrix::from_fn(rows, columns, |i, j| 1.0 + ((3 * i + 5 * j) as f64).sin())
    }

    fn assert_equal(a: &DMatrix<f64>, b: &DMatrix<f64>, what: &str) {
        assert!((a - b).amax() < 1e-12 * b.amax(), "{what}: off by {:e} of {:e}", (a - b).amax(), b.amax());
    }

    #[test]
    fn exact_integrals_over_a_rectangle_are_those_of_the_general_element() {
        let forms = [Form::DIFFUSION, Form::PLANE_STRAIN, Form::AXISYMMETRIC_DIFFUSION, Form::AXISYMMETRIC_ELASTICITY];
        for (form, order) in forms.into_iter().flat_map(|form| [1, 2, 5, 8].map(|order| (form, order))) {
            let (mesh, reference) = (mesh(order, 0.0), ReferenceElement::new(order, order + 1));
            let (value, g) = (&reference.value, reference.geometry(&mesh, 0, form.measure).unwrap());
            let rectangle = Rectangle::new(&reference, &mesh, 0, form.measure).expect("a rectangle");
            let what = format!("{form:?}, order {order}");
            let (d, s) = (law(form.strains, form.strains), law(form.strains, 1));
            assert_equal(&rectangle.stiffness(&Coefficients::stiffness(form, &d)), &form.stiffness(value, &g, &d), &what);
            let loads = Coefficients::loads(form, &s);
            assert_equal(&rectangle.coupling(&loads), &form.coupling(value, &g, s.as_slice()), &what);
            assert_equal(&rectangle.mass(), &Form::mass(value, &g, 1.0), &what);
            let (load, general) = (rectangle.loads(&loads), form.load(value, &g, s.as_slice()));
            assert!((&load - &general).amax() < 1e-12 * general.amax(), "{what}");
        }
    }

    #[test]
    fn exact_what_is_no_rectangle_is_left_to_the_general_element() {
        let reference = ReferenceElement::new(3, 4);
        let is_one = |mesh: &Mesh, measure| Rectangle::new(&reference, mesh, 0, measure).is_some();
        assert!(is_one(&mesh(3, 0.0), Measure::Revolution));
        assert!(!is_one(&mesh(3, 1e-12), Measure::Revolution), "nodes off their places");
        let moved = |by: f64, sign: f64| {
            let nodes = mesh(3, 0.0).nodes().iter().map(|[x, y]| [sign * x + by, *y]).collect();
            Mesh::new(3, nodes, vec![(0..16).collect()], vec![0]).unwrap()
        };
        assert!(!is_one(&moved(3.0, -1.0), Measure::Area), "turned inside out");
        let upside_down = mesh(3, 0.0).nodes().iter().map(|[x, y]| [*x, -y]).collect();
        let upside_down = Mesh::new(3, upside_down, vec![(0..16).collect()], vec![0]).unwrap();
        assert!(!is_one(&upside_down, Measure::Area), "turned inside out along y");
        assert!(!is_one(&moved(-1.1, 1.0), Measure::Revolution) && is_one(&moved(-1.1, 1.0), Measure::Area), "across the axis");
    }
}
