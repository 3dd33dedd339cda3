//! The weak forms: which derivative of which displacement makes which strain.
//!
//! Every form is `∫ (B v)ᵀ D (B u)` with a strain operator `B` that is a short list of terms and a constitutive matrix `D`
//! that is constant in each region. Element matrices are sums of `D_ts (O_tᵀ W O_s)` over the operators O.

use crate::geometry::{ElementGeometry, Measure};
use nalgebra::{DMatrix, DVector};

/// A derivative (or quotient) of a scalar shape function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// ∂N/∂x
    DX,
    /// ∂N/∂y
    DY,
    /// N/x: the hoop strain of a radial displacement
    OverX,
}

/// `strain[strain] += operator(u[component])`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Term {
    strain: usize,
    operator: Operator,
    component: usize,
}

const fn term(strain: usize, operator: Operator, component: usize) -> Term {
    Term { strain, operator, component }
}

/// A weak form: strain operator and measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Form {
    /// Unknowns per node.
    pub components: usize,
    /// Number of strains.
    pub strains: usize,
    terms: &'static [Term],
    /// Measure of the integrals.
    pub measure: Measure,
}

impl Form {
    /// Conduction or antiplane shear in the plane: strains (∂u/∂x, ∂u/∂y).
    pub const DIFFUSION: Self =
        Self { components: 1, strains: 2, terms: &[term(0, Operator::DX, 0), term(1, Operator::DY, 0)], measure: Measure::Area };

    /// Generalised plane strain: strains (xx, yy, xy); zz is prescribed by the load.
    pub const PLANE_STRAIN: Self = Self {
        components: 2,
        strains: 3,
        terms: &[term(0, Operator::DX, 0), term(1, Operator::DY, 1), term(2, Operator::DY, 0), term(2, Operator::DX, 1)],
        measure: Measure::Area,
    };

    /// Axisymmetric conduction in (r, y).
    pub const AXISYMMETRIC_DIFFUSION: Self = Self { measure: Measure::Revolution, ..Self::DIFFUSION };

    /// Axisymmetric elasticity in (r, y): strains (rr, yy, hoop, ry), displacements (u_r, u_y).
    ///
    /// A body that touches r = 0 needs u_r held there ([`crate::Constraints::hold_axis`]): the hoop strain u_r/r is integrated at points off the
    /// axis, so the form itself would not notice that the axis moves. A stiffness with a free axis is refused ([`crate::Error::Axis`]).
    pub const AXISYMMETRIC_ELASTICITY: Self = Self {
        components: 2,
        strains: 4,
        terms: &[
            term(0, Operator::DX, 0),
            term(1, Operator::DY, 1),
            term(2, Operator::OverX, 0),
            term(3, Operator::DY, 0),
            term(3, Operator::DX, 1),
        ],
        measure: Measure::Revolution,
    };

    fn operator(&self, operator: Operator, value: &DMatrix<f64>, g: &ElementGeometry) -> DMatrix<f64> {
        match operator {
            Operator::DX => g.d_x.clone(),
            Operator::DY => g.d_y.clone(),
            Operator::OverX => DMatrix::from_fn(value.nrows(), value.ncols(), |a, k| value[(a, k)] / g.x[k]),
        }
    }

    /// Component that is divided by the radius, and so vanishes on the axis of a body of revolution.
    pub(crate) fn over_radius(&self) -> Option<usize> {
        self.terms.iter().find(|term| term.operator == Operator::OverX).map(|term| term.component)
    }

    fn operators(&self) -> Vec<Operator> {
        let used = |operator: &Operator| self.terms.iter().any(|t| t.operator == *operator);
        [Operator::DX, Operator::DY, Operator::OverX].into_iter().filter(used).collect()
    }

