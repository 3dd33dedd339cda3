//! A sparse system as a tree of small dense ones: unknowns that live in one element only are eliminated there (static condensation),
//! those that two groups of elements share where the groups meet (nested dissection).
//!
//! A. George, *Nested dissection of a regular finite element mesh* (1973); I. S. Duff and J. K. Reid (1983), the multifrontal method.

use crate::linear::{BACKWARD_ERROR_LIMIT, PartialFactor, check_backward, check_probe, largest, probe};
use crate::sparse::{ElementDofs, element_dofs};
use crate::{DofMap, Error, Mesh};
use nalgebra::{DMatrix, DVector};

/// A symmetric positive definite system, condensed to the unknowns on element boundaries and factorised.
#[derive(Debug, Clone)]
pub struct Condensed {
    unknowns: usize,
    elements: Vec<Element>,
    /// those that a front passes unknowns on to come after it
    fronts: Vec<Front>,
}

/// Unknowns of which the first ones are eliminated.
#[derive(Debug, Clone)]
struct Front {
    unknowns: Vec<usize>,
    factor: PartialFactor,
}

/// An element and what is left of its matrix without its inner unknowns.
#[derive(Debug, Clone)]
struct Element {
    front: Front,
    left: DMatrix<f64>,
}

impl Condensed {
    /// Condenses the sum of `element_matrices`, one per element of `mesh` (an empty one where the element takes no part), with the
    /// unknowns of `map`.
    ///
    /// # Errors
    /// [`Error::NotPositiveDefinite`]; [`Error::Residual`] if a factor does not solve.
    pub fn new(mesh: &Mesh, map: &DofMap, element_matrices: &[DMatrix<f64>]) -> Result<Self, Error> {
        Self::assemble(mesh, map, |e| element_matrices[e].nrows() > 0, element_matrices.iter().cloned().map(Ok))
    }

    /// As [`Self::new`], from a matrix for each element, of which those that are not `active` are not used.
    pub(crate) fn assemble(
        mesh: &Mesh,
        map: &DofMap,
        active: impl Fn(usize) -> bool,
        element_matrices: impl Iterator<Item = Result<DMatrix<f64>, Error>>,
    ) -> Result<Self, Error> {
        let dofs = element_dofs(mesh, map);
        let mut assembly = Assembly::new(map.reduced());
        let unknowns: Vec<_> = dofs.iter().enumerate().map(|(e, dofs)| active(e).then(|| assembly.open(dofs))).collect();
        let known = probe(map.reduced());
        let mut load = vec![0.0; map.reduced()];
        let (mut elements, mut order) = (Vec::new(), Vec::new());
        for (e, (unknowns, matrix)) in unknowns.into_iter().zip(element_matrices).enumerate() {
            let (Some(unknowns), matrix) = (unknowns, matrix?) else { continue };
            multiply(&matrix, &dofs[e], &known, &mut load);
            order.push((elements.len(), centre(mesh, e)));
            elements.push(assembly.condense(unknowns, &dofs[e], &matrix)?);
        }
        let mut fronts = Vec::new();
        assembly.dissect(&elements, &mut order, &mut fronts)?;
        let condensed = Self { unknowns: map.reduced(), elements, fronts };
        let mut x = [load];
        condensed.elements.iter().for_each(|e| e.front.forward(&mut x));
        condensed.substitute(&mut x);
        condensed.elements.iter().for_each(|e| e.front.backward(&mut x));
        check_probe(&x[0], &known)?;
        Ok(condensed)
    }

