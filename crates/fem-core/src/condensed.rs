//! Static condensation: unknowns that live in one element only are eliminated there, and a smaller sparse system is factorised.

use crate::linear::{DenseFactor, PROBE_ERROR_LIMIT, largest, probe};
use crate::sparse::{ElementDofs, element_dofs};
use crate::{DofMap, Error, Factor, Mesh, Pattern};
use nalgebra::DMatrix;

/// A symmetric positive definite system, condensed to the unknowns on element boundaries and factorised.
#[derive(Debug, Clone)]
pub struct Condensed {
    unknowns: usize,
    elements: Vec<Element>,
    /// reduced number of each boundary unknown
    boundary: Vec<usize>,
    schur: Factor,
}

/// What an element needs to eliminate and recover its inner unknowns.
#[derive(Debug, Clone)]
struct Element {
    inner: Vec<usize>,
    /// boundary unknown of each column of `coupling`
    outer: Vec<usize>,
    /// K_ii
    factor: DenseFactor,
    /// K_ii⁻¹ K_io
    coupling: DMatrix<f64>,
}

impl Condensed {
    /// Condenses the sum of `element_matrices`, one per element of `mesh` (an empty one where the element takes no part), with the
    /// unknowns of `map`.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`]; [`Error::Residual`] if a factor does not solve.
    pub fn new(mesh: &Mesh, map: &DofMap, element_matrices: &[DMatrix<f64>]) -> Result<Self, Error> {
        let dofs = element_dofs(mesh, map);
        let active: Vec<usize> = (0..dofs.len()).filter(|&e| element_matrices[e].nrows() > 0).collect();
        let mut uses = vec![0usize; map.reduced()];
        for (unknown, _) in active.iter().flat_map(|&e| dofs[e].iter().flatten()) {
            uses[*unknown] += 1;
        }
        let boundary: Vec<usize> = (0..map.reduced()).filter(|&i| uses[i] > 1).collect();
        let mut number = vec![usize::MAX; map.reduced()];
        boundary.iter().enumerate().for_each(|(n, &i)| number[i] = n);
        let (mut elements, mut reduced, mut outer_dofs) = (Vec::new(), Vec::new(), Vec::new());
        for &e in &active {
            let (element, schur) = Element::condense(&element_matrices[e], &dofs[e], &number)?;
            // factors of ties are in the matrix already
            outer_dofs.push(element.outer.iter().map(|n| Some((*n, 1.0))).collect::<ElementDofs>());
            elements.push(element);
            reduced.push(schur);
        }
        let columns: Vec<_> = outer_dofs.iter().cloned().enumerate().collect();
        let pattern = Pattern::of_elements(boundary.len(), outer_dofs, boundary.len(), &columns);
        let schur = Factor::new(pattern.assemble(&reduced))?;
        let condensed = Self { unknowns: map.reduced(), elements, boundary, schur };
        condensed.check(&active, &dofs, element_matrices)?;
        Ok(condensed)
    }

    /// Number of unknowns, inner ones included.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Number of unknowns of the condensed system.
    pub fn boundary_unknowns(&self) -> usize {
        self.boundary.len()
    }

    /// Solves for a known solution of the uncondensed system.
    fn check(&self, active: &[usize], dofs: &[ElementDofs], element_matrices: &[DMatrix<f64>]) -> Result<(), Error> {
        let known = probe(self.unknowns);
        let mut rhs = vec![0.0; self.unknowns];
        for &e in active {
            let local = dofs[e].iter().map(|d| d.map_or(0.0, |(i, factor)| factor * known[i]));
            let product = &element_matrices[e] * nalgebra::DVector::from_iterator(dofs[e].len(), local);
            for (dof, value) in dofs[e].iter().zip(product.iter()) {
                dof.iter().for_each(|(i, factor)| rhs[*i] += factor * value);
            }
        }
        let found = &self.solve(&[rhs])?[0];
        let error = largest(&found.iter().zip(&known).map(|(a, b)| a - b).collect::<Vec<_>>()) / 2.0;
        if error <= PROBE_ERROR_LIMIT {
            return Ok(());
        }
        let detail = format!("singular to rounding: a known solution came back with a relative error of {error:.1e}");
        Err(Error::NotPositiveDefinite { unknowns: self.unknowns, detail })
    }

    /// Solves for all right-hand sides (each of length [`Self::unknowns`]) together.
    ///
    /// # Errors
    /// As [`Factor::solve`].
    ///
    /// # Panics
    /// If a right-hand side has another length.
    pub fn solve(&self, rhs: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        assert!(rhs.iter().all(|b| b.len() == self.unknowns), "right-hand sides of {} entries", self.unknowns);
        let mut condensed: Vec<Vec<f64>> = rhs.iter().map(|b| self.boundary.iter().map(|&i| b[i]).collect()).collect();
        for element in &self.elements {
            let inner = DMatrix::from_fn(element.inner.len(), rhs.len(), |i, j| rhs[j][element.inner[i]]);
            let passed_on = element.coupling.tr_mul(&inner);
            for (j, b) in condensed.iter_mut().enumerate() {
                element.outer.iter().enumerate().for_each(|(k, n)| b[*n] -= passed_on[(k, j)]);
            }
        }
        let outer = self.schur.solve(&condensed)?;
        let mut solutions = vec![vec![0.0; self.unknowns]; rhs.len()];
        for (x, outer) in solutions.iter_mut().zip(&outer) {
            self.boundary.iter().zip(outer).for_each(|(&i, u)| x[i] = *u);
        }
        for element in &self.elements {
            let inner = element.factor.solve(&DMatrix::from_fn(element.inner.len(), rhs.len(), |i, j| rhs[j][element.inner[i]]));
            let around = DMatrix::from_fn(element.outer.len(), rhs.len(), |k, j| outer[j][element.outer[k]]);
            let inner = inner - &element.coupling * around;
            for (j, x) in solutions.iter_mut().enumerate() {
                element.inner.iter().enumerate().for_each(|(i, &dof)| x[dof] = inner[(i, j)]);
            }
        }
        Ok(solutions)
    }
}

impl Element {
    /// Eliminates the unknowns whose `number` is none: the element with its Schur complement.
    fn condense(matrix: &DMatrix<f64>, dofs: &ElementDofs, number: &[usize]) -> Result<(Self, DMatrix<f64>), Error> {
        let entries = |inside: bool| {
            let wanted = move |(local, dof): (usize, &Option<(usize, f64)>)| {
                dof.filter(|(i, _)| (number[*i] == usize::MAX) == inside).map(|(i, factor)| (local, i, factor))
            };
            dofs.iter().enumerate().filter_map(wanted).collect::<Vec<_>>()
        };
        let (inner, outer) = (entries(true), entries(false));
        let block = |rows: &[(usize, usize, f64)], columns: &[(usize, usize, f64)]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| rows[i].2 * columns[j].2 * matrix[(rows[i].0, columns[j].0)])
        };
        let factor = DenseFactor::new(&block(&inner, &inner))?;
        let across = block(&inner, &outer);
        let coupling = factor.solve(&across);
        let schur = block(&outer, &outer) - across.transpose() * &coupling;
        let outer = outer.iter().map(|(_, i, _)| number[*i]).collect();
        Ok((Self { inner: inner.iter().map(|(_, i, _)| *i).collect(), outer, factor, coupling }, schur))
    }
}
