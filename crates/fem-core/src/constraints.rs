//! Master–slave constraints `u_slave = factor · u_master`, eliminated so that the system stays symmetric positive definite.

use crate::{Error, Mesh};

/// Values of constrained unknowns, gathered before elimination.
#[derive(Debug, Clone)]
pub struct Constraints {
    /// parent and factor: u = factor · u_parent; a root is its own parent
    parent: Vec<(usize, f64)>,
    held: Vec<bool>,
}

/// Each full unknown in terms of the reduced ones: `u_full = factor · u_reduced`, or zero where it is held.
#[derive(Debug, Clone, PartialEq)]
pub struct DofMap {
    entries: Vec<Option<(usize, f64)>>,
    reduced: usize,
}

impl Constraints {
    /// No constraint on `unknowns` unknowns.
    pub fn new(unknowns: usize) -> Self {
        Self { parent: (0..unknowns).map(|i| (i, 1.0)).collect(), held: vec![false; unknowns] }
    }

    fn root(&self, mut i: usize) -> (usize, f64) {
        let mut factor = 1.0;
        while self.parent[i].0 != i {
            factor *= self.parent[i].1;
            i = self.parent[i].0;
        }
        (i, factor)
    }

    fn check(&self, i: usize) -> Result<(), Error> {
        if i < self.parent.len() {
            return Ok(());
        }
        Err(Error::Constraint(format!("unknown {i} of {}", self.parent.len())))
    }

    /// u_i = 0. No other value can be held: of prescribed values u₀ (zero at the other unknowns) and a load f, the rest w = u − u₀ is held
    /// at zero and solves `K w = f − K u₀`.
    ///
    /// ```
    /// use fem_core::{Constraints, Form, Mesh, Problem};
    /// use nalgebra::DMatrix;
    ///
    /// // a square, 20 °C at the bottom and 30 °C at the top
    /// let mesh = Mesh::rectangles(2, &[0.0, 1.0], &[0.0, 1.0], |_, _| Some(0))?;
    /// let problem = Problem::new(&mesh, Form::DIFFUSION, 3);
    /// let at = |y: f64| if y == 0.0 { Some(20.0) } else { (y == 1.0).then_some(30.0) };
    /// let known: Vec<Option<f64>> = mesh.nodes().iter().map(|[_, y]| at(*y)).collect();
    /// let mut constraints = Constraints::new(known.len());
    /// let all = constraints.eliminate(&problem.used(|_| true));
    /// (0..known.len()).filter(|i| known[*i].is_some()).try_for_each(|i| constraints.hold(i))?;
    /// let map = constraints.eliminate(&problem.used(|_| true));
    ///
    /// let laws = [Some(DMatrix::identity(2, 2))];
    /// let prescribed: Vec<f64> = known.iter().map(|t| t.unwrap_or(0.0)).collect();
    /// let load: Vec<f64> = problem.stiffness(&all, &laws)?.multiply(&prescribed).iter().map(|f| -f).collect();
    /// let rest = map.expand(&problem.factor(&map, &laws)?.solve(&[map.restrict(&load)])?[0]);
    /// for ((w, t), [_, y]) in rest.iter().zip(&prescribed).zip(mesh.nodes()) {
    ///     assert!((w + t - (20.0 + 10.0 * y)).abs() < 1e-12);
    /// }
    /// # Ok::<(), fem_core::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Constraint`] if there is no such unknown.
    pub fn hold(&mut self, i: usize) -> Result<(), Error> {
        self.check(i)?;
        let (root, _) = self.root(i);
        self.held[root] = true;
        Ok(())
    }

    /// u_r = 0 at every node on the axis r = 0, of [`crate::Form::AXISYMMETRIC_ELASTICITY`] on `mesh`: the axis of a body of revolution stays where
    /// it is. Nothing in the weak form says so, because the axis has no area.
    ///
    /// # Errors
    /// [`Error::Map`] unless there are two unknowns for each node.
    pub fn hold_axis(&mut self, mesh: &Mesh) -> Result<(), Error> {
        let (found, needed) = (self.parent.len(), 2 * mesh.nodes().len());
        if found != needed {
            return Err(Error::Map { found, needed, components: 2 });
        }
        mesh.on_axis().into_iter().try_for_each(|node| self.hold(2 * node))
    }

    /// u_slave = sign · u_master, sign +1 or −1. Chains and loops are resolved; a loop that demands u = −u holds u at zero.
    ///
    /// # Errors
    /// [`Error::Constraint`] if there is no such unknown, or the sign is neither.
    pub fn tie(&mut self, slave: usize, master: usize, sign: f64) -> Result<(), Error> {
        self.check(slave)?;
        self.check(master)?;
        if sign.abs() != 1.0 {
            return Err(Error::Constraint(format!("sign {sign} of a tie must be +1 or -1")));
        }
        let ((s, fs), (m, fm)) = (self.root(slave), self.root(master));
        if s == m {
            self.held[s] |= fs != sign * fm;
            return Ok(());
        }
        self.parent[s] = (m, sign * fm * fs);
        self.held[m] |= self.held[s];
        Ok(())
    }

    /// Root and factor of every unknown, each link followed once.
    fn roots(&self) -> Vec<(usize, f64)> {
        let mut roots: Vec<Option<(usize, f64)>> = vec![None; self.parent.len()];
        let mut path = Vec::new();
        for start in 0..self.parent.len() {
            let mut i = start;
            while roots[i].is_none() && self.parent[i].0 != i {
                path.push(i);
                i = self.parent[i].0;
            }
            let (root, mut factor) = *roots[i].get_or_insert((i, 1.0));
            while let Some(i) = path.pop() {
                factor *= self.parent[i].1;
                roots[i] = Some((root, factor));
            }
        }
        roots.into_iter().flatten().collect()
    }