    /// Element stiffness `∫ Bᵀ D B`, unknowns node by node (component fastest). `d` is (strains × strains), symmetric.
    pub fn stiffness(&self, value: &DMatrix<f64>, g: &ElementGeometry, d: &DMatrix<f64>) -> DMatrix<f64> {
        let list = self.operators();
        let left: Vec<_> = list.iter().map(|&o| self.operator(o, value, g)).collect();
        let (n, c) = (value.nrows(), self.components);
        let mut k = DMatrix::zeros(n * c, n * c);
        for (s, right) in list.iter().zip(&left) {
            let weighted = weighted(right, g, 1.0);
            for (t, left) in list.iter().zip(&left) {
                let product = left * &weighted;
                self.scatter(&mut k, &product, (*t, *s), d);
            }
        }
        k
    }

    /// Adds `D_ts product` wherever the operators of two terms are the given pair.
    fn scatter(&self, k: &mut DMatrix<f64>, product: &DMatrix<f64>, pair: (Operator, Operator), d: &DMatrix<f64>) {
        let (n, c) = (product.nrows(), self.components);
        for t in self.terms.iter().filter(|t| t.operator == pair.0) {
            for s in self.terms.iter().filter(|s| s.operator == pair.1) {
                let factor = d[(t.strain, s.strain)];
                if factor != 0.0 {
                    for b in 0..n {
                        for a in 0..n {
                            k[(a * c + t.component, b * c + s.component)] += factor * product[(a, b)];
                        }
                    }
                }
            }
        }
    }

    /// Strains where the shape functions and their gradients are N, ∂N/∂x, ∂N/∂y at a distance x from the axis, of an element's unknowns, component fastest.
    pub(crate) fn strain(&self, [value, dx, dy]: [&[f64]; 3], x: f64, unknowns: &[f64]) -> Vec<f64> {
        let mut strain = vec![0.0; self.strains];
        for t in self.terms {
            let (shape, by) = match t.operator {
                Operator::DX => (dx, 1.0),
                Operator::DY => (dy, 1.0),
                Operator::OverX => (value, x),
            };
            let component = unknowns.iter().skip(t.component).step_by(self.components);
            strain[t.strain] += shape.iter().zip(component).map(|(shape, u)| shape * u).sum::<f64>() / by;
        }
        strain
    }

    /// Element load `∫ Bᵀ σ` of a stress that is constant in the element (length `strains`).
    pub fn load(&self, value: &DMatrix<f64>, g: &ElementGeometry, stress: &[f64]) -> DVector<f64> {
        let (n, c) = (value.nrows(), self.components);
        let weight = DVector::from_column_slice(&g.weight);
        let mut f = DVector::zeros(n * c);
        for t in self.terms.iter().filter(|t| stress[t.strain] != 0.0) {
            let integral = self.operator(t.operator, value, g) * &weight;
            for a in 0..n {
                f[a * c + t.component] += stress[t.strain] * integral[a];
            }
        }
        f
    }

    /// Coupling `∫ Bᵀ β N`: the load of a scalar nodal field that stresses the element by `β` per unit.
    /// Shape (nodes × components, nodes).
    pub fn coupling(&self, value: &DMatrix<f64>, g: &ElementGeometry, beta: &[f64]) -> DMatrix<f64> {
        let (n, c) = (value.nrows(), self.components);
        let weighted = weighted(value, g, 1.0);
        let mut h = DMatrix::zeros(n * c, n);
        for t in self.terms.iter().filter(|t| beta[t.strain] != 0.0) {
            let product = self.operator(t.operator, value, g) * &weighted;
            for b in 0..n {
                for a in 0..n {
                    h[(a * c + t.component, b)] += beta[t.strain] * product[(a, b)];
                }
            }
        }
        h
    }

    /// Element mass `∫ N c N` of a scalar field.
    pub fn mass(value: &DMatrix<f64>, g: &ElementGeometry, capacity: f64) -> DMatrix<f64> {
        value * weighted(value, g, capacity)
    }
}

/// The transpose, each point's row times its weight and a factor.
fn weighted(functions: &DMatrix<f64>, g: &ElementGeometry, factor: f64) -> DMatrix<f64> {
    let mut weighted = functions.transpose();
    for (mut row, w) in weighted.row_iter_mut().zip(&g.weight) {
        row *= *w * factor;
    }
    weighted
}
