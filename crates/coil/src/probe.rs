//! A point in a mesh: values and gradients of a field there.

use crate::grid::Along;
use crate::{Error, Grid, Region};
use std::collections::HashMap;
use std::sync::Arc;

/// The element (or elements) that hold a point, with their shape functions along r and along y there.
///
/// A point between elements takes the mean of their values: gradients jump there, and the mean keeps mirror symmetry.
#[derive(Debug, Clone)]
pub(crate) struct Probe {
    r: f64,
    hits: Vec<Hit>,
}

#[derive(Debug, Clone)]
struct Hit {
    /// rows along r
    nodes: Arc<[usize]>,
    r: Arc<Along>,
    y: Arc<Along>,
}

/// Probes that share the shape functions of equal coordinates.
pub(crate) struct Prober<'g> {
    grid: &'g Grid,
    r: HashMap<u64, Vec<Arc<Along>>>,
    y: HashMap<u64, Vec<Arc<Along>>>,
    nodes: Vec<Option<Arc<[usize]>>>,
}

/// Weighted sums over probes, as functionals of a nodal field.
#[derive(Debug, Clone)]
pub(crate) struct Sums {
    /// Of the value.
    pub(crate) value: Vec<f64>,
    /// Of the value over r.
    pub(crate) over_r: Vec<f64>,
    /// Of ∂/∂r.
    pub(crate) d_r: Vec<f64>,
    /// Of ∂/∂y.
    pub(crate) d_y: Vec<f64>,
}

impl Grid {
    /// The point (r, y), which must lie in the mesh. `field` is for the message.
    pub(crate) fn probe(&self, field: &str, r: f64, y: f64) -> Result<Probe, Error> {
        Prober::new(self).probe(field, r, y)
    }
}

impl<'g> Prober<'g> {
    pub(crate) fn new(grid: &'g Grid) -> Self {
        Self { grid, r: HashMap::new(), y: HashMap::new(), nodes: vec![None; grid.regions().len()] }
    }

    /// The point (r, y), which must lie in the mesh; a turn's centre (`field` "winding") in the coil. `field` is for the message.
    pub(crate) fn probe(&mut self, field: &str, r: f64, y: f64) -> Result<Probe, Error> {
        let grid = self.grid;
        let columns = self.r.entry(r.to_bits()).or_insert_with(|| grid.columns(r).into_iter().map(Arc::new).collect());
        let rows = self.y.entry(y.to_bits()).or_insert_with(|| grid.rows(y).into_iter().map(Arc::new).collect());
        let (mut hits, mut inside) = (Vec::with_capacity(1), false);
        for (row, column) in rows.iter().flat_map(|row| columns.iter().map(move |column| (row, column))) {
            let Some(element) = grid.element(column.cell, row.cell) else { continue };
            inside = true;
            if field == "winding" && grid.regions()[element] != Region::Coil {
                continue;
            }
            let nodes = self.nodes[element].get_or_insert_with(|| grid.mesh().elements()[element].as_slice().into());
            hits.push(Hit { nodes: nodes.clone(), r: column.clone(), y: row.clone() });
        }
        if !inside {
            let remedy = if field == "winding" { "; enlarge the coil, or wind fewer layers or turns" } else { "" };
            return Err(Error::design(field, format!("the point r = {r} m, y = {y} m lies outside the mesh{remedy}")));
        }
        if hits.is_empty() {
            let problem = format!("the turn at r = {r} m, y = {y} m lies outside the coil; enlarge the coil");
            return Err(Error::design(field, problem));
        }
        Ok(Probe { r, hits })
    }
}

impl Hit {
    /// `Σ a_i b_j field_ij` with a along r and b along y.
    fn sum(&self, along_r: &[f64], along_y: &[f64], field: impl Fn(usize) -> f64) -> f64 {
        let row = |nodes: &[usize]| nodes.iter().zip(along_r).map(|(&node, a)| a * field(node)).sum::<f64>();
        self.nodes.chunks_exact(along_r.len()).zip(along_y).map(|(nodes, b)| b * row(nodes)).sum()
    }
}

impl Probe {
    fn mean(&self, of: impl Fn(&Hit) -> f64) -> f64 {
        self.hits.iter().map(of).sum::<f64>() / self.hits.len() as f64
    }