    /// Number of unknowns, inner ones included.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Solves for all right-hand sides (each of length [`Self::unknowns`]) together; the condensed system is refined once and its
    /// residuals checked.
    ///
    /// # Errors
    /// [`Error::Residual`] if a backward error exceeds [`BACKWARD_ERROR_LIMIT`], as when a right-hand side is not finite.
    ///
    /// # Panics
    /// If a right-hand side has another length.
    pub fn solve(&self, rhs: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, Error> {
        assert!(rhs.iter().all(|b| b.len() == self.unknowns), "right-hand sides of {} entries", self.unknowns);
        let mut x = rhs.to_vec();
        self.elements.iter().for_each(|e| e.front.forward(&mut x));
        let condensed = x.clone();
        self.substitute(&mut x);
        let (mut step, _) = self.residual(&x, &condensed);
        self.substitute(&mut step);
        // an inner unknown has no residual, and no step
        for (x, step) in x.iter_mut().zip(&step) {
            x.iter_mut().zip(step).for_each(|(x, step)| *x += step);
        }
        self.check_residual(&x, &condensed)?;
        self.elements.iter().for_each(|e| e.front.backward(&mut x));
        if x.iter().flatten().any(|x| !x.is_finite()) {
            return Err(Error::Residual { backward_error: f64::NAN, limit: BACKWARD_ERROR_LIMIT, unknowns: self.unknowns });
        }
        Ok(x)
    }

    /// Solves the condensed system in place.
    fn substitute(&self, x: &mut [Vec<f64>]) {
        self.fronts.iter().for_each(|front| front.forward(x));
        self.fronts.iter().rev().for_each(|front| front.backward(x));
    }

    /// `b − A x` of the condensed system, zero at inner unknowns, and for each column the largest of `|A| |x|`.
    fn residual(&self, x: &[Vec<f64>], b: &[Vec<f64>]) -> (Vec<Vec<f64>>, Vec<f64>) {
        let mut residual = b.to_vec();
        let mut size = vec![vec![0.0; self.unknowns]; x.len()];
        let (mut product, mut magnitude) = (Vec::new(), Vec::new());
        for Element { front, left } in &self.elements {
            let (inner, outer) = front.unknowns.split_at(front.factor.inner);
            for ((x, residual), size) in x.iter().zip(&mut residual).zip(&mut size) {
                product.clear();
                product.resize(outer.len(), 0.0);
                magnitude.clone_from(&product);
                for (&j, column) in outer.iter().zip(left.as_slice().chunks_exact(outer.len().max(1))) {
                    let x = x[j];
                    for ((p, m), a) in product.iter_mut().zip(&mut magnitude).zip(column) {
                        *p += a * x;
                        *m += (a * x).abs();
                    }
                }
                inner.iter().for_each(|&i| residual[i] = 0.0);
                for ((&i, p), m) in outer.iter().zip(&product).zip(&magnitude) {
                    residual[i] -= p;
                    size[i] += m;
                }
            }
        }
        (residual, size.iter().map(|size| largest(size)).collect())
    }

    fn check_residual(&self, x: &[Vec<f64>], b: &[Vec<f64>]) -> Result<(), Error> {
        let (residual, size) = self.residual(x, b);
        let outer = || self.elements.iter().flat_map(|e| &e.front.unknowns[e.front.factor.inner..]);
        for ((b, residual), size) in b.iter().zip(&residual).zip(size) {
            let size = size + outer().fold(0.0f64, |size, &i| size.max(b[i].abs()));
            check_backward(residual, size)?;
        }
        Ok(())
    }
}

/// Adds an element's part of `A x`.
fn multiply(matrix: &DMatrix<f64>, dofs: &ElementDofs, x: &[f64], sum: &mut [f64]) {
    let local = dofs.iter().map(|dof| dof.map_or(0.0, |(i, factor)| factor * x[i]));
    let product = matrix * DVector::from_iterator(dofs.len(), local);
    for ((i, factor), value) in dofs.iter().zip(product.iter()).filter_map(|(dof, value)| Some((dof.as_ref()?, value))) {
        sum[*i] += factor * value;
    }
}

fn gather(unknowns: &[usize], x: &[Vec<f64>]) -> DMatrix<f64> {
    DMatrix::from_fn(unknowns.len(), x.len(), |i, j| x[j][unknowns[i]])
}

fn scatter(unknowns: &[usize], values: &DMatrix<f64>, x: &mut [Vec<f64>]) {
    for (x, values) in x.iter_mut().zip(values.column_iter()) {
        unknowns.iter().zip(values.iter()).for_each(|(&i, value)| x[i] = *value);
    }
}

impl Front {
    fn forward(&self, x: &mut [Vec<f64>]) {
        let mut values = gather(&self.unknowns, x);
        self.factor.forward(&mut values);
        scatter(&self.unknowns, &values, x);
    }

