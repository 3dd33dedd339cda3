//! Shape functions and their physical gradients at the quadrature points of an element.

use crate::polynomial::{Lagrange, Quadrature, gauss};
use crate::{Error, Mesh};
use nalgebra::DMatrix;
use std::f64::consts::TAU;

/// Factor on the area element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Per unit length across the plane: dA.
    Area,
    /// Body of revolution about x = 0: 2πx dA.
    Revolution,
}

/// Tensor-product shape functions at the quadrature points of the reference square. Rows are nodes, columns points.
#[derive(Debug, Clone)]
pub struct ReferenceElement {
    pub(crate) basis: Lagrange,
    /// Values and slopes at the points along one side, shape (nodes, points).
    pub(crate) one_dimension: [DMatrix<f64>; 2],
    pub(crate) quadrature: Quadrature,
    /// N, shape (nodes, points).
    pub value: DMatrix<f64>,
    d_xi: DMatrix<f64>,
    d_eta: DMatrix<f64>,
    weights: Vec<f64>,
}

/// Gradients and weights of one element at its quadrature points. Rows are nodes, columns points.
#[derive(Debug, Clone)]
pub struct ElementGeometry {
    /// ∂N/∂x \[1/m\].
    pub d_x: DMatrix<f64>,
    /// ∂N/∂y \[1/m\].
    pub d_y: DMatrix<f64>,
    /// x at each point \[m\].
    pub x: Vec<f64>,
    /// y at each point \[m\].
    pub y: Vec<f64>,
    /// Quadrature weight times area element times [`Measure`].
    pub weight: Vec<f64>,
}

impl ReferenceElement {
    /// Elements of `order` with `points` Gauss points per direction.
    pub fn new(order: usize, points: usize) -> Self {
        let basis = Lagrange::gauss_lobatto(order);
        let quadrature = gauss(points);
        let Quadrature { points, weights } = &quadrature;
        let one_dimension: Vec<_> = points.iter().map(|&x| basis.evaluate(x)).collect();
        let (n, q) = (order + 1, points.len());
        let tensor = |xi: &dyn Fn(usize, usize) -> f64, eta: &dyn Fn(usize, usize) -> f64| {
            DMatrix::from_fn(n * n, q * q, |node, point| xi(node % n, point % q) * eta(node / n, point / q))
        };
        let (v, d) = (|i: usize, k: usize| one_dimension[k].0[i], |i: usize, k: usize| one_dimension[k].1[i]);
        let (value, d_xi, d_eta) = (tensor(&v, &v), tensor(&d, &v), tensor(&v, &d));
        let weights = (0..q * q).map(|k| weights[k % q] * weights[k / q]).collect();
        let one_dimension = [DMatrix::from_fn(n, q, v), DMatrix::from_fn(n, q, d)];
        Self { basis, one_dimension, quadrature, value, d_xi, d_eta, weights }
    }

    /// Geometry of element `e` of `mesh` (which must be of this order).
    ///
    /// # Errors
    /// [`Error::Mesh`] if the element is turned inside out at a quadrature point, or a body of revolution reaches across its axis.
    pub fn geometry(&self, mesh: &Mesh, e: usize, measure: Measure) -> Result<ElementGeometry, Error> {
        let (nodes, points) = (mesh.elements()[e].len(), self.weights.len());
        let zeros = || DMatrix::zeros(nodes, points);
        let mut g =
            ElementGeometry { d_x: zeros(), d_y: zeros(), x: vec![0.0; points], y: vec![0.0; points], weight: Vec::new() };
        for k in 0..points {
            let ([x, y], j) = self.position_and_jacobian(mesh, e, k);
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            // not `<=`: a NaN must not pass
            if !(det > 0.0 && det.is_finite()) {
                return Err(Error::Mesh(format!("element {e} is turned inside out near ({x:.6e}, {y:.6e}) m")));
            }
            let radius = match measure {
                Measure::Area => 1.0,
                Measure::Revolution if x > 0.0 => TAU * x,
                Measure::Revolution => return Err(Error::Mesh(format!("element {e} reaches across the axis to x = {x:.6e} m"))),
            };
            let (d_xi, d_eta) = (self.d_xi.column(k), self.d_eta.column(k));
            for a in 0..nodes {
                g.d_x[(a, k)] = (j[1][1] * d_xi[a] - j[0][1] * d_eta[a]) / det;
                g.d_y[(a, k)] = (j[0][0] * d_eta[a] - j[1][0] * d_xi[a]) / det;
            }
            (g.x[k], g.y[k]) = (x, y);
            g.weight.push(self.weights[k] * det * radius);
        }
        Ok(g)
    }