    /// Numbers what is left, dropping also every unknown that `used` (one entry for each unknown) does not name.
    ///
    /// # Panics
    /// If `used` has another length than there are unknowns.
    pub fn eliminate(&self, used: &[bool]) -> DofMap {
        assert!(used.len() == self.parent.len(), "one entry of `used` for each of {} unknowns", self.parent.len());
        let roots = self.roots();
        let mut root_used = vec![false; roots.len()];
        for ((root, _), _) in roots.iter().zip(used).filter(|(_, used)| **used) {
            root_used[*root] = true;
        }
        let mut number = vec![None; roots.len()];
        let mut reduced = 0;
        for i in 0..roots.len() {
            if roots[i].0 == i && !self.held[i] && root_used[i] {
                number[i] = Some(reduced);
                reduced += 1;
            }
        }
        let entries = roots.iter().map(|(root, factor)| number[*root].map(|n| (n, *factor))).collect();
        DofMap { entries, reduced }
    }
}

impl DofMap {
    /// Number of unknowns of the reduced system.
    pub fn reduced(&self) -> usize {
        self.reduced
    }

    /// Number of unknowns before elimination.
    pub fn full(&self) -> usize {
        self.entries.len()
    }

    /// Reduced unknown and factor of full unknown `i`, or `None` if it is held at zero.
    pub fn get(&self, i: usize) -> Option<(usize, f64)> {
        self.entries[i]
    }

    /// Tᵀ f: a full load vector onto the reduced unknowns. Of values of the unknowns it makes sums over those that are tied: read single
    /// values with [`Self::get`].
    ///
    /// # Panics
    /// If `full` has not one entry for each full unknown.
    pub fn restrict(&self, full: &[f64]) -> Vec<f64> {
        assert!(full.len() == self.full(), "a load of {} entries for a map of {} unknowns", full.len(), self.full());
        let mut reduced = vec![0.0; self.reduced];
        for (entry, value) in self.entries.iter().zip(full) {
            if let Some((i, factor)) = entry {
                reduced[*i] += factor * value;
            }
        }
        reduced
    }

    /// T u: a reduced solution onto all unknowns.
    ///
    /// # Panics
    /// If `reduced` has not one entry for each reduced unknown.
    pub fn expand(&self, reduced: &[f64]) -> Vec<f64> {
        assert!(reduced.len() == self.reduced, "a solution of {} entries for {} reduced unknowns", reduced.len(), self.reduced);
        self.entries.iter().map(|entry| entry.map_or(0.0, |(i, factor)| factor * reduced[i])).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_chains_and_loops_of_ties_are_resolved() {
        let mut c = Constraints::new(6);
        c.tie(0, 1, -1.0).unwrap();
        c.tie(1, 2, -1.0).unwrap();
        c.tie(2, 0, 1.0).unwrap(); // consistent loop: nothing new
        c.tie(3, 4, 1.0).unwrap();
        c.tie(4, 3, -1.0).unwrap(); // demands u = -u
        let map = c.eliminate(&[true; 6]);
        assert_eq!(map.reduced(), 2);
        assert_eq!(map.expand(&[2.0, 5.0]), vec![2.0, -2.0, 2.0, 0.0, 0.0, 5.0]);
        assert_eq!(map.restrict(&[1.0, 10.0, 100.0, 7.0, 7.0, 3.0]), vec![91.0, 3.0]);
    }

    /// u0 = −u1 and u0 = u2, so u1 = −u2: the second tie reaches u1 through a slave.
    #[test]
    fn exact_a_slave_that_is_tied_again_carries_its_sign() {
        let mut c = Constraints::new(3);
        c.tie(0, 1, -1.0).unwrap();
        c.tie(0, 2, 1.0).unwrap();
        let map = c.eliminate(&[true; 3]);
        assert_eq!((map.reduced(), map.expand(&[4.0])), (1, vec![4.0, -4.0, 4.0]));
    }

    #[test]
    fn exact_a_long_chain_is_one_unknown() {
        let n = 200_000;
        let mut c = Constraints::new(n);
        for i in 1..n {
            c.tie(i - 1, i, -1.0).unwrap();
        }
        let map = c.eliminate(&vec![true; n]);
        assert_eq!(map.reduced(), 1);
        assert!(map.expand(&[1.0]).windows(2).all(|w| w[0] == -w[1]));
    }

    #[test]
    fn exact_a_hold_reaches_all_that_is_tied_before_or_after() {
        for held in 0..3 {
            for first in [true, false] {
                let mut c = Constraints::new(3);
                if first {
                    c.hold(held).unwrap();
                }
                c.tie(0, 1, -1.0).unwrap();
                c.tie(2, 1, 1.0).unwrap();
                if !first {
                    c.hold(held).unwrap();
                }
                assert_eq!(c.eliminate(&[true; 3]).reduced(), 0, "held {held}, first {first}");
            }
        }
    }

    #[test]
    fn exact_unknowns_that_nothing_uses_are_dropped() {
        let mut c = Constraints::new(4);
        c.tie(0, 1, -1.0).unwrap();
        let map = c.eliminate(&[true, false, false, true]);
        assert_eq!(map.reduced(), 2);
        assert_eq!([map.get(0), map.get(1), map.get(2), map.get(3)], [Some((0, -1.0)), Some((0, 1.0)), None, Some((1, 1.0))]);
    }

    #[test]
    fn bounds_what_is_no_unknown_or_no_sign_is_refused() {
        let mut c = Constraints::new(3);
        assert!(c.hold(3).is_err() && c.tie(0, 1, 0.5).is_err());
    }
}