    fn backward(&self, x: &mut [Vec<f64>]) {
        let mut values = gather(&self.unknowns, x);
        self.factor.backward(&mut values);
        scatter(&self.unknowns[..self.factor.inner], &values, x);
    }
}

fn centre(mesh: &Mesh, e: usize) -> [f64; 2] {
    let sum = |c: usize| mesh.elements()[e].iter().map(|&node| mesh.nodes()[node][c]).sum();
    [sum(0), sum(1)]
}

/// Bookkeeping of elimination for each unknown, and work space.
struct Assembly {
    /// number of fronts that an unknown is still in
    open: Vec<usize>,
    /// place of an unknown in the front at hand
    place: Vec<usize>,
    /// of the elements at hand: all that hold an unknown, those below a cut
    uses: Vec<[usize; 2]>,
}

const NOWHERE: usize = usize::MAX;

impl Assembly {
    fn new(unknowns: usize) -> Self {
        Self { open: vec![0; unknowns], place: vec![NOWHERE; unknowns], uses: vec![[0; 2]; unknowns] }
    }

    /// The unknowns of an element, which is a front of theirs. Ties may name one unknown several times.
    fn open(&mut self, dofs: &ElementDofs) -> Vec<usize> {
        let mut unknowns = Vec::with_capacity(dofs.len());
        for (i, _) in dofs.iter().flatten() {
            if self.place[*i] == NOWHERE {
                self.place[*i] = 0;
                self.open[*i] += 1;
                unknowns.push(*i);
            }
        }
        unknowns.iter().for_each(|&i| self.place[i] = NOWHERE);
        unknowns
    }

    /// Puts the unknowns that are in no other front first, notes the place of each, and returns how many they are.
    fn sort(&mut self, unknowns: &mut Vec<usize>) -> usize {
        let (mut sorted, outer): (Vec<usize>, Vec<usize>) = unknowns.iter().partition(|&&i| self.open[i] == 1);
        let inner = sorted.len();
        sorted.extend(outer);
        sorted.iter().enumerate().for_each(|(k, &i)| self.place[i] = k);
        *unknowns = sorted;
        inner
    }

    /// Eliminates the unknowns of an element that are in no other.
    fn condense(&mut self, mut unknowns: Vec<usize>, dofs: &ElementDofs, matrix: &DMatrix<f64>) -> Result<Element, Error> {
        let inner = self.sort(&mut unknowns);
        let placed = dofs.iter().enumerate().filter_map(|(local, dof)| dof.map(|(i, factor)| (self.place[i], local, factor)));
        let mut placed: Vec<(usize, usize, f64)> = placed.collect();
        placed.sort_unstable_by_key(|p| p.0);
        let rows = unknowns.len();
        let mut sorted = DMatrix::zeros(rows, rows);
        let mut first = 0;
        for &(column, b, scale) in &placed {
            while placed[first].0 < column {
                first += 1;
            }
            let (from, to) =
                (&matrix.as_slice()[b * dofs.len()..][..dofs.len()], &mut sorted.as_mut_slice()[column * rows..][..rows]);
            if placed.len() == rows {
                let below = placed[first..].iter().zip(&mut to[first..]);
                below.for_each(|(&(_, a, factor), to)| *to = scale * factor * from[a]);
            } else {
                placed[first..].iter().for_each(|&(row, a, factor)| to[row] += scale * factor * from[a]);
            }
        }
        unknowns.iter().for_each(|&i| self.place[i] = NOWHERE);
        let (factor, mut left) = PartialFactor::new(sorted, inner)?;
        left.fill_upper_triangle_with_lower_triangle();
        Ok(Element { front: Front { unknowns, factor }, left })
    }