    /// Value of a nodal field.
    pub(crate) fn value_of(&self, field: &[f64]) -> f64 {
        self.mean(|hit| hit.sum(&hit.r.value, &hit.y.value, |node| field[node]))
    }

    /// Strains rr, yy, hoop of the displacement (u_r, u_y), component fastest.
    pub(crate) fn strain_of(&self, u: &[f64]) -> [f64; 3] {
        let (u_r, u_y) = (|node: usize| u[2 * node], |node: usize| u[2 * node + 1]);
        [
            self.mean(|hit| hit.sum(&hit.r.slope, &hit.y.value, u_r)),
            self.mean(|hit| hit.sum(&hit.r.value, &hit.y.slope, u_y)),
            self.mean(|hit| hit.sum(&hit.r.value, &hit.y.value, u_r)) / self.r,
        ]
    }

    /// Engineering shear ry of the displacement (u_r, u_y), component fastest.
    pub(crate) fn shear_of(&self, u: &[f64]) -> f64 {
        self.mean(|hit| {
            hit.sum(&hit.r.value, &hit.y.slope, |node| u[2 * node]) + hit.sum(&hit.r.slope, &hit.y.value, |node| u[2 * node + 1])
        })
    }

    /// A component of the displacement (u_r, u_y), component fastest.
    pub(crate) fn component_of(&self, u: &[f64], component: usize) -> f64 {
        self.mean(|hit| hit.sum(&hit.r.value, &hit.y.value, |node| u[2 * node + component]))
    }

    /// Adds `factor` times the value to a functional of a nodal field.
    pub(crate) fn add_value(&self, functional: &mut [f64], factor: f64) {
        let share = factor / self.hits.len() as f64;
        for hit in &self.hits {
            for (nodes, b) in hit.nodes.chunks_exact(hit.r.value.len()).zip(&hit.y.value) {
                nodes.iter().zip(&hit.r.value).for_each(|(&node, a)| functional[node] += share * a * b);
            }
        }
    }
}

impl Sums {
    /// Sums over `probes` with `weights`, for fields of `nodes` nodes.
    ///
    /// Turns of one layer in one element differ in y alone, so they are summed along y before the product with the functions along r.
    pub(crate) fn new(probes: &[Probe], weights: impl IntoIterator<Item = f64>, nodes: usize) -> Self {
        let zeros = || vec![0.0; nodes];
        let mut sums = Self { value: zeros(), over_r: zeros(), d_r: zeros(), d_y: zeros() };
        let hits =
            probes.iter().zip(weights).flat_map(|(p, w)| p.hits.iter().map(move |hit| (hit, p.r, w / p.hits.len() as f64)));
        let mut run: Option<(&Hit, f64, Vec<f64>, Vec<f64>)> = None;
        for (hit, r, weight) in hits {
            match &mut run {
                Some((first, _, value, slope)) if Arc::ptr_eq(&first.nodes, &hit.nodes) && Arc::ptr_eq(&first.r, &hit.r) => {
                    value.iter_mut().zip(&hit.y.value).for_each(|(sum, v)| *sum += weight * v);
                    slope.iter_mut().zip(&hit.y.slope).for_each(|(sum, d)| *sum += weight * d);
                }
                _ => {
                    sums.add(run.take());
                    let scaled = |list: &[f64]| list.iter().map(|v| weight * v).collect();
                    run = Some((hit, r, scaled(&hit.y.value), scaled(&hit.y.slope)));
                }
            }
        }
        sums.add(run);
        sums
    }

    fn add(&mut self, run: Option<(&Hit, f64, Vec<f64>, Vec<f64>)>) {
        let Some((hit, r, value, slope)) = run else { return };
        for ((nodes, v), d) in hit.nodes.chunks_exact(hit.r.value.len()).zip(value).zip(slope) {
            for ((&node, a), s) in nodes.iter().zip(&hit.r.value).zip(&hit.r.slope) {
                self.value[node] += a * v;
                self.over_r[node] += a * v / r;
                self.d_r[node] += s * v;
                self.d_y[node] += a * d;
            }
        }
    }
}