    /// Position of quadrature point `k` and its derivatives along ξ (first row) and η.
    fn position_and_jacobian(&self, mesh: &Mesh, e: usize, k: usize) -> ([f64; 2], [[f64; 2]; 2]) {
        let (value, d_xi, d_eta) = (self.value.column(k), self.d_xi.column(k), self.d_eta.column(k));
        let (mut position, mut jacobian) = ([0.0; 2], [[0.0; 2]; 2]);
        for (a, &node) in mesh.elements()[e].iter().enumerate() {
            let p = mesh.nodes()[node];
            for c in 0..2 {
                position[c] += value[a] * p[c];
                jacobian[0][c] += d_xi[a] * p[c];
                jacobian[1][c] += d_eta[a] * p[c];
            }
        }
        (position, jacobian)
    }

    /// Area (or volume of revolution) of each region of `mesh`, by quadrature \[m² or m³\].
    ///
    /// # Errors
    /// As [`Self::geometry`].
    pub fn region_measures(&self, mesh: &Mesh, measure: Measure) -> Result<Vec<f64>, Error> {
        let mut sums = vec![0.0; mesh.region_count()];
        for (e, &region) in mesh.regions().iter().enumerate() {
            sums[region] += self.geometry(mesh, e, measure)?.weight.iter().sum::<f64>();
        }
        Ok(sums)
    }

    /// Values and physical gradients of all shape functions of element `e` at the reference point (ξ, η).
    ///
    /// Returns (N, ∂N/∂x, ∂N/∂y), each of length (p+1)².
    pub fn at_point(&self, mesh: &Mesh, e: usize, xi: f64, eta: f64) -> [Vec<f64>; 3] {
        let ((vx, dx), (vy, dy)) = (self.basis.evaluate(xi), self.basis.evaluate(eta));
        let n = vx.len();
        let shape: Vec<[f64; 3]> = (0..n * n)
            .map(|a| {
                let (i, j) = (a % n, a / n);
                [vx[i] * vy[j], dx[i] * vy[j], vx[i] * dy[j]]
            })
            .collect();
        let mut j = [[0.0; 2]; 2];
        for (s, &node) in shape.iter().zip(&mesh.elements()[e]) {
            let [x, y] = mesh.nodes()[node];
            j[0] = [j[0][0] + s[1] * x, j[0][1] + s[1] * y];
            j[1] = [j[1][0] + s[2] * x, j[1][1] + s[2] * y];
        }
        let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        [
            shape.iter().map(|s| s[0]).collect(),
            shape.iter().map(|s| (j[1][1] * s[1] - j[0][1] * s[2]) / det).collect(),
            shape.iter().map(|s| (j[0][0] * s[2] - j[1][0] * s[1]) / det).collect(),
        ]
    }
}

/// An edge of the reference square.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Edge {
    /// ξ = −1
    XiLow,
    /// ξ = +1
    XiHigh,
    /// η = −1
    EtaLow,
    /// η = +1
    EtaHigh,
}

impl Edge {
    /// Local numbers of the edge's nodes, along ξ or η.
    fn nodes(self, order: usize) -> Vec<usize> {
        let n = order + 1;
        (0..n)
            .map(|k| match self {
                Self::XiLow => k * n,
                Self::XiHigh => k * n + order,
                Self::EtaLow => k,
                Self::EtaHigh => order * n + k,
            })
            .collect()
    }
}

impl ReferenceElement {
    /// `∫ N N ds` along an edge of element `e` (times 2πx for a body of revolution), shape (nodes, nodes).
    pub fn edge_mass(&self, mesh: &Mesh, e: usize, edge: Edge, measure: Measure) -> DMatrix<f64> {
        let local = edge.nodes(mesh.order());
        let position = |k: usize| mesh.nodes()[mesh.elements()[e][local[k]]];
        let mut mass = DMatrix::zeros(mesh.elements()[e].len(), mesh.elements()[e].len());
        let Quadrature { points, weights } = gauss(mesh.order() + 2);
        for (point, weight) in points.iter().zip(&weights) {
            let (value, slope) = self.basis.evaluate(*point);
            let sum = |factors: &[f64], c: usize| factors.iter().enumerate().map(|(k, f)| f * position(k)[c]).sum::<f64>();
            let around = if measure == Measure::Revolution { TAU * sum(&value, 0) } else { 1.0 };
            let ds = weight * sum(&slope, 0).hypot(sum(&slope, 1)) * around;
            for (a, &i) in local.iter().enumerate() {
                for (b, &j) in local.iter().enumerate() {
                    mass[(i, j)] += ds * value[a] * value[b];
                }
            }
        }
        mass
    }
}