    /// Eliminates all that the elements in `order` (with their centres) share with no other, and adds the fronts; returns the unknowns
    /// that are left and the lower triangle of their matrix.
    fn dissect(
        &mut self,
        elements: &[Element],
        order: &mut [(usize, [f64; 2])],
        fronts: &mut Vec<Front>,
    ) -> Result<(Vec<usize>, DMatrix<f64>), Error> {
        match order {
            [] => return Ok((Vec::new(), DMatrix::zeros(0, 0))),
            [(e, _)] => {
                let Element { front, left } = &elements[*e];
                return Ok((front.unknowns[front.factor.inner..].to_vec(), left.clone()));
            }
            _ => {}
        }
        let cut = self.cut(elements, order);
        let (low, high) = order.split_at_mut(cut);
        let parts = [self.dissect(elements, low, fronts)?, self.dissect(elements, high, fronts)?];
        let mut unknowns: Vec<usize> = Vec::new();
        for &i in parts.iter().flat_map(|(part, _)| part) {
            if self.place[i] == NOWHERE {
                self.place[i] = 0;
                unknowns.push(i);
            } else {
                self.open[i] -= 1;
            }
        }
        let inner = self.sort(&mut unknowns);
        let mut matrix = DMatrix::zeros(unknowns.len(), unknowns.len());
        for (part, left) in &parts {
            let places: Vec<usize> = part.iter().map(|&i| self.place[i]).collect();
            for (j, &column) in places.iter().enumerate() {
                for (i, &row) in places.iter().enumerate().skip(j) {
                    matrix[(row.max(column), row.min(column))] += left[(i, j)];
                }
            }
        }
        unknowns.iter().for_each(|&i| self.place[i] = NOWHERE);
        let (factor, left) = PartialFactor::new(matrix, inner)?;
        let outer = unknowns[inner..].to_vec();
        fronts.push(Front { unknowns, factor });
        Ok((outer, left))
    }

    /// Sorts the elements along the axis, and returns the place in the middle third, where a cut severs the fewest unknowns.
    fn cut(&mut self, elements: &[Element], order: &mut [(usize, [f64; 2])]) -> usize {
        let outer = |e: usize| &elements[e].front.unknowns[elements[e].front.factor.inner..];
        let n = order.len();
        let margin = (n / 3).max(1);
        let mut best = (usize::MAX, 0, 0);
        let along = |axis: usize| {
            move |a: &(usize, [f64; 2]), b: &(usize, [f64; 2])| {
                a.1[axis].total_cmp(&b.1[axis]).then(a.1[1 - axis].total_cmp(&b.1[1 - axis]))
            }
        };
        let uses = &mut self.uses;
        for axis in [0, 1] {
            order.sort_by(along(axis));
            for (e, _) in order.iter() {
                outer(*e).iter().for_each(|&i| uses[i] = [uses[i][0] + 1, 0]);
            }
            let mut severed = 0usize;
            for (k, (e, _)) in order.iter().enumerate() {
                for &i in outer(*e) {
                    let [all, below] = &mut uses[i];
                    severed += usize::from(*below == 0 && *all > 1);
                    *below += 1;
                    severed -= usize::from(*below == *all && *all > 1);
                }
                let cut = k + 1;
                if cut >= margin && cut <= n - margin && severed < best.0 {
                    best = (severed, axis, cut);
                }
            }
            for (e, _) in order.iter() {
                outer(*e).iter().for_each(|&i| uses[i] = [0, 0]);
            }
        }
        order.sort_by(along(best.1));
        best.2
    }
}
